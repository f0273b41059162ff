#include "train/config/strict_yaml.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include "base/error.h"
#include "base/text.h"
#include "train/config/yaml_blanks.h"

namespace svnet::train {
namespace {

using Kind = YamlValue::Kind;

constexpr const char* kOverride = "--set";

/// Builds the tree from the parser's events, so that tags, anchors and duplicate keys are seen before they are lost.
class TreeBuilder : public YAML::EventHandler {
 public:
  /// The value of an override where `root_key` is given, else the text of the file `source`.
  TreeBuilder(std::string source, const std::string& root_key) : source_(std::move(source)) {
    root_.key = root_key;
    place(root_, 1);
  }

  YamlValue take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnAnchor(const YAML::Mark& mark, const std::string& name) override {
    fail(start(mark), ": anchors ('&", name, "') are not allowed here, write the value out");
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    fail(start(mark), ": aliases are not allowed here, write the value out");
  }
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { add(mark, "?", anchor, Kind::null, ""); }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    add(mark, tag, anchor, Kind::scalar, text);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    add(mark, tag, anchor, Kind::list, "");
  }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    add(mark, tag, anchor, Kind::mapping, "");
  }
  void OnSequenceEnd() override { open_.pop_back(); }
  void OnMapEnd() override { open_.pop_back(); }

 private:
  std::string start(const YAML::Mark& mark) const {
    return source_ == kOverride ? source_ + " " + root_.key : joined(source_, ":", mark.line + 1);
  }

  void add(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, Kind kind, const std::string& text) {
    check(anchor == YAML::NullAnchor, start(mark), ": anchors are not allowed here, write the value out");
    check(tag.empty() || tag == "?" || tag == "!", start(mark), ": tags ('", tag, "') are not allowed here");
    if (!open_.empty() && open_.back()->kind == Kind::mapping && !key_waits_) return add_key(mark, kind, text);
    key_waits_ = false;
    YamlValue* value = &root_;
    if (!open_.empty()) {
      YamlValue& parent = *open_.back();
      if (parent.kind == Kind::list) add_item(parent, joined(parent.key, "[", parent.items.size(), "]"), mark);
      value = &parent.items.back();
    }
    value->kind = kind;
    value->text = text;
    value->quoted = tag == "!";
    if (kind == Kind::list || kind == Kind::mapping) open_.push_back(value);
  }

  void add_key(const YAML::Mark& mark, Kind kind, const std::string& name) {
    YamlValue& mapping = *open_.back();
    check(kind == Kind::scalar, start(mark), ": a key must be a name");
    check(name.find('.') == std::string::npos, start(mark), ": key '", name,
          "' has a dot: write what follows the dot indented on a line of its own, below 'NAME:'");
    const std::string key = mapping.key.empty() ? name : mapping.key + "." + name;
    for (const auto& item : mapping.items)
      check(item.key != key, start(mark), ": key '", key, "' is given twice, first on line ", item.line);
    add_item(mapping, key, mark);
    key_waits_ = true;
  }

  // A mapping's value is placed where its key stands: the parser marks an empty value lines below.
  void add_item(YamlValue& parent, const std::string& key, const YAML::Mark& mark) {
    YamlValue& value = parent.items.emplace_back();
    value.key = key;
    place(value, mark.line + 1);
  }

  void place(YamlValue& value, int line) const {
    value.line = line;
    value.place = source_ == kOverride ? source_ : joined(source_, ":", line);
  }

  std::string source_;
  YamlValue root_;
  // From the root down. A parent does not grow while a child is open, so that these stay valid.
  std::vector<YamlValue*> open_;
  bool key_waits_ = false;
};

YamlValue parse(const std::string& text, const std::string& source, const std::string& root_key) {
  const std::string start = source == kOverride ? source + " " + root_key : source;
  // Without the last line break yaml-cpp sees a quote that is never closed; with it, it does not.
  const std::string trimmed = text.substr(0, text.find_last_not_of(" \t\r\n") + 1);
  if (const auto blank = false_blank(text))
    fail(start, source == kOverride ? "" : joined(":", blank->line), ": ", blank->what, " (column ", blank->column,
         "); YAML takes spaces only");
  std::istringstream stream(trimmed);
  TreeBuilder builder(source, root_key);
  try {
    // An error of syntax first: it may reach the builder as a mapping that nobody wrote. Only the first document: with
    // "][" the parser would find empty documents without end.
    YAML::Load(trimmed);
    YAML::Parser parser(stream);
    parser.HandleNextDocument(builder);
    TreeBuilder rest(source, root_key);
    check(!parser.HandleNextDocument(rest), start, ": only one YAML document is allowed, remove what follows '---'");
  } catch (const YAML::Exception& e) {
    fail(start, source == kOverride ? "" : joined(":", e.mark.line + 1), ": ", e.msg, " (column ", e.mark.column + 1,
         ")");
  }
  return builder.take();
}

std::string what_it_is(const YamlValue& value) {
  switch (value.kind) {
    case Kind::null:
      return "no value is given";
    case Kind::scalar:
      return "'" + value.text + "'" + (value.quoted ? " in quotes is text" : " is wrong");
    case Kind::list:
      return "a list is given";
    case Kind::mapping:
      return "a mapping is given";
  }
  return "";
}

