# SPDX-License-Identifier: Apache-2.0
"""Cameras: the pixels to which points are projected, and the conventions of their arguments."""

import pickle

import numpy as np
import pytest

import halfspace
from conftest import QUAD

WHITE = halfspace.Material((1, 1, 1), unlit=True)
SIZE = (64, 48)
K = np.array([[70.0, 3.0, 20.3], [0, 65.0, 31.7], [0, 0, 1]])


def random_rotation(rng):
    q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return q * np.linalg.det(q)


def moved(K, x=0.0, y=0.0):
    out = K.copy()
    out[0, 2] += x
    out[1, 2] += y
    return out


def covered(corners_camera, R, t, K, pixel):
    """Returns whether the pixel (column, row) shows the quad. Its corners are given in OpenCV's camera space."""
    scene = halfspace.Scene(lighting="none", threads=1)
    scene["samples"] = 1
    scene.add(halfspace.Mesh((corners_camera - t) @ R, QUAD[1], material=WHITE))
    camera = halfspace.Camera.from_intrinsics(K, extrinsics=np.column_stack([R, t]), near=0.5, far=100)
    return scene.render(SIZE, camera=camera)[pixel[1], pixel[0], 0] == 255


def test_points_land_within_a_256th_of_a_pixel():
    """Moves an edge through each point across the center of a pixel. The pixel must change within 1/256 px."""
    rng = np.random.default_rng(5)
    step = 1 / 256
    for _ in range(100):
        R, t = random_rotation(rng), rng.uniform(-5, 5, 3)
        z = rng.uniform(1, 30)
        pixel = rng.integers(2, 46, 2)
        image = pixel + rng.uniform(-0.49, 0.49, 2)
        p = z * np.linalg.solve(K, [*image, 1.0])
        projected = K @ (R @ (R.T @ (p - t)) + t)
        image = projected[:2] / projected[2]
        along_y, along_x = z * np.array([-K[0, 1] / K[0, 0], 1, 0]), z * np.array([1.0, 0, 0])  # the directions of columns and rows
        right = np.array([p - along_y, p - along_y + along_x, p + along_y + along_x, p + along_y])
        below = np.array([p - along_x, p - along_x + along_y, p + along_x + along_y, p + along_x])
        dx, dy = pixel - image
        assert covered(right, R, t, moved(K, dx - step), pixel) and not covered(right, R, t, moved(K, dx + step), pixel)
        assert covered(below, R, t, moved(K, 0, dy - step), pixel) and not covered(below, R, t, moved(K, 0, dy + step), pixel)


def textured_scene():
    rng = np.random.default_rng(1)
    scene = halfspace.Scene()
    for place in rng.uniform(-1, 1, (6, 3)):
        transform = np.eye(4)
        transform[:3, :3] = 0.3 * random_rotation(rng)
        transform[:3, 3] = place
        scene.add(halfspace.Mesh(*QUAD, material=halfspace.Material(rng.uniform(0, 1, 3))), transform)
    return scene


def difference(a, b):
    return np.abs(a.astype(int) - b.astype(int)).max()


def look_at_pose(eye, target):
    back = np.subtract(eye, target) / np.linalg.norm(np.subtract(eye, target))
    right = np.cross((0, 1, 0), back)
    right /= np.linalg.norm(right)
    pose = np.eye(4)
    pose[:3] = np.column_stack([right, np.cross(back, right), back, eye])
    return pose


