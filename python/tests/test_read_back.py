# SPDX-License-Identifier: Apache-2.0
"""Meshes, materials and scenes can be read: members, shapes, model files, keys, names and lights."""

import copy
import json
import pickle

import numpy as np
import pytest

import halfspace
from conftest import QUAD, sphere

SIZE = (64, 48)
CORNERS = [[0, 0], [1, 0], [1, 1], [0, 1]]  # texture coordinates of QUAD
CUBE_OBJ = "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1)) + (
    "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n")


def two_parts(folder):
    """Writes an OBJ of a red quad and a blue triangle, and an unused vertex far away."""
    (folder / "two.mtl").write_text("newmtl red\nKd 0.5 0.25 0.125\nnewmtl blue\nKd 0 0 1\n")
    path = folder / "two.obj"
    path.write_text("mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 2\nusemtl red\nf 1 2 3 4\nusemtl blue\nf 1 2 5\n")
    return path


# ---- meshes and materials ------------------------------------------------------------------------------------------


def test_the_arrays_of_a_mesh_can_be_read():
    vertices, faces, normals, uvs = sphere(4, 6)
    colors = np.linspace(0, 1, 3 * len(vertices)).reshape(-1, 3)
    material = halfspace.Material((1, 0.5, 0.25))
    mesh = halfspace.Mesh(vertices, faces, normals=2 * normals, uvs=uvs, colors=colors, material=material)
    assert np.array_equal(mesh.vertices, vertices) and np.array_equal(mesh.faces, faces) and np.allclose(mesh.normals, normals, atol=1e-7)
    assert np.array_equal(mesh.uvs, uvs.astype(np.float32)) and np.array_equal(mesh.colors[:, :3], colors.astype(np.float32))
    assert mesh.material is material and mesh.topology == "triangles" and mesh.uv_origin == "lower_left"
    vertices[0] = 7  # the mesh has a copy
    assert mesh.vertices[0, 1] == 1
    for array in (mesh.vertices, mesh.faces, mesh.normals, mesh.uvs, mesh.colors, mesh.bounds):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
    plain = halfspace.Mesh(np.zeros((6, 3)))
    assert plain.faces.tolist() == [[0, 1, 2], [3, 4, 5]] and plain.normals is None and plain.uvs is None and plain.colors is None
    assert halfspace.Mesh(np.zeros((2, 3)), topology="points").faces.tolist() == [0, 1]


def test_arrays_of_the_right_type_are_not_shared():
    vertices, faces = np.array(QUAD[0], np.float64), np.array(QUAD[1], np.uint32)
    mesh = halfspace.Mesh(vertices, faces)
    vertices[:], faces[:] = 9, 0
    assert np.array_equal(mesh.vertices, QUAD[0]) and np.array_equal(mesh.faces, QUAD[1])


def test_vertices_that_no_face_uses_do_not_count():
    vertices = np.vstack([QUAD[0], [[100.0, 200, 300]]])
    mesh = halfspace.Mesh(vertices, QUAD[1])
    assert mesh.bounds.tolist() == [[-1, -1, 0], [1, 1, 0]]
    scene = halfspace.Scene()
    scene.add(mesh)
    assert scene.bounds.tolist() == [[-1, -1, 0], [1, 1, 0]]


def test_the_properties_of_a_material_can_be_read_but_not_changed():
    texels = np.arange(12, dtype=np.uint8).reshape(2, 2, 3)
    texture = halfspace.Texture(texels, filter="nearest", wrap=("clamp", "repeat"), anisotropy=4)
    material = halfspace.Material((0.1, 0.2, 0.3, 0.5), metallic=0.25, roughness=0.75, emissive=(2, 3, 4), ior=1.25, clearcoat=0.5,
                                  unlit=True, double_sided=False, base_color_texture=texture, normal_texture=texels)
    assert material.base_color == (0.1, 0.2, 0.3, 0.5) and material.alpha_mode == "blend" and material.emissive == (2, 3, 4)
    assert (material.metallic, material.roughness, material.ior, material.clearcoat) == (0.25, 0.75, 1.25, 0.5)
    assert material.unlit is True and material.double_sided is False and material.base_color_texture is texture
    assert material.occlusion_texture is None and np.array_equal(material.normal_texture.texels[..., :3], texels)
    assert (texture.filter, texture.mag, texture.wrap, texture.anisotropy) == ("nearest", "nearest", ("clamp", "repeat"), 4)
    with pytest.raises(AttributeError, match="^Material.metallic: cannot be changed; expected a new Material$"):
        material.metallic = 1
    with pytest.raises(AttributeError, match="^Texture.filter: cannot be changed"):
        del texture.filter
    assert copy.deepcopy(material) is material and copy.copy(texture) is texture
    again = pickle.loads(pickle.dumps(material))
    assert repr(again) == repr(material) and np.array_equal(again.base_color_texture.texels, texture.texels)
    assert again.normal_texture.wrap == ("repeat", "repeat") and again.base_color_texture.wrap == ("clamp", "repeat")


