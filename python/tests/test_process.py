# SPDX-License-Identifier: Apache-2.0
"""Lifetimes, threads, processes, memory use and import time."""

import ctypes
import gc
import multiprocessing
import os
import re
import shutil
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import halfspace
from conftest import QUAD, sphere

SMALL = (64, 48)


def ball_scene(threads=None):
    vertices, faces, normals, uvs = sphere(12, 24)
    scene = halfspace.Scene(threads=threads)
    texels = np.random.default_rng(2).integers(0, 255, (16, 16, 3), np.uint8)
    scene.add(halfspace.Mesh(vertices, faces, normals=normals, uvs=uvs, material=halfspace.Material(base_color_texture=texels)))
    return scene


def test_pictures_outlive_their_scene():
    scene = ball_scene()
    kept = [scene.render(SMALL), scene.render(SMALL, linear=True), scene.render(SMALL, alpha=True), scene.render_batch([None] * 2, size=SMALL)]
    copies = [picture.copy() for picture in kept]
    frames = scene.frames(2, size=SMALL)
    del scene
    gc.collect()
    [np.full((500, 500, 4), 7.0, np.float32) for _ in range(20)]
    assert all(np.array_equal(a, b) for a, b in zip(kept, copies))
    assert np.array_equal(next(frames), copies[0])


def test_scenes_outlive_their_arrays():
    vertices, faces, normals, uvs = (np.array(a) for a in sphere(12, 24))
    texels, place = np.full((4, 4, 4), 200, np.uint8), np.eye(4)
    mesh = halfspace.Mesh(vertices, faces, normals=normals, uvs=uvs, material=halfspace.Material(base_color_texture=texels))
    scene = halfspace.Scene()
    scene.add(mesh, place)
    before = scene.render(SMALL)
    for array in (vertices, normals, uvs, place):
        array[:] = 5
    texels[:], faces[:] = 9, 0
    del vertices, faces, normals, uvs, texels, mesh, place
    gc.collect()
    assert np.array_equal(scene.render(SMALL), before)


def test_eight_threads_render_their_own_scenes():
    expected = ball_scene().render(SMALL)
    with ThreadPoolExecutor(8) as pool:
        pictures = list(pool.map(lambda i: ball_scene(threads=1 + i % 3).render(SMALL), range(24)))
    assert all(np.array_equal(picture, expected) for picture in pictures)


def test_eight_threads_render_the_same_scene():
    scene = ball_scene(threads=2)
    cameras = [halfspace.Camera.look_at((4 * np.sin(a), 1, 4 * np.cos(a))) for a in range(8)]
    expected = [scene.render(SMALL, camera=camera) for camera in cameras]

    def work(i):
        for _ in range(5):
            picture = scene.render(SMALL, camera=cameras[i])
            batch = scene.render_batch([cameras[i]] * 2, size=SMALL)
            scene[f"object_1.casts_shadow"]
            if not (np.array_equal(picture, expected[i]) and np.array_equal(batch[1], expected[i])):
                return False
        return True

    with ThreadPoolExecutor(8) as pool:
        assert all(pool.map(work, range(8)))


def test_threads_that_start_together_see_all_objects():
    expected = ball_scene().render(SMALL)
    for _ in range(10):
        scene = ball_scene(threads=1)  # its object is added by the first picture
        with ThreadPoolExecutor(8) as pool:
            assert all(np.array_equal(picture, expected) for picture in pool.map(lambda i: scene.render(SMALL), range(8)))


def test_other_threads_run_while_a_picture_is_rendered():
    scene, stop, ticks = halfspace.Scene.load("moon", threads=1), threading.Event(), []

    def tick():
        while not stop.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    scene.render((16, 16))
    thread = threading.Thread(target=tick)
    thread.start()
    start = time.perf_counter()
    scene.render((1920, 1080))
    end = time.perf_counter()
    stop.set()
    thread.join()
    assert sum(start < t < end for t in ticks) >= 3


