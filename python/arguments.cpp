#include "arguments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include "base/error.h"

namespace svnet::python {
using view::CameraPose;

namespace {

namespace py = pybind11;

/// Returns the result of `convert`, or nothing if it raises TypeError, ValueError or OverflowError: the value does not
/// fit. Other exceptions, such as a KeyboardInterrupt in an object's __array__, are not caught.
template <class Convert>
std::optional<std::invoke_result_t<Convert>> if_it_fits(const Convert& convert) {
  try {
    return convert();
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_TypeError) && !error.matches(PyExc_ValueError) && !error.matches(PyExc_OverflowError))
      throw;
    return std::nullopt;
  }
}

bool is_bfloat16(const py::object& given) {
  return py::hasattr(given, "dtype") && py::str(given.attr("dtype")).cast<std::string>().ends_with("bfloat16");
}

/// A torch tensor as one that NumPy can read: without gradients, in main memory, bfloat16 as float32. Others as they
/// are.
py::object readable_by_numpy(const py::object& given) {
  for (const char* method : {"detach", "cpu", "float"})
    if (!py::hasattr(given, method)) return given;
  const py::object tensor = given.attr("detach")().attr("cpu")();
  return is_bfloat16(tensor) ? py::object(tensor.attr("float")()) : tensor;
}

/// Converts to an array, of any dtype, strides and byte order. bfloat16, of which NumPy knows nothing, becomes float32.
py::array any_array(const char* function, const char* argument, const py::object& given, const char* expected) {
  const auto array = if_it_fits([&] {  // fails for rows of unequal length
    const py::array as_given(readable_by_numpy(given));
    return is_bfloat16(as_given) ? py::array(as_given.attr("astype")("float32")) : as_given;
  });
  check(array.has_value(), "[", function, "] ", argument, " is not an array; expects ", expected);
  return *array;
}

/// Whether the elements are strings: str or bytes of any length, as NumPy or pandas have them.
bool is_text(const py::array& array) {
  const char kind = array.dtype().kind();
  if (kind != 'O') return kind == 'U' || kind == 'S';
  const py::list items = array.attr("ravel")().attr("tolist")();
  return !items.empty() && std::ranges::all_of(items, [](py::handle item) { return py::isinstance<py::str>(item); });
}

/// The rank of each string among the different ones, in the order of Python.
py::array ranks_of(const py::array& texts) {
  const py::object numpy = py::module_::import("numpy");
  return numpy.attr("unique")(texts, py::arg("return_inverse") = true).cast<py::tuple>()[1].cast<py::array>();
}

std::string shape_text(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t axis = 0; axis < array.ndim(); ++axis)
    text += (axis > 0 ? ", " : "") + std::to_string(array.shape(axis));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

std::string dtype_text(const py::array& array) { return py::str(array.dtype()); }

bool is_integer(const py::array& array) {
  const char kind = array.dtype().kind();
  return kind == 'i' || kind == 'u' || kind == 'b';
}

void check_numbers(const char* function, const char* argument, const py::array& array,
                   const char* expected = "integers or floats") {
  check(is_integer(array) || array.dtype().kind() == 'f', "[", function, "] ", argument, " has dtype ",
        dtype_text(array), "; expects ", expected);
}

/// `subject`: the first words of the message, such as "images have".
void check_pixels(const char* function, const char* subject, const py::array& array) {
  check(array.dtype().kind() == 'u' && array.itemsize() == 1, "[", function, "] ", subject, " dtype ",
        dtype_text(array), "; expects uint8, grey levels from 0 to 255, not yet preprocessed");
}

/// Whether float32 can hold every value of the dtype.
bool fits_float(const py::array& array) { return array.itemsize() <= (is_integer(array) ? 2 : 4); }