def test_colors_can_be_given_as_srgb_codes():
    assert halfspace.Material("#ff0000").base_color == (1, 0, 0, 1)
    expected = halfspace.srgb(np.array([32, 64, 96, 128], np.uint8))
    half = halfspace.Material("#20406080", emissive="#204060")
    assert half.base_color == tuple(expected.tolist()) and half.alpha_mode == "blend" and half.emissive == half.base_color[:3]
    mesh = halfspace.Mesh(*QUAD, material=halfspace.Material("#3c78b4", unlit=True))
    scene = halfspace.Scene(lighting="none")
    scene.add(mesh)
    assert scene.render((4, 4), camera=halfspace.Camera.look_at((0, 0, 4), height=1))[1, 1].tolist() == [0x3C, 0x78, 0xB4]
    for wrong in ("red", "#ff00", "#gg0000", "ff0000", ""):
        with pytest.raises(halfspace.InputError, match="^base_color: is .*; expected 3 or 4 numbers from 0 to 1, \"#rrggbb\""):
            halfspace.Material(wrong)
    with pytest.raises(halfspace.InputError, match="^emissive: is '#11223344'; expected"):
        halfspace.Material(emissive="#11223344")


# ---- shapes --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name, size, keys", [
    ("sphere", (2, 2, 2), {"shape": "uv_sphere"}), ("icosphere", (2, 2, 2), {"shape": "icosphere"}), ("box", (2, 2, 2), {"shape": "cube"}),
    ("plane", (2, 0, 2), {"shape": "plane"}), ("cylinder", (2, 2, 2), {"shape": "cylinder"}), ("cone", (2, 2, 2), {"shape": "cone"}),
    ("torus", (2.5, 0.5, 2.5), {"shape": "torus"}), ("torus_knot", None, {"shape": "torus_knot"})])
def test_shapes_have_the_surfaces_of_scene_files(name, size, keys):
    """The depth of each pixel is that of the shape in a scene file. Both meshes have the same vertices, except that those of the knot, whose
    center is not the origin, are rounded to float32 once more. That can move one to the next 1/256 px: a pixel at an outline may differ, and
    depths on steep sides by 1e-3."""
    mesh = getattr(halfspace.Mesh, name)()
    if size is not None:
        assert np.allclose(mesh.bounds[1] - mesh.bounds[0], size, atol=2e-3)  # an icosphere has no vertex at +x
    own, listed = halfspace.Scene(lighting="none"), halfspace.Scene(lighting="none")
    own.add(mesh)
    listed.merge({"objects": {"thing": keys}})
    camera = halfspace.Camera.look_at((2, 3, 4))
    depths = [scene.labels(["depth", "uv"], size=SIZE, camera=camera) for scene in (own, listed)]
    a, b = (labels["depth"] for labels in depths)
    both = np.isfinite(a) & np.isfinite(b)
    assert both.sum() > 100 and (np.isfinite(a) != np.isfinite(b)).sum() <= (name == "torus_knot")
    assert np.allclose(a[both], b[both], rtol=1e-3 if name == "torus_knot" else 0, atol=0)
    assert np.allclose(depths[0]["uv"][both], depths[1]["uv"][both], atol=1e-2 if name == "torus_knot" else 1e-4)


def test_shapes_take_sizes_counts_and_materials():
    red = halfspace.Material("#ff0000")
    assert halfspace.Mesh.sphere(3, latitudes=4, longitudes=6, material=red).material is red
    assert len(halfspace.Mesh.sphere(latitudes=4, longitudes=6).faces) == 2 * 6 * 3
    assert len(halfspace.Mesh.icosphere(level=1).faces) == 80
    assert halfspace.Mesh.box((1, 2, 4)).bounds.tolist() == [[-0.5, -1, -2], [0.5, 1, 2]]
    assert np.allclose(np.linalg.norm(halfspace.Mesh.box((1, 2, 4)).normals, axis=1), 1)
    assert len(halfspace.Mesh.plane(segments=3).faces) == 18
    for make, words in [(lambda: halfspace.Mesh.sphere(0), "radius: is 0"), (lambda: halfspace.Mesh.sphere(latitudes=1), "latitudes: is 1"),
                        (lambda: halfspace.Mesh.torus(1, 1), "tube: is 1; expected less than the radius, 1"),
                        (lambda: halfspace.Mesh.torus(1, 1 - 1e-12), "tube: is"), (lambda: halfspace.Mesh.box("big"), "size: "),
                        (lambda: halfspace.Mesh.icosphere(level=9), "level: is 9"),
                        (lambda: halfspace.Mesh.sphere(latitudes=8192, longitudes=16384), "latitudes, longitudes: are 8192 and 16384")]:
        with pytest.raises(halfspace.InputError, match=f"^{words}"):
            make()


