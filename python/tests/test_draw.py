# SPDX-License-Identifier: Apache-2.0
"""Passes that draw arrays: compares pixels with exact results for each part of the draw state."""

import numpy as np
import pytest

import halfspace
from halfspace import draw

# Two triangles that cover clip space, at depth z.
CORNERS = np.array([[-1, -1], [1, -1], [1, 1], [-1, -1], [1, 1], [-1, 1]], np.float32)


def plane(z=0.0):
    return np.column_stack([CORNERS, np.full(6, z, np.float32)])


def paint(p, color, z=0.0, state=None, count=6):
    p.draw(draw.colored(np.eye(4), color), positions=plane(z)[:count], colors=np.ones((count, 4), np.float32), state=state)


def one(*draws, **options):
    """Runs draws (color, z, state) and returns the linear pixel of a 1x1 image."""
    image = np.zeros((1, 1, 4), np.float32)
    p = draw.Pass(image, **options)
    for color, z, state in draws:
        paint(p, color, z, state)
    assert p.run() == len(draws)
    return image[0, 0].tolist()


RED, GREEN, HALF = (1, 0, 0, 1), (0, 1, 0, 1), (0, 1, 0, 0.5)


def test_the_nearer_plane_is_visible():
    assert one((RED, 0.5, None), (GREEN, 0, None)) == [0, 1, 0, 1]
    assert one((RED, 0, None), (GREEN, 0.5, None)) == [1, 0, 0, 1]


def test_depth_state():
    assert one((RED, 0, None), (GREEN, 0.5, draw.State(depth_test=False))) == [0, 1, 0, 1]
    assert one((RED, 0, None), (GREEN, 0.5, draw.State(depth_compare="greater"))) == [0, 1, 0, 1]
    assert one((RED, 0, draw.State(depth_write=False)), (GREEN, 0.5, None)) == [0, 1, 0, 1]
    assert one((RED, 1.5, None)) == [0, 0, 0, 0] and one((RED, 1.5, draw.State(depth_clamp=True, depth_compare="always"))) == [1, 0, 0, 1]
    assert one((RED, 0, None), (GREEN, 0, draw.State(depth_range=(0, 0.5)))) == [0, 1, 0, 1]
    assert one((RED, 0, None), (GREEN, 0, draw.State(offset=(0, -100, 0)))) == [0, 1, 0, 1]
    reversed_z = draw.State(depth_clip="zero_to_one", depth_compare="greater")
    assert one((RED, 0.5, reversed_z), (GREEN, 0.75, reversed_z), clear_depth=0) == [0, 1, 0, 1]


def test_blending():
    assert one((RED, 0.5, None), (HALF, 0, draw.State(blend="alpha"))) == [0.5, 0.5, 0, 1]
    assert one((RED, 0.5, None), (HALF, 0, draw.State(blend="additive"))) == [1, 0.5, 0, 1.5]
    largest = draw.Blend("one", "one", "max", source_alpha="one", destination_alpha="one", equation_alpha="max")
    assert one((RED, 0.5, None), (GREEN, 0, draw.State(blend=largest))) == [1, 1, 0, 1]
    over = draw.State(order_independent=True, depth_write=False)
    assert one((HALF, -0.5, over), ((1, 0, 0, 1), 0.5, over)) == one(((1, 0, 0, 1), 0.5, over), (HALF, -0.5, over))


def test_masks_and_culling():
    assert one((RED, 0.5, None), (GREEN, 0, draw.State(color_mask=(True, False, False, True)))) == [0, 0, 0, 1]
    assert one((RED, 0, draw.State(cull="back"))) == [1, 0, 0, 1] and one((RED, 0, draw.State(cull="front"))) == [0, 0, 0, 0]
    assert one((RED, 0, draw.State(cull="front", front="clockwise"))) == [1, 0, 0, 1]


