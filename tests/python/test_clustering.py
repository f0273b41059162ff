import signal
import threading
import time

import numpy as np
import pytest

import svnet

# Two groups of two points, and a single point.
POINTS = [[0, 0], [10, 0], [0, 1], [10, 2], [50, 50]]


@pytest.mark.parametrize("cluster", [svnet.ward, lambda x, k: svnet.kmeans(x, k)[0]])
@pytest.mark.parametrize("k, expected", [(1, [0, 0, 0, 0, 0]), (3, [0, 1, 0, 1, 2]), (5, [0, 1, 2, 3, 4])])
def test_partition(cluster, k, expected):
    labels = cluster(POINTS, k)
    assert labels.dtype == np.int64 and labels.tolist() == expected


LINKAGES = ["ward", "average", "complete", "single"]


def plain_agglomeration(points, k, linkage):
    """The formulas of Lance and Williams, without shortcuts."""
    size = {i: 1 for i in range(len(points))}
    apart = {
        (i, j): float(np.linalg.norm(points[i] - points[j])) ** (2 if linkage == "ward" else 1)
        for i in size
        for j in size
        if i < j
    }
    labels = list(range(len(points)))
    while len(size) > k:
        a, b = min(apart, key=apart.get)
        joined = apart.pop((a, b))
        for c in size:
            if c in (a, b):
                continue
            to_a, to_b = apart[min(a, c), max(a, c)], apart.pop((min(b, c), max(b, c)))
            na, nb, nc = size[a], size[b], size[c]
            apart[min(a, c), max(a, c)] = {
                "ward": ((na + nc) * to_a + (nb + nc) * to_b - nc * joined) / (na + nb + nc),
                "average": (na * to_a + nb * to_b) / (na + nb),
                "complete": max(to_a, to_b),
                "single": min(to_a, to_b),
            }[linkage]
        size[a] += size.pop(b)
        labels = [a if label == b else label for label in labels]
    return [sorted(size).index(label) for label in labels]


@pytest.mark.parametrize("linkage", LINKAGES)
def test_every_linkage(linkage, random):
    points = random.normal(size=(40, 3))
    partitions = [svnet.agglomerative(points, k, linkage=linkage) for k in (1, 4, 9, 40)]
    assert [p.tolist() for p in partitions] == [plain_agglomeration(points, k, linkage) for k in (1, 4, 9, 40)]
    assert partitions[0].dtype == np.int64


def test_linkages_differ_and_ward_is_the_default(random):
    points = random.normal(size=(60, 2))
    assert len({svnet.agglomerative(points, 6, linkage).tobytes() for linkage in LINKAGES}) == 4
    assert (svnet.agglomerative(points, 6) == svnet.ward(points, 6)).all()
    with pytest.raises(svnet.Error, match=".linkage. 'wards' is unknown, did you mean 'ward'?"):
        svnet.agglomerative(points, 6, "wards")


def test_inertia_is_the_sum_of_squared_distances_to_the_centres():
    labels, inertia = svnet.kmeans(POINTS, 3)
    assert isinstance(inertia, float) and inertia == 0.5 + 2.0


@pytest.mark.parametrize("dtype", ["?", "i1", "u1", "i2", "u4", "i8", "u8", "f2", "f4", "f8", "g", ">f4", ">i2"])
def test_every_number_dtype_means_the_same(dtype):
    points = np.array([[0, 0], [1, 1], [0, 0], [1, 0]]).astype(dtype)
    assert svnet.ward(points, 2).tolist() == [0, 1, 0, 1]
    assert svnet.kmeans(points, 2)[1] == 0.5


def test_strides(random):
    points = random.normal(size=(40, 6)).astype(np.float32)
    expected = svnet.ward(points, 4).tolist()
    assert svnet.ward(np.asfortranarray(points), 4).tolist() == expected
    assert svnet.ward(np.repeat(np.repeat(points, 2, axis=0), 3, axis=1)[::2, ::3], 4).tolist() == expected
    assert svnet.ward(points[:, ::-1], 4).tolist() == expected
    backwards = svnet.ward(points[::-1], 4)[::-1]
    assert svnet.fowlkes_mallows(backwards, expected) == 1


def test_digits_that_float32_lacks_are_kept():
    apart = np.array([[0.0], [1e-3], [3e-3], [3.5e-3]]) + 1e6
    assert svnet.ward(apart, 2).tolist() == [0, 0, 1, 1]
    assert svnet.ward([[2**53 - 4], [2**53 - 3], [2**53 - 1], [2**53]], 2).tolist() == [0, 0, 1, 1]


def test_arguments_are_left_alone(random):
    points = random.normal(size=(20, 3)).astype(np.float32)
    before = points.copy()
    points.setflags(write=False)
    svnet.ward(points, 3)
    svnet.kmeans(points, 3)
    assert (points == before).all()


def test_seed_decides_kmeans(random):
    points = random.normal(size=(200, 4))
    results = [svnet.kmeans(points, 12, n_init=1, seed=seed) for seed in (0, 0, 1, 2, 2**64 - 1)]
    assert (results[0][0] == results[1][0]).all() and results[0][1] == results[1][1]
    assert len({inertia for _, inertia in results}) == 4


