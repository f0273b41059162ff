#pragma once
#include <string>
#include <vector>

namespace svnet::report {

/// A section of a page, with its heading.
struct Section {
  std::string id, title;
  std::string inner;  ///< markup
};

struct Page {
  std::string title;
  std::string lead;               ///< markup below the title
  std::vector<Section> sections;  ///< those without contents are left out
};

/// The page as one HTML file: no scripts, and nothing that is loaded. It suits phones, and dark mode.
std::string page_html(const Page& page);

/// <p class="how">text</p>: how to read what follows.
std::string how_to_read(const std::string& text);

/// A table that can be scrolled sideways. `label`: what it is, in words. `inner`: its head and body.
std::string table_html(const std::string& label, const std::string& inner);

}  // namespace svnet::report
