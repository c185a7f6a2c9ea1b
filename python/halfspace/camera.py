# SPDX-License-Identifier: Apache-2.0
"""Cameras.

World space is right-handed. A camera looks along -z with y up, as in OpenGL; with `extrinsics`, it looks along +z with y down, as in OpenCV.
"""

from __future__ import annotations

import math
from typing import Any, Callable, Dict, Optional, Tuple

import numpy as np

from . import _check, _core
from ._check import fail

# From the axes of an OpenCV camera to those of an OpenGL camera, and back.
_TURN = np.diag([1.0, -1.0, -1.0, 1.0])


class Camera:
    """A view of a scene. Use one of the class methods. Cameras are immutable and can be used with any scene, from any thread, and in other
    processes: they can be pickled.

    Every camera can be read as matrices: `pose`, `extrinsics`, projection() and intrinsics(). The last two depend on the size of the picture
    if the camera has a field of view instead of a projection in pixels.
    """

    __slots__ = ("_for_size", "_text", "_made_by")

    def __init__(self, for_size: Callable[[int, int], Any], text: str, made_by: Tuple[str, Dict[str, Any]]) -> None:
        """Internal: `for_size` returns the camera of _core for an image of width x height pixels. made_by: the class method and the
        arguments that create an equal camera."""
        self._for_size = for_size
        self._text = text
        self._made_by = made_by

    def __repr__(self) -> str:
        return self._text

    def __reduce__(self) -> Any:
        return _make, self._made_by

    @property
    def pose(self) -> np.ndarray:
        """Camera to world, with OpenGL's axes (x right, y up, z backward): float64 of shape (4, 4)."""
        return self._for_size(1, 1).pose()

    @property
    def extrinsics(self) -> np.ndarray:
        """World to camera, with OpenCV's axes (x right, y down, z forward): float64 of shape (4, 4)."""
        return _TURN @ _inverse("pose", self.pose)

    def projection(self, size: Tuple[int, int]) -> np.ndarray:
        """Returns OpenGL's projection for pictures of this size: camera to clip space, float64 of shape (4, 4). Clip-space z is -w at the
        near plane and w at the far plane.

        size: (width, height) in pixels.
        """
        width, height = _check.size(size)
        return self._for_size(width, height).projection(width, height)

    def intrinsics(self, size: Tuple[int, int]) -> np.ndarray:
        """Returns OpenCV's K for pictures of this size: float64 of shape (3, 3), in pixels. Pixel centers are at integers: (0, 0) is the
        center of the top left pixel. A point p in world space appears at K @ (extrinsics @ (*p, 1))[:3], divided by its third element.

        size: (width, height) in pixels.
        Raises InputError for orthographic cameras, which have no K.
        """
        width, height = _check.size(size)
        p = self.projection(size)
        if p[3, 3] != 0.0:
            raise fail("camera", "is orthographic, so it has no intrinsics", "a perspective camera, or projection()")
        half_width, half_height = width / 2.0, height / 2.0
        return np.array([[half_width * p[0, 0], -half_width * p[0, 1], half_width * (1.0 - p[0, 2]) - 0.5],
                         [-half_height * p[1, 0], half_height * p[1, 1], half_height * (1.0 + p[1, 2]) - 0.5], [0.0, 0.0, 1.0]])

    @classmethod
    def look_at(cls, position: Any, target: Any = (0.0, 0.0, 0.0), up: Any = (0.0, 1.0, 0.0), *, fov: Optional[float] = None,
                height: Optional[float] = None, near: Optional[float] = None, far: Optional[float] = None) -> "Camera":
        """Returns a camera at `position` that looks at `target`, both in world space.

        fov: full vertical angle of view in degrees, 0.01 to 179. The default is 45.
        height: if given, the camera is orthographic, and this is the height of the view volume in scene units. Excludes fov.
        near, far: distances of the clipping planes along the view axis in scene units; 0 < near < far. By default, nothing in front of
            the camera is clipped, and depth is as precise as with any other planes. The depth of an orthographic camera is linear; its
            far plane is by default 1000 units behind the near plane.
        """
        eye, aim, top = _check.vector("position", position), _check.vector("target", target), _check.vector("up", up)
        line = np.subtract(aim, eye)
        if not line.any():
            raise fail("target", "is the position of the camera", "another point")
        if np.linalg.norm(np.cross(line / np.linalg.norm(line), top)) <= 1e-12 * max(1e-300, float(np.linalg.norm(top))):
            raise fail("up", "is parallel to the line from position to target, or zero", "another direction")
        if fov is not None and height is not None:
            raise fail("fov, height", "both are given", "fov for a perspective camera or height for an orthographic one")
        angle = 45.0 if fov is None else _check.number("fov", fov, 0.01, 179.0)
        tall = 0.0 if height is None else _check.number("height", height, 1e-9, 1e9)
        _check_planes(near, far)
        camera = _core.Camera.look_at(eye, aim, top, angle, tall, 0.0 if near is None else float(near), 0.0 if far is None else float(far))
        made_by = {"position": eye, "target": aim, "up": top, "fov": fov, "height": height, "near": near, "far": far}
        return cls(lambda width, height: camera, f"Camera.look_at({eye}, {aim})", ("look_at", made_by))

    @classmethod
    def from_pose(cls, pose: Any, *, fov: float = 45.0, near: Optional[float] = None, far: Optional[float] = None) -> "Camera":
        """Returns a perspective camera with a pose: camera to world, OpenGL axes, shape (4, 4). See look_at for the other arguments."""
        world = _pose(pose, None)
        fov = _check.number("fov", fov, 0.01, 179.0)
        _check_planes(near, far)
        scale = 1.0 / math.tan(math.radians(fov) / 2.0)

        def for_size(width: int, height: int) -> Any:
            return _matrices(world, _frustum(scale * height / width, scale, 0.0, 0.0, 0.0, near, far))

        return cls(for_size, f"Camera.from_pose(fov={fov:g})", ("from_pose", {"pose": world, "fov": fov, "near": near, "far": far}))

    @classmethod
    def from_matrices(cls, projection: Any, *, view: Any = None, pose: Any = None) -> "Camera":
        """Returns a camera with the given OpenGL matrices.

        projection: camera to clip space, shape (4, 4), float. Clip-space z is -w at the near plane and w at the far plane. Perspective and
            orthographic projections may be off-center or skewed. The aspect ratio of the picture should match the projection.
        view: world to camera, OpenGL axes, shape (4, 4); or
        pose: its inverse, camera to world.
        """
        clip = _check.numbers("projection", projection, (4, 4))
        if (view is None) == (pose is None):
            raise fail("view, pose", "both or none are given", "one of them")
        world = _pose(pose, None) if view is None else _inverse("view", view)
        camera = _matrices(world, clip)
        return cls(lambda width, height: camera, "Camera.from_matrices(...)", ("from_matrices", {"projection": clip, "pose": world}))

    @classmethod
    def from_intrinsics(cls, K: Any, *, extrinsics: Any = None, pose: Any = None, near: Optional[float] = None, far: Optional[float] = None) -> "Camera":
        """Returns a calibrated camera, as in OpenCV.

        K: [[fx, skew, cx], [0, fy, cy], [0, 0, 1]] in pixels of the rendered image. Pixel centers are at integers: (0, 0) is the center of
            the top left pixel, and cx increases to the right and cy downwards.
        extrinsics: [R | t], world to camera, with OpenCV's axes (x right, y down, z forward), shape (3, 4) or (4, 4); or
        pose: camera to world, with OpenGL's axes (x right, y up, z backward), shape (4, 4).
            Rotations may be rounded to float32 or 4 decimals; the nearest exact rotation is used. Scale is rejected.
        near, far: distances of the clipping planes along the view axis in scene units; 0 < near < far. See look_at for the defaults.
        """
        k = _check.numbers("K", K, (3, 3))
        if k[1, 0] != 0.0 or k[2].tolist() != [0.0, 0.0, 1.0] or k[0, 0] <= 0.0 or k[1, 1] <= 0.0:
            raise fail("K", f"is {k.tolist()}", "[[fx, skew, cx], [0, fy, cy], [0, 0, 1]] with positive fx and fy")
        world = _pose(pose, extrinsics)
        _check_planes(near, far)
        fx, skew, cx, fy, cy = k[0, 0], k[0, 1], k[0, 2], k[1, 1], k[1, 2]

        def for_size(width: int, height: int) -> Any:
            # The center of pixel (0, 0) is half a pixel from the corner of the image. NDC y points up, and OpenCV's y down.
            center_x, center_y = 2.0 * (cx + 0.5) / width - 1.0, 1.0 - 2.0 * (cy + 0.5) / height
            return _matrices(world, _frustum(2.0 * fx / width, 2.0 * fy / height, -2.0 * skew / width, center_x, center_y, near, far))

        return cls(for_size, f"Camera.from_intrinsics(fx={fx:g}, fy={fy:g}, cx={cx:g}, cy={cy:g}, skew={skew:g})",
                   ("from_intrinsics", {"K": k, "pose": world, "near": near, "far": far}))


