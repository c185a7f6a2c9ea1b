# SPDX-License-Identifier: Apache-2.0
"""render_frames(), render_models(), submit_frames() and submit_models(), in this process, with executors and with Dask."""

import concurrent.futures
import multiprocessing
import os
import pickle
import signal
import tempfile
import time
from pathlib import Path

import numpy as np
import pytest

import halfspace
from conftest import QUAD, same_bytes, sphere

SIZE = (48, 27)


def rich_scene():
    """A scene with everything that a pickle must contain."""
    scene = halfspace.Scene(threads=1)
    texels = np.random.default_rng(1).integers(0, 255, (8, 8, 3), np.uint8)
    vertices, faces, _, uvs = sphere(8, 12)
    ball = halfspace.Mesh(vertices, faces, uvs=uvs, crease=0, material=halfspace.Material(base_color_texture=texels, roughness=0.3))
    scene.add(ball, name="ball")
    scene.add(ball, np.stack([np.diag([0.3, 0.3, 0.3, 1.0])] * 2), name="small")
    scene.add(halfspace.Mesh(*QUAD, colors=np.eye(4)[:, :3]), casts_shadow=False)
    vertices, faces, normals, _ = sphere(30, 40, 0.4)
    scene.add(halfspace.Mesh(vertices, faces, normals=normals + np.float32(1e-3)), np.eye(4))
    scene.place("small", np.array([[[0.3, 0, 0, 1.2], [0, 0.3, 0, 0], [0, 0, 0.3, 0], [0, 0, 0, 1]]]))
    scene.add_light("point", position=(1, 2, 3), color=(1, 0.5, 0.2))
    scene.merge({"animations": {"turn": {"type": "rate", "target": "small.rotation", "rate": [0, 90, 0]}}})
    return scene


def test_a_pickled_scene_shows_the_same(tmp_path):
    scene = rich_scene()
    again = pickle.loads(pickle.dumps(scene))
    assert np.array_equal(scene.render(SIZE, time=0.5), again.render(SIZE, time=0.5))
    assert again.objects == scene.objects and again.lights == scene.lights
    again.place("ball", np.diag([2.0, 2, 2, 1]))
    assert again.add(halfspace.Mesh(*QUAD)) not in scene.objects
    assert not np.array_equal(scene.render(SIZE), again.render(SIZE))
    scene.camera = halfspace.Camera.look_at((0, 0, 9), (0, 0, 0))
    assert np.array_equal(scene.render(SIZE), pickle.loads(pickle.dumps(scene)).render(SIZE))
    shipped = halfspace.Scene.load("moon")
    shipped["samples"] = 8
    assert np.array_equal(shipped.render(SIZE), pickle.loads(pickle.dumps(shipped)).render(SIZE))


def test_a_pickled_model_file_shows_the_same(horse):
    scene = halfspace.Scene.load(horse, yaw=100, background="#336699")
    assert np.array_equal(scene.render(SIZE), pickle.loads(pickle.dumps(scene)).render(SIZE))
    mixed = halfspace.Scene()
    mixed.add(halfspace.Model.load(horse))
    mixed.add(halfspace.Mesh.load(horse), np.diag([0.5, 0.5, 0.5, 1.0]))
    assert np.array_equal(mixed.render(SIZE), pickle.loads(pickle.dumps(mixed)).render(SIZE))


def test_frames_are_those_of_scene_frames(tmp_path):
    scene = rich_scene()
    expected = list(scene.frames([0, 3, 5], size=SIZE, fps=10, time=0.5))
    calls = []
    given = halfspace.render_frames(scene, [0, 3, 5], size=SIZE, fps=10, time=0.5, progress=lambda done, total: calls.append((done, total)))
    assert all(np.array_equal(a, b) for a, b in zip(given, expected)) and calls == [(1, 3), (2, 3), (3, 3)]
    files = halfspace.render_frames(scene, [0, 3, 5], size=SIZE, fps=10, time=0.5, out=tmp_path / "new" / "%03d.png")
    assert [os.path.basename(f) for f in files] == ["000.png", "003.png", "005.png"]
    expected[2].save(tmp_path / "own.png")
    assert (tmp_path / "new" / "005.png").read_bytes() == (tmp_path / "own.png").read_bytes()
    assert halfspace.render_frames(scene, 0) == []


