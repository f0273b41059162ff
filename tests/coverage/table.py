"""table.py JSON_OF_LLVM_COV [FOLDER]: lines and branches of each folder of src/ that ran; of each file below FOLDER,
with the lines of branches that did not."""
import collections
import json
import os
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def runs_of_lines(segments):
    """{line: how often it ran} of a file's segments (line, column, count, has a count, starts a region, is a gap)."""
    runs = {}
    wrapped = None
    by_line = collections.defaultdict(list)
    for segment in segments:
        by_line[segment[0]].append(segment)
    for line in range(min(by_line, default=1), max(by_line, default=0) + 1):
        starts = [s for s in by_line[line] if s[3] and s[4] and not s[5]]
        counts = [s[2] for s in starts]
        if wrapped is not None and wrapped[3]:
            counts.append(wrapped[2])
        if counts and not (by_line[line] and not by_line[line][0][3] and by_line[line][0][4]):
            runs[line] = max(counts)
        if by_line[line]:
            wrapped = by_line[line][-1]
    return runs


def compile_time_lines(path):
    """The lines whose conditions the compiler decides: llvm-cov counts neither outcome of them."""
    with open(path) as source:
        return {number for number, line in enumerate(source, 1) if "if constexpr" in line}


class Counts:
    """What ran of one file, which may be listed under several names, as ../src/a.cpp and src/a.cpp."""

    def __init__(self):
        self.runs = {}
        self.outcomes = collections.defaultdict(int)

    def add(self, file):
        for line, count in runs_of_lines(file["segments"]).items():
            self.runs[line] = max(self.runs.get(line, 0), count)
        decided = compile_time_lines(file["filename"])
        for line, column, _, end, true, false, *_ in file["branches"]:
            if line in decided:
                continue
            self.outcomes[line, column, end, True] += true
            self.outcomes[line, column, end, False] += false

    def values(self):
        """Lines run, lines, branches taken, branches."""
        return [sum(count > 0 for count in self.runs.values()), len(self.runs),
                sum(count > 0 for count in self.outcomes.values()), len(self.outcomes)]

    def missed(self):
        return sorted({place[0] for place, count in self.outcomes.items() if count == 0})


def share(part, whole):
    return f"{100 * part / whole:5.1f} %" if whole else "      -"


def main(path, below=None):
    files = collections.defaultdict(Counts)
    for file in json.load(open(path))["data"][0]["files"]:
        name = os.path.relpath(os.path.normpath(file["filename"]), ROOT)
        if name.startswith(below or "src/"):
            files[name].add(file)
    sums = collections.defaultdict(lambda: [0, 0, 0, 0])
    for name, counts in files.items():
        folder = str(pathlib.Path(name).parent)
        for key in [name] if below else [folder, "/".join(folder.split("/")[:2]) + "/*", "all"]:
            sums[key] = [a + b for a, b in zip(sums[key], counts.values())]
    print(f"{'folder':40} {'lines':>14} {'branches':>16}")
    for folder, (run, all_lines, taken, branches) in sorted(sums.items()):
        print(f"{folder:40} {share(run, all_lines)} {all_lines:6d} {share(taken, branches)} {branches:8d}",
              *files[folder].missed() if below else [])


if __name__ == "__main__":
    main(*sys.argv[1:3])
