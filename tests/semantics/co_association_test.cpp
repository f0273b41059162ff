#include "semantics/co_association.h"

#include <catch2/catch.hpp>

#include "base/error.h"

using namespace svnet::semantics;

TEST_CASE("co-association counts the labellings that put two items apart") {
  const std::vector<std::int64_t> labels{0, 0, 1, 1,   //
                                         7, 7, 7, -2,  //
                                         5, 4, 3, 3,   //
                                         1, 1, 2, 2};  //
  const DistanceMatrix distances = co_association_distances(labels, 4);
  const auto apart = [&](int i, int j) { return std::sqrt(static_cast<double>(distances(i, j))); };
  CHECK(apart(0, 0) == 0);
  CHECK(apart(0, 1) == Approx(0.25));
  CHECK(apart(0, 2) == Approx(0.75));
  CHECK(apart(2, 3) == Approx(0.25));
  CHECK(apart(3, 0) == Approx(1));
  CHECK(distances(3, 1) == distances(1, 3));
}

TEST_CASE("co-association recovers groups that no single labelling has") {
  // Three groups of two; each labelling cannot tell two of them apart, or moves one item.
  const std::vector<std::int64_t> labels{0, 0, 0, 0, 1, 1,  //
                                         0, 0, 1, 1, 1, 1,  //
                                         0, 0, 1, 1, 0, 0,  //
                                         0, 0, 1, 2, 2, 2};
  for (const Linkage linkage : {Linkage::average, Linkage::complete, Linkage::single, Linkage::ward})
    CHECK(co_association(labels, 6, 3, linkage) == std::vector<std::int32_t>{0, 0, 1, 1, 2, 2});
  CHECK(co_association(labels, 6, 1) == std::vector<std::int32_t>(6, 0));
}

TEST_CASE("co-association of one labelling is that labelling") {
  const std::vector<std::int64_t> labels{4, 9, 4, 1, 9};
  CHECK(co_association(labels, 5, 3) == std::vector<std::int32_t>{0, 1, 0, 2, 1});
}

TEST_CASE("co-association refuses sizes that do not fit") {
  const std::vector<std::int64_t> labels{0, 1, 0, 1, 1};
  CHECK_THROWS_WITH(co_association(labels, 2, 1),
                    "[co_association] 5 labels are no whole number of labellings of 2 items");
  CHECK_THROWS_WITH(co_association(labels, 0, 1),
                    "[co_association] labels are 0x0; at least one labelling of one item is needed");
  CHECK_THROWS_WITH(co_association(labels, 5, 6),
                    "[dendrogram] cannot make 6 clusters of 5 items; 1 to 5 are possible");
}
