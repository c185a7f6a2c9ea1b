# SPDX-License-Identifier: Apache-2.0
"""Labels: comparison with exact values for a quad and a sphere, ids, backgrounds, and batches."""

import numpy as np
import pytest

import halfspace
from conftest import QUAD, sphere

NONE = halfspace.NO_ID
WHITE = halfspace.Material((0.25, 0.5, 0.75), unlit=True)
SIZE = (40, 30)
K = np.array([[30.0, 2.0, 18.0], [0, 28.0, 16.5], [0, 0, 1]])


def moved(*offset):
    transform = np.eye(4)
    transform[:3, 3] = offset
    return transform


def look_down_z(distance=4.0, K=K):
    return halfspace.Camera.from_intrinsics(K, pose=moved(0, 0, distance), near=0.1, far=50)


@pytest.fixture
def quads():
    """A near quad in the center, and two copies of a far quad to its left and right."""
    scene = halfspace.Scene(lighting="none")
    uvs = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)
    scene.add(halfspace.Mesh(*QUAD, uvs=uvs, material=WHITE), np.diag([0.5, 0.5, 1, 1.0]) @ moved(0, 0, 1), name="near")
    scene.add(halfspace.Mesh(*QUAD, uvs=uvs, material=WHITE), np.stack([moved(-1.5, 0, -1), moved(1.5, 0, -1)]), name="far")
    return scene


def test_all_labels_have_their_shapes_and_types(quads):
    labels = quads.labels(size=SIZE, camera=look_down_z())
    assert tuple(labels) == halfspace.LABELS
    expected = {"color": (np.uint8, 3), "uv": (np.float32, 2), "mask": (np.bool_, 0)}
    expected.update({name: (np.uint32, 0) for name in ("object", "instance", "triangle")})
    expected.update({name: (np.float32, 0) for name in ("depth", "distance")})
    for name, array in labels.items():
        dtype, channels = expected.get(name, (np.float32, 3))
        assert array.dtype == dtype and array.shape == (30, 40) + ((channels,) if channels else ()), name
    assert np.array_equal(labels["color"], quads.render(SIZE, camera=look_down_z()))
    assert list(quads.labels(["uv", "mask"], size=SIZE)) == ["uv", "mask"]
    assert list(quads.labels(iter(["uv", "mask"]), size=SIZE)) == ["uv", "mask"]
    assert list(quads.label_batch([None], (name for name in ("depth", "mask")), size=SIZE)) == ["depth", "mask"]


def test_labels_follow_from_the_projection(quads):
    labels = quads.labels(size=SIZE, camera=look_down_z())
    row, column = np.nonzero(labels["mask"])
    near = labels["object"][row, column] == 0
    z = np.where(near, 3.0, 5.0)
    assert near.any() and not near.all()
    rays = np.linalg.solve(K, np.stack([column, row, np.ones(len(row))]))  # OpenCV's axes, z = 1
    points = np.stack([z * rays[0], -z * rays[1], 4 - z], axis=1)
    assert np.allclose(labels["depth"][row, column], z, atol=1e-5)
    assert np.allclose(labels["distance"][row, column], z * np.linalg.norm(rays, axis=0), atol=4e-4)
    step = 5 / 28 / 256  # vertices are snapped to 1/256 px; here in scene units
    assert np.allclose(labels["position"][row, column], points, atol=step)
    assert np.allclose(labels["normal"][row, column], [0, 0, 1], atol=1e-6)
    assert np.allclose(labels["albedo"][row, column], [0.25, 0.5, 0.75], atol=1e-6)
    copy = labels["instance"][row, column]
    center = np.where(near, 0, np.where(copy == 0, -1.5, 1.5))
    half = np.where(near, 0.5, 1.0)
    assert (copy[near] == 0).all() and np.array_equal(copy[~near], (points[~near, 0] > 0).astype(np.uint32))
    uv = np.stack([(points[:, 0] - center) / half * 0.5 + 0.5, 0.5 - points[:, 1] / half * 0.5], axis=1)
    assert np.allclose(labels["uv"][row, column], uv, atol=step)
    corners = QUAD[0][QUAD[1][labels["triangle"][row, column]]]
    local = (labels["barycentrics"][row, column][:, :, None] * corners).sum(axis=1)
    assert np.allclose(local[:, 0] * half + center, points[:, 0], atol=step) and np.allclose(local[:, 1] * half, points[:, 1], atol=step)
    assert quads.objects == ["near", "far"]


