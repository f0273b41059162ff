#!/usr/bin/env python3
"""How much several views of an object help to sort objects, and how they are best joined.

Usage: compare_fusion.py NAME=FEATURES.h5... [--problems N] [--seed S]
FEATURES.h5: from svnet-features. PYTHONPATH has the module svnet; the Python that runs this needs NumPy and h5py.

A problem has 3 to 8 categories with 3 to 6 objects each. Every object is seen from V random camera poses, the same for all
objects. Printed is the mean Fowlkes-Mallows index of the groups, of as many as there are categories, by Ward:
  mean          of the features of an object's views
  concatenate   the features of its views, one after the other
  co-associate  every view clustered by itself, and the labellings joined
The share of exact estimates of the number of groups, and within one, is that of "mean".
"""
import argparse
import os

os.environ["SVNET_THREADS"] = "1"

import h5py
import numpy as np

import svnet

parser = argparse.ArgumentParser()
parser.add_argument("features", nargs="+")
parser.add_argument("--problems", type=int, default=1000)
parser.add_argument("--seed", type=int, default=0)
args = parser.parse_args()


def read(path):
    """Features, and the row of each camera pose of each object of each category."""
    with h5py.File(path) as file:
        features, paths = file["features"][:], file["paths"].asstr()[:]
    rows = {}
    for row, path in enumerate(paths):
        category, item, _, view = path.split("/")
        rows.setdefault(category, {}).setdefault(item, {}).setdefault(view.rsplit(".", 1)[0], row)
    return features, rows


for given in args.features:
    name, path = given.split("=", 1)
    features, rows = read(path)
    poses = sorted(set.intersection(*(set(views) for items in rows.values() for views in items.values())))
    print(f"{name}: {args.problems} problems, {len(poses)} camera poses; Fowlkes-Mallows; number of groups")
    for count in (1, 2, 3, 5):
        scores, errors = [], []
        for problem in range(args.problems):
            random = np.random.default_rng([args.seed, problem])
            chosen, truth = [], []
            for category in random.choice(sorted(rows), random.integers(3, min(8, len(rows)) + 1), replace=False):
                items = sorted(rows[category])
                for item in random.choice(items, min(random.integers(3, 7), len(items)), replace=False):
                    chosen.append(rows[category][item])
                    truth.append(category)
            views = random.choice(poses, count, replace=False)
            x = np.stack([features[[views_of[view] for views_of in chosen]] for view in views])  # (V, objects, D)
            k, mean = len(set(truth)), x.mean(axis=0)
            joined = {
                "mean": svnet.ward(mean, k),
                "concatenate": svnet.ward(np.concatenate(list(x), axis=1), k),
                "co-associate": svnet.co_association([svnet.ward(view, k) for view in x], k),
            }
            scores.append([svnet.fowlkes_mallows(truth, labels) for labels in joined.values()])
            errors.append(abs(svnet.group_count(mean) - k))
        text = ", ".join(f"{rule} {score:.3f}" for rule, score in zip(joined, np.mean(scores, axis=0)))
        exact, near = (100 * (np.array(errors) <= limit).mean() for limit in (0, 1))
        print(f"  {count} views: {text}; {exact:.1f} %, {near:.1f} %", flush=True)
