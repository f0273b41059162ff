"""The real MobileNetV2 recognises the objects in two images."""
import numpy as np
import pytest
from conftest import picture

import svnet


@pytest.mark.parametrize(
    "file, number, name, probability",
    [("military_uniform.png", 652, "military uniform", 0.718), ("egyptian_cat.png", 285, "Egyptian cat", 0.672)],
)
def test_recognises(file, number, name, probability, shared, report):
    weights = shared("weights/mobilenet_v2_weights_tf_dim_ordering_tf_kernels_1.0_224.h5")
    image = picture(shared("weights/check/" + file))
    predictions = svnet.Backbone("mobilenet_v2", weights=weights, layer="predictions").features(image[None])[0]
    report(f"{file}: {name} with probability {predictions[number]:.4f}, expected {probability}")
    assert predictions.shape == (1000,) and predictions.sum() == pytest.approx(1, abs=1e-5)
    assert np.argmax(predictions) == number
    assert predictions[number] == pytest.approx(probability, abs=0.005)