def test_the_background_has_no_surface(quads):
    labels = quads.labels(size=SIZE, camera=look_down_z())
    empty = ~labels["mask"]
    assert empty.any()
    for name in ("object", "instance", "triangle"):
        assert (labels[name][empty] == NONE).all() and (labels[name][~empty] != NONE).all()
    assert np.isposinf(labels["depth"][empty]).all() and np.isposinf(labels["distance"][empty]).all()
    for name in ("normal", "camera_normal", "albedo", "position", "uv", "barycentrics"):
        assert (labels[name][empty] == 0).all()
    assert (quads.labels(["depth"], size=SIZE, camera=look_down_z(), background_depth=0)["depth"][empty] == 0).all()


def test_camera_normals_turn_with_the_camera(quads):
    camera = halfspace.Camera.look_at((3, 0, 3), (0, 0, 1))
    labels = quads.labels(["object", "camera_normal"], size=SIZE, camera=camera)
    normals = labels["camera_normal"][labels["object"] == 0]
    yaw = np.arctan2(3, 2)
    assert len(normals) > 10 and np.allclose(normals, [-np.sin(yaw), 0, np.cos(yaw)], atol=1e-5)


def test_depth_of_a_sphere_and_a_plane_in_a_scene_file():
    scene = halfspace.Scene(lighting="none")
    scene.merge({"ambient": 1, "objects": {"ball": {"shape": "sphere"}, "floor": {"shape": "plane", "size": 20, "position": [0, -2, 0]}}})
    labels = scene.labels(["distance", "object", "normal"], size=(41, 41), camera=halfspace.Camera.look_at((0, 0, 5)))
    assert abs(labels["distance"][20, 20] - 4) < 1e-5 and labels["object"][20, 20] == 0
    assert np.allclose(labels["normal"][20, 20], [0, 0, 1], atol=1e-5)
    assert labels["object"][40, 20] == 1 and np.allclose(labels["normal"][40, 20], [0, 1, 0], atol=1e-6)
    assert scene.objects == ["ball", "floor"]


def test_a_batch_matches_single_frames(quads):
    cameras = [look_down_z(d) for d in (3.5, 4, 6, 8)]
    batch = quads.label_batch(cameras, size=SIZE)
    for i, camera in enumerate(cameras):
        for name, array in quads.labels(size=SIZE, camera=camera).items():
            assert np.array_equal(batch[name][i], array), name
    assert quads.label_batch([], ["depth", "color"], size=SIZE)["color"].shape == (0, 30, 40, 3)


def test_labels_outlive_their_scene(quads):
    labels = quads.labels(size=SIZE, camera=look_down_z())
    copies = {name: array.copy() for name, array in labels.items()}
    quads.remove("near")
    quads.labels(size=SIZE, camera=look_down_z())
    assert all(np.array_equal(labels[name], copies[name]) for name in labels)


def test_alpha_is_zero_where_nothing_is_drawn(quads):
    picture = quads.render(SIZE, camera=look_down_z(), alpha=True)
    mask = quads.labels(["mask"], size=SIZE, camera=look_down_z())["mask"]
    assert ((picture[..., 3] == 255) & mask).sum() > 0.75 * mask.sum() and ((picture[..., 3] == 0) & ~mask).sum() > 0.9 * (~mask).sum()
    assert (picture[picture[..., 3] == 0] == 0).all()
    light = quads.render(SIZE, camera=look_down_z(), alpha=True, linear=True)
    assert light[..., 3].min() == 0 and light[..., 3].max() == 1


