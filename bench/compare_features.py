#!/usr/bin/env python3
"""Times svnet-features and Python pipelines on folders of JPEG pictures, in turns, and prints a table.

The Python that runs this needs NumPy, h5py, Pillow, ONNX, ONNX Runtime, Keras with TensorFlow and, for pipelines opencv/...,
OpenCV. Every round runs svnet-features with SVNET_MAX_ISA=AVX2, svnet-features as it is, and each pipeline of
bench/feature_pipelines.py, all on the same files with the same random weights; odd rounds in the opposite order. Pipelines
may use whatever the machine has; with --cap-pipelines each also runs as on a processor with AVX2 (bench/avx2_only.c, Linux
on x86-64, needs a C compiler). Pictures a second are those of the whole command, and those after its start: less the
time until a pipeline's session is ready, or less that of svnet-features on a single picture.

    bench/compare_features.py                                drawn pictures of 640 x 480 pixels, all networks, 5 rounds
    bench/compare_features.py --images photographs --networks mobilenet_v2 --rounds 3
    bench/compare_features.py --results /tmp/results.jsonl   adds these rounds to those of earlier calls, if there are any

Features are checked: Pillow's pixels are svnet's, so pipelines pillow/... must agree within 1e-4 (relative, L2). Other
pixels give other features; of those the nearest row of svnet's must be that of the same picture, for most pictures.
"""
import argparse
import importlib.util
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
NAMES = {"vgg19": "VGG19", "xception": "Xception", "mobilenet_v2": "MobileNetV2"}
PICTURES = {"vgg19": 64, "xception": 64, "mobilenet_v2": 512}
PIPELINES = ["pillow/processes/spin", "opencv/processes/spin", "opencv-linear/threads/spin", "opencv-linear/threads/wait",
             "opencv-linear/processes/spin"]


def fail(text):
    sys.exit(f"compare_features.py: {text}")


def run(command, environment):
    """Returns the output and the seconds."""
    start = time.perf_counter()
    try:
        done = subprocess.run([str(word) for word in command], env=environment, capture_output=True, text=True, check=False)
    except OSError as error:
        fail(f"{command[0]}: cannot be run: {error.strerror}")
    seconds = time.perf_counter() - start
    if done.returncode != 0:
        last = (done.stderr.strip() or done.stdout.strip() or "no message").splitlines()[-1]
        fail(f"{' '.join(map(str, command))}: failed with status {done.returncode}: {last}")
    return done.stdout, seconds


