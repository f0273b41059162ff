#include <array>
#include <catch2/catch.hpp>
#include <limits>
#include <vector>

#include "svnet/svnet.hpp"

namespace {

void refused(svnet_status status, const std::string& text) {
  CHECK(status == SVNET_INVALID_ARGUMENT);
  CHECK(std::string(svnet_last_error()) == text);
}

// Three groups of items with two features.
const std::vector<float> kFeatures{0, 0, 50, 1, 1, 0, 0, 1, 51, 0, -40, 60, -41, 61};
const std::vector<std::int32_t> kLabels{0, 1, 0, 0, 1, 2, 2};

}  // namespace

TEST_CASE("items are put into groups, whose number is given or estimated") {
  std::vector<std::int32_t> labels(7, -1);
  std::size_t count = 0;
  REQUIRE(svnet_group(kFeatures.data(), 7, 2, 3, labels.data(), &count) == SVNET_OK);
  CHECK(labels == kLabels);
  CHECK(count == 3);
  labels.assign(7, -1);
  REQUIRE(svnet_group(kFeatures.data(), 7, 2, 0, labels.data(), nullptr) == SVNET_OK);
  CHECK(labels == kLabels);
  REQUIRE(svnet_group(kFeatures.data(), 7, 2, 1, labels.data(), &count) == SVNET_OK);
  CHECK(labels == std::vector<std::int32_t>(7, 0));
  REQUIRE(svnet_group(kFeatures.data(), 1, 14, 0, labels.data(), &count) == SVNET_OK);
  CHECK(count == 1);
  const std::array<float, 4> equal{3, 3, 3, 3};
  REQUIRE(svnet_group(equal.data(), 4, 1, 0, labels.data(), &count) == SVNET_OK);
  CHECK(count == 1);
}

TEST_CASE("wrong arguments of groups are reported and do not change the outputs") {
  std::vector<std::int32_t> labels(7, -1);
  std::size_t count = 9;
  refused(svnet_group(nullptr, 7, 2, 3, labels.data(), &count), "[svnet_group] features is NULL");
  refused(svnet_group(kFeatures.data(), 7, 2, 3, nullptr, &count), "[svnet_group] labels is NULL");
  refused(svnet_group(kFeatures.data(), 0, 2, 0, labels.data(), &count),
          "[svnet_group] rows is 0, expected 1 to 65535");
  refused(svnet_group(kFeatures.data(), static_cast<std::size_t>(-1), 2, 0, labels.data(), &count),
          "[svnet_group] rows is 18446744073709551615, expected 1 to 65535");
  refused(svnet_group(kFeatures.data(), 7, 0, 0, labels.data(), &count),
          "[svnet_group] columns is 0, expected 1 to 16777216");
  refused(svnet_group(kFeatures.data(), 7, 2, 8, labels.data(), &count),
          "[svnet_group] cannot make 8 groups of 7 rows");
  std::vector<float> bad = kFeatures;
  bad[3] = std::numeric_limits<float>::infinity();
  refused(svnet_group(bad.data(), 7, 2, 0, labels.data(), &count),
          "[distances] feature 1 of row 1 is inf; every feature must be finite");
  CHECK(labels == std::vector<std::int32_t>(7, -1));
  CHECK(count == 9);
}

TEST_CASE("the C++ interface groups items") {
  const svnet::Groups groups = svnet::group(kFeatures, 7);
  CHECK(groups.labels == kLabels);
  CHECK(groups.count == 3);
  CHECK(svnet::group(kFeatures, 7, 1).count == 1);
  CHECK_THROWS_WITH(svnet::group(kFeatures, 4), "there are 14 features, which is no whole number for each of 4 rows");
  CHECK_THROWS_WITH(svnet::group({}, 0), "there are 0 features, which is no whole number for each of 0 rows");
  CHECK_THROWS_WITH(svnet::group(kFeatures, 7, 8), "[svnet_group] cannot make 8 groups of 7 rows");
}
