#pragma once
#include "semantics/clusterer.h"
#include "train/config/config.h"

namespace svnet {

/// The algorithm that a configuration names, for features of `dimension` numbers.
inline ClusteringOptions clustering_options(Config::Scores::Clustering clustering, Index dimension) {
  using Clustering = Config::Scores::Clustering;
  ClusteringOptions options{.dimension = dimension};
  switch (clustering) {
    case Clustering::ward:
      options.linkage = Linkage::ward;
      break;
    case Clustering::average:
      options.linkage = Linkage::average;
      break;
    case Clustering::complete:
      options.linkage = Linkage::complete;
      break;
    case Clustering::single:
      options.linkage = Linkage::single;
      break;
    case Clustering::kmeans:
      options.method = ClusteringOptions::Method::kmeans;
      break;
  }
  return options;
}

}  // namespace svnet