def test_stencil():
    write = draw.State(stencil=draw.Stencil("always", reference=3, passed="replace"), color_mask=(False,) * 4, depth_write=False)
    for reference, expected in ((3, [1, 0, 0, 1]), (4, [0, 0, 0, 0])):
        test = draw.State(stencil=draw.Stencil("equal", reference=reference))
        assert one((GREEN, 0, write), (RED, 0, test), depth_format="d24s8") == expected


def test_viewport_and_scissor_count_from_the_lower_left():
    image = np.zeros((4, 4, 4), np.float32)
    p = draw.Pass(image, clear_color=(0, 0, 1, 1))
    paint(p, RED, state=draw.State(viewport=(0, 0, 2, 2)))
    paint(p, GREEN, -0.5, state=draw.State(scissor=(3, 3, 2**31 - 1, 20000)))
    p.run(threads=2)
    names = {(1, 0, 0): "r", (0, 1, 0): "g", (0, 0, 1): "b"}
    assert ["".join(names[tuple(c[:3])] for c in row) for row in image] == ["bbbg", "bbbb", "rrbb", "rrbb"]


def red_pixels(**state):
    image = np.zeros((2, 4, 4), np.float32)
    p = draw.Pass(image)
    paint(p, RED, state=draw.State(**state))
    p.run()
    return ["".join("r" if c[0] else "." for c in row) for row in image]


def test_viewports_may_have_fractions_and_be_upside_down():
    assert red_pixels(viewport=(0.5, 0, 2, 2)) == ["rr..", "rr.."]  # the centers of pixels are at 0.5, 1.5, ...
    assert red_pixels(viewport=(0.75, 1.5, 2, 0.5)) == [".rr.", "...."]
    assert red_pixels(viewport=(0, 2, 1, -1)) == ["r...", "...."]
    # A negative height shows the back faces, the upper left origin does not.
    assert red_pixels(viewport=(0, 2, 4, -2), cull="back") == ["....", "...."]
    assert red_pixels(clip_origin="upper_left", cull="back") == ["rrrr", "rrrr"]


def test_topologies():
    image = np.zeros((3, 3, 4), np.float32)
    p = draw.Pass(image)
    p.draw(draw.colored(np.eye(4)), positions=np.zeros((1, 3), np.float32), colors=np.ones((1, 4), np.float32),
           state=draw.State(topology="points"))
    p.run()
    assert image[..., 0].tolist() == [[0, 0, 0], [0, 1, 0], [0, 0, 0]]
    p = draw.Pass(image, load=True)
    p.draw(draw.colored(np.eye(4)), positions=np.array([[-2, 0, 0], [2, 0, 0]], np.float32), colors=np.ones((2, 4), np.float32),
           state=draw.State(topology="lines", depth_test=False))
    p.run()
    assert image[..., 0].tolist() == [[0, 0, 0], [1, 1, 1], [0, 0, 0]]


@pytest.mark.parametrize("dtype, format, value", [(np.uint8, None, 188), (np.uint8, "rgba8", 128), (np.float16, None, 0.5),
                                                  (np.float32, None, 0.5)])
def test_color_formats(dtype, format, value):
    image = np.zeros((1, 1, 4), dtype)
    p = draw.Pass(image, color_format=format)
    paint(p, (0.5, 0, 0, 1))
    p.run()
    assert image[0, 0, 0] == value


@pytest.mark.parametrize("format, dtype, value", [
    ("d16", np.uint16, 0.75 * 65535), ("d24", np.uint32, 0.75 * (2**24 - 1)), ("d32f", np.float32, 0.75),
    ("d32fs8", [("depth", np.float32), ("stencil", np.uint32)], (0.75, 0))])
def test_depth_formats(format, dtype, value):
    depth = np.zeros((1, 1), dtype)
    p = draw.Pass(np.zeros((1, 1, 4), np.uint8), depth, depth_format=format)
    paint(p, RED, 0.5)
    p.run()
    assert abs(float(depth[0, 0] if depth.dtype.names is None else depth[0, 0]["depth"])
               - (value if np.isscalar(value) else value[0])) <= (0.5 if format in ("d16", "d24") else 0)


