# SPDX-License-Identifier: Apache-2.0
"""Options of model files: animations, scenes, variants, backgrounds. The models are written by the tests."""

import base64
import json
import struct
import warnings

import numpy as np
import pytest

import halfspace
from conftest import same_bytes

SMALL = (160, 90)


def write_model(path, animations=("Slide",)):
    """Writes a glTF file with a quad of two scenes, "flat" and "tall". Each animation moves it to the right, by 10 units per second and
    animation, from an offset of 0.5."""
    corners = (-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0)
    data = struct.pack("<12f", *corners) + struct.pack("<6H", 0, 1, 2, 0, 2, 3) + struct.pack("<2f", 0, 1)
    accessors = [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]},
                 {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
                 {"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]}]
    views = [(0, 48), (48, 12), (60, 8)]
    moves = []
    for i, name in enumerate(animations):
        views.append((len(data), 24))
        data += struct.pack("<6f", 0.5, 0, 0, 10.5 * (i + 1), 0, 0)
        accessors.append({"bufferView": 3 + i, "componentType": 5126, "count": 2, "type": "VEC3"})
        moves.append({"name": name, "samplers": [{"input": 2, "output": 3 + i}],
                      "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]})
    gltf = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"name": "flat", "nodes": [0]}, {"name": "tall", "nodes": [1]}],
            "nodes": [{"mesh": 0}, {"mesh": 0, "scale": [1, 3, 1]}], "accessors": accessors, "animations": moves,
            "materials": [{"pbrMetallicRoughness": {"baseColorFactor": color}} for color in ([1, 0, 0, 1], [0, 0, 1, 1])],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0, "extensions": {
                "KHR_materials_variants": {"mappings": [{"material": 1, "variants": [1]}]}}}]}],
            "extensionsUsed": ["KHR_materials_variants"],
            "extensions": {"KHR_materials_variants": {"variants": [{"name": "red"}, {"name": "blue"}]}},
            "bufferViews": [{"buffer": 0, "byteOffset": start, "byteLength": size} for start, size in views],
            "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}
    path.write_text(json.dumps(gltf))
    return path


@pytest.fixture
def model(tmp_path):
    return write_model(tmp_path / "slide.gltf")


# ---- animations ------------------------------------------------------------------------------------------------------

@pytest.mark.parametrize("view, options", [
    ({}, []),
    ({"time": 0}, ["--time", "0"]),  # plays the animation
    ({"time": 0.75}, ["--time", "0.75"]),
    ({"time": 0.75, "animation": "Slide"}, ["--time", "0.75", "--animation", "Slide"]),
    ({"animation": "Slide"}, ["--animation", "Slide"]),
    ({"model_animation": "Slide"}, ["--animation", "Slide"]),
])
def test_an_animated_model_matches_the_command_line(command_line, model, view, options):
    picture = halfspace.render(model, size=SMALL, **view)
    assert same_bytes(picture, command_line(model, "--size", "160x90", *options))
    assert (picture != halfspace.render(model, size=SMALL, model_scene="tall")).any()


