import copy
import os
import pathlib
import pickle

import numpy as np
import pytest

import svnet

POSES = [[0, 45], [90, 60], [200.5, 75], [-45, 0], [90, 90]]


@pytest.fixture(scope="module")
def path():
    return os.environ["SVNET_SMALL_MODEL"]  # the build writes it


@pytest.fixture(scope="module")
def model(path):
    return svnet.Model.load(path)


@pytest.fixture(scope="module")
def image():
    return np.random.default_rng(7).integers(256, size=(70, 50, 3), dtype=np.uint8)


@pytest.fixture(scope="module")
def expected(model, image):
    return model.score(image, POSES)


def test_scores(model, image, expected):
    assert expected.shape == (5,) and expected.dtype == np.float32
    assert ((expected > 0) & (expected < 1)).all() and len(set(expected.tolist())) == 5
    assert (model.score(image[::-1], POSES) != expected).any()
    assert repr(model).startswith("<svnet.Model, ")


def test_each_pose_has_its_score(model, image, expected):
    for pose, score in zip(POSES, expected):
        np.testing.assert_allclose(model.score(image, [pose]), [score], atol=1e-6)
    np.testing.assert_allclose(model.score(image, POSES[::-1]), expected[::-1], atol=1e-6)
    many = model.score(image, POSES * 700)  # more than are scored at once
    np.testing.assert_allclose(many, np.tile(expected, 700), atol=1e-6)


def test_best_view(model, image, expected):
    index, scores = model.best_view(image, POSES)
    assert isinstance(index, int) and index == expected.argmax()
    assert scores.tobytes() == expected.tobytes()
    assert model.best_view(image, [POSES[1], POSES[1]])[0] == 0


def test_best_views_differ(model, image):
    grid = svnet.pose_grid(24, 7, lowest_phi_deg=10, highest_phi_deg=90)
    scores = model.score(image, grid)
    indices, best = model.best_views(image, grid, 4, min_angle_deg=35)
    assert indices.dtype == np.int64 and best.dtype == np.float32 and len(indices) == 4
    assert best.tobytes() == scores[indices].tobytes() and indices[0] == scores.argmax()
    theta, phi = np.radians(grid).T
    directions = np.stack([np.cos(phi) * np.cos(theta), np.cos(phi) * np.sin(theta), np.sin(phi)], axis=1)
    angles = np.degrees(np.arccos(np.clip(directions @ directions.T, -1, 1)))
    chosen = [scores.argmax()]
    while len(chosen) < 4:
        nearest = angles[:, chosen].min(axis=1)
        value = scores + scores.std(dtype=float) * np.minimum(nearest, 90) / 90
        value[nearest < 35 - 1e-4] = -np.inf
        chosen.append(value.argmax())
    assert indices.tolist() == chosen
    assert sorted(model.best_views(image, grid, k=10**6)[0]) == list(range(len(grid)))
    with pytest.raises(svnet.Error, match="k"):
        model.best_views(image, grid, 0)
    with pytest.raises(svnet.Error, match=r"the views are to differ by 181 degrees, expected 0 to 180"):
        model.best_views(image, grid, 2, min_angle_deg=181)


def test_gain_is_not_known_in_the_frame_camera(model, image):
    with pytest.raises(svnet.Error, match="does not say what moving the camera gains"):
        model.gain(image, POSES)


def test_the_next_view_is_not_known_to_a_model_that_has_not_learned_it(model, image):
    assert model.knows_next_view is False
    with pytest.raises(svnet.Error, match="it must be trained with sv_net.next_view: ridge"):
        model.next_view(image, [(45, 60, image)], POSES)


def test_margin(model, image, expected):
    top = model.score(image, [[90, 90]])[0]
    np.testing.assert_allclose(model.margin(image, POSES), expected.max() - top, atol=1e-6)
    assert model.margin(image, [[90, 90]]) == 0


