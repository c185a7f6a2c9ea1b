# SPDX-License-Identifier: Apache-2.0
"""Many pictures, in this process or by an engine that distributes work: Dask, or any concurrent.futures.Executor."""

from __future__ import annotations

import os
import pickle
import re
import sys
import threading
import uuid
import warnings
from collections import OrderedDict
from typing import Any, Callable, Dict, Iterable, List, Optional, Sequence, Tuple, Union

import numpy as np

from . import _check, _core
from ._check import fail
from ._options import is_model_file, pixel_kind
from .camera import Camera
from .picture import Picture
from .scene import Scene, Size

Path = Union[str, "os.PathLike[str]"]
_PLACE = re.compile(r"%%|%0([1-9])d|\{frame\}|\{name\}")


def _file_of(pattern: str, frame: Optional[int], digits: int, name: str) -> str:
    """Returns the name of an output file, with the places that `halfspace render -o` accepts."""

    def replaced(place: "re.Match[str]") -> str:
        if place[0] == "%%":
            return "%"
        if place[0] == "{name}":
            return name
        return place[0] if frame is None else f"{frame:0{place[1] or digits}}"

    return _PLACE.sub(replaced, pattern)


def _save(picture: Picture, path: Optional[str]) -> Union[Picture, str]:
    """Returns the picture, or writes it to the file at path, if one is given, and returns that name."""
    if path is None:
        return picture
    folder = os.path.dirname(path)
    if folder:
        os.makedirs(folder, exist_ok=True)
    picture.save(path)
    return path


