#!/usr/bin/env python3
"""svnet's clustering problems beside scikit-learn's, on one core each, in turns, so that both see the same machine.

Usage: compare_clustering.py BENCH [--rounds N]. BENCH is the program svnet_semantics_bench; run this with a Python that has
NumPy and scikit-learn. Prints the least CPU time per problem of each side, and their ratio.

Problems are of the paper's size: 24 categories of 5 objects, 3 to 24 of them with 1 to 5 objects each in a problem, 40
images on average, 2048 features.
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


def problems(count):
    random = np.random.default_rng(0)
    centres = random.normal(size=(24, 2048)).astype(np.float32)
    for _ in range(count):
        chosen = random.permutation(24)[: random.integers(3, 25)]
        labels = np.repeat(chosen, random.integers(1, 6, size=len(chosen)))
        noise = random.normal(size=(len(labels), 2048)).astype(np.float32)
        yield centres[labels] + np.float32(1.5) * noise, labels


def ward(x, labels):
    fowlkes_mallows_score(labels, AgglomerativeClustering(len(set(labels))).fit_predict(x))


def kmeans(x, labels):
    KMeans(len(set(labels)), n_init=10).fit_predict(x)


def of_sklearn(solve, drawn):
    start = time.process_time()
    for x, labels in drawn:
        solve(x, labels)
    return (time.process_time() - start) / len(drawn)


def of_svnet(name):
    command = [args.bench, f"--benchmark_filter=problem/{name}/", "--benchmark_min_time=1", "--benchmark_format=json"]
    result = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["benchmarks"][0]
    return result["cpu_time"] * 1e-3 / int(result["name"].split("/")[2])


for name, solve, count in (("ward", ward, 200), ("kmeans", kmeans, 30)):
    drawn = list(problems(count))
    of_sklearn(solve, drawn[:5])
    pairs = [(of_sklearn(solve, drawn), of_svnet(name)) for _ in range(args.rounds)]
    theirs, ours = (min(side) for side in zip(*pairs))
    ratios = sorted(a / b for a, b in pairs)
    print(
        f"{name}: scikit-learn {theirs * 1e3:.2f} ms, svnet {ours * 1e6:.2f} us a problem and core: "
        f"{theirs / ours:.0f} times, {ratios[0]:.0f} to {ratios[-1]:.0f} by round",
        flush=True,
    )
