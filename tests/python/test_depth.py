import os
import pathlib

import numpy as np
import pytest

import svnet

POSES = [[0, 45], [90, 60], [200.5, 75], [-45, 20], [90, 90]]


def model_named(name):
    return svnet.Model.load(pathlib.Path(os.environ["SVNET_SMALL_MODEL"]).with_name(name))  # the build writes it


@pytest.fixture(scope="module")
def axis_model():
    return model_named("axis_model.safetensors")


@pytest.fixture(scope="module")
def depth_model():
    return model_named("depth_model.safetensors")


def hammer():
    """A hammer on a table from above: the image and its depth in metres."""
    image = np.full((120, 120, 3), (150, 140, 120), np.uint8)
    image += np.random.default_rng(3).integers(4, size=image.shape, dtype=np.uint8)
    depth = np.full((120, 120), 0.5, np.float32)
    for rows, columns, height in [(slice(56, 64), slice(25, 90), 0.02), (slice(40, 80), slice(80, 95), 0.03)]:
        image[rows, columns] = (200, 40, 40)
        depth[rows, columns] -= height
    return image, depth


def test_model_says_whether_it_uses_depth(axis_model, depth_model):
    assert depth_model.uses_depth is True and axis_model.uses_depth is False
    assert model_named("small_model.safetensors").uses_depth is False
    with pytest.raises(AttributeError):
        depth_model.uses_depth = False


def test_scores_with_depth(depth_model):
    image, depth = hammer()
    scores = depth_model.score(image, POSES, depth=depth)
    assert scores.shape == (5,) and ((scores > 0) & (scores < 1)).all() and len(set(scores.tolist())) == 5
    index, same = depth_model.best_view(image, POSES, depth=depth)
    assert index == scores.argmax() and (same == scores).all()
    higher = depth - 0.02 * (depth < 0.5)
    assert (depth_model.score(image, POSES, higher) != scores).any()
    # Any numbers, strides and byte orders.
    np.testing.assert_array_equal(depth_model.score(image, POSES, depth.astype(np.float64)), scores)
    np.testing.assert_array_equal(depth_model.score(image, POSES, np.asfortranarray(depth)), scores)
    np.testing.assert_array_equal(depth_model.score(image, POSES, depth.astype(">f4")), scores)
    holes, odd = depth.copy(), depth.copy()
    holes[::5, ::7], odd[::5, ::7] = 0, np.nan
    np.testing.assert_array_equal(depth_model.score(image, POSES, odd), depth_model.score(image, POSES, holes))


def test_depth_is_needed(depth_model):
    image, _ = hammer()
    for call in (depth_model.score, depth_model.best_view):
        with pytest.raises(svnet.Error, match="trained with depth; give the depth image of the top view too"):
            call(image, POSES)
        with pytest.raises(svnet.Error, match="give the depth image"):
            call(image, POSES, depth=None)


def test_wrong_depth_is_refused(depth_model):
    image, depth = hammer()
    for wrong, message in [
        (depth[:-1], r"depth has shape \(119, 120\); expects \(120, 120\), that of the image, in metres"),
        (depth[..., None], r"depth has shape \(120, 120, 1\)"),
        (0.5, r"depth has shape \(\)"),
        (np.full((120, 120), "a"), "depth has dtype"),
        (np.zeros((120, 120)), "table cannot be seen"),
    ]:
        with pytest.raises(svnet.Error, match=message):
            depth_model.score(image, POSES, wrong)


def test_depth_is_ignored_by_a_model_without_it(axis_model):
    image, depth = hammer()
    np.testing.assert_array_equal(axis_model.score(image, POSES, depth), axis_model.score(image, POSES))
    with pytest.raises(svnet.Error, match="depth has shape"):
        axis_model.score(image, POSES, depth[1:])


def test_quarter_turns_turn_the_scores(axis_model, depth_model):
    image, depth = hammer()
    for model in (axis_model, depth_model):
        expected = model.score(image, POSES, depth)
        for turns in (1, 2, 3):
            turned = model.score(
                np.rot90(image, turns), [[theta + 90 * turns, phi] for theta, phi in POSES], np.rot90(depth, turns)
            )
            np.testing.assert_allclose(turned, expected, atol=1e-5)


def test_the_next_view_depends_on_the_pictures_taken(axis_model):
    image, _ = hammer()
    assert axis_model.knows_next_view is True
    taken = [(0, 45, image), (90, 90, np.rot90(image))]
    index, scores = axis_model.next_view(image, taken, POSES)
    assert scores.dtype == np.float32 and scores.shape == (5,)
    assert index == max((1, 2, 3), key=lambda i: scores[i])  # 0 and 4 were taken
    plain = np.full_like(image, 120)
    assert (axis_model.next_view(image, [(0, 45, plain), (90, 90, image)], POSES)[1] != scores).all()
    assert axis_model.next_view(image, taken, POSES, min_angle_deg=180)[0] is None
    for wrong, message in [
        ([], "taken is empty"),
        ("ab", "taken is no list"),
        ([(0, 45)], r"taken\[0\] is not \(theta, phi, picture\)"),
        ([(0, -5, image)], "phi -5 is outside"),
    ]:
        with pytest.raises(svnet.Error, match=message):
            axis_model.next_view(image, wrong, POSES)