[[noreturn]] void fail_expected(const YamlValue& value, const std::string& expected) {
  fail(value.where(), ": ", what_it_is(value), ", expected ", expected);
}

bool contains(const NumberRange& range, double x) {
  return std::isfinite(x) && (range.min_open ? x > range.min : x >= range.min) &&
         (range.max_open ? x < range.max : x <= range.max);
}

bool is_plain(std::string_view text) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '/'; };
  const auto inner = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.'; };
  static constexpr std::array<std::string_view, 12> kSpecial{"null", "true", "false", "yes", "no",  "on",
                                                             "off",  "y",    "n",     "nan", "inf", "infinity"};
  const std::string lower = lower_case(text);
  return !text.empty() && (letter(text[0]) || text.starts_with("..")) && std::all_of(text.begin(), text.end(), inner) &&
         std::find(kSpecial.begin(), kSpecial.end(), lower) == kSpecial.end();
}

}  // namespace

std::string YamlValue::where() const { return key.empty() ? place : place + (place == kOverride ? " " : ": ") + key; }

YamlValue parse_yaml(const std::string& text, const std::string& source) { return parse(text, source, ""); }

YamlValue parse_override(const std::string& assignment) {
  const auto at = assignment.find('=');
  check(at != std::string::npos && at > 0, "--set ", assignment, ": expected key=value");
  YamlValue value = parse(assignment.substr(at + 1), kOverride, assignment.substr(0, at));
  if (at + 1 == assignment.size()) value.kind = Kind::scalar, value.quoted = true;
  return value;
}

std::string described(const NumberRange& range, bool whole) {
  std::string text = whole ? "a whole number" : "a number";
  const bool low = std::isfinite(range.min), high = std::isfinite(range.max);
  if (low) text += (range.min_open ? " > " : " >= ") + written_yaml(range.min);
  if (high) text += (low ? " and" : "") + std::string(range.max_open ? " < " : " <= ") + written_yaml(range.max);
  return text;
}

std::string described(std::span<const std::string> choices) { return "one of " + joined_with(", ", choices); }

std::string yaml_text(const YamlValue& value) {
  if (value.kind != Kind::scalar) fail_expected(value, "text (\"\" for none)");
  return value.text;
}

Index yaml_whole_number(const YamlValue& value, const NumberRange& range) {
  const std::string expected = described(range, true);
  if (value.kind != Kind::scalar || value.quoted) fail_expected(value, expected);
  Index whole = 0;
  if (double real = 0; !parse_number(value.text, whole)) {
    const bool exact = parse_number(value.text, real) && real == std::floor(real) && std::abs(real) <= 0x1p53;
    if (!exact) fail_expected(value, expected);
    whole = static_cast<Index>(real);
  }
  check(contains(range, static_cast<double>(whole)), value.where(), ": ", value.text, " is out of range, expected ",
        expected);
  return whole;
}

double yaml_number(const YamlValue& value, const NumberRange& range) {
  const std::string expected = described(range, false);
  double number = 0;
  if (value.kind != Kind::scalar || value.quoted || !parse_number(value.text, number)) fail_expected(value, expected);
  check(contains(range, number), value.where(), ": ", value.text, " is out of range, expected ", expected);
  return number;
}

void check_choice(const std::string& where, const std::string& name, std::span<const std::string> choices) {
  if (std::find(choices.begin(), choices.end(), name) != choices.end()) return;
  const std::string nearest = nearest_name(name, choices);
  fail(where, ": unknown value '", name, "', expected ", described(choices),
       nearest.empty() ? "" : "; did you mean '" + nearest + "'?");
}

std::string yaml_choice(const YamlValue& value, std::span<const std::string> choices) {
  if (value.kind != Kind::scalar) fail_expected(value, described(choices));
  check_choice(value.where(), value.text, choices);
  return value.text;
}

std::vector<std::string> yaml_texts(const YamlValue& value) {
  if (value.kind != Kind::list) fail_expected(value, "a list, as in [first, second]");
  std::vector<std::string> texts;
  for (const auto& item : value.items) {
    const std::string text = yaml_text(item);
    check(!text.empty(), item.where(), ": the name is empty");
    check(std::find(texts.begin(), texts.end(), text) == texts.end(), item.where(), ": '", text, "' is listed twice");
    texts.push_back(text);
  }
  return texts;
}

std::string written_yaml(std::string_view text) {
  if (is_plain(text)) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += {'\\', c};
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      constexpr const char* kDigits = "0123456789abcdef";
      quoted += {'\\', 'x', kDigits[(c >> 4) & 15], kDigits[c & 15]};
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

std::string written_yaml(double number) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  return {digits.data(), end};
}

std::string written_yaml(std::span<const std::string> texts) {
  std::vector<std::string> written;
  for (const auto& text : texts) written.push_back(written_yaml(text));
  return "[" + joined_with(", ", written) + "]";
}

}  // namespace svnet::train