def draw(path, seed):
    """A picture as a camera takes it: a shaded table, things with edges and texture, noise of the sensor."""
    import numpy as np
    from PIL import Image, ImageDraw, ImageFilter

    random = np.random.default_rng(seed)
    width, height = 640, 480
    image = Image.new("RGB", (width, height), tuple(int(v) for v in random.integers(60, 200, 3)))
    pen = ImageDraw.Draw(image)
    for _ in range(40):
        x, y = random.integers(0, width), random.integers(0, height)
        w, h = random.integers(10, 200, 2)
        shape = pen.ellipse if random.random() < 0.5 else pen.rectangle
        shape([int(x), int(y), int(x + w), int(y + h)], fill=tuple(int(v) for v in random.integers(0, 256, 3)))
    pixels = np.asarray(image.filter(ImageFilter.GaussianBlur(1)), np.float32)
    texture = random.normal(0, 12, (height // 4, width // 4, 1)).astype(np.float32).repeat(4, 0).repeat(4, 1)
    light = np.linspace(0.6, 1.1, width, dtype=np.float32)[None, :, None]
    pixels = pixels * light + texture + random.normal(0, 4, pixels.shape).astype(np.float32)
    Image.fromarray(np.clip(pixels, 0, 255).astype(np.uint8)).save(path, quality=90)


def drawn_folder(folder, count):
    """A dataset of `count` pictures in svnet's layout, 32 views a pose, drawn once."""
    if folder.exists():
        return folder
    unfinished = folder.with_name(folder.name + "-unfinished")
    for i in range(count):
        view = "90_90" if i % 32 == 0 else f"30_{11 * (i % 32)}"
        pose = unfinished / f"thing{i // 128}" / str(i // 32 % 4) / "0"
        pose.mkdir(parents=True, exist_ok=True)
        draw(pose / f"{view}.jpg", i)
    unfinished.rename(folder)
    return folder


def pictures_of(images):
    """The files in the order of svnet's rows is not known here; rows are matched by path."""
    files = sorted(path for path in images.rglob("*") if path.suffix.lower() in (".jpg", ".jpeg"))
    if not files:
        fail(f"{images}: has no JPEG files")
    return files


def single_picture(folder, file):
    """A dataset with this picture alone."""
    pose = folder / "thing" / "0" / "0"
    pose.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(file, pose / "90_90.jpg")
    return folder


class Network:
    """A network's weights, pictures and what runs are called with."""

    def __init__(self, options, name, images):
        self.options, self.name, self.images = options, name, images
        self.weights, self.model = (options.folder / f"{name}{end}" for end in (".weights.h5", ".onnx"))
        if not (self.weights.exists() and self.model.exists()):
            run([sys.executable, ROOT / "bench/feature_pipelines.py", "make", name, options.folder], dict(os.environ))
        self.files = pictures_of(images)
        self.list = options.folder / f"{name}.txt"
        self.list.write_text("".join(f"{file}\n" for file in self.files), encoding="utf-8")
        self.single = single_picture(options.folder / "single", self.files[0])
        self.output = options.folder / name
        Path(f"{self.output}.h5").unlink(missing_ok=True)  # of other pictures, maybe

    def svnet(self, isa):
        environment = {**os.environ, "SVNET_THREADS": str(self.options.threads)}
        environment.pop("SVNET_MAX_ISA", None)
        if isa:
            environment["SVNET_MAX_ISA"] = isa
        command = [self.options.svnet, "--backbone", self.name, "--weights", self.weights, "--images"]
        _, start = run([*command, self.single, "--output", f"{self.output}-single.h5"], environment)
        _, whole = run([*command, self.images, "--output", f"{self.output}.h5"], environment)
        return {"start": start, "whole": whole, "after": whole - start}

    def pipeline(self, name, preload=None):
        environment = {**os.environ, "LD_PRELOAD": str(preload)} if preload else dict(os.environ)
        output, whole = run([sys.executable, ROOT / "bench/feature_pipelines.py", "run", self.model, self.list, "--pipeline",
                             name, "--threads", self.options.threads, "--batch", self.options.batch, "--output",
                             f"{self.output}.npy"], environment)
        self.check(name)
        times = json.loads(output.splitlines()[-1])
        return {"start": times["start"], "whole": whole, "after": times["pictures"]}

    def check(self, name):
        """Compares the last rows of a pipeline with the last ones of svnet."""
        import h5py
        import numpy as np

        theirs = np.load(f"{self.output}.npy")
        with h5py.File(f"{self.output}.h5") as file:
            paths = [path.decode() if isinstance(path, bytes) else path for path in file["paths"]]
            ours = np.asarray(file["features"])
        row_of = {path: row for row, path in enumerate(paths)}
        ours = ours[[row_of[str(path.relative_to(self.images))] for path in self.files]]
        if self.name == "vgg19":  # (512, 7, 7) of ONNX, (7, 7, 512) of Keras
            theirs = theirs.reshape(-1, 512, 49).transpose(0, 2, 1).reshape(len(theirs), -1)
        difference = np.linalg.norm(theirs - ours) / np.linalg.norm(ours)
        if name.startswith("pillow"):
            if not difference <= 1e-4:
                fail(f"{self.name}, {name}: features differ by {difference:.2g} (relative, L2)")
            return
        centre = ours.mean(0)
        distances = ((theirs - centre) ** 2).sum(1)[:, None] + ((ours - centre) ** 2).sum(1) - 2 * (theirs - centre) @ (ours - centre).T
        same = (distances.argmin(1) == np.arange(len(ours))).mean()
        if same < 0.9:
            fail(f"{self.name}, {name}: only {100 * same:.0f} % of the pictures have the features of the same picture")


def stored(options):
    """The results of earlier calls."""
    if not options.results or not options.results.exists():
        return []
    return [json.loads(line) for line in options.results.read_text(encoding="utf-8").splitlines()]


def measure(options, networks):
    """One line of results per run: network, program, seconds."""
    lines = []
    earlier = len({line.get("round") for line in stored(options)})
    for number in range(options.rounds):
        for network in networks:
            turns = [("svnet, AVX2", lambda: network.svnet("AVX2")), ("svnet", lambda: network.svnet(None))]
            turns += [(name, lambda name=name: network.pipeline(name)) for name in options.pipelines]
            if options.preload:
                turns += [(name + ", AVX2", lambda name=name: network.pipeline(name, options.preload))
                          for name in options.pipelines]
            if not Path(f"{network.output}.h5").exists():
                network.svnet(None)  # pipelines are compared with it, and may come first
            for who, call in turns if (number + earlier) % 2 == 0 else reversed(turns):
                line = {"network": network.name, "who": who, "round": number + earlier, "pictures": len(network.files),
                        **call()}
                lines.append(line)
                print(f"round {number + 1}/{options.rounds}, {network.name}, {who}: "
                      f"{line['pictures'] / line['whole']:.4g} pictures a second, {line['pictures'] / line['after']:.4g} after a "
                      f"start of {line['start']:.2f} s", file=sys.stderr, flush=True)
                if options.results:
                    with options.results.open("a", encoding="utf-8") as file:
                        file.write(json.dumps(line) + "\n")
    return lines


def rate(lines, network, who, what):
    """The median over the rounds, in pictures a second."""
    values = [line["pictures"] / line[what] for line in lines if line["network"] == network and line["who"] == who]
    return statistics.median(values) if values else None


def best(lines, network, what, is_capped):
    """The name and the rate of the fastest pipeline."""
    names = {line["who"] for line in lines if line["network"] == network and not line["who"].startswith("svnet")}
    rates = {name: rate(lines, network, name, what) for name in names if name.endswith(", AVX2") == is_capped}
    return max(rates.items(), key=lambda item: item[1]) if rates else None


def table(lines):
    rows = []
    for what, title in (("after", "pictures a second, after the start"), ("whole", "pictures a second, whole command")):
        rows += [f"| {title} | rounds | svnet, AVX2 | svnet | best pipeline, not capped | best pipeline, AVX2 | svnet AVX2 / "
                 "pipeline not capped | svnet / pipeline, neither capped | svnet / pipeline, both AVX2 |",
                 "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"]
        for network in NAMES:
            free = best(lines, network, what, False)
            if free is None:
                continue
            capped = best(lines, network, what, True)
            own_capped, own = (rate(lines, network, who, what) for who in ("svnet, AVX2", "svnet"))
            rounds = sum(line["network"] == network and line["who"] == "svnet" for line in lines)
            cells = [f"{own_capped:.4g}", f"{own:.4g}", f"{free[1]:.4g} ({free[0]})",
                     f"{capped[1]:.4g} ({capped[0].removesuffix(', AVX2')})" if capped else "–",
                     f"{own_capped / free[1]:.2f}", f"{own / free[1]:.2f}",
                     f"{own_capped / capped[1]:.2f}" if capped else "–"]
            rows.append(f"| {NAMES[network]} | {rounds} | " + " | ".join(cells) + " |")
        rows.append("")
    rows += ["| pipeline, pictures a second after the start | " + " | ".join(NAMES.values()) + " |",
             "| --- " * (1 + len(NAMES)) + "|"]
    for who in dict.fromkeys(line["who"] for line in lines):
        rates = [rate(lines, network, who, "after") for network in NAMES]
        rows.append(f"| {who} | " + " | ".join("–" if r is None else f"{r:.4g}" for r in rates) + " |")
    return "\n".join(rows)


def library_for_avx2(folder):
    """Builds the library that hides AVX-512, and tries it."""
    library = folder / "avx2_only.so"
    run(["cc", "-O2", "-shared", "-fPIC", "-o", library, ROOT / "bench/avx2_only.c"], dict(os.environ))
    done = subprocess.run([sys.executable, "-c", ""], env={**os.environ, "LD_PRELOAD": str(library)}, check=False,
                          capture_output=True, text=True)
    if done.returncode != 0:
        fail(f"--cap-pipelines: {done.stderr.strip() or f'status {done.returncode}'}")
    return library


def check_modules(options):
    needed = ["numpy", "h5py", "PIL", "onnx", "onnxruntime", "keras", "tensorflow"]
    needed += ["cv2"] if any(name.startswith("opencv") for name in options.pipelines) else []
    missing = [name for name in needed if importlib.util.find_spec(name) is None]
    if missing:
        names = {"PIL": "pillow", "cv2": "opencv-python-headless"}
        fail(f"{sys.executable} lacks {', '.join(missing)}; install them there (pip install "
             f"{' '.join(names.get(name, name) for name in missing)}), or run this with a Python that has them")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--svnet", type=Path, default=ROOT / "build/release/bin/svnet-features", help="svnet-features")
    parser.add_argument("--images", type=Path, help="a dataset of JPEG pictures in svnet's layout (default: drawn ones)")
    parser.add_argument("--networks", nargs="+", choices=NAMES, default=list(NAMES), metavar="NETWORK")
    parser.add_argument("--pipelines", nargs="+", default=PIPELINES, metavar="PIPELINE",
                        help="see feature_pipelines.py --help")
    parser.add_argument("--cap-pipelines", action="store_true", help="also runs pipelines as on a processor with AVX2")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--batch", type=int, default=8, help="of the pipelines")
    parser.add_argument("--folder", type=Path, help="keeps weights and drawn pictures (default: a temporary folder)")
    parser.add_argument("--results", type=Path, help="lines of JSON, one for each run; the table is of the whole file")
    options = parser.parse_args()
    if options.rounds < 0:
        parser.error("--rounds must not be negative")
    check_modules(options)
    if not options.svnet.exists():
        fail(f"{options.svnet}: no such file; build svnet-features, or name it with --svnet")
    with tempfile.TemporaryDirectory() as temporary:
        options.folder = options.folder or Path(temporary)
        options.folder.mkdir(parents=True, exist_ok=True)
        options.preload = library_for_avx2(options.folder) if options.cap_pipelines else None
        networks = []
        for name in options.networks:
            count = PICTURES[name]
            networks.append(Network(options, name, options.images or drawn_folder(options.folder / f"drawn{count}", count)))
        lines = measure(options, networks)
    print(table(stored(options) if options.results else lines))


if __name__ == "__main__":
    main()
