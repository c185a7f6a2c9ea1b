# SPDX-License-Identifier: Apache-2.0
"""Scenes made from arrays: meshes, materials, textures, lights, copies, and errors."""

import json
from types import SimpleNamespace

import numpy as np
import pytest

import halfspace
from conftest import QUAD, sphere

CAMERA = halfspace.Camera.look_at((0, 0, 4), height=2.0, near=1, far=10)


def flat(color=(1, 1, 1), **more):
    """A material whose color is rendered unchanged."""
    return halfspace.Material(color, unlit=True, **more)


def dark(*meshes, **more):
    scene = halfspace.Scene(lighting="none", **more)
    for mesh in meshes:
        scene.add(mesh)
    return scene


def fitted(vertices, scale=1.0, ball=None):
    """Fits a camera to a scaled quad, and a ball if its position is given."""
    scene = halfspace.Scene()
    scene.add(halfspace.Mesh(vertices, QUAD[1]), np.diag([scale] * 3 + [1.0]), name="shape")
    if ball is not None:
        scene.merge({"objects": {"ball": {"shape": "sphere", "radius": 10, "position": ball}}})
    return scene.fit()


def shown(mesh, size=(20, 20)):
    scene = dark(mesh)
    scene["ambient"] = 1
    return scene.render(size, camera=CAMERA, linear=True)


def read_ply(path):
    """Reads positions, normals and triangles of a binary PLY file of floats."""
    data = path.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    header = data[:end].decode().split("\n")
    counts = {line.split()[1]: int(line.split()[2]) for line in header if line.startswith("element")}
    order = "<" if "little" in header[1] else ">"
    columns = [line for line in header if line.startswith("property float")]
    vertices = np.frombuffer(data, order + "f4", counts["vertex"] * len(columns), end).reshape(-1, len(columns))
    face = np.dtype([("n", "u1"), ("i", order + "i4", 3)])
    return vertices[:, :3], vertices[:, 3:6], np.frombuffer(data, face, counts["face"], end + vertices.nbytes)["i"]


def test_sheen_reflects_ambient_light():
    """White sheen on a black surface is gray, and the brighter the more of it there is."""
    def seen(sheen):
        material = halfspace.Material((0, 0, 0), specular=0, sheen=sheen, sheen_roughness=1)
        return shown(halfspace.Mesh(*QUAD, material=material))[10, 10]
    none, half, full = seen(0), seen(0.5), seen(1)
    assert none[0] == 0 and full[0] == full[1] == full[2]
    assert full[0] > 0.1 and half[0] == pytest.approx(full[0] / 2, rel=1e-5)


def test_a_quad_fills_the_picture():
    color = np.array([0.25, 0.5, 0.75, 1], np.float32)
    assert (shown(halfspace.Mesh(*QUAD, material=flat(color[:3]))) == color).all()


def test_faces_none_means_all_vertices_in_order():
    vertices = QUAD[0][QUAD[1].ravel()]
    assert np.array_equal(shown(halfspace.Mesh(vertices)), shown(halfspace.Mesh(*QUAD)))


@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.int32])
@pytest.mark.parametrize("index", [np.uint8, np.int32, np.int64, np.uint32])
def test_types_and_layouts_do_not_matter(dtype, index):
    expected = shown(halfspace.Mesh(*QUAD))
    vertices, faces = np.asfortranarray(QUAD[0].astype(dtype)), QUAD[1].astype(index)
    assert np.array_equal(shown(halfspace.Mesh(vertices, faces)), expected)
    twice = np.repeat(vertices, 2, axis=0)[::2]
    assert np.array_equal(shown(halfspace.Mesh(twice, faces.tolist())), expected)


def test_colors_are_linear_floats_or_srgb_codes():
    codes = np.tile(np.array([[255, 128, 0]], np.uint8), (4, 1))
    linear = shown(halfspace.Mesh(*QUAD, colors=codes, material=flat()))[10, 10]
    assert linear[0] == 1 and linear[2] == 0 and abs(linear[1] - 0.215861) < 1e-5
    floats = shown(halfspace.Mesh(*QUAD, colors=np.full((4, 3), 0.5), material=flat()))
    assert (floats[..., :3] == 0.5).all()


