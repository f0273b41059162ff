#!/usr/bin/env python3
"""Times clustering problems with svnet and with scikit-learn, on one core, in turns.

Usage: compare_clustering.py BENCH [--rounds N]. BENCH is the program svnet_semantics_bench. The Python that runs this needs
NumPy and scikit-learn. Prints the least CPU time per problem of both, and their ratio.

Both draw a problem, cluster it, and compute its global and individual scores. Problems are drawn from 7,560 views
(24 categories of 5 objects in 3 poses of 21 views, 2048 features): 3 to 24 categories with 1 to 5 objects each, 40 views on
average.
"""
import argparse
import json
import os
import subprocess
import time

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

import numpy as np
from sklearn.cluster import AgglomerativeClustering, KMeans
from sklearn.metrics import fowlkes_mallows_score

parser = argparse.ArgumentParser()
parser.add_argument("bench")
parser.add_argument("--rounds", type=int, default=5)
args = parser.parse_args()


CATEGORIES, OBJECTS, POSES, VIEWS, FEATURES = 24, 5, 3, 21, 2048
random = np.random.default_rng(0)
features = np.empty((CATEGORIES, OBJECTS * POSES * VIEWS, FEATURES), np.float32)
for of_category in features:
    centre = random.normal(size=FEATURES).astype(np.float32)
    of_category[:] = centre + np.float32(1.5) * random.standard_normal(of_category.shape, np.float32)
features = features.reshape(-1, FEATURES)


def draw():
    """The rows of one problem and the category of each."""
    categories = random.permutation(CATEGORIES)[: random.integers(3, CATEGORIES + 1), None]
    objects = random.random((len(categories), OBJECTS)).argsort(axis=1)
    pose, view = random.integers(POSES, size=objects.shape), random.integers(VIEWS, size=objects.shape)
    rows = ((categories * OBJECTS + objects) * POSES + pose) * VIEWS + view
    chosen = np.arange(OBJECTS) < random.integers(1, OBJECTS + 1, size=categories.shape)
    return rows[chosen], np.broadcast_to(categories, rows.shape)[chosen]


def individual_fowlkes_mallows(labels, predicted):
    alike, together = labels[:, None] == labels, predicted[:, None] == predicted
    both = (alike & together).sum(axis=1) - 1
    return both / np.sqrt(np.maximum((alike.sum(axis=1) - 1) * (together.sum(axis=1) - 1), 1))


def ward(x, clusters):
    return AgglomerativeClustering(clusters).fit_predict(x)


def kmeans(x, clusters):
    return KMeans(clusters, n_init=10).fit_predict(x)


def of_sklearn(cluster, count):
    start = time.process_time()
    for _ in range(count):
        rows, labels = draw()
        predicted = cluster(features[rows], len(set(labels)))
        fowlkes_mallows_score(labels, predicted)
        individual_fowlkes_mallows(labels, predicted)
    return (time.process_time() - start) / count


def of_svnet(name):
    command = [args.bench, f"--benchmark_filter=problem/{name}/", "--benchmark_min_time=1", "--benchmark_format=json"]
    result = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["benchmarks"][0]
    return result["cpu_time"] * 1e-3 / int(result["name"].split("/")[2])


for name, cluster, count in (("ward", ward, 500), ("kmeans", kmeans, 50)):
    of_sklearn(cluster, 5)
    pairs = [(of_sklearn(cluster, count), of_svnet(name)) for _ in range(args.rounds)]
    theirs, ours = (min(side) for side in zip(*pairs))
    ratios = sorted(a / b for a, b in pairs)
    print(
        f"{name}: scikit-learn {theirs * 1e3:.2f} ms, svnet {ours * 1e6:.2f} us a problem and core: "
        f"{theirs / ours:.0f} times, {ratios[0]:.0f} to {ratios[-1]:.0f} by round",
        flush=True,
    )