def in_process(connection):
    connection.send_bytes(ball_scene(threads=2).render(SMALL).tobytes())
    connection.close()


def batch_in_process(connection):
    scene, done = ball_scene(threads=2), threading.Event()

    def render():
        while not done.is_set():
            scene.render(SMALL)

    other = threading.Thread(target=render)
    other.start()
    batch = scene.render_batch([None] * 60, size=SMALL, progress=lambda done, total: scene["samples"])
    done.set()
    other.join()
    connection.send_bytes(batch[59].tobytes())
    connection.close()


def test_a_batch_and_a_picture_do_not_wait_for_each_other():
    context = multiprocessing.get_context("spawn")
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=batch_in_process, args=(sender,))
    process.start()
    try:
        assert receiver.poll(60), "the process does not answer"
        assert receiver.recv_bytes() == ball_scene(threads=2).render(SMALL).tobytes()
        process.join(60)
        assert process.exitcode == 0
    finally:
        process.kill()


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_other_processes_render(method):
    expected = ball_scene(threads=2).render(SMALL)
    context = multiprocessing.get_context(method)
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=in_process, args=(sender,))
    process.start()
    assert receiver.poll(60), "the process does not answer"
    assert receiver.recv_bytes() == expected.tobytes()
    process.join(60)
    assert process.exitcode == 0


def test_a_scene_of_the_parent_renders_in_a_fork():
    scene = ball_scene(threads=2)
    expected = scene.render(SMALL)
    pid = os.fork()
    if pid == 0:
        try:
            same = np.array_equal(scene.render(SMALL), expected) and np.array_equal(scene.render_batch([None] * 4, size=SMALL)[3], expected)
            os._exit(0 if same else 1)
        finally:
            os._exit(2)
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        done, status = os.waitpid(pid, os.WNOHANG)
        if done:
            assert os.waitstatus_to_exitcode(status) == 0
            return
        time.sleep(0.01)
    os.kill(pid, 9)
    os.waitpid(pid, 0)
    pytest.fail("the child hangs")


def resident_bytes():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def test_thousands_of_frames_leak_nothing():
    scene = halfspace.Scene(lighting="none", threads=1)
    name = scene.add(halfspace.Mesh(*QUAD, material=halfspace.Material(unlit=True)))
    place = np.eye(4)

    def render(count):
        for i in range(count):
            place[0, 3] = i % 7
            scene.place(name, place)
            scene.render((32, 32), linear=i % 2 == 0)

    render(500)
    gc.collect()
    before = resident_bytes()
    render(2500)
    gc.collect()
    assert resident_bytes() - before < 4 << 20  # if the pictures were not freed, they would need more than 10 MB


def test_meshes_that_are_removed_leak_nothing():
    vertices, faces, _, _ = sphere(32, 64)
    scene = halfspace.Scene(lighting="none", threads=1)

    def render(count):
        for _ in range(count):
            name = scene.add(halfspace.Mesh(vertices, faces, material=halfspace.Material(unlit=True)))
            scene.render((16, 16))
            scene.remove(name)

    render(20)
    gc.collect()
    before = resident_bytes()
    render(200)
    gc.collect()
    assert resident_bytes() - before < 8 << 20  # 200 meshes need 30 MB


def test_the_rounding_mode_of_the_process_has_no_effect():
    """Uses the values of <fenv.h> on x86-64."""
    libm = ctypes.CDLL("libm.so.6")
    scene = ball_scene()
    scene.camera = scene.fit()  # NumPy computes cameras in the mode of the process
    expected = [halfspace.render("moon", size=(64, 36)), scene.render((64, 48)), *scene.labels(size=(64, 48)).values()]
    for mode in (0x400, 0x800, 0xC00):  # FE_DOWNWARD, FE_UPWARD, FE_TOWARDZERO
        libm.fesetround(mode)
        try:
            actual = [halfspace.render("moon", size=(64, 36)), scene.render((64, 48)), *scene.labels(size=(64, 48)).values()]
            after = libm.fegetround()
        finally:
            libm.fesetround(0)
        assert after == mode
        for a, b in zip(expected, actual):
            np.testing.assert_array_equal(a, b)