/// Encodes as UTF-8; lone surrogates are written as \udcff.
std::string utf8(const py::str& text) {
  PyObject* bytes = PyUnicode_AsEncodedString(text.ptr(), "utf-8", "backslashreplace");
  if (bytes == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::bytes>(bytes);
}

/// At most 60 characters of repr, on one line.
std::string repr(const py::object& given) {
  constexpr py::ssize_t kLongest = 60;
  const auto text = if_it_fits([&] { return py::repr(given); });  // fails for an int of more than 4300 digits
  if (!text) return joined("<unprintable ", Py_TYPE(given.ptr())->tp_name, " object>");
  std::string shown = utf8((*text)[py::slice(0, kLongest, 1)]);
  std::ranges::replace(shown, '\n', ' ');
  return py::len(*text) <= kLongest ? shown : shown + "...";
}

/// Labels as int64, from integers or floats.
Array<std::int64_t> whole_labels(const char* function, const char* argument, const py::array& array) {
  const auto place = [&](py::ssize_t i) {
    const py::ssize_t columns = array.ndim() == 2 ? array.shape(1) : 0;
    return columns > 0 ? joined("[", i / columns, ", ", i % columns, "]") : joined("[", i, "]");
  };
  if (array.dtype().kind() == 'f') {
    const Array<double> values(array);
    for (py::ssize_t i = 0; i < values.size(); ++i) {
      const double value = values.data()[i];
      check(std::abs(value) <= 0x1p53 && value == std::trunc(value), "[", function, "] ", argument, place(i), " is ",
            value, "; expects whole numbers");
    }
  } else if (array.dtype().kind() == 'u' && array.itemsize() == 8) {
    const Array<std::uint64_t> values(array);
    for (py::ssize_t i = 0; i < values.size(); ++i)
      check(values.data()[i] <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()), "[", function,
            "] ", argument, place(i), " is ", values.data()[i], ", beyond int64");
  }
  return Array<std::int64_t>(array);
}

}  // namespace

GivenFeatures::GivenFeatures(const char* function, const py::object& given) {
  const py::array array = any_array(function, "features", given, "numbers (N, D)");
  check_numbers(function, "features", array);
  check(array.ndim() == 2 && array.size() > 0, "[", function, "] features have shape ", shape_text(array),
        "; expects (N, D), one row per item, and at least one");
  rows_ = array.shape(0);
  columns_ = array.shape(1);
  if (fits_float(array))
    values_ = Array<float>(array);
  else
    values_ = Array<double>(array);
}

semantics::DistanceMatrix GivenFeatures::squared_distances(Parallel& parallel) const {
  return std::visit(
      [&](const auto& values) { return semantics::squared_distances(values.data(), rows_, columns_, parallel); },
      values_);
}

GivenLabels::GivenLabels(const char* function, const char* argument, const py::object& given) {
  py::array array = any_array(function, argument, given, "integers or strings (N)");
  const bool text = is_text(array);
  if (!text) check_numbers(function, argument, array, "integers, floats or strings");
  check(array.ndim() == 1, "[", function, "] ", argument, " has shape ", shape_text(array), "; expects (N,)");
  values_ = whole_labels(function, argument, text ? ranks_of(array) : array);
}

GivenLabellings::GivenLabellings(const char* function, const py::object& given) {
  const py::array array = any_array(function, "labels", given, "whole numbers (L, N)");
  check_numbers(function, "labels", array);
  check(array.ndim() == 2 && array.size() > 0, "[", function, "] labels have shape ", shape_text(array),
        "; expects (L, N), one row per labelling of all items, and at least one");
  values_ = whole_labels(function, "labels", array);
}

Array<std::uint8_t> images(const char* function, const py::object& given) {
  const py::array array = any_array(function, "images", given, "uint8 (N, H, W, 3)");
  check_pixels(function, "images have", array);
  check(array.ndim() == 4 && array.shape(3) == 3, "[", function, "] images have shape ", shape_text(array),
        "; expects (N, H, W, 3), RGB", array.ndim() == 3 ? "; for one image pass image[None]" : "");
  return Array<std::uint8_t>(array);
}

Image image(const char* function, const py::object& given) {
  const py::array array = any_array(function, "image", given, "uint8 (H, W, 3)");
  check_pixels(function, "image has", array);
  check(array.ndim() == 3 && array.shape(2) == 3, "[", function, "] image has shape ", shape_text(array),
        "; expects (H, W, 3), RGB", array.ndim() == 4 ? "; pass one image at a time" : "");
  check(array.size() > 0, "[", function, "] image has shape ", shape_text(array), ", no pixels");
  const Array<std::uint8_t> pixels(array);
  return {pixels.shape(0), pixels.shape(1), {pixels.data(), pixels.data() + pixels.size()}};
}