def test_srgb_codes_survive_a_round_trip():
    codes = np.repeat(np.arange(256, dtype=np.uint8)[:, None], 3, axis=1)
    for code in (0, 1, 10, 11, 127, 128, 254, 255):
        mesh = halfspace.Mesh(*QUAD, colors=np.repeat(codes[code:code + 1], 4, axis=0), material=flat())
        assert (dark(mesh).render((4, 4), camera=CAMERA) == code).all()


def test_uvs_put_the_top_row_of_a_texture_at_v_1():
    texels = np.zeros((2, 2, 3), np.uint8)
    texels[0, 0], texels[0, 1], texels[1, 0], texels[1, 1] = (255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255)
    uvs = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)
    material = flat(base_color_texture=halfspace.Texture(texels, filter="nearest", wrap="clamp"))
    picture = dark(halfspace.Mesh(*QUAD, uvs=uvs, material=material)).render((2, 2), camera=CAMERA)
    assert np.array_equal(picture, texels)
    flipped = dark(halfspace.Mesh(*QUAD, uvs=uvs, material=material, uv_origin="upper_left")).render((2, 2), camera=CAMERA)
    assert np.array_equal(flipped, texels[::-1])


def test_textures_without_uvs_are_reported():
    material = flat(base_color_texture=np.full((4, 4), 200, np.uint8), emissive_texture=np.zeros((4, 4), np.uint8))
    words = "^uvs: are missing, but the material has base_color_texture, emissive_texture; expected uvs"
    with pytest.warns(halfspace.RenderWarning, match=words) as caught:
        halfspace.Mesh(*QUAD, material=material)
    assert len(caught) == 1 and caught[0].filename == __file__


@pytest.mark.parametrize("scale", [2.0**-66, 2.0**-33, 2.0**59])
def test_the_units_of_a_mesh_do_not_matter(scale):
    def render(size):
        scene = halfspace.Scene()
        scene.add(halfspace.Mesh(size * vertices, faces), np.diag([1 / size] * 3 + [1.0]))
        return scene.render((64, 64), camera=CAMERA)

    vertices, faces, _, _ = sphere(8, 16)
    assert np.array_equal(render(scale), render(1.0)) and render(1.0).std() > 10


@pytest.mark.parametrize("scale", [1e-9, 1e-6, 1e6, 3e8])
def test_a_fitted_view_shows_small_and_large_meshes(scale):
    def render(size):
        return dark(halfspace.Mesh(size * QUAD[0], QUAD[1], material=flat())).render((16, 16)) > 0

    assert np.array_equal(render(scale), render(1.0)) and render(scale).any()


def test_textures_may_be_gray_or_have_alpha():
    uvs = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)
    gray = flat(base_color_texture=np.full((4, 4), 200, np.uint8))
    assert (dark(halfspace.Mesh(*QUAD, uvs=uvs, material=gray)).render((4, 4), camera=CAMERA) == 200).all()
    holes = np.full((4, 4, 4), 200, np.uint8)
    holes[:, :2, 3] = 0
    masked = flat(alpha_mode="mask", base_color_texture=halfspace.Texture(holes, filter="nearest"))
    picture = dark(halfspace.Mesh(*QUAD, uvs=uvs, material=masked)).render((4, 4), camera=CAMERA)
    assert (picture[:, :2] == 0).all() and (picture[:, 2:] == 200).all()


UVS = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)


def light_of_texel(texel, dtype):
    """Renders a quad whose texture has one color, without light. Returns the linear color."""
    texels = np.full((2, 2, len(texel)), texel, dtype)
    return shown(halfspace.Mesh(*QUAD, uvs=UVS, material=flat(base_color_texture=texels)))[10, 10, :3]


def test_integer_textures_keep_16_bits():
    codes = np.array([32800, 32960, 257])  # the first two have the same 8 bits
    x = codes / 65535
    expected = np.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4)
    assert np.allclose(light_of_texel(codes, np.uint16), expected, rtol=1e-6, atol=0)
    assert np.array_equal(light_of_texel((257 * 200, 257, 0), np.uint16), light_of_texel((200, 1, 0), np.uint8))


@pytest.mark.parametrize("dtype", [np.float16, np.float32])
def test_float_textures_are_linear_and_may_exceed_1(dtype):
    texel = np.array([0.1, 7.3, 0.0], dtype)
    assert np.allclose(light_of_texel(texel, dtype), texel.astype(np.float32), rtol=1e-6)
    gray = halfspace.Texture(np.full((2, 3), 0.25, dtype)).texels
    assert gray.dtype == np.float32 and gray.shape == (2, 3, 4) and (gray == (0.25, 0.25, 0.25, 1)).all()


