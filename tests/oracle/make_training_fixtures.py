#!/usr/bin/env python3
"""Records ten training steps of Keras: vgg_like.safetensors, sv_net.safetensors and fine_tuned.safetensors.

Usage: make_training_fixtures.py FOLDER [--large]. Needs Keras with TensorFlow, and safetensors (the committed files in
tests/fixtures/training: Keras 3.15.1, TensorFlow 2.21.0, without --large). tests/train/replay_training_test.cpp replays
them.

Tensors: the inputs and targets of B batches (B, 8, …), of which step s uses batch s mod B; parameters/LAYER/NAME, the
initial weights; losses (10), before each step; inference, the outputs for the first batch after the last step, in
inference mode. Metadata: learning_rate. fine_tuned has losses and inference twice, as all/… and last_block/….
"""
import os
import pathlib
import sys

os.environ.setdefault("KERAS_BACKEND", "tensorflow")
os.environ.setdefault("TF_CPP_MIN_LOG_LEVEL", "3")

import keras
import numpy as np
import tensorflow as tf
from keras import layers
from safetensors.numpy import save_file

BATCH, STEPS = 8, 10


def weights_of(model):
    return {
        f"parameters/{layer.name}/{weight.name}": weight.numpy()
        for layer in model.layers
        for weight in layer.weights
    }


def randomised_norms(model, random):
    for layer in model.layers:
        if isinstance(layer, layers.BatchNormalization):
            shape = layer.gamma.shape
            layer.gamma.assign(random.uniform(0.5, 1.5, shape))
            layer.beta.assign(random.normal(0, 0.2, shape))
            layer.moving_mean.assign(random.normal(0, 0.2, shape))
            layer.moving_variance.assign(random.uniform(0.5, 1.5, shape))


def trained(name, model, loss, optimizer, inputs, targets):
    """Returns the losses of the steps and the outputs after them. inputs, targets: lists of (B, 8, …), as the model takes them."""
    losses = []
    for step in range(STEPS):
        batch = step % len(targets)
        with tf.GradientTape() as tape:
            value = loss(targets[batch], model([x[batch] for x in inputs], training=True))
        gradients = tape.gradient(value, model.trainable_variables)
        optimizer.apply(gradients, model.trainable_variables)
        losses.append(float(value))
    assert len(set(losses)) == STEPS and np.isfinite(losses).all()
    print(name, "losses", *(f"{value:.6f}" for value in losses))
    return {"losses": np.array(losses), "inference": model([x[0] for x in inputs], training=False).numpy()}


def record(path, model, loss, optimizer, learning_rate, inputs, targets, given):
    """optimizer: makes an optimizer for a learning rate. given: the tensors that are written for inputs and targets."""
    tensors = given | weights_of(model)
    tensors |= trained(path.name, model, loss, optimizer(learning_rate), inputs, targets)
    save_file(tensors, path, metadata={"learning_rate": repr(learning_rate)})


def vgg_like(path, filters, units, batches):
    """Three blocks of 3×3 convolution and max pooling, and two dense layers; SGD with momentum."""
    keras.utils.set_random_seed(21)
    random = np.random.default_rng(22)
    x = image = keras.Input((16, 16, 3), name="image")
    for number, count in enumerate(filters, 1):
        x = layers.Conv2D(count, 3, padding="same", activation="relu", name=f"block{number}_conv")(x)
        x = layers.MaxPooling2D(name=f"block{number}_pool")(x)
    x = layers.Flatten(name="flatten")(x)
    x = layers.Dense(units, activation="relu", name="fc")(x)
    model = keras.Model([image], layers.Dense(8, name="logits")(x))
    for layer in model.layers:
        if layer.weights:
            layer.bias.assign(random.normal(0, 0.1, layer.bias.shape))
    # Every class has its own colour, so that the network can learn.
    classes = random.integers(8, size=(batches, BATCH))
    colours = random.uniform(40, 215, size=(8, 3))
    images = colours[classes][:, :, None, None, :] + random.normal(0, 40, size=(batches, BATCH, 16, 16, 3))
    images = np.clip(images, 0, 255).astype(np.uint8)
    record(
        path,
        model,
        lambda truth, logits: tf.reduce_mean(keras.losses.sparse_categorical_crossentropy(truth, logits, from_logits=True)),
        lambda rate: keras.optimizers.SGD(rate, momentum=0.9),
        0.05,
        [images.astype(np.float32) / np.float32(255)],
        classes,
        {"images": images, "classes": classes.astype(np.int64)},
    )


