#!/usr/bin/env python3
"""How often the estimated number of groups is right: svnet's rules, scikit-learn's silhouette, the gap statistic.

Usage: compare_group_counts.py NAME=FEATURES.h5... [--problems N] [--objects LOW HIGH] [--categories A,B,...] [--seed S]
FEATURES.h5: from svnet-features. PYTHONPATH has the module svnet; the Python that runs this needs NumPy, h5py, SciPy and
scikit-learn.

A problem has 3 to 8 categories with LOW to HIGH objects each (default 3 to 6, or as many as a category has) and one random
view of each object. Printed are the share of problems whose number of categories is estimated exactly and within one, and
the mean error. The last rule divides the number of objects by the mean number per category, which no user knows: it shows
how much the design of the problems gives away. Problems are split among processes.
"""
import argparse
import os

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "SVNET_THREADS"):
    os.environ[name] = "1"

import multiprocessing

import h5py
import numpy as np
from scipy.cluster.hierarchy import cut_tree, linkage
from scipy.spatial.distance import pdist, squareform
from sklearn.metrics import silhouette_score

import svnet


def read(path):
    """Features, and the rows of each object of each category."""
    with h5py.File(path) as file:
        features, paths = file["features"][:], file["paths"].asstr()[:]
    rows = {}
    for row, path in enumerate(paths):
        category, item = path.split("/")[:2]
        rows.setdefault(category, {}).setdefault(item, []).append(row)
    return features, rows


def draw(rows, objects, random):
    """The rows of one problem, and its number of categories."""
    names = sorted(rows)
    count = random.integers(3, min(8, len(names)) + 1)
    chosen = []
    for name in random.choice(names, count, replace=False):
        items = sorted(rows[name])
        wanted = min(int(random.integers(objects[0], objects[1] + 1)), len(items))
        chosen += [random.choice(rows[name][item]) for item in random.choice(items, wanted, replace=False)]
    return np.array(chosen), int(count)


def sklearn_silhouette(x):
    """argmax over k = 2 to n - 1 of silhouette_score of Ward's partitions."""
    distances = squareform(pdist(x))
    cuts = cut_tree(linkage(x, "ward"))
    scores = [silhouette_score(distances, cuts[:, -k], metric="precomputed") for k in range(2, len(x))]
    return 2 + int(np.argmax(scores))


def log_dispersions(x):
    """log W_k of Ward's partitions for k = 1 to n - 1: a merge at height h adds h^2 / 2."""
    return np.log(np.cumsum(linkage(x, "ward")[:, 2] ** 2) / 2)[::-1]


def gap_statistic(x, random, references=10):
    """Tibshirani, Walther and Hastie (2001), uniform references over the range of each feature: the smallest k with
    gap(k) >= gap(k + 1) - s(k + 1)."""
    low, high = x.min(axis=0), x.max(axis=0)
    drawn = np.stack([log_dispersions(random.uniform(low, high, x.shape)) for _ in range(references)])
    gap = drawn.mean(axis=0) - log_dispersions(x)
    error = drawn.std(axis=0) * np.sqrt(1 + 1 / references)
    stops = np.flatnonzero(gap[:-1] >= gap[1:] - error[1:])
    return 1 + int(stops[0] if len(stops) else np.argmax(gap))


def principal_components(x):
    """The same points in the axes of their principal components."""
    x = x - x.mean(axis=0)
    return x @ np.linalg.svd(x, full_matrices=False)[2].T


def height_and_silhouette(x):
    """The largest silhouette among the numbers within a third of svnet's height rule."""
    count = svnet.group_count(x, "height")
    distances = squareform(pdist(x))
    cuts = cut_tree(linkage(x, "ward"))
    numbers = range(max(2, int(np.ceil(count / 1.34))), min(len(x) - 1, int(count * 1.34)) + 1)
    scores = [silhouette_score(distances, cuts[:, -k], metric="precomputed") for k in numbers]
    return numbers[int(np.argmax(scores))] if scores else count


def normalised(x):
    return x / np.linalg.norm(x, axis=1, keepdims=True)


RULES = {
    "svnet height": lambda x, _: svnet.group_count(x, "height"),
    "svnet height, features of length 1": lambda x, _: svnet.group_count(normalised(x), "height"),
    "svnet height, average linkage": lambda x, _: svnet.group_count(x, "height", "average"),
    "svnet height, complete linkage": lambda x, _: svnet.group_count(x, "height", "complete"),
    "svnet height, then silhouette": lambda x, _: height_and_silhouette(x),
    "svnet silhouette": lambda x, _: svnet.group_count(x, "silhouette"),
    "svnet gap": lambda x, _: svnet.group_count(x, "gap"),
    "scikit-learn silhouette": lambda x, _: sklearn_silhouette(x),
    "gap statistic": lambda x, random: gap_statistic(x, random),
    "gap statistic, principal components": lambda x, random: gap_statistic(principal_components(x), random),
}


def errors(task):
    """The errors of every rule in problems [first, last)."""
    path, categories, objects, seed, first, last, mean_objects = task
    features, rows = read(path)
    if categories:
        rows = {name: rows[name] for name in categories}
    found = []
    for problem in range(first, last):
        random = np.random.default_rng([seed, problem])
        chosen, count = draw(rows, objects, random)
        x = features[chosen].astype(np.float64)
        estimates = [rule(x, random) for rule in RULES.values()]
        found.append([estimate - count for estimate in [*estimates, round(len(x) / mean_objects)]])
    return found


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("features", nargs="+")
    parser.add_argument("--problems", type=int, default=1000)
    parser.add_argument("--objects", type=int, nargs=2, default=(3, 6))
    parser.add_argument("--categories", default="")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--processes", type=int, default=2)
    args = parser.parse_args()
    categories = [name for name in args.categories.split(",") if name]
    mean_objects = sum(args.objects) / 2
    step = 25
    with multiprocessing.get_context("fork").Pool(args.processes) as pool:
        for given in args.features:
            name, path = given.split("=", 1)
            tasks = [
                (path, categories, args.objects, args.seed, first, min(first + step, args.problems), mean_objects)
                for first in range(0, args.problems, step)
            ]
            found = np.array(sum(pool.map(errors, tasks, chunksize=1), []))
            print(f"{name}: {len(found)} problems, {args.objects[0]} to {args.objects[1]} objects, exact, within 1, error")
            for rule, error in zip([*RULES, f"objects / {mean_objects:g}"], found.T):
                exact, near = (100 * (abs(error) <= limit).mean() for limit in (0, 1))
                print(f"  {rule:36} {exact:5.1f} % {near:5.1f} % {error.mean():+6.2f}", flush=True)


if __name__ == "__main__":
    main()