def test_alpha_of_integer_textures_is_opaque():
    assert (halfspace.Texture(np.zeros((1, 2, 3), np.uint16)).texels[..., 3] == 65535).all()


def test_normal_textures_can_be_vectors():
    def lit(texels):
        scene = dark(halfspace.Mesh(*QUAD, uvs=UVS, material=halfspace.Material(specular=0, normal_texture=texels)))
        scene.add_light(direction=(0, 0, 1), shadow=False)
        return scene.render((8, 8), camera=CAMERA, linear=True)[4, 4, :3]

    normal = np.array([-0.6, 0, 0.8], np.float32)
    vectors, mapped = np.tile(normal, (2, 2, 1)), np.tile(normal / 2 + 0.5, (2, 2, 1)).astype(np.float32)
    codes = np.rint(mapped * 65535).astype(np.uint16)
    assert np.allclose(lit(vectors), lit(mapped), rtol=1e-5) and np.allclose(lit(vectors), lit(codes), rtol=1e-4)
    assert np.allclose(lit(vectors), 0.8 * lit(np.float32([[[0.5, 0.5, 1]]])), rtol=1e-3)


def test_normals_are_computed_or_given():
    vertices, faces, normals, _ = sphere()
    light = {"direction": (0.3, 0.5, 1), "shadow": False}

    def lit(mesh):
        scene = dark(mesh)
        scene.add_light(**light)
        return scene.render((64, 64), camera=halfspace.Camera.look_at((0, 0, 4)), linear=True)[..., 0]

    given = lit(halfspace.Mesh(vertices, faces, normals=3 * normals))
    smooth = lit(halfspace.Mesh(vertices, faces, crease=180))
    facets = lit(halfspace.Mesh(vertices, faces, crease=0))
    assert np.abs(given - smooth).max() < 0.03 < 0.1 < np.abs(given - facets).max()


def test_copies_are_placed_by_transforms():
    places = np.tile(np.eye(4), (3, 1, 1))
    places[:, 0, :3] *= 0.1
    places[:, 1, :3] *= 0.1
    places[:, 0, 3] = (-0.5, 0, 0.5)
    scene = halfspace.Scene(lighting="none")
    name = scene.add(halfspace.Mesh(*QUAD, material=flat()), places)
    row = scene.render((40, 40), camera=CAMERA)[20, :, 0] > 0
    assert np.nonzero(row)[0].tolist() == [8, 9, 10, 11, 18, 19, 20, 21, 28, 29, 30, 31]
    scene.place(name, places[1])
    assert (scene.render((40, 40), camera=CAMERA)[20, :, 0] > 0).sum() == 4
    scene.place(name, places[:0])
    assert not scene.render((40, 40), camera=CAMERA).any()
    assert scene.bounds is None


def test_mirrored_and_sheared_transforms_keep_the_front():
    one_sided = halfspace.Mesh(*QUAD, material=flat(double_sided=False))
    mirror, shear = np.diag([-1.0, 1, 1, 1]), np.eye(4)
    shear[0, 1] = 0.25
    scene = halfspace.Scene(lighting="none")
    name = scene.add(one_sided, mirror)
    assert (scene.render((8, 8), camera=CAMERA) == 255).all()
    scene.place(name, shear)
    assert (scene.render((8, 8), camera=CAMERA)[4] > 200).all()
    scene.place(name, np.diag([-1.0, 1, -1, 1]))  # a half turn
    assert not scene.render((8, 8), camera=CAMERA).any()


def test_objects_are_hidden_and_removed():
    scene = halfspace.Scene(lighting="none")
    red = scene.add(halfspace.Mesh(*QUAD, material=flat((1, 0, 0))), name="red")
    blue = scene.add(halfspace.Mesh(*QUAD, material=flat((0, 0, 1))), np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 1], [0, 0, 0, 1.0]]))
    assert (red, blue) == ("red", "object_1")
    assert scene.render((4, 4), camera=CAMERA)[2, 2].tolist() == [0, 0, 255]
    scene[f"{blue}.visible"] = False
    assert scene.render((4, 4), camera=CAMERA)[2, 2].tolist() == [255, 0, 0]
    scene[f"{blue}.visible"] = True
    scene.remove(red)
    assert scene.render((4, 4), camera=CAMERA)[2, 2].tolist() == [0, 0, 255]
    scene.remove(blue)
    assert scene.bounds is None and not scene.render((4, 4), camera=CAMERA).any()