def test_samples_are_averaged():
    image = np.zeros((1, 1, 4), np.float32)
    p = draw.Pass(image, samples=4)
    paint(p, RED, count=3)  # the triangle below the diagonal
    p.run()
    assert image[0, 0].tolist() == [0.5, 0, 0, 0.5]


def test_lit_shaders():
    normals = np.tile(np.array([[0, 0, 1]], np.float32), (6, 1))
    image = np.zeros((2, 2, 4), np.float32)
    sun = draw.light(place=(0, np.sqrt(3), 1))  # 60 degrees from the normal
    for shader in (draw.phong(np.eye(4), eye=(0, 0, 5), lights=[sun], color=(0.5, 1, 1)),
                   draw.phong(np.eye(4), eye=(0, 0, 5), lights=[sun], color=(0.5, 1, 1), per_vertex=True)):
        p = draw.Pass(image)
        p.draw(shader, positions=plane(), normals=normals)
        p.run()
        assert np.allclose(image[0, 0], [0.25, 0.5, 0.5, 1], atol=1e-6)
    p = draw.Pass(image)
    p.draw(draw.metallic(np.eye(4), eye=(0, 0, 5), ambient=(1, 1, 1), base_color=(0.2, 0.4, 0.6, 1)), positions=plane(), normals=normals)
    p.run()
    dim = image[0, 0, :3].copy()
    assert (np.diff(dim) > 0).all()
    colors = np.full((6, 4), 0.5, np.float32)
    p = draw.Pass(image)
    p.draw(draw.metallic(np.eye(4), eye=(0, 0, 5), ambient=(1, 1, 1), base_color=(0.4, 0.8, 1, 1), vertex_colors=True), positions=plane(),
           normals=normals, colors=colors)
    p.run()
    assert np.allclose(image[0, 0, :2], dim[:2], atol=1e-6)


def test_the_range_of_a_light():
    def brightness(**keys):
        image = np.zeros((1, 1, 4), np.float32)
        p = draw.Pass(image)
        lamp = draw.light("point", place=(0, 0, 2), **keys)  # 2 from the pixel, along its normal
        p.draw(draw.phong(np.eye(4), eye=(0, 0, 5), lights=[lamp]), positions=plane(), normals=np.tile(np.array([[0, 0, 1]], np.float32), (6, 1)))
        p.run()
        return float(image[0, 0, 0])

    assert np.isclose(brightness(), 1, atol=1e-6)
    assert np.isclose(brightness(range=4), 1 - 0.5 ** 4, atol=1e-6)  # the window of KHR_lights_punctual
    assert brightness(range=2) == 0
    with pytest.raises(ValueError, match="range"):
        draw.light("point", range=0)


def test_textures():
    texels = np.array([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 255]]], np.uint8)
    texture = halfspace.Texture(texels, filter="nearest", wrap="clamp")
    normals = np.tile(np.array([[0, 0, 1]], np.float32), (6, 1))
    uvs = CORNERS * [0.5, -0.5] + np.float32(0.5)  # v = 0 is the top row of the texture
    image = np.zeros((2, 2, 4), np.uint8)
    p = draw.Pass(image)
    p.draw(draw.phong(np.eye(4), eye=(0, 0, 5), ambient=(1, 1, 1), texture=texture), positions=plane(), normals=normals, uvs=uvs)
    p.run()
    assert np.array_equal(image[..., :3], texels)


def test_indices_and_transforms():
    image = np.zeros((2, 2, 4), np.float32)
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
    half = np.diag([0.5, 1, 1, 1.0])
    half[0, 3] = 0.5
    p = draw.Pass(image)
    p.draw(draw.colored(half), positions=corners, colors=np.ones((4, 4), np.float32), indices=[[0, 1, 2], [0, 2, 3]])
    p.run()
    assert image[..., 0].tolist() == [[0, 1], [0, 1]]


def test_arrays_are_kept_until_the_pass_runs():
    image = np.zeros((1, 1, 4), np.float32)
    p = draw.Pass(image)
    paint(p, RED)  # its arrays are temporaries
    [np.full((6, 4), np.nan, np.float32) for _ in range(100)]
    p.run()
    assert image[0, 0].tolist() == [1, 0, 0, 1]