def test_all_kinds_of_cameras_show_the_same():
    scene, eye, target = textured_scene(), (2.0, 1.5, 4.0), (0.1, 0.0, -0.2)
    width, height = 120, 90
    expected = scene.render((width, height), camera=halfspace.Camera.look_at(eye, target, fov=40, near=1, far=20))
    pose = look_at_pose(eye, target)
    f = 1 / np.tan(np.radians(20))
    projection = [[f * height / width, 0, 0, 0], [0, f, 0, 0], [0, 0, -21 / 19, -40 / 19], [0, 0, -1, 0]]
    K = [[f * height / 2, 0, (width - 1) / 2], [0, f * height / 2, (height - 1) / 2], [0, 0, 1]]
    extrinsics = np.diag([1, -1, -1, 1]) @ np.linalg.inv(pose)
    cameras = [
        halfspace.Camera.from_pose(pose, fov=40, near=1, far=20),
        halfspace.Camera.from_matrices(projection, pose=pose),
        halfspace.Camera.from_matrices(projection, view=np.linalg.inv(pose)),
        halfspace.Camera.from_intrinsics(K, extrinsics=extrinsics, near=1, far=20),
        halfspace.Camera.from_intrinsics(K, extrinsics=extrinsics[:3], near=1, far=20),
        halfspace.Camera.from_intrinsics(K, pose=pose, near=1, far=20),
    ]
    for camera in cameras:
        assert difference(scene.render((width, height), camera=camera), expected) <= 1, camera
    turned = halfspace.Camera.from_intrinsics(K, pose=pose @ np.diag([1, -1, -1, 1]), near=1, far=20)
    assert difference(scene.render((width, height), camera=turned), expected) > 20


def test_orthographic_matrices_match_look_at():
    scene, eye = textured_scene(), (0.0, 0.0, 5.0)
    expected = scene.render((100, 100), camera=halfspace.Camera.look_at(eye, height=3, near=1, far=10))
    projection = np.diag([2 / 3, 2 / 3, -2 / 9, 1.0])
    projection[2, 3] = -11 / 9
    camera = halfspace.Camera.from_matrices(projection, pose=look_at_pose(eye, (0, 0, 0)))
    assert difference(scene.render((100, 100), camera=camera), expected) <= 1


def test_the_sky_moves_with_the_principal_point():
    """The picture of an off-center view is identical to the corresponding part of a larger picture."""
    scene = halfspace.Scene.load("environment")
    pose = look_at_pose((0.0, 1.0, 6.0), (0.0, 0.5, 0.0))
    K = np.array([[100.0, 0, 79.5], [0, 100.0, 59.5], [0, 0, 1]])
    scene["samples"] = 1
    whole = scene.render((160, 120), camera=halfspace.Camera.from_intrinsics(K, pose=pose))
    part = scene.render((80, 60), camera=halfspace.Camera.from_intrinsics(moved(K, -60, -10), pose=pose))
    close = np.abs(part.astype(int) - whole[10:70, 60:140].astype(int)) <= 3
    assert whole.std() > 5 and close.mean() > 0.98


def test_exact_spheres_reject_off_center_cameras():
    scene = halfspace.Scene(lighting="none")
    scene.merge({"ambient": 1, "objects": {"ball": {"shape": "sphere"}}})
    pose = look_at_pose((0.0, 0.0, 4.0), (0.0, 0.0, 0.0))
    centered = np.array([[40.0, 0, 15.5], [0, 40, 15.5], [0, 0, 1]])
    assert scene.render((32, 32), camera=halfspace.Camera.from_intrinsics(centered, pose=pose)).any()
    with pytest.raises(halfspace.InputError, match="camera: exact spheres need a symmetric view"):
        scene.render((32, 32), camera=halfspace.Camera.from_intrinsics(moved(centered, 1), pose=pose))


@pytest.mark.parametrize("rounded", [lambda m: m.astype(np.float32), lambda m: np.round(m, 4)])
def test_rounded_rotations_are_made_exact(rounded):
    """The error of a pixel is the rounding of the pose: at most 5e-5 * sqrt(3) radians, or 0.009 px at a focal length of 100 px."""
    scene, rng = textured_scene(), np.random.default_rng(5)
    for _ in range(20):
        eye = rng.normal(size=3)
        eye *= 4 / np.linalg.norm(eye)
        pose = look_at_pose(eye, (0.0, 0.0, 0.0))
        near = halfspace.Camera.from_pose(rounded(pose), fov=40, near=1, far=20)
        exact = halfspace.Camera.from_pose(pose, fov=40, near=1, far=20)
        positions = [scene.labels(["position", "mask"], size=(60, 40), camera=camera) for camera in (near, exact)]
        both = positions[0]["mask"] & positions[1]["mask"]
        assert both.sum() > 100
        # A pixel is about 0.07 units wide; a grazing angle of up to 80 degrees multiplies the error by 6.
        assert np.percentile(np.abs(positions[0]["position"] - positions[1]["position"])[both], 99) < 0.07 * 0.01 * 6