class _Frames:
    """The frames of a scene, some of which are rendered by each process. It can be pickled; what it prepares is kept in each process."""

    def __init__(self, scene: Scene, numbers: List[int], size: Size, fps: float, time: float, camera: Union[str, Camera, None], linear: bool,
                 alpha: bool, out: Optional[str]) -> None:
        self._scene, self._numbers, self._size, self._fps, self._time = scene, numbers, size, fps, time
        self._camera, self._linear, self._alpha, self._out = camera, linear, alpha, out
        self._digits = max(4, len(str(max(numbers, default=0))))
        self._key = uuid.uuid4().hex
        self._lock, self._core = threading.Lock(), None

    def __getstate__(self) -> Dict[str, Any]:
        return {key: value for key, value in self.__dict__.items() if key not in ("_lock", "_core")}

    def __setstate__(self, state: Dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._lock, self._core = threading.Lock(), None

    def render(self, positions: Sequence[int]) -> List[Any]:
        """Returns pictures, or the names of their files. positions: which of the frames."""
        core, (width, height) = self._prepared(), self._size
        kind = pixel_kind(self._linear, self._alpha)
        results: List[Any] = []
        for i in positions:
            time = self._time_of(self._numbers[i])
            view = self._scene._camera(self._camera, width, height, time)
            picture = self._scene._picture(core, width, height, time, view, kind, self._alpha)
            results.append(_save(picture, self.file(i)))
        return results

    def file(self, i: int) -> Optional[str]:
        """Returns the name of the file of frame i, if frames are written to files."""
        return None if self._out is None else _file_of(self._out, self._numbers[i], self._digits, "")

    def _time_of(self, number: int) -> float:
        return self._time + number / self._fps

    def _prepared(self) -> Any:
        """Returns a copy of the scene to which all frames were announced, so that the pictures do not depend on the process."""
        with self._lock:
            if self._core is None:
                self._scene._flush()
                core = self._scene._core.copy()
                core.expect([self._time_of(n) for n in self._numbers], *self._size)
                self._core = core
            return self._core


class _Models:
    """Pictures of model files or scenes."""

    def __init__(self, models: List[str], size: Size, view: Dict[str, Any], linear: bool, alpha: bool, out: Optional[str],
                 threads: Optional[int]) -> None:
        self._models, self._size, self._view, self._linear, self._alpha = models, size, view, linear, alpha
        self._out, self._threads = out, threads
        self._key = uuid.uuid4().hex

    def render(self, positions: Sequence[int]) -> List[Any]:
        """Returns pictures, the names of their files, or InputErrors and OutputErrors."""
        return [self._render_one(i) for i in positions]

    def file(self, i: int) -> Optional[str]:
        """Returns the name of the picture of model i, if pictures are written to files."""
        name = os.path.splitext(os.path.basename(self._models[i]))[0]
        return None if self._out is None else _file_of(self._out, None, 4, name)

    def _render_one(self, i: int) -> Any:
        try:
            file = self.file(i)
            if file is not None:
                _core.check_own_image(file)  # it could be a texture of another model
            view = {"aspect": self._size[0] / self._size[1], **self._view}
            scene = Scene.load(self._models[i], threads=self._threads, **view)
            if file is not None:
                scene._core.protect_inputs(file)
            return _save(scene.render(self._size, linear=self._linear, alpha=self._alpha), file)
        except (_core.InputError, _core.OutputError) as e:
            return e


_jobs: "OrderedDict[str, Any]" = OrderedDict()  # the last jobs of this process, with what they have prepared
_jobs_lock = threading.Lock()
_MAX_JOBS = 4


def _clean(job: Any, positions: Sequence[int]) -> None:
    """Removes temporary files of killed processes from the folders of the pictures. A task that runs again after its worker was killed thus
    removes what that worker left behind."""
    files = [job.file(i) for i in positions]
    for folder in {os.path.dirname(file) for file in files if file is not None}:
        _core.remove_abandoned_output(folder)


def _render(job: Any, positions: Sequence[int]) -> List[Any]:
    """Renders part of a job in a worker, which may have received it before."""
    with _jobs_lock:
        job = _jobs.setdefault(job._key, job)
        _jobs.move_to_end(job._key)
        while len(_jobs) > _MAX_JOBS:
            _jobs.popitem(last=False)
    _clean(job, positions)
    return job.render(positions)


def _render_from(file: str, key: str, positions: Sequence[int]) -> List[Any]:
    """The same for a job in a file, which each worker reads once."""
    with _jobs_lock:
        job = _jobs.get(key)
    if job is None:
        with open(file, "rb") as stream:
            job = pickle.load(stream)
    return _render(job, positions)


def _identity(job: Any) -> Any:
    return job


def _submit_by_file(job: Any, client: Any, parts: List[range]) -> List[Any]:
    """Gives a job to processes of this machine in a temporary file, which is removed after the last batch."""
    import tempfile

    handle, file = tempfile.mkstemp(prefix="halfspace-", suffix=".job")
    left = len(parts)
    lock = threading.Lock()

    def ended(_: Any) -> None:
        nonlocal left
        with lock:
            left -= 1
            is_last = left == 0
        if is_last:
            os.unlink(file)

    try:
        with open(handle, "wb") as stream:
            pickle.dump(job, stream)
        futures = [client.submit(_render_from, file, job._key, part) for part in parts]
    except BaseException:
        os.unlink(file)
        raise
    for future in futures:
        future.add_done_callback(ended)
    return futures


def _is_dask(client: Any) -> bool:
    return hasattr(client, "scatter") and hasattr(client, "submit")


def _is_process_pool(client: Any) -> bool:
    module = sys.modules.get("concurrent.futures.process")  # imported if there is such a pool
    return module is not None and isinstance(client, module.ProcessPoolExecutor)


def _slots(client: Any) -> int:
    """Returns how many tasks an engine runs at the same time, or a guess."""
    if _is_dask(client):
        return max(1, sum(client.nthreads().values()))
    return int(getattr(client, "_max_workers", 0) or _core.cores())


def _batches(count: int, batch: Optional[int], slots: int) -> List[range]:
    """Splits 0 … count − 1. By default, each worker gets about 8 batches, so that a slow one does not delay the end by much."""
    size = max(1, -(-count // (8 * slots))) if batch is None else _check.integer("batch", batch, 1, 2**31 - 1)
    return [range(first, min(first + size, count)) for first in range(0, count, size)]


def _submit(job: Any, count: int, client: Any, batch: Optional[int]) -> List[Any]:
    if not hasattr(client, "submit"):
        raise fail("client", f"is of type {type(client).__name__}", "a dask.distributed.Client or a concurrent.futures.Executor")
    parts = _batches(count, batch, _slots(client))
    if _is_dask(client):
        # A task of its own: each worker receives its result once, and Dask can repeat it if all workers that have it die. What scatter()
        # sends would be forgotten after the last frame, and a frame that is lost after that could not be rendered again.
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", "Large object|Sending large graph", UserWarning)
            sent = client.submit(_identity, job, pure=False)
        return [client.submit(_render, sent, part, pure=False) for part in parts]
    if _is_process_pool(client) and parts:
        return _submit_by_file(job, client, parts)
    return [client.submit(_render, job, part) for part in parts]


def _gathered(futures: List[Any], total: int, progress: Optional[Callable[[int, int], Any]]) -> List[Any]:
    results: List[Any] = []
    try:
        for future in futures:
            results += future.result()
            if progress is not None:
                progress(len(results), total)
    finally:
        for future in futures:
            future.cancel()
    return results


def _local(job: Any, count: int, progress: Optional[Callable[[int, int], Any]]) -> List[Any]:
    results: List[Any] = []
    _clean(job, range(count))
    for i in range(count):
        results += job.render([i])
        if progress is not None:
            progress(i + 1, count)
    return results


def _checked_out(out: Optional[Path], place: str) -> Optional[str]:
    if out is None:
        return None
    name = _check.path("out", out)
    places = {match[0] for match in _PLACE.finditer(name)} - {"%%"}
    wanted = {"{name}"} if place == "{name}" else {p for p in places if p != "{name}"}
    if not places or not wanted <= places or (place == "{frame}" and "{name}" in places):
        raise fail("out", f"is {name!r}", f"a file name with {place}" + (" or %04d" if place == "{frame}" else "") + " as the place for "
                   + ("the number of the frame" if place == "{frame}" else "the name of the model"))
    return name


def _frames_job(scene: Union[Scene, Path], frames: Union[int, Iterable[int]], out: Optional[Path], size: Size, fps: float, time: float,
                camera: Union[str, Camera, None], linear: bool, alpha: bool) -> Tuple[_Frames, int]:
    width, height = _check.size(size)
    rate, start = _check.number("fps", fps, 1e-3, 1e6), _check.number("time", time)
    expected = "a number of frames or a sequence of frame numbers"
    if isinstance(frames, (int, np.integer)):
        numbers = list(range(_check.integer("frames", frames, 0, 2**31 - 1)))
    else:
        numbers = [_check.integer("frames", number, 0, 2**31 - 1) for number in _check.items("frames", frames, expected)]
    if isinstance(scene, Scene):
        opened = pickle.loads(pickle.dumps(scene))  # later changes of the scene do not affect the frames
    else:
        name = _check.path("scene", scene)
        view = {"times": [start + n / rate for n in numbers], "aspect": width / height} if is_model_file(name) and numbers else {}
        opened = Scene.load(name, **view)
    job = _Frames(opened, numbers, (width, height), rate, start, camera, bool(linear), bool(alpha), _checked_out(out, "{frame}"))
    return job, len(numbers)


def submit_frames(scene: Union[Scene, Path], frames: Union[int, Iterable[int]], client: Any, *, out: Optional[Path] = None,
                  size: Size = (640, 480), fps: float = 30.0, time: float = 0.0, camera: Union[str, Camera, None] = None,
                  linear: bool = False, alpha: bool = False, batch: Optional[int] = None) -> List[Any]:
    """Gives the frames of render_frames() to `client` and returns its futures, one per batch of frames. Each future yields a list. Use the
    functions of the engine for progress and cancellation, for example dask.distributed.progress(futures)."""
    job, count = _frames_job(scene, frames, out, size, fps, time, camera, linear, alpha)
    return _submit(job, count, client, batch)


def render_frames(scene: Union[Scene, Path], frames: Union[int, Iterable[int]], *, out: Optional[Path] = None, client: Any = None,
                  size: Size = (640, 480), fps: float = 30.0, time: float = 0.0, camera: Union[str, Camera, None] = None,
                  linear: bool = False, alpha: bool = False, batch: Optional[int] = None,
                  progress: Optional[Callable[[int, int], Any]] = None) -> List[Any]:
    """Renders frames of an animation, and returns a list of Pictures or, with `out`, of file names. The pictures are those of Scene.frames(),
    for any client.

    scene: a Scene, of which later changes have no effect, or the name of a shipped scene, a scene file or a model file. The whole model is
        in view at the times of all frames; its first animation plays.
    frames: how many frames, or the frame numbers, for example range(0, 20000, 10).
    out: names of the files: "frames/{frame}.png" or "frames/%05d.png". Missing folders are created, and existing files replaced.
        Workers write the files, so they must share a file system with the reader of the files.
    client: a dask.distributed.Client or a concurrent.futures.Executor, whose workers render. Each worker of Dask and each process of a
        ProcessPoolExecutor receives the scene once, other executors with each batch. The default is this process.
    size, fps, time, camera, linear, alpha: as in Scene.frames(). The threads of each worker are those of the scene: with one process per
        core, use Scene.load(..., threads=1).
    batch: number of frames per task. The default gives each worker about eight tasks.
    progress: called as progress(done, total) in this process. An exception that it raises cancels the remaining tasks.
    """
    _check.callback("progress", progress)
    job, count = _frames_job(scene, frames, out, size, fps, time, camera, linear, alpha)
    if client is None:
        return _local(job, count, progress)
    return _gathered(_submit(job, count, client, batch), count, progress)


def _models_job(models: Iterable[Path], out: Optional[Path], size: Size, linear: bool, alpha: bool, threads: Optional[int],
                view: Dict[str, Any]) -> Tuple[_Models, int]:
    names = [_check.path("models", model) for model in _check.items("models", models, "a sequence of files")]
    pattern = _checked_out(out, "{name}")
    if pattern is not None:
        owners: Dict[str, str] = {}
        for name in names:
            file = _file_of(pattern, None, 4, os.path.splitext(os.path.basename(name))[0])
            if owners.setdefault(file, name) != name:
                raise fail("models", f"has '{owners[file]}' and '{name}', which have the same output file, {file}", "different names")
    count = None if threads is None else _check.threads(threads, _core.cores())
    return _Models(names, _check.size(size), view, bool(linear), bool(alpha), pattern, count), len(names)


def submit_models(models: Iterable[Path], client: Any, *, out: Optional[Path] = None, size: Size = (640, 480), linear: bool = False,
                  alpha: bool = False, threads: Optional[int] = None, batch: Optional[int] = None, **view: Any) -> List[Any]:
    """Gives the models of render_models() to `client` and returns its futures, one per batch of models. Each future yields a list, in which
    a model that cannot be rendered is its InputError or OutputError. Use the functions of the engine for progress and cancellation."""
    job, count = _models_job(models, out, size, linear, alpha, threads, view)
    return _submit(job, count, client, batch)


def render_models(models: Iterable[Path], *, out: Optional[Path] = None, client: Any = None, size: Size = (640, 480), linear: bool = False,
                  alpha: bool = False, threads: Optional[int] = None, batch: Optional[int] = None, errors: str = "raise",
                  progress: Optional[Callable[[int, int], Any]] = None, **view: Any) -> List[Any]:
    """Renders one picture of each model file or scene, and returns a list of Pictures or, with `out`, of file names.

    models: the files.   out: names of the pictures: "thumbnails/{name}.png". A file that is not a picture of Halfspace, or that the model
        reads, is not replaced; that is an OutputError of the model.   client, batch, progress: as in render_frames().
    threads: of each model. The default is one per core; with a client that runs several tasks per machine, use 1.
    errors: "raise" raises the first InputError or OutputError after all other models are rendered; "return" puts each error into the list.
    view: arguments of Scene.load() such as yaw and background.
    """
    _check.callback("progress", progress)
    _check.choice("errors", errors, ("raise", "return"))
    job, count = _models_job(models, out, size, linear, alpha, threads, view)
    results = _local(job, count, progress) if client is None else _gathered(_submit(job, count, client, batch), count, progress)
    for result in results:
        if errors == "raise" and isinstance(result, Exception):
            raise result
    return results
