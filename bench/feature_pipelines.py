#!/usr/bin/env python3
"""Features of a folder of pictures as a user would compute them in Python: the peers of bench/compare_features.py.

    feature_pipelines.py make NETWORK FOLDER     writes NETWORK.weights.h5 (Keras, random) and NETWORK.onnx, the same network
    feature_pipelines.py run NETWORK.onnx LIST --pipeline NAME --threads N --output FEATURES.npy

LIST names one picture a line. A pipeline decodes, resizes and preprocesses pictures, and runs batches of them in ONNX
Runtime. `run` prints a line of JSON: the seconds of starting (modules, session) and of the pictures.

A name of a pipeline has three parts, as in opencv/threads/wait:
    pillow        decodes and resizes with Pillow, as Keras does; its pictures have svnet's bits
    opencv        cv2.imread and cv2.resize with INTER_AREA
    opencv-linear cv2.resize with INTER_LINEAR, which skips pixels when it shrinks a picture
    opencv-half   cv2.IMREAD_REDUCED_COLOR_2, then INTER_LINEAR: the JPEG decoder makes a picture of half the size
    threads       N threads decode the next batches while ONNX Runtime's N threads run the network
    processes     N processes with a share of the pictures; each decodes and runs the network with one thread
    spin, wait    whether threads of ONNX Runtime spin while they have no work
"""
import argparse
import json
import os
import queue
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

STARTED = time.perf_counter()
SIDES = {"vgg19": 224, "xception": 299, "mobilenet_v2": 224}


# The network.

def keras_model(network):
    import keras

    make = {"vgg19": keras.applications.VGG19, "xception": keras.applications.Xception,
            "mobilenet_v2": keras.applications.MobileNetV2}[network]
    keras.utils.set_random_seed(1)
    side = SIDES[network]
    return make(weights=None, include_top=False, input_shape=(side, side, 3), pooling=None if network == "vgg19" else "avg")


