"""Mesh files of the kinds that collections hold: python make_meshes.py FOLDER writes FOLDER/thing/NAME.*.

All show the same box, 12 × 8 × 5 cm, with a square of the texture on each side. cases(folder) also tells what to compare
each file with: a twin that says the same in words that the oracle reads, or its size alone.
"""
import base64
import json
import pathlib
import struct
import sys
from dataclasses import dataclass

import numpy as np
from PIL import Image

SIZE = np.array([0.12, 0.08, 0.05])


@dataclass
class Case:
    path: pathlib.Path
    twin: pathlib.Path
    has_colour: bool = True


def box():
    """Points (24, 3), coordinates of the texture (24, 2) with v upwards, triangles (12, 3); four points on each side."""
    points, uv, triangles = [], [], []
    for axis in range(3):
        for end in (0, 1):
            first = len(points)
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                point = np.zeros(3)
                point[axis], point[(axis + 1) % 3], point[(axis + 2) % 3] = end, a, b
                points.append(point * SIZE)
                uv.append((0.1 + 0.7 * a, 0.2 + 0.7 * b))
            order = ((0, 1, 2), (0, 2, 3)) if end else ((0, 2, 1), (0, 3, 2))
            triangles += [[first + k for k in corner] for corner in order]
    return np.array(points), np.array(uv), np.array(triangles)


POINTS, UV, TRIANGLES = box()
COLOURS = np.stack([np.linspace(0.1, 1, 24), np.linspace(0.9, 0.2, 24), np.full(24, 0.5)], axis=1)  # per point


def picture(flat=None):
    """32 × 32: four fields of colour, or one."""
    if flat:
        return Image.new("RGB", (32, 32), flat)
    image = np.zeros((32, 32, 3), np.uint8)
    image[:16, :16], image[:16, 16:], image[16:, :16], image[16:, 16:] = (220, 20, 20), (20, 200, 40), (30, 60, 220), 240
    return Image.fromarray(image)


def encoded(image, kind):
    import io

    stream = io.BytesIO()
    image.save(stream, kind, **({"quality": 95} if kind in ("JPEG", "WEBP") else {}))
    return stream.getvalue()


