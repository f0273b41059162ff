#!/usr/bin/env python3
"""Draws docs/figures/camera-convention.svg: the half-sphere of camera poses with its angles and the axes of a camera.

Needs nothing but Python. Run it after changing it: python3 docs/figures/make_camera_convention.py
"""
import math
from pathlib import Path

WIDTH, HEIGHT, SCALE = 720, 520, 210
CENTRE = (330, 380)
AZIMUTH, ELEVATION = math.radians(28), math.radians(20)  # where the drawing is seen from
THETA, PHI = math.radians(50), math.radians(42)


def project(point):
    """World (x, y, z), the radius being 1, to the picture."""
    x, y, z = point
    right = -x * math.sin(AZIMUTH) + y * math.cos(AZIMUTH)
    depth = x * math.cos(AZIMUTH) + y * math.sin(AZIMUTH)
    up = z * math.cos(ELEVATION) - depth * math.sin(ELEVATION)
    return CENTRE[0] + SCALE * right, CENTRE[1] - SCALE * up


def direction(theta, phi):
    return (math.cos(phi) * math.cos(theta), math.cos(phi) * math.sin(theta), math.sin(phi))


def scaled(vector, factor):
    return tuple(factor * v for v in vector)


def added(a, b):
    return tuple(x + y for x, y in zip(a, b))


def line(points, colour, width=1.5, dash="", arrow=""):
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(project, points))
    extra = (f' stroke-dasharray="{dash}"' if dash else "") + (f' marker-end="url(#{arrow})"' if arrow else "")
    return f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="{width}"{extra}/>'


def text(point, content, colour="#222", dx=0, dy=0, size=17):
    x, y = project(point)
    return f'<text x="{x + dx:.1f}" y="{y + dy:.1f}" fill="{colour}" font-size="{size}">{content}</text>'


def arc(function, start, end, steps=40):
    return [function(start + (end - start) * i / steps) for i in range(steps + 1)]


def drawing():
    grey, dark, red, blue, green = "#b8b8b8", "#444", "#c0392b", "#1f5fa8", "#2b8a4b"
    camera = direction(THETA, PHI)
    z = scaled(camera, -1)
    x = (math.sin(THETA), -math.cos(THETA), 0)
    y = (z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0])
    parts = [line(arc(lambda t: direction(t, 0), 0, 2 * math.pi, 90), grey)]
    for phi in (45, 60, 75):
        parts.append(line(arc(lambda t, p=math.radians(phi): direction(t, p), 0, 2 * math.pi, 90), grey, 0.8, "3 4"))
    for theta in range(0, 180, 45):
        parts.append(line(arc(lambda p, t=math.radians(theta): direction(t, p), 0, math.pi, 60), grey, 0.8, "3 4"))
    for axis, name, dx, dy in (((1.35, 0, 0), "x", -16, 12), ((0, 1.35, 0), "y", 8, 4), ((0, 0, 1.3), "z", 8, 0)):
        parts += [line([(0, 0, 0), axis], dark, 2, "", "dark"), text(axis, name, dark, dx, dy)]
    foot = direction(THETA, 0)
    parts += [line([(0, 0, 0), foot], dark, 1, "5 4"), line(arc(lambda p: direction(THETA, p), 0, PHI), dark, 1, "5 4"),
              line([(0, 0, 0), camera], dark, 1.5),
              line(arc(lambda t: scaled(direction(t, 0), 0.45), 0, THETA), red, 2.5, "", "red"),
              text(scaled(direction(THETA / 2, 0), 0.45), "θ", red, -4, 22, 20),
              line(arc(lambda p: scaled(direction(THETA, p), 0.55), 0, PHI), blue, 2.5, "", "blue"),
              text(scaled(direction(THETA, PHI / 2), 0.55), "φ", blue, 8, 6, 20),
              text(scaled(camera, 0.72), "R", dark, -20, 0), text((0, 0, 0), "GC", dark, -30, 4)]
    for vector, name, colour, mark in ((z, "z: towards GC", green, "green"), (x, "x: level", red, "red"), (y, "y: up", blue, "blue")):
        end = added(camera, scaled(vector, 0.3))
        parts += [line([camera, end], colour, 3, "", mark)]
        dx, dy = {"z": (8, 18), "x": (-66, -6), "y": (6, -6)}[name[0]]
        parts.append(text(end, name, colour, dx, dy, 15))
    cx, cy = project(camera)
    parts.append(f'<circle cx="{cx:.1f}" cy="{cy:.1f}" r="6" fill="{dark}"/>')
    gx, gy = project((0, 0, 0))
    parts.append(f'<circle cx="{gx:.1f}" cy="{gy:.1f}" r="5" fill="{dark}"/>')
    base = project(scaled(direction(math.radians(270), 0), 1.0))
    parts.append(f'<circle cx="{base[0]:.1f}" cy="{base[1]:.1f}" r="4" fill="{dark}"/>')
    parts.append(text(direction(math.radians(270), 0), "θ = 270°: the robot’s base", dark, -105, 24, 14))
    markers = "".join(
        f'<marker id="{name}" viewBox="0 0 10 10" refX="8" refY="5" markerWidth="5" markerHeight="5" orient="auto">'
        f'<path d="M0,0 L10,5 L0,10 z" fill="{colour}"/></marker>'
        for name, colour in (("dark", dark), ("red", red), ("blue", blue), ("green", green)))
    body = "\n".join(parts)
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif">\n'
            f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>\n<defs>{markers}</defs>\n{body}\n</svg>\n')


if __name__ == "__main__":
    Path(__file__).with_name("camera-convention.svg").write_text(drawing(), encoding="utf-8")
