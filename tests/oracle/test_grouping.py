"""Dendrograms against SciPy, silhouettes against scikit-learn."""
import numpy as np
import pytest
from scipy.cluster.hierarchy import cut_tree, linkage as scipy_linkage
from scipy.spatial.distance import pdist
from sklearn.metrics import silhouette_score

import svnet

LINKAGES = ["ward", "average", "complete", "single"]


def points(random, largest):
    """Groups of normal points, from well separated to one cloud; some are far from the origin."""
    n, d = int(random.integers(4, largest)), int(random.integers(1, 64))
    centres = random.normal(size=(int(random.integers(1, 12)), d)) * random.choice([0.0, 1.0, 3.0])
    return centres[random.integers(len(centres), size=n)] + random.normal(size=(n, d)) + random.choice([0.0, 100.0])


@pytest.mark.parametrize("linkage", LINKAGES)
def test_dendrograms(linkage, report):
    random = np.random.default_rng(11)
    largest = 0.0
    for problem in range(300):
        x = points(random, 120).astype(random.choice([np.float32, np.float64]))
        found, expected = svnet.dendrogram(x, linkage), scipy_linkage(x.astype(np.float64), linkage)
        assert (found[:, [0, 1, 3]] == expected[:, [0, 1, 3]]).all(), (problem, x.shape)
        largest = max(largest, np.abs(found[:, 2] / expected[:, 2] - 1).max())
    report(f"dendrogram, {linkage}: 300 of 300 merges equal SciPy's, heights within {largest:.1e}")
    assert largest < 1e-5


@pytest.mark.parametrize("linkage", LINKAGES)
def test_a_large_dendrogram(linkage, report):
    x = np.random.default_rng(12).normal(size=(2000, 40))
    found, expected = svnet.dendrogram(x, linkage), scipy_linkage(x, linkage)
    difference = np.abs(found[:, 2] / expected[:, 2] - 1).max()
    report(f"dendrogram of 2000 items, {linkage}: heights within {difference:.1e} of SciPy's")
    assert difference < 1e-5


def test_the_number_with_the_largest_silhouette():
    random = np.random.default_rng(13)
    for problem in range(100):
        x = points(random, 40)
        merges = scipy_linkage(x, "ward")
        cuts = cut_tree(merges)
        scores = [silhouette_score(x, cuts[:, -k]) for k in range(2, len(x))]
        found = svnet.group_count(x, "silhouette")
        assert scores[found - 2] == pytest.approx(max(scores), abs=1e-5), problem


def test_the_largest_gap():
    random = np.random.default_rng(14)
    for problem in range(100):
        x = points(random, 40)
        heights = scipy_linkage(x, "average")[:, 2]
        assert svnet.group_count(x, "gap", "average") == len(x) - 1 - np.argmax(np.diff(heights)), problem


def test_the_height():
    random = np.random.default_rng(15)
    for problem in range(100):
        x = points(random, 40)
        heights = scipy_linkage(x, "ward")[:, 2]
        limit = 1.02 * pdist(x).mean() ** 0.8 * heights[-1] ** 0.2
        assert svnet.group_count(x) == 1 + (heights > limit).sum(), problem
