# SPDX-License-Identifier: Apache-2.0
"""halfspace.render: its pixels and errors match those of the command line."""

import subprocess
import warnings

import numpy as np
import pytest

import halfspace
from conftest import same_bytes

SMALL = (160, 90)


def test_moon_matches_the_command_line(command_line):
    path = command_line("moon", "--size", "160x90", "--set", "time.hours=18")
    picture = halfspace.render("moon", size=SMALL, set={"time.hours": 18})
    assert picture.shape == (90, 160, 3) and picture.dtype == np.uint8
    assert same_bytes(picture, path)
    assert not same_bytes(halfspace.render("moon", size=SMALL), path)


def test_time_and_camera_match_the_command_line(command_line):
    path = command_line("day-night", "--size", "160x90", "--time", "2.5", "--set", "samples=2")
    assert same_bytes(halfspace.render("day-night", size=SMALL, time=2.5, set={"samples": 2}), path)


def test_model_matches_the_command_line(command_line, horse):
    path = command_line(horse, "--size", "200x100", "--yaw", "-40", "--background", "#204060")
    assert same_bytes(halfspace.render(horse, size=(200, 100), yaw=-40, background="#204060"), path)


def test_linear_light_matches_the_command_line(command_line, program):
    path = command_line("moon", "--size", "160x90", out="light.exr")
    light = halfspace.render("moon", size=SMALL, linear=True)
    assert light.shape == (90, 160, 4) and light.dtype == np.float32
    saved = path.with_name("own.exr")
    light.save(saved)
    # The header of the other file contains the command line.
    assert subprocess.run([program, "compare", saved, path, "--tolerance", "0"], check=False, capture_output=True).returncode == 0


def test_threads_do_not_change_the_pixels():
    one = halfspace.render("moon", size=SMALL, threads=1)
    assert np.array_equal(one, halfspace.render("moon", size=SMALL, threads=3))


@pytest.mark.parametrize("size", [(301, 307), (33, 7), (1, 1)])  # pixels are copied in parts of 65536
def test_pictures_copied_in_one_or_several_parts_match_the_command_line(command_line, size):
    path = command_line("three-lights", "--size", f"{size[0]}x{size[1]}")
    assert same_bytes(halfspace.render("three-lights", size=size), path)


@pytest.mark.parametrize("name, hide", [("earth", {"earth.visible": False}), ("day-night", {"time.hours": 23}), ("particles", {"particles.count": 0})])
def test_a_picture_does_not_depend_on_the_previous_one(name, hide):
    scene, fresh = halfspace.Scene.load(name), halfspace.Scene.load(name)
    before = scene.render(SMALL)
    scene.set(hide)
    fresh.set(hide)
    after = scene.render(SMALL)
    assert not np.array_equal(after, before)
    assert np.array_equal(after, fresh.render(SMALL))


def test_alpha_is_the_fourth_channel():
    four = halfspace.render("moon", size=SMALL, alpha=True)
    assert four.shape == (90, 160, 4) and four[0, 0, 3] == 0 and four[45, 80, 3] == 255
    assert np.array_equal(four[45, 80, :3], halfspace.render("moon", size=SMALL)[45, 80])


@pytest.mark.parametrize("call, arguments", [
    (lambda: halfspace.render("mooon", size=SMALL), ["mooon"]),
    (lambda: halfspace.render("moon", size=SMALL, set={"moon.raduis": 2}), ["moon", "--set", "moon.raduis=2"]),
    (lambda: halfspace.render("moon", size=SMALL, set={"moon.radius": "many"}), ["moon", "--set", "moon.radius=many"]),
    (lambda: halfspace.render("missing.glb", size=SMALL), ["missing.glb"]),
])
def test_errors_match_the_command_line(program, call, arguments):
    with pytest.raises(halfspace.InputError) as error:
        call()
    assert isinstance(error.value, ValueError)
    printed = subprocess.run([program, "render", *arguments], capture_output=True, text=True, check=False)
    assert printed.returncode == 3
    assert printed.stderr.replace("--set: ", "") == f"halfspace: {error.value}\n"  # options of the command line are not mentioned