@pytest.mark.parametrize("camera", [
    halfspace.Camera.look_at((1, 2, 3), (0, 0.5, 0), (0, 0, 1), fov=30, near=0.5, far=20),
    halfspace.Camera.look_at((1, 2, 3), height=2),
    halfspace.Camera.from_pose(look_at_pose((1.0, 2.0, 3.0), (0.0, 0.0, 0.0)), fov=50),
    halfspace.Camera.from_matrices(np.diag([1.0, 1.0, -0.1, 1.0]), view=np.eye(4)),
    halfspace.Camera.from_intrinsics(np.array([[60.0, 2, 30], [0, 55, 20], [0, 0, 1]]), extrinsics=np.eye(4)[:3] + [[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 4]]),
])
def test_a_pickled_camera_shows_the_same(camera):
    scene = halfspace.Scene(lighting="none")
    scene.merge({"ambient": 1, "objects": {"ball": {"shape": "uv_sphere", "rotation": [20, 30, 0]}}})
    again = pickle.loads(pickle.dumps(camera))
    assert repr(again) == repr(camera)
    picture = scene.render((64, 48), camera=camera)
    assert picture.any() and np.array_equal(scene.render((64, 48), camera=again), picture)


@pytest.mark.parametrize("make, words", [
    (lambda c: c.look_at((1, 2, 3), fov=30, height=2), "fov, height: both are given; expected fov for a perspective"),
    (lambda c: c.look_at((0, 0, 0)), "target: is the position of the camera; expected another point"),
    (lambda c: c.look_at((0, 1, 0)), "up: is parallel to the line from position to target, or zero; expected another direction"),
    (lambda c: c.look_at((0, 0, 1), up=(0, 0, 0)), "up: is parallel"),
    (lambda c: c.look_at((0, 0, 1), fov=180), "fov: is 180; expected a number from 0.01 to 179"),
    (lambda c: c.look_at((0, 0, 1), near=2, far=1), "far: is 1; expected more than near, 2"),
    (lambda c: c.look_at((0, 0, np.nan)), "position[2]: is nan; expected a finite number"),
    (lambda c: c.from_pose(np.eye(3)), "pose: has the shape (3, 3); expected (4, 4)"),
    (lambda c: c.from_intrinsics(K), "extrinsics, pose: both or none are given; expected one of them"),
    (lambda c: c.from_intrinsics(K, pose=np.eye(4), extrinsics=np.eye(4)), "extrinsics, pose: both or none are given; expected one"),
    (lambda c: c.from_intrinsics(np.diag([1.0, 1, 2]), pose=np.eye(4)), "K: is [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 2.0]]; expected"),
    (lambda c: c.from_intrinsics(K, extrinsics=np.eye(3)), "extrinsics: has the shape (3, 3); expected (3, 4) or (4, 4)"),
    (lambda c: c.from_matrices(np.eye(4)), "view, pose: both or none are given; expected one of them"),
    (lambda c: c.from_matrices(np.eye(4), view=np.ones((4, 4))), "view: has the last row [1.0, 1.0, 1.0, 1.0]; expected [0, 0, 0, 1]"),
    (lambda c: c.from_matrices(np.ones((4, 4)), pose=np.eye(4)), "camera: the projection matrix cannot be used; expected"),
    (lambda c: c.from_pose(np.diag([2.0, 2, 2, 1])), "pose: is not a rotation and a translation; expected"),
    (lambda c: c.from_pose(np.diag([1.001, 1.001, 1.001, 1])), "pose: is not a rotation and a translation; expected"),
    (lambda c: c.from_pose(np.diag([-1.0, 1, 1, 1])), "pose: contains a reflection; expected a rotation and a translation"),
    (lambda c: c.from_pose(np.ones((4, 4))), "pose: has the last row [1.0, 1.0, 1.0, 1.0]; expected [0, 0, 0, 1]"),
    (lambda c: c.from_matrices(np.diag([1.0, 1, -0.1, 1]), view=np.diag([2.0, 2, 2, 1])), "view: is not a rotation and a translation"),
    (lambda c: c.from_intrinsics(K, extrinsics=np.diag([2.0, 2, 2, 1])), "extrinsics: is not a rotation and a translation; expected"),
    (lambda c: c.from_intrinsics(K, extrinsics=[[1, 2], [3]]), "extrinsics: is not an array; expected numbers of shape (3, 4) or (4, 4)"),
    (lambda c: c.from_intrinsics(K, extrinsics=[["a"] * 4] * 3), "extrinsics: has the dtype <U1; expected a floating-point or integer dtype"),
])
def test_wrong_cameras_are_reported(make, words):
    with pytest.raises(halfspace.InputError) as error:
        make(halfspace.Camera)
    assert str(error.value).startswith(words) and "\n" not in str(error.value)


