# SPDX-License-Identifier: Apache-2.0
"""Scenes and their pictures."""

from __future__ import annotations

import json
import os
import threading
from typing import Any, Callable, Dict, Iterable, Iterator, List, Mapping, Optional, Tuple, Union

import numpy as np

from . import _check, _core
from ._check import fail
from ._contents import Contents
from ._options import LIGHTING, check_names, emit, is_model_file, pixel_kind, setting_text, times_of, view_options
from .camera import Camera
from .labels import LABELS, checked_background, checked_outputs, finished, images_of
from .mesh import Mesh
from .model import Model
from .picture import Picture

Size = Tuple[int, int]
_MAX_COPIES = 65536
_MIN_SPAN, _MAX_SPAN = 1e-9, 1e9  # units that a fitted view can show; also the limits of the near plane


def _check_name(name: Any) -> None:
    """Raises InputError if this is not a valid name for an object of a scene file."""
    _check.string("name", name)
    _core.Scene.parse(json.dumps({"version": 1, "objects": {name: {}}}), "scene", 1)


def _fits(span: float) -> bool:
    """Returns whether a view can be fitted to objects that span this many units. 0: a single point."""
    return span == 0.0 or _MIN_SPAN <= span <= _MAX_SPAN


def _world_span(mesh: Union[Mesh, Model], places: np.ndarray) -> float:
    """Returns the diagonal of the bounds of all copies of a mesh, in world space."""
    x, y, z = mesh.bounds.T
    corners = np.array([(a, b, c, 1.0) for a in x for b in y for c in z])
    points = places[:, :3] @ corners.T
    return float(np.linalg.norm(points.max(axis=(0, 2)) - points.min(axis=(0, 2))))


