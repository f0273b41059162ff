#include "semantics/cluster_metrics.h"

#include "arguments.h"
#include "base/error.h"
#include "base/text.h"
#include "bindings.h"
#include "computing.h"

namespace svnet::python {
using semantics::NmiAverage;

namespace {

namespace py = pybind11;

/// Returns `metric` of the two labellings, computed without the GIL.
auto measured(const char* function, const py::object& given_true, const py::object& given_pred, auto metric) {
  const GivenLabels truth(function, "true", given_true), predicted(function, "pred", given_pred);
  const Computing computing;
  return metric(truth.values(), predicted.values());
}

NmiAverage average_named(const py::object& given) {
  const std::string name = text("normalized_mutual_info", "average", given, quoted_names<NmiAverage>().c_str());
  const auto found = find_enum<NmiAverage>(name);
  check(found.has_value(), "[normalized_mutual_info] there is no average '", name, "'",
        suggestion(name, names_of<NmiAverage>()));
  return *found;
}

constexpr const char* kFowlkesMallowsDoc = R"(fowlkes_mallows(true, pred)
--

Fowlkes-Mallows score TP / sqrt((TP + FP)(TP + FN)) over pairs of items; 0 if TP is 0.

true, pred : (N,) arrays of whole numbers or strings, the class and the cluster of each item. Returns a float in [0, 1].
Raises svnet.Error if lengths or types do not fit, or there is no item.
)";

constexpr const char* kIndividualDoc = R"(fowlkes_mallows_individual(true, pred)
--

The Fowlkes-Mallows score of each item over the pairs that contain it; 0/0 counts as 0.

true, pred : (N,) arrays of whole numbers or strings, the class and the cluster of each item. Returns (N,) float64 in [0, 1].
Raises svnet.Error if lengths or types do not fit, or there is no item.
)";

constexpr const char* kMutualDoc = R"(normalized_mutual_info(true, pred, average="arithmetic")
--

Mutual information of two labellings, divided by the mean of their entropies, as scikit-learn defines it.

true, pred : (N,) arrays of whole numbers or strings, the class and the cluster of each item.
average : "arithmetic" or "geometric". Returns a float in [0, 1].
Raises svnet.Error if lengths or types do not fit, there is no item, or the average is unknown.
)";

constexpr const char* kPurityDoc = R"(purity(true, pred)
--

Fraction of the items whose class is the most frequent one in their cluster.

true, pred : (N,) arrays of whole numbers or strings, the class and the cluster of each item. Returns a float in (0, 1].
Raises svnet.Error if lengths or types do not fit, or there is no item.
)";

constexpr const char* kAdjustedRandDoc = R"(adjusted_rand(true, pred)
--

Rand index adjusted for chance, as scikit-learn defines it.

true, pred : (N,) arrays of whole numbers or strings, the class and the cluster of each item. Returns a float in [-0.5, 1].
Raises svnet.Error if lengths or types do not fit, or there is no item.
)";

}  // namespace

void bind_cluster_metrics(py::module_& module) {
  const auto define = [&](const char* name, double (*metric)(semantics::Labels, semantics::Labels), const char* doc) {
    module.def(
        name,
        [name, metric](const py::object& truth, const py::object& pred) { return measured(name, truth, pred, metric); },
        doc, py::arg("true"), py::arg("pred"));
  };
  define("fowlkes_mallows", semantics::fowlkes_mallows, kFowlkesMallowsDoc);
  define("purity", semantics::purity, kPurityDoc);
  define("adjusted_rand", semantics::adjusted_rand, kAdjustedRandDoc);
  module.def(
      "fowlkes_mallows_individual",
      [](const py::object& truth, const py::object& pred) {
        const auto values = measured("fowlkes_mallows_individual", truth, pred,
                                     [](auto t, auto p) { return semantics::fowlkes_mallows_individual(t, p); });
        return array_of(std::span(values));
      },
      kIndividualDoc, py::arg("true"), py::arg("pred"));
  module.def(
      "normalized_mutual_info",
      [](const py::object& truth, const py::object& pred, const py::object& average) {
        return measured("normalized_mutual_info", truth, pred, [mean = average_named(average)](auto t, auto p) {
          return semantics::normalized_mutual_info(t, p, mean);
        });
      },
      kMutualDoc, py::arg("true"), py::arg("pred"), py::arg("average") = "arithmetic");
}

}  // namespace svnet::python
