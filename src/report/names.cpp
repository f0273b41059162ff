#include "report/names.h"

#include <cctype>

namespace svnet::report {
namespace {

struct SelectorWords {
  const char *name, *label, *words;
};
constexpr SelectorWords kSelectorWords[] = {
    {"top", "top view", "the top view"},
    {"rand", "random view", "a random view"},
    {"broadside", "broadside rule", "the fixed rule broadside (φ 45° across the object's axis)"},
    {"phi_map", "elevation rule", "the fixed rule phi_map (the best elevation of the training scores)"},
    {"svnet", "SV-net", "SV-net"},
    {"next", "next view", "SV-net's view and those ranked best given the pictures taken"},
    {"top_svnet", "top view, SV-net", "the top view and SV-net's"},
    {"top_next", "top view, next view", "the top view and those ranked best given the pictures taken"},
    {"move_25", "a quarter moved", "SV-net where it expects most of it, in a quarter of the poses"},
    {"move_50", "half moved", "SV-net where it expects most of it, in half of the poses"},
    {"move_75", "three quarters moved", "SV-net where it expects most of it, in three quarters of the poses"},
    {"opt_ind", "best individual", "the best view by individual score"},
    {"opt_glob", "best global", "the best view by global score"},
};

/// The words for a selector; "SV-net, 2 views" for several views.
std::string words_of(const std::string& name, const char* SelectorWords::*words) {
  for (const SelectorWords& selector : kSelectorWords) {
    const std::string_view kind = selector.name;
    if (name == kind) return selector.*words;
    if (name.starts_with(kind) && name.size() == kind.size() + 2 && name[kind.size()] == '_' &&
        std::isdigit(static_cast<unsigned char>(name.back())) != 0)
      return std::string(selector.*words) + ", " + name.back() + " views";
  }
  return name;
}

}  // namespace

std::string selector_words(const std::string& name) { return words_of(name, &SelectorWords::words); }

std::string selector_label(const std::string& name) { return words_of(name, &SelectorWords::label); }

std::string Ids::make(std::string_view text) {
  std::string id;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    id += byte >= 0x80 || std::isalnum(byte) != 0 || c == '_' || c == '.' ? c : '-';
  }
  if (id.empty() || std::isdigit(static_cast<unsigned char>(id[0])) != 0) id = "o" + id;
  const int count = used_[id]++;
  return count == 0 ? id : make(id + "-" + std::to_string(count + 1));
}

}  // namespace svnet::report
