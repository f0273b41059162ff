import numpy as np
import pytest

import svnet

LINKAGES = ["ward", "average", "complete", "single"]
METHODS = ["height", "silhouette", "gap"]


def cut(merges, k):
    """The partition into k clusters, numbered in order of first appearance."""
    n = len(merges) + 1
    clusters = {i: [i] for i in range(n)}
    for m, (a, b, _, _) in enumerate(merges[: n - k]):
        clusters[n + m] = clusters.pop(int(a)) + clusters.pop(int(b))
    labels = np.empty(n, int)
    for number, items in enumerate(sorted(clusters.values(), key=min)):
        labels[items] = number
    return labels


def test_dendrogram_of_points_on_a_line():
    merges = svnet.dendrogram([[0], [1], [10], [13]])
    assert merges.dtype == np.float64 and merges.shape == (3, 4)
    expected = [[0, 1, 1, 2], [2, 3, 3, 2], [4, 5, np.sqrt(2) * 11, 4]]
    np.testing.assert_allclose(merges, expected, rtol=1e-6)
    assert svnet.dendrogram([[3]]).shape == (0, 4)


@pytest.mark.parametrize("linkage", LINKAGES)
def test_cuts_are_the_partitions_of_agglomerative(linkage, random):
    points = random.normal(size=(50, 4))
    merges = svnet.dendrogram(points, linkage)
    for k in (1, 2, 7, 25, 50):
        assert (cut(merges, k) == svnet.agglomerative(points, k, linkage)).all()
    assert (np.diff(merges[:, 2]) >= 0).all() and merges[-1, 3] == 50


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("linkage", LINKAGES)
def test_group_count_of_clear_groups(method, linkage, random):
    points = np.repeat(np.eye(5, 16) * 50, 6, axis=0) + random.normal(size=(30, 16))
    count = svnet.group_count(points, method, linkage)
    assert type(count) is int and count == 5


@pytest.mark.parametrize("method", METHODS)
def test_group_count_of_few_or_equal_items(method):
    assert svnet.group_count([[1, 2]], method) == 1
    assert svnet.group_count([[1, 2], [3, 4]], method) == 2
    assert svnet.group_count([[1, 2]] * 7, method) == 1


def test_height_is_the_default(random):
    points = random.normal(size=(30, 16))
    assert svnet.group_count(points) == svnet.group_count(points, method="height", linkage="ward")


def test_co_association_recovers_groups_that_no_labelling_has():
    labels = [[0, 0, 0, 0, 1, 1], [0, 0, 1, 1, 1, 1], [0, 0, 1, 1, 0, 0], [0, 0, 1, 2, 2, 2]]
    groups = svnet.co_association(labels, 3)
    assert groups.dtype == np.int64 and groups.tolist() == [0, 0, 1, 1, 2, 2]
    assert svnet.co_association(np.array(labels, float), n_clusters=1, linkage="single").tolist() == [0] * 6


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: svnet.dendrogram([1, 2, 3]), r"\[dendrogram\] features have shape \(3,\); expects \(N, D\)"),
        (lambda: svnet.dendrogram([[1.0], [np.nan]]), "feature 0 of row 1 is -?nan"),
        (lambda: svnet.dendrogram([[1], [2]], "wards"), "'wards' is unknown, did you mean 'ward'?"),
        (lambda: svnet.dendrogram([[1], [2]], None), 'linkage is no str; expects "ward", "average"'),
        (lambda: svnet.group_count([[1], [2]], "elbow"), r"\[group_count\] 'elbow' is unknown; known: height, silh"),
        (lambda: svnet.group_count([[1], [2]], 3), 'method is no str; expects "height", "silhouette" or "gap"'),
        (lambda: svnet.group_count(np.zeros((0, 3))), r"features have shape \(0, 3\)"),
        (lambda: svnet.co_association([0, 1], 1), r"labels have shape \(2,\); expects \(L, N\), one row per labelling"),
        (lambda: svnet.co_association([[0, 1], [0, 0.5]], 1), r"labels\[1, 1\] is 0.5; expects whole numbers"),
        (lambda: svnet.co_association([["a", "b"]], 1), "labels has dtype <U1; expects integers or floats"),
        (lambda: svnet.co_association([[0, 1]], 3), "cannot make 3 clusters of 2 items; 1 to 2 are possible"),
        (lambda: svnet.co_association([[0, 1]], 0), "n_clusters is 0; expects a whole number from 1 to"),
        (lambda: svnet.co_association([[0, 1]], 1, "mean"), "'mean' is unknown"),
    ],
)
def test_arguments_that_are_refused(call, message):
    with pytest.raises(svnet.Error, match=message):
        call()