def test_a_scene_without_a_camera_shows_everything():
    scene = halfspace.Scene(lighting="none")
    scene.add(halfspace.Mesh(*sphere()[:2], material=flat()), np.diag([5.0, 5, 5, 1]))
    covered = scene.render((60, 60))[..., 0] > 0
    assert covered.sum() > 800 and not covered[0].any() and not covered[:, -1].any()
    narrow = scene.render((30, 90))[..., 0] > 0
    assert narrow.sum() > 200 and not narrow[:, 0].any() and not narrow[:, -1].any()
    scene.merge({"cameras": {"own": {"position": [0, 0, 900], "far": 2000}}})
    assert (scene.render((60, 60))[..., 0] > 0).sum() < 20


def test_keys_may_be_numpy_numbers_and_arrays():
    scene = halfspace.Scene(lighting="none")
    scene.add_light("point", name="lamp", position=[np.float32(1), np.int64(2), np.float64(0.5)], intensity=np.float32(2), shadow=np.bool_(False))
    assert scene["lights.lamp.position"] == [1, 2, 0.5] and scene["lights.lamp.shadow"] is False
    scene.merge({"ambient": np.array([1, 0.5, 0.25]), "lights": {"lamp": {"position": (np.float32(3), 0, 0)}}})
    assert scene["ambient"] == [1, 0.5, 0.25] and scene["lights.lamp.position"] == [3, 0, 0]


def test_the_default_view_follows_keys_and_merged_objects():
    scene = halfspace.Scene(lighting="none")
    name = scene.add(halfspace.Mesh(*QUAD, material=flat()))
    assert scene.bounds.tolist() == [[-1, -1, 0], [1, 1, 0]]
    before = scene.render((40, 40))
    scene[f"{name}.position"] = (100, 0, 0)
    assert scene.bounds.tolist() == [[99, -1, 0], [101, 1, 0]]
    # The rotation from the object to the camera is the same. float32 has 2**-17 = 7.6e-6 units at 100, less than 1/1000 of a pixel.
    assert np.abs(scene.render((40, 40)).astype(int) - before).max() <= 1 and before.any()
    scene.place(name, np.diag([2.0, 1, 1, 1]))
    assert scene.bounds.tolist() == [[98, -1, 0], [102, 1, 0]]
    scene.merge({"ambient": 1, "objects": {"ball": {"shape": "sphere", "radius": 3}, "box": {"shape": "plane", "position": [0, 0, -7]}}})
    assert scene.bounds.tolist() == [[-3, -3, -8], [102, 3, 3]]
    scene[f"{name}.visible"] = False
    assert scene.bounds.tolist() == [[-3, -3, -8], [3, 3, 3]]
    scene.merge({"objects": {"ball": None, "box": None}})
    assert scene.bounds is None
    points = halfspace.Scene(lighting="none")
    points.add(halfspace.Mesh([[0, 0, 0], [1, 2, 3]], topology="points"))
    assert points.bounds.tolist() == [[0, 0, 0], [1, 2, 3]]


def test_a_mesh_read_from_a_file_matches_the_file(horse):
    vertices, normals, faces = read_ply(horse)
    by_file = halfspace.Scene.load(horse, floor=False)
    by_arrays = halfspace.Scene()
    name = by_arrays.add(halfspace.Mesh(vertices, faces, normals=normals))
    by_arrays.merge({"lights": json.loads(by_file.text())["lights"]})
    camera = halfspace.Camera.look_at(by_file["cameras.view.position"], by_file["cameras.view.target"], by_file["cameras.view.up"],
                                      fov=by_file["cameras.view.fov"], near=by_file["cameras.view.near"], far=by_file["cameras.view.far"])
    assert by_arrays[f"{name}.scale"] == by_file["model.scale"]
    assert np.array_equal(by_arrays.render((320, 180), camera=camera), by_file.render((320, 180)))


