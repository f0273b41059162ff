#include "semantics/view_fusion.h"

#include <catch2/catch.hpp>

using namespace svnet;
using namespace svnet::semantics;

namespace {
const std::vector<float> kFeatures{1, 2, 3, 4, 5, 6, 7, 8};  // four views of two features
}

TEST_CASE("views of an item are averaged or concatenated") {
  CHECK(fused_views(ViewFusion::mean, kFeatures, 2, std::vector<Index>{3, 1}) == std::vector<float>{3, 4, 7, 8});
  CHECK(fused_views(ViewFusion::mean, kFeatures, 2, std::vector<Index>{1, 1, 1, 1}) == kFeatures);
  CHECK(fused_views(ViewFusion::concatenate, kFeatures, 2, std::vector<Index>{2, 2}) == kFeatures);
}

TEST_CASE("views that cannot be fused are refused") {
  CHECK_THROWS_WITH(fused_views(ViewFusion::concatenate, kFeatures, 2, std::vector<Index>{3, 1}),
                    "[view_fusion] item 1 has 1 views, item 0 has 3; concatenate needs as many views of every item, "
                    "mean takes any");
  CHECK_THROWS_WITH(fused_views(ViewFusion::mean, kFeatures, 2, std::vector<Index>{4, 0}),
                    "[view_fusion] item 1 has no views");
  CHECK_THROWS_WITH(fused_views(ViewFusion::mean, kFeatures, 2, std::vector<Index>{3, 2}),
                    "[view_fusion] 8 features are not 5 x 2");
}
