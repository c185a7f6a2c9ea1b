# SPDX-License-Identifier: Apache-2.0
"""Passes with depth only, narrow formats, instances and occlusion queries, and the shaders for normal maps, spheres and skies."""

import numpy as np
import pytest

import halfspace
from halfspace import draw
from test_draw import CORNERS, GREEN, RED, paint, plane

UVS = CORNERS * [0.5, -0.5] + np.float32(0.5)  # v = 0 is the top row of the texture
NORMALS = np.tile(np.array([[0, 0, 1]], np.float32), (6, 1))
POINTS = draw.State(topology="points", depth_clip="zero_to_one", depth_compare="greater")


def test_a_pass_without_color_writes_depth():
    depth = np.zeros((2, 3), np.float32)
    p = draw.Pass(None, depth)
    paint(p, RED, 0.5)
    assert p.run() == 1 and (depth == 0.75).all()


def test_depth_only_draws_keep_the_color():
    image, depth = np.full((1, 2, 4), 0.5, np.float32), np.zeros((1, 2), np.float32)
    texels = np.full((1, 2, 4), 255, np.uint8)
    texels[0, 0, 3] = 100
    holes = halfspace.Texture(texels, filter="nearest", wrap="clamp")
    p = draw.Pass(image, depth, load=False, clear_color=(0.5, 0.5, 0.5, 0.5))
    p.draw(draw.depth_only(np.eye(4), texture=holes), positions=plane(-0.5), uvs=UVS)
    p.draw(draw.depth_only(np.eye(4)), positions=plane(0.5))
    p.run()
    assert (image == 0.5).all() and depth.tolist() == [[0.75, 0.25]]
    p.draw(draw.depth_only(np.eye(4), texture=holes, cutoff=0.25), positions=plane(-0.5), uvs=UVS)
    p.run()
    assert depth.tolist() == [[0.25, 0.25]]


@pytest.mark.parametrize("shape", [(1, 1), (1, 1, 2), (1, 1, 3)])
def test_narrow_formats_store_the_first_channels(shape):
    image = np.zeros(shape, np.float32)
    p = draw.Pass(image)
    paint(p, (0.5, 0.25, 2, 1))
    p.run()
    assert image.ravel().tolist() == [0.5, 0.25, 2][: image.size]


def test_normal_maps():
    texel = np.array([204, 128, 230])  # about (0.6, 0, 0.8)
    normal = 2 * texel / 255 - 1
    normal /= np.linalg.norm(normal)
    tangents = np.tile(np.array([[1, 0, 0, 1]], np.float32), (6, 1))
    texture = np.full((2, 2, 3), texel, np.uint8)
    for axis, scale in ((0, 1), (2, 1), (2, 0)):
        image = np.zeros((1, 1, 4), np.float32)
        towards = np.eye(3)[axis]
        p = draw.Pass(image)
        p.draw(draw.phong(np.eye(4), eye=(0, 0, 5), lights=[draw.light(place=towards)], normal_texture=texture, normal_scale=scale),
               positions=plane(), normals=NORMALS, tangents=tangents, uvs=UVS)
        p.run()
        assert abs(image[0, 0, 0] - (normal[axis] if scale else 1)) < 1e-6


@pytest.mark.parametrize("texel, expected", [
    (np.array([32800, 32960, 0], np.uint16), ((np.array([32800, 32960, 0]) / 65535 + 0.055) / 1.055) ** 2.4 * [1, 1, 0]),
    (np.array([0.1, 3.5, 0.0], np.float32), [0.1, 3.5, 0.0]),
])
def test_textures_with_more_than_8_bits(texel, expected):
    image = np.zeros((1, 1, 4), np.float32)
    p = draw.Pass(image)
    p.draw(draw.phong(np.eye(4), eye=(0, 0, 5), ambient=(1, 1, 1), texture=np.full((2, 2, 3), texel)),
           positions=plane(), normals=NORMALS, uvs=UVS)
    p.run()
    assert np.allclose(image[0, 0, :3], expected, rtol=1e-6, atol=0)


