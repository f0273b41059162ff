import numpy as np
import pytest
from test_depth import POSES, hammer, model_named


@pytest.fixture(scope="module")
def model():
    return model_named("turned_model.safetensors")


def test_quarter_turns_turn_the_scores(model):
    image, depth = hammer()
    expected = model.score(image, POSES)
    assert model.uses_depth is False and len(set(expected.tolist())) == 5
    for turns in (1, 2, 3):
        poses = [[theta + 90 * turns, phi] for theta, phi in POSES]
        np.testing.assert_allclose(model.score(np.rot90(image, turns), poses), expected, atol=1e-5)
    np.testing.assert_array_equal(model.score(image, POSES, depth), expected)


def test_the_mirror_image_has_mirrored_scores(model):
    image, _ = hammer()
    mirrored = model.score(image[:, ::-1], [[180 - theta, phi] for theta, phi in POSES])
    np.testing.assert_allclose(mirrored, model.score(image, POSES), atol=0.02)