DepthImage depth_image(const char* function, const py::object& given, Index height, Index width) {
  const py::array array = any_array(function, "depth", given, "numbers (H, W)");
  check_numbers(function, "depth", array);
  check(array.ndim() == 2 && array.shape(0) == height && array.shape(1) == width, "[", function, "] depth has shape ",
        shape_text(array), "; expects (", height, ", ", width, "), that of the image, in metres");
  const Array<float> metres(array);
  DepthImage depth{height, width, {metres.data(), metres.data() + metres.size()}};
  for (float& value : depth.metres)
    if (!std::isfinite(value) || value < 0) value = 0;
  return depth;
}

std::vector<CameraPose> camera_poses(const char* function, const py::object& given) {
  const py::array array = any_array(function, "angles_deg", given, "numbers (M, 2)");
  check_numbers(function, "angles_deg", array);
  check(array.ndim() == 2 && array.shape(1) == 2 && array.size() > 0, "[", function, "] angles_deg has shape ",
        shape_text(array), "; expects (M, 2), theta and phi of each pose in degrees, and at least one");
  const Array<double> angles(array);
  std::vector<CameraPose> poses;
  poses.reserve(angles.shape(0));
  for (py::ssize_t i = 0; i < angles.shape(0); ++i) {
    poses.push_back({angles.at(i, 0), angles.at(i, 1)});
    const std::string problem = pose_problem(poses.back());
    check(problem.empty(), "[", function, "] angles_deg[", i, "]: ", problem);
    poses.back() = clamped_pose(poses.back());
  }
  return poses;
}

double number(const char* function, const char* argument, const py::object& given) {
  const py::array array = any_array(function, argument, given, "a number");
  check_numbers(function, argument, array);
  check(array.ndim() == 0, "[", function, "] ", argument, " has shape ", shape_text(array), "; expects a number");
  return *Array<double>(array).data();
}

std::array<double, 3> point(const char* function, const char* argument, const py::object& given) {
  const py::array array = any_array(function, argument, given, "numbers (3)");
  check_numbers(function, argument, array);
  check(array.ndim() == 1 && array.size() == 3, "[", function, "] ", argument, " has shape ", shape_text(array),
        "; expects (3,)");
  const Array<double> values(array);
  return {values.at(0), values.at(1), values.at(2)};
}

std::uint64_t whole_number(const char* function, const char* argument, const py::object& given, std::uint64_t lowest,
                           std::uint64_t highest) {
  const auto value = if_it_fits([&]() -> std::uint64_t {
    const auto integer = py::reinterpret_steal<py::object>(PyNumber_Index(given.ptr()));
    if (!integer) throw py::error_already_set();
    const std::uint64_t number = PyLong_AsUnsignedLongLong(integer.ptr());
    if (PyErr_Occurred() != nullptr) throw py::error_already_set();
    return number;
  });
  if (!value || *value < lowest || *value > highest)
    fail("[", function, "] ", argument, " is ", repr(given), "; expects a whole number from ", lowest, " to ",
         highest == ~std::uint64_t{0} ? "2^64 - 1" : std::to_string(highest));
  return *value;
}

Index count_of(const char* function, const char* argument, const py::object& given, std::uint64_t lowest) {
  const std::uint64_t value = whole_number(function, argument, given, lowest);
  check(value <= static_cast<std::uint64_t>(std::numeric_limits<Index>::max()), "[", function, "] ", argument, " is ",
        value, ", beyond 2^63 - 1");
  return value;
}

std::string text(const char* function, const char* argument, const py::object& given, const char* expected) {
  check(py::isinstance<py::str>(given), "[", function, "] ", argument, " is no str; expects ", expected);
  return utf8(given);
}

std::string path(const char* function, const char* argument, const py::object& given) {
  const auto encoded = if_it_fits([&]() -> std::string {
    PyObject* bytes = nullptr;
    if (PyUnicode_FSConverter(given.ptr(), &bytes) == 0) throw py::error_already_set();
    return py::reinterpret_steal<py::bytes>(bytes);
  });
  if (!encoded) fail("[", function, "] ", argument, " is ", repr(given), "; expects a path");
  return *encoded;
}

py::array_t<std::int64_t> label_array(std::span<const std::int32_t> labels) {
  py::array_t<std::int64_t> array(labels.size());
  std::copy(labels.begin(), labels.end(), array.mutable_data());
  return array;
}

}  // namespace svnet::python
