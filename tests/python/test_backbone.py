import os
import pathlib

import numpy as np
import pytest

import svnet


@pytest.fixture(scope="module")
def backbone():
    return svnet.Backbone("mobilenet_v2", seed=1)


@pytest.fixture(scope="module")
def images():
    return np.random.default_rng(5).integers(256, size=(3, 224, 224, 3), dtype=np.uint8)


@pytest.fixture(scope="module")
def expected(backbone, images):
    return backbone.features(images)


def test_what_it_says_of_itself(backbone):
    assert backbone.name == "mobilenet_v2"
    assert backbone.layer == "global_average_pooling2d"
    assert backbone.dimension == 1280
    assert backbone.input_shape == (224, 224, 3)
    assert backbone.unused_layers == []
    assert repr(backbone) == "<svnet.Backbone mobilenet_v2, layer global_average_pooling2d, 1280 features>"


def test_features(expected):
    assert expected.shape == (3, 1280) and expected.dtype == np.float32
    assert np.isfinite(expected).all()
    assert np.linalg.norm(expected[0] - expected[1]) > 0


def test_no_images(backbone):
    assert backbone.features(np.zeros((0, 224, 224, 3), np.uint8)).shape == (0, 1280)


def test_strides(backbone, images, expected):
    assert backbone.features(np.asfortranarray(images)).tobytes() == expected.tobytes()
    bgr = np.ascontiguousarray(images[..., ::-1])
    assert backbone.features(bgr[..., ::-1]).tobytes() == expected.tobytes()
    np.testing.assert_allclose(backbone.features(images[::-1]), expected[::-1], rtol=1e-4, atol=1e-6 * expected.max())


def test_pooled_output_has_several_names(images, expected):
    for layer in ("avg_pool", "global_average_pooling2d"):
        assert svnet.Backbone("mobilenet_v2", layer=layer, seed=1).features(images).tobytes() == expected.tobytes()


def test_inner_layers_are_flattened(images):
    inner = svnet.Backbone("mobilenet_v2", layer="block_3_depthwise_relu", seed=1)
    assert inner.dimension == 28 * 28 * 144
    assert inner.features(images[:1]).shape == (1, 28 * 28 * 144)


def test_seed_decides_random_weights(images, expected):
    assert svnet.Backbone("mobilenet_v2", seed=1).features(images).tobytes() == expected.tobytes()
    assert svnet.Backbone("mobilenet_v2", seed=2).features(images).tobytes() != expected.tobytes()


@pytest.mark.parametrize("n", [2, 3])
def test_number_of_threads_does_not_matter(n, backbone, images, expected, threads):
    threads(n)
    assert backbone.features(images).tobytes() == expected.tobytes()


def test_images_that_are_refused(backbone, images):
    refused = [
        (images.astype(np.float32) / 255, "images have dtype float32; expects uint8"),
        (images.astype(np.int64), "images have dtype int64; expects uint8"),
        (images[0], r"shape \(224, 224, 3\); expects \(N, H, W, 3\), RGB; for one image pass image\[None\]"),
        (images[..., :1], r"shape \(3, 224, 224, 1\)"),
        (images.transpose(0, 3, 1, 2), r"shape \(3, 3, 224, 224\)"),
        (images[:, ::2], "images are 112x224, mobilenet_v2 takes 224x224; resize them first"),
    ]
    for given, message in refused:
        with pytest.raises(svnet.Error, match=message):
            backbone.features(given)


def test_names_that_are_refused(tmp_path):
    with pytest.raises(svnet.Error, match="no backbone 'mobilenetv2', did you mean 'mobilenet_v2'?"):
        svnet.Backbone("mobilenetv2")
    with pytest.raises(svnet.Error, match="block_3_exand.*block_3_expand"):
        svnet.Backbone("mobilenet_v2", layer="block_3_exand")
    with pytest.raises(svnet.Error, match=r"^\[Backbone\] name is no str; expects the name of a network$"):
        svnet.Backbone(None)
    with pytest.raises(svnet.Error, match=r"^\[Backbone\] layer is no str; expects the name of a layer, or None$"):
        svnet.Backbone("mobilenet_v2", layer=5)
    with pytest.raises(svnet.Error, match=r"no layer '\\udcff'"):
        svnet.Backbone("mobilenet_v2", layer="\udcff")
    missing = tmp_path / "missing.h5"
    for weights in (missing, str(missing), os.fsencode(missing)):
        with pytest.raises(svnet.Error, match="missing.h5"):
            svnet.Backbone("mobilenet_v2", weights=weights)
    with pytest.raises(svnet.Error, match="weights is 5; expects a path"):
        svnet.Backbone("mobilenet_v2", weights=5)
    with pytest.raises(svnet.Error, match="seed is -1"):
        svnet.Backbone("mobilenet_v2", seed=-1)


def test_weights_of_another_model_are_refused():
    fixtures = pathlib.Path(__file__).parents[1] / "fixtures" / "io"
    with pytest.raises(svnet.Error, match="keras_legacy.h5"):
        svnet.Backbone("mobilenet_v2", weights=fixtures / "keras_legacy.h5")


def test_tiny_xception_has_its_weights_built_in():
    images = np.random.default_rng(6).integers(256, size=(2, 96, 96, 3), dtype=np.uint8)
    built_in = svnet.Backbone("tiny_xception")
    file = pathlib.Path(__file__).parents[2] / "data" / "tiny_xception.safetensors"
    given = svnet.Backbone("tiny_xception", weights=file, seed=3)
    assert built_in.features(images).tobytes() == given.features(images).tobytes()
    assert given.unused_layers == []
    with pytest.raises(svnet.Error, match="holds weights of tiny_xception, expected weights of mobilenet"):
        svnet.Backbone("mobilenet", weights=file)


def test_a_backbone_without_network_is_refused(images):
    class Early(svnet.Backbone):
        def __init__(self):
            self.dimension

    empty = svnet.Backbone.__new__(svnet.Backbone)
    failed = svnet.Backbone.__new__(svnet.Backbone)
    with pytest.raises(svnet.Error):
        failed.__init__("no network")
    for use in (
        lambda: empty.dimension,
        lambda: empty.features(images),
        lambda: repr(empty),
        lambda: failed.input_shape,
        lambda: Early(),
    ):
        with pytest.raises(TypeError, match="no network yet"):
            use()
    empty.__init__("vgg16", layer="block1_pool")
    assert empty.layer == "block1_pool"
