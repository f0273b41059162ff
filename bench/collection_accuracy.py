#!/usr/bin/env python3
"""Accuracy of k-nearest neighbours on the features of a collection, leaving one object out.

Usage: collection_accuracy.py FEATURES.h5 [--scores SCORES.h5] [--k N] [--confusions N]. svnet-features wrote FEATURES.h5,
and svnet-score wrote SCORES.h5 for the same views. The Python that runs this needs NumPy and h5py.

A view is assigned the most frequent category of its k nearest views (cosine) of all other objects; in a tie, the category
that comes first among the neighbours. Prints the accuracy of all views and of each elevation; with scores, also of the best
and the worst view of each pose, and of its best and worst third, by individual score. "among themselves": only views of the
same row are neighbours, as if a robot took one view of each object and sorted them. "among all": every view of the other
objects is a neighbour.
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

    def assigned(self, views, neighbours, k):
        """The category that the k nearest of `neighbours` assign to each of `views`."""
        alike = self.alike[np.ix_(views, neighbours)]
        order = np.argsort(-alike, axis=1, kind="stable")[:, :k]
        near = self.category[neighbours][order]
        votes = (near[:, :, None] == np.arange(len(self.names))).sum(axis=1)
        first = np.argmax(near[:, :, None] == np.arange(len(self.names)), axis=1)
        return np.lexsort((first, -votes), axis=1)[:, 0]

    def accuracy(self, views, neighbours, k):
        return np.mean(self.assigned(views, neighbours, k) == self.category[views])


def of_each_pose(collection, scores, chosen):
    """The views of each pose at the positions `chosen(count)`, in order of score from worst to best."""
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
    parser.add_argument("--confusions", type=int, default=0, help="print the N most frequent confusions of each category")
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
        assigned = collection.assigned(everything, everything, args.k)
        table = np.zeros((len(collection.names),) * 2, int)
        np.add.at(table, (collection.category, assigned), 1)
        for i in np.argsort(np.diag(table) / table.sum(axis=1)):
            wrong = [(table[i, j], collection.names[j]) for j in range(len(table)) if j != i and table[i, j]]
            worst = ", ".join(f"{name} {count}" for count, name in sorted(wrong, reverse=True)[: args.confusions])
            print(f"{collection.names[i]:14}{table[i, i] / table[i].sum():6.2f}   {worst}")


if __name__ == "__main__":
    main()