def test_pose_grid():
    grid = svnet.pose_grid(4, 3, 30, 90)
    assert grid.dtype == np.float64 and grid.shape == (9, 2)
    assert grid[:5].tolist() == [[0, 30], [90, 30], [180, 30], [270, 30], [0, 60]]
    assert grid[-1].tolist() == [90, 90]
    with pytest.raises(svnet.Error, match="a grid of 0 theta steps, expected 1 to 3600"):
        svnet.pose_grid(theta_steps=0)


def test_a_whole_turn_changes_nothing(model, image):
    assert len(set(model.score(image, [[-270, 45], [90, 45], [450, 45]]).tolist())) == 1


def test_strides(model, image, expected):
    bgr = np.ascontiguousarray(image[..., ::-1])
    padded = np.zeros((140, 60, 4), np.uint8)
    padded[::2, 5:55, :3] = image
    for same in (np.asfortranarray(image), bgr[..., ::-1], padded[::2, 5:55, :3], image[::-1, ::-1][::-1, ::-1]):
        assert model.score(same, POSES).tobytes() == expected.tobytes()
    read_only = image.copy()
    read_only.flags.writeable = False
    assert model.score(read_only, np.asfortranarray(POSES)).tobytes() == expected.tobytes()


@pytest.mark.parametrize("size", [(1, 1), (1, 300), (300, 1), (32, 32), (500, 641)])
def test_any_size(size, model):
    assert np.isfinite(model.score(np.full((*size, 3), 200, np.uint8), POSES)).all()


@pytest.mark.parametrize("dtype", ["i2", "u2", ">i4", "i8", "f2", "f4", ">f8", "g"])
def test_every_number_dtype_of_angles_means_the_same(dtype, model, image):
    angles = np.array([[0, 45], [90, 60]])
    assert model.score(image, angles.astype(dtype)).tobytes() == model.score(image, angles).tobytes()


@pytest.mark.parametrize("n", [2, 3])
def test_number_of_threads_does_not_matter(n, model, image, expected, threads):
    threads(n)
    assert model.score(image, POSES).tobytes() == expected.tobytes()


@pytest.mark.parametrize(
    "given, message",
    [
        (lambda image: image.astype(np.float32) / 255, "image has dtype float32; expects uint8, grey levels"),
        (lambda image: image.astype(np.int8), "image has dtype int8; expects uint8"),
        (lambda image: image[None], r"image has shape \(1, 70, 50, 3\); .*; pass one image at a time"),
        (lambda image: image[..., 0], r"image has shape \(70, 50\); expects \(H, W, 3\), RGB"),
        (lambda image: np.dstack([image, image])[..., :4], r"image has shape \(70, 50, 4\)"),
        (lambda image: image.transpose(2, 0, 1), r"image has shape \(3, 70, 50\)"),
        (lambda image: image[:0], r"image has shape \(0, 50, 3\), no pixels"),
        (lambda image: image[:, :0], r"image has shape \(70, 0, 3\), no pixels"),
        (lambda image: None, "image has dtype object"),
        (lambda image: [[1, 2], [3]], "image is not an array"),
    ],
)
@pytest.mark.parametrize("function", ["score", "best_view"])
def test_images_that_are_refused(function, given, message, model, image):
    with pytest.raises(svnet.Error, match=rf"^\[Model\.{function}\] {message}") as error:
        getattr(model, function)(given(image), POSES)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    "angles, message",
    [
        ([], r"angles_deg has shape \(0,\); expects \(M, 2\), theta and phi of each pose in degrees, and at least one"),
        (np.zeros((0, 2)), r"angles_deg has shape \(0, 2\); .* at least one"),
        ([0, 45], r"angles_deg has shape \(2,\); expects \(M, 2\)"),
        ([[0, 45, 1]], r"angles_deg has shape \(1, 3\)"),
        ([[0, 45], [0, np.nan]], r"angles_deg\[1\]: phi nan is not finite"),
        ([[np.inf, 45]], r"angles_deg\[0\]: theta inf is not finite"),
        ([[0, -1]], r"angles_deg\[0\]: phi -1 is outside \[0, 90\] degrees"),
        ([[0, 90.5]], r"angles_deg\[0\]: phi 90.5 is outside"),
        ([[721, 45]], r"angles_deg\[0\]: theta 721 is outside \[-360, 720\] degrees"),
        ([["0", "45"]], "angles_deg has dtype <U2; expects integers or floats"),
        ([[0, 45], [1]], "angles_deg is not an array"),
        ([[0j, 45]], "angles_deg has dtype complex128"),
        (None, "angles_deg has dtype object"),
    ],
)
@pytest.mark.parametrize("function", ["score", "best_view"])
def test_angles_that_are_refused(function, angles, message, model, image):
    with pytest.raises(svnet.Error, match=rf"^\[Model\.{function}\] {message}") as error:
        getattr(model, function)(image, angles)
    assert "\n" not in str(error.value)


