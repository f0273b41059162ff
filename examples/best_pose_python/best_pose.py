#!/usr/bin/env python3
"""best_pose.py MODEL TOP [DEPTH.npy]: prints the camera pose with the highest score, of 25 around the object.

TOP is an image file. DEPTH, in metres and of the image's size, is for models that were trained with it.
Needs NumPy and Pillow.
"""

import sys

import numpy as np
from PIL import Image

import svnet


def main(model_file, image_file, depth_file=None):
    model = svnet.Model.load(model_file)
    if model.uses_depth and depth_file is None:
        sys.exit(f"best_pose.py: {model_file}: the model needs depth too: give a .npy file of metres")
    image = np.asarray(Image.open(image_file).convert("RGB"))
    depth = np.load(depth_file) if model.uses_depth else None

    rings = [(theta, phi) for phi in (45, 60, 75) for theta in range(0, 360, 45)]
    poses = [(90, 90)] + rings  # the top view first
    best, scores = model.best_view(image, poses, depth)
    theta, phi = poses[best]
    print(f"theta {theta} phi {phi} score {scores[best]:.4f}")


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    main(*sys.argv[1:])
