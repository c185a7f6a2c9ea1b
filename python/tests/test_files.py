# SPDX-License-Identifier: Apache-2.0
"""halfspace.export, info and compare give the results and the messages of the command line."""

import json
import subprocess

import numpy as np
import pytest

import halfspace
from conftest import QUAD

# Keys that make the meshes of shipped scenes small.
SMALL = {"moon": {"objects.moon.latitudes": 32, "objects.moon.longitudes": 64}, "day-night": {"objects.ground.segments": 8}}
TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\nf 1 2 3\n"


@pytest.fixture
def run(program):
    """Runs the program and returns its exit code, its output and the line that it prints about an error."""
    def run_program(*arguments):
        done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)
        return done.returncode, done.stdout, done.stderr.removeprefix("halfspace: ").removeprefix("error: ").strip()

    return run_program


def set_options(keys):
    return [option for key, value in keys.items() for option in ("--set", f"{key}={value}")]


def fails_like(run, arguments, call):
    code, _, line = run(*arguments)
    assert code != 0
    with pytest.raises((halfspace.InputError, halfspace.OutputError)) as error:
        call()
    assert str(error.value) == line


@pytest.mark.parametrize("scene, end", [("moon", "glb"), ("materials", "gltf"), ("moon", "obj"), ("moon", "stl"), ("model", "ply"), ("model", "glb")])
def test_export_writes_the_files_of_the_command_line(run, tmp_path, scene, end):
    if scene == "model":
        (tmp_path / "triangle.obj").write_text(TRIANGLE)
        scene = tmp_path / "triangle.obj"
    elif scene not in halfspace.scenes():
        scene = halfspace.scenes()[0]
    for folder in ("own", "program"):
        (tmp_path / folder).mkdir()
    keys = SMALL.get(scene, {})
    code, _, line = run("export", scene, "-o", tmp_path / "program" / f"out.{end}", *set_options(keys))
    assert code == 0, line
    with np.testing.suppress_warnings() as quiet:
        quiet.filter(halfspace.RenderWarning)
        halfspace.export(scene, tmp_path / "own" / f"out.{end}", set=keys)
    names = sorted(path.name for path in (tmp_path / "program").iterdir())
    assert names == sorted(path.name for path in (tmp_path / "own").iterdir())
    for name in names:
        assert (tmp_path / "own" / name).read_bytes() == (tmp_path / "program" / name).read_bytes(), name


def test_export_warns_and_fails_like_the_command_line(run, tmp_path):
    (tmp_path / "triangle.obj").write_text(TRIANGLE)
    source, none = tmp_path / "triangle.obj", tmp_path / "none.obj"
    keys = SMALL["day-night"]
    _, _, printed = run("export", "day-night", "-o", tmp_path / "a.obj", *set_options(keys))
    with pytest.warns(halfspace.RenderWarning) as warnings:
        halfspace.export("day-night", tmp_path / "b.obj", set=keys)
    assert printed and all(str(warning.message).split(": ")[-1] in printed for warning in warnings)
    fails_like(run, ("export", none, "-o", tmp_path / "c.glb"), lambda: halfspace.export(none, tmp_path / "c.glb"))
    fails_like(run, ("export", source, "-o", source), lambda: halfspace.export(source, source))
    fails_like(run, ("export", "mon", "-o", tmp_path / "c.glb"), lambda: halfspace.export("mon", tmp_path / "c.glb"))
    fails_like(run, ("export", source, "-o", source / "c.glb"), lambda: halfspace.export(source, source / "c.glb"))
    with pytest.raises(halfspace.InputError, match="^out: is .*c.png'; expected a file name ending in .glb, .gltf, .obj, .ply or .stl$"):
        halfspace.export("moon", tmp_path / "c.png")
    with pytest.raises(halfspace.InputError, match="^set: applies only to scenes"):
        halfspace.export(source, tmp_path / "c.glb", set={"samples": 1})
    assert not (tmp_path / "c.glb").exists()