def test_trimesh_like_objects_are_meshes():
    vertices, faces, _, uvs = sphere(8, 16)
    plain = SimpleNamespace(vertices=vertices, faces=faces)
    scene = halfspace.Scene()
    scene.add(plain)
    assert scene.render((32, 32)).std() > 0
    codes = np.tile(np.array([255, 0, 0, 255], np.uint8), (len(vertices), 1))
    by_vertex = SimpleNamespace(vertices=vertices, faces=faces, visual=SimpleNamespace(kind="vertex", vertex_colors=codes))
    by_face = SimpleNamespace(vertices=vertices, faces=faces, visual=SimpleNamespace(kind="face", face_colors=codes[:len(faces)]))
    texture = SimpleNamespace(kind="texture", uv=uvs, material=SimpleNamespace(
        baseColorFactor=np.array([255, 255, 255, 255], np.uint8), baseColorTexture=np.full((2, 2, 3), (255, 0, 0), np.uint8),
        metallicFactor=0.0, roughnessFactor=None))
    by_texture = SimpleNamespace(vertices=vertices, faces=faces, visual=texture)
    codes_by_face = np.tile(codes[:1], (len(faces), 1))
    by_face.visual.face_colors = codes_by_face
    for mesh in (by_vertex, by_face, by_texture):
        picture = dark(halfspace.Mesh.from_trimesh(mesh))
        picture.set({"ambient": 1})
        pixels = picture.render((32, 32))[16, 16]
        assert pixels[0] > 100 and pixels[1] < 60, mesh.visual.kind


def test_materials_of_trimesh_have_their_colors():
    vertices, faces, _, uvs = sphere(8, 16)
    texels = np.full((2, 2, 3), (200, 150, 100), np.uint8)

    def shown_with(material):
        mesh = SimpleNamespace(vertices=vertices, faces=faces, visual=SimpleNamespace(kind="texture", uv=uvs, material=material))
        scene = dark(halfspace.Mesh.from_trimesh(mesh))
        scene["ambient"] = 1
        return scene.render((32, 32), linear=True)

    def expected(*color, **keys):
        scene = dark(halfspace.Mesh(vertices, faces, uvs=uvs, material=halfspace.Material(color, **keys)))
        scene["ambient"] = 1
        return scene.render((32, 32), linear=True)

    codes = np.array([128, 64, 32, 255], np.uint8)
    for texture in (None, texels):
        metallic = SimpleNamespace(baseColorFactor=codes, baseColorTexture=texture, metallicFactor=None, roughnessFactor=None)
        assert np.array_equal(shown_with(metallic), expected(*(codes[:3] / 255), base_color_texture=texture))
        simple = SimpleNamespace(image=texture, diffuse=codes)
        assert np.array_equal(shown_with(simple), expected(*halfspace.srgb(codes)[:3], base_color_texture=texture))
    unset = np.array([102, 102, 102, 255], np.uint8)  # what trimesh sets if there is no diffuse color
    assert np.array_equal(shown_with(SimpleNamespace(image=texels, diffuse=unset)), expected(1, 1, 1, base_color_texture=texels))
    assert np.array_equal(shown_with(SimpleNamespace(image=None, diffuse=unset)), expected(*halfspace.srgb(unset)[:3]))


NAN = np.where(np.arange(12).reshape(4, 3) == 7, np.nan, 0.5)


def trimesh_quad(**material):
    """An object like a trimesh.Trimesh with a PBRMaterial."""
    names = ("baseColorFactor", "baseColorTexture", "metallicFactor", "roughnessFactor", "metallicRoughnessTexture", "normalTexture",
             "occlusionTexture", "emissiveFactor", "emissiveTexture", "alphaMode", "alphaCutoff", "doubleSided")
    unknown = set(material) - set(names)
    assert not unknown
    uvs = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)
    visual = SimpleNamespace(kind="texture", uv=uvs, material=SimpleNamespace(**{name: material.get(name) for name in names}))
    return SimpleNamespace(vertices=QUAD[0], faces=QUAD[1], visual=visual)


def texels_of(*color):
    return np.full((4, 4, len(color)), color, np.uint8)


