#!/usr/bin/env python3
"""How well k-nearest neighbours tell the categories of a collection, by its features: leave one object out.

Usage: collection_accuracy.py FEATURES.h5 [--scores SCORES.h5] [--k N] [--confusions N]. FEATURES.h5 is svnet-features' file,
SCORES.h5 svnet-score's of the same views; run this with a Python that has NumPy and h5py.

A view is called by the majority of the k nearest views (cosine) of all other objects, the nearest one where votes are
equal. Prints the accuracy of all views and of each elevation; with scores, of the best and the worst view of each pose and of the
best and the worst third, by their individual score. "among themselves" has only such views for neighbours, as when a
robot takes one view of each object and sorts what it took; "among all" has every view of the other objects.
"""
import argparse

import h5py
import numpy as np


def decoded(paths):
    return [path.decode() if isinstance(path, bytes) else path for path in paths]


class Collection:
    def __init__(self, features, paths):
        features = features - features.mean(axis=0)
        features /= np.linalg.norm(features, axis=1, keepdims=True)
        parts = [path.split("/") for path in paths]
        self.names, self.category = np.unique([part[0] for part in parts], return_inverse=True)
        self.object = np.unique(["/".join(part[:2]) for part in parts], return_inverse=True)[1]
        self.pose = np.unique(["/".join(part[:3]) for part in parts], return_inverse=True)[1]
        self.elevation = np.array([int(part[-1].split("_")[0]) for part in parts])
        self.alike = features @ features.T
        self.alike[self.object[:, None] == self.object] = -np.inf

    def called(self, views, neighbours, k):
        """The category that each of `views` is called by its k nearest among `neighbours`."""
        alike = self.alike[np.ix_(views, neighbours)]
        order = np.argsort(-alike, axis=1, kind="stable")[:, :k]
        near = self.category[neighbours][order]
        votes = (near[:, :, None] == np.arange(len(self.names))).sum(axis=1)
        first = np.argmax(near[:, :, None] == np.arange(len(self.names)), axis=1)
        return np.lexsort((first, -votes), axis=1)[:, 0]

    def accuracy(self, views, neighbours, k):
        return np.mean(self.called(views, neighbours, k) == self.category[views])


def of_each_pose(collection, scores, chosen):
    """The views at the places `chosen`(count) of each pose, ordered by score from the worst to the best."""
    rows = []
    for pose in range(collection.pose.max() + 1):
        views = np.flatnonzero(collection.pose == pose)
        rows.extend(views[np.argsort(scores[views], kind="stable")][chosen(len(views))])
    return np.array(rows)


def main():
    parser = argparse.ArgumentParser(description="Leave-one-object-out accuracy of k-nearest neighbours.")
    parser.add_argument("features")
    parser.add_argument("--scores")
    parser.add_argument("--k", type=int, default=5)
    parser.add_argument("--confusions", type=int, default=0, help="print so many of the most frequent")
    args = parser.parse_args()
    with h5py.File(args.features) as file:
        paths = decoded(file["paths"][:])
        collection = Collection(file["features"][:].astype(np.float64), paths)
    everything = np.arange(len(paths))
    print(f"{len(collection.names)} categories, {collection.object.max() + 1} objects, {len(paths)} views, k = {args.k}")

    kinds = [("all views", everything)]
    kinds += [(f"elevation {e}", np.flatnonzero(collection.elevation == e)) for e in np.unique(collection.elevation)]
    if args.scores:
        with h5py.File(args.scores) as file:
            score_of = dict(zip(decoded(file["paths"][:]), file["individual"][:]))
        scores = np.array([score_of[path] for path in paths])
        for name, chosen in [
            ("best view of each pose", lambda n: slice(n - 1, n)),
            ("best third", lambda n: slice(n - n // 3, n)),
            ("worst third", lambda n: slice(0, n // 3)),
            ("worst view of each pose", lambda n: slice(0, 1)),
        ]:
            kinds.append((name, of_each_pose(collection, scores, chosen)))
    print(f"{'':28}{'among themselves':>18}{'among all':>12}{'views':>8}")
    for name, views in kinds:
        print(f"{name:28}{collection.accuracy(views, views, args.k):18.3f}"
              f"{collection.accuracy(views, everything, args.k):12.3f}{len(views):8d}")
    if args.confusions:
        called = collection.called(everything, everything, args.k)
        table = np.zeros((len(collection.names),) * 2, int)
        np.add.at(table, (collection.category, called), 1)
        for i in np.argsort(np.diag(table) / table.sum(axis=1)):
            wrong = [(table[i, j], collection.names[j]) for j in range(len(table)) if j != i and table[i, j]]
            worst = ", ".join(f"{name} {count}" for count, name in sorted(wrong, reverse=True)[: args.confusions])
            print(f"{collection.names[i]:14}{table[i, i] / table[i].sum():6.2f}   {worst}")


if __name__ == "__main__":
    main()