def test_messages_name_no_options_of_the_command_line(tmp_path):
    scene = halfspace.Scene()
    with pytest.raises(halfspace.InputError, match="^nope: no 'nope' in this scene"):
        scene["nope"] = 1
    with pytest.raises(halfspace.InputError, match="^ambient: "):
        halfspace.render("moon", size=SMALL, set={"ambient": "many"})
    with pytest.raises(halfspace.InputError, match="nope") as error:
        halfspace.render("moon", size=SMALL, camera="nope")
    assert "--" not in str(error.value)
    (tmp_path / "m.mtl").write_text("newmtl m\nmap_Kd ../outside.png\nmap_Ks ../other.png\n")
    model = tmp_path / "m.obj"
    model.write_text("mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    with pytest.warns(halfspace.RenderWarning, match="pass allow_outside=True to allow it$") as caught:
        halfspace.render(model, size=SMALL)
    assert not any("--" in str(warning.message) for warning in caught)
    model = tmp_path / "m.gltf"
    model.write_text('{"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],'
                     '"accessors": [{"componentType": 5126, "count": 3, "type": "VEC3", "bufferView": 0}],'
                     '"bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"uri": "../a.bin", "byteLength": 36}]}')
    (tmp_path.parent / "a.bin").write_bytes(bytes(36))
    with pytest.raises(halfspace.InputError, match="outside the folder of the model.*allow_outside=True") as error:
        halfspace.render(model, size=SMALL)
    assert "--" not in str(error.value)


@pytest.mark.parametrize("arguments, words", [
    ({"size": (0, 10)}, "size: is (0, 10); expected"),
    ({"size": 5}, "size: is 5; expected"),
    ({"size": (1.5, 2)}, "size: is (1.5, 2); expected"),
    ({"threads": 0}, "threads: is 0; expected"),
    ({"time": float("nan")}, "time: is nan; expected"),
    ({"yaw": 3}, "yaw: applies only to model files"),
    ({"set": {"moon.radius": object()}}, "moon.radius: is of type object; expected"),
    ({"set": {"moon.color": ["a", "b"]}}, "moon.color: has elements that are not numbers; expected a sequence of numbers"),
    ({"set": {"moon.color": [[1, 2], [3]]}}, "moon.color: has elements that are not numbers; expected a sequence of numbers"),
    ({"camera": 5}, "camera: is of type int; expected"),
])
def test_wrong_arguments_are_reported(arguments, words):
    with pytest.raises(halfspace.InputError) as error:
        halfspace.render("moon", **{"size": SMALL, **arguments})
    assert str(error.value).startswith(words) and "\n" not in str(error.value)


def test_unknown_arguments_are_reported():
    words = "^yaww: unknown argument; expected one of "
    with pytest.raises(TypeError, match=words + "size, set, camera, time, linear, alpha, threads, aspect, yaw, "):
        halfspace.render("model.glb", yaww=3)
    with pytest.raises(TypeError, match=words + "threads, aspect, yaw, .*model_scene, animation, variant, "):
        halfspace.Scene.load("model.glb", yaww=None)


def test_warnings_are_python_warnings(tmp_path):
    model = tmp_path / "triangle.obj"
    model.write_text("mtllib missing.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    with pytest.warns(halfspace.RenderWarning, match="missing.mtl") as caught:
        halfspace.render(model, size=SMALL)
    assert caught[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(halfspace.RenderWarning):
            halfspace.render(model, size=SMALL)


def test_pictures_can_be_displayed_and_saved(tmp_path):
    picture = halfspace.render("moon", size=SMALL)
    assert picture._repr_png_().startswith(b"\x89PNG")
    assert type(picture.max()) is np.uint8 and type(picture.mean()) is np.float64 and type(picture + 1) is halfspace.Picture
    assert picture[0]._repr_png_() is None and picture.astype(float)._repr_png_() is None
    with pytest.raises(halfspace.InputError, match="path: is .*picture.xyz"):
        picture.save(tmp_path / "picture.xyz")
    with pytest.raises(halfspace.InputError, match="expected a file name ending in .png"):
        picture.save(tmp_path / "picture.exr")
    (tmp_path / "file").write_text("")
    with pytest.raises(halfspace.OutputError) as error:
        picture.save(tmp_path / "file" / "picture.png")
    assert isinstance(error.value, OSError)


def test_alpha_is_not_dropped_when_a_picture_is_saved(tmp_path):
    cutout = halfspace.render("moon", size=SMALL, alpha=True)
    light = halfspace.render("moon", size=SMALL, alpha=True, linear=True)
    for picture, name, others in [(cutout, "a.jpg", ".png or .tif"), (cutout, "a.JPEG", ".png or .tif"), (light, "a.hdr", ".exr")]:
        with pytest.raises(halfspace.InputError, match=f"{name}', a format without alpha, .* a file name ending in {others}$"):
            picture.save(tmp_path / name)
        assert not (tmp_path / name).exists()
    cutout.save(tmp_path / "a.tif")
    light.save(tmp_path / "a.exr")
    cutout[..., :3].save(tmp_path / "a.jpg")
    halfspace.render("moon", size=SMALL, linear=True).save(tmp_path / "a.hdr")


@pytest.mark.parametrize("size", [(512, 1), (1, 512)])
def test_any_aspect_ratio_matches_the_command_line(command_line, size):
    path = command_line("moon", "--size", f"{size[0]}x{size[1]}")
    assert same_bytes(halfspace.render("moon", size=size), path)


def test_a_camera_can_be_given_by_name(command_line):
    path = command_line("moon", "--size", "160x90", "--set", "camera=terminator")
    scene = halfspace.Scene.load("moon")
    assert same_bytes(scene.render(SMALL, camera="terminator"), path)
    assert same_bytes(scene.render_batch([None, "terminator"], size=SMALL)[1], path)
    assert same_bytes(scene.labels(["color"], size=SMALL, camera="terminator")["color"], path)
    assert same_bytes(next(scene.frames(1, size=SMALL, camera="terminator")), path)
    scene.camera = "terminator"
    assert same_bytes(scene.render(SMALL), path)
    with pytest.raises(halfspace.InputError, match="^camera: no camera 'nope' in this scene; expected one of whole, terminator$"):
        scene.render(SMALL, camera="nope")


def test_a_named_camera_moves_with_the_animation():
    scene = halfspace.Scene.load("moon")
    scene.merge({"cameras": {"moving": {"position": [0, 0, 4]}},
                 "animations": {"back": {"type": "rate", "target": "moving.position", "rate": [0, 0, 4]}}})
    first, last = scene.frames([0, 30], size=SMALL, fps=30, camera="moving")
    batch = scene.render_batch(["moving"] * 2, size=SMALL, time=[0, 1])
    assert np.array_equal(batch[0], first) and np.array_equal(batch[1], last) and not np.array_equal(first, last)


def test_errors_have_docstrings():
    assert "argument" in halfspace.InputError.__doc__ and "written" in halfspace.OutputError.__doc__