def _make(method: str, arguments: Dict[str, Any]) -> Camera:
    return getattr(Camera, method)(**arguments)


def _check_planes(near: Optional[float], far: Optional[float]) -> None:
    if far is not None:
        _check.number("far", far, 1e-9, 1e12)
    if near is not None:
        _check.number("near", near, 1e-9, 1e9)
    if near is not None and far is not None and near >= far:
        raise fail("far", f"is {far}", f"more than near, {near}")


def _frustum(scale_x: float, scale_y: float, skew: float, center_x: float, center_y: float, near: Optional[float],
             far: Optional[float]) -> np.ndarray:
    """Returns a projection: x_clip = scale_x x + skew y + center_x w, y_clip = scale_y y + center_y w, w = -z."""
    if near is None:  # clips nothing, and far can still be computed from the matrix
        near = 2.0**-30 * (1.0 if far is None else far)
    if far is None:  # beyond everything, as in far_plane() in src/render/view.cpp
        far = 2.0**33
    a, b = -(far + near) / (far - near), -2.0 * far * near / (far - near)
    return np.array([[scale_x, skew, -center_x, 0.0], [0.0, scale_y, -center_y, 0.0], [0.0, 0.0, a, b], [0.0, 0.0, -1.0, 0.0]])


def _matrices(world: np.ndarray, clip: np.ndarray) -> Any:
    return _core.Camera.from_matrices(np.ascontiguousarray(world), np.ascontiguousarray(clip))


