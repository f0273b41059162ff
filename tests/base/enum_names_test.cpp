#include "base/enum_names.h"

#include <catch2/catch.hpp>

using namespace svnet;

namespace {

enum class Colour { green = 7, red = 3 };

constexpr auto enum_table(Colour) {
  return std::to_array<EnumName<Colour>>({{Colour::red, "red"}, {Colour::green, "green"}});
}

}  // namespace

TEST_CASE("an enum's values are known by the names of its table") {
  CHECK(names_of<Colour>() == std::vector<std::string>{"red", "green"});
  static_assert(std::string_view(name_of(Colour::green)) == "green");
  for (const std::string& name : names_of<Colour>()) CHECK(name_of(*find_enum<Colour>(name)) == name);
  CHECK(enum_from_name<Colour>("--colour", "red") == Colour::red);
  CHECK_FALSE(find_enum<Colour>("blue").has_value());
  CHECK_FALSE(find_enum<Colour>("").has_value());
}

TEST_CASE("a name that an enum does not have is refused with those it has") {
  CHECK_THROWS_WITH(enum_from_name<Colour>("--colour", "blue"), "--colour: 'blue' is none of red, green");
  CHECK_THROWS_WITH(enum_from_name<Colour>("--colour", "gren"),
                    "--colour: 'gren' is none of red, green; did you mean 'green'?");
}
