#include "sorting/summary.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"

using namespace svnet;
using namespace svnet::sorting;

namespace {

SortedTable table_with(Index wrong_first, Index wrong_second) {
  SortedTable table;
  table.outcomes.resize(2);
  table.outcomes[0].wrong_count = wrong_first;
  table.outcomes[1].wrong_count = wrong_second;
  table.outcomes[1].camera = {12, 30.0};
  return table;
}

}  // namespace

TEST_CASE("summaries are means, and differences on the same tables") {
  const std::vector<SortedTable> tables{table_with(4, 1), table_with(2, 1), table_with(3, 4), table_with(7, 4)};
  const auto all = summaries(tables, 0);
  REQUIRE(all.size() == 2);
  CHECK(all[0].wrong == Approx(4));
  CHECK(all[0].fewer_than_first == 0);
  CHECK(all[0].interval.low == 0);
  CHECK(all[0].interval.high == 0);
  CHECK(all[1].wrong == Approx(2.5));
  CHECK(all[1].moves == Approx(12));
  CHECK(all[1].seconds == Approx(30));
  CHECK(all[1].fewer_than_first == Approx(1.5));
  CHECK(all[1].interval.low < 1.5);
  CHECK(all[1].interval.high > 1.5);
  CHECK_THROWS_WITH(summaries({}, 0), "[simulation] there are no tables");
}

TEST_CASE("the interval of a mean is that of the normal distribution, for many values") {
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(i % 2 == 0 ? 1.0 : 3.0);  // standard error 1 / sqrt(1000)
  const train::Interval interval = interval_of_mean(values, 5);
  CHECK(interval.low == Approx(2 - 1.96 / std::sqrt(1000)).margin(0.006));
  CHECK(interval.high == Approx(2 + 1.96 / std::sqrt(1000)).margin(0.006));
  CHECK(interval_of_mean(values, 5).low == interval.low);
  CHECK(std::isnan(interval_of_mean(std::span(values).first(1), 5).low));
}