@pytest.mark.parametrize("arguments, words", [
    ({"outputs": ["deph"]}, "outputs: is 'deph'; expected one of color, depth"),
    ({"outputs": "depth"}, "outputs: is 'depth'; expected a list of names"),
    ({"background_depth": float("nan")}, "background_depth: is nan; expected"),
    ({"background_depth": None}, "background_depth: is None; expected a number or infinity"),
    ({"background_depth": "far"}, "background_depth: is 'far'; expected a number or infinity"),
    ({"outputs": None}, "outputs: is of type NoneType; expected a list of names"),
    ({"time": "1"}, "time: is '1'; expected a number"),
    ({"camera": 5}, "camera: is of type int; expected a halfspace.Camera, the name of a camera or None"),
])
def test_wrong_arguments_are_reported(quads, arguments, words):
    with pytest.raises(halfspace.InputError) as error:
        quads.labels(size=SIZE, **arguments)
    assert str(error.value).startswith(words)


@pytest.mark.parametrize("arguments, words", [
    ({"cameras": halfspace.Camera.look_at((0, 0, 4))}, "cameras: is of type Camera; expected a sequence of cameras"),
    ({"cameras": "main"}, "cameras: is of type str; expected a sequence of cameras"),
    ({"cameras": [None], "progress": 5}, "progress: is of type int; expected a function or None"),
    ({"cameras": [None], "time": [0, 1]}, "time: has 2 values; expected one per camera, 1"),
])
def test_wrong_arguments_of_batches_are_reported(quads, arguments, words):
    for batch in (quads.render_batch, quads.label_batch):
        with pytest.raises(halfspace.InputError) as error:
            batch(size=SIZE, **arguments)
        assert str(error.value).startswith(words)


def test_cameras_and_times_may_be_iterators(quads):
    cameras = [look_down_z(d) for d in (3.5, 4)]
    expected = quads.render_batch(cameras, size=SIZE)
    assert np.array_equal(quads.render_batch((camera for camera in cameras), size=SIZE, time=(t for t in (0.0, 1.0))), expected)


def test_labels_without_color_do_not_need_light():
    """A warning is an error in this suite."""
    scene = halfspace.Scene(lighting="none")
    scene.add(halfspace.Mesh(*QUAD))
    depth = scene.labels(["depth"], size=SIZE, camera=look_down_z())["depth"]
    batch = scene.label_batch([look_down_z()] * 2, ["depth", "albedo"], size=SIZE)
    assert np.array_equal(batch["depth"][1], depth)
    with pytest.warns(halfspace.RenderWarning, match="nothing lights the scene"):
        labels = scene.labels(size=SIZE, camera=look_down_z())
    assert np.array_equal(labels["depth"], depth) and np.array_equal(labels["albedo"], batch["albedo"][0])


def test_lights_and_shadows_do_not_change_labels():
    scene = halfspace.Scene.load("shadow-knot")
    color = scene.labels(size=SIZE)
    values = scene.labels([name for name in halfspace.LABELS if name != "color"], size=SIZE)
    assert all(np.array_equal(color[name], values[name]) for name in values)


def test_colors_are_pictures(quads):
    labels = quads.labels(["color"], size=SIZE, camera=look_down_z(), alpha=True)
    expected = quads.render(SIZE, camera=look_down_z(), alpha=True)
    assert labels["color"].shape == (30, 40, 4) and np.array_equal(labels["color"], expected)
    batch = quads.label_batch([look_down_z()] * 2, ["color"], size=SIZE, alpha=True)["color"]
    assert np.array_equal(batch[1], expected)
    pictures = quads.render_batch([look_down_z()] * 2, size=SIZE)
    opaque = quads.labels(["color"], size=SIZE, camera=look_down_z())["color"]
    for picture in (opaque, labels["color"], batch[0], pictures[1], quads.label_batch([None], ["color"], size=SIZE)["color"][0]):
        assert picture.flags.c_contiguous and picture._repr_png_().startswith(b"\x89PNG")
    assert pictures._repr_png_() is None


def test_face_ids_match_the_given_faces():
    vertices, faces, _, _ = sphere(6, 8)
    scene = halfspace.Scene(lighting="none")
    scene.add(halfspace.Mesh(vertices, faces, crease=0, material=WHITE))  # splits all vertices
    labels = scene.labels(["triangle", "barycentrics", "position", "mask"], size=(60, 60), camera=halfspace.Camera.look_at((0, 0, 3)))
    mask = labels["mask"]
    corners = vertices[faces[labels["triangle"][mask]]]
    assert np.allclose((labels["barycentrics"][mask][:, :, None] * corners).sum(axis=1), labels["position"][mask], atol=1e-5)
