#include "sorting/bins.h"

#include <catch2/catch.hpp>

#include "base/error.h"

using namespace svnet;
using sorting::in_wrong_bin;
using Numbers = std::vector<std::int32_t>;
using Wrong = std::vector<bool>;

TEST_CASE("objects are right if bins are categories, whatever their numbers") {
  CHECK(in_wrong_bin(Numbers{0, 1, 0, 2}, Numbers{5, 3, 5, 0}) == Wrong(4, false));
  CHECK(in_wrong_bin(Numbers{}, Numbers{}).empty());
}

TEST_CASE("an object among more objects of another category is wrong") {
  CHECK(in_wrong_bin(Numbers{0, 0, 0, 1, 1}, Numbers{0, 0, 1, 1, 1}) == Wrong{false, false, true, false, false});
  // All objects of category 1 are in a bin that stands for 0.
  CHECK(in_wrong_bin(Numbers{0, 0, 0, 0, 0}, Numbers{0, 0, 0, 1, 1}) == Wrong{false, false, false, true, true});
}

TEST_CASE("a category has one bin: that with the most of its objects") {
  CHECK(in_wrong_bin(Numbers{0, 1, 1, 1, 0}, Numbers{4, 4, 4, 4, 4}) == Wrong{true, false, false, false, true});
  // Bin 1 stands for category 1, but bin 0 has more of its objects, and stands for 0.
  CHECK(in_wrong_bin(Numbers{0, 0, 0, 0, 0, 1}, Numbers{0, 0, 0, 1, 1, 1}) ==
        Wrong{false, false, false, true, true, true});
}

TEST_CASE("ties: the first bin is right, and a bin stands for the category of its first object") {
  CHECK(in_wrong_bin(Numbers{1, 0, 1, 0}, Numbers{2, 2, 2, 2}) == Wrong{true, false, true, false});
  CHECK(in_wrong_bin(Numbers{0, 0}, Numbers{1, 0}) == Wrong{false, true});
  // Two objects of category 1 in both bins: bin 0 stands for category 0.
  CHECK(in_wrong_bin(Numbers{0, 0, 0, 0, 0, 1, 1}, Numbers{1, 1, 0, 0, 0, 1, 1}) ==
        Wrong{true, true, false, false, false, false, false});
}

TEST_CASE("bins and categories are of the same objects") {
  CHECK_THROWS_WITH(in_wrong_bin(Numbers{0, 1}, Numbers{0}), "[bins] 2 bins of 1 objects");
}
