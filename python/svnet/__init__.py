"""Semantic view selection: features of images, clustering, semantic scores of views, and their prediction.

    import svnet
    backbone = svnet.Backbone("mobilenet_v2", weights="mobilenet_v2.h5")
    features = backbone.features(images)                      # (N, 224, 224, 3) uint8 -> (N, 1280) float32
    labels = svnet.ward(features, n_clusters=8)
    print(svnet.fowlkes_mallows(category, labels))
    groups = svnet.ward(features, svnet.group_count(features))  # an unknown number of groups
    scores = svnet.semantic_scores(features, category, object, pose, min_samples=10000)
    model = svnet.Model.load("model.safetensors")             # written by svnet-train
    index, scores = model.best_view(top_image, [[0, 45], [90, 60]])  # (H, W, 3) uint8; theta, phi in degrees
    indices, scores = model.best_views(top_image, svnet.pose_grid(36, 10), k=3, min_angle_deg=40)
    camera_to_world = svnet.camera_pose(90, 60, radius=0.7, centre=(0, 0, 0.05), frame="optical")

Arguments and results are NumPy arrays. Features, labels and angles may have any integer or float dtype and any strides.
All functions release the GIL while they compute, and may be called from several threads. Results have the same bits for
any number of threads. An error that the caller can correct is raised as svnet.Error, a ValueError.
"""

from ._svnet import (
    Backbone,
    Error,
    Model,
    __version__,
    adjusted_rand,
    agglomerative,
    camera_pose,
    co_association,
    dendrogram,
    fowlkes_mallows,
    fowlkes_mallows_individual,
    group_count,
    kmeans,
    normalized_mutual_info,
    pose_grid,
    purity,
    semantic_scores,
    set_sandbox,
    set_threads,
    ward,
)


def _model_from_bytes(contents):
    """The inverse of Model.__reduce__, which pickle needs."""
    return Model._from_bytes(contents)


__all__ = [
    "Backbone",
    "Error",
    "Model",
    "__version__",
    "adjusted_rand",
    "agglomerative",
    "camera_pose",
    "co_association",
    "dendrogram",
    "fowlkes_mallows",
    "fowlkes_mallows_individual",
    "group_count",
    "kmeans",
    "normalized_mutual_info",
    "pose_grid",
    "purity",
    "semantic_scores",
    "set_sandbox",
    "set_threads",
    "ward",
]