# ---- model files ---------------------------------------------------------------------------------------------------


def test_a_mesh_can_be_loaded(tmp_path):
    (tmp_path / "cube.obj").write_text(CUBE_OBJ)
    mesh = halfspace.Mesh.load(tmp_path / "cube.obj")
    assert mesh.bounds.tolist() == [[0, 0, 0], [1, 1, 1]] and mesh.faces.shape == (12, 3) and mesh.topology == "triangles"
    corners = mesh.vertices[mesh.faces]
    assert {tuple(p) for p in corners.reshape(-1, 3)} == {(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)}
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert np.einsum("ij,ij", across, corners.mean(axis=1) - 0.5) > 0 and (mesh.normals[mesh.faces[:, 0]] * across).sum(axis=1).min() > 0
    scene, shown = halfspace.Scene(), halfspace.Scene()
    scene.add(mesh)
    shown.merge({"objects": {"cube": {"shape": "file", "file": str(tmp_path / "cube.obj")}}})
    assert np.array_equal(scene.render(SIZE), shown.render(SIZE))
    with pytest.raises(halfspace.InputError, match="none.obj"):
        halfspace.Mesh.load(tmp_path / "none.obj")


def test_a_file_with_several_materials_is_a_model(tmp_path):
    path = two_parts(tmp_path)
    with pytest.raises(halfspace.InputError, match=r"two.obj: has 2 materials; expected one; Model.load\(\) keeps all of them"):
        halfspace.Mesh.load(path)
    both = halfspace.Mesh.load(path, material=halfspace.Material("#00ff00"))
    assert both.faces.shape == (3, 3) and both.bounds.tolist() == [[0, 0, 0], [1, 1, 2]] and both.material.base_color == (0, 1, 0, 1)
    model = halfspace.Model.load(path)
    assert model.bounds.tolist() == [[0, 0, 0], [1, 1, 2]] and repr(model) == f"Model({str(path)!r})"
    red, blue = model.meshes
    assert np.allclose(red.material.base_color, (0.5, 0.25, 0.125, 1), atol=0.3) and blue.material.base_color[2] > 0
    assert red.bounds.tolist() == [[0, 0, 0], [1, 1, 0]] and len(blue.faces) == 1


def test_scenes_share_a_model_that_is_read_once(tmp_path):
    path = two_parts(tmp_path)
    model = halfspace.Model.load(path)
    expected = halfspace.Scene()
    expected.merge({"objects": {"thing": {"shape": "file", "file": str(path)}}})
    picture = expected.render(SIZE)
    path.unlink()
    (tmp_path / "two.mtl").unlink()
    for _ in range(3):
        scene = halfspace.Scene()
        name = scene.add(model, name="Two Parts")
        assert np.array_equal(scene.render(SIZE), picture) and scene.bounds.tolist() == model.bounds.tolist()
    scene.place(name, np.diag([2.0, 2, 2, 1]))
    assert scene.bounds.tolist() == (2 * model.bounds).tolist()
    for mesh in model.meshes:
        scene.add(mesh)
    assert len(scene.objects) == 3 and np.isfinite(scene.labels(["depth"], size=SIZE)["depth"]).any()


def test_a_model_with_z_up_is_turned(tmp_path):
    path = two_parts(tmp_path)
    model = halfspace.Model.load(path, up_axis="z")
    assert np.allclose(model.bounds, [[0, 0, -1], [1, 2, 0]])
    scene = halfspace.Scene()
    scene.add(model)
    assert np.allclose(scene.bounds, model.bounds)
    assert np.allclose(halfspace.Mesh.load(path, up_axis="z", material=halfspace.Material()).bounds, model.bounds)