def test_indices_are_copied():
    image, indices = np.zeros((1, 1, 4), np.float32), np.arange(6, dtype=np.uint32)
    p = draw.Pass(image)
    p.draw(draw.colored(np.eye(4), RED), positions=plane(), colors=np.ones((6, 4), np.float32), indices=indices)
    indices[:] = 0  # a triangle without area; larger values would cause reads outside the arrays
    p.run()
    assert image[0, 0].tolist() == [1, 0, 0, 1]


IMAGE = np.zeros((2, 2, 4), np.uint8)


@pytest.mark.parametrize("make, words", [
    (lambda: draw.Pass(np.zeros((2, 2, 3), np.uint8)), "color: is uint8 of shape (2, 2, 3); expected uint8, float16 or float32"),
    (lambda: draw.Pass(IMAGE[:, ::-1]), "color: is not C-contiguous and writeable; expected"),
    (lambda: draw.Pass(IMAGE, color_format="rgba32f"), "color: has the dtype uint8; expected float32 for the format rgba32f"),
    (lambda: draw.Pass(IMAGE, np.zeros((2, 3), np.float32)), "depth: is float32 of shape (2, 3); expected float32 of shape (2, 2)"),
    (lambda: draw.Pass(IMAGE, samples=3), "samples: is 3; expected 1, 2, 4 or 8"),
    (lambda: draw.State(cull="both"), "cull: is 'both'; expected one of none, front, back, front_and_back"),
    (lambda: draw.State(depth_range=(0, 2)), "depth_range: is 2; expected a number from 0 to 1"),
    (lambda: draw.State(blend="mix"), "blend: is 'mix'; expected one of alpha, additive"),
    (lambda: draw.State(viewport=(0, 0, -1, 1)), "viewport: is (0, 0, -1, 1); expected"),
    (lambda: draw.Pass(IMAGE).draw(draw.colored(np.eye(4)), positions=plane()), "arrays: are positions; expected positions, colors"),
    (lambda: draw.Pass(IMAGE).draw(draw.colored(np.eye(4)), positions=plane(), colors=np.ones((5, 4))), "arrays: have 6, 5 rows; expected"),
    (lambda: draw.Pass(IMAGE).draw(draw.colored(np.eye(4)), positions=plane(), colors=np.ones((6, 4)), indices=[6, 0, 0]),
     "indices: has the index 6; expected indices from 0 to 5"),
    (lambda: draw.phong(np.eye(4), eye=(0, 0, 1), lights=["sun"]), "lights[0]: is of type str; expected a light of draw.light()"),
    (lambda: draw.metallic(np.eye(4), eye=(0, 0, 1), lights=draw.light()), "lights: is of type Light; expected a list of lights"),
    (lambda: draw.colored(np.eye(3)), "clip_from_object: has the shape (3, 3); expected (4, 4)"),
    (lambda: draw.phong(np.eye(4), np.tile(np.eye(4), (3, 1, 1)), eye=(0, 0, 1)), "world_from_object: has the shape (3, 4, 4); expected (4, 4)"),
    (lambda: draw.Pass(IMAGE, np.zeros((2, 2)), depth_format="none"), "depth: is given with the format none; expected None"),
    (lambda: draw.Pass(IMAGE, samples=np.ones(2)), "samples: is array([1., 1.]); expected 1, 2, 4 or 8"),
    (lambda: draw.Pass(IMAGE).draw(None), "shader: is of type NoneType; expected the result of"),
    (lambda: paint(draw.Pass(IMAGE), RED, state={}), "state: is of type dict; expected a State or None"),
    (lambda: paint(draw.Pass(IMAGE), RED, state=draw.State(base_vertex=1)),
     "base_vertex: is 1, so that vertices 1 to 6 are drawn; expected vertices from 0 to 5"),
    (lambda: draw.State(base_vertex=2**40), "base_vertex: is 1099511627776; expected an integer from -2147483648 to 2147483647"),
    (lambda: draw.State(base_vertex=float("nan")), "base_vertex: is nan; expected an integer from"),
    (lambda: draw.State(viewport=(0, 0, 3)), "viewport: is (0, 0, 3); expected (x, y, width, height)"),
    (lambda: draw.State(viewport=(0, 0, 0, 0)), "viewport: is (0, 0, 0, 0); expected a width and a height from 1/256 to 16384, where"),
    (lambda: draw.State(viewport=(0, 0, 20000, 1)), "viewport: is (0, 0, 20000, 1); expected a width and a height from 1/256 to 16384, where"),
    (lambda: draw.State(scissor=(0, 0, -1, 1)), "scissor: is (0, 0, -1, 1); expected a width and a height from 0 to 2147483647"),
    (lambda: draw.State(depth_range=0.5), "depth_range: is 0.5; expected a pair of depths"),
    (lambda: draw.State(color_mask=True), "color_mask: is True; expected 4 booleans"),
    (lambda: draw.State(stencil=(draw.Stencil(), 3)), "stencil: is of type int; expected a Stencil or a pair of them"),
    (lambda: draw.State(blend=3), "blend: is of type int; expected a Blend, alpha, additive or None"),
    (lambda: draw.State(order_independent=True), "depth_write: is True with order_independent=True; expected False"),
    (lambda: draw.State(order_independent=True, depth_write=False, blend="alpha"), "blend: is set with order_independent=True; expected None"),
    (lambda: draw.State(order_independent=True, depth_write=False, color_mask=(True, False, True, True)),
     "color_mask: disables channels with order_independent=True; expected 4 times True"),
    (lambda: draw.State(order_independent=True, depth_write=False, depth_compare="always"),
     "depth_compare: is 'always' with order_independent=True; expected less, less_equal, greater or greater_equal"),
    (lambda: paint(draw.Pass(None, np.zeros((2, 2), np.float32)), RED, state=draw.State(order_independent=True, depth_write=False)),
     "state: has order_independent=True, but the pass has no color array; expected a pass with one"),
    (lambda: draw.Pass(IMAGE).draw(draw.colored(np.eye(4)), positions=np.zeros((3, 3)), colors=np.zeros((3, 4)), instances=2**31 - 1),
     "instances: is 2147483647 with 3 vertices each; expected less than 2^32 vertices in all"),
    (lambda: draw.Stencil(reference=0.5), "reference: is 0.5; expected an integer from 0 to 255"),
])
def test_wrong_draws_are_reported(make, words):
    with pytest.raises(halfspace.InputError) as error:
        make()
    assert str(error.value).startswith(words) and "\n" not in str(error.value)


