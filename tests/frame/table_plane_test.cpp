#include "frame/table_plane.h"

#include <catch2/catch.hpp>
#include <string>

#include "base/error.h"

using namespace svnet;
using namespace svnet::frame;

namespace {

std::vector<std::int64_t> level_and_slope(bool with_object) {
  std::vector<std::int64_t> values;
  for (Index row = 0; row < kSide; ++row)
    for (Index column = 0; column < kSide; ++column) {
      const bool is_object = with_object && column > 80 && row > 30;  // covers 35 % of the ring
      values.push_back(is_object ? 90'000 : 20'000 + 30 * half_cells(column) - 50 * half_cells(row));
    }
  return values;
}

}  // namespace

TEST_CASE("the table's plane is found beside an object that covers a third of the ring") {
  for (const bool with_object : {false, true}) {
    CAPTURE(with_object);
    const TablePlane table =
        fit_table(level_and_slope(with_object), 1, Grid<std::uint8_t>(static_cast<std::size_t>(kCells), 1));
    REQUIRE(table.planes.size() == 1);
    CHECK(table.planes[0].level == Approx(20'000).epsilon(1e-9));
    CHECK(table.planes[0].along_x == Approx(30).epsilon(1e-9));
    CHECK(table.planes[0].along_y == Approx(-50).epsilon(1e-9));
    CHECK(table.noise == Approx(0).margin(1e-6));
  }
}

TEST_CASE("a ring that was hardly measured is an error that says how much was") {
  Grid<std::uint8_t> measured(static_cast<std::size_t>(kCells));
  for (Index column = 0; column < kSide; ++column) measured[static_cast<std::size_t>(56 * kSide + column)] = 1;
  CHECK_THROWS_WITH(fit_table(level_and_slope(false), 1, measured),
                    Catch::Contains("[frame] the table cannot be seen") && Catch::Contains("at least a tenth"));
}
