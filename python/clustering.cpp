#include <numeric>

#include "arguments.h"
#include "base/error.h"
#include "bindings.h"
#include "computing.h"
#include "semantics/clusterer.h"

namespace svnet::python {
using semantics::Linkage;

namespace {

namespace py = pybind11;

std::vector<std::int32_t> all_rows(Index n) {
  std::vector<std::int32_t> rows(n);
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

constexpr const char* kWardDoc = R"(ward(features, n_clusters)
--

Agglomerative clustering with Ward's linkage. Distances are rounded to float32. If they all differ, the partition is that
of scikit-learn's AgglomerativeClustering(n_clusters, linkage="ward").

Parameters
----------
features : (N, D) array of integers or floats, any strides
n_clusters : int from 1 to N

Returns
-------
labels : (N,) int64, numbered from 0 in order of first appearance

Raises
------
svnet.Error if shapes, types or values do not fit, and for features that are not finite.
)";

constexpr const char* kAgglomerativeDoc = R"(agglomerative(features, n_clusters, linkage="ward")
--

Agglomerative clustering. Distances are rounded to float32. If they all differ, the partition is that of scikit-learn's
AgglomerativeClustering(n_clusters, linkage=linkage). In a tie, the pair of clusters whose first items come first is
merged.

Parameters
----------
features : (N, D) array of integers or floats, any strides
n_clusters : int from 1 to N
linkage : "ward", "average", "complete" or "single", of Euclidean distances

Returns
-------
labels : (N,) int64, numbered from 0 in order of first appearance

Raises
------
svnet.Error if shapes, types, values or names do not fit, and for features that are not finite.
)";

py::array_t<std::int64_t> agglomerated(const char* function, const py::object& given, const py::object& n_clusters,
                                       Linkage linkage) {
  const GivenFeatures features(function, given);
  const Index k = count_of(function, "n_clusters", n_clusters);
  std::vector<std::int32_t> labels(features.rows());
  {
    const Computing computing;
    const auto distances = features.squared_distances(Parallel::shared());
    let_python_interrupt();
    semantics::Agglomerative(linkage, features.rows()).cluster(distances, all_rows(features.rows()), k, labels);
  }
  return label_array(labels);
}

py::array_t<std::int64_t> ward(const py::object& features, const py::object& n_clusters) {
  return agglomerated("ward", features, n_clusters, Linkage::ward);
}

py::array_t<std::int64_t> agglomerative(const py::object& features, const py::object& n_clusters,
                                        const py::object& linkage) {
  constexpr const char* kFunction = "agglomerative";
  const std::string name = text(kFunction, "linkage", linkage, quoted_names<Linkage>().c_str());
  return agglomerated(kFunction, features, n_clusters, semantics::linkage_named(name));
}

constexpr const char* kKMeansDoc = R"(kmeans(features, n_clusters, n_init=10, seed=0)
--

k-means as scikit-learn's KMeans(algorithm="lloyd"): greedy k-means++ with 2 + floor(ln k) trials, then Lloyd with at
most 300 iterations and tolerance 1e-4. Of n_init runs, the one with the lowest inertia is returned.

Parameters
----------
features : (N, D) array of integers or floats, any strides
n_clusters : int from 1 to N
n_init : int from 1
seed : int from 0 to 2^64 - 1; the same seed gives the same result for any number of threads

Returns
-------
labels : (N,) int64, numbered from 0 in order of first appearance; fewer than n_clusters if there are fewer distinct
    rows
inertia : float, the sum of squared distances to the nearest centre

Raises
------
svnet.Error if shapes, types or values do not fit, and for features that are not finite.
)";

py::tuple kmeans(const py::object& given, const py::object& n_clusters, const py::object& n_init,
                 const py::object& given_seed) {
  const GivenFeatures features("kmeans", given);
  const Index n = features.rows(), k = count_of("kmeans", "n_clusters", n_clusters);
  const semantics::KMeansOptions options{.n_init = count_of("kmeans", "n_init", n_init),
                                         .after_iteration = let_python_interrupt};
  const std::uint64_t seed = whole_number("kmeans", "seed", given_seed);
  // Checked before memory for k clusters is allocated.
  check(k <= n, "[kmeans] cannot make ", k, " clusters of ", n, " points; 1 to ", n, " are possible");
  std::vector<std::int32_t> labels(n);
  double inertia;
  {
    const Computing computing;
    const auto distances = features.squared_distances(Parallel::shared());
    let_python_interrupt();
    inertia = semantics::KMeans(n, k, features.columns(), options)
                  .cluster(distances, all_rows(n), k, RandomStream(seed, Stream::kmeans), labels);
  }
  return py::make_tuple(label_array(labels), inertia);
}

}  // namespace

void bind_clustering(py::module_& module) {
  module.def("ward", ward, kWardDoc, py::arg("features"), py::arg("n_clusters"));
  module.def("agglomerative", agglomerative, kAgglomerativeDoc, py::arg("features"), py::arg("n_clusters"),
             py::arg("linkage") = "ward");
  module.def("kmeans", kmeans, kKMeansDoc, py::arg("features"), py::arg("n_clusters"), py::arg("n_init") = 10,
             py::arg("seed") = 0);
}

}  // namespace svnet::python
