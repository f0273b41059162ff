"""table.py GCOVR_JSON [FOLDER]: lines and branches of each folder of src/ that ran; of each file below FOLDER."""
import collections
import json
import pathlib
import sys


def counts(file):
    """Lines run, lines, branches taken, branches. What gcov lists once for each instance of a template counts once: a
    line or branch is run if it is in one of them."""
    runs = collections.defaultdict(int)
    branches = collections.defaultdict(dict)
    for line in file["lines"]:
        if line.get("gcovr/noncode") or line.get("gcovr/excluded"):
            continue
        number = line["line_number"]
        runs[number] = max(runs[number], line["count"])
        for place, branch in enumerate(line["branches"]):
            if not branch.get("gcovr/excluded"):
                taken = branches[number]
                taken[place] = max(taken.get(place, 0), branch["count"])
    taken = [count for places in branches.values() for count in places.values()]
    return [sum(count > 0 for count in runs.values()), len(runs), sum(count > 0 for count in taken), len(taken)]


def share(part, whole):
    return f"{100 * part / whole:5.1f} %" if whole else "      -"


def main(path, below=None):
    sums = collections.defaultdict(lambda: [0, 0, 0, 0])
    for file in json.load(open(path))["files"]:
        name = pathlib.Path(file["file"])
        if below and not file["file"].startswith(below):
            continue
        folders = [str(name)] if below else [str(name.parent), "/".join(name.parts[:2]) + "/*", "all"]
        for folder in folders:
            for i, value in enumerate(counts(file)):
                sums[folder][i] += value
    print(f"{'folder':40} {'lines':>14} {'branches':>16}")
    for folder, (lines, all_lines, taken, branches) in sorted(sums.items()):
        print(f"{folder:40} {share(lines, all_lines)} {all_lines:6d} {share(taken, branches)} {branches:8d}")


if __name__ == "__main__":
    main(*sys.argv[1:3])