def sv_net_head(features, angles, width):
    """SV-net (PAPER.md section 5) without dropout."""

    def block(prefix, x, units, activation="relu"):
        x = layers.Dense(units, name=prefix + "_fc")(x)
        x = layers.BatchNormalization(name=prefix + "_bn")(x)
        return layers.Activation(activation)(x)

    x = block("mlp1_2", block("mlp1_1", features, width), width)
    x = layers.Concatenate()([x, angles])
    x = block("mlp2_2", block("mlp2_1", x, width), width)
    return block("mlp2_3", x, 1, "sigmoid")


def mean_squared_error(truth, score):
    return tf.reduce_mean(tf.square(score - truth))


def sv_net(path, features, width, batches):
    """The head alone; Adam, mean squared error."""
    keras.utils.set_random_seed(31)
    random = np.random.default_rng(32)
    inputs = [keras.Input((features,), name="features"), keras.Input((2,), name="angles")]
    model = keras.Model(inputs, sv_net_head(*inputs, width))
    randomised_norms(model, random)
    given = {
        "features": np.maximum(random.normal(size=(batches, BATCH, features)), 0).astype(np.float32),
        "angles": random.uniform(-np.pi, np.pi, size=(batches, BATCH, 2)).astype(np.float32),
        "scores": random.uniform(size=(batches, BATCH, 1)).astype(np.float32),
    }
    record(
        path,
        model,
        mean_squared_error,
        keras.optimizers.Adam,
        1e-3,
        [given["features"], given["angles"]],
        given["scores"],
        given,
    )


def fine_tuned(path, filters, width, batches):
    """Three blocks of 3×3 convolution, batch norm and max pooling below SV-net. Trains all of them, or only the last block."""
    keras.utils.set_random_seed(41)
    random = np.random.default_rng(42)
    inputs = [keras.Input((16, 16, 3), name="image"), keras.Input((2,), name="angles")]
    x = inputs[0]
    for number, count in enumerate(filters, 1):
        x = layers.Conv2D(count, 3, padding="same", activation="relu", name=f"block{number}_conv")(x)
        x = layers.BatchNormalization(name=f"block{number}_bn")(x)
        x = layers.MaxPooling2D(name=f"block{number}_pool")(x)
    model = keras.Model(inputs, sv_net_head(layers.Flatten()(x), inputs[1], width))
    randomised_norms(model, random)
    given = {
        "images": random.integers(256, size=(batches, BATCH, 16, 16, 3)).astype(np.uint8),
        "angles": random.uniform(-np.pi, np.pi, size=(batches, BATCH, 2)).astype(np.float32),
        "scores": random.uniform(size=(batches, BATCH, 1)).astype(np.float32),
    }
    tensors = given | weights_of(model)
    for name, frozen in ("all", ()), ("last_block", ("block1_", "block2_")):
        for layer in model.layers:
            layer.trainable = not layer.name.startswith(tuple(frozen))
            for weight in layer.weights:
                weight.assign(tensors[f"parameters/{layer.name}/{weight.name}"])
        results = trained(
            f"{path.name} {name}",
            model,
            mean_squared_error,
            keras.optimizers.Adam(1e-3),
            [given["images"].astype(np.float32) / np.float32(255), given["angles"]],
            given["scores"],
        )
        tensors |= {f"{name}/{key}": value for key, value in results.items()}
    save_file(tensors, path, metadata={"learning_rate": repr(1e-3)})


folder = pathlib.Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)
if "--large" in sys.argv[2:]:
    vgg_like(folder / "vgg_like.safetensors", [32, 64, 64], 128, 10)
    sv_net(folder / "sv_net.safetensors", 512, 256, 10)
    # No larger rate: Adam's first steps have the size of the rate even if the gradient is tiny. So rounding errors in
    # gradients near 0 become full steps.
    fine_tuned(folder / "fine_tuned.safetensors", [16, 16, 16], 16, 4)
else:
    vgg_like(folder / "vgg_like.safetensors", [4, 8, 8], 16, 4)
    sv_net(folder / "sv_net.safetensors", 32, 16, 4)
    fine_tuned(folder / "fine_tuned.safetensors", [16, 16, 16], 16, 4)
