#include <algorithm>

#include "arguments.h"
#include "base/error.h"
#include "bindings.h"
#include "computing.h"
#include "predict/predictor.h"

namespace svnet::python {
namespace {

namespace py = pybind11;

/// Poses that are scored between two checks for signals.
constexpr std::size_t kPosesAtOnce = 1024;

constexpr const char* kClassDoc =
    R"(A trained SV-net with its backbone: predicts the semantic scores of camera poses from a top image.

Made by Model.load. Threads may share one.
)";

constexpr const char* kLoadDoc = R"(load(path)
--

Reads a model file that svnet-train wrote (model.safetensors).

path : str, bytes or os.PathLike
Raises svnet.Error for a file that cannot be read, is truncated, has a damaged header, holds weights that are not
finite, or is not a model.
)";

constexpr const char* kScoreDoc = R"(score(self, image, angles_deg)
--

Predicts how informative the view from each camera pose is.

Parameters
----------
image : (H, W, 3) uint8, RGB, the object from above; any size and strides, not preprocessed
angles_deg : (M, 2) integers or floats, M >= 1: azimuth theta in [-360, 720] (a full turn changes nothing) and elevation
    phi in [0, 90] of each camera pose, in degrees, up to rounding (1e-4); (90, 90) is the top view

Returns
-------
scores : (M,) float32 in [0, 1], in the order of the poses; higher is more informative

Raises
------
svnet.Error for another dtype or shape, for an image without pixels, and for angles that are out of range or not
finite.
)";

constexpr const char* kBestViewDoc = R"(best_view(self, image, angles_deg)
--

The most informative of the given camera poses.

image, angles_deg : as for score
Returns (index, scores): the index (int) of the pose with the highest score, the first one in a tie; and the scores, as
score returns them.
Raises svnet.Error as score does.
)";

std::vector<float> scores(const Predictor& self, const char* function, const py::object& given_image,
                          const py::object& given_angles) {
  const Image top = image(function, given_image);
  const std::vector<CameraPose> poses = camera_poses(function, given_angles);
  const Computing computing;
  const Tensor features = self.embed(top);
  std::vector<float> result;
  result.reserve(poses.size());
  for (std::size_t first = 0; first < poses.size(); first += kPosesAtOnce) {
    const std::size_t count = std::min(kPosesAtOnce, poses.size() - first);
    std::ranges::copy(self.scores(features, std::span(poses).subspan(first, count)), std::back_inserter(result));
    let_python_interrupt();
  }
  return result;
}

std::unique_ptr<Predictor> load(const py::object& given) {
  const std::string file = path("Model.load", "path", given);
  const Computing computing;
  return std::make_unique<Predictor>(std::filesystem::path(file), inference_options_from_environment());
}

py::array_t<float> score(const Predictor& self, const py::object& image, const py::object& angles_deg) {
  return array_of(std::span<const float>(scores(self, "Model.score", image, angles_deg)));
}

py::tuple best_view_of(const Predictor& self, const py::object& image, const py::object& angles_deg) {
  const std::vector<float> values = scores(self, "Model.best_view", image, angles_deg);
  return py::make_tuple(best_view(values), array_of(std::span<const float>(values)));
}

/// Makes Model.__new__ raise TypeError: pybind11's own would make an instance without a Predictor, and methods would
/// use memory that holds none.
void refuse_new(PyHeapTypeObject* type) {
  type->ht_type.tp_new = [](PyTypeObject*, PyObject*, PyObject*) -> PyObject* {
    PyErr_SetString(PyExc_TypeError, "svnet.Model is made by svnet.Model.load(path)");
    return nullptr;
  };
}

}  // namespace

void bind_model(py::module_& module) {
  py::class_<Predictor>(module, "Model", kClassDoc, py::custom_type_setup(refuse_new))
      .def_static("load", load, kLoadDoc, py::arg("path"))
      .def("score", score, kScoreDoc, py::arg("image"), py::arg("angles_deg"))
      .def("best_view", best_view_of, kBestViewDoc, py::arg("image"), py::arg("angles_deg"))
      .def("__repr__", [](const Predictor& self) {
        return joined("<svnet.Model, ", self.feature_count(), " features of an image>");
      });
}

}  // namespace svnet::python