SNAPPED = 1 / 512 + 1e-4  # half a step, and the rounding of points to float32


def projected(points, matrix):
    """Returns the points after a projection to homogeneous coordinates, divided by the last of them."""
    out = np.column_stack([points, np.ones(len(points))]) @ matrix.T
    return out[:, :-1] / out[:, -1:]


def seen_points(scene, camera, size):
    """Returns the points in world space that pixels show, with the columns, the rows and the depths of the pixels."""
    labels = scene.labels(["position", "depth", "mask"], size=size, camera=camera)
    rows, columns = np.nonzero(labels["mask"])
    return labels["position"][rows, columns].astype(float), np.column_stack([columns, rows]), labels["depth"][rows, columns]


def cameras_of_all_kinds(scene):
    pose = look_at_pose((2.0, 1.5, 4.0), (0.1, 0.0, -0.2))
    skewed = [[1.7, 0.2, 0.15, 0], [0.1, 2.1, -0.2, 0], [0, 0, -21 / 19, -40 / 19], [0, 0, -1, 0]]
    return {"look_at": halfspace.Camera.look_at((2, 1, 4), (0.1, 0, 0), up=(0.2, 1, 0), fov=33, near=0.5, far=50), "fit": scene.fit(fov=50),
            "from_pose": halfspace.Camera.from_pose(pose, fov=40), "from_matrices": halfspace.Camera.from_matrices(skewed, pose=pose),
            "from_intrinsics": halfspace.Camera.from_intrinsics(K, pose=pose), "view": scene.view(size=SIZE)}


@pytest.mark.parametrize("kind", ["look_at", "fit", "from_pose", "from_matrices", "from_intrinsics", "view"])
def test_every_camera_can_be_read_as_intrinsics_and_extrinsics(kind):
    """Projects the point that each pixel shows. It must land in the center of the pixel, except that vertices are snapped to
    1/256 px, which moves the interpolated point by up to 1/512 px."""
    scene = textured_scene()
    camera = cameras_of_all_kinds(scene)[kind]
    points, pixels, depths = seen_points(scene, camera, SIZE)
    assert len(points) > 30
    in_camera = projected(points, camera.extrinsics)
    assert np.abs(projected(in_camera, np.column_stack([camera.intrinsics(SIZE), [0, 0, 0]])) - pixels).max() < SNAPPED
    assert np.allclose(in_camera[:, 2], depths, rtol=1e-6)
    ndc = projected(points, camera.projection(SIZE) @ np.linalg.inv(camera.pose))
    assert np.abs((ndc[:, 0] + 1) * SIZE[0] / 2 - 0.5 - pixels[:, 0]).max() < SNAPPED
    assert np.abs((1 - ndc[:, 1]) * SIZE[1] / 2 - 0.5 - pixels[:, 1]).max() < SNAPPED


def test_an_orthographic_camera_can_be_read_as_matrices():
    scene = textured_scene()
    camera = halfspace.Camera.look_at((2, 1, 4), (0, 0.2, 0), height=3, near=1, far=20)
    points, pixels, _ = seen_points(scene, camera, SIZE)
    ndc = projected(points, camera.projection(SIZE) @ np.linalg.inv(camera.pose))
    assert np.abs((ndc[:, 0] + 1) * SIZE[0] / 2 - 0.5 - pixels[:, 0]).max() < SNAPPED and ndc[:, 2].min() > -1 and ndc[:, 2].max() < 1
    with pytest.raises(halfspace.InputError, match="camera: is orthographic, so it has no intrinsics; expected a perspective camera"):
        camera.intrinsics(SIZE)


