"""Sizes and colours of meshes against trimesh, without light: the mean over the surface.

Colours follow glTF 2.0 and MTL: factor × texture × vertex colour, COLOR_0 and factors linear, textures and the colours of
other formats sRGB; Kd 0 0 0 beside a texture leaves the texture alone. What trimesh does not read is compared with a twin
that says the same in other words.
"""
import json
import os
import pathlib
import subprocess

import make_meshes
import numpy as np
import pytest

trimesh = pytest.importorskip("trimesh")


def linear(srgb):
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def levels(value):
    return 255 * np.where(value <= 0.0031308, 12.92 * value, 1.055 * np.clip(value, 1e-9, None) ** (1 / 2.4) - 0.055)


def samples(steps=24):
    u, v = np.meshgrid((np.arange(steps) + 0.4) / steps, (np.arange(steps) + 0.3) / steps)
    u, v = u.ravel(), v.ravel()
    outside = u + v > 1
    u, v = np.where(outside, 1 - u, u), np.where(outside, 1 - v, v)
    return np.stack([1 - u - v, u, v], axis=1)  # (N, 3) weights of the corners


def surface(mesh, is_gltf):
    """Linear colours (triangles, N, 3) of samples of a trimesh."""
    weights = samples()
    visual = mesh.visual
    colours = np.ones((len(mesh.faces), len(weights), 3))
    if visual.kind == "texture":
        material = visual.material
        if is_gltf:
            factor, image = material.baseColorFactor, material.baseColorTexture
            factor = np.ones(3) if factor is None else np.asarray(factor[:3]) / (255 if np.asarray(factor).dtype.kind in "ui" else 1)
        else:
            factor, image = np.asarray(material.diffuse[:3]) / 255, getattr(material, "image", None)
            if image is not None and not factor.any():
                factor = np.ones(3)
        colours = colours * factor
        if image is not None:
            uv = np.einsum("nk,tkc->tnc", weights, visual.uv[mesh.faces])
            pixels = np.asarray(image.convert("RGB"))
            height, width = pixels.shape[:2]
            x = np.floor((uv[..., 0] % 1) * width).astype(int).clip(0, width - 1)
            y = np.floor(((1 - uv[..., 1]) % 1) * height).astype(int).clip(0, height - 1)
            colours = colours * linear(pixels[y, x] / 255)
        attributes = visual.vertex_attributes
        per_point = attributes["color"] if is_gltf and "color" in list(attributes.keys()) else None
    elif visual.kind == "face":
        return colours * linear(visual.face_colors[:, None, :3] / 255)
    else:
        per_point = visual.vertex_colors
    if per_point is not None:
        per_point = np.asarray(per_point)[:, :3] / (255 if np.asarray(per_point).dtype.kind in "ui" else 1)
        per_point = per_point if is_gltf else linear(per_point)
        colours = colours * np.einsum("nk,tkc->tnc", weights, per_point[mesh.faces])
    return colours


def oracle(path):
    """(size, mean of the sRGB levels)"""
    scene = trimesh.load(path, force="scene", process=False)
    total, area = np.zeros(3), 0
    for name in scene.graph.nodes_geometry:
        transform, geometry = scene.graph[name]
        mesh = scene.geometry[geometry]  # a copy would lose COLOR_0
        mean = levels(surface(mesh, path.suffix in (".glb", ".gltf"))).mean(axis=1)
        areas = trimesh.triangles.area(trimesh.transform_points(mesh.vertices, transform)[mesh.faces])
        total += (mean * areas[:, None]).sum(axis=0)
        area += areas.sum()
    return scene.extents, total / area


@pytest.fixture(scope="session")
def read(tmp_path_factory):
    """What svnet reads of all files, by their names, and their cases."""
    cases = make_meshes.cases(tmp_path_factory.mktemp("meshes"))
    probe = pathlib.Path(os.environ["SVNET_BUILD"]) / "bin" / "mesh_probe"
    ran = subprocess.run([probe, *(case.path for case in cases)], check=True, capture_output=True, text=True)
    return [(case, json.loads(line)) for case, line in zip(cases, ran.stdout.splitlines(), strict=True)]


def test_sizes_and_colours_agree(read, report):
    assert len(read) >= 40
    worst = (0, "")
    problems = []
    for case, found in read:
        if "error" in found:
            problems.append(found["error"])
            continue
        size, colour = oracle(case.twin)
        error = np.abs(np.array(found["size"]) / size - 1).max()
        if error > 1e-3:
            problems.append(f"{case.path.name}: {found['size']} m, trimesh {size.tolist()}")
        if case.has_colour:
            difference = np.abs(np.array(found["colour"]) - colour).max()
            worst = max(worst, (difference, case.path.name))
            if difference > 12:
                problems.append(f"{case.path.name}: colour {np.round(found['colour'])}, trimesh {np.round(colour)}")
    report(f"{len(read)} meshes; largest difference in colour: {worst[0]:.1f} levels, {worst[1]}")
    assert not problems, "\n".join(problems)


def test_only_what_is_missing_is_warned_of(read):
    for case, found in read:
        if case.path.name == "missing_texture.obj":
            assert len(found["warnings"]) == 1 and "'gone.png' is missing" in found["warnings"][0]
        else:
            assert not found.get("warnings"), found
