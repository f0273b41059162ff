"""svnet-export against ONNX Runtime, OpenCV and Keras: 200 pictures x 20 poses of a model, and every part of small ones."""
import importlib.util
import os
import pathlib
import subprocess

import numpy as np
import pytest

import svnet

BUILD = pathlib.Path(os.environ["SVNET_BUILD"])
MODELS = {name: BUILD / "tests" / f"{name}_model.safetensors" for name in ("small", "turned", "axis")}
BOUNDS = {"f32": (1e-5, 1.0), "bf16": (5e-3, 0.98), "int8": (2e-2, 0.95)}  # difference, share of equal best poses
POSES = np.array([((137.5 * i) % 360, 5 + 4.25 * i) for i in range(20)])


def export(model, *options):
    result = subprocess.run([BUILD / "bin" / "svnet-export", model, *options], capture_output=True, text=True)
    assert result.returncode == 0, result.stderr


@pytest.fixture(scope="module")
def pictures(drawings, shared_pictures):
    """uint8 (200, 96, 96, 3): parts of photographs if they are there, else of drawings."""
    return shared_pictures if shared_pictures is not None else crops(drawings)


def crops(images):
    random = np.random.default_rng(5)
    place = lambda: random.integers(0, images.shape[1] - 96)
    return np.stack([images[i % len(images), (y := place()) : y + 96, (x := place()) : x + 96] for i in range(200)])


@pytest.fixture(scope="module")
def shared_pictures(request):
    try:
        return crops(request.getfixturevalue("photographs"))
    except pytest.skip.Exception:
        return None


def onnx_runtime(path):
    import onnxruntime

    session = onnxruntime.InferenceSession(path)
    return lambda feed: session.run(None, feed)[0]


def opencv(path):
    import cv2

    net = cv2.dnn.readNetFromONNX(str(path))

    def run(feed):
        for name, value in feed.items():
            net.setInput(value, name)
        return net.forward()

    return run


RUNTIMES = {"ONNX Runtime": onnx_runtime, "OpenCV": opencv}


def check_agreement(report, what, precision, wanted, got):
    bound, share = BOUNDS[precision]
    difference = np.abs(wanted - got).max()
    same = (wanted.argmax(1) == got.argmax(1)).mean()
    report(f"{what}, {precision}: largest difference {difference:.1e} (bound {bound:g}), same best pose {same:.3f}")
    assert difference <= bound
    assert same >= share


@pytest.mark.parametrize("precision", BOUNDS)
@pytest.mark.parametrize("runtime", RUNTIMES)
def test_scores_of_onnx_exports(report, tmp_path, pictures, runtime, precision):
    path = tmp_path / "model.onnx"
    export(MODELS["small"], "--onnx", path, "--precision", precision, "--preprocessing")
    run, model, poses = RUNTIMES[runtime](path), svnet.Model.load(MODELS["small"]), POSES.astype(np.float32)
    wanted = np.stack([model.score(picture, POSES) for picture in pictures])
    got = np.stack([run({"image": p[None].astype(np.float32), "poses_deg": poses})[:, 0] for p in pictures])
    check_agreement(report, runtime, precision, wanted, got)


def test_scores_of_keras_exports(report, tmp_path, pictures):
    import keras

    folder = tmp_path / "keras"
    export(MODELS["small"], "--keras", folder, "--preprocessing")
    spec = importlib.util.spec_from_file_location("angles", folder / "angles.py")
    angles = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(angles)
    network, model = keras.saving.load_model(folder), svnet.Model.load(MODELS["small"])
    wanted = np.stack([model.score(picture, POSES) for picture in pictures])
    rows = np.repeat(pictures.astype(np.float32), len(POSES), axis=0)
    got = network.predict([rows, np.tile(angles.angles(POSES), (len(pictures), 1))], batch_size=200, verbose=0)
    check_agreement(report, "Keras", "f32", wanted, got.reshape(wanted.shape))


@pytest.mark.parametrize("precision", ["bf16", "int8"])
def test_scores_of_smaller_model_files(report, tmp_path, pictures, precision):
    path = tmp_path / "small.safetensors"
    export(MODELS["small"], "--safetensors", path, "--precision", precision)
    model, small = svnet.Model.load(MODELS["small"]), svnet.Model.load(path)
    wanted, got = (np.stack([m.score(picture, POSES) for picture in pictures]) for m in (model, small))
    check_agreement(report, "svnet", precision, wanted, got)


@pytest.mark.parametrize("opset", range(13, 18))
def test_the_checker_of_onnx_accepts_every_opset(tmp_path, opset):
    import onnx

    path = tmp_path / "model.onnx"
    export(MODELS["small"], "--onnx", path, "--opset", str(opset))
    onnx.checker.check_model(path, full_check=True)
    onnx_runtime(path)


@pytest.mark.parametrize("runtime", RUNTIMES)
def test_parts_compose_to_the_whole(tmp_path, pictures, runtime):
    backbone, head = tmp_path / "backbone.onnx", tmp_path / "head.onnx"
    export(MODELS["small"], "--onnx", backbone, "--part", "backbone", "--preprocessing")
    export(MODELS["small"], "--onnx", head, "--part", "head")
    features = RUNTIMES[runtime](backbone)({"image": pictures[:3].astype(np.float32)})
    score, model = RUNTIMES[runtime](head), svnet.Model.load(MODELS["small"])
    for picture, row in zip(pictures, features):
        got = score({"features": row[None].copy(), "poses_deg": POSES.astype(np.float32)})[:, 0]
        assert np.abs(got - model.score(picture, POSES)).max() < 1e-5


@pytest.mark.parametrize("runtime", RUNTIMES)
@pytest.mark.parametrize("name", ["turned", "axis"])
def test_heads_of_other_frames(tmp_path, name, runtime):
    import keras

    path, folder = tmp_path / "head.onnx", tmp_path / "keras"
    export(MODELS[name], "--onnx", path, "--part", "head")
    export(MODELS[name], "--keras", folder, "--part", "head")
    network = keras.saving.load_model(folder)
    inputs = np.random.default_rng(2).normal(size=(20, network.input_shape[1])).astype(np.float32)
    got, wanted = RUNTIMES[runtime](path)({"pose": inputs}), network.predict(inputs, verbose=0)
    assert np.abs(got - wanted).max() < 1e-6
