#include "serve/prediction_request.h"

#include "serve/requests.h"
#include "view/pose_grid.h"

using namespace svnet;
using namespace svnet::serve;

namespace {

PredictionRequest read(const Fields& fields) { return prediction_request(fields, 500); }

}  // namespace

TEST_CASE("without fields the paper's grid is asked for") {
  const PredictionRequest request = read({});
  CHECK(request.poses == view::paper_grid());
  CHECK(request.exif == ExifOrientation::ignore);
  CHECK_FALSE(request.depth_unit_m);
  CHECK(request.place.radius_m == 1);
  CHECK(request.place.frame == view::CameraFrame::optical);
}

TEST_CASE("all fields are read") {
  CHECK(read({{"grid", "even"}, {"count", "7"}, {"lowest_phi_deg", "30"}}).poses == view::fibonacci_half_sphere(7, 30));
  CHECK(read({{"grid", "even"}}).poses == view::fibonacci_half_sphere(400, 45));
  const PredictionRequest request = read({{"poses", "0,45;-90,60.5;"},
                                          {"exif_orientation", "obey"},
                                          {"depth_unit", "0.25mm"},
                                          {"radius_m", "0.5"},
                                          {"centre_m", "1,2,-3"},
                                          {"frame", "paper"}});
  CHECK(request.poses == std::vector<view::CameraPose>{{0, 45}, {-90, 60.5}});
  CHECK(request.exif == ExifOrientation::obey);
  CHECK(request.depth_unit_m == 0.00025);
  CHECK(request.place.radius_m == 0.5);
  CHECK(request.place.centre_m == Eigen::Vector3d(1, 2, -3));
  CHECK(request.place.frame == view::CameraFrame::paper);
}

TEST_CASE("fields with wrong values are refused by name") {
  for (const auto& [name, value] : Fields{{"grid", "odd"},
                                          {"poses", ""},
                                          {"poses", "1"},
                                          {"poses", "1,2,3"},
                                          {"poses", "0,95"},
                                          {"poses", "0,45;;0,45"},
                                          {"radius_m", "0"},
                                          {"radius_m", "-1"},
                                          {"centre_m", "1,2"},
                                          {"frame", "opticle"},
                                          {"exif_orientation", "1"}}) {
    CAPTURE(name, value);
    const Fields field{{name, value}};
    CHECK_THAT(refusal_of([&] { read(field); }), Catch::StartsWith("400 " + name + ": "));
  }
  for (const char* count : {"0", "-1", "1.5", "501", "1e300"})
    CHECK_THAT(refusal_of([&] { read({{"grid", "even"}, {"count", count}}); }), Catch::StartsWith("400 count: "));
  for (const char* lowest : {"-1", "90"})
    CHECK_THAT(refusal_of([&] {
                 read({{"grid", "even"}, {"lowest_phi_deg", lowest}});
               }),
               Catch::StartsWith("400 lowest_phi_deg: "));
  CHECK_THAT(refusal_of([] { read({{"count", "5"}}); }), Catch::StartsWith("400 the field count is not known here"));
  std::string many;
  for (int i = 0; i < 501; ++i) many += "0,45;";
  CHECK(refusal_of([&] { read({{"poses", many}}); }) == "400 poses: more than 500");
}
