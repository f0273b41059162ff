"""Compares features of the backbones with Keras, with weights files that Keras wrote."""
import h5py
import keras
import numpy as np
import pytest
from PIL import Image
from keras.src.legacy.saving import legacy_h5_format

import svnet

# Largest relative L2 error of the features of an image.
BARS = {"vgg16": 2e-5, "vgg19": 2e-5}
BAR = 1e-4

NETWORKS = {
    "vgg16": (keras.applications.VGG16, keras.applications.vgg16),
    "vgg19": (keras.applications.VGG19, keras.applications.vgg19),
    "xception": (keras.applications.Xception, keras.applications.xception),
    "mobilenet": (keras.applications.MobileNet, keras.applications.mobilenet),
    "mobilenet_v2": (keras.applications.MobileNetV2, keras.applications.mobilenet_v2),
}
LAYERS = {
    "vgg16": ["block1_conv1", "block3_conv3", "block4_pool"],
    "vgg19": ["block1_pool", "block2_conv1", "block5_conv4"],
    "xception": ["block1_conv2_bn", "block2_sepconv2_bn", "block3_pool", "block6_sepconv2_act", "block13_pool", "block14_sepconv2_act"],
    "mobilenet": ["conv_pad_2", "conv_dw_1_bn", "conv_pw_5_relu", "conv_dw_12_relu", "conv_pw_13_relu"],
    "mobilenet_v2": ["bn_Conv1", "expanded_conv_project_BN", "block_3_pad", "block_4_add", "block_13_depthwise_relu", "out_relu"],
}


def side(name):
    return 299 if name == "xception" else 224


def resized(name, pictures):
    """The images at the size of the network's input."""
    size = side(name)
    if pictures.shape[1] == size:
        return pictures
    return np.stack([np.asarray(Image.fromarray(p).resize((size, size), Image.BILINEAR)) for p in pictures])


def pooling(name):
    """The arguments with which Keras returns the pooled output of svnet."""
    return None if name.startswith("vgg") else "avg"


def random_model(name, top, pictures):
    """The network with random weights. Its batch norms are near the statistics of the images, so that activations keep
    their magnitude, but far enough from them, and from 0 and 1, that every parameter changes the result."""
    keras.utils.set_random_seed(7)
    network, _ = NETWORKS[name]
    model = network(weights=None, include_top=top, input_shape=(side(name), side(name), 3), pooling=None if top else pooling(name))
    random = np.random.default_rng(8)
    norms = [layer for layer in model.layers if isinstance(layer, keras.layers.BatchNormalization)]
    for layer in norms:
        layer.momentum = 0.0  # the statistics become those of the batch
        layer.gamma.assign(random.uniform(0.5, 1.5, layer.gamma.shape))
        layer.beta.assign(random.normal(0.5, 0.5, layer.beta.shape))
    model(preprocessed(name, pictures), training=True)
    for layer in norms:
        variance = layer.moving_variance.numpy()
        layer.moving_mean.assign_add(0.2 * np.sqrt(variance) * random.normal(size=variance.shape))
        layer.moving_variance.assign(variance * random.uniform(0.5, 2, variance.shape))
    return model


def preprocessed(name, pictures):
    return NETWORKS[name][1].preprocess_input(resized(name, pictures).astype(np.float32))


def keras_features(name, model, layer, pictures):
    cut = keras.Model(model.input, model.get_layer(layer).output) if layer else model
    return np.asarray(cut.predict(preprocessed(name, pictures), batch_size=8, verbose=0)).reshape(len(pictures), -1)


def largest_error(found, expected):
    assert found.shape == expected.shape and found.dtype == np.float32
    return (np.linalg.norm(found - expected, axis=1) / np.linalg.norm(expected, axis=1)).max()


def assert_sensitive(expected):
    """Checks that the features of the images differ; otherwise the comparison would mean little."""
    spread = np.linalg.norm(expected - expected.mean(axis=0)) / np.linalg.norm(expected)
    assert spread > 0.02, spread


@pytest.fixture(scope="module", params=NETWORKS)
def random_network(request, drawings, tmp_path_factory):
    """(name, model without top, its weights as a legacy file and as a Keras 3 file)"""
    name = request.param
    model = random_model(name, False, drawings)
    folder = tmp_path_factory.mktemp(name)
    with h5py.File(folder / "legacy.h5", "w") as file:
        legacy_h5_format.save_weights_to_hdf5_group(file, model)
    model.save_weights(folder / "keras3.weights.h5")
    return name, model, {"legacy": folder / "legacy.h5", "keras 3": folder / "keras3.weights.h5"}


