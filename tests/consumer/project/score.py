"""score.py MODEL IMAGE.ppm THETA PHI [THETA PHI]...: prints one score per line, then the index of the best."""

import sys

import numpy as np

import svnet


def main(model_file, image_file, *angles):
    with open(image_file, "rb") as file:
        _, width, height, _ = file.readline().split()
        image = np.frombuffer(file.read(), np.uint8).reshape(int(height), int(width), 3)
    model = svnet.Model.load(model_file)
    poses = np.array(angles, float).reshape(-1, 2)
    index, scores = model.best_view(image, poses)
    assert scores.tobytes() == model.score(image, poses).tobytes()
    print(*(f"{score:.9g}" for score in scores), index, sep="\n")


main(*sys.argv[1:])