@pytest.mark.parametrize("n", [1, 2, 3, 8])
def test_number_of_threads_does_not_matter(n, random, threads):
    points = random.normal(size=(400, 300))
    threads(1)
    ward, kmeans = svnet.ward(points, 7), svnet.kmeans(points, 7)
    threads(n)
    assert svnet.ward(points, 7).tobytes() == ward.tobytes()
    labels, inertia = svnet.kmeans(points, 7)
    assert labels.tobytes() == kmeans[0].tobytes() and inertia == kmeans[1]


@pytest.mark.parametrize(
    "features, message",
    [
        ([1, 2, 3], r"features have shape \(3,\); expects \(N, D\)"),
        (np.zeros((2, 2, 2)), r"features have shape \(2, 2, 2\)"),
        ([["a", "b"]], "features has dtype <U1; expects integers or floats"),
        (np.zeros((2, 2), complex), "features has dtype complex128"),
        ([[1, 2], [3]], "features is not an array"),
        ([[None]], "features has dtype object"),
        (np.zeros((0, 3)), r"features have shape \(0, 3\)"),
        (np.zeros((3, 0)), r"features have shape \(3, 0\)"),
        ([[0.0, 1.0], [2.0, float("nan")]], "feature 1 of row 1 is -?nan"),
        (np.array([[0.0], [np.inf]], np.float16), "feature 0 of row 1 is inf"),
        ([[0.0], [1e30]], "scale the features down"),
    ],
)
def test_features_that_are_refused(features, message):
    for cluster in (svnet.ward, svnet.agglomerative, svnet.kmeans):
        with pytest.raises(svnet.Error, match=message):
            cluster(features, 1)


@pytest.mark.parametrize("k", [0, -1, 2.0, "2", None, 6, 2**64])
def test_numbers_of_clusters_that_are_refused(k):
    message = "cannot make 6 clusters of 5 points" if k == 6 else "n_clusters is .*; expects a whole number from 1 to"
    for cluster in (svnet.ward, svnet.agglomerative, svnet.kmeans):
        with pytest.raises(svnet.Error, match=message):
            cluster(POINTS, k)


def test_other_numbers_that_are_refused():
    with pytest.raises(svnet.Error, match="n_init is 0; expects a whole number from 1"):
        svnet.kmeans(POINTS, 2, n_init=0)
    with pytest.raises(svnet.Error, match="seed is -1; expects a whole number from 0"):
        svnet.kmeans(POINTS, 2, seed=-1)
    assert svnet.kmeans(POINTS, np.int8(2), n_init=np.uint16(3), seed=np.int64(5))[0].tolist() == [0, 0, 0, 0, 1]


def test_linkages_that_are_refused():
    with pytest.raises(svnet.Error, match="'wards' is unknown, did you mean 'ward'?"):
        svnet.agglomerative(POINTS, 2, "wards")
    for linkage in (None, 3, b"ward"):
        with pytest.raises(svnet.Error, match='linkage is no str; expects "ward", "average", "complete" or "single"$'):
            svnet.agglomerative(POINTS * 1000, 2, linkage)


def test_interrupt_ends_kmeans(random):
    features = random.normal(size=(300, 8))
    threading.Timer(0.1, lambda: signal.raise_signal(signal.SIGINT)).start()
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        svnet.kmeans(features, 20, n_init=10**6)
    assert time.monotonic() - start < 5


@pytest.mark.parametrize("cluster", [svnet.ward, svnet.agglomerative])
def test_interrupt_after_the_distances_ends_an_agglomeration(cluster, random):
    features = random.normal(size=(4000, 1000))
    # Refuses during a computation, not before or after it. Signals repeat, because the first ones may come before the
    # computation starts; the distances take longer than the interval.
    before = signal.signal(signal.SIGALRM, lambda *_: svnet.set_threads(1))
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.02, 0.02)
        with pytest.raises(svnet.Error, match="while a computation is interrupted"):
            cluster(features, 2)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


class Tensor:
    """What svnet needs of a torch tensor in bfloat16 with gradients: NumPy cannot read it."""

    dtype = "torch.bfloat16"

    def __init__(self, values):
        self.values = values

    def __array__(self, *arguments, **options):
        raise TypeError("Got unsupported ScalarType BFloat16")

    def detach(self):
        return self

    def cpu(self):
        return self

    def float(self):
        return self.values.astype("f4")


def test_tensors_in_bfloat16():
    features = np.random.default_rng(6).integers(-8, 8, size=(20, 3)) / 4  # exact in bfloat16
    expected = svnet.ward(features, 4).tobytes()
    assert svnet.ward(Tensor(features), 4).tobytes() == expected
    torch = pytest.importorskip("torch")
    tensor = torch.tensor(features, dtype=torch.bfloat16, requires_grad=True)
    assert svnet.ward(tensor, 4).tobytes() == expected


def test_arrays_in_bfloat16():
    ml_dtypes = pytest.importorskip("ml_dtypes")  # of JAX and TensorFlow
    features = np.random.default_rng(6).integers(-8, 8, size=(20, 3)) / 4
    assert svnet.ward(features.astype(ml_dtypes.bfloat16), 4).tobytes() == svnet.ward(features, 4).tobytes()
