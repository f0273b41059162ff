#include "io/views/camera_file.h"

#include <catch2/catch.hpp>

#include "temporary_folder.h"

using namespace svnet;

TEST_CASE("a camera is written and read") {
  const TemporaryFolder folder;
  const CameraFile camera{{640, 480, 600.5, 601, 319.5, 240}, look_at({30, 60}, 0.7, {1, 2, 3}, CameraFrame::optical)};
  const CameraFile read = read_camera(folder.write("camera.json", camera_json(camera)));
  CHECK(read.intrinsics.width == 640);
  CHECK(read.intrinsics.fx == 600.5);
  CHECK(read.intrinsics.cy == 240);
  REQUIRE(read.camera_to_world.has_value());
  CHECK(read.camera_to_world->matrix().isApprox(camera.camera_to_world->matrix(), 1e-12));
  CHECK_FALSE(read_camera(folder.write("b.json", camera_json({camera.intrinsics, {}}))).camera_to_world.has_value());
}

TEST_CASE("camera files that cannot be used are named in one line") {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& contents) -> std::string {
    try {
      read_camera(folder.write("c.json", contents));
    } catch (const std::exception& error) {
      return error.what();
    }
    return "read";
  };
  const std::string name = (folder.path() / "c.json").string() + ": ";
  const std::string rest = R"("height": 480, "fx": 600, "fy": 600, "cx": 320, "cy": 240)";
  CHECK(message("{" + rest + "}") == name + "the key 'width' is missing");
  CHECK(message(R"({"width": "a", )" + rest + "}") == name + "width is not a number");
  CHECK(message(R"({"width": 640.5, )" + rest + "}") == name + "width is 640.5, expected a number of pixels");
  CHECK(message(R"({"width": 0, )" + rest + "}") ==
        name + "the picture has 0x480 pixels, expected a positive width and height");
  CHECK(message(R"({"width": 300, )" + rest + "}") == name + "cx is 320, which is outside the picture of 300 pixels");
  CHECK(message(R"({"width": 640, "f": 1, )" + rest + "}") == name + "the key 'f' is not known");
  CHECK(message("[]") == name + "is no JSON object");
  CHECK_THAT(message("{"), Catch::StartsWith(name + "is not JSON: "));
  CHECK(message(R"({"width": 640, "pose": {"x_m": 0}, )" + rest + "}") == name + "pose: the key 'y_m' is missing");
  CHECK(message(R"({"width": 640, "pose": {"x_m": 0, "y_m": 0, "z_m": 1, "qx": 0, "qy": 0, "qz": 0, "qw": 2}, )" +
                rest + "}") == name + "pose: the quaternion has length 2, expected 1");
  CHECK(message(R"({"width": 640, "pose": {"x_m": 0, "y_m": 0, "z_m": 1e300, "qx": 1, "qy": 0, "qz": 0, "qw": 0}, )" +
                rest + "}") == name + "pose: z_m is 1e+300, expected metres in the world");
  CHECK(message(R"({"width": 640, "height": 480, "fx": 1e-9, "fy": 600, "cx": 320, "cy": 240})") ==
        name + "fx is 1e-09 for 640 pixels: no camera sees so much; is it in pixels?");
  CHECK_THROWS_WITH(read_camera(folder.path() / "none"),
                    (folder.path() / "none").string() + ": cannot be read; expected a JSON file of a camera");
}
