#!/usr/bin/env python3
"""Sorts tables of objects that no model has seen: svnet-simulate-sorting with the model of every fold of a
cross-validation, on the categories that the fold held out. Pools the tables of all folds.

    bench/sorting_folds.py RUN DATASET [--program FILE] [--tables N] [OPTION of svnet-simulate-sorting]...

RUN is a folder that svnet-crossval made of DATASET. Prints the means of a table, and how many objects fewer are wrong
than with the top view: its 95 % interval over tables (bootstrap), and over folds (Student's t), which also knows that
other categories would give another result.
"""
import argparse
import json
import math
import pathlib
import random
import statistics
import subprocess

REPLICATES = 2000
T_975 = {2: 4.303, 3: 3.182, 4: 2.776, 5: 2.571, 6: 2.447, 7: 2.365, 8: 2.306, 9: 2.262}  # by degrees of freedom


def interval_over_tables(values):
    draw = random.Random(0)
    means = sorted(statistics.fmean(draw.choices(values, k=len(values))) for _ in range(REPLICATES))
    return means[round(0.025 * REPLICATES)], means[round(0.975 * REPLICATES) - 1]


def interval_over_folds(means):
    mean = statistics.fmean(means)
    if len(means) - 1 not in T_975:
        return math.nan, math.nan
    half = T_975[len(means) - 1] * statistics.stdev(means) / math.sqrt(len(means))
    return mean - half, mean + half


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", type=pathlib.Path)
    parser.add_argument("dataset")
    parser.add_argument("--program", default="svnet-simulate-sorting")
    parser.add_argument("--tables", type=int, default=200, help="of all folds together")
    options, others = parser.parse_known_args()
    models = sorted(options.run.glob("fold-*/model.safetensors"))
    if not models:
        parser.error(f"{options.run}: has no fold-*/model.safetensors")
    folds = []
    for number, model in enumerate(models):
        tables = (options.tables + len(models) - 1 - number) // len(models)
        command = [options.program, options.dataset, "--model", model, "--tables", str(tables), "--json", "-", *others]
        folds.append(json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout))

    tables = [table["wrong_objects"] for fold in folds for table in fold["tables"]]
    print(f"{len(tables)} tables of {len(folds)} folds")
    print(f"{'views':10} {'wrong':>6} {'moves':>6} {'seconds':>8}   fewer wrong than top (tables; folds)   of each fold")
    for row, first in enumerate(folds[0]["selectors"]):
        name = first["name"]
        weighted = [(fold["selectors"][row], len(fold["tables"])) for fold in folds]
        moves, seconds = (sum(r[key] * n for r, n in weighted) / len(tables) for key in ("moves", "seconds"))
        fewer = [table["top"] - table[name] for table in tables]
        of_folds = [r["fewer_wrong_than_top"]["mean"] for r, _ in weighted]
        low, high = interval_over_tables(fewer)
        fold_low, fold_high = interval_over_folds(of_folds)
        print(
            f"{name:10} {statistics.fmean(table[name] for table in tables):6.2f} {moves:6.1f} {seconds:8.1f}   "
            f"{statistics.fmean(fewer):+.2f} ({low:+.2f} to {high:+.2f}; {fold_low:+.2f} to {fold_high:+.2f})   "
            + " ".join(f"{mean:+.2f}" for mean in of_folds)
        )


if __name__ == "__main__":
    main()