@pytest.mark.parametrize("height", [None, 4.0])
def test_spheres_are_exact(height):
    image, depth = np.zeros((41, 41, 4), np.float32), np.zeros((41, 41), np.float32)
    near, far = 1.0, 20.0
    pose = np.eye(4)[:, [2, 1, 0, 3]] * [1, 1, -1, 1]  # looks along +x, so that right is +z
    pose[:3, 3] = (10, 20, 30)
    lamp = draw.light("point", place=(15, 20, 90))  # far to the right of the sphere
    p = draw.Pass(image, depth, clear_depth=0)
    p.draw(draw.spheres((41, 41), pose=pose, fov=40, height=height, near=near, far=far, ambient=(0.25, 0.25, 0.25), lights=[lamp]),
           centers=[[0, 0, 5]], radii=[1.0], colors=[[1, 0.5, 0]], state=POINTS)
    p.run()
    reversed_depth = near * (far - 4) / (4 * (far - near)) if height is None else (far - 4) / (far - near)
    assert abs(depth[20, 20] - reversed_depth) < 1e-6
    y, x = np.mgrid[0:41, 0:41]
    half = np.tan(np.radians(20)) if height is None else height / 2
    a, b = ((x + 0.5) / 20.5 - 1) * half, (1 - (y + 0.5) / 20.5) * half
    # A ray (a, b, 1) t touches the sphere if its distance from the center is 1; a parallel ray, if a^2 + b^2 is 1.
    inside = (25 - 25 / (a * a + b * b + 1) <= 1) if height is None else a * a + b * b <= 1
    assert np.array_equal(depth > 0, inside) and inside.sum() > 100
    assert image[20, 20, :3].tolist() == [0.25, 0.125, 0] or image[20, 20, 0] > 0.25
    right, left = inside & (x > 25), inside & (x < 15)
    assert (image[right, 0] > 0.3).all() and (image[left, 0] == 0.25).all() and (image[left, 1] == 0.125).all()


def test_the_sky_covers_what_is_not_drawn():
    panorama = np.zeros((4, 8, 3), np.uint8)
    panorama[:, :4, 0], panorama[:, 4:, 1] = 255, 255
    behind = draw.State(depth_clip="zero_to_one", depth_compare="greater_equal", depth_write=False)
    image = np.zeros((2, 4, 4), np.float32)
    p = draw.Pass(image, clear_depth=0)
    p.draw(draw.sky((4, 2), panorama), state=behind)
    p.run()
    assert (image[:, 0, :3] == [1, 0, 0]).all() and (image[:, 3, :3] == [0, 1, 0]).all()
    p = draw.Pass(image, clear_depth=0)
    p.draw(draw.sky((4, 2), panorama, pose=np.diag([-1.0, 1, -1, 1])), state=behind)  # half a turn
    p.run()
    assert (image[:, 0, :3] == [0, 1, 0]).all() and (image[:, 3, :3] == [1, 0, 0]).all()
    p = draw.Pass(image, clear_depth=0)
    paint(p, RED, 0.5, draw.State(depth_clip="zero_to_one", depth_compare="greater"), count=3)
    p.draw(draw.sky((4, 2), np.full((2, 4, 3), 1.5, np.float32), brightness=2), state=behind)
    p.run()
    assert (image[1, 3] == RED).all() and (image[0, 0] == [3, 3, 3, 1]).all()


def test_arrays_per_instance():
    image = np.zeros((1, 1, 4), np.float32)
    state = draw.State(blend="additive", depth_test=False)
    p = draw.Pass(image)
    p.draw(draw.colored(np.eye(4)), positions=plane(), colors=[[1, 0, 0, 1], [0, 0.5, 0, 1], [0, 0, 9, 1]], instances=2, per_instance=["colors"],
           state=state)
    p.run()
    assert image[0, 0].tolist() == [1, 0.5, 0, 2]


