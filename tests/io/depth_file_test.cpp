#include "io/images/depth_file.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <limits>

#include "io/images/image_file.h"
#include "temporary_folder.h"

using namespace svnet;

namespace {

/// A NumPy file, version 1.0, as numpy.save writes it.
std::string npy(const std::string& dictionary, const std::string& data) {
  std::string header = dictionary + std::string(117 - dictionary.size(), ' ') + '\n';
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + '\0' + header + data;
}

template <class Number>
std::string bytes(const std::vector<Number>& numbers) {
  std::string result(numbers.size() * sizeof(Number), '\0');
  std::memcpy(result.data(), numbers.data(), result.size());
  return result;
}

std::string refusal(const std::filesystem::path& path) {
  try {
    read_depth(path);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "read";
}

}  // namespace

TEST_CASE("depth is written and read in millimetres") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "depth.png";
  write_depth_png(path, {2, 3, {0, 0.001f, 0.5f, 1.2346f, 65.534f, 65.535f}});
  const DepthImage depth = read_depth(path);
  CHECK(depth.height == 2);
  CHECK(depth.width == 3);
  CHECK(depth.metres == std::vector<float>{0, 0.001f, 0.5f, 1.235f, 65.534f, 0});
}

TEST_CASE("depth is read from NumPy files of floats in metres") {
  const TemporaryFolder folder;
  const std::string single = bytes(std::vector<float>{1.5f, -1, 0, std::nanf(""), INFINITY, 2.25f});
  const auto path = folder.write("a.npy", npy("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }", single));
  CHECK(read_depth(path).metres == std::vector<float>{1.5f, 0, 0, 0, 0, 2.25f});
  CHECK(read_depth(path).width == 3);
  // A depth beyond the range of the robot means: not measured.
  const std::string twice = bytes(std::vector<double>{0.25, 4, 1000});
  folder.write("b.npy", npy("{'descr': '<f8', 'fortran_order': False, 'shape': (1, 3), }", twice));
  CHECK(read_depth(folder.path() / "b.npy").metres == std::vector<float>{0.25f, 4, 0});
}

TEST_CASE("depth files that cannot be read are named in one line") {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& contents) { return refusal(folder.write("d", contents)); };
  const std::string name = (folder.path() / "d").string() + ": ", data = bytes(std::vector<float>{1, 2});
  CHECK(refusal(folder.path() / "none") == (folder.path() / "none").string() + ": no such file");
  CHECK(message("text") ==
        name + "is neither a PNG nor a NumPy file, expected depth as 16-bit PNG in millimetres or .npy in metres");
  CHECK(message(npy("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }", data)) ==
        name + "is a damaged NumPy file (its size is not that of its array); replace the file");
  CHECK(message(npy("{'descr': '<i4', 'fortran_order': False, 'shape': (1, 2), }", data)) ==
        name + "holds no little-endian floats of 32 or 64 bits, expected depth in metres");
  CHECK(message(npy("{'descr': '<f4', 'fortran_order': True, 'shape': (1, 2), }", data)) ==
        name + "is stored by columns; save it with numpy.ascontiguousarray");
  for (const char* shape : {"(2,)", "(1, 2, 1)", "(a, 2)", "()", "(1"})
    CHECK(message(npy(std::string("{'descr': '<f4', 'fortran_order': False, 'shape': ") + shape + ", }", data)) ==
          name + "holds an array that is not two-dimensional, expected (height, width)");
  CHECK_THAT(message(npy("{'descr': '<f4', 'fortran_order': False, 'shape': (99999, 99999), }", data)),
             Catch::Contains("more than the 64 megapixels"));
  const std::string whole = npy("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2), }", data);
  for (std::size_t length = 6; length < whole.size(); ++length)
    CHECK_THAT(message(whole.substr(0, length)), Catch::StartsWith(name));
  const auto numbers = [&](float a, float b) {
    return message(npy("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2), }", bytes(std::vector<float>{a, b})));
  };
  const std::string no_distance =
      name + "holds no distance between 0 and 100 m; depth is in millimetres in a PNG, in metres in .npy";
  CHECK(numbers(812, 950) == no_distance);
  CHECK(numbers(0, std::numeric_limits<float>::quiet_NaN()) == no_distance);
  write_png(folder.path() / "d", {1, 2, std::vector<std::uint8_t>(6)});
  CHECK(refusal(folder.path() / "d") == name + "is a PNG of another kind, expected 16-bit grey, depth in millimetres");
  write_depth_png(folder.path() / "d", {1, 2, {1, 2}});
  const std::string png = file_contents(folder.path() / "d");
  CHECK_THAT(message(png.substr(0, png.size() - 20)), Catch::Contains("is a damaged or incomplete PNG picture"));
}
