"""kill_run.py COUNT [SEED]: a small training run that is killed by SIGKILL COUNT times at random moments.

A run has all stages: features, scores, training, evaluation, report. After each kill every file under its final name
must be whole, and the same command goes on. When a run reaches its end, its model and scores must have the same bits as
those of a run that was never interrupted; then the next run begins. The moments are spread evenly over the time of a
whole run, beginning with the start of each process, so that they fall into every stage, and into the middle of epochs.
Afterwards SIGTERM at moments in every stage: the command must end with status 130 and a message, and the run goes on.

Ends with a line of figures, "N kills, ...", and exit 1 after the first failure, which keeps its folder.
"""
import collections
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from workplace import PROGRAMS, Workplace, grows, incomplete, is_temporary

# --open: evaluation and report too. There is no desktop, so no browser.
TRAIN = "svnet-train --open in/config.yaml --output out/run --set training.epochs=12 --set scores.problems=60000"
COMPARED = ("features-tiny_xception.h5", "scores.h5", "model.safetensors", "metrics.csv")
# The last file of a run that tells its stage, from the end on.
STAGES = (("report.html", "report"), ("evaluation.json", "evaluation"), ("model.safetensors", "after training"),
          ("checkpoint-last.safetensors", "training"), ("scores.h5", "before training"),
          ("features-tiny_xception.h5", "scores"), ("config.yaml", "features"))


class Killed:
    def __init__(self, folder, seed):
        self.place = Workplace(folder)
        self.random = random.Random(seed)
        self.run = self.place.out / "run"
        self.stages = collections.Counter()
        self.kills = self.runs = self.temporaries = self.outlived = 0

    def start(self):
        environment = {"SVNET_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "PATH": "/usr/bin:/bin"}
        program, *arguments = TRAIN.split()
        return subprocess.Popen([PROGRAMS / program, *arguments], cwd=self.place.folder, env=environment,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def to_end(self):
        """Runs to the end; the seconds that it takes."""
        begin = time.monotonic()
        process = self.start()
        said, _ = process.communicate(timeout=300)
        if process.returncode != 0:
            self.fail(f"ended with status {process.returncode}: {said}")
        return time.monotonic() - begin

    def fail(self, what):
        kept = tempfile.mkdtemp(prefix="svnet-killed-")
        shutil.copytree(self.place.folder, kept, dirs_exist_ok=True)
        print(f"after {self.kills} kills: {what}\nkept: {kept}")
        sys.exit(1)

    def results(self):
        return {name: (self.run / name).read_bytes() for name in COMPARED}

    def stage(self):
        return next((stage for file, stage in STAGES if (self.run / file).exists()), "start")

    def info(self, path):
        done = self.place.run(f"svnet-info {path}")
        return "" if done.returncode == 0 else f"{path}: {done.stderr}"

    def check_files(self):
        if not self.run.exists():
            return
        for path in sorted(self.run.rglob("*")):
            if not path.is_file():
                continue
            if is_temporary(path.relative_to(self.run)):
                self.temporaries += 1
            elif wrong := ("" if grows(str(path)) else incomplete(path, self.info)):
                self.fail(f"is partial: {wrong}")

    def check_whole(self, expected):
        for name, contents in self.results().items():
            if contents != expected[name]:
                self.fail(f"{name} differs from that of a run without a kill")
        # One stays as long as its process's number belongs to another process.
        self.outlived += len(list(self.run.rglob(".svnet-*")))
        self.runs += 1
        shutil.rmtree(self.run)

    def interrupt(self, how, after):
        """Whether the process was still there."""
        process = self.start()
        try:
            process.wait(timeout=after)
        except subprocess.TimeoutExpired:
            process.send_signal(how)
        said, _ = process.communicate(timeout=60)
        if how == signal.SIGTERM and process.returncode == 130:
            if "svnet-train:" not in said or "Traceback" in said:
                self.fail(f"SIGTERM without a message: {said!r}")
            return True
        if process.returncode == -how and (how == signal.SIGKILL or not said):  # or the program had not begun yet
            return True
        if process.returncode != 0:
            self.fail(f"ended with status {process.returncode}: {said}")
        return False


def main(count, seed):
    with tempfile.TemporaryDirectory(prefix="svnet-kills-") as folder:
        work = Killed(folder, seed)
        seconds = work.to_end()
        expected = work.results()
        shutil.rmtree(work.run)
        begin = time.monotonic()
        while work.kills < count:
            if work.interrupt(signal.SIGKILL, work.random.uniform(0, seconds)):
                work.kills += 1
                work.stages[work.stage()] += 1
                work.check_files()
            else:
                work.check_whole(expected)
        work.to_end()
        work.check_whole(expected)
        terms = collections.Counter()
        steps = max(6, min(60, count // 4))
        for step in range(steps):
            if work.interrupt(signal.SIGTERM, seconds * (step + 0.5) / steps):
                terms[work.stage()] += 1
                work.check_files()
                work.to_end()
            work.check_whole(expected)
        spread = ", ".join(f"{n} {stage}" for stage, n in sorted(work.stages.items()))
        print(f"{work.kills} kills ({spread}), {work.runs} whole runs with the bits of one without a kill, "
              f"{work.temporaries} temporary files met, {work.outlived} of them at the end of a run; SIGTERM: {sum(terms.values())} "
              f"({', '.join(f'{n} {stage}' for stage, n in sorted(terms.items()))}); "
              f"a run takes {seconds:.1f} s, all of it {time.monotonic() - begin:.0f} s")


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 1)