def test_import_loads_no_large_modules():
    """Importing takes about 50 ms more than importing NumPy. Modules that only some functions need are loaded on demand."""
    code = "import sys, numpy; before = set(sys.modules); import halfspace; print(*set(sys.modules) - before)"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert {name.split(".")[0] for name in loaded} - set(sys.stdlib_module_names) == {"halfspace"}
    for large in ("asyncio", "concurrent.futures", "json", "multiprocessing", "subprocess"):
        assert large not in loaded


def import_on(processor):
    """Imports the module on an emulated processor. Its /proc/cpuinfo is that of this machine."""
    code = "import halfspace; print(halfspace._core.lanes)"
    result = subprocess.run(["qemu-x86_64", "-cpu", processor, sys.executable, "-c", code], capture_output=True, text=True)
    return result.returncode, result.stdout, [line for line in result.stderr.splitlines() if "TCG doesn't support" not in line]


@pytest.mark.skipif(not shutil.which("qemu-x86_64"), reason="qemu-x86_64 (package qemu-user) is absent")
def test_the_processor_is_checked_before_code_for_it_is_loaded():
    code, out, error = import_on("Nehalem")
    if (code, out) != (0, "4\n"):  # a build for x86-64-v2
        assert code == 1 and out == ""
        assert re.fullmatch("ImportError: halfspace: this build needs .*AVX2.*, which this processor does not support; .*", error[-1])
    code, out, error = import_on("max")  # AVX2 without AVX-512
    if halfspace._core.lanes == 16:
        assert code == 1 and "AVX-512 (F, BW, DQ, VL" in error[-1]
    else:
        assert (code, out, error) == (0, f"{halfspace._core.lanes}\n", [])


def test_a_missing_library_is_reported_in_one_line(tmp_path):
    source = os.path.dirname(halfspace.__file__)
    package = tmp_path / "halfspace"
    package.mkdir()
    for name in os.listdir(source):
        if name.endswith((".py", ".so")) and not name.startswith("_library"):
            (package / name).symlink_to(os.path.realpath(os.path.join(source, name)))
    result = subprocess.run([sys.executable, "-c", "import halfspace"], capture_output=True, text=True, env={**os.environ, "PYTHONPATH": str(tmp_path)})
    assert result.returncode == 1
    assert re.fullmatch("ImportError: halfspace: _library.*: cannot open shared object file.*; expected .*", result.stderr.splitlines()[-1])


def run(code, **more):
    return subprocess.run([sys.executable, "-W", "error", "-c", code], check=True, capture_output=True, text=True, **more).stdout.split()


def test_draw_is_a_part_of_the_package():
    assert run("import halfspace; print(halfspace.draw.Pass.__name__)") == ["Pass"]


def test_a_scene_can_be_made_without_a_current_folder(tmp_path):
    code = "import os; os.rmdir(os.getcwd()); import halfspace; print(halfspace.Scene().render((4, 4)).shape[0])"
    assert run(code, cwd=tmp_path, env={**os.environ, "PYTHONPATH": os.path.dirname(os.path.dirname(halfspace.__file__))}) == ["4"]


def test_the_folder_of_the_decoders_can_be_set(tmp_path):
    halfspace.render("moon", size=(16, 16)).save(tmp_path / "map.jpg")
    code = f"""
import halfspace
def works():
    try:
        return halfspace.render("earth", size=(4, 4), set={{"earth.color": {str(tmp_path / "map.jpg")!r}}}).size == 48
    except halfspace.InputError:
        return False
print(works())
halfspace.set_tool_folder({str(tmp_path)!r})
print(works())
halfspace.set_tool_folder("")
print(works())
"""
    assert run(code) == ["True", "False", "True"]
