#include "train/config/yaml_blanks.h"

#include <algorithm>
#include <array>

namespace svnet::train {
namespace {

struct UnicodeSpace {
  std::string_view bytes;
  const char* name;
};

constexpr std::array<UnicodeSpace, 5> kUnicodeSpaces{{{"\xc2\xa0", "a no-break space (U+00A0)"},
                                                      {"\xe2\x80\xaf", "a narrow no-break space (U+202F)"},
                                                      {"\xe2\x80\x87", "a figure space (U+2007)"},
                                                      {"\xe3\x80\x80", "an ideographic space (U+3000)"},
                                                      {"\xe2\x80\x8b", "a zero-width space (U+200B)"}}};

/// Reads YAML just well enough to know what is in quotes, comments and brackets.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  std::optional<FalseBlank> scan() {
    while (at_ < text_.size()) {
      if (starts_line_ && depth_ == 0 && quote_ == 0)
        if (auto tab = tab_in_indentation()) return tab;
      starts_line_ = false;
      if (quote_ == 0)
        for (const UnicodeSpace& space : kUnicodeSpaces)
          if (text_.substr(at_).starts_with(space.bytes)) return FalseBlank{line_, column_, space.name};
      step();
    }
    return std::nullopt;
  }

 private:
  std::optional<FalseBlank> tab_in_indentation() const {
    std::size_t end = text_.find_first_not_of(" \t", at_);
    const std::size_t tab = text_.substr(0, end).find('\t', at_);
    if (tab == std::string_view::npos || end == std::string_view::npos) return std::nullopt;
    if (text_[end] == '\n' || text_[end] == '\r' || text_[end] == '#') return std::nullopt;
    return FalseBlank{line_, column_ + static_cast<long>(tab - at_), "a tab in the indentation"};
  }

  void step() {
    const char c = text_[at_++];
    if ((static_cast<unsigned char>(c) & 0xc0) != 0x80) ++column_;
    if (c == '\n') {
      ++line_, column_ = 1;
      starts_line_ = true;
      if (quote_ == 0) before_ = ' ';
      return;
    }
    if (quote_ != 0) {
      if (quote_ == '"' && c == '\\' && at_ < text_.size() && text_[at_] != '\n') ++at_, ++column_;
      if (c == quote_) quote_ = 0;
      return;
    }
    if (c == '#' && before_ == ' ') {  // a comment
      at_ = std::min(text_.find('\n', at_), text_.size());
      return;
    }
    if ((c == '"' || c == '\'') && (before_ == ' ' || before_ == '[' || before_ == ',' || before_ == '{')) quote_ = c;
    if (c == '[' || c == '{') ++depth_;
    if ((c == ']' || c == '}') && depth_ > 0) --depth_;
    before_ = c == '\t' ? ' ' : c;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  long line_ = 1, column_ = 1;
  int depth_ = 0;
  char quote_ = 0, before_ = ' ';
  bool starts_line_ = true;
};

}  // namespace

std::optional<FalseBlank> false_blank(std::string_view yaml) { return Scanner(yaml).scan(); }

}  // namespace svnet::train
