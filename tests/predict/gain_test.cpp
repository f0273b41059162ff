#include "predict/gain.h"

#include <catch2/catch.hpp>

using namespace svnet;
using namespace svnet::predict;

TEST_CASE("a gain is the line plus what it left over") {
  const GainCalibration calibration{0.02, 0.5, {-0.2, -0.1, 0, 0.1, 0.2}};
  const Gain gain = expected_gain(calibration, 0.16);
  CHECK(gain.expected == Approx(0.1));
  CHECK(gain.low == Approx(0.1 - 0.16));
  CHECK(gain.high == Approx(0.1 + 0.16));
  CHECK(gain.probability == Approx(0.75));  // a residual above -0.1
  CHECK(expected_gain(calibration, 1).probability == 1);
  CHECK(expected_gain(calibration, -1).probability == 0);
  CHECK(expected_gain(calibration, 0).expected == 0);  // no move
  CHECK_THROWS_WITH(expected_gain({}, 0.1), Catch::Contains("the model does not say what moving the camera gains"));
}

TEST_CASE("the margin is that of centred scores") {
  CHECK(centred_margin(0.5, 0.5) == 0);
  // A sigmoid of 4 s is about 0.5 + s near 0.
  CHECK(centred_margin(0.55, 0.45) == Approx(0.1).epsilon(0.01));
  CHECK(std::isfinite(centred_margin(1, 0)));
}