def test_files_that_are_refused(path, tmp_path):
    with open(path, "rb") as file:
        contents = file.read()
    missing, cut, text = tmp_path / "missing", tmp_path / "cut", tmp_path / "text"
    cut.write_bytes(contents[:-1])
    text.write_text("not a model")
    for file in (missing, cut, text, tmp_path):
        for given in (file, str(file), os.fsencode(file)):
            with pytest.raises(svnet.Error, match=file.name):
                svnet.Model.load(given)
    with pytest.raises(svnet.Error, match=r"\[Model.load\] path is 5; expects a path"):
        svnet.Model.load(5)
    with pytest.raises(svnet.Error, match=r"\[Model.load\] path is .*expects a path"):
        svnet.Model.load("model\0.safetensors")
    for given in (b"caf\xe9.safetensors", os.fsdecode(b"caf\xe9.safetensors")):
        with pytest.raises(svnet.Error, match=r"caf\\xe9\.safetensors"):
            svnet.Model.load(given)


def test_a_model_is_made_by_load_only():
    class Derived(svnet.Model):
        pass

    for make in (svnet.Model, Derived, lambda: svnet.Model.__new__(svnet.Model), lambda: Derived.__new__(Derived)):
        with pytest.raises(TypeError, match="svnet.Model.load"):
            make()
    for base in (object, svnet.Model.__base__):
        with pytest.raises(TypeError):
            base.__new__(svnet.Model)


def test_a_model_outlives_its_file(path, tmp_path, image, expected):
    copy = tmp_path / "model.safetensors"
    with open(path, "rb") as file:
        copy.write_bytes(file.read())
    model = svnet.Model.load(copy)
    copy.unlink()
    assert model.score(image, POSES).tobytes() == expected.tobytes()


def test_a_model_is_shared_between_threads(model, image, expected):
    from concurrent.futures import ThreadPoolExecutor

    with ThreadPoolExecutor(4) as pool:
        results = list(pool.map(lambda _: model.score(image, POSES).tobytes(), range(24)))
    assert set(results) == {expected.tobytes()}


def test_interrupt_ends_a_long_computation(model, image):
    import signal
    import threading

    threading.Timer(0.1, lambda: signal.raise_signal(signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        for _ in range(100000):
            model.score(image, POSES * 20000)


def test_pickle_stores_the_file(path, model, image, expected, tmp_path):
    copied = tmp_path / "model.safetensors"
    copied.write_bytes(pathlib.Path(path).read_bytes())
    stored = pickle.dumps(svnet.Model.load(copied))
    copied.unlink()
    assert pickle.loads(stored).score(image, POSES).tobytes() == expected.tobytes()
    assert copy.deepcopy(model).score(image, POSES).tobytes() == expected.tobytes()
    with pytest.raises(svnet.Error, match="pickled model: "):
        pickle.loads(stored.replace(b'"backbone', b'"backbome', 1))


def test_angles_out_of_range_by_rounding(model, image):
    inside = model.score(image, [[720, 90], [-360, 0]])
    for outside in ([[720.00005, 90.0000025], [-360.00005, -0.00005]], np.nextafter(np.float32([[720, 90], [-360, 0]]), np.float32([[800, 91], [-400, -1]]))):
        assert model.score(image, outside).tobytes() == inside.tobytes()
    with pytest.raises(svnet.Error, match=r"phi 90.0002 is outside"):
        model.score(image, [[0, 90.0002]])
