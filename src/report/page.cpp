#include "report/page.h"

#include "base/error.h"
#include "base/version.h"
#include "report/markup.h"
#include "report/page_style.h"

namespace svnet::report {

std::string page_html(const Page& page) {
  std::string links, sections;
  for (const Section& section : page.sections) {
    if (section.inner.empty()) continue;
    links += element("li", element("a", {{"href", "#" + section.id}}, escaped(section.title)));
    sections +=
        element("section", {{"id", section.id}}, element("h2", escaped(section.title)) + "\n" + section.inner) + "\n";
  }
  const std::string head = empty_element("meta", {{"charset", "utf-8"}}) +
                           empty_element("meta", {{"name", "viewport"}, {"content", "width=device-width"}}) +
                           element("title", escaped(page.title)) + element("style", kPageStyle);
  const std::string body =
      element("header", element("h1", escaped(page.title)) + "\n" + page.lead) + "\n" +
      element("nav", {{"aria-label", "Sections"}}, element("ul", links)) + "\n" + element("main", "\n" + sections) +
      "\n" +
      element("footer", element("p", escaped(joined("Made by svnet ", kVersion,
                                                    ". This file holds everything that it shows; nothing is "
                                                    "loaded from elsewhere."))));
  return "<!DOCTYPE html>\n" + element("html", {{"lang", "en"}}, element("head", head) + "\n" + element("body", body)) +
         "\n";
}

std::string how_to_read(const std::string& text) { return element("p", {{"class", "how"}}, escaped(text)) + "\n"; }

std::string table_html(const std::string& label, const std::string& inner) {
  return element("div", {{"class", "scroll"}, {"tabindex", "0"}, {"role", "region"}, {"aria-label", "Table: " + label}},
                 element("table", inner)) +
         "\n";
}

}  // namespace svnet::report