def test_a_camera_read_and_created_again_is_the_same():
    camera = halfspace.Camera.look_at((2, 1, 4), (0, 0.2, 0), fov=33, near=0.1)
    again = halfspace.Camera.from_intrinsics(camera.intrinsics(SIZE), extrinsics=camera.extrinsics, near=0.1)
    assert np.allclose(again.projection(SIZE), camera.projection(SIZE), rtol=1e-13, atol=1e-15)
    assert np.allclose(again.intrinsics(SIZE), camera.intrinsics(SIZE), rtol=1e-13, atol=1e-12) and np.allclose(again.pose, camera.pose)
    given = halfspace.Camera.from_intrinsics(K, pose=look_at_pose((2.0, 1.5, 4.0), (0, 0, 0)))
    assert np.allclose(given.intrinsics(SIZE), K, rtol=1e-14, atol=1e-13)  # two roundings per element
    with pytest.raises(halfspace.InputError, match="size: is 7; expected"):
        camera.intrinsics(7)


def test_nothing_in_front_of_a_camera_without_a_near_plane_vanishes():
    """A square is 1e-3 units in front of the camera. Its half size is twice the distance, so it fills a view of 90 degrees."""
    scene = halfspace.Scene(lighting="none")
    square = [[-2e-3, -2e-3, 0], [2e-3, -2e-3, 0], [2e-3, 2e-3, 0], [-2e-3, 2e-3, 0]]
    scene.add(halfspace.Mesh(square, [[0, 1, 2], [0, 2, 3]], material=halfspace.Material((1, 1, 1))))
    pose = np.eye(4)
    pose[2, 3] = 1e-3
    half = [[16, 0, 15.5], [0, 16, 15.5], [0, 0, 1]]
    for camera in (halfspace.Camera.look_at((0, 0, 1e-3), fov=90), halfspace.Camera.from_pose(pose, fov=90),
                   halfspace.Camera.from_intrinsics(half, pose=pose)):
        depth = scene.labels(["depth"], size=(32, 32), camera=camera)["depth"]
        assert np.allclose(depth, 1e-3, rtol=1e-6)
        assert np.isfinite(camera.projection((32, 32))).all()


def test_the_cameras_of_a_scene_can_be_read():
    scene = halfspace.Scene.load("moon")
    names = scene.cameras
    assert "terminator" in names
    picture = scene.render(SIZE, camera="terminator")
    view = scene.view("terminator", size=SIZE)
    assert np.allclose(view.pose[:3, 3], scene["terminator.position"]) and difference(scene.render(SIZE, camera=view), picture) == 0
    assert difference(scene.render(SIZE, camera=scene.view(size=SIZE)), scene.render(SIZE)) == 0
    scene.camera = halfspace.Camera.look_at((0, 0, 3))
    assert scene.view() is scene.camera
    for wrong in ("", "clsoe", 3):
        with pytest.raises(halfspace.InputError, match="^camera: "):
            scene.view(wrong)


def test_default_planes_cut_off_nothing():
    """A wall at a distance of 200 km and a small quad at 2 mm, with all kinds of perspective cameras."""
    scene = halfspace.Scene(lighting="none")
    scene.add(halfspace.Mesh(*QUAD, material=WHITE), [[1e6, 0, 0, 0], [0, 1e6, 0, 0], [0, 0, 1, -2e5], [0, 0, 0, 1]])
    scene.add(halfspace.Mesh(*QUAD, material=WHITE), [[1e-4, 0, 0, 0], [0, 1e-4, 0, 0], [0, 0, 1, -2e-3], [0, 0, 0, 1]])
    for camera in (halfspace.Camera.look_at((0, 0, 0), (0, 0, -1)), halfspace.Camera.from_pose(np.eye(4)),
                   halfspace.Camera.from_intrinsics(np.array([[40.0, 0, 15.5], [0, 40, 15.5], [0, 0, 1]]), pose=np.eye(4))):
        depth = scene.labels(["depth"], size=(32, 32), camera=camera)["depth"]
        # Depth is rounded to float, and interpolated from float positions: 3e-7 of the largest coordinate.
        np.testing.assert_allclose(depth[0, 0], 2e5, rtol=5e-6)
        np.testing.assert_allclose(depth[16, 16], 2e-3, rtol=5e-6)
