#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
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

constexpr const char* kBestViewsDoc = R"(best_views(self, image, angles_deg, k, min_angle_deg=0, depth=None)
--

Up to k camera poses to take together, chosen one after the other: the best first, then each time the one with the highest
score + s * min(a, 90) / 90, where a is the angle in degrees to the nearest pose that was chosen and s the standard
deviation of all scores.

image, angles_deg, depth : as for score
k : integer >= 1
min_angle_deg : the least angle between the viewing directions of two chosen poses, along the great circle, in [0, 180]
    degrees; up to 1e-4 degrees less count as enough
Returns (indices, scores): (F,) int64 and (F,) float32, in the order of the choice; F < k if no other pose differs enough.
Raises svnet.Error as score does, and for a k or an angle that is out of range.
)";

constexpr const char* kMarginDoc = R"(margin(self, image, angles_deg, depth=None)
--

How much the best of the given camera poses is better than looking from above: the highest score minus the score of
(90, 90), which need not be one of them; negative if the top view is better than all.

image, angles_deg, depth : as for score
Raises svnet.Error as score does.
)";

constexpr const char* kGainDoc = R"(gain(self, image, angles_deg, depth=None)
--

What moving the camera from above to the best of the given poses is expected to gain, as semantic score (0 to 1), for
objects of categories that the model has not seen.

image, angles_deg, depth : as for score
Returns a dict of floats: expected; low and high, between which four of five gains are; probability, that the gain is
above 0.
Raises svnet.Error as score does, and if the model does not know: models of the frame camera, and of earlier versions.
)";

constexpr const char* kNextViewDoc = R"(next_view(self, image, taken, angles_deg, min_angle_deg=0, depth=None)
--

Which of the given camera poses to view next, when views of the object were taken.

image : (H, W, 3) uint8, RGB, the object from above
taken : list of (theta, phi, picture), at least one: the pose of each view that was taken, in degrees, and its picture,
    (h, w, 3) uint8, RGB. The top view counts only if it is in the list
angles_deg, depth : as for score
min_angle_deg : the least angle between the pose and each taken one, in [0, 180] degrees
Returns (index, scores): the index (int) of the pose with the highest score among those that differ from the taken ones,
None if none differs enough; and (M,) float32, the scores of all: about 1/2 plus what the view and a taken view tell
together, more than the other candidates would.
Raises svnet.Error as score does, and if the model does not know (knows_next_view): it must be trained with
sv_net.next_view: ridge.
)";

/// Camera poses of one call, and their scores.
struct ScoredPoses {
  std::vector<view::CameraPose> poses;
  std::vector<float> scores;
  float top_score = 0;
};

ScoredPoses scored(const Predictor& self, const char* function, const py::object& given_image,
                   const py::object& given_angles, const py::object& given_depth) {
  const Image top = image(function, given_image);
  std::optional<DepthImage> depth;
  if (!given_depth.is_none()) depth = depth_image(function, given_depth, top.height, top.width);
  ScoredPoses result{camera_poses(function, given_angles), {}};
  const Computing computing;
  std::vector<float> features(static_cast<std::size_t>(self.feature_count()));
  predict::Workspace workspace;
  self.embed(top, depth ? &*depth : nullptr, features, workspace);
  const std::span<const view::CameraPose> poses = result.poses;
  result.scores.resize(poses.size());
  for (std::size_t first = 0; first < poses.size(); first += kPosesAtOnce) {
    const std::size_t count = std::min(kPosesAtOnce, poses.size() - first);
    self.scores(features, poses.subspan(first, count), std::span(result.scores).subspan(first, count), workspace);
    let_python_interrupt();
  }
  self.scores(features, std::span(&view::kTopView, 1), std::span(&result.top_score, 1), workspace);
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
  return array_of(std::span<const float>(scored(self.predictor, "Model.score", image, angles_deg, depth).scores));
}

py::tuple best_view_of(const LoadedModel& self, const py::object& image, const py::object& angles_deg,
                       const py::object& depth) {
  const std::vector<float> values = scored(self.predictor, "Model.best_view", image, angles_deg, depth).scores;
  return py::make_tuple(predict::best_view(values), array_of(std::span<const float>(values)));
}