def test_textures_of_a_file_can_be_read(tmp_path):
    codes = np.array([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 255]]], np.uint8)
    mesh = halfspace.Mesh(*QUAD, uvs=[[0, 0], [1, 0], [1, 1], [0, 1]], colors=np.full((4, 3), 0.5),
                          material=halfspace.Material((1, 0.5, 0.25), metallic=0.5, base_color_texture=codes))
    scene = halfspace.Scene(lighting="none")
    scene.add(mesh)
    scene.export(tmp_path / "quad.glb")
    read = halfspace.Mesh.load(tmp_path / "quad.glb")
    assert np.array_equal(read.material.base_color_texture.texels[..., :3], codes) and read.material.metallic == 0.5
    assert np.allclose(read.material.base_color, (1, 0.5, 0.25, 1)) and np.allclose(read.colors[:, :3], 0.5, atol=0.01)
    corners = {tuple(np.round(p, 6)): tuple(uv) for p, uv in zip(read.vertices, read.uvs)}
    assert corners[(-1, -1, 0)] == (0, 1) and corners[(1, 1, 0)] == (1, 0) and read.uv_origin == "upper_left"


def test_textures_of_a_file_keep_16_bits(tmp_path):
    codes = np.array([[[32800, 32960, 0]]], np.uint16)
    scene = halfspace.Scene(lighting="none")
    scene.add(halfspace.Mesh(*QUAD, uvs=[[0, 0], [1, 0], [1, 1], [0, 1]],
                             material=halfspace.Material(base_color_texture=codes, normal_texture=np.float32([[[0.5, 0.5, 0.75]]]))))
    scene.export(tmp_path / "quad.glb")
    read = halfspace.Mesh.load(tmp_path / "quad.glb").material
    color, normal = read.base_color_texture.texels[0, 0], read.normal_texture.texels[0, 0]
    assert color.dtype == np.float32 and np.allclose(color[:2], ((codes[0, 0, :2] / 65535 + 0.055) / 1.055) ** 2.4, rtol=1e-6)
    assert np.allclose(normal, (0.5, 0.5, 0.75, 1), atol=1e-5)


def test_a_model_needs_meshes_and_a_file(tmp_path):
    with pytest.raises(TypeError, match="Model.load"):
        halfspace.Model()
    with pytest.raises(halfspace.InputError, match="up_axis: is 'x'; expected one of y, z"):
        halfspace.Model.load(tmp_path / "a.obj", up_axis="x")


# ---- scenes --------------------------------------------------------------------------------------------------------


def test_the_floor_of_a_model_does_not_count(tmp_path):
    (tmp_path / "cube.obj").write_text(CUBE_OBJ)
    scene = halfspace.Scene.load(tmp_path / "cube.obj")
    assert "floor" in scene.objects and np.allclose(scene.bounds, [[0, 0, 0], [1, 1, 1]], atol=1e-6)
    without = halfspace.Scene.load(tmp_path / "cube.obj", floor=False)
    assert np.array_equal(scene.fit().pose, without.fit().pose)


def test_a_scene_is_a_mapping_of_its_keys():
    scene = halfspace.Scene()
    name = scene.add(halfspace.Mesh.box(), name="ball")
    keys = list(scene)
    assert keys == scene.keys() and len(scene) == len(keys) and "samples" in keys and "objects.ball.visible" in keys
    assert "samples" in scene and "ball.visible" in scene and "objects.ball" in scene and name in scene and "key.intensity" in scene
    assert "bal" not in scene and 7 not in scene and "ball.visibel" not in scene
    assert scene["ball"]["visible"] is True and scene["post"]["tone"] == "aces" and scene["lights.key"]["type"] == "directional"
    assert dict(scene)["samples"] == 4
    with pytest.raises(halfspace.InputError, match="no 'bal' in this scene; did you mean 'ball'|bal"):
        scene["bal"]


@pytest.mark.parametrize("name", ["My Obj", "Cube.001", "wheel-left (2)", "Größe", "0", "a.radius", "Obj/1: #2", "it's"])
def test_names_are_any_text(name):
    scene = halfspace.Scene(lighting="none")
    scene.add(halfspace.Mesh.box(material=halfspace.Material("#ffffff", unlit=True)), name=name)
    light = scene.add_light("point", name=name, position=(0, 1, 2))
    assert scene.objects == [name] and scene.lights == [name] == [light]
    path = f"objects.{name}"
    assert scene[f"{path}.visible"] is True and path in scene and scene[path]["visible"] is True and f"{path}.visible" in scene.keys()
    assert scene.render((4, 4))[2, 2].tolist() == [255, 255, 255]
    scene[f"{path}.visible"] = False
    assert scene.render((4, 4), camera=halfspace.Camera.look_at((0, 0, 5)))[2, 2].tolist() == [0, 0, 0]
    with pytest.raises(halfspace.InputError, match="radus"):
        scene[f"{path}.radus"]
    scene.remove(name)
    scene.remove_light(name)
    assert scene.objects == [] and scene.lights == []


