#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>

#include "arguments.h"
#include "base/error.h"
#include "bindings.h"
#include "computing.h"
#include "io/models/model_file.h"
#include "predict/predictor.h"

namespace svnet::python {
using predict::Predictor;

namespace {

namespace py = pybind11;

/// Poses that are scored between two checks for signals.
constexpr std::size_t kPosesAtOnce = 1024;

constexpr const char* kClassDoc =
    R"(A trained SV-net with its backbone: predicts the semantic scores of camera poses from a top image.

Made by Model.load. Threads may share one. pickle and copy.deepcopy store the contents of its file, so that processes
that do not share the file system can have it.
)";

constexpr const char* kLoadDoc = R"(load(path)
--

Reads a model file that svnet-train wrote (model.safetensors).

path : str, bytes or os.PathLike
Raises svnet.Error for a file that cannot be read, is truncated, has a damaged header, holds weights that are not
finite, or is not a model.
)";

constexpr const char* kScoreDoc = R"(score(self, image, angles_deg, depth=None)
--

Predicts how informative the view from each camera pose is.

Parameters
----------
image : (H, W, 3) uint8, RGB, the object from above; any size and strides, not preprocessed
angles_deg : (M, 2) integers or floats, M >= 1: azimuth theta in [-360, 720] (a full turn changes nothing) and elevation
    phi in [0, 90] of each camera pose, in degrees; (90, 90) is the top view. An angle that is out of
    range by at most 1e-4 degrees, by rounding, is taken for the bound
depth : (H, W) floats or integers, optional: the depth of the top view in metres along the camera's axis; 0 and NaN mean
    not measured. A model that was trained with depth (uses_depth) needs it, others ignore it

Returns
-------
scores : (M,) float32 in [0, 1], in the order of the poses; higher is more informative

Raises
------
svnet.Error for another dtype or shape, for an image without pixels, and for angles that are out of range or not
finite.
)";

constexpr const char* kBestViewDoc = R"(best_view(self, image, angles_deg, depth=None)
--

The most informative of the given camera poses.

image, angles_deg, depth : as for score
Returns (index, scores): the index (int) of the pose with the highest score, the first one in a tie; and the scores, as
score returns them.
Raises svnet.Error as score does.
)";

std::vector<float> scores(const Predictor& self, const char* function, const py::object& given_image,
                          const py::object& given_angles, const py::object& given_depth) {
  const Image top = image(function, given_image);
  std::optional<DepthImage> depth;
  if (!given_depth.is_none()) depth = depth_image(function, given_depth, top.height, top.width);
  const std::vector<view::CameraPose> poses = camera_poses(function, given_angles);
  const Computing computing;
  const Tensor features = self.embed(top, depth ? &*depth : nullptr);
  std::vector<float> result;
  result.reserve(poses.size());
  for (std::size_t first = 0; first < poses.size(); first += kPosesAtOnce) {
    const std::size_t count = std::min(kPosesAtOnce, poses.size() - first);
    std::ranges::copy(self.scores(features, std::span(poses).subspan(first, count)), std::back_inserter(result));
    let_python_interrupt();
  }
  return result;
}

/// A model and the contents of its file, which are what pickle stores.
struct LoadedModel {
  std::string contents;
  Predictor predictor;
};

std::unique_ptr<LoadedModel> model_of(const std::string& name, std::string contents) {
  const Model model = io::parse_model(name, std::as_bytes(std::span(contents)));
  return std::unique_ptr<LoadedModel>(
      new LoadedModel{std::move(contents), Predictor(model, inference_options_from_environment())});
}

std::unique_ptr<LoadedModel> load(const py::object& given) {
  const std::string file = path("Model.load", "path", given);
  const Computing computing;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) static_cast<void>(io::read_model(file));  // throws what is wrong
  std::ifstream stream(file, std::ios::binary);
  std::string contents{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) static_cast<void>(io::read_model(file));
  return model_of(file, std::move(contents));
}

/// For pickle, whose bytes may come from anywhere: they are checked like a file.
std::unique_ptr<LoadedModel> from_bytes(const py::bytes& given) {
  std::string contents = given;
  const Computing computing;
  return model_of("pickled model", std::move(contents));
}

/// pickle finds the function by its name in the package.
py::tuple reduced(const LoadedModel& self) {
  return py::make_tuple(py::module_::import("svnet").attr("_model_from_bytes"),
                        py::make_tuple(py::bytes(self.contents)));
}

py::array_t<float> score(const LoadedModel& self, const py::object& image, const py::object& angles_deg,
                         const py::object& depth) {
  return array_of(std::span<const float>(scores(self.predictor, "Model.score", image, angles_deg, depth)));
}

py::tuple best_view_of(const LoadedModel& self, const py::object& image, const py::object& angles_deg,
                       const py::object& depth) {
  const std::vector<float> values = scores(self.predictor, "Model.best_view", image, angles_deg, depth);
  return py::make_tuple(predict::best_view(values), array_of(std::span<const float>(values)));
}

/// Makes Model.__new__ raise TypeError: pybind11's own would make an instance without a model, and methods would
/// use memory that holds none.
void refuse_new(PyHeapTypeObject* type) {
  type->ht_type.tp_new = [](PyTypeObject*, PyObject*, PyObject*) -> PyObject* {
    PyErr_SetString(PyExc_TypeError, "svnet.Model is made by svnet.Model.load(path)");
    return nullptr;
  };
}

}  // namespace

void bind_model(py::module_& module) {
  py::class_<LoadedModel>(module, "Model", kClassDoc, py::custom_type_setup(refuse_new))
      .def_static("load", load, kLoadDoc, py::arg("path"))
      .def("score", score, kScoreDoc, py::arg("image"), py::arg("angles_deg"), py::arg("depth") = py::none())
      .def("best_view", best_view_of, kBestViewDoc, py::arg("image"), py::arg("angles_deg"),
           py::arg("depth") = py::none())
      .def_property_readonly(
          "uses_depth", [](const LoadedModel& self) { return self.predictor.uses_depth(); },
          "Whether the model was trained with the depth of top views, and needs it.")
      .def_static("_from_bytes", from_bytes)
      .def("__reduce__", reduced)
      .def("__repr__", [](const LoadedModel& self) {
        return joined("<svnet.Model, ", self.predictor.feature_count(), " features of an image>");
      });
}

}  // namespace svnet::python
