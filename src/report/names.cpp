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
    {"opt_ind", "best individual", "the best view by individual score"},
    {"opt_glob", "best global", "the best view by global score"},
};

}  // namespace

std::string selector_words(const std::string& name) {
  for (const SelectorWords& selector : kSelectorWords)
    if (name == selector.name) return selector.words;
  return name;
}

std::string selector_label(const std::string& name) {
  for (const SelectorWords& selector : kSelectorWords)
    if (name == selector.name) return selector.label;
  return name;
}

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