def test_arrays_must_not_be_resized_before_the_pass_runs():
    image = np.zeros((2, 2, 4), np.uint8)
    p = draw.Pass(image)
    paint(p, RED)
    image.resize((1, 1, 4), refcheck=False)
    with pytest.raises(halfspace.InputError, match="color: was resized; expected"):
        p.run()


def test_the_custom_shader_of_the_examples():
    stripes = pytest.importorskip("stripes", reason="the example was not built")
    image = np.zeros((2, 8, 4), np.uint8)
    stripes.draw(np.array([[-1, -1, 0], [3, -1, 0], [-1, 3, 0]], np.float32), image, count=2)
    assert image[0, :, 0].tolist() == [255, 0] * 4  # a pixel is 0.25 wide, and a stripe as well
    assert np.array_equal(image[0], image[1])
    for positions, shape in ((np.zeros((3, 3), np.float32), (0, 8, 4)), (np.zeros((0, 3), np.float32), (2, 8, 4)),
                             (np.zeros((4, 3), np.float32), (2, 8, 4))):
        with pytest.raises(ValueError, match=r"expected positions of shape \(3 N, 3\)"):
            stripes.draw(positions, np.zeros(shape, np.uint8))
    with pytest.raises(RuntimeError, match="width"):
        stripes.draw(np.zeros((3, 3), np.float32), np.zeros((1, 20000, 4), np.uint8))  # a check of the library that fails