py::tuple best_views_of(const LoadedModel& self, const py::object& image, const py::object& angles_deg,
                        const py::object& k, const py::object& min_angle_deg, const py::object& depth) {
  constexpr const char* kName = "Model.best_views";
  const std::uint64_t most = whole_number(kName, "k", k, 1, std::numeric_limits<std::int64_t>::max());
  const double angle_deg = number(kName, "min_angle_deg", min_angle_deg);
  const ScoredPoses all = scored(self.predictor, kName, image, angles_deg, depth);
  std::vector<std::size_t> chosen(std::min<std::size_t>(most, all.poses.size()));
  chosen.resize(predict::best_views(all.scores, all.poses, angle_deg, chosen));
  std::vector<float> scores;
  for (const std::size_t i : chosen) scores.push_back(all.scores[i]);
  const std::vector<std::int64_t> indices(chosen.begin(), chosen.end());
  return py::make_tuple(array_of(std::span<const std::int64_t>(indices)), array_of(std::span<const float>(scores)));
}

float margin_of(const LoadedModel& self, const py::object& image, const py::object& angles_deg,
                const py::object& depth) {
  const ScoredPoses all = scored(self.predictor, "Model.margin", image, angles_deg, depth);
  return all.scores[predict::best_view(all.scores)] - all.top_score;
}

py::dict gain_of(const LoadedModel& self, const py::object& image, const py::object& angles_deg,
                 const py::object& depth) {
  const ScoredPoses all = scored(self.predictor, "Model.gain", image, angles_deg, depth);
  const predict::Gain gain = self.predictor.gain(static_cast<double>(all.scores[predict::best_view(all.scores)]),
                                                 static_cast<double>(all.top_score));
  py::dict result;
  result["expected"] = gain.expected;
  result["low"] = gain.low;
  result["high"] = gain.high;
  result["probability"] = gain.probability;
  return result;
}

/// The views that were taken, from a list of (theta, phi, picture).
std::vector<frame::TakenView> taken_views(const char* function, const py::object& given) {
  check(py::isinstance<py::sequence>(given) && !py::isinstance<py::str>(given), "[", function,
        "] taken is no list of (theta, phi, picture)");
  const auto views = py::reinterpret_borrow<py::sequence>(given);
  check(!views.empty(), "[", function, "] taken is empty, no view was taken; the best first one is best_view's");
  std::vector<frame::TakenView> taken;
  for (const py::handle item : views) {
    check(py::isinstance<py::sequence>(item) && py::len(item) == 3, "[", function, "] taken[", taken.size(),
          "] is not (theta, phi, picture)");
    const auto view = py::reinterpret_borrow<py::sequence>(item);
    const view::CameraPose pose{number(function, "theta", py::object(view[0])),
                                number(function, "phi", py::object(view[1]))};
    const Image picture = image(function, py::object(view[2]));
    const Computing computing;
    taken.push_back({pose, frame::view_shape(picture)});
  }
  return taken;
}

py::tuple next_view_of(const LoadedModel& self, const py::object& given_image, const py::object& given_taken,
                       const py::object& angles_deg, const py::object& min_angle_deg, const py::object& given_depth) {
  constexpr const char* kName = "Model.next_view";
  const Predictor& predictor = self.predictor;
  const Image top = image(kName, given_image);
  std::optional<DepthImage> depth;
  if (!given_depth.is_none()) depth = depth_image(kName, given_depth, top.height, top.width);
  const double angle_deg = number(kName, "min_angle_deg", min_angle_deg);
  const std::vector<view::CameraPose> poses = camera_poses(kName, angles_deg);
  const std::vector<frame::TakenView> taken = taken_views(kName, given_taken);
  std::vector<float> scores;
  std::optional<std::size_t> next;
  {
    const Computing computing;
    scores = predictor.next_scores(predictor.embed(top, depth ? &*depth : nullptr), taken, poses);
    next = predict::next_view(scores, poses, taken, angle_deg);
  }
  return py::make_tuple(next ? py::object(py::int_(*next)) : py::none(), array_of(std::span<const float>(scores)));
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
      .def("best_views", best_views_of, kBestViewsDoc, py::arg("image"), py::arg("angles_deg"), py::arg("k"),
           py::arg("min_angle_deg") = 0, py::arg("depth") = py::none())
      .def("margin", margin_of, kMarginDoc, py::arg("image"), py::arg("angles_deg"), py::arg("depth") = py::none())
      .def("gain", gain_of, kGainDoc, py::arg("image"), py::arg("angles_deg"), py::arg("depth") = py::none())
      .def("next_view", next_view_of, kNextViewDoc, py::arg("image"), py::arg("taken"), py::arg("angles_deg"),
           py::arg("min_angle_deg") = 0, py::arg("depth") = py::none())
      .def_property_readonly(
          "knows_next_view", [](const LoadedModel& self) { return self.predictor.knows_next_view(); },
          "Whether next_view knows: the model was trained with sv_net.next_view.")
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
