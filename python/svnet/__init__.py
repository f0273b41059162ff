"""Semantic view selection: features of images, clusterings of them, and the semantic scores of views.

    import svnet
    backbone = svnet.Backbone("mobilenet_v2", weights="mobilenet_v2.h5")
    features = backbone.features(images)                      # (N, 224, 224, 3) uint8 -> (N, 1280) float32
    labels = svnet.ward(features, n_clusters=8)
    print(svnet.fowlkes_mallows(category, labels))
    scores = svnet.semantic_scores(features, category, object, pose, min_samples=10000)

NumPy in, NumPy out. Features and labels may be of any integer or float dtype and have any strides. Everything releases
the GIL while it computes, and may be called from several threads. Results are the same bits for any number of threads.
What a caller can mend is raised as svnet.Error, a ValueError.
"""

from ._svnet import (
    Backbone,
    Error,
    __version__,
    adjusted_rand,
    fowlkes_mallows,
    fowlkes_mallows_individual,
    kmeans,
    normalized_mutual_info,
    purity,
    semantic_scores,
    set_threads,
    ward,
)

__all__ = [
    "Backbone",
    "Error",
    "__version__",
    "adjusted_rand",
    "fowlkes_mallows",
    "fowlkes_mallows_individual",
    "kmeans",
    "normalized_mutual_info",
    "purity",
    "semantic_scores",
    "set_threads",
    "ward",
]