class OnnxGraph:
    """The layers of a Keras model as ONNX nodes in NCHW, which is the layout of ONNX Runtime's kernels."""

    def __init__(self):
        self.nodes, self.weights, self.shapes = [], [], {}

    def node(self, kind, inputs, output, **attributes):
        from onnx import helper

        self.nodes.append(helper.make_node(kind, inputs, [output], **attributes))

    def weight(self, name, values):
        from onnx import numpy_helper

        self.weights.append(numpy_helper.from_array(values, name))
        return name

    def window(self, layer, size, strides, padding, height):
        """Keras' "same" padding, which is larger at the end."""
        if padding == "valid":
            return {"strides": list(strides)}
        pads = [max((-(-height // s) - 1) * s + k - height, 0) for k, s in zip(size, strides)]
        return {"strides": list(strides), "pads": [p // 2 for p in pads] + [p - p // 2 for p in pads]}

    def convolution(self, name, layer, kernel, bias, x, output, depthwise, height, strides=None):
        """`kernel`: HWIO, or HWC1 of a depthwise convolution."""
        size = kernel.shape[:2]
        weight = self.weight(name + "/w", kernel.transpose(2, 3, 0, 1).copy() if depthwise else
                             kernel.transpose(3, 2, 0, 1).copy())
        inputs = [x, weight] + ([self.weight(name + "/b", bias)] if bias is not None else [])
        self.node("Conv", inputs, output, kernel_shape=list(size), group=kernel.shape[2] if depthwise else 1,
                  **self.window(layer, size, strides or layer.strides, layer.padding, height))

    def activation(self, layer, output):
        """Returns the name of what comes before the activation."""
        return output if layer.activation.__name__ == "linear" else output + "/before"

    def activate(self, layer, output):
        if layer.activation.__name__ == "relu":
            self.node("Relu", [output + "/before"], output)
        elif layer.activation.__name__ != "linear":
            sys.exit(f"feature_pipelines.py: {layer.name}: activation {layer.activation.__name__} is not written")

    def add(self, layer, inputs, output):
        import numpy as np

        kind = type(layer).__name__
        weights = [np.asarray(w) for w in layer.get_weights()]
        source = layer.input[0] if isinstance(layer.input, (list, tuple)) else layer.input
        height = source.shape[1] if len(source.shape) == 4 else 0
        x = inputs[0]
        if kind in ("Conv2D", "DepthwiseConv2D"):
            bias = weights[1] if layer.use_bias else None
            self.convolution(output, layer, weights[0], bias, x, self.activation(layer, output), kind != "Conv2D", height)
            self.activate(layer, output)
        elif kind == "SeparableConv2D":
            bias = weights[2] if layer.use_bias else None
            self.convolution(output + "/depthwise", layer, weights[0], None, x, output + "/between", True, height)
            self.convolution(output, layer, weights[1], bias, output + "/between", self.activation(layer, output), False,
                             1, strides=(1, 1))
            self.activate(layer, output)
        elif kind == "BatchNormalization":
            names = [self.weight(f"{output}/{i}", w) for i, w in enumerate(weights)]
            self.node("BatchNormalization", [x, *names], output, epsilon=layer.epsilon)
        elif kind == "ReLU" and layer.max_value == 6:
            self.node("Clip", [x, self.weight(output + "/0", np.float32(0)), self.weight(output + "/6", np.float32(6))],
                      output)
        elif kind == "Activation" and layer.activation.__name__ == "relu":
            self.node("Relu", [x], output)
        elif kind == "Add":
            self.node("Add", inputs, output)
        elif kind == "MaxPooling2D":
            self.node("MaxPool", [x], output, kernel_shape=list(layer.pool_size),
                      **self.window(layer, layer.pool_size, layer.strides, layer.padding, height))
        elif kind == "ZeroPadding2D":
            (top, bottom), (left, right) = layer.padding
            self.node("Pad", [x, self.weight(output + "/pads", np.array([0, 0, top, left, 0, 0, bottom, right]))], output)
        elif kind == "GlobalAveragePooling2D":
            self.node("GlobalAveragePool", [x], output)
        else:
            sys.exit(f"feature_pipelines.py: {layer.name}: layers {kind} are not written")


def onnx_model(model):
    from onnx import TensorProto, checker, helper

    graph, side = OnnxGraph(), model.input_shape[1]
    for layer in model.layers:
        if type(layer).__name__ == "InputLayer":
            continue
        sources = layer.input if isinstance(layer.input, (list, tuple)) else [layer.input]
        names = [tensor._keras_history.operation.name for tensor in sources]
        graph.add(layer, ["x" if name == model.layers[0].name else name for name in names], layer.name)
    last, shape = model.layers[-1].name, [model.output_shape[-1], *model.output_shape[1:-1]]
    if len(shape) == 1:
        shape += [1, 1]
    made = helper.make_model(
        helper.make_graph(graph.nodes, "backbone",
                          [helper.make_tensor_value_info("x", TensorProto.FLOAT, ["batch", 3, side, side])],
                          [helper.make_tensor_value_info(last, TensorProto.FLOAT, ["batch", *shape])], graph.weights),
        opset_imports=[helper.make_opsetid("", 17)], ir_version=8)
    checker.check_model(made)
    return made


def make(network, folder):
    os.environ.setdefault("TF_CPP_MIN_LOG_LEVEL", "3")
    import onnx

    model = keras_model(network)
    model.save_weights(folder / f"{network}.weights.h5")
    onnx.save(onnx_model(model), folder / f"{network}.onnx")


# The pipelines.

def as_input(network, rgb, out):
    """uint8 (H, W, 3) -> float32 (3, H, W), as keras.applications' preprocess_input."""
    import numpy as np

    if network == "vgg19":
        for channel, mean in enumerate((103.939, 116.779, 123.68)):
            np.subtract(rgb[:, :, 2 - channel], np.float32(mean), out=out[channel])
    else:
        np.multiply(rgb.transpose(2, 0, 1), np.float32(1 / 127.5), out=out)
        out -= 1


def pillow_picture(network, path, out):
    import numpy as np
    from PIL import Image

    with Image.open(path) as image:
        as_input(network, np.asarray(image.convert("RGB").resize(out.shape[:0:-1], Image.Resampling.BILINEAR)), out)


def opencv_picture(read, interpolation):
    def picture(network, path, out):
        import cv2

        bgr = cv2.imread(path, getattr(cv2, read))
        small = cv2.resize(bgr, out.shape[:0:-1], interpolation=getattr(cv2, interpolation))
        as_input(network, small[:, :, ::-1], out)

    return picture


PICTURES = {"pillow": pillow_picture, "opencv": opencv_picture("IMREAD_COLOR", "INTER_AREA"),
            "opencv-linear": opencv_picture("IMREAD_COLOR", "INTER_LINEAR"),
            "opencv-half": opencv_picture("IMREAD_REDUCED_COLOR_2", "INTER_LINEAR")}


def session(path, threads, spin):
    import onnxruntime

    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = threads
    options.graph_optimization_level = onnxruntime.GraphOptimizationLevel.ORT_ENABLE_ALL
    options.add_session_config_entry("session.intra_op.allow_spinning", "1" if spin else "0")
    return onnxruntime.InferenceSession(str(path), options, providers=["CPUExecutionProvider"])


def load_modules(picture):
    if picture.startswith("opencv"):
        import cv2

        cv2.setNumThreads(1)
    else:
        import PIL.Image  # noqa: F401


def by_threads(options, paths, network, picture, spin):
    """Decoding threads fill batches in the order of the paths; at most three batches are ready or in work."""
    import numpy as np

    load_modules(options.picture)
    net = session(options.model, options.threads, spin)
    started = time.perf_counter()
    side, rows, pending = SIDES[network], [], queue.Queue()
    places = threading.Semaphore(3)
    with ThreadPoolExecutor(options.threads) as pool:
        def feed():
            for begin in range(0, len(paths), options.batch):
                part = paths[begin:begin + options.batch]
                places.acquire()
                batch = np.empty((len(part), 3, side, side), np.float32)
                pending.put((batch, [pool.submit(picture, network, path, out) for path, out in zip(part, batch)]))
            pending.put(None)

        threading.Thread(target=feed, daemon=True).start()
        while (item := pending.get()) is not None:
            for future in item[1]:
                future.result()
            rows.append(net.run(None, {"x": item[0]})[0].reshape(len(item[0]), -1))
            places.release()
    return np.concatenate(rows), started


def one_process(options, paths, network, picture, spin, results):
    """Puts the time of its start and its rows into `results`; None if it fails."""
    try:
        rows_of_process(options, paths, network, picture, spin, results)
    except BaseException:
        results.put(None)
        raise


def rows_of_process(options, paths, network, picture, spin, results):
    import numpy as np

    load_modules(options.picture)
    net = session(options.model, 1, spin)
    results.put(time.perf_counter())
    batch, rows = np.empty((options.batch, 3, SIDES[network], SIDES[network]), np.float32), []
    for begin in range(0, len(paths), options.batch):
        part = paths[begin:begin + options.batch]
        for path, out in zip(part, batch):
            picture(network, path, out)
        rows.append(net.run(None, {"x": batch[:len(part)]})[0].reshape(len(part), -1))
    results.put(np.concatenate(rows))


def by_processes(options, paths, network, picture, spin):
    import multiprocessing
    import numpy as np

    import onnxruntime  # noqa: F401  once, before the processes are forked

    context = multiprocessing.get_context("fork")
    queues = [context.SimpleQueue() for _ in range(options.threads)]
    shares = [paths[len(paths) * i // options.threads:len(paths) * (i + 1) // options.threads] for i in range(options.threads)]
    workers = [context.Process(target=one_process, args=(options, share, network, picture, spin, results))
               for share, results in zip(shares, queues)]
    for worker in workers:
        worker.start()

    def next_of(results):
        value = results.get()
        if value is None:
            sys.exit("feature_pipelines.py: a process failed; its error is above")
        return value

    started = max(next_of(results) for results in queues)
    rows = np.concatenate([next_of(results) for results in queues])
    for worker in workers:
        worker.join()
    return rows, started


def run(options):
    import numpy as np

    parts = options.pipeline.split("/")
    if len(parts) != 3 or parts[0] not in PICTURES or parts[1] not in ("threads", "processes") or \
            parts[2] not in ("spin", "wait"):
        sys.exit(f"feature_pipelines.py: pipeline '{options.pipeline}' is not known; for example opencv/threads/wait")
    options.picture = parts[0]
    network = options.model.stem
    paths = options.pictures.read_text(encoding="utf-8").splitlines()
    how = by_threads if parts[1] == "threads" else by_processes
    rows, started = how(options, paths, network, PICTURES[parts[0]], parts[2] == "spin")
    np.save(options.output, rows)
    print(json.dumps({"start": started - STARTED, "pictures": time.perf_counter() - started}))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    making = commands.add_parser("make")
    making.add_argument("network", choices=SIDES)
    making.add_argument("folder", type=Path)
    making.set_defaults(call=lambda options: make(options.network, options.folder))
    running = commands.add_parser("run")
    running.add_argument("model", type=Path)
    running.add_argument("pictures", type=Path)
    running.add_argument("--pipeline", default="opencv/threads/wait")
    running.add_argument("--threads", type=int, default=2)
    running.add_argument("--batch", type=int, default=8)
    running.add_argument("--output", type=Path, required=True)
    running.set_defaults(call=run)
    options = parser.parse_args()
    options.call(options)


if __name__ == "__main__":
    main()