class Scene(Contents):
    """A scene that can be changed and rendered. Textures, meshes and maps are cached from one picture to the next.

    Scene() starts an empty scene, for add() and add_light(). Scene.load() opens a scene or a model file.

    lighting: "studio" (the environment, key light, exposure and tone curve that are used for model files; the tone curve also applies to
        background.color, so that white arrives as 215) or "none" (black background, no light, no tone curve: colors are clamped to [0, 1]).
    threads: number of threads; the default is one per core. The pictures do not depend on it.

    A scene is a mapping of its keys: scene["samples"], "ball" in scene, list(scene) and dict(scene) work.

    All methods can be called by several Python threads at once. Pictures and labels do not share memory with the scene. A scene can be
    pickled, with its meshes and textures; the files to which it refers must exist where it is used.
    """

    def __init__(self, *, lighting: str = "studio", threads: Optional[int] = None) -> None:
        text = json.dumps(LIGHTING[_check.choice("lighting", lighting, tuple(LIGHTING))])
        self._start(_core.Scene.parse(text, "scene", _check.threads(threads, _core.cores())))
        self._fits = True

    def _start(self, core: Any) -> None:
        self._core = core
        self._lock = threading.RLock()  # guards the following members
        self._pending: Dict[str, Any] = {}  # objects that are not yet in the scene of _core, which reads all of its objects for each change
        self._meshes: Dict[str, Tuple[Union[Mesh, Model], np.ndarray]] = {}
        self._names = 0
        self._fits = False  # no camera has been given: all objects are shown
        self.camera: Union[str, Camera, None] = None  #: used if render() is called without a camera

    @classmethod
    def load(cls, path: Union[str, "os.PathLike[str]"], *, threads: Optional[int] = None, **view: Any) -> "Scene":
        """Opens a shipped scene by name, a scene file, or a model file (.obj, .gltf, .glb, .ply, .stl).

        A model file is shown as `halfspace render MODEL` shows it. The following arguments change the view; None means the default.

        aspect: width / height of the pictures, to which the view of the model is fitted. The default is 16/9.
        yaw, pitch: position of the eye around the model in degrees, from the front (+z) to the right, and upwards.
        zoom: factor by which the eye is nearer.   fov: vertical field of view in degrees, 1 to 170.
        eye, look_at, up: position of the eye, point at the center of the picture, and direction that points up, in world space: (x, y, z).
        inside: whether the eye is inside the model.   floor: whether there is a shadow on a floor below the model.
        environment: image file of a panorama that lights the model.
        background: "#rrggbb", three linear numbers from 0 to 1, "environment" or "transparent". Colors are those before exposure and tone
            mapping: "#ffffff" arrives as 215 in the picture. For exact white, render with alpha=True and blend the picture with white.
        model_scene, animation, variant: scene, animation and material variant of the file: names, or indices from 0. `animation` and
            `variant` can also be called model_animation and model_variant, like the keys of an object.
        times: times in seconds at which the whole model is in view. The default is time 0.
        up_axis: "y" or "z".   turn_seconds: time in which the camera moves around the model once. 0: it does not move.
        allow_outside: whether models may refer to files outside their folders. Also applies to scene files.

        An animated model moves if `animation` or `times` is given. With `times` alone, the first animation of the file plays. For frames
        that are the same as those of `halfspace render MODEL --frames`, pass the times of all frames.

        Raises InputError if the file or an argument cannot be used, and TypeError for an unknown argument.
        """
        check_names(view, ("threads",))
        name = _check.path("path", path)
        scene = cls.__new__(cls)
        options = view_options(name, view)
        color = options.pop("background") if isinstance(options.get("background"), tuple) else None
        scene._start(_core.Scene.open(name, options, _check.threads(threads, _core.cores())))
        if color is not None:
            scene.set({"background.color": color})
        if options.get("allow_outside") and not is_model_file(name):
            files = [object for object in scene.objects if scene[f"objects.{object}.shape"] == "file"]
            scene.set({f"objects.{object}.allow_outside": True for object in files})
        return scene

    # ---- keys ----------------------------------------------------------------------------------------------------

    def set(self, keys: Mapping[str, Any]) -> None:
        """Sets keys of the scene, for example {"time.hours": 18, "moon.radius": 2}, like --set on the command line.

        Raises InputError and leaves the scene unchanged if a key or a value is invalid.
        """
        settings = [setting_text(key, value) for key, value in _check.mapping("keys", keys, "a dictionary of keys and values").items()]
        self._flush()
        self._core.set(settings)
        self._fits = self._fits and not any(key.split(".")[0] in ("camera", "cameras", "main") for key in keys)

    def __setitem__(self, key: str, value: Any) -> None:
        self.set({key: value})

    def merge(self, patch: Mapping[str, Any]) -> None:
        """Applies a JSON merge patch (RFC 7386) to the scene file, for example {"objects": {"ball": {"shape": "sphere"}}}. Values may be
        NumPy numbers and arrays."""
        text = json.dumps(_check.plain("", _check.mapping("patch", patch, "a dictionary")))
        self._flush()
        self._core.merge(text)
        self._fits = self._fits and not ("camera" in patch or "cameras" in patch)

    def text(self) -> str:
        """Returns the whole scene as the text of a scene file. It can be loaded again unless add() was used."""
        self._flush()
        return self._core.print()

    def export(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the scene at time 0 as a model file (.glb, .gltf, .obj, .ply, .stl), with the meshes, materials, cameras and lights that
        the format can store. Other data is omitted with a RenderWarning.

        Raises OutputError if the file cannot be written, or is one from which the scene was made.
        """
        out = _check.model_output("path", path)
        self._flush()
        try:
            self._core.export_to(out)
        finally:
            emit(self._core)

    # ---- objects and lights --------------------------------------------------------------------------------------

    def add(self, mesh: Any, transform: Any = None, *, name: Optional[str] = None, casts_shadow: bool = True,
            receives_shadow: bool = True) -> str:
        """Adds an object and returns its name.

        mesh: a Mesh, a Model, or an object like trimesh.Trimesh.
        transform: affine matrix from object to world space, of shape (4, 4), or (N, 4, 4) for N copies. The default is the identity.
        name: any text without "=", "," and control characters that neither begins with "#" nor begins or ends with a space. It must differ
            from the names of other objects and of sections. By default, a name is generated.

        The name is a section of the scene: scene[name + ".visible"] = False hides the object, also if the name contains spaces or dots. Object ids in labels number the objects in
        the order in which they were added.
        """
        if not isinstance(mesh, (Mesh, Model)):
            mesh = Mesh.from_trimesh(mesh)
        if mesh.bounds is None:
            raise fail("mesh", "has no vertices", "a model with at least one mesh")
        places = np.eye(4)[np.newaxis] if transform is None else self._transforms(transform)
        with self._lock:
            if name is None:
                name = self._new_name("object", self._has_object)
            else:
                _check_name(name)
                if self._has_object(name):
                    raise fail("name", f"an object '{name}' exists", "another name")
            self._pending[name] = {"shape": "file", "file": mesh._file, "casts_shadow": bool(casts_shadow),
                                   "receives_shadow": bool(receives_shadow)}
            self._core.provide(mesh._file, mesh._model)
            self._core.place(name, places)
            self._meshes[name] = (mesh, places)
        return name

    def place(self, name: str, transform: Any) -> None:
        """Moves an object that was added with add(). transform: from object to world space, of shape (4, 4) or (N, 4, 4)."""
        places = self._transforms(transform)
        with self._lock:
            mesh, _ = self._mesh(name)
            self._core.place(name, places)
            self._meshes[name] = (mesh, places)

    def remove(self, name: str) -> None:
        """Removes an object: one that was added with add() or one of the scene file."""
        with self._lock:
            self._flush()
            if not self._core.has_object(_check.string("name", name)):
                known = "one of " + ", ".join(self.objects) if self.objects else "add() first"
                raise fail("name", f"no object '{name}' in this scene", "remove_light() for a light" if name in self.lights else known)
            self._core.merge(json.dumps({"objects": {name: None}}))
            if name in self._meshes:
                self._forget(name)

    def add_light(self, type: str = "directional", *, name: Optional[str] = None, **keys: Any) -> str:
        """Adds a light and returns its name.

        type: "directional" (direction: towards the light), "point" (position) or "spot" (position, direction, inner, outer in degrees).
        name: as for add().
        keys: keys of a light in a scene file, for example color=(1, 0.9, 0.8), intensity=2, shadow=False, falloff="physical". Colors are
            linear, or "#rrggbb".

        `lights` lists all lights, and remove_light() removes one.
        """
        if name is None:
            with self._lock:
                name = self._new_name("light", self.lights.__contains__)
        elif _check.string("name", name) in self.lights:
            raise fail("name", f"a light '{name}' exists", "another name")
        light = _check.plain("", {"type": type, **keys})
        self._flush()
        self._core.merge(json.dumps({"lights": {name: light}}))
        return name

    @property
    def bounds(self) -> Optional[np.ndarray]:
        """The minimum and maximum coordinates of all visible objects at time 0, in world space: float64 of shape (2, 3). None if there are
        no such objects. Each object contributes the axis-aligned box around its transformed bounding box. Objects that show only shadows,
        such as the floor of a model file, do not count."""
        self._flush()
        return self._core.bounds()

    def fit(self, *, yaw: float = 35.0, pitch: float = 18.0, fov: float = 35.0, aspect: float = 1.0) -> Camera:
        """Returns a camera that shows all visible objects. Together, they must span 1e-9 to 1e9 units.

        yaw, pitch: position of the eye around the objects in degrees, from the front (+z) to the right, and upwards.
        fov: vertical field of view in degrees.
        aspect: width / height of the picture. Values above 1 have no further effect.
        """
        box = self.bounds
        if box is None:
            raise fail("fit", "the scene has no visible object", "at least one")
        self._check_span(float(np.linalg.norm(box[1] - box[0])))
        center, radius = box.mean(axis=0), float(np.linalg.norm(box[1] - box[0])) / 2.0 or 1.0
        yaw, pitch = np.radians(_check.number("yaw", yaw)), np.radians(_check.number("pitch", pitch, -89.0, 89.0))
        towards = np.array([np.sin(yaw) * np.cos(pitch), np.sin(pitch), np.cos(yaw) * np.cos(pitch)])
        tan_y = np.tan(np.radians(_check.number("fov", fov, 1.0, 170.0)) / 2.0)
        narrow = np.arctan(tan_y * min(1.0, _check.number("aspect", aspect, 1e-5, 1e5)))  # half of the smaller angle of view
        distance = radius / float(np.sin(narrow))
        near = min(max(1e-3 * radius, 0.5 * (distance - 1.5 * radius), _MIN_SPAN), _MAX_SPAN)
        return Camera.look_at(center + towards * distance, center, fov=fov, near=near, far=distance + 20.0 * radius)

    def view(self, camera: Union[str, Camera, None] = None, *, size: Size = (640, 480), time: float = 0.0) -> Camera:
        """Returns the camera that render() uses for the same arguments, for example to read its pose and intrinsics."""
        width, height = _check.size(size)
        self._flush()
        chosen = self._chosen(camera, width, height)
        if isinstance(chosen, Camera):
            return chosen
        return Camera.look_at(**self._core.camera(chosen or "", _check.number("time", time)).look_at_arguments())

    # ---- pictures ------------------------------------------------------------------------------------------------

    def render(self, size: Size = (640, 480), *, camera: Union[str, Camera, None] = None, time: float = 0.0, linear: bool = False,
               alpha: bool = False) -> Picture:
        """Renders a picture.

        size: (width, height) in pixels, each 1 to 16384.
        camera: a Camera, or the name of a camera of the scene or the model. The default is the member `camera` or, if that is None, the
            camera of the scene. If there is no camera, a scene created with Scene() is shown as a whole.
        time: time in the scene's animations, in seconds.
        alpha: omit the background. Alpha is straight, and 0 where nothing is drawn.
        Returns 8-bit sRGB values: uint8 of shape (height, width, 3), or (height, width, 4) with alpha=True. With linear=True, returns
        linear values before exposure and tone mapping: float32 of shape (height, width, 4).
        """
        width, height = _check.size(size)
        self._flush()
        time = _check.number("time", time)
        view = self._camera(camera, width, height, time)
        return self._picture(self._core, width, height, time, view, pixel_kind(linear, alpha), alpha)

    def frames(self, frames: Union[int, Iterable[int]], *, size: Size = (640, 480), fps: float = 30.0, time: float = 0.0,
               camera: Union[str, Camera, None] = None, linear: bool = False, alpha: bool = False) -> Iterator[Picture]:
        """Returns an iterator over frames of an animation. Frames are rendered one at a time, as `halfspace render --frames` renders them.

        frames: how many frames, or the frame numbers, for example range(24, 48).   fps: frames per second.
        time: time of frame 0 in seconds. Frame i shows the time `time` + i / fps.
        Later changes of the scene do not affect the frames.
        """
        width, height = _check.size(size)
        start, rate = _check.number("time", time), _check.number("fps", fps, 1e-3, 1e6)
        expected = "a number of frames or a sequence of frame numbers"
        if isinstance(frames, (int, np.integer)):
            numbers = list(range(_check.integer("frames", frames, 0, 2**31 - 1)))
        else:
            numbers = _check.items("frames", frames, expected)
            if not all(isinstance(i, (int, np.integer)) for i in numbers):
                raise fail("frames", f"is {frames!r}", expected)
        times = [start + int(i) / rate for i in numbers]
        self._flush()
        core, kind = self._core.copy(), pixel_kind(linear, alpha)
        views = [self._camera(camera, width, height, t) for t in times]
        if times:
            core.expect(times, width, height)
        return (self._picture(core, width, height, t, view, kind, alpha) for t, view in zip(times, views))

    def render_batch(self, cameras: Iterable[Union[str, Camera, None]], *, size: Size = (640, 480), time: Union[float, Iterable[float]] = 0.0,
                     linear: bool = False, alpha: bool = False, progress: Optional[Callable[[int, int], Any]] = None) -> Picture:
        """Renders one picture per camera. Several pictures are rendered at the same time, each by one thread.

        time: time in seconds for all pictures, or one time per camera.
        progress: called as progress(done, total) after each picture, from any thread. An exception that it raises ends the batch.
        Returns an array of shape (N, height, width, C): for each camera, the picture that render() returns. Each can be passed to save().
        """
        width, height = _check.size(size)
        cameras = _check.items("cameras", cameras, "a sequence of cameras")
        times = times_of(time, cameras)
        _check.callback("progress", progress)
        self._flush()
        views = [self._camera(camera, width, height, t) for camera, t in zip(cameras, times)]
        try:
            return self._core.render_batch(width, height, times, views, pixel_kind(linear, alpha), bool(alpha), progress).view(Picture)
        finally:
            emit(self._core)

    # ---- labels --------------------------------------------------------------------------------------------------

    def labels(self, outputs: Iterable[str] = LABELS, *, size: Size = (640, 480), camera: Union[str, Camera, None] = None, time: float = 0.0,
               background_depth: float = float("inf"), alpha: bool = False) -> Dict[str, np.ndarray]:
        """Renders a picture and per-pixel values. Returns a dictionary with an array for each name in `outputs`.

        "color"          uint8 (H, W, 3), or (H, W, 4) with alpha=True: the picture that render() returns
        "depth"          float32 (H, W), along the view axis, in scene units; background_depth where there is no surface
        "distance"       float32 (H, W), from the eye along the ray of the pixel; background_depth where there is no surface
        "normal"         float32 (H, W, 3), unit length, in world space; for two-sided surfaces, that of the visible side
        "camera_normal"  float32 (H, W, 3), the same in camera space: x right, y up, z towards the eye
        "albedo"         float32 (H, W, 3), linear color before lighting
        "position"       float32 (H, W, 3), in world space
        "uv"             float32 (H, W, 2), texture coordinates with v = 0 at the top row of the texture
        "object"         uint32 (H, W), index in `objects`; NO_ID where there is no surface
        "instance"       uint32 (H, W), index of the copy of the object; NO_ID where there is no surface
        "triangle"       uint32 (H, W), index of the face; NO_ID where there is no surface
        "barycentrics"   float32 (H, W, 3), weights of the face's vertices, in order
        "mask"           bool (H, W), whether there is a surface

        Values are those of the surface at the center of the pixel, without antialiasing. Where there is no surface, they are 0 unless
        stated otherwise. Blended surfaces are omitted. With background_depth=0, "depth" is the same as in pyrender. Color is rendered in one
        pass, with the samples and shaders of the scene, and all other labels together in a second pass, with one sample per pixel. Without
        "color", there is only the second pass, and no shadow maps are rendered.
        """
        width, height = _check.size(size)
        names, depth = checked_outputs(outputs), checked_background(background_depth)
        self._flush()
        time = _check.number("time", time)
        view = self._camera(camera, width, height, time)
        try:
            return finished(_core.labels(self._core, width, height, time, view, images_of(names), depth, bool(alpha)),
                            names)
        finally:
            emit(self._core)

    def label_batch(self, cameras: Iterable[Union[str, Camera, None]], outputs: Iterable[str] = LABELS, *, size: Size = (640, 480),
                    time: Union[float, Iterable[float]] = 0.0, background_depth: float = float("inf"), alpha: bool = False,
                    progress: Optional[Callable[[int, int], Any]] = None) -> Dict[str, np.ndarray]:
        """Renders the labels of one frame per camera, several at a time. The arrays have the shapes that labels() returns, with an
        additional first axis of length N.

        time, progress: as in render_batch().
        """
        width, height = _check.size(size)
        names, depth = checked_outputs(outputs), checked_background(background_depth)
        cameras = _check.items("cameras", cameras, "a sequence of cameras")
        times = times_of(time, cameras)
        _check.callback("progress", progress)
        self._flush()
        views = [self._camera(camera, width, height, t) for camera, t in zip(cameras, times)]
        try:
            return finished(_core.label_batch(self._core, width, height, times, views, images_of(names), depth, bool(alpha), progress),
                            names)
        finally:
            emit(self._core)

    def __reduce__(self) -> Any:
        """For pickling: the text of the scene, and everything that add() and place() added to it."""
        with self._lock:
            self._flush()
            members = {"meshes": dict(self._meshes), "names": self._names, "fits": self._fits, "camera": self.camera,
                       "camera_names": self._core.camera_names, "threads": self._core.threads}
            return _restored, (type(self), self._core.print(), members)

    def __repr__(self) -> str:
        names = self.objects
        shown = ", ".join(names[:4]) + (", ..." if len(names) > 4 else "")
        return f"Scene({len(names)} object{'' if len(names) == 1 else 's'}{': ' if names else ''}{shown})"

    def _repr_png_(self) -> Optional[bytes]:
        return self.render((640, 360))._repr_png_()

    # ---- private -------------------------------------------------------------------------------------------------

    def _picture(self, core: Any, width: int, height: int, time: float, view: Any, kind: Any, alpha: bool) -> Picture:
        try:
            return core.render(width, height, time, view, kind, bool(alpha)).view(Picture)
        finally:
            emit(core)

    def _chosen(self, camera: Union[str, Camera, None], width: int, height: int) -> Union[str, Camera, None]:
        """Returns the camera of a picture. None: the camera that the scene selects."""
        camera = camera if camera is not None else self.camera
        if camera is None and self._fits and self.bounds is not None:
            return self.fit(aspect=width / height)
        if camera is not None and not isinstance(camera, (str, Camera)):
            raise fail("camera", f"is of type {type(camera).__name__}", "a halfspace.Camera, the name of a camera or None")
        if camera == "":
            raise fail("camera", "is empty", "the name of a camera: one of " + ", ".join(self.cameras))
        return camera

    def _camera(self, camera: Union[str, Camera, None], width: int, height: int, time: float) -> Any:
        chosen = self._chosen(camera, width, height)
        if chosen is None:
            return None
        return self._core.camera(chosen, time) if isinstance(chosen, str) else chosen._for_size(width, height)

    def _flush(self) -> None:
        """Adds the objects pending from add() to the scene. Other threads wait until this is done.

        Raises InputError if the scene rejects an object, which is then dropped. The next call adds the objects after the rejected one.
        """
        with self._lock:
            if self._pending:
                self._add_pending(list(self._pending))

    def _add_pending(self, names: List[str]) -> None:
        try:
            self._core.merge(json.dumps({"objects": {name: self._pending[name] for name in names}}))
        except _core.InputError:
            if len(names) == 1:
                del self._pending[names[0]]
                self._forget(names[0])
                raise
            self._add_pending(names[: len(names) // 2])
            self._add_pending(names[len(names) // 2:])
            return
        for name in names:
            del self._pending[name]

    def _forget(self, name: str) -> None:
        """Forgets an object that is not in the scene, and its mesh if no other object uses it."""
        mesh, _ = self._meshes.pop(name)
        self._core.forget_object(name)
        if all(other is not mesh for other, _ in self._meshes.values()):
            self._core.forget_model(mesh._file)

    def _has_object(self, name: str) -> bool:
        return name in self._meshes or self._core.has_object(name)

    def _new_name(self, kind: str, exists: Callable[[str], bool]) -> str:
        while True:
            self._names += 1
            name = f"{kind}_{self._names}"
            if not exists(name):
                return name

    def _mesh(self, name: str) -> Tuple[Union[Mesh, Model], np.ndarray]:
        if _check.string("name", name) not in self._meshes:
            raise fail("name", f"no object '{name}' has been added", "one of " + ", ".join(self._meshes) if self._meshes else "add() first")
        return self._meshes[name]

    def _check_span(self, span: float) -> None:
        """Raises InputError if a view cannot be fitted to a scene that spans this many units. Names the largest mesh if it is the cause."""
        if _fits(span):
            return
        with self._lock:
            spans = {name: _world_span(mesh, places) for name, (mesh, places) in self._meshes.items() if len(places) > 0}
        name = max(spans, key=lambda name: spans[name]) if spans else ""
        if name and not _fits(spans[name]):
            place, span = f"mesh '{name}'", spans[name]
        else:
            place = "scene"
        raise fail(place, f"spans {span:.3g} units in world space",
                   f"{_MIN_SPAN:g} to {_MAX_SPAN:g}; scale it with a transform, or pass a camera")

    @staticmethod
    def _transforms(transform: Any) -> np.ndarray:
        places = _check.transforms("transform", transform).copy()
        if len(places) > _MAX_COPIES:
            raise fail("transform", f"has {len(places)} copies", f"at most {_MAX_COPIES}")
        return places


def _restored(kind: Any, text: str, members: Dict[str, Any]) -> Scene:
    """Returns the scene that was pickled."""
    content = json.loads(text)
    for name, (mesh, _) in members["meshes"].items():
        content["objects"][name]["file"] = mesh._file
    scene = kind.__new__(kind)
    scene._start(_core.Scene.parse(json.dumps(content), "scene", members["threads"], members["camera_names"]))
    for name, (mesh, places) in members["meshes"].items():
        scene._core.provide(mesh._file, mesh._model)
        scene._core.place(name, places)
    scene._meshes, scene._names, scene._fits, scene.camera = members["meshes"], members["names"], members["fits"], members["camera"]
    return scene
