#include <set>

#include "arguments.h"
#include "base/error.h"
#include "base/text.h"
#include "bindings.h"
#include "computing.h"
#include "semantics/semantic_scores.h"

namespace svnet::python {
using semantics::ScoreOptions;
using semantics::ScoreSums;
using semantics::Singletons;

namespace {

namespace py = pybind11;

Singletons singletons_named(const py::object& given) {
  const std::string name = text("semantic_scores", "singletons", given, quoted_names<Singletons>().c_str());
  const auto found = find_enum<Singletons>(name);
  check(found.has_value(), "[semantic_scores] there is no treatment of singletons '", name, "'",
        suggestion(name, names_of<Singletons>()));
  return *found;
}

ScoreOptions options_from(const py::object& problems, const py::object& min_samples, const py::object& seed,
                          const py::object& singletons) {
  check(!problems.is_none() || !min_samples.is_none(),
        "[semantic_scores] nothing says when to stop; give problems or min_samples");
  ScoreOptions options{.seed = whole_number("semantic_scores", "seed", seed),
                       .singletons = singletons_named(singletons)};
  if (!problems.is_none()) options.problems = whole_number("semantic_scores", "problems", problems, 1);
  if (!min_samples.is_none()) options.min_samples = whole_number("semantic_scores", "min_samples", min_samples, 1);
  return options;
}

constexpr const char* kDoc =
    R"(semantic_scores(features, category, object, pose, problems=None, min_samples=None, seed=0, singletons="zero")
--

Semantic scores of views by Monte-Carlo: the mean individual and global Fowlkes-Mallows scores over the random
clustering problems that contain the view. For a problem, at least three categories are drawn, then objects of each
category, a pose of each object and a view of each pose. It is clustered with Ward's linkage.

Parameters
----------
features : (N, D) array of integers or floats, one row per view
category, object, pose : (N,) arrays of whole numbers; objects are unique within a category, poses within an object
problems : int N: stop after N problems
min_samples : int N: stop once every view has been in at least N problems (checked every 16384 problems)
    At least one of the two is needed; the first that is reached stops.
seed : int from 0 to 2^64 - 1; the same seed gives the same bits for any number of threads
singletons : the individual score of an item that is alone in its category in a problem. "zero": 0; "skip": the mean
    leaves it out

Returns
-------
dict of (N,) arrays: individual, global, standard_error (of individual), float64; count (problems that contain the
view), uint64. The mean of no scores is NaN.

Raises
------
svnet.Error if shapes, types or values do not fit, for features that are not finite, and for fewer than three
categories.
)";

py::dict semantic_scores(const py::object& given_features, const py::object& given_category,
                         const py::object& given_object, const py::object& given_pose, const py::object& problem_count,
                         const py::object& min_samples, const py::object& seed, const py::object& singletons) {
  const char* function = "semantic_scores";
  const GivenFeatures features(function, given_features);
  const GivenLabels category(function, "category", given_category), object(function, "object", given_object),
      pose(function, "pose", given_pose);
  const ScoreOptions options = options_from(problem_count, min_samples, seed, singletons);
  semantics::SemanticScores scores;
  {
    const Computing computing;
    const std::set<std::int64_t> categories(category.values().begin(), category.values().end());
    check(categories.size() >= 3, "[semantic_scores] there are ", categories.size(),
          " categories, at least 3 are needed");
    const semantics::ClusteringProblems problems(category.values(), object.values(), pose.values());
    check(problems.views() == features.rows(), "[semantic_scores] ", features.rows(), " rows of features, but ",
          problems.views(), " categories, objects and poses");
    const auto distances = features.squared_distances(Parallel::shared());
    ScoreSums sums(problems.views());
    SingleProcess single_process;
    continue_scores(distances, problems, options, Parallel::shared(), single_process, sums,
                    {.messages = nullptr, .after_step = [](const ScoreSums&) { let_python_interrupt(); }});
    scores = scores_from(sums);
  }
  py::dict result;
  result["individual"] = array_of(std::span<const double>(scores.individual));
  result["global"] = array_of(std::span<const double>(scores.global));
  result["count"] = array_of(std::span<const std::uint64_t>(scores.count));
  result["standard_error"] = array_of(std::span<const double>(scores.standard_error));
  return result;
}

}  // namespace

void bind_scores(py::module_& module) {
  module.def("semantic_scores", semantic_scores, kDoc, py::arg("features"), py::arg("category"), py::arg("object"),
             py::arg("pose"), py::arg("problems") = py::none(), py::arg("min_samples") = py::none(),
             py::arg("seed") = 0, py::arg("singletons") = "zero");
}

}  // namespace svnet::python