def test_a_name_with_dots_needs_no_collection():
    scene = halfspace.Scene(lighting="none")
    scene.add(halfspace.Mesh.box(), name="Cube")
    scene.add(halfspace.Mesh.box(), name="Cube.001")
    scene["Cube.001.visible"] = False
    assert scene["Cube.visible"] is True and scene["Cube.001.visible"] is False and scene["Cube.001"]["visible"] is False
    with pytest.raises(halfspace.InputError, match="unknown key 'visibel'"):
        scene["Cube.001.visibel"]


@pytest.mark.parametrize("name", ["", " a", "a ", "#a", "a=b", "a,b", "a\nb", "a\x00", "a\x7f"])
def test_names_that_keys_could_not_name_are_rejected(name):
    scene = halfspace.Scene(lighting="none")
    with pytest.raises(halfspace.InputError, match="invalid name; expected text without '=' and ','"):
        scene.add(halfspace.Mesh.box(), name=name)
    assert scene.objects == []


def test_lights_can_be_listed_and_removed():
    scene = halfspace.Scene()
    assert scene.lights == ["key"]
    lamp = scene.add_light("point", name="My Lamp", position=(0, 1, 2), color="#ff0000")
    spot = scene.add_light("spot", position=(0, 1, 2), direction=(0, 1, 2))
    assert scene.lights == ["key", lamp, spot] and scene[lamp]["position"] == [0, 1, 2] and scene["lights.My Lamp.color"] == [1, 0, 0]
    scene.remove_light("key")
    scene.remove_light(spot)
    assert scene.lights == [lamp]
    with pytest.raises(halfspace.InputError, match="^name: no light 'key' in this scene; expected one of My Lamp$"):
        scene.remove_light("key")
    with pytest.raises(halfspace.InputError, match=r"no object 'My Lamp' in this scene; expected remove_light\(\) for a light"):
        scene.remove("My Lamp")


def test_objects_of_a_scene_file_can_be_removed():
    scene = halfspace.Scene()
    scene.merge({"objects": {"ball": {"shape": "sphere"}}})
    scene.remove("ball")
    assert scene.objects == []
    with pytest.raises(halfspace.InputError, match=r"no object 'ball' in this scene; expected add\(\) first"):
        scene.remove("ball")


def test_the_filters_of_a_file_can_be_read(tmp_path):
    """Each number of glTF, also a magnification filter that does not follow from the other one."""
    numbers = {9728: "nearest", 9729: "bilinear", 9984: "nearest_mipmap_nearest", 9985: "bilinear_mipmap_nearest",
               9986: "nearest_mipmap_linear", 9987: "trilinear"}
    texels = np.arange(12, dtype=np.uint8).reshape(2, 2, 3)
    scene = halfspace.Scene(lighting="none")
    scene.add(halfspace.Mesh(*QUAD, uvs=CORNERS, material=halfspace.Material(base_color_texture=texels)))
    scene.export(tmp_path / "m.gltf")
    file = json.loads((tmp_path / "m.gltf").read_text())
    for small, filter in numbers.items():
        for large, mag in list(numbers.items())[:2]:
            file["samplers"] = [{"minFilter": small, "magFilter": large}]
            file["textures"][0]["sampler"] = 0
            (tmp_path / "n.gltf").write_text(json.dumps(file))
            texture = halfspace.Model.load(tmp_path / "n.gltf").meshes[0].material.base_color_texture
            assert (texture.filter, texture.mag) == (filter, mag)
            assert pickle.loads(pickle.dumps(texture)).mag == mag


def test_the_default_magnification_follows_the_other_filter():
    texels = np.zeros((2, 2), np.uint8)
    assert halfspace.Texture(texels).mag == "bilinear"
    assert halfspace.Texture(texels, filter="nearest_mipmap_linear").mag == "nearest"
    with pytest.raises(halfspace.InputError, match="^mag: is 'trilinear'"):
        halfspace.Texture(texels, mag="trilinear")


def test_the_magnification_filter_shows_whole_texels():
    texels = np.array([[0, 255], [255, 0]], np.uint8)
    levels = []
    for mag in ("nearest", "bilinear"):
        material = halfspace.Material(unlit=True, base_color_texture=halfspace.Texture(texels, mag=mag, wrap="clamp"))
        scene = halfspace.Scene(lighting="none")
        scene.add(halfspace.Mesh(*QUAD, uvs=CORNERS, material=material))
        levels.append(len(np.unique(scene.render((64, 64), camera=scene.fit()))))
    assert levels[0] < 8 and levels[1] > 20  # samples at the edges of texels mix two values
