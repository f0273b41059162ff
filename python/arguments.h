#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "base/enum_names.h"
#include "base/index.h"
#include "base/text.h"
#include "image/depth_image.h"
#include "image/image.h"
#include "semantics/distances.h"
#include "view/camera_pose.h"

// Converts the arguments of a Python caller to the types of the library. `function` and `argument` are for messages.
// All of these throw Error for a value that does not fit, and require the GIL.
namespace svnet::python {

template <class T>
using Array = pybind11::array_t<T, pybind11::array::c_style | pybind11::array::forcecast>;

/// Features (N, D) as contiguous float32, or as float64 if float32 cannot hold every value of the dtype.
class GivenFeatures {
 public:
  /// Takes any array-like (N, D) of integers or floats.
  GivenFeatures(const char* function, const pybind11::object& given);

  Index rows() const { return rows_; }
  Index columns() const { return columns_; }
  /// Does not require the GIL.
  semantics::DistanceMatrix squared_distances(Parallel& parallel) const;

 private:
  std::variant<Array<float>, Array<double>> values_;
  Index rows_, columns_;
};

/// Labels (N), from any array-like of integers, of floats that are whole, or of strings, whose order decides.
class GivenLabels {
 public:
  GivenLabels(const char* function, const char* argument, const pybind11::object& given);

  std::span<const std::int64_t> values() const { return std::span(values_.data(), values_.size()); }

 private:
  Array<std::int64_t> values_;
};

/// Labellings (L, N) of the same items, from any array-like of integers or of floats that are whole; at least one.
class GivenLabellings {
 public:
  GivenLabellings(const char* function, const pybind11::object& given);

  std::span<const std::int64_t> values() const { return std::span(values_.data(), values_.size()); }
  Index items() const { return values_.shape(1); }

 private:
  Array<std::int64_t> values_;
};

/// Images (N, H, W, 3) of uint8.
Array<std::uint8_t> images(const char* function, const pybind11::object& given);

/// A copy of an image (H, W, 3) of uint8 with at least one pixel.
Image image(const char* function, const pybind11::object& given);

/// A copy of a depth image, from any array-like (height, width) of floats or integers in metres; what is not a positive
/// number is not measured.
DepthImage depth_image(const char* function, const pybind11::object& given, Index height, Index width);

/// Camera poses, from any array-like (M, 2) of integers or floats: theta and phi in degrees, all in range; M >= 1. The
/// message says the index of a wrong pose.
std::vector<view::CameraPose> camera_poses(const char* function, const pybind11::object& given);

/// A Python or NumPy integer or float.
double number(const char* function, const char* argument, const pybind11::object& given);

/// A point, from any array-like (3,) of integers or floats.
std::array<double, 3> point(const char* function, const char* argument, const pybind11::object& given);

/// A Python or NumPy integer in [lowest, highest].
std::uint64_t whole_number(const char* function, const char* argument, const pybind11::object& given,
                           std::uint64_t lowest = 0, std::uint64_t highest = ~std::uint64_t{0});
/// A Python or NumPy integer in [lowest, 2^63).
Index count_of(const char* function, const char* argument, const pybind11::object& given, std::uint64_t lowest = 1);

/// The names of an enum as messages list them: "a", "b" or "c", in quotes.
template <class Enum>
std::string quoted_names() {
  std::vector<std::string> names = names_of<Enum>();
  for (std::string& name : names) name = '"' + name + '"';
  const std::string last = names.back();
  names.pop_back();
  return joined_with(", ", names) + " or " + last;
}

/// A str as UTF-8; lone surrogates are written as \udcff. `expected`: for the message.
std::string text(const char* function, const char* argument, const pybind11::object& given, const char* expected);

/// A path, from str, bytes or os.PathLike.
std::string path(const char* function, const char* argument, const pybind11::object& given);

/// A new int64 array of the labels.
pybind11::array_t<std::int64_t> label_array(std::span<const std::int32_t> labels);

template <class T>
pybind11::array_t<T> array_of(std::span<const T> values) {
  return pybind11::array_t<T>(values.size(), values.data());
}

}  // namespace svnet::python
