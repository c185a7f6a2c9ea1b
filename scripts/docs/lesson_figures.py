#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the figures of the lessons, one per idea, as SVG files in docs/tutorial/lessons/images.

  scripts/docs/lesson_figures.py          writes the files
  scripts/docs/lesson_figures.py --check  exits with 1 if a file is not what this script draws
"""

import math
import sys
from fractions import Fraction
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


def strip_triangles(first, vertices):
    """The triangles of a strip, as numbers of vertices: each vertex from the third forms one with the two before it."""
    return [(k, k + 1, k + 2) for k in range(first, first + vertices - 2)]


def geometry_stage():
    """Two triangles of lesson 15, the strips that the geometry function emits for them, and the triangles in the order of drawing."""
    f = Figure(720, 330, "From a triangle to strips, and from strips to triangles")
    for x, words in ((90, "in"), (265, "strip of the quill"), (400, "strip of the skin"), (605, "drawn in this order")):
        f.text(x, 24, words, SOFT, "middle")
    along, across = (-30, -120), (12, -3)  # as in the program, `across` is perpendicular to `along` and a tenth as long
    drawn = []
    for name, top, grows in (("A", 170, True), ("B", 270, False)):
        corners = [(-60, 20), (70, 10), (-10, -36)]
        root = (sum(x for x, _ in corners) / 3, sum(y for _, y in corners) / 3)
        f.polygon([(90 + x, top + y) for x, y in corners], SOFT, INK, 1.5, 0.2)
        f.text(90 + root[0], top + root[1] + 5, name, INK, "middle", 18)
        f.text(90, top + 40, f"grows = {str(grows).lower()}", GREEN if grows else RED, "middle", 12)
        f.arrow((180, top), (212, top), SOFT)
        strips = []
        if grows:
            side = [root[0] + 0.3 * along[0], root[1] + 0.3 * along[1]]
            quill = [root, (side[0] - across[0], side[1] - across[1]), (side[0] + across[0], side[1] + across[1]), (root[0] + along[0], root[1] + along[1])]
            strips.append((BLUE, [(280 + x, top + 8 + y) for x, y in quill]))
        else:
            f.text(265, top + 5, "none", RED, "middle", 12)
        strips.append((YELLOW, [(395 + x, top + y) for x, y in corners]))
        first = 1
        for color, points in strips:
            triangles = strip_triangles(first, len(points))
            for t in triangles:
                f.polygon([points[k - first] for k in t], color, color, 1.5, 0.3)
            center = sum(x for x, _ in points) / len(points)
            for k, (x, y) in enumerate(points):
                f.dot((x, y), 3)
                end = len(points) == 4 and k in (0, 3)
                f.text(x if end else x + (-9 if x < center else 9), y + (16 if k == 0 else -7) if end else y + 5, str(first + k), INK,
                       "middle" if end else "end" if x < center else "start", 12)
            drawn += [(name, color, t) for t in triangles]
            first += len(points)
        f.arrow((482, top), (510, top), SOFT)
    for row, (name, color, t) in enumerate(drawn):
        y = 102 + 36 * row + (46 if name == "B" else 0)
        f.box(520, y, 170, 28, color, color, 0.3)
        f.text(534, y + 19, f"{row + 1}.  {name}: {' '.join(map(str, t))}")
    return f


def divided_square(outer, inner):
    """The triangles that tessellation makes of the square, as corners (u, v). outer: left, bottom, right, top; inner: along u, along v.
    This is tessellate_quad in src/raster/amplify/tessellator.cpp for equal spacing and inner levels of at least 2."""
    columns, rows = inner
    # The points of the four sides, counterclockwise from v = 0: as their position on the side and their distance from it.
    turned = (lambda p, d: (p, d), lambda p, d: (1 - d, p), lambda p, d: (1 - p, 1 - d), lambda p, d: (d, 1 - p))
    outer_sides = [[(Fraction(k, n), 0) for k in range(n + 1)] for n in (outer[1], outer[2], outer[3], outer[0])]
    inner_sides = [[(Fraction(k, n), Fraction(1, m)) for k in range(1, n)] for n, m in ((columns, rows), (rows, columns)) * 2]
    triangles = []
    for x in range(1, columns - 1):
        for y in range(1, rows - 1):
            a, b, c, d = ((Fraction(x + i, columns), Fraction(y + j, rows)) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)))
            triangles += [(a, b, c), (a, c, d)]
    for turn, far, near in zip(turned, outer_sides, inner_sides):
        i = j = 0
        while i + 1 < len(far) or j + 1 < len(near):
            # Go on along the side whose next segment has its middle first.
            along_outer = j + 1 == len(near) or (i + 1 < len(far) and far[i][0] + far[i + 1][0] <= near[j][0] + near[j + 1][0])
            corners = (far[i], far[i + 1], near[j]) if along_outer else (far[i], near[j + 1], near[j])
            triangles.append(tuple(turn(*corner) for corner in corners))
            i, j = (i + 1, j) if along_outer else (i, j + 1)
    return triangles


def teapot_patch():
    """The 16 points of a patch of the near teapot of lesson 16: a quarter of the upper body, whose last row is on the widest circle."""
    rings = ((1.5, 2.4), (1.75, 1.875), (2, 1.35), (2, 0.9))
    return [(x - 1.5, y, z + 1) for r, y in rings for x, z in ((r, 0), (r, 0.56 * r), (0.56 * r, r), (0, r))]


def patch_levels(points, eye):
    """The levels of the four edges (left, bottom, right, top), as the control function of lesson 16 computes them."""

    def level(i, step):
        edge = [points[i + k * step] for k in range(4)]
        return max(16 * sum(math.dist(a, b) for a, b in zip(edge, edge[1:])) / math.dist(edge[0], eye), 1)

    return level(0, 4), level(0, 1), level(3, 4), level(12, 1)


def evaluated(points, u, v):
    """The point of the patch at (u, v): the sum of its points, each times two Bernstein polynomials."""
    a, b = (((1 - t) ** 3, 3 * (1 - t) ** 2 * t, 3 * (1 - t) * t**2, t**3) for t in (float(u), float(v)))
    return [sum(points[i][k] * a[i % 4] * b[i // 4] for i in range(16)) for k in range(3)]


def tessellation():
    """The square of lesson 16, divided by the levels of a patch of its teapot, and the divided patch."""
    f = Figure(720, 340, "Levels, points of the square, and the divided patch")
    eye, points = (0, 4, 9), teapot_patch()
    levels = patch_levels(points, eye)
    outer = [math.ceil(level) for level in levels]
    inner = (max(outer[1], outer[3]), max(outer[0], outer[2]))
    triangles = divided_square(outer, inner)
    x0, y0, size = 110, 60, 220
    # The view of lesson 4, from the eye to the middle of the patch, without perspective.
    middle = evaluated(points, 0.5, 0.5)
    back = [(e - m) / math.dist(eye, middle) for e, m in zip(eye, middle)]
    length = math.hypot(back[0], back[2])
    right = (back[2] / length, 0, -back[0] / length)
    up = (back[1] * right[2], back[2] * right[0] - back[0] * right[2], -back[1] * right[0])

    def in_square(u, v):
        return (x0 + float(u) * size, y0 + float(1 - v) * size)

    def in_view(u, v):
        offset = [a - b for a, b in zip(evaluated(points, u, v), middle)]
        return (610 + 85 * sum(a * b for a, b in zip(right, offset)), 170 - 85 * sum(a * b for a, b in zip(up, offset)))

    for place in (in_square, in_view):
        for corners in triangles:
            f.polygon([place(*corner) for corner in corners], BLUE, SOFT, 1, 0.1)
        for u, v in sorted({corner for corners in triangles for corner in corners}):
            f.dot(place(u, v), 3.5, RED if u in (0, 1) or v in (0, 1) else BLUE)
    texts = [f"{level:.2f} → {n}" for level, n in zip(levels, outer)]
    f.text(x0 - 10, y0 + size / 2 - 4, "left", RED, "end")
    f.text(x0 - 10, y0 + size / 2 + 14, texts[0], RED, "end")
    f.text(x0 + size / 2, y0 + size + 20, f"bottom {texts[1]}", RED, "middle")
    f.text(x0 + size + 10, y0 + size / 2 - 4, "right", RED)
    f.text(x0 + size + 10, y0 + size / 2 + 14, texts[2], RED)
    f.text(x0 + size / 2, y0 - 10, f"top {texts[3]}", RED, "middle")
    f.text(x0 - 10, y0 + size + 6, "(0, 0)", SOFT, "end", 12)
    f.text(x0 + size + 10, y0 + 4, "(1, 1)", SOFT, "start", 12)
    f.arrow((x0 + size + 20, y0 + size - 24), (x0 + size + 100, y0 + size - 24), SOFT)
    f.text(x0 + size + 58, y0 + size - 32, "evaluate", SOFT, "middle")
    for u, v, dx, dy, anchor in ((0, 0, 8, -6, "start"), (1, 1, -8, 14, "end")):
        at = in_view(u, v)
        f.text(at[0] + dx, at[1] + dy, f"({u}, {v})", SOFT, anchor, 12)
    f.text(20, 24, "outer levels, rounded up", RED)
    f.text(20, 328, f"inner levels: {inner[0]} along u, {inner[1]} along v", BLUE)
    f.text(610, 328, f"{len(triangles)} triangles", INK, "middle")
    return f


def cube_map():
    """A direction in a cube, the face that it meets, and the place on this face."""
    f = Figure(720, 300, "A direction, its face, and its place on the face")
    direction, face = (3, 1, -2), "+x"  # x has the largest magnitude, and is positive
    hit = [Fraction(value, direction[0]) for value in direction]
    s, t = -hit[2], -hit[1]  # the face +x contains the directions (1, -t, -s)

    def signed(value):
        return str(value).replace("-", "−")

    def at(x, y, z):  # z points to the reader, to the lower left
        return (160 + 85 * float(x) - 48 * float(z), 165 - 85 * float(y) + 34 * float(z))

    corners = [(1, 1, 1), (1, 1, -1), (1, -1, -1), (1, -1, 1)]
    f.polygon([at(*c) for c in corners], BLUE, BLUE, 2, 0.15)
    for y, z in ((1, 1), (1, -1), (-1, -1), (-1, 1)):
        f.line(at(-1, y, z), at(1, y, z), SOFT, 1)
    f.polygon([at(-1, y, z) for _, y, z in corners], "none", SOFT, 1)
    f.arrow(at(0, 0, 0), at(*hit), RED, 2.5)
    f.dot(at(0, 0, 0), 5)
    f.dot(at(*hit), 4, RED)
    f.text(at(0, 0, 0)[0] - 10, at(0, 0, 0)[1] - 8, "eye", INK, "end")
    for name, dx, dy in (("x", 34, 0), ("y", 0, -34), ("z", -24, 17)):
        f.arrow((44, 54), (44 + dx, 54 + dy), SOFT, 1.5)
        f.text(44 + 1.3 * dx, 59 + 1.3 * dy, name, SOFT, "middle", 12)
    # s and t on the edges of the face.
    edge = at(1, 1, 1)
    f.arrow((edge[0] - 4, edge[1] - 8), (at(1, 1, -1)[0] - 4, at(1, 1, -1)[1] - 8), INK, 1.5)
    f.text(at(1, 1, 0)[0] - 14, at(1, 1, 0)[1] - 12, "s", INK, "middle")
    f.arrow((edge[0] - 9, edge[1]), (edge[0] - 9, at(1, -1, 1)[1]), INK, 1.5)
    f.text(edge[0] - 20, at(1, -0.4, 1)[1], "t", INK, "middle")
    f.text(at(1, -1, 0)[0] + 10, at(1, -1, 0)[1] + 22, f"face {face}", BLUE)

    x0, y0, size = 335, 55, 180
    f.box(x0, y0, size, size, BLUE, BLUE, 0.15, 2)
    center = (x0 + size / 2, y0 + size / 2)
    place = (center[0] + float(s) * size / 2, center[1] + float(t) * size / 2)
    f.line((x0, center[1]), (x0 + size, center[1]), SOFT, 1)
    f.line((center[0], y0), (center[0], y0 + size), SOFT, 1)
    f.arrow((x0, y0 - 12), (x0 + size, y0 - 12), INK, 1.5)
    f.text(center[0], y0 - 20, "s", INK, "middle")
    f.arrow((x0 - 12, y0), (x0 - 12, y0 + size), INK, 1.5)
    f.text(x0 - 24, center[1] + 5, "t", INK, "middle")
    f.text(x0, y0 + size + 16, "s = −1", SOFT, "start", 12)
    f.text(x0 + size, y0 + size + 16, "s = 1", SOFT, "end", 12)
    f.text(x0 + size + 6, y0 + 8, "t = −1", SOFT, "start", 12)
    f.text(x0 + size + 6, y0 + size, "t = 1", SOFT, "start", 12)
    f.line(place, (place[0], center[1]), RED, 1, True)
    f.line(place, (center[0], place[1]), RED, 1, True)
    f.dot(place, 5, RED)
    f.text(place[0], center[1] + 18, signed(s), RED, "middle")
    f.text(center[0] - 8, place[1] + 5, signed(t), RED, "end")
    f.text(x0, y0 + size + 36, f"the texture of the face {face}", BLUE)

    order = sorted(direction, key=abs, reverse=True)
    for y, words, color in (
        (90, f"direction ({', '.join(map(signed, direction))})", RED),
        (120, " &gt; ".join(f"|{signed(value)}|" for value in sorted(direction, key=abs, reverse=True)), INK),
        (142, f"so the face is {face}", INK),
        (172, f"divided by {direction[0]}:", INK),
        (194, f"({', '.join(map(signed, hit))})", RED),
        (216, "= (1, −t, −s)", INK),
        (246, f"s = {signed(s)}, t = {signed(t)}", RED),
    ):
        f.text(570, y, words, color)
    return f


FIGURES = {
    function.__name__: function
    for function in (
        half_planes,
        similar_triangles,
        frustum,
        mip_pyramid,
        reflection,
        tangent_frame,
        shadow_texel,
        lanes,
        bins,
        gamma,
        samples,
        geometry_stage,
        tessellation,
        cube_map,
    )
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
