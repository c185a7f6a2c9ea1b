#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the figures of the lessons, one per idea, as SVG files in docs/tutorial/lessons/images.

  scripts/docs/lesson_figures.py          writes the files
  scripts/docs/lesson_figures.py --check  exits with 1 if a file is not what this script draws
"""

import math
import sys
from pathlib import Path

IMAGES = Path(__file__).resolve().parents[2] / "docs" / "tutorial" / "lessons" / "images"
INK, SOFT, BLUE, RED, GREEN, YELLOW = "#222222", "#999999", "#2f6fb0", "#c0392b", "#2e8b57", "#e0a92e"


def number(value):
    """Returns a number with at most two decimals, the same on every machine."""
    text = f"{value:.2f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


class Figure:
    """A picture of lines, polygons, circles and texts. y points down."""

    def __init__(self, width, height, title):
        self.parts = [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
            'font-family="Helvetica, Arial, sans-serif" font-size="14">',
            f"<title>{title}</title>",
            f'<rect width="{width}" height="{height}" fill="#ffffff"/>',
        ]

    def polygon(self, points, fill="none", stroke=INK, width=1.5, opacity=1.0):
        text = " ".join(f"{number(x)},{number(y)}" for x, y in points)
        self.parts.append(
            f'<polygon points="{text}" fill="{fill}" fill-opacity="{number(opacity)}" stroke="{stroke}" stroke-width="{number(width)}"/>'
        )

    def box(self, x, y, width, height, fill="none", stroke=INK, opacity=1.0, line=1.5):
        self.polygon([(x, y), (x + width, y), (x + width, y + height), (x, y + height)], fill, stroke, line, opacity)

    def line(self, a, b, stroke=INK, width=1.5, dashed=False):
        dash = ' stroke-dasharray="5 4"' if dashed else ""
        self.parts.append(
            f'<line x1="{number(a[0])}" y1="{number(a[1])}" x2="{number(b[0])}" y2="{number(b[1])}" stroke="{stroke}" '
            f'stroke-width="{number(width)}"{dash}/>'
        )

    def arrow(self, a, b, stroke=INK, width=2):
        length = math.hypot(b[0] - a[0], b[1] - a[1])
        ux, uy = (b[0] - a[0]) / length, (b[1] - a[1]) / length
        base = (b[0] - 10 * ux, b[1] - 10 * uy)
        self.line(a, base, stroke, width)
        self.polygon([b, (base[0] - 4 * uy, base[1] + 4 * ux), (base[0] + 4 * uy, base[1] - 4 * ux)], stroke, stroke, 1)

    def curve(self, points, stroke=INK, width=2):
        text = " ".join(f"{number(x)},{number(y)}" for x, y in points)
        self.parts.append(f'<polyline points="{text}" fill="none" stroke="{stroke}" stroke-width="{number(width)}"/>')

    def dot(self, at, radius=3.5, fill=INK):
        self.parts.append(f'<circle cx="{number(at[0])}" cy="{number(at[1])}" r="{number(radius)}" fill="{fill}"/>')

    def text(self, x, y, words, fill=INK, anchor="start", size=14):
        self.parts.append(f'<text x="{number(x)}" y="{number(y)}" fill="{fill}" text-anchor="{anchor}" font-size="{size}">{words}</text>')

    def svg(self):
        return "\n".join([*self.parts, "</svg>"]) + "\n"


def half_planes():
    """The triangle of lesson 1, with the signs of its edge functions and its two pixels."""
    f = Figure(720, 310, "Three half-planes make a triangle")
    a, b, c = (190, 40), (320, 220), (60, 180)
    f.polygon([a, b, c], BLUE, "none", 0, 0.18)
    for p, q, name, x, y in ((a, b, "edge(a, b, p) = 0", 362, 290), (b, c, "edge(b, c, p) = 0", 392, 246), (c, a, "edge(c, a, p) = 0", 216, 22)):
        d = (q[0] - p[0], q[1] - p[1])
        ends = [(p[0] - 0.3 * d[0], p[1] - 0.3 * d[1]), (q[0] + 0.3 * d[0], q[1] + 0.3 * d[1])]
        f.line(*ends, SOFT, 1, True)
        f.arrow(p, q, BLUE)
        f.text(x, y, name, BLUE)
        # The inside is on the right of the walk: perpendicular to d, turned clockwise in the picture.
        middle, length = ((p[0] + q[0]) / 2, (p[1] + q[1]) / 2), math.hypot(*d)
        n = (-d[1] / length, d[0] / length)
        f.text(middle[0] + 16 * n[0], middle[1] + 16 * n[1] + 5, "+", GREEN, "middle", 20)
        f.text(middle[0] - 16 * n[0], middle[1] - 16 * n[1] + 5, "−", RED, "middle", 20)
    for at, name, dx in ((a, "a", -16), (b, "b", 10), (c, "c", -18)):
        f.dot(at)
        f.text(at[0] + dx, at[1] - 6, name)
    f.dot((180.5, 140.5), 4, GREEN)
    f.text(118, 164, "(150, 120): + + +", GREEN)
    f.dot((70.5, 60.5), 4, RED)
    f.text(20, 48, "(40, 40): + − +", RED)
    f.text(400, 60, "Walk from a to b to c to a:")
    f.text(400, 82, "the inside is on the right of each edge,")
    f.text(400, 104, "where its function is positive.")
    f.text(400, 140, "Order of the signs: bc, ca, ab.", SOFT)
    return f


def similar_triangles():
    """The image of a point: a small triangle and a large one with the same angles."""
    f = Figure(640, 260, "Projection by similar triangles")
    eye, axis = (60, 200), 200
    f.line((40, axis), (620, axis), SOFT, 1, True)
    near, far, height = 240, 560, 150
    y = height * (near - eye[0]) / (far - eye[0])
    f.polygon([eye, (far, axis), (far, axis - height)], BLUE, BLUE, 1, 0.1)
    f.polygon([eye, (near, axis), (near, axis - y)], RED, RED, 1, 0.25)
    f.line((near, 40), (near, 235), RED, 2)
    f.text(near, 30, "image", RED, "middle")
    f.line((far, axis), (far, axis - height), BLUE, 3)
    f.text(far + 10, axis - height / 2, "y", BLUE)
    f.text(near + 8, axis - y / 2 + 5, "f · y / distance", RED)
    f.dot(eye, 5)
    f.text(eye[0] - 8, eye[1] - 12, "eye", INK, "middle")
    f.arrow((eye[0], 228), (near, 228), RED, 1.5)
    f.text((eye[0] + near) / 2, 222, "f", RED, "middle")
    f.arrow((eye[0], 248), (far, 248), BLUE, 1.5)
    f.text((eye[0] + far) / 2 + 60, 242, "distance", BLUE, "middle")
    return f


def frustum():
    """The view volume from the side, with a polygon that reaches behind the camera."""
    f = Figure(640, 310, "View frustum and near plane")
    eye = (170, 150)
    near, far, slope = 60, 400, 0.3
    corners = [(eye[0] + x, 150 + sign * x * slope) for x, sign in ((near, -1), (far, -1), (far, 1), (near, 1))]
    f.polygon(corners, BLUE, BLUE, 1.5, 0.12)
    for s in (-1, 1):
        f.line(eye, (eye[0] + near, 150 + s * near * slope), BLUE, 1, True)
    f.line((eye[0] + near, 40), (eye[0] + near, 285), RED, 2)
    f.text(430, 155, "view frustum", BLUE, "middle")
    f.text(eye[0] + near, 30, "near plane: z + w = 0", RED, "middle")
    f.line((eye[0], 60), (eye[0], 280), SOFT, 1, True)
    f.text(eye[0] - 8, 290, "w = 0", SOFT, "end")
    f.dot(eye, 5)
    f.text(eye[0] - 10, 140, "eye", INK, "end")
    f.text(eye[0] + far, 295, "far plane: z = w", BLUE, "middle")
    a, b = (50, 235), (500, 235)
    cut = (eye[0] + near, 235)
    f.line(a, cut, SOFT, 4)
    f.line(cut, b, GREEN, 4)
    f.dot(cut, 5, RED)
    f.dot(a, 4, SOFT)
    f.dot(b, 4, GREEN)
    f.text(60, 256, "removed: d &lt; 0", SOFT)
    f.text(400, 256, "kept: e ≥ 0", GREEN, "middle")
    f.text(cut[0] + 8, 226, "t = d / (d − e)", RED)
    f.text(54, 80, "behind the", SOFT)
    f.text(54, 98, "camera: w &lt; 0", SOFT)
    return f


def mip_pyramid():
    """The levels of a texture of 8 x 8 texels; each texel is the mean of four."""
    f = Figure(720, 260, "Mip levels")
    texels = [[230 if (x // 2 + y // 2 + (x * y) % 3) % 2 == 0 else 60 for x in range(8)] for y in range(8)]
    x0, level = 20, 0
    while True:
        n = len(texels)
        size = 200 / 8
        for y in range(n):
            for x in range(n):
                v = round(texels[y][x])
                f.box(x0 + x * size, 20 + y * size, size, size, f"#{v:02x}{v:02x}{v:02x}", SOFT, 1, 0.5)
        f.text(x0, 20 + n * size + 20, f"level {level}: {n} x {n}")
        if n == 1:
            break
        texels = [[sum(texels[2 * y + j][2 * x + i] for j in (0, 1) for i in (0, 1)) / 4 for x in range(n // 2)] for y in range(n // 2)]
        x0, level = x0 + n * size + 40, level + 1
    f.text(270, 190, "Each texel is the mean of four texels of the level before.")
    f.text(270, 212, "A pixel that covers 4 x 4 texels of level 0 reads level 2.")
    return f


def reflection():
    """The four vectors of reflection, as unit vectors from a point of the surface."""
    f = Figure(640, 300, "The four vectors of reflection")
    p, r = (300, 240), 180
    f.line((80, 240), (560, 240), INK, 2)
    for x in range(90, 560, 20):
        f.line((x, 240), (x - 10, 252), SOFT, 1)
    vectors = (
        ("l: to the light", 35, YELLOW, "end"),
        ("n: normal", 0, INK, "middle"),
        ("r: reflected", -35, RED, "start"),
        ("e: to the eye", -58, BLUE, "start"),
    )
    for name, degrees, color, anchor in vectors:
        angle = math.radians(degrees)
        tip = (p[0] - r * math.sin(angle), p[1] - r * math.cos(angle))
        f.arrow(p, tip, color)
        f.text(tip[0] + (-8 if anchor == "end" else 8 if anchor == "start" else 0), tip[1] - 6, name, color, anchor)
    for sign in (-1, 1):
        arc = [(p[0] - 70 * math.sin(sign * math.radians(t)), p[1] - 70 * math.cos(math.radians(t))) for t in range(0, 36)]
        f.curve(arc, SOFT, 1.5)
        f.text(p[0] - sign * 28, p[1] - 84, "θ", SOFT, "middle")
    f.text(30, 30, "r = 2 (n · l) n − l")
    f.text(470, 30, "diffuse: cos θ = n · l", SOFT)
    f.text(470, 52, "highlight: r · e", SOFT)
    f.dot(p, 4)
    return f


def tangent_frame():
    """Tangent, bitangent and normal of a curved surface, and a normal of the map."""
    f = Figure(720, 280, "Tangent frame")
    left = [(60 + 4 * i, 200 - 40 * math.sin(math.pi * i / 80)) for i in range(81)]
    back = [(x + 130, y - 80) for x, y in left]
    f.polygon([*left, *reversed(back)], BLUE, BLUE, 1.5, 0.15)
    p = (285, 122)
    f.arrow(p, (p[0] + 110, p[1] + 2), RED)
    f.text(p[0] + 116, p[1] + 8, "tangent", RED)
    f.arrow(p, (p[0] + 62, p[1] - 38), GREEN)
    f.text(p[0] + 66, p[1] - 44, "bitangent", GREEN)
    f.arrow(p, (p[0], p[1] - 100), INK)
    f.text(p[0] - 6, p[1] - 104, "normal", INK, "end")
    f.arrow(p, (p[0] + 0.5 * 110, p[1] + 0.5 * 2 - 0.86 * 100), YELLOW, 3)
    f.text(p[0] + 60, p[1] - 92, "normal of the map: 0.5 · tangent + 0.86 · normal", YELLOW)
    f.text(60, 228, "The tangent points to where u increases, and the bitangent to where v decreases.")
    f.text(60, 250, "A texel (x, y, z) stands for x · tangent + y · bitangent + z · normal.")
    f.text(60, 272, "The bluish texel (128, 128, 255) is the normal itself: x = y = 0, z = 1.", SOFT)
    return f


def shadow_texel():
    """A texel of the shadow map on a surface at an angle, and the bias that it needs."""
    f = Figure(720, 320, "A texel of the shadow map on a slope")
    # The light shines straight down; the texel has the width w, and the surface falls to the right.
    x0, w, top, slope = 220, 200, 110, 0.5
    f.line((100, top - 120 * slope), (582, top + 362 * slope), INK, 2)
    for x in range(120, 440, 40):
        f.line((x, 14), (x, top + (x - x0) * slope - 4), YELLOW, 1)
    f.text(440, 26, "light", YELLOW)
    for x in (x0, x0 + w):
        f.line((x, 30), (x, 290), SOFT, 1, True)
    middle = (x0 + w / 2, top + w / 2 * slope)
    f.line((x0, middle[1]), (x0 + w, middle[1]), RED, 2.5)
    f.text(x0 - 8, middle[1] + 5, "stored depth", RED, "end")
    f.dot(middle, 4, RED)
    f.polygon([middle, (x0 + w, middle[1]), (x0 + w, middle[1] + w / 2 * slope)], RED, "none", 0, 0.25)
    f.line((x0 + w + 14, middle[1]), (x0 + w + 14, middle[1] + w / 2 * slope), BLUE, 2)
    f.text(x0 + w + 22, middle[1] + w / 4 * slope - 12, "bias ≥ w / 2 · tan θ", BLUE)
    # The angle between the normal and the direction to the light.
    p, theta = (x0 + 320, top + 320 * slope), math.atan(slope)
    f.arrow(p, (p[0], p[1] - 80), YELLOW)
    f.arrow(p, (p[0] + 80 * math.sin(theta), p[1] - 80 * math.cos(theta)))
    f.curve([(p[0] + 45 * math.sin(theta * i / 10), p[1] - 45 * math.cos(theta * i / 10)) for i in range(11)], SOFT, 1.5)
    f.text(p[0] + 14, p[1] - 50, "θ", SOFT, "middle")
    f.text(p[0] - 8, p[1] - 70, "to the light", YELLOW, "end")
    f.text(p[0] + 44, p[1] - 70, "normal")
    f.arrow((x0, 276), (x0 + w, 276), SOFT, 1)
    f.text(middle[0], 294, "w: one texel", SOFT, "middle")
    f.text(20, 310, "The red part of the surface is farther from the light than the stored depth: it would shadow itself.", RED, "start", 12)
    return f


def lanes():
    """Eight lanes at the border of a triangle, and their mask."""
    f = Figure(720, 260, "Eight lanes and their mask")
    size, x0 = 60, 80
    inside = [x0 + (i + 0.5) * size > 270 for i in range(8)]
    for i in range(8):
        f.box(x0 + i * size, 40, size, size, GREEN if inside[i] else "#ffffff", SOFT, 0.3)
        f.dot((x0 + (i + 0.5) * size, 70), 3)
        f.text(x0 + (i + 0.5) * size, 30, f"lane {i}", SOFT, "middle", 12)
        rows = (("mask", str(inside[i]).lower()), ("new", "new"), ("old", "old"), ("select", "new" if inside[i] else "old"))
        for row, (name, words) in enumerate(rows):
            color = GREEN if words in ("true", "new") else RED
            f.text(x0 + (i + 0.5) * size, 135 + 26 * row, words, color, "middle")
            if i == 0:
                f.text(12, 135 + 26 * row, name)
    f.line((300, 36), (240, 104), BLUE, 2.5)
    f.text(12, 75, "pixels")
    f.text(12, 246, "All lanes compute the new color. select(mask, new, old) keeps the old one outside of the triangle.", SOFT, "start", 12)
    return f


def overlaps(triangle, left, top, size):
    """Whether a triangle, clockwise in the picture, overlaps a square: neither is beyond an edge of the other."""
    square = [(left, top), (left + size, top), (left + size, top + size), (left, top + size)]

    def meets_inside(polygon, points):
        edges = zip(polygon, polygon[1:] + polygon[:1])
        return all(max((bx - ax) * (y - ay) - (by - ay) * (x - ax) for x, y in points) > 0 for (ax, ay), (bx, by) in edges)

    return meets_inside(list(triangle), square) and meets_inside(square, triangle)


def bins():
    """Three triangles on a grid of tiles, and the list of each tile."""
    f = Figure(720, 300, "Tiles and bins")
    size, y0 = 80, 20
    triangles = (
        ("A", BLUE, ((40, 50), (140, 60), (50, 130))),
        ("B", RED, ((120, 40), (320, 150), (130, 200))),
        ("C", GREEN, ((230, 190), (330, 200), (270, 245))),
    )
    for row in range(3):
        for column in range(4):
            left, right, top = 20 + column * size, 380 + column * size, y0 + row * size
            names = [name for name, _, points in triangles if overlaps(points, left, top, size)]
            for x in (left, right):
                f.box(x, top, size, size, "none", SOFT, 1, 1)
            f.text(right + size / 2, top + 45, " ".join(names), INK, "middle")
    for name, color, points in triangles:
        f.polygon(points, color, color, 2, 0.25)
        center = (sum(x for x, _ in points) / 3, sum(y for _, y in points) / 3)
        f.text(center[0], center[1] + 5, name, color, "middle", 18)
    f.text(20, 285, "tiles of the picture")
    f.text(380, 285, "bins: the triangles that overlap the tile")
    return f


def encoded(light):
    """The sRGB encoding of linear light, from 0 to 1."""
    return 12.92 * light if light <= 0.0031308 else 1.055 * light ** (1 / 2.4) - 0.055


def gamma():
    """The sRGB curve, and stripes of black and white next to two grays."""
    f = Figure(640, 300, "Linear light and sRGB")
    x0, y0, size = 60, 250, 220
    f.line((x0, y0), (x0 + size, y0))
    f.line((x0, y0), (x0, y0 - size))
    f.curve([(x0 + size * i / 100, y0 - size * encoded(i / 100)) for i in range(101)], BLUE)
    f.line((x0, y0), (x0 + size, y0 - size), SOFT, 1, True)
    v = encoded(0.5)
    f.line((x0 + size / 2, y0), (x0 + size / 2, y0 - size * v), RED, 1, True)
    f.line((x0, y0 - size * v), (x0 + size / 2, y0 - size * v), RED, 1, True)
    f.text(x0 + size / 2, y0 + 18, "0.5", RED, "middle")
    f.text(x0 - 6, y0 - size * v + 5, str(round(255 * v)), RED, "end")
    f.text(x0 - 6, y0 - size + 5, "255", INK, "end")
    f.text(x0 + size, y0 + 36, "light", INK, "end")
    f.text(x0 - 40, y0 - size - 10, "stored byte")
    for i in range(60):
        f.box(340, 40 + 3 * i, 90, 3, "#ffffff" if i % 2 == 0 else "#000000", "none", 1, 0)
    f.box(430, 40, 90, 180, "#bcbcbc", "none", 1, 0)
    f.box(520, 40, 90, 180, "#808080", "none", 1, 0)
    f.text(385, 240, "half white,", INK, "middle")
    f.text(385, 258, "half black", INK, "middle")
    f.text(475, 240, "188: the", GREEN, "middle")
    f.text(475, 258, "same light", GREEN, "middle")
    f.text(565, 240, "128: the mean", RED, "middle")
    f.text(565, 258, "of the bytes", RED, "middle")
    f.text(475, 26, "Look from a distance: which gray is the mean?", INK, "middle")
    return f


def samples():
    """A pixel with four samples at OpenGL's standard places, and an edge."""
    f = Figure(720, 280, "Four samples of a pixel")
    x0, y0, size = 40, 30, 220
    f.polygon([(x0, y0 + 35), (x0 + size, y0 + 115), (x0 + size, y0 + size), (x0, y0 + size)], BLUE, "none", 0, 0.25)
    f.box(x0, y0, size, size)
    f.line((x0 - 22, y0 + 27), (x0 + size + 22, y0 + 123), BLUE, 2)
    covered = 0
    for x, y in ((6, 2), (14, 6), (2, 10), (10, 14)):  # in sixteenths, from the lower left
        px, py = x0 + x / 16 * size, y0 + size - y / 16 * size
        inside = (py - y0) > 35 + 80 * (px - x0) / size
        covered += inside
        f.dot((px, py), 7, BLUE if inside else SOFT)
    f.line((x0 + size / 2 - 6, y0 + size / 2), (x0 + size / 2 + 6, y0 + size / 2), INK, 1)
    f.line((x0 + size / 2, y0 + size / 2 - 6), (x0 + size / 2, y0 + size / 2 + 6), INK, 1)
    f.text(310, 80, f"{covered} of 4 samples are covered.", BLUE)
    f.text(310, 106, f"The pixel becomes {covered}/4 · triangle + {4 - covered}/4 · background.")
    f.text(310, 132, "With one sample, only the center (+) counts.", SOFT)
    return f


FIGURES = {
    function.__name__: function
    for function in (half_planes, similar_triangles, frustum, mip_pyramid, reflection, tangent_frame, shadow_texel, lanes, bins, gamma, samples)
}


def main(arguments):
    if arguments not in ([], ["--check"]):
        print(__doc__, file=sys.stderr)
        return 2
    stale = 0
    for name, draw in FIGURES.items():
        path, svg = IMAGES / f"{name}.svg", draw().svg()
        if path.exists() and path.read_text(encoding="utf-8") == svg:
            continue
        if arguments:
            print(f"lesson_figures.py: {path.name} is not what this script draws; run it without --check", file=sys.stderr)
            stale += 1
        else:
            path.write_text(svg, encoding="utf-8")
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
