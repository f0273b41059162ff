"""Reads a backbone from the files that Keras writes of models which were made from it."""
import h5py
import keras
import numpy as np
import pytest

import svnet
from test_keras_features import keras_features, largest_error, random_model


def fine_tuned(base, nested, frozen):
    for layer in base.layers[:frozen]:
        layer.trainable = False
    pooled = keras.layers.GlobalAveragePooling2D()
    if nested:
        model = keras.Sequential([base, pooled, keras.layers.Dense(5)])
        model.build((None, 224, 224, 3))
        return model
    return keras.Model(base.input, keras.layers.Dense(5)(pooled(base.output)))


@pytest.mark.parametrize("ending", [".h5", ".weights.h5"])
@pytest.mark.parametrize("nested, frozen", [(False, 0), (True, 0), (True, 40), (True, 1000)])
def test_fine_tuned_mobilenet(ending, nested, frozen, drawings, tmp_path):
    model = random_model("mobilenet", False, drawings)
    expected = keras_features("mobilenet", model, None, drawings)
    base = keras.applications.MobileNet(weights=None, include_top=False, input_shape=(224, 224, 3))
    base.set_weights(model.get_weights())
    path = tmp_path / ("tuned" + ending)
    tuned = fine_tuned(base, nested, frozen)
    tuned.save_weights(path) if ending == ".weights.h5" else tuned.save(path)
    backbone = svnet.Backbone("mobilenet", weights=path)
    assert largest_error(backbone.features(drawings), expected) < 1e-4
    assert [name.split("/")[-1].split("_")[0] for name in backbone.unused_layers] == ["dense"]


def test_bfloat16(drawings, tmp_path):
    ml_dtypes = pytest.importorskip("ml_dtypes")
    model = random_model("mobilenet", False, drawings)
    model.set_weights([w.astype(ml_dtypes.bfloat16).astype("f4") for w in model.get_weights()])
    expected = keras_features("mobilenet", model, None, drawings)
    model.save_weights(tmp_path / "f4.weights.h5")
    with h5py.File(tmp_path / "f4.weights.h5") as source, h5py.File(tmp_path / "bf16.weights.h5", "w") as file:
        def copy(name, item):  # as Keras' H5IOStore writes them with the TensorFlow backend
            if isinstance(item, h5py.Dataset):
                file.create_dataset(name, data=np.array(item).astype(ml_dtypes.bfloat16)).attrs["dtype"] = "bfloat16"
        source["layers"].visititems(lambda name, item: copy("layers/" + name, item))
    assert largest_error(svnet.Backbone("mobilenet", weights=tmp_path / "bf16.weights.h5").features(drawings), expected) < 1e-4
