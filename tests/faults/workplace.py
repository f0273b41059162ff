"""Small inputs for every command that writes, made in a folder of their own, and whether files are complete."""
import hashlib
import json
import os
import pathlib
import shutil
import struct
import subprocess
import zlib

PROGRAMS = pathlib.Path(os.environ.get("SVNET_PROGRAMS", pathlib.Path(__file__).parents[2] / "build/dev/bin"))

CONFIG = """seed: 3
dataset:
  root: data
  held_out: [ring]
scores:
  backbone: tiny_xception
  problems: 300
  min_categories: 2
sv_net:
  backbone: tiny_xception
  width: 16
training:
  epochs: 3
  batch_size: 5
evaluation:
  problems: 40
  pipelines: [tiny_xception_ward]
"""

CAMERA = '{"width": 64, "height": 48, "fx": 60, "fy": 60, "cx": 31.5, "cy": 23.5}'


def png(height, width, pixel):
    """An RGB image; pixel(y, x) gives its three values."""
    rows = b"".join(b"\0" + bytes(v for x in range(width) for v in pixel(y, x)) for y in range(height))
    chunks = [(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)), (b"IDAT", zlib.compress(rows)), (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body)) for kind, body in chunks)


def write_dataset(root):
    """Four categories of two objects with one pose of four views: tests/train/small_dataset.h."""
    for number, category in enumerate(("ball", "cone", "cube", "ring")):
        for thing in range(2):
            folder = root / category / str(thing) / "1"
            folder.mkdir(parents=True)
            for view in ("90_90", "45_0", "45_90", "75_180"):
                def pixel(y, x):
                    at = y * 24 + x
                    lit = 150 if view.startswith("45") else 30
                    return [(at * (7 + c) + 31 * thing + at // 24 * 5) % 60 + (lit if c == number % 3 else number * 9)
                            for c in range(3)]
                (folder / f"{view}.png").write_bytes(png(24, 24, pixel))


class Workplace:
    """`folder`/in has the inputs, `folder`/out is where commands write. Commands run in `folder`."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder).resolve()
        self.out = self.folder / "out"
        inputs = self.folder / "in"
        inputs.mkdir()
        self.out.mkdir()
        write_dataset(inputs / "data")
        (inputs / "config.yaml").write_text(CONFIG)
        (inputs / "camera.json").write_text(CAMERA)
        (inputs / "top.png").write_bytes(png(40, 50, lambda y, x: [y * 5, x * 4, 200 if (y - 20) ** 2 + (x - 25) ** 2 < 90 else 20]))

    def run(self, command, shim=None, **environment):
        """Runs "svnet-… ARGUMENTS" with one thread. `shim`: the library of faults, which watches out/."""
        program, *arguments = command.split()
        variables = {**os.environ, "SVNET_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", **environment}
        if shim:
            variables |= {"LD_PRELOAD": str(shim), "SVNET_FAULT_FOLDER": str(self.out)}
        return subprocess.run([PROGRAMS / program, *arguments], cwd=self.folder, env=variables, capture_output=True,
                              text=True, timeout=120, check=False)

    def checked(self, command):
        done = self.run(command)
        assert done.returncode == 0, done.stderr
        return done

    def restore(self, template):
        """Makes out/ a copy of the template."""
        shutil.rmtree(self.out)
        shutil.copytree(template, self.out)

    def files(self):
        """The contents' hash of every file in out/, by its path."""
        return {str(path.relative_to(self.out)): hashlib.sha256(path.read_bytes()).hexdigest()
                for path in sorted(self.out.rglob("*")) if path.is_file()}


def is_temporary(path):
    return any(part.startswith(".svnet-") for part in pathlib.Path(path).parts)


def grows(path):
    """Files that are appended to, and may end anywhere after a crash."""
    return path.endswith(("log.txt", ".lock")) or "tfevents" in path


def incomplete(path, info):
    """What is wrong with a file that has its final name; empty if it is whole. `info`: runs svnet-info on a file."""
    contents = path.read_bytes()
    if path.suffix == ".json":
        try:
            json.loads(contents)
        except ValueError as error:
            return f"{path}: {error}"
    elif path.suffix == ".png":
        if not contents.endswith(b"IEND\xaeB`\x82"):
            return f"{path}: ends before its end"
    elif path.suffix == ".html":
        if not contents.rstrip().endswith(b"</html>"):
            return f"{path}: ends before its end"
    elif path.suffix in (".csv", ".yaml"):
        if not contents.endswith(b"\n"):
            return f"{path}: ends within a line"
    elif path.suffix in (".h5", ".safetensors"):
        return info(path)
    elif not grows(str(path)) and not contents:
        return f"{path}: is empty"
    return ""
