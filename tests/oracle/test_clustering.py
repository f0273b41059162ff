"""Clusterings and metrics against scikit-learn."""
import numpy as np
import pytest
from sklearn import metrics
from sklearn.cluster import AgglomerativeClustering, KMeans

import svnet


def points(random, largest):
    """Groups of normal points, from well separated to one cloud; some are far from the origin."""
    n, d = int(random.integers(4, largest)), int(random.integers(1, 64))
    centres = random.normal(size=(int(random.integers(1, 12)), d)) * random.choice([0.0, 1.0, 3.0])
    x = centres[random.integers(len(centres), size=n)] + random.normal(size=(n, d)) + random.choice([0.0, 100.0])
    return x.astype(random.choice([np.float32, np.float64]))


def numbered_by_appearance(labels):
    _, first, inverse = np.unique(labels, return_index=True, return_inverse=True)
    return np.argsort(np.argsort(first))[inverse]


@pytest.mark.parametrize("linkage", ["ward", "average", "complete", "single"])
def test_every_linkage_gives_the_same_partitions(linkage, report):
    random = np.random.default_rng(1)
    for problem in range(1000):
        x = points(random, 120)
        k = int(random.integers(1, len(x) + 1))
        expected = AgglomerativeClustering(k, linkage=linkage).fit(x.astype(np.float64)).labels_
        labels = svnet.agglomerative(x, k, linkage)
        assert (labels == numbered_by_appearance(expected)).all(), (problem, x.shape, k)
    report(f"{linkage}: 1000 of 1000 partitions equal")


def test_kmeans_means_as_low_inertias_over_many_problems(report):
    random = np.random.default_rng(5)
    found, expected = [], []
    for problem in range(1000):
        x = points(random, 80)
        k = int(random.integers(2, min(len(x), 25)))
        found.append(svnet.kmeans(x, k, n_init=10, seed=problem)[1])
        expected.append(KMeans(k, n_init=10, random_state=problem).fit(x.astype(np.float64)).inertia_)
    ratio = np.mean(np.array(found) / np.array(expected))
    report(
        f"kmeans, n_init 10, 1000 problems: inertia {ratio - 1:+.4%} of scikit-learn's in the mean of ratios, "
        f"{np.mean(found) / np.mean(expected) - 1:+.4%} in the ratio of means"
    )
    assert ratio < 1.001 and np.mean(found) / np.mean(expected) < 1.001


def test_kmeans_finds_as_low_inertias(report):
    random = np.random.default_rng(2)
    ratios = []
    seeds = range(8)  # a single search is off by half a per cent where the points are one cloud
    for problem in range(50):
        x = points(random, 250)
        k = int(random.integers(2, min(len(x), 13)))
        found = [svnet.kmeans(x, k, seed=seed) for seed in seeds]
        expected = [KMeans(k, n_init=10, random_state=seed).fit(x).inertia_ for seed in seeds]
        labels, inertia = found[0]
        x = x.astype(np.float64)
        recomputed = sum(((x[labels == c] - x[labels == c].mean(axis=0)) ** 2).sum() for c in range(k))
        assert inertia == pytest.approx(recomputed, rel=1e-3), problem
        ratios.append(np.mean([inertia for _, inertia in found]) / np.mean(expected))
    report(f"kmeans: mean inertia {np.mean(ratios) - 1:+.4%} of scikit-learn's, {min(ratios) - 1:+.2%} to {max(ratios) - 1:+.2%}")
    assert np.mean(ratios) == pytest.approx(1, abs=1e-3)


def purity(truth, pred):
    return sum(np.unique(truth[pred == c], return_counts=True)[1].max() for c in np.unique(pred)) / len(truth)


METRICS = {
    "fowlkes_mallows": (svnet.fowlkes_mallows, metrics.fowlkes_mallows_score),
    "nmi, arithmetic": (svnet.normalized_mutual_info, metrics.normalized_mutual_info_score),
    "nmi, geometric": (
        lambda truth, pred: svnet.normalized_mutual_info(truth, pred, average="geometric"),
        lambda truth, pred: metrics.normalized_mutual_info_score(truth, pred, average_method="geometric"),
    ),
    "adjusted_rand": (svnet.adjusted_rand, metrics.adjusted_rand_score),
    "purity": (svnet.purity, purity),
}


@pytest.mark.parametrize("name", METRICS)
def test_metric(name, report):
    metric, oracle = METRICS[name]
    random = np.random.default_rng(3)
    largest = 0.0
    for problem in range(300):
        n = int(random.integers(1, 400))
        truth = random.integers(random.integers(1, n + 1), size=n)
        pred = np.where(random.random(n) < random.random(), random.integers(random.integers(1, n + 1), size=n), truth)
        difference = abs(metric(truth, pred) - oracle(truth, pred))
        assert difference < 1e-12, (problem, n)
        largest = max(largest, difference)
    report(f"{name}: largest difference {largest:.1e}")


def test_individual_fowlkes_mallows():
    random = np.random.default_rng(4)
    for problem in range(50):
        n = int(random.integers(1, 60))
        truth, pred = random.integers(6, size=n), random.integers(6, size=n)
        same_truth, same_pred = (a[:, None] == a for a in (truth, pred))
        others = ~np.eye(n, dtype=bool)
        tp = (same_truth & same_pred & others).sum(axis=1)
        pairs = (same_truth & others).sum(axis=1) * (same_pred & others).sum(axis=1)
        expected = np.divide(tp, np.sqrt(pairs), out=np.zeros(n), where=pairs > 0)
        assert np.abs(svnet.fowlkes_mallows_individual(truth, pred) - expected).max() < 1e-12, problem