def test_a_scene_in_memory_can_be_exported(tmp_path):
    scene = halfspace.Scene(lighting="none")
    place = np.eye(4)
    place[:3, 3] = 1, 2, 3
    scene.add(halfspace.Mesh(*QUAD, material=halfspace.Material("#204060")), place, name="My Obj")
    scene.add_light("point", position=(0, 2, 3), falloff="physical")
    scene.export(tmp_path / "scene.glb")
    model = halfspace.Model.load(tmp_path / "scene.glb")
    assert np.allclose(model.bounds, [[0, 1, 3], [2, 3, 3]]) and halfspace.info(tmp_path / "scene.glb")["lights"] == ["light_1"]
    assert np.allclose(model.meshes[0].material.base_color, halfspace.Material("#204060").base_color, atol=1e-6)
    with pytest.raises(halfspace.InputError, match="^path: is 'a.png'; expected a file name ending in .glb"):
        scene.export("a.png")
    with pytest.raises(halfspace.InputError, match="scene: has no meshes to export"):
        halfspace.Scene().export(tmp_path / "none.glb")


def test_info_is_that_of_the_command_line(run, tmp_path):
    (tmp_path / "triangle.obj").write_text(TRIANGLE)
    path = tmp_path / "triangle.obj"
    assert halfspace.info(path) == json.loads(run("info", path, "--json")[1])
    assert halfspace.info(path, up_axis="z") == json.loads(run("info", path, "--json", "--up-axis", "z")[1])
    own, printed = halfspace.info(), json.loads(run("info", "--json")[1])
    assert {*own, "commit"} == {*printed} and (own["version"], own["arch"], own["lanes"]) == (halfspace.__version__, printed["arch"], printed["lanes"])
    for wrong in (tmp_path / "none.obj", "moon"):
        fails_like(run, ("info", wrong), lambda: halfspace.info(wrong))
    with pytest.raises(halfspace.InputError, match="^up_axis: is 'w'; expected one of y, z$"):
        halfspace.info(path, up_axis="w")


def test_compare_is_that_of_the_command_line(run, tmp_path):
    rng = np.random.default_rng(3)
    a, b = (rng.integers(0, 256, (24, 32, 3), np.uint8) for _ in range(2))
    paths = [tmp_path / "a.png", tmp_path / "b.png"]
    for array, path in zip((a, b), paths):
        array.view(halfspace.Picture).save(path)
    expected = json.loads(run("compare", *paths, "--json", "-o", tmp_path / "program.png")[1])
    assert halfspace.compare(*paths, difference=tmp_path / "own.png") == expected
    assert halfspace.compare(tmp_path / "program.png", tmp_path / "own.png")["differing_pixels"] == 0
    pictures = halfspace.compare(a, b)
    assert {**pictures, "a": expected["a"], "b": expected["b"]} == expected and pictures["psnr_db"] is not None
    assert halfspace.compare(a, a)["psnr_db"] is None and halfspace.compare(paths[0], a, tolerance=0)["max"] == 0
    _, _, line = run("compare", *paths, "--tolerance", "0.25")
    with pytest.raises(halfspace.DifferenceError) as error:
        halfspace.compare(*paths, tolerance=0.25)
    assert str(error.value) == line
    a[:8].view(halfspace.Picture).save(tmp_path / "small.png")
    fails_like(run, ("compare", paths[0], tmp_path / "small.png"), lambda: halfspace.compare(paths[0], tmp_path / "small.png"))
    fails_like(run, ("compare", paths[0], tmp_path / "no.png"), lambda: halfspace.compare(paths[0], tmp_path / "no.png"))
    fails_like(run, ("compare", *paths, "-o", paths[0]), lambda: halfspace.compare(*paths, difference=paths[0]))


def test_linear_light_is_compared_as_such():
    light = np.full((4, 4, 4), 2.0, np.float32)
    result = halfspace.compare(light, 1.5 * light)
    assert result["values"] == "linear" and result["max"] == 1.0
    codes = np.full((4, 4, 4), 255, np.uint8)
    assert halfspace.compare(np.ones((4, 4, 4), np.float32), codes)["values"] == "codes"
    for wrong, words in ((np.zeros((4, 4)), "has the shape"), (np.zeros((4, 4, 4)), "has the dtype float64"), (7, "is 7; expected a file name"),
                         (np.full((2, 2, 4), np.nan, np.float32), "is nan; expected a finite number")):
        with pytest.raises(halfspace.InputError, match=words):
            halfspace.compare(wrong, codes)
