"""Compares ten training steps with Keras: new recordings, replayed by the C++ test program."""
import os
import pathlib
import subprocess
import sys

import pytest


def test_ten_steps(tmp_path, report):
    program = pathlib.Path(os.environ["SVNET_BUILD"]) / "bin" / "replay_training_test"
    if not program.exists():
        pytest.fail(f"{program} is missing; build it (cmake --build {program.parents[1]} --target replay_training_test)")
    script = pathlib.Path(__file__).with_name("make_training_fixtures.py")
    subprocess.run([sys.executable, script, tmp_path, "--large"], check=True)
    replay = subprocess.run(
        [program], env=os.environ | {"SVNET_TRAINING_FIXTURES": str(tmp_path)}, capture_output=True, text=True
    )
    assert replay.returncode == 0, replay.stdout + replay.stderr
    lines = [line for line in replay.stdout.splitlines() if "largest" in line]
    assert len(lines) == 4, replay.stdout
    for line in lines:
        report(line)