def test_occlusion_queries_count_samples():
    p = draw.Pass(np.zeros((4, 4, 4), np.uint8))
    paint(p, RED, 0, draw.State(query=1), count=3)  # half of the image: 6 pixels, and the 4 on the diagonal if the triangle owns them
    p.run()
    assert p.samples_passed in ([0, 6], [0, 10])
    paint(p, RED, 0, draw.State(query=0))
    paint(p, GREEN, 0.5, draw.State(query=2))
    p.run()
    assert p.samples_passed == [16, 0, 0]


IMAGE = np.zeros((2, 2, 4), np.uint8)
BALL = {"centers": [[0, 0, 5]], "radii": [1], "colors": [[1, 1, 1]]}


@pytest.mark.parametrize("make, words", [
    (lambda: draw.Pass(None), "depth: is None; expected an array of shape (H, W) if there is no color array"),
    (lambda: draw.Pass(None, np.zeros((2, 2), np.float32), color_format="rgba8"), "color_format: is 'rgba8' without a color array; expected None"),
    (lambda: draw.Pass(np.zeros((2, 2, 3), np.float32), color_format="r32f"), "color: has the shape (2, 2, 3); expected (H, W) for the format r32f"),
    (lambda: draw.Pass(np.zeros((2, 2), np.uint8)), "color: is uint8 of shape (2, 2); expected"),
    (lambda: draw.State(query=1024), "query: is 1024; expected an integer from 0 to 1023"),
    (lambda: draw.phong(np.eye(4), eye=(0, 0, 1), per_vertex=True, normal_texture=IMAGE), "normal_texture: is given with per_vertex=True"),
    (lambda: draw.spheres((2, 2), pose=np.diag([2.0, 2, 2, 1])), "pose: is not a rotation and a translation; expected"),
    (lambda: draw.Pass(IMAGE).draw(draw.spheres((2, 2)), **BALL), "topology: is triangles; expected points for spheres()"),
    (lambda: draw.Pass(IMAGE).draw(draw.spheres((2, 2)), state=POINTS, **{**BALL, "radii": [np.nan]}), "radii[0]: is nan; expected a finite number"),
    (lambda: draw.Pass(IMAGE).draw(draw.spheres((2, 2)), state=POINTS, **{**BALL, "colors": [[1, 1, 1, 1]]}),
     "colors: has the shape (1, 4); expected (N, 3)"),
    (lambda: draw.sky((2, 2), np.zeros((2, 2, 2), np.float32)), "panorama: has the shape (2, 2, 2); expected (H, W, 3) or (H, W, 4)"),
    (lambda: draw.sky((2, 2), np.full((2, 2, 3), np.nan, np.float32)), "panorama[0, 0, 0]: is nan; expected a finite number"),
    (lambda: draw.Pass(IMAGE).draw(draw.colored(np.eye(4)), positions=plane(), colors=np.ones((1, 4)), instances=2, per_instance=["colors"]),
     "colors: has 1 rows; expected one per instance, 2"),
    (lambda: draw.Pass(IMAGE).draw(draw.colored(np.eye(4)), positions=plane(), colors=np.ones((1, 4)), per_instance=["uvs"]),
     "per_instance: is 'uvs'; expected one of positions, colors"),
    (lambda: draw.Pass(IMAGE).draw(draw.depth_only(np.eye(4)), positions=plane(), instances=2, per_instance=["positions"]),
     "per_instance: names all arrays; expected at least one array with one row per vertex"),
    (lambda: draw.Pass(IMAGE).draw(draw.colored(np.eye(4)), positions=plane(), colors=np.ones((6, 4)), instances=0), "instances: is 0; expected"),
])
def test_wrong_arguments_are_reported(make, words):
    with pytest.raises(halfspace.InputError) as error:
        make()
    assert str(error.value).startswith(words) and "\n" not in str(error.value)
