#pragma once
#include <map>
#include <string>
#include <string_view>

namespace svnet::report {

/// A selector in words: "a random view" for "rand". The name itself if there are no words for it.
std::string selector_words(const std::string& name);

/// A short label of a selector: "random view".
std::string selector_label(const std::string& name);

/// Values of attributes `id`, each once. Characters that may not stand in an id, or that a link would have to escape,
/// become '-'.
class Ids {
 public:
  std::string make(std::string_view text);

 private:
  std::map<std::string, int> used_{};
};

}  // namespace svnet::report
