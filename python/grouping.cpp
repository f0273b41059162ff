// Groups of objects: dendrograms, the number of groups, and what several labellings agree on.
#include <vector>

#include "arguments.h"
#include "base/error.h"
#include "bindings.h"
#include "computing.h"
#include "semantics/co_association.h"
#include "semantics/dendrogram.h"
#include "semantics/group_count.h"

namespace svnet::python {
using semantics::Dendrogram;
using semantics::DistanceMatrix;
using semantics::GroupCount;
using semantics::Linkage;

namespace {

namespace py = pybind11;

constexpr const char* kDendrogramDoc = R"(dendrogram(features, linkage="ward")
--

The merges of agglomerative clustering, in the form of scipy.cluster.hierarchy.linkage, whose functions draw and cut it.
A cut into k clusters is the partition of agglomerative(features, k, linkage). Needs 8 N^2 bytes.

Parameters
----------
features : (N, D) array of integers or floats, any strides
linkage : "ward", "average", "complete" or "single", of Euclidean distances

Returns
-------
merges : (N - 1, 4) float64, one row per merge: the two clusters, the smaller number first; their dissimilarity, in the
    unit of the features, computed in float32; and the number of items in the result. Cluster i < N is row i of
    features; cluster N + m is the result of merge m. Heights never decrease.

Raises
------
svnet.Error if shapes, types or names do not fit, and for features that are not finite.
)";

Linkage linkage_of(const char* function, const py::object& linkage) {
  return semantics::linkage_named(text(function, "linkage", linkage, quoted_names<Linkage>().c_str()));
}

py::array_t<double> dendrogram(const py::object& given, const py::object& given_linkage) {
  constexpr const char* kFunction = "dendrogram";
  const Linkage linkage = linkage_of(kFunction, given_linkage);
  const GivenFeatures features(kFunction, given);
  Dendrogram history{};
  {
    const Computing computing;
    const DistanceMatrix distances = features.squared_distances(Parallel::shared());
    let_python_interrupt();
    history = semantics::dendrogram(linkage, distances);
  }
  py::array_t<double> merges({static_cast<py::ssize_t>(history.merges.size()), py::ssize_t{4}});
  double* row = merges.mutable_data();
  for (const semantics::Merge& merge : history.merges) {
    *row++ = merge.a;
    *row++ = merge.b;
    *row++ = merge.height;
    *row++ = static_cast<double>(merge.size);
  }
  return merges;
}

constexpr const char* kGroupCountDoc = R"(group_count(features, method="height", linkage="ward")
--

Estimates into how many groups items fall, by their dendrogram.

Parameters
----------
features : (N, D) array of integers or floats, any strides
method : "height": the cut at a height between the mean distance of two items and the last merge. "silhouette": the
    number from 2 to N - 1 with the largest mean silhouette. "gap": the cut in the largest gap between two heights.
linkage : "ward", "average", "complete" or "single", of Euclidean distances

Returns
-------
count : int; 1 if all rows are equal, 2 for two rows that differ

Raises
------
svnet.Error if shapes, types or names do not fit, and for features that are not finite.
)";

Index group_count(const py::object& given, const py::object& given_method, const py::object& given_linkage) {
  constexpr const char* kFunction = "group_count";
  const GroupCount method =
      semantics::group_count_named(text(kFunction, "method", given_method, quoted_names<GroupCount>().c_str()));
  const Linkage linkage = linkage_of(kFunction, given_linkage);
  const GivenFeatures features(kFunction, given);
  const Computing computing;
  const DistanceMatrix distances = features.squared_distances(Parallel::shared());
  let_python_interrupt();
  return semantics::group_count(method, linkage, semantics::dendrogram(linkage, distances), distances);
}

constexpr const char* kCoAssociationDoc = R"(co_association(labels, n_clusters, linkage="average")
--

The partition that several labellings of the same items agree on most, such as one labelling per view: evidence
accumulation of Fred and Jain (2005). The distance of two items is the share of labellings that put them apart; items are
clustered by these distances.

Parameters
----------
labels : (L, N) array of whole numbers; a row is a labelling of all items, and numbers mean nothing across rows
n_clusters : int from 1 to N
linkage : "ward", "average", "complete" or "single"

Returns
-------
labels : (N,) int64, numbered from 0 in order of first appearance

Raises
------
svnet.Error if shapes, types, values or names do not fit.
)";

py::array_t<std::int64_t> co_association(const py::object& given, const py::object& n_clusters,
                                         const py::object& given_linkage) {
  constexpr const char* kFunction = "co_association";
  const Linkage linkage = linkage_of(kFunction, given_linkage);
  const Index k = count_of(kFunction, "n_clusters", n_clusters);
  const GivenLabellings labellings(kFunction, given);
  std::vector<std::int32_t> labels;
  {
    const Computing computing;
    labels = semantics::co_association(labellings.values(), labellings.items(), k, linkage);
  }
  return label_array(labels);
}

}  // namespace

void bind_grouping(py::module_& module) {
  module.def("dendrogram", dendrogram, kDendrogramDoc, py::arg("features"), py::arg("linkage") = "ward");
  module.def("group_count", group_count, kGroupCountDoc, py::arg("features"), py::arg("method") = "height",
             py::arg("linkage") = "ward");
  module.def("co_association", co_association, kCoAssociationDoc, py::arg("labels"), py::arg("n_clusters"),
             py::arg("linkage") = "average");
}

}  // namespace svnet::python
