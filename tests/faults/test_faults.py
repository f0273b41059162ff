"""Every command that writes, while one of its writes fails: fault_shim.c counts its calls, then each command runs again
with a fault at several of them. It must end with status 1 and name the file, or succeed with the whole output; leave
nothing partial under a final name and no temporary file; and succeed without the fault afterwards.

SVNET_FAULT_POSITIONS: at how many calls each kind of fault is tried (0: at all of them). SVNET_FAULT_SEED chooses them.
"""
import json
import os
import pathlib
import random
import re
import shutil

import pytest

from workplace import Workplace, grows, incomplete, is_temporary

SHIM = os.environ["SVNET_FAULT_SHIM"]
POSITIONS = int(os.environ.get("SVNET_FAULT_POSITIONS", "4"))
SEED = int(os.environ.get("SVNET_FAULT_SEED", "1"))
KINDS = ("enospc", "eio", "full", "short")

# Name: the command, and whether it needs the outputs of features, scores and training.
COMMANDS = {
    "features": ("svnet-features --quiet --backbone tiny_xception --images in/data --output out/features.h5", False),
    "score": ("svnet-score --quiet --features out/features.h5 --dataset in/data --output out/scores.h5 --problems 300", True),
    "train": ("svnet-train --quiet in/config.yaml --output out/run", False),
    "eval": ("svnet-eval --quiet out/run --json out/evaluation.json", True),
    "report": ("svnet-report --quiet out/run --output out/report.html", True),
    "export-onnx": ("svnet-export --quiet out/run/model.safetensors --onnx out/model.onnx", True),
    "export-keras": ("svnet-export --quiet out/run/model.safetensors --keras out/keras", True),
    "export-int8": ("svnet-export --quiet out/run/model.safetensors --safetensors out/small.safetensors --precision int8", True),
    "predict": ("svnet-predict --quiet out/run/model.safetensors --image in/top.png --json --plot out/plot.png", True),
    "sort": ("svnet-sort --quiet in/data --json out/sort.json --sheet out/sort.png --dendrogram out/tree.png", False),
    "views": ("svnet-views --quiet in/camera.json --centre 0.4 0 0.05 --diagonal 0.2 --json out/views.json --csv out/views.csv "
              "--plot out/views.png", False),
    "render": ("svnet-render --quiet --output out/rendered --categories pen --objects 1 --poses 1 --size 32", False),
}


class Bench:
    """Templates of out/, before and after each command."""

    def __init__(self, folder):
        self.place = Workplace(folder)
        self.count_file = pathlib.Path(folder) / "count"
        self.templates = {}
        for trained in (False, True):
            if trained:
                self.place.checked(COMMANDS["features"][0])
                self.place.checked(COMMANDS["train"][0])
                self.place.checked("svnet-eval --quiet out/run")
            template = pathlib.Path(folder) / f"template-{trained}"
            shutil.copytree(self.place.out, template)
            self.templates[trained] = template

    def prepare(self, trained):
        self.place.restore(self.templates[trained])
        return self.place.files()

    def info(self, path):
        """What svnet-info says against a file; it does not read checkpoints whole, and files in exports are not its own."""
        done = self.place.run(f"svnet-info {path}")
        return "" if done.returncode == 0 else f"{path}: {done.stderr}"


@pytest.fixture(scope="module")
def bench(tmp_path_factory):
    return Bench(tmp_path_factory.mktemp("faults"))


def name_without_time(path):
    return re.sub(r"tfevents\.\d+", "tfevents.TIME", path)


def differences(files, expected, volatile):
    """The paths that are in one listing only, or differ although they do not differ between any two runs."""
    def compared(listing):
        return {name_without_time(p): None if p in volatile or grows(p) else h for p, h in listing.items()}
    return sorted({path for path, _ in compared(files).items() ^ compared(expected).items()})


def problem_of(bench, done, kind, before, expected, volatile):
    """What a run with a fault did wrong; empty if nothing."""
    place = bench.place
    files = place.files()
    leftover = [p for p in files if is_temporary(p)] + [str(p) for p in place.out.rglob(".svnet-*")]
    if leftover:
        return f"left temporary files: {leftover}"
    for path, digest in files.items():
        if digest in (before.get(path), expected.get(path)) or grows(path):
            continue
        wrong = incomplete(place.out / path, bench.info)
        if wrong:
            return f"is partial: {wrong}"
    if done.returncode == 0:
        wrong = differences(files, expected, volatile)
        return f"succeeded, but its output is not whole: {wrong}" if wrong else ""
    if done.returncode != 1:
        return f"ended with {done.returncode}: {done.stderr}"
    if kind == "short":
        return f"failed after a short write: {done.stderr}"
    if "out/" not in done.stderr or len(done.stderr.strip().splitlines()) != 1:
        return f"does not name the file in one line: {done.stderr!r}"
    return ""


@pytest.mark.parametrize("name", COMMANDS)
def test_faults(bench, name):
    command, trained = COMMANDS[name]
    place = bench.place
    listings = []
    for _ in range(2):
        bench.prepare(trained)
        done = place.run(command, SHIM, SVNET_FAULT_COUNT=str(bench.count_file))
        assert done.returncode == 0, done.stderr
        listings.append(place.files())
    expected = listings[0]
    # Pages and tables that say when a run was and how long it took.
    volatile = {path for path in expected if path.endswith(("report.html", "timings.csv"))}
    assert not differences(listings[1], expected, volatile)
    calls = int(bench.count_file.read_text())
    assert calls > 0
    chosen = list(range(1, calls + 1))
    if POSITIONS and POSITIONS < calls:
        chosen = sorted(random.Random(f"{SEED} {name}").sample(chosen, POSITIONS))
    problems, failed, trials = [], 0, 0
    for kind in KINDS:
        for at in chosen:
            before = bench.prepare(trained)
            done = place.run(command, SHIM, SVNET_FAULT_AT=str(at), SVNET_FAULT_KIND=kind)
            trials += 1
            failed += done.returncode != 0
            problem = problem_of(bench, done, kind, before, expected, volatile)
            if not problem and done.returncode != 0:
                again = place.run(command)
                if again.returncode != 0:
                    problem = f"fails afterwards: {again.stderr}"
                elif wrong := differences(place.files(), expected, volatile):
                    problem = f"makes something else afterwards: {wrong}"
            if problem:
                problems.append(f"{kind} at call {at} of {calls}: {problem}")
    print(json.dumps({"command": name, "calls": calls, "faults": trials, "failed_cleanly": failed - len(problems)}))
    assert not problems, f"{len(problems)} of {trials}:\n" + "\n".join(problems)