class Glb:
    """A glTF file in the making: one node, one mesh of one primitive, the box."""

    KINDS = {np.dtype("u1"): 5121, np.dtype("i2"): 5122, np.dtype("u2"): 5123, np.dtype("u4"): 5125, np.dtype("f4"): 5126}

    def __init__(self, points=POINTS.astype("f4"), indices=TRIANGLES.astype("u2").ravel(), **material):
        self.binary = b""
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                     "accessors": [], "bufferViews": [], "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0, **material}}]}
        self.primitive = {"attributes": {"POSITION": self.accessor(points)}, "material": 0}
        if indices is not None:
            self.primitive["indices"] = self.accessor(indices)
        self.json["meshes"] = [{"primitives": [self.primitive]}]

    @property
    def pbr(self):
        return self.json["materials"][0]["pbrMetallicRoughness"]

    def view(self, contents, **more):
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(contents), **more})
        self.binary += contents + b"\0" * (-len(contents) % 4)
        return len(self.json["bufferViews"]) - 1

    def accessor(self, array, normalized=False):
        array = np.ascontiguousarray(array)
        width = array.shape[1] if array.ndim > 1 else 1
        stride, contents = {}, array.tobytes()
        if array.ndim > 1 and width * array.itemsize % 4:
            padded = np.zeros((len(array), width + (-width * array.itemsize % 4) // array.itemsize), array.dtype)
            padded[:, :width] = array
            stride, contents = {"byteStride": padded.shape[1] * array.itemsize}, padded.tobytes()
        accessor = {"bufferView": self.view(contents, **stride), "componentType": self.KINDS[array.dtype],
                    "count": len(array), "type": {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}[width]}
        if normalized:
            accessor["normalized"] = True
        if width == 3:
            accessor |= {"min": array.min(axis=0).tolist(), "max": array.max(axis=0).tolist()}
        self.json["accessors"].append(accessor)
        return len(self.json["accessors"]) - 1

    def attribute(self, name, array, normalized=False):
        self.primitive["attributes"][name] = self.accessor(array, normalized)
        return self

    def texture(self, image, kind="PNG"):
        view = self.view(encoded(image, kind))
        self.json.setdefault("images", []).append({"bufferView": view, "mimeType": f"image/{kind.lower()}"})
        self.json.setdefault("textures", []).append({"source": len(self.json["images"]) - 1})
        return {"index": len(self.json["textures"]) - 1}

    def textured(self, image=None, uv=UV, kind="PNG"):
        self.pbr["baseColorTexture"] = self.texture(image or picture(), kind)
        return self.attribute("TEXCOORD_0", down(uv).astype("f4"))

    def needs(self, extension):
        self.json["extensionsUsed"] = self.json["extensionsRequired"] = [extension]
        return self

    def write(self, path):
        whole = {**self.json, "buffers": [{"byteLength": len(self.binary)}]}
        text = json.dumps(whole).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(self.binary), 0x004E4942) + self.binary
        path.write_bytes(struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks)


def down(uv):
    """With v downwards, as in glTF."""
    return np.stack([uv[:, 0], 1 - uv[:, 1]], axis=1)


def obj(path, material="", polygons=TRIANGLES, points=POINTS, colours=None, mtllib=None, usemtl="paint", uv=UV, base=1):
    if material:
        path.with_suffix(".mtl").write_text(material)
    lines = [f"mtllib {mtllib or path.with_suffix('.mtl').name}", f"usemtl {usemtl}"] if material else []
    for i, point in enumerate(points):
        lines.append("v " + " ".join(f"{x:.9g}" for x in [*point, *(colours[i] if colours is not None else [])]))
    lines += [f"vt {u:.6f} {v:.6f}" for u, v in uv]
    lines += ["f " + " ".join(f"{c + base}/{c + base}" if len(uv) else f"{c + base}" for c in polygon) for polygon in polygons]
    path.write_text("\n".join(lines) + "\n")


def ply(path, vertex=None, face=None, kind="ascii", comment="", number="f4"):
    """`vertex` and `face`: (names, types, rows), after the coordinates and the corners."""
    names = {"f4": "float", "f8": "double", "u1": "uchar"}
    order = ">" if kind.endswith("big_endian") else "<"
    header = f"ply\nformat {kind} 1.0\n{comment}element vertex {len(POINTS)}\n"
    header += "".join(f"property {names[number]} {axis}\n" for axis in "xyz")
    if vertex:
        header += "".join(f"property {names[t]} {n}\n" for n, t in zip(*vertex[:2]))
    header += f"element face {len(TRIANGLES)}\nproperty list uchar int vertex_indices\n"
    wedge = face and face[0] == ["texcoord"]
    if wedge:
        header += "property list uchar float texcoord\n"
    elif face:
        header += "".join(f"property {names[t]} {n}\n" for n, t in zip(*face[:2]))
    body = b""
    for rows, extra, corner in ((POINTS, vertex, False), (TRIANGLES, face, True)):
        for i, row in enumerate(rows):
            more = list(extra[2][i]) if extra else []
            if kind == "ascii":
                words = ([3] if corner else []) + list(row) + ([len(more)] if corner and wedge else []) + more
                body += (" ".join(f"{w:.9g}" for w in words) + "\n").encode()
            else:
                body += (b"\3" + struct.pack(order + "3i", *row)) if corner else np.asarray(row, order + number).tobytes()
                if corner and wedge:
                    body += bytes([len(more)]) + np.asarray(more, order + "f4").tobytes()
                elif extra:
                    body += b"".join(np.asarray(m, order + t if t != "u1" else t).tobytes() for m, t in zip(more, extra[1]))
    path.write_bytes((header + "end_header\n").encode() + body)


def stl(path, header=b"", attribute=0):
    corners = POINTS[TRIANGLES].astype("<f4")
    facets = b"".join(b"\0" * 12 + c.tobytes() + struct.pack("<H", attribute) for c in corners)
    path.write_bytes(header.ljust(80, b"\0") + struct.pack("<I", len(corners)) + facets)


def cases(folder):
    thing = pathlib.Path(folder) / "thing"
    (thing / "textures").mkdir(parents=True, exist_ok=True)
    (thing.parent / "images").mkdir(exist_ok=True)
    all_cases = []

    def add(name, twin=None, has_colour=True):
        path = thing / name
        all_cases.append(Case(path, thing / twin if twin else path, has_colour))
        return path

    def glb(name, file, twin=None):
        file.write(add(name + ".glb", twin and twin + ".glb"))

    red, dark = [0.6, 0.05, 0.05, 1], [0.2, 0.2, 0.2, 1]
    glb("factor_red", Glb(baseColorFactor=red))
    glb("factor_dark", Glb(baseColorFactor=dark))
    for kind in ("PNG", "JPEG"):
        glb(f"texture_{kind.lower()}", Glb().textured(kind=kind))
    glb("factor_texture", Glb(baseColorFactor=red).textured(picture((255, 255, 255))))
    glb("factor_fields", Glb(baseColorFactor=[0.5, 0.8, 0.3, 1]).textured())
    floats = COLOURS.astype("f4")
    levels = np.round(COLOURS * 255).astype("u1")
    glb("color0_float", Glb().attribute("COLOR_0", floats))
    glb("color0_bytes", Glb().attribute("COLOR_0", np.c_[levels, np.full(24, 255, "u1")], True))
    glb("color0_shorts", Glb().attribute("COLOR_0", np.round(np.c_[COLOURS, np.ones(24)] * 65535).astype("u2"), True), "color0_bytes")
    glb("color0_factor_texture", Glb(baseColorFactor=[0.9, 0.7, 0.8, 1]).textured().attribute(
        "COLOR_0", np.c_[levels, np.full(24, 255, "u1")], True))
    file = Glb(baseColorFactor=red)
    file.json["nodes"] = [{"children": [1], "scale": [0.5, 2, 1], "rotation": [0, 0, 0.38268343, 0.92387953]},
                          {"mesh": 0, "translation": [0.1, 0.2, 0.3]}]
    glb("nodes", file)
    file = Glb(baseColorFactor=red)
    file.json["nodes"][0]["matrix"] = [0, 1.5, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0.1, 0.2, 0.3, 1]
    glb("matrix", file)
    file = Glb(baseColorFactor=red)
    file.json["nodes"].append({"mesh": 0, "translation": [0.2, 0, 0]})
    file.json["scenes"][0]["nodes"] = [0, 1]
    glb("two_nodes", file)
    file = Glb(baseColorFactor=red)
    file.json["materials"].append({"pbrMetallicRoughness": {"baseColorFactor": dark, "metallicFactor": 0}})
    second = {"attributes": file.primitive["attributes"], "material": 1, "indices": file.accessor(TRIANGLES[6:].astype("u1").ravel())}
    file.primitive["indices"] = file.accessor(TRIANGLES[:6].astype("u4").ravel())
    file.json["meshes"][0]["primitives"].append(second)
    glb("two_primitives", file)
    glb("no_indices", Glb(POINTS[TRIANGLES].reshape(-1, 3).astype("f4"), None, baseColorFactor=red))
    file = Glb(np.round(POINTS / 0.12 * 16383).astype("u2"), baseColorFactor=red).needs("KHR_mesh_quantization")
    file.json["nodes"][0]["scale"] = [0.12 / 16383] * 3
    glb("quantized", file, "factor_red")
    file = Glb(baseColorFactor=red)
    file.primitive["attributes"]["POSITION"] = file.accessor(np.round(POINTS / 0.12 * 65535).astype("u2"), True)
    file.json["nodes"][0]["scale"] = [0.12] * 3
    glb("quantized_normalized", file.needs("KHR_mesh_quantization"), "factor_red")
    file = Glb().textured(uv=UV * 0.1)
    file.attribute("TEXCOORD_1", down(UV).astype("f4")).pbr["baseColorTexture"]["texCoord"] = 1
    glb("texcoord1", file, "texture_png")
    for name, transform, uv in (("offset", {"offset": [0.3, 0.1]}, down(UV) + [0.3, 0.1]),
                                ("scale", {"scale": [0.5, 0.7]}, down(UV) * [0.5, 0.7]),
                                ("rotation", {"rotation": 0.5, "offset": [0.1, 0.4]},
                                 down(UV) @ np.array([[np.cos(0.5), -np.sin(0.5)], [np.sin(0.5), np.cos(0.5)]]) + [0.1, 0.4])):
        file = Glb().textured().needs("KHR_texture_transform")
        file.pbr["baseColorTexture"]["extensions"] = {"KHR_texture_transform": transform}
        glb(f"transform_{name}", file, f"transform_{name}_twin")
        glb(f"transform_{name}_twin", Glb().textured(uv=down(uv)))
    file = Glb().textured(kind="WEBP").needs("EXT_texture_webp")
    file.json["textures"][0] = {"extensions": {"EXT_texture_webp": {"source": 0}}}
    glb("webp", file, "texture_png")
    file = Glb().textured().needs("KHR_materials_pbrSpecularGlossiness")
    file.json["materials"][0] = {"extensions": {"KHR_materials_pbrSpecularGlossiness": {
        "diffuseFactor": [0.5, 0.8, 0.3, 1], "diffuseTexture": {"index": 0}, "specularFactor": [0, 0, 0]}}}
    glb("specular_glossiness", file, "factor_fields")
    file = Glb(baseColorFactor=red).needs("KHR_materials_unlit")
    file.json["materials"][0]["extensions"] = {"KHR_materials_unlit": {}}
    glb("unlit", file)
    file = Glb(baseColorFactor=red)
    places = file.view(np.array([1, 3], "u2").tobytes())
    values = file.view(POINTS[[1, 3]].astype("f4").tobytes())
    broken = POINTS.copy()
    broken[[1, 3]] = 9
    file.primitive["attributes"]["POSITION"] = file.accessor(broken.astype("f4"))
    file.json["accessors"][-1]["sparse"] = {"count": 2, "indices": {"bufferView": places, "componentType": 5123},
                                            "values": {"bufferView": values}}
    glb("sparse", file, "factor_red")
    file = Glb().textured()
    contents = {**file.json, "buffers": [{"byteLength": len(file.binary),
                                          "uri": "data:application/octet-stream;base64," + base64.b64encode(file.binary).decode()}]}
    add("data_uri.gltf", "texture_png.glb").write_text(json.dumps(contents))
    (thing / "textures" / "my fields.png").write_bytes(encoded(picture(), "PNG"))
    (thing / "beside.bin").write_bytes(file.binary)
    contents = {**file.json, "buffers": [{"byteLength": len(file.binary), "uri": "beside.bin"}],
                "images": [{"uri": "textures/my%20fields.png"}]}
    add("beside.gltf", "texture_png.glb").write_text(json.dumps(contents))

    obj(add("kd.obj"), "newmtl paint\nKd 0.6 0.05 0.05\n")
    for kind, ending in (("PNG", "png"), ("JPEG", "jpg"), ("BMP", "bmp"), ("TGA", "tga"), ("TIFF", "tif"), ("GIF", "gif"), ("WEBP", "webp")):
        picture().save(thing / f"fields.{ending}", kind)
        obj(add(f"texture_{ending}.obj", None if ending == "png" else "texture_png.obj"), f"newmtl paint\nKd 1 1 1\nmap_Kd fields.{ending}\n")
    picture((255, 255, 255)).save(thing / "white.png")
    obj(add("kd_texture.obj"), "newmtl paint\nKd 0.6 0.05 0.05\nmap_Kd white.png\n")
    obj(add("kd_fields.obj"), "newmtl paint\nKd 0.5 0.8 0.3\nmap_Kd fields.png\n")
    obj(add("kd_black_texture.obj"), "newmtl paint\nKd 0 0 0\nmap_Kd fields.png\n")
    picture().save(thing / "textures" / "fields.png")
    picture().save(thing.parent / "images" / "fields.png")
    obj(add("subfolder.obj", "texture_png.obj"), "newmtl paint\nKd 1 1 1\nmap_Kd textures/fields.png\n")
    obj(add("backslash.obj", "texture_png.obj"), "newmtl paint\nKd 1 1 1\nmap_Kd textures\\fields.png\n")
    obj(add("parent.obj", "texture_png.obj"), "newmtl paint\nKd 1 1 1\nmap_Kd ../images/fields.png\n")
    obj(add("blanks.obj", "texture_png.obj"), "newmtl paint \nKd 1 1 1 \nmap_Kd fields.png \n", usemtl="paint ", mtllib="blanks.mtl ")
    obj(add("missing_texture.obj", has_colour=False), "newmtl paint\nKd 1 1 1\nmap_Kd gone.png\n")
    quads = [[4 * side + k for k in ((0, 1, 2, 3) if side % 2 else (0, 3, 2, 1))] for side in range(6)]
    obj(add("quads.obj"), "newmtl paint\nKd 1 1 1\nmap_Kd fields.png\n", quads)
    obj(add("negative.obj", "texture_png.obj"), "newmtl paint\nKd 1 1 1\nmap_Kd fields.png\n", base=-24)
    obj(add("vertex_colours.obj"), colours=COLOURS, uv=())
    obj(add("far.obj", "grey.obj", has_colour=False), points=POINTS + [500000, 4500000, 100])
    text = (thing / "far.obj").read_text().splitlines()
    far = ["v " + " ".join(f"{x:.9f}" for x in p) for p in POINTS + [500000, 4500000, 100]]
    (thing / "far.obj").write_text("\n".join(far + [line for line in text if line[:2] != "v "]) + "\n")
    obj(add("grey.obj", has_colour=False))

    sides = np.repeat(np.linspace(0, 1, 6), 2)
    faces = np.round(np.stack([255 * sides, 255 - 200 * sides, np.full(12, 60)], axis=1)).astype(int)
    rgb = ["red", "green", "blue"]
    for kind in ("ascii", "binary_little_endian", "binary_big_endian"):
        ply(add(f"vertex_{kind}.ply"), (rgb, ["u1"] * 3, levels), kind=kind)
        ply(add(f"face_{kind}.ply"), face=(rgb, ["u1"] * 3, faces), kind=kind)
    ply(add("doubles.ply"), (rgb, ["u1"] * 3, levels), kind="binary_little_endian", number="f8")
    wedges = UV[TRIANGLES].reshape(12, 6)
    for kind in ("ascii", "binary_little_endian"):
        ply(add(f"wedge_{kind}.ply", "texture_png.obj"), face=(["texcoord"], ["f4"], wedges), kind=kind, comment="comment TextureFile fields.png\n")
    ply(add("st.ply", "texture_png.obj"), (["s", "t"], ["f4", "f4"], UV), comment="comment TextureFile fields.png\n")

    stl(add("plain.stl", has_colour=False))
    ply(add("magics_twin.ply"), (rgb, ["u1"] * 3, [[200, 40, 40]] * 24))
    stl(add("magics.stl", "magics_twin.ply"), b"COLOR=" + bytes([200, 40, 40, 255]), 0x8000)
    ply(add("viscam_twin.ply"), (rgb, ["u1"] * 3, [[255, 132, 0]] * 24))
    stl(add("viscam.stl", "viscam_twin.ply"), attribute=0x8000 | 31 << 10 | 16 << 5)
    text = "SOLID A\n"
    for corners in POINTS[TRIANGLES]:
        text += "FACET NORMAL 0 0 0\nOUTER LOOP\n" + "".join("VERTEX {:.6f} {:.6f} {:.6f}\n".format(*c) for c in corners) + "ENDLOOP\nENDFACET\n"
    add("upper.STL", "plain.stl", has_colour=False).write_text(text + "ENDSOLID A\n")
    return all_cases


if __name__ == "__main__":
    print(len(cases(sys.argv[1])), "files")
