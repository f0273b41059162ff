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
#include "image/image.h"
#include "semantics/distances.h"
#include "view/camera_pose.h"

// From what a caller in Python passes to what the library takes. `function` and `argument` are for messages alone.
// All of these need the GIL.
namespace svnet::python {

template <class T>
using Array = pybind11::array_t<T, pybind11::array::c_style | pybind11::array::forcecast>;

/// Features (N, D) as contiguous float32, or as float64 where float32 might lose digits.
class GivenFeatures {
 public:
  /// Any array-like (N, D) of integers or floats. Throws Error for anything else.
  GivenFeatures(const char* function, const pybind11::object& given);

  Index rows() const { return rows_; }
  Index columns() const { return columns_; }
  /// Needs no GIL.
  DistanceMatrix squared_distances(Parallel& parallel) const;

 private:
  std::variant<Array<float>, Array<double>> values_;
  Index rows_, columns_;
};

/// Numbers of groups (N), from any array-like of integers, or of floats that are whole. Throws Error for anything else.
class GivenLabels {
 public:
  GivenLabels(const char* function, const char* argument, const pybind11::object& given);

  std::span<const std::int64_t> values() const { return std::span(values_.data(), values_.size()); }

 private:
  Array<std::int64_t> values_;
};

/// Pictures (N, H, W, 3) of uint8. Throws Error for anything else.
Array<std::uint8_t> images(const char* function, const pybind11::object& given);

/// A copy of a picture (H, W, 3) of uint8, of at least one pixel. Throws Error for anything else.
Image image(const char* function, const pybind11::object& given);

/// Poses (M, 2), theta and phi in degrees, from any array-like of integers or floats; at least one, all in range.
/// Throws Error for anything else, with the number of the pose.
std::vector<CameraPose> camera_poses(const char* function, const pybind11::object& given);

/// A Python or NumPy integer or float. Throws Error for anything else.
double number(const char* function, const char* argument, const pybind11::object& given);

/// Three of them, from any array-like (3,). Throws Error for anything else.
std::array<double, 3> point(const char* function, const char* argument, const pybind11::object& given);

/// A Python or NumPy integer in [lowest, 2^64). Throws Error for anything else.
std::uint64_t whole_number(const char* function, const char* argument, const pybind11::object& given,
                           std::uint64_t lowest = 0, std::uint64_t highest = ~std::uint64_t{0});
/// The same in [lowest, 2^63).
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

/// A str, as UTF-8; lone surrogates are written as \udcff. Throws Error for anything else.
std::string text(const char* function, const char* argument, const pybind11::object& given, const char* expected);

/// A path given as str, bytes or os.PathLike. Throws Error for anything else.
std::string path(const char* function, const char* argument, const pybind11::object& given);

/// A new array of the numbers, int64.
pybind11::array_t<std::int64_t> label_array(std::span<const std::int32_t> labels);

template <class T>
pybind11::array_t<T> array_of(std::span<const T> values) {
  return pybind11::array_t<T>(values.size(), values.data());
}

}  // namespace svnet::python
