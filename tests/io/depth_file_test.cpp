#include "io/images/depth_file.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <limits>

#include "base/error.h"
#include "image/depth_unit.h"
#include "io/images/image_codecs.h"
#include "io/images/image_file.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;

namespace {

/// A NumPy file as numpy.save writes it; from version 2 on the header's length has four bytes.
std::string npy(const std::string& dictionary, const std::string& data, char version = 1) {
  std::string header = dictionary + std::string(117 - dictionary.size(), ' ') + '\n';
  return std::string("\x93NUMPY") + version + '\0' + static_cast<char>(header.size()) +
         std::string(version == 1 ? 1 : 3, '\0') + header + data;
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

TEST_CASE("depth that a PNG cannot hold is written and read as not measured") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "depth.png";
  write_depth_png(path, {1, 4, {-1, std::nanf(""), 65.535f, 1}});
  CHECK(read_depth(path).metres == std::vector<float>{0, 0, 0, 1});
  // Cameras mark such pixels by the largest level too.
  const std::string png = encoded_grey16_png("depth.png", {1, 3, {65535, 65534, 1000}});
  CHECK(read_depth(folder.write("camera.png", png)).metres == std::vector<float>{0, 65.534f, 1});
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
  CHECK(message("version https://git-lfs.github.com/spec/v1\n") ==
        name +
            "is neither a PNG nor a NumPy file, but a Git LFS pointer; get the file itself by 'git lfs pull'; expected "
            "depth as 16-bit PNG in millimetres or .npy in metres");
  CHECK(message(npy("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }", data)) ==
        name + "is a damaged NumPy file (its size is not that of its array); replace the file");
  CHECK(message(npy("{'descr': '<c8', 'fortran_order': False, 'shape': (1, 1), }", data)) ==
        name +
            "holds numbers of the NumPy type '<c8', expected depth as float16, float32, float64 or integers of 16 to "
            "64 bits");
  CHECK(message(npy("{'descr': '|u1', 'fortran_order': False, 'shape': (1, 8), }", data)) ==
        name +
            "holds numbers of the NumPy type '|u1', expected depth as float16, float32, float64 or integers of 16 to "
            "64 bits; 8 bits are too few for depth");
  CHECK(message("PK\3\4....") == name + "is a ZIP archive (.npz?), expected one array, by numpy.save");
  CHECK(message(npy("{'descr': '|i1', 'fortran_order': False, 'shape': (1, 8), }", data)) ==
        name +
            "holds numbers of the NumPy type '|i1', expected depth as float16, float32, float64 or integers of 16 to "
            "64 bits; 8 bits are too few for depth");
  for (const char* type : {"<f16", "=f4", "|f4"})
    CHECK_THAT(message(npy(joined("{'descr': '", type, "', 'fortran_order': False, 'shape': (1, 2), }"), data)),
               Catch::StartsWith(name + "holds numbers of the NumPy type '" + type + "', expected depth as "));
  CHECK_THAT(message(npy("{'fortran_order': False, 'shape': (1, 2), }", data)),
             Catch::StartsWith(name + "holds numbers of the NumPy type '', expected depth as "));
  CHECK(message(npy("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2), }", data + "x")) ==
        name + "is a damaged NumPy file (its size is not that of its array); replace the file");
  CHECK(message(npy("{'descr': '<f4', 'fortran_order': False, 'shape': (0, 3), }", "")) ==
        name + "has no pixels (3x0)");
  CHECK(message(npy("{'descr': '<f4', 'fortran_order': False, 'shape': (3, 0), }", "")) ==
        name + "has no pixels (0x3)");
  for (const char* shape : {"(a, 2)", "1, 2", "(1", "(-1, 2)"})
    CHECK(message(npy(std::string("{'descr': '<f4', 'fortran_order': False, 'shape': ") + shape + ", }", data)) ==
          name + "is a damaged NumPy file (its header names no shape); replace the file");
  for (const char* shape : {"(2,)", "(3, 2, 2)", "()"})
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
      name +
      "holds no distance between 0 and 100 m; integers are taken as millimetres and floats as metres, unless "
      "--depth-unit says otherwise";
  CHECK(numbers(812, 950) ==
        name + "its smallest distance is 812 m; is it in another unit? Millimetres are --depth-unit mm");
  CHECK(numbers(0, std::numeric_limits<float>::quiet_NaN()) == no_distance);
  write_png(folder.path() / "d", {1, 2, std::vector<std::uint8_t>(6)});
  CHECK(refusal(folder.path() / "d") == name + "is a PNG of another kind, expected 16-bit grey, depth in millimetres");
  const std::vector<std::uint8_t> grey(2);
  CHECK(message(encoded_grey_png("d", 1, 2, grey)) ==
        name + "is a PNG of another kind, expected 16-bit grey, depth in millimetres");
  write_depth_png(folder.path() / "d", {1, 2, {1, 2}});
  const std::string png = file_contents(folder.path() / "d");
  CHECK_THAT(message(png.substr(0, png.size() - 20)), Catch::Contains("is a damaged or incomplete PNG image"));
  CHECK(message(png.substr(0, 20)) ==
        name + "is a damaged or incomplete PNG image (the file ends too early); replace the file");
}

TEST_CASE("depth is read from every array that NumPy writes for it") {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& type, const std::string& shape, const std::string& data,
                        bool by_columns = false, std::optional<double> unit_m = {}) {
    const std::string order = by_columns ? "True" : "False";
    return read_depth(
        folder.write("d.npy",
                     npy("{'descr': '" + type + "', 'fortran_order': " + order + ", 'shape': " + shape + ", }", data)),
        unit_m);
  };
  const auto swapped = [](std::string data, std::size_t width) {
    for (std::size_t i = 0; i < data.size(); i += width)
      std::reverse(data.begin() + static_cast<std::ptrdiff_t>(i),
                   data.begin() + static_cast<std::ptrdiff_t>(i + width));
    return data;
  };
  const std::vector<float> metres{0.5f, 1, 1.5f, 2, 2.5f, 3};
  const std::string floats = bytes(metres);
  const auto integers = [&](auto zero) {
    std::vector<decltype(zero)> numbers;
    for (const float z : metres) numbers.push_back(static_cast<decltype(zero)>(1000 * z));
    return bytes(numbers);
  };
  for (const char* shape : {"(2, 3)", "(2, 3, 1)", "(1, 2, 3)", "(1, 2, 3, 1)", "(2L, 3L)"}) {
    CAPTURE(shape);
    CHECK(read("<f4", shape, floats).metres == metres);
    CHECK(read("<f4", shape, floats).width == 3);
  }
  for (const char version : {2, 3}) {
    const std::string file = npy("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }", floats, version);
    CHECK(read_depth(folder.write("d.npy", file)).metres == metres);
  }
  // By columns: of (2, 3) the array's second element in memory is the first of the second row.
  CHECK(read("<f4", "(2, 3)", bytes(std::vector<float>{0.5f, 2, 1, 2.5f, 1.5f, 3}), true).metres == metres);
  CHECK(read("<f4", "(2, 3, 1)", bytes(std::vector<float>{0.5f, 2, 1, 2.5f, 1.5f, 3}), true).metres == metres);
  CHECK(read(">f4", "(2, 3)", swapped(floats, 4)).metres == metres);
  CHECK(read(">f8", "(2, 3)", swapped(bytes(std::vector<double>(metres.begin(), metres.end())), 8)).metres == metres);
  CHECK(
      read("<f2", "(2, 3)", bytes(std::vector<std::uint16_t>{0x3800, 0x3c00, 0x3e00, 0x4000, 0x4100, 0x4200})).metres ==
      metres);
  // 0, infinity, NaN, -1, the smallest half
  CHECK(read("<f2", "(2, 3)", bytes(std::vector<std::uint16_t>{0, 0x7c00, 0x7e00, 0xbc00, 1, 0x3c00})).metres ==
        std::vector<float>{0, 0, 0, 0, 5.9604645e-8f, 1});
  CHECK(read("<u2", "(2, 3)", integers(std::uint16_t{})).metres == metres);
  CHECK(read(">u2", "(2, 3)", swapped(integers(std::uint16_t{}), 2)).metres == metres);
  CHECK(read("<i2", "(2, 3)", integers(std::int16_t{})).metres == metres);
  CHECK(read("<u4", "(2, 3)", integers(std::uint32_t{})).metres == metres);
  CHECK(read("<i4", "(2, 3)", integers(std::int32_t{})).metres == metres);
  CHECK(read("<i8", "(2, 3)", integers(std::int64_t{})).metres == metres);
  CHECK(read("<u8", "(2, 3)", integers(std::uint64_t{})).metres == metres);
  CHECK(read("<i4", "(1, 3)", bytes(std::vector<std::int32_t>{-5, 0, 700})).metres == std::vector<float>{0, 0, 0.7f});
  CHECK(read("<u2", "(1, 2)", bytes(std::vector<std::uint16_t>{65535, 700})).metres == std::vector<float>{0, 0.7f});
  // Given units
  CHECK(read("<u2", "(1, 2)", bytes(std::vector<std::uint16_t>{4000, 8000}), false, 0.00025).metres ==
        std::vector<float>{1, 2});
  CHECK(read("<f4", "(1, 2)", bytes(std::vector<float>{100, 150}), false, 0.01).metres == std::vector<float>{1, 1.5f});
  write_depth_png(folder.path() / "d.png", {1, 2, {5, 10}});
  CHECK(read_depth(folder.path() / "d.png", 0.0002).metres == std::vector<float>{1, 2});
}

TEST_CASE("units of depth have names") {
  CHECK(depth_unit_m("m") == 1);
  CHECK(depth_unit_m("cm") == 0.01);
  CHECK(depth_unit_m("mm") == 0.001);
  CHECK(depth_unit_m("0.25mm") == 0.00025);
  CHECK(depth_unit_m("0.2 mm") == Approx(0.0002));
  CHECK(depth_unit_m("100um") == Approx(0.0001));
  CHECK(depth_unit_m("0.001") == 0.001);
  CHECK(depth_unit_name(0.00025) == "0.25mm");
  CHECK(depth_unit_name(0.0005) == "0.0005 m");
  for (const char* wrong : {"", "inch", "mmm", "0", "-1", "1000", "nan", "1e-9", "0.25 furlongs"}) {
    CAPTURE(wrong);
    CHECK_THROWS_WITH(depth_unit_m(wrong), Catch::StartsWith("the unit of depth '"));
  }
}