# Rounding the elements of a rotation R to 4 decimals, by at most 5e-5 each, changes an element of R^T R by at most
# 2 * 5e-5 * sqrt(3) = 1.74e-4. A scale of 1.001 changes the diagonal by 2e-3.
_ROUNDED = 2e-4
_EXACT = 1e-12  # of rotations that were computed in double


def _rigid(name: str, matrix: Any) -> np.ndarray:
    """Returns a rotation and a translation of shape (4, 4). Replaces a rotation that was rounded by the nearest exact one."""
    m = _check.numbers(name, matrix, (4, 4))
    if m[3].tolist() != [0.0, 0.0, 0.0, 1.0]:
        raise fail(name, f"has the last row {m[3].tolist()}", "[0, 0, 0, 1]")
    turn = m[:3, :3]
    error = float(np.abs(turn.T @ turn - np.eye(3)).max())
    if not error <= _ROUNDED:
        raise fail(name, "is not a rotation and a translation", "rows and columns of length 1 that are perpendicular, without scale")
    if np.linalg.det(turn) < 0.0:
        raise fail(name, "contains a reflection", "a rotation and a translation")
    if error > _EXACT:
        m = m.copy()
        left, _, right = np.linalg.svd(turn)
        m[:3, :3] = left @ right
    return m


def _inverse(name: str, matrix: Any) -> np.ndarray:
    """Returns the inverse of a rigid transform of shape (4, 4)."""
    m = _rigid(name, matrix)
    out = np.eye(4)
    out[:3, :3] = m[:3, :3].T
    out[:3, 3] = -m[:3, :3].T @ m[:3, 3]
    return out


def _pose(pose: Any, extrinsics: Any) -> np.ndarray:
    """Returns camera to world, OpenGL axes."""
    if (pose is None) == (extrinsics is None):
        raise fail("extrinsics, pose", "both or none are given", "one of them")
    if pose is not None:
        return _rigid("pose", pose)
    try:
        rows = np.shape(extrinsics)
    except ValueError:  # rows of different lengths
        raise fail("extrinsics", "is not an array", "numbers of shape (3, 4) or (4, 4)") from None
    if rows == (3, 4):
        extrinsics = np.vstack([_check.numbers("extrinsics", extrinsics, (3, 4)), [0.0, 0.0, 0.0, 1.0]])
    elif rows != (4, 4):
        raise fail("extrinsics", f"has the shape {rows}", "(3, 4) or (4, 4)")
    return _inverse("extrinsics", extrinsics) @ _TURN