def test_later_changes_of_the_scene_have_no_effect():
    scene = rich_scene()
    expected = list(scene.frames(3, size=SIZE))
    with concurrent.futures.ThreadPoolExecutor(1) as executor:
        blocked = executor.submit(time.sleep, 0.3)
        futures = halfspace.submit_frames(scene, 3, executor, size=SIZE)
        scene["ball.visible"] = False
        blocked.result()
        given = [picture for future in futures for picture in future.result()]
    assert all(np.array_equal(a, b) for a, b in zip(given, expected))


def test_normals_of_a_pickled_mesh_have_the_same_bits():
    vertices, faces, normals, _ = sphere(40, 60)
    mesh = halfspace.Mesh(vertices, faces, normals=np.random.default_rng(2).normal(size=normals.shape))
    again = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(mesh))))
    assert np.array_equal(again.normals, mesh.normals) and type(again.normals) is np.ndarray


def test_frames_are_those_of_the_command_line(command_line, tmp_path):
    command_line("moon", "--size", "48x27", "--frames", "0..3", "--fps", "2", out="own/{frame}.png")
    for number, picture in enumerate(halfspace.render_frames("moon", 4, size=SIZE, fps=2)):
        assert same_bytes(picture, tmp_path / "own" / f"{number:04}.png")


def executors():
    yield concurrent.futures.ThreadPoolExecutor(2)
    yield concurrent.futures.ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("forkserver"))


def test_executors_give_the_same_frames(tmp_path):
    scene = rich_scene()
    expected = list(scene.frames(range(5), size=SIZE))
    for executor in executors():
        with executor:
            given = halfspace.render_frames(scene, range(5), size=SIZE, client=executor, batch=2)
            assert all(np.array_equal(a, b) for a, b in zip(given, expected)), type(executor)
            futures = halfspace.submit_frames(scene, range(5), executor, size=SIZE, batch=3)
            assert [len(f.result()) for f in futures] == [3, 2]