@pytest.mark.parametrize("layout", ["legacy", "keras 3"])
def test_random_weights(random_network, layout, drawings, report):
    name, model, files = random_network
    expected = keras_features(name, model, None, drawings)
    assert_sensitive(expected)
    backbone = svnet.Backbone(name, weights=files[layout])
    assert backbone.unused_layers == []
    pictures = resized(name, drawings)
    together = backbone.features(pictures)
    error = largest_error(together, expected)
    report(f"{name}, random weights, {layout}: relative error {error:.1e}")
    assert error < BARS.get(name, BAR)
    assert (np.concatenate([backbone.features(image[None]) for image in pictures]) == together).all()


def test_inner_layers(random_network, drawings, report):
    name, model, files = random_network
    for layer in LAYERS[name]:
        expected = keras_features(name, model, layer, drawings)
        backbone = svnet.Backbone(name, weights=files["legacy"], layer=layer)
        error = largest_error(backbone.features(resized(name, drawings)), expected)
        report(f"{name}, random weights, layer {layer}: relative error {error:.1e}")
        assert error < BARS.get(name, BAR), layer


@pytest.mark.parametrize("layout", ["legacy", "keras 3"])
@pytest.mark.parametrize("name", ["mobilenet", "mobilenet_v2", "xception"])  # a VGG's top is half a gigabyte
def test_random_weights_with_top(name, layout, drawings, tmp_path, report):
    model = random_model(name, True, drawings)
    path = tmp_path / "with_top.weights.h5"
    if layout == "legacy":
        with h5py.File(path, "w") as file:
            legacy_h5_format.save_weights_to_hdf5_group(file, model)
    else:
        model.save_weights(path)
    for layer in ("predictions", "avg_pool" if name == "xception" else "global_average_pooling2d"):
        keras_layer = next(l.name for l in model.layers if l.name.startswith(layer))
        expected = keras_features(name, model, keras_layer, drawings)
        error = largest_error(svnet.Backbone(name, weights=path, layer=layer).features(resized(name, drawings)), expected)
        report(f"{name}, random weights with top, {layout}, {layer}: relative error {error:.1e}")
        assert error < BAR, layer


@pytest.mark.parametrize("name", ["vgg19", "xception"])
def test_photographs(name, photographs, tmp_path, report):
    model = random_model(name, False, photographs[:16])
    model.save_weights(tmp_path / "random.weights.h5")
    expected = keras_features(name, model, None, photographs[:16])
    backbone = svnet.Backbone(name, weights=tmp_path / "random.weights.h5")
    error = largest_error(backbone.features(resized(name, photographs[:16])), expected)
    report(f"{name}, random weights, 16 photographs: relative error {error:.1e}")
    assert error < BARS.get(name, BAR)


@pytest.mark.parametrize(
    "name, file, top",
    [
        ("mobilenet", "mobilenet_1_0_224_tf_no_top.h5", False),
        ("mobilenet_v2", "mobilenet_v2_weights_tf_dim_ordering_tf_kernels_1.0_224_no_top.h5", False),
        ("mobilenet_v2", "mobilenet_v2_weights_tf_dim_ordering_tf_kernels_1.0_224.h5", True),
    ],
)
def test_real_weights(name, file, top, shared, photographs, report):
    weights = shared("weights/" + file)
    model = NETWORKS[name][0](weights=str(weights), include_top=top, input_shape=(224, 224, 3))
    pooled = keras.layers.GlobalAveragePooling2D()(model.get_layer(LAYERS[name][-1]).output)
    expected = keras_features(name, keras.Model(model.input, pooled), None, photographs)
    assert_sensitive(expected)
    backbone = svnet.Backbone(name, weights=weights)
    batches = np.concatenate([backbone.features(photographs[i : i + 8]) for i in range(0, 64, 8)])
    error = largest_error(batches, expected)
    report(f"{name}, {file}, 64 photographs: relative error {error:.1e}")
    assert error < BAR
    inner = LAYERS[name][2]
    expected = keras_features(name, model, inner, photographs[:8])
    error = largest_error(svnet.Backbone(name, weights=weights, layer=inner).features(photographs[:8]), expected)
    report(f"{name}, {file}, layer {inner}: relative error {error:.1e}")
    assert error < BAR
