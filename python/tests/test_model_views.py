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


def write_model(path, animations=("Slide",), **more):
    """Writes a glTF file with a quad of two scenes, "flat" and "tall". Each animation moves it to the right, by 10 units per second and
    animation, from an offset of 0.5."""
    data = b"".join([struct.pack("<12f", -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0), struct.pack("<6H", 0, 1, 2, 0, 2, 3), struct.pack("<2f", 0, 1)])
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
            "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}], **more}
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
    ({"time": 0.75, "model_animation": "Slide"}, ["--time", "0.75", "--animation", "Slide"]),
    ({"model_animation": "Slide"}, ["--animation", "Slide"]),
])
def test_an_animated_model_matches_the_command_line(command_line, model, view, options):
    picture = halfspace.render(model, size=SMALL, **view)
    assert same_bytes(picture, command_line(model, "--size", "160x90", *options))
    assert (picture != halfspace.render(model, size=SMALL, model_scene="tall")).any()


def test_the_first_of_several_animations_plays_with_a_warning(command_line, tmp_path):
    model = write_model(tmp_path / "two.gltf", ("Slide", "Fly"))
    with pytest.warns(halfspace.RenderWarning, match="'Slide' plays, the first of 2") as caught:
        picture = halfspace.render(model, size=SMALL, time=1)
    assert len(caught) == 1 and same_bytes(picture, command_line(model, "--size", "160x90", "--time", "1"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        halfspace.render(model, size=SMALL)  # nothing plays
        halfspace.render(model, size=SMALL, time=1, model_animation="Fly")


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