def test_processes_receive_a_scene_once(tmp_path, monkeypatch):
    """The scene is pickled once for all batches, into a file that is removed."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    pickled = []
    state_of = halfspace.frames._Frames.__getstate__
    monkeypatch.setattr(halfspace.frames._Frames, "__getstate__", lambda job: pickled.append(job) or state_of(job))
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("forkserver")) as executor:
        futures = halfspace.submit_frames(rich_scene(), 6, executor, size=SIZE, batch=1)
        assert len(list(tmp_path.iterdir())) == 1
        assert [len(future.result()) for future in futures] == [1] * 6
    assert len(pickled) == 1
    assert list(tmp_path.iterdir()) == []


def test_an_exception_of_progress_cancels_the_rest(tmp_path):
    def stop(done, total):
        raise RuntimeError("enough")

    with concurrent.futures.ThreadPoolExecutor(1) as executor:
        with pytest.raises(RuntimeError, match="enough"):
            halfspace.render_frames(rich_scene(), 200, size=SIZE, client=executor, batch=1, out=tmp_path / "{frame}.png", progress=stop)
    assert len(list(tmp_path.iterdir())) < 100


def write_models(folder):
    for i, name in enumerate("abcd"):
        (folder / f"{name}.obj").write_text(f"v 0 0 0\nv {i + 1} 0 0\nv 0 1 {i}\nf 1 2 3\n")
    (folder / "broken.obj").write_text("v 0 0 0\nf 1 2 3\n")
    return [folder / f"{name}.obj" for name in "abcd"]


def test_models_are_those_of_single_calls(tmp_path):
    models = write_models(tmp_path)
    files = halfspace.render_models(models, size=SIZE, out=tmp_path / "out" / "{name}.png", yaw=10)
    assert [os.path.basename(f) for f in files] == ["a.png", "b.png", "c.png", "d.png"]
    with concurrent.futures.ThreadPoolExecutor(2) as executor:
        pictures = halfspace.render_models(models, size=SIZE, client=executor, threads=1, yaw=10)
    for model, picture, file in zip(models, pictures, files):
        own = halfspace.render(model, size=SIZE, yaw=10)
        assert np.array_equal(picture, own)
        own.save(tmp_path / "own.png")
        assert (tmp_path / "own.png").read_bytes() == Path(file).read_bytes()


def test_a_model_that_fails_costs_its_own_picture(tmp_path):
    models = write_models(tmp_path)
    models.insert(1, tmp_path / "broken.obj")
    results = halfspace.render_models(models, size=SIZE, errors="return")
    assert [isinstance(r, halfspace.InputError) for r in results] == [False, True, False, False, False]
    with pytest.raises(halfspace.InputError, match="broken.obj"):
        halfspace.render_models(models, size=SIZE, out=tmp_path / "{name}.png")
    assert (tmp_path / "d.png").exists()


def test_pictures_of_models_replace_no_file_of_others(tmp_path):
    models = write_models(tmp_path)[:2]
    texture = tmp_path / "a.png"
    texture.write_bytes(halfspace.render("shapes", size=(8, 8))._repr_png_().replace(b"Software\0Halfspace", b"Software\0Otherpict"))
    before = texture.read_bytes()
    results = halfspace.render_models(models, size=SIZE, out=tmp_path / "{name}.png", errors="return")
    assert isinstance(results[0], halfspace.OutputError) and "a.png: exists, and Halfspace did not write it" in str(results[0])
    assert texture.read_bytes() == before
    assert halfspace.render_models(models[1:], size=SIZE, out=tmp_path / "{name}.png") == [results[1]], "its own picture is replaced"
    # A texture that Halfspace made is protected from its own model.
    texture.unlink()
    halfspace.render("shapes", size=(8, 8)).save(texture)
    before = texture.read_bytes()
    (tmp_path / "a.mtl").write_text("newmtl m\nmap_Kd a.png\n")
    models[0].write_text("mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n")
    scene = tmp_path / "scene" / "a.json"
    scene.parent.mkdir()
    scene.write_text('{"version": 1, "objects": {"part": {"shape": "file", "file": "../a.obj", "allow_outside": true}}}')
    for source in (models[0], scene):
        with pytest.raises(halfspace.OutputError, match="a.png: is read by this command"):
            halfspace.render_models([source], size=SIZE, out=tmp_path / "{name}.png")
    assert texture.read_bytes() == before


def test_submitted_models_are_futures(tmp_path):
    models = write_models(tmp_path)
    for executor in executors():
        with executor:
            futures = halfspace.submit_models([*models, tmp_path / "broken.obj"], executor, size=SIZE, threads=1, batch=2, yaw=10)
            results = [result for future in futures for result in future.result()]
        assert len(futures) == 3 and isinstance(results[4], halfspace.InputError), type(executor)
        for model, picture in zip(models, results):
            assert np.array_equal(picture, halfspace.render(model, size=SIZE, yaw=10))


def test_wrong_arguments():
    scene = halfspace.Scene()
    for out in ("a.png", "{name}.png", "%4d.png", "%%.png"):
        with pytest.raises(halfspace.InputError, match=r"^out: is .*\{frame\} or %04d"):
            halfspace.render_frames(scene, 2, out=out)
    with pytest.raises(halfspace.InputError, match=r"^out: is .*\{name\}"):
        halfspace.render_models(["a.obj"], out="a.png")
    with pytest.raises(halfspace.InputError, match="^models: has 'x/a.obj' and 'y/a.obj', which have the same output file"):
        halfspace.render_models(["x/a.obj", "y/a.obj"], out="{name}.png")
    with pytest.raises(halfspace.InputError, match="^client: is of type str"):
        halfspace.render_frames(scene, 2, client="tcp://localhost")
    with pytest.raises(halfspace.InputError, match="^batch"):
        halfspace.render_frames(scene, 2, client=concurrent.futures.ThreadPoolExecutor(1), batch=0)


@pytest.mark.parametrize("client", [None, concurrent.futures.ThreadPoolExecutor(2)])
def test_files_of_killed_processes_are_removed(client, tmp_path):
    scene = rich_scene()
    abandoned = tmp_path / ".halfspace-1-0.part"
    abandoned.write_bytes(b"half of a picture")
    halfspace.render_frames(scene, 2, size=SIZE, out=tmp_path / "{frame}.png", client=client)
    assert sorted(file.name for file in tmp_path.iterdir()) == ["0000.png", "0001.png"]
    models = write_models(tmp_path)
    abandoned.write_bytes(b"half of a picture")
    halfspace.render_models(models, size=SIZE, out=tmp_path / "{name}.png", client=client)
    assert not abandoned.exists()


@pytest.fixture(scope="module")
def dask():
    distributed = pytest.importorskip("distributed", reason="Dask is not installed (scripts/install_deps.sh --dask)")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, silence_logs=50) as cluster:
        with distributed.Client(cluster) as client:
            yield client


@pytest.mark.filterwarnings("ignore")  # of Dask
def test_dask_gives_the_same_frames(dask, tmp_path):
    scene = rich_scene()
    expected = list(scene.frames(range(6), size=SIZE))
    given = halfspace.render_frames(scene, range(6), size=SIZE, client=dask, batch=1)
    assert all(np.array_equal(a, b) for a, b in zip(given, expected))
    models = write_models(tmp_path)
    pictures = halfspace.render_models(models, size=SIZE, client=dask, threads=1)
    assert np.array_equal(pictures[2], halfspace.render(tmp_path / "c.obj", size=SIZE))
    submitted = [picture for future in halfspace.submit_models(models, dask, size=SIZE, threads=1) for picture in future.result()]
    assert all(np.array_equal(a, b) for a, b in zip(submitted, pictures))


def _worker_pid():
    return os.getpid()


def kill_a_worker(client):
    """Kills one of two workers. If the last one died, Dask 2022.12 would lose the tasks that wait (docs/howto/scale.md)."""
    pids = client.run(_worker_pid)
    assert len(pids) == 2
    os.kill(next(iter(pids.values())), signal.SIGKILL)


@pytest.mark.filterwarnings("ignore")  # of Dask
def test_results_on_a_killed_worker_of_dask_are_rendered_again(dask):
    distributed = pytest.importorskip("distributed")
    scene = rich_scene()
    dask.wait_for_workers(2)
    futures = halfspace.submit_frames(scene, 6, dask, size=SIZE, batch=1)
    distributed.wait(futures)
    kill_a_worker(dask)
    pictures = [picture for future in futures for picture in future.result(timeout=120)]
    assert len(pictures) == 6 and all(np.array_equal(a, b) for a, b in zip(pictures, scene.frames(range(6), size=SIZE)))


@pytest.mark.filterwarnings("ignore")  # of Dask
def test_a_killed_worker_of_dask_loses_nothing(dask, tmp_path):
    """The tasks of a killed worker run again on others."""
    scene = halfspace.Scene.load("moon", threads=1)
    halfspace.render_frames(scene, 12, size=SIZE, out=tmp_path / "one" / "{frame}.png")
    dask.wait_for_workers(2)
    futures = halfspace.submit_frames(scene, 12, dask, size=SIZE, out=tmp_path / "dask" / "{frame}.png", batch=1)
    time.sleep(0.2)
    kill_a_worker(dask)
    names = [name for future in futures for name in future.result(timeout=120)]
    assert [os.path.basename(name) for name in names] == [f"{i:04}.png" for i in range(12)]
    for i in range(12):
        assert (tmp_path / "dask" / f"{i:04}.png").read_bytes() == (tmp_path / "one" / f"{i:04}.png").read_bytes()
    assert sorted(p.name for p in (tmp_path / "dask").iterdir()) == [f"{i:04}.png" for i in range(12)], "no partial files"