def test_the_first_of_several_animations_plays_with_a_warning(command_line, tmp_path):
    model = write_model(tmp_path / "two.gltf", ("Slide", "Fly"))
    with pytest.warns(halfspace.RenderWarning, match="'Slide' plays, the first of 2; pass animation= to select another: Fly$") as caught:
        picture = halfspace.render(model, size=SMALL, time=1)
    assert len(caught) == 1 and same_bytes(picture, command_line(model, "--size", "160x90", "--time", "1"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        halfspace.render(model, size=SMALL)  # nothing plays
        halfspace.render(model, size=SMALL, time=1, animation="Fly")


def test_frames_of_an_animated_model_match_the_command_line(command_line, model):
    path = command_line(model, "--size", "160x90", "--frames", "0..2", "--fps", "3")
    scene = halfspace.Scene.load(model, times=[i / 3 for i in range(3)])
    for number, frame in enumerate(scene.frames(3, size=SMALL, fps=3)):
        assert same_bytes(frame, path.with_name(f"picture_{number:04}.png"))


@pytest.mark.parametrize("times, words", [
    (1, "times: is of type int; expected a sequence of numbers"),
    ([0, "x"], "times[1]: is 'x'; expected a number"),
    ([float("inf")], "times[0]: is inf; expected"),
])
def test_wrong_times_are_reported(model, times, words):
    with pytest.raises(halfspace.InputError) as error:
        halfspace.Scene.load(model, times=times)
    assert str(error.value).startswith(words)


# ---- types -----------------------------------------------------------------------------------------------------------

@pytest.mark.parametrize("arguments, words", [
    ({"background": (1, 0)}, 'background: is (1, 0); expected "#rrggbb", '),
    ({"background": (255, 0, 0)}, "background: is (255, 0, 0); expected"),
    ({"background": np.eye(3)}, "background: is array([[1., 0., 0.], "),
    ({"background": [[1], [1, 2], 3]}, "background: is [[1], [1, 2], 3]; expected"),
    ({"background": 0.5}, "background: is 0.5; expected"),
    ({"background": "red"}, "background: is 'red'; expected"),
    ({"environment": 3}, "environment: is 3; expected a file name"),
    ({"floor": "no"}, "floor: is 'no'; expected True or False"),
    ({"inside": "x"}, "inside: is 'x'; expected True or False"),
    ({"allow_outside": "x"}, "allow_outside: is 'x'; expected True or False"),
    ({"model_scene": 1.5}, "model_scene: is 1.5; expected a name or an index"),
    ({"animation": True}, "animation: is True; expected a name or an index"),
    ({"model_variant": -1}, "model_variant: is -1; expected an integer from 0"),
    ({"animation": 0, "model_animation": 0}, "model_animation: is another name of animation; expected only one of them"),
    ({"up_axis": 1}, "up_axis: is 1; expected one of y, z"),
    ({"eye": "x"}, "eye: has the shape (); expected (3,)"),
])
def test_wrong_types_are_reported(model, arguments, words):
    with pytest.raises(halfspace.InputError) as error:
        halfspace.render(model, size=SMALL, **arguments)
    assert str(error.value).startswith(words) and "\n" not in str(error.value)


@pytest.mark.parametrize("arguments, words", [
    ({"animation": "walk"}, "animation: "),
    ({"model_variant": 7}, "variant: "),
    ({"model_scene": 5}, "model_scene: "),
    ({"environment": "none.hdr"}, "environment: "),
    ({"eye": (0, 50, 0), "look_at": (0, 0, 0)}, "up: "),
])
def test_values_that_do_not_fit_the_model_are_reported(tmp_path, arguments, words):
    model = write_model(tmp_path / "still.gltf", ())
    with pytest.raises(halfspace.InputError) as error:
        halfspace.render(str(model), size=SMALL, **arguments)
    assert str(error.value).startswith(words) and "\n" not in str(error.value) and "--" not in str(error.value)


@pytest.mark.parametrize("argument, option, name, index", [
    ("model_scene", "--scene", "tall", 1),
    ("animation", "--animation", "Fly", np.int64(1)),
    ("variant", "--variant", "blue", 1),
    ("model_variant", "--variant", "blue", 1),
])
def test_parts_of_a_model_can_be_given_by_index(command_line, tmp_path, argument, option, name, index):
    model = write_model(tmp_path / "two.gltf", ("Slide", "Fly"))
    time = {"time": 0.5, "animation": "Slide"}
    options = {"--time": "0.5", "--animation": "Slide", option: name}
    path = command_line(model, "--size", "160x90", *(word for pair in options.items() for word in pair))
    for value in (name, index):
        picture = halfspace.render(model, size=SMALL, **{**time, argument: value})
        assert same_bytes(picture, path)
    assert (picture != halfspace.render(model, size=SMALL, **{**time, argument: 0})).any()


@pytest.mark.parametrize("color", [(0, 0.5, 1), [0, 0.5, 1], np.array([0, 0.5, 1])])
def test_a_background_can_be_a_linear_color(command_line, model, color):
    path = command_line(model, "--size", "160x90", "--set", "background.color=0,0.5,1")
    assert same_bytes(halfspace.render(model, size=SMALL, background=color), path)


def test_a_transparent_background_matches_the_command_line(command_line, model):
    path = command_line(model, "--size", "160x90", "--background", "transparent")
    assert same_bytes(halfspace.render(model, size=SMALL, background="transparent"), path)
    assert same_bytes(halfspace.render(model, size=SMALL, alpha=True), path)


def test_models_of_a_scene_file_can_refer_to_files_outside_their_folders(tmp_path):
    folder = tmp_path / "inner"
    folder.mkdir()
    halfspace.Picture((4, 4, 3), np.uint8).save(tmp_path / "outer.png")
    (folder / "a.mtl").write_text("newmtl m\nmap_Kd ../outer.png\n")
    (folder / "a.obj").write_text("mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (folder / "scene.json").write_text(json.dumps({
        "version": 1, "samples": 1, "ambient": 1, "cameras": {"front": {"position": [0, 0, 4]}}, "camera": "front",
        "objects": {"shown": {"shape": "file", "file": "a.obj"}, "ball": {"shape": "sphere"}}}))
    for file in ("a.obj", "scene.json"):
        with pytest.warns(halfspace.RenderWarning, match="outside the folder"):
            halfspace.render(folder / file, size=SMALL)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            halfspace.render(folder / file, size=SMALL, allow_outside=True)