@pytest.mark.parametrize("of_trimesh, own", [
    ({"emissiveFactor": [0.5, 0.25, 1.0]}, {"emissive": (0.5, 0.25, 1)}),
    ({"emissiveFactor": [1, 1, 1], "emissiveTexture": texels_of(200, 100, 50)}, {"emissive": (1, 1, 1), "emissive_texture": texels_of(200, 100, 50)}),
    ({"metallicRoughnessTexture": texels_of(0, 60, 255)},
     {"metallic": 1, "roughness": 1, "metallic_roughness_texture": texels_of(0, 60, 255)}),
    ({"metallicRoughnessTexture": texels_of(0, 60, 255), "metallicFactor": 0.5, "roughnessFactor": 0.8},
     {"metallic": 0.5, "roughness": 0.8, "metallic_roughness_texture": texels_of(0, 60, 255)}),
    ({"normalTexture": texels_of(200, 128, 220)}, {"normal_texture": texels_of(200, 128, 220)}),
    ({"occlusionTexture": texels_of(40, 40, 40)}, {"occlusion_texture": texels_of(40, 40, 40)}),
    ({"baseColorTexture": texels_of(255, 0, 0, 100), "alphaMode": "MASK"},
     {"base_color": (1, 1, 1), "base_color_texture": texels_of(255, 0, 0, 100), "alpha_mode": "mask"}),
    ({"baseColorTexture": texels_of(255, 0, 0, 100), "alphaMode": "MASK", "alphaCutoff": 0.25},
     {"base_color": (1, 1, 1), "base_color_texture": texels_of(255, 0, 0, 100), "alpha_mode": "mask", "alpha_cutoff": 0.25}),
    ({"baseColorTexture": texels_of(255, 0, 0, 100), "alphaMode": "BLEND"},
     {"base_color": (1, 1, 1), "base_color_texture": texels_of(255, 0, 0, 100), "alpha_mode": "blend"}),
    ({"doubleSided": False}, {"double_sided": False}),
])
def test_materials_of_trimesh_like_objects(of_trimesh, own):
    def pictures(mesh):
        scene = halfspace.Scene()
        scene.add(mesh)
        return [scene.render((16, 16), camera=halfspace.Camera.look_at(eye, height=3)) for eye in ((0.5, 0.5, 4), (0.5, 0.5, -4))]

    uvs = trimesh_quad().visual.uv
    expected = pictures(halfspace.Mesh(*QUAD, uvs=uvs, material=halfspace.Material(**own)))
    shown = pictures(trimesh_quad(**of_trimesh))
    plain = pictures(trimesh_quad())
    assert all(np.array_equal(a, b) for a, b in zip(shown, expected))
    assert not all(np.array_equal(a, b) for a, b in zip(shown, plain))


