"""TensorBoard reads the events of a training and of an evaluation, with the numbers of metrics.csv and evaluation.json."""
import csv
import io
import json
import os
import pathlib
import subprocess

import numpy as np
import pytest
from PIL import Image
from tensorboard.backend.event_processing.event_accumulator import EventAccumulator

CONFIG = """seed: 3
dataset:
  root: data
  held_out: [cube, ring]
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
  validation_categories: 1
evaluation:
  problems: 40
  pipelines: [tiny_xception_ward]
"""


def write_views(root):
    """Five categories of two objects in one pose, four views each."""
    random = np.random.default_rng(1)
    for category in ("ball", "cone", "cube", "disc", "ring"):
        level = random.uniform(50, 200, 3)
        for thing in "12":
            folder = root / category / thing / "1"
            folder.mkdir(parents=True)
            for view in ("90_90", "45_0", "45_90", "75_180"):
                pixels = np.clip(random.normal(level, 20, (24, 24, 3)), 0, 255).astype(np.uint8)
                Image.fromarray(pixels).save(folder / f"{view}.png")


@pytest.fixture(scope="module")
def run_folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("events")
    write_views(folder / "data")
    (folder / "config.yaml").write_text(CONFIG)
    programs = pathlib.Path(os.environ["SVNET_BUILD"]) / "bin"
    for command in (["svnet-train", "config.yaml", "--output", "run"], ["svnet-eval", "run"]):
        done = subprocess.run([programs / command[0], *command[1:]], cwd=folder, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
    return folder / "run"


@pytest.fixture(scope="module")
def events(run_folder):
    accumulator = EventAccumulator(str(run_folder), size_guidance={"images": 0, "scalars": 0})
    accumulator.Reload()
    return accumulator


def test_metrics_of_each_epoch(run_folder, events):
    rows = list(csv.DictReader((run_folder / "metrics.csv").open()))
    assert len(rows) == 3
    columns = [name for name in rows[0] if name not in ("epoch", "step")]
    assert "validation_spearman" in columns
    for name in columns:
        tag = name.replace("validation_", "validation/") if name.startswith("validation_") else f"training/{name}"
        scalars = events.Scalars(tag)
        assert [s.step for s in scalars] == [1, 2, 3]
        assert [s.value for s in scalars] == [np.float32(row[name]) for row in rows]


def test_tables(run_folder, events):
    tables = json.loads((run_folder / "evaluation.json").read_text())["tables"]
    for split, pipelines in tables.items():
        for pipeline, selectors in pipelines.items():
            for selector, metrics in selectors.items():
                for metric, value in metrics.items():
                    (scalar,) = events.Scalars(f"{split}/{pipeline}/{selector}/{metric}")
                    assert scalar.value == np.float32(value["mean"])


def test_half_spheres(events):
    (panel,) = events.Images("half-spheres of held-out objects: predicted and true scores")
    image = Image.open(io.BytesIO(panel.encoded_image_string))
    assert image.format == "PNG" and image.size == (panel.width, panel.height)
    assert np.asarray(image).std() > 0
