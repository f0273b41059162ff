# Types of the module. The docstrings describe the arguments, with shapes and units.
import os
from typing import Literal, Optional, SupportsIndex, TypedDict, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

_Path = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]
_SemanticScores = TypedDict(
    "_SemanticScores",
    {
        "individual": NDArray[np.float64],
        "global": NDArray[np.float64],
        "count": NDArray[np.uint64],
        "standard_error": NDArray[np.float64],
    },
)

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

__version__: str

class Error(ValueError): ...

class Backbone:
    def __init__(
        self, name: str, weights: Optional[_Path] = None, layer: Optional[str] = None, seed: SupportsIndex = 0
    ) -> None: ...
    def features(self, images: NDArray[np.uint8]) -> NDArray[np.float32]: ...
    @property
    def name(self) -> str: ...
    @property
    def layer(self) -> str: ...
    @property
    def dimension(self) -> int: ...
    @property
    def input_shape(self) -> tuple[int, int, int]: ...
    @property
    def unused_layers(self) -> list[str]: ...

class Model:
    @staticmethod
    def load(path: _Path) -> Model: ...
    def score(
        self, image: NDArray[np.uint8], angles_deg: ArrayLike, depth: Optional[ArrayLike] = None
    ) -> NDArray[np.float32]: ...
    def best_view(
        self, image: NDArray[np.uint8], angles_deg: ArrayLike, depth: Optional[ArrayLike] = None
    ) -> tuple[int, NDArray[np.float32]]: ...
    def best_views(
        self,
        image: NDArray[np.uint8],
        angles_deg: ArrayLike,
        k: SupportsIndex,
        min_angle_deg: float = 0,
        depth: Optional[ArrayLike] = None,
    ) -> tuple[NDArray[np.int64], NDArray[np.float32]]: ...
    def gain(
        self, image: NDArray[np.uint8], angles_deg: ArrayLike, depth: Optional[ArrayLike] = None
    ) -> dict[str, float]: ...
    def next_view(
        self,
        image: NDArray[np.uint8],
        taken: Sequence[tuple[float, float, NDArray[np.uint8]]],
        angles_deg: ArrayLike,
        min_angle_deg: float = 0,
        depth: Optional[ArrayLike] = None,
    ) -> tuple[Optional[int], NDArray[np.float32]]: ...
    def margin(self, image: NDArray[np.uint8], angles_deg: ArrayLike, depth: Optional[ArrayLike] = None) -> float: ...
    @property
    def knows_next_view(self) -> bool: ...
    @property
    def uses_depth(self) -> bool: ...

def adjusted_rand(true: ArrayLike, pred: ArrayLike) -> float: ...
def agglomerative(
    features: ArrayLike, n_clusters: SupportsIndex, linkage: Literal["ward", "average", "complete", "single"] = "ward"
) -> NDArray[np.int64]: ...
def camera_pose(
    theta_deg: float, phi_deg: float, radius: float, centre: ArrayLike, frame: Literal["paper", "optical"] = "paper"
) -> NDArray[np.float64]: ...
def co_association(
    labels: ArrayLike,
    n_clusters: SupportsIndex,
    linkage: Literal["ward", "average", "complete", "single"] = "average",
) -> NDArray[np.int64]: ...
def dendrogram(
    features: ArrayLike, linkage: Literal["ward", "average", "complete", "single"] = "ward"
) -> NDArray[np.float64]: ...
def fowlkes_mallows(true: ArrayLike, pred: ArrayLike) -> float: ...
def fowlkes_mallows_individual(true: ArrayLike, pred: ArrayLike) -> NDArray[np.float64]: ...
def group_count(
    features: ArrayLike,
    method: Literal["height", "silhouette", "gap"] = "height",
    linkage: Literal["ward", "average", "complete", "single"] = "ward",
) -> int: ...
def kmeans(
    features: ArrayLike, n_clusters: SupportsIndex, n_init: SupportsIndex = 10, seed: SupportsIndex = 0
) -> tuple[NDArray[np.int64], float]: ...
def normalized_mutual_info(
    true: ArrayLike, pred: ArrayLike, average: Literal["arithmetic", "geometric"] = "arithmetic"
) -> float: ...
def pose_grid(
    theta_steps: SupportsIndex = 36,
    phi_steps: SupportsIndex = 10,
    lowest_phi_deg: float = 0,
    highest_phi_deg: float = 90,
) -> NDArray[np.float64]: ...
def purity(true: ArrayLike, pred: ArrayLike) -> float: ...
def semantic_scores(
    features: ArrayLike,
    category: ArrayLike,
    object: ArrayLike,
    pose: ArrayLike,
    problems: Optional[SupportsIndex] = None,
    min_samples: Optional[SupportsIndex] = None,
    seed: SupportsIndex = 0,
    singletons: Literal["zero", "skip"] = "zero",
) -> _SemanticScores: ...
def set_sandbox(mode: Literal["on", "off"]) -> None: ...
def set_threads(n: SupportsIndex) -> None: ...
def ward(features: ArrayLike, n_clusters: SupportsIndex) -> NDArray[np.int64]: ...