@pytest.mark.parametrize("make, words", [
    (lambda: halfspace.Mesh(np.zeros((4, 2))), "vertices: has the shape (4, 2); expected (N, 3)"),
    (lambda: halfspace.Mesh([[0, 0, 0], [1]]), "vertices: is not an array; expected numbers of shape (N, 3)"),
    (lambda: halfspace.Mesh(np.zeros((0, 3))), "vertices: has 0 rows; expected 1 to 2147483647"),
    (lambda: halfspace.Mesh(np.zeros((4, 3))), "vertices: has 4 rows; expected a multiple of 3 if there are no faces"),
    (lambda: halfspace.Mesh(NAN, [[0, 1, 2]]), "vertices[2, 1]: is nan; expected a finite number"),
    (lambda: halfspace.Mesh(np.full((3, 3), "a")), "vertices: has the dtype <U1; expected a floating-point or integer dtype"),
    (lambda: halfspace.Mesh(QUAD[0], [[0, 1, 4]]), "faces: has the index 4; expected indices from 0 to 3"),
    (lambda: halfspace.Mesh(QUAD[0], [[0, -1, 2]]), "faces: has the index -1; expected indices from 0 to 3"),
    (lambda: halfspace.Mesh(QUAD[0], [[0.0, 1, 2]]), "faces: has the dtype float64; expected an integer dtype"),
    (lambda: halfspace.Mesh(QUAD[0], [[0, 1]]), "faces: has the shape (1, 2); expected (N, 3)"),
    (lambda: halfspace.Mesh(QUAD[0], np.zeros((0, 3), int)), "faces: is empty; expected at least one row"),
    (lambda: halfspace.Mesh(*QUAD, normals=np.zeros((4, 3))), "normals[0]: is zero; expected a direction"),
    (lambda: halfspace.Mesh(*QUAD, normals=np.ones((3, 3))), "normals: has 3 rows; expected one per vertex, 4"),
    (lambda: halfspace.Mesh(*QUAD, uvs=np.full((4, 2), np.inf)), "uvs[0, 0]: is inf; expected a finite number"),
    (lambda: halfspace.Mesh(*QUAD, uvs=np.full((4, 2), 1e300)), "uvs[0, 0]: is inf; expected a finite number"),
    (lambda: halfspace.Mesh(*QUAD, colors=np.full((4, 3), 255.0)), "colors: has values from 255 to 255; expected uint8, or numbers from"),
    (lambda: halfspace.Mesh(*QUAD, colors=np.zeros((4, 2))), "colors: has the shape (4, 2); expected (N, 3) or (N, 4)"),
    (lambda: halfspace.Mesh(*QUAD, topology="quads"), "topology: is 'quads'; expected one of triangles, lines, points"),
    (lambda: halfspace.Mesh(*QUAD, material="red"), "material: is of type str; expected a halfspace.Material"),
    (lambda: halfspace.Mesh(QUAD[0] * 1e300, QUAD[1]), "vertices: has coordinates of at most 1e+300 in magnitude; expected all 0, or"),
    (lambda: halfspace.Mesh(QUAD[0] * 1e-40, QUAD[1]), "vertices: has coordinates of at most 1e-40 in magnitude; expected all 0, or"),
    (lambda: fitted(QUAD[0] * 1e17), "mesh 'shape': spans 2.83e+17 units in world space; expected 1e-09 to 1e+09; scale"),
    (lambda: fitted(QUAD[0] * 1e-20), "mesh 'shape': spans 2.83e-20 units in world space; expected 1e-09 to 1e+09; scale"),
    (lambda: fitted(QUAD[0], 1e10), "mesh 'shape': spans 2.83e+10 units in world space; expected"),
    (lambda: fitted(QUAD[0], ball=(1e9, 0, 0)), "scene: spans 1e+09 units in world space; expected"),
    (lambda: halfspace.Material("red"), "base_color: is 'red'; expected 3 or 4 numbers from 0 to 1"),
    (lambda: halfspace.Material((1, 2, 3)), "base_color: is [1.0, 2.0, 3.0]; expected 3 or 4 numbers from 0 to 1"),
    (lambda: halfspace.Material(roughness=-1), "roughness: is -1; expected a number from 0 to 1"),
    (lambda: halfspace.Material(sheen=1.5), "sheen: is 1.5; expected a number from 0 to 1"),
    (lambda: halfspace.Material(base_color_texture=np.zeros((2, 2))), "base_color_texture: texels: has the dtype float64; expected uint8, uint16, float16 or float32"),
    (lambda: halfspace.Texture(np.full((1, 2, 3), np.nan, np.float32)), "texels[0, 0, 0]: is nan; expected a finite number"),
    (lambda: halfspace.Texture(np.zeros((2, 2, 2), np.uint8)), "texels: has the shape (2, 2, 2); expected (H, W), (H, W, 3) or (H, W, 4)"),
    (lambda: halfspace.Texture(np.zeros((2, 2), np.uint8), wrap="tile"), "wrap: is 'tile'; expected one of repeat, mirrored, clamp"),
    (lambda: halfspace.Scene().add(3), "mesh: an object of type int has no vertices; expected a halfspace.Mesh or an object like trimesh.Trimesh"),
    (lambda: halfspace.Scene().add(halfspace.Mesh(*QUAD), np.eye(3)), "transform: has the shape (1, 3, 3); expected (N, 4, 4)"),
    (lambda: halfspace.Scene().add(halfspace.Mesh(*QUAD), np.ones((4, 4))), "transform[0]: has the last row [1.0, 1.0, 1.0, 1.0]; expected"),
    (lambda: halfspace.Scene().place("a", np.eye(4)), "name: no object 'a' has been added; expected add() first"),
    (lambda: halfspace.Scene().add_light("sun"), "scene: lights.light_1.type: "),
    (lambda: halfspace.Scene(lighting="sun"), "lighting: is 'sun'; expected one of studio, none"),
    (lambda: halfspace.Texture(np.zeros((2, 2), np.uint8), wrap=5), "wrap: is 5; expected one of repeat, mirrored, clamp"),
    (lambda: halfspace.Texture(np.zeros((2, 2), np.uint8), anisotropy=1.5), "anisotropy: is 1.5; expected an integer from 1 to 16"),
    (lambda: halfspace.Scene().add_light("point", position=(0, 0, np.nan)), "position[2]: is nan; expected a finite number"),
    (lambda: halfspace.Scene().add_light("point", intensity=np.float32("inf")), "intensity: is inf; expected a finite number"),
    (lambda: halfspace.Scene().add_light("point", position={1, 2}), "position: is of type set; expected a bool, a number, a string, a list"),
    (lambda: halfspace.Scene().add_light("point", name=5), "name: is 5; expected a string"),
    (lambda: halfspace.Scene().remove(["a"]), "name: is ['a']; expected a string"),
    (lambda: halfspace.Scene()[5], "key: is 5; expected a string"),
    (lambda: halfspace.Scene().set([("samples", 1)]), "keys: is of type list; expected a dictionary of keys and values"),
    (lambda: halfspace.Scene().set({5: 1}), "a key: is 5; expected a string"),
    (lambda: halfspace.Scene().set({"ambient": np.inf}), "ambient: is inf; expected a finite number"),
    (lambda: halfspace.Scene().set({"ambient": (1, np.nan, 1)}), "ambient: has an element that is not finite; expected finite numbers"),
    (lambda: halfspace.Scene().merge("x"), "patch: is of type str; expected a dictionary"),
    (lambda: halfspace.Scene().merge({"lights": {"a": {"position": np.array([1, np.nan, 0])}}}), "lights.a.position[1]: is nan; expected"),
    (lambda: halfspace.Scene().merge({"lights": {5: {}}}), "lights: a key: is 5; expected a string"),
    (lambda: halfspace.Scene.load(None), "path: is None; expected a file name"),
    (lambda: halfspace.Scene().add(halfspace.Mesh(*QUAD), [[1, 2], [3]]), "transform: is not an array; expected numbers of shape (4, 4)"),
    (lambda: halfspace.Scene().fit(), "fit: the scene has no visible object; expected at least one"),
])
def test_wrong_arrays_are_reported(make, words):
    with pytest.raises(halfspace.InputError) as error:
        make()
    assert str(error.value).startswith(words) and "\n" not in str(error.value)


@pytest.mark.parametrize("name, words", [("Wrong=Name", "invalid name"), ("post", "is a reserved word"), (7, "name: is 7; expected a string"),
                                         ("object_1", "name: an object 'object_1' exists; expected another name")])
def test_a_wrong_name_is_rejected_at_once(name, words):
    scene = halfspace.Scene(lighting="none")
    scene.add(halfspace.Mesh(*QUAD, material=flat()))
    with pytest.raises(halfspace.InputError, match=words):
        scene.add(halfspace.Mesh(*QUAD, material=flat()), name=name)
    assert (scene.render((4, 4), camera=CAMERA) == 255).all() and scene.objects == ["object_1"]


def test_objects_and_lights_of_a_file_are_not_changed_by_adding():
    scene = halfspace.Scene.load("moon")
    with pytest.raises(halfspace.InputError, match="name: an object 'moon' exists; expected another name"):
        scene.add(halfspace.Mesh(*QUAD), name="moon")
    with pytest.raises(halfspace.InputError, match="name: a light 'sun' exists; expected another name"):
        scene.add_light(name="sun")
    scene.merge({"objects": {"object_1": {"shape": "sphere"}}})
    assert scene.add(halfspace.Mesh(*QUAD)) == "object_2"


def test_more_objects_than_one_patch_can_have():
    scene, mesh = halfspace.Scene(lighting="none"), halfspace.Mesh(*QUAD, material=flat())
    for _ in range(4100):
        scene.add(mesh)
    assert len(scene.objects) == 4100


def test_only_rejected_objects_are_dropped():
    """A scene can have at most 65,536 objects, counting copies. Objects that fit are added."""
    scene = halfspace.Scene(lighting="none")
    copies = [4096] * 15 + [4094]
    scene.merge({"objects": {f"many_{i}": {"shape": "plane", "instances": [{}] * count} for i, count in enumerate(copies)}})
    before = scene.objects
    for name in ("first", "second", "third", "fourth"):
        scene.add(halfspace.Mesh(*QUAD, material=flat()), name=name)
    for _ in range(2):
        with pytest.raises(halfspace.InputError, match="65537 objects including instances"):
            scene.render((4, 4))
    assert scene.objects == before + ["first", "second"]
    with pytest.raises(halfspace.InputError, match="no object 'third'"):
        scene.remove("third")
