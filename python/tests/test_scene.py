# SPDX-License-Identifier: Apache-2.0
"""Scene.load, keys, frames and batches."""

import numpy as np
import pytest

import halfspace
from conftest import same_bytes

SMALL = (160, 90)


def test_keys_are_set_and_read():
    scene = halfspace.Scene.load("moon")
    scene["moon.radius"] = np.float32(0.75)
    assert scene["moon.radius"] == 0.75 and scene["objects.moon.radius"] == 0.75
    scene.set({"ambient": (0.1, 0.2, 0.3), "samples": np.int64(4)})
    assert scene["ambient"] == [0.1, 0.2, 0.3] and scene["samples"] == 4
    scene["moon.casts_shadow"] = False
    assert scene["moon.casts_shadow"] is False
    with pytest.raises(halfspace.InputError, match="samples"):
        scene.set({"moon.radius": 0.5, "samples": 3})
    assert scene["moon.radius"] == 0.75  # unchanged
    with pytest.raises(halfspace.InputError, match="no key|unknown"):
        scene["moon.raduis"]


def test_a_changed_scene_matches_the_command_line(command_line):
    path = command_line("moon", "--size", "160x90", "--set", "moon.radius=0.75")
    scene = halfspace.Scene.load("moon")
    before = scene.render(SMALL)
    scene["moon.radius"] = 0.75
    assert same_bytes(scene.render(SMALL), path)
    assert not np.array_equal(before, scene.render(SMALL))


def test_frames_match_the_command_line(command_line):
    first = command_line("day-night", "--size", "160x90", "--frames", "3..5", "--fps", "2")
    frames = list(halfspace.Scene.load("day-night").frames(range(3, 6), size=SMALL, fps=2))
    assert len(frames) == 3
    for number, frame in zip(range(3, 6), frames):
        assert same_bytes(frame, first.with_name(f"picture_{number:04}.png"))


def test_frames_are_rendered_on_demand_and_ignore_later_changes():
    scene = halfspace.Scene.load("day-night")
    expected = list(scene.frames(2, size=SMALL))
    frames = scene.frames(2, size=SMALL)
    assert np.array_equal(next(frames), expected[0])
    scene["samples"] = 1 if scene["samples"] != 1 else 2
    assert np.array_equal(next(frames), expected[1])
    with pytest.raises(StopIteration):
        next(frames)


def test_a_batch_matches_single_pictures():
    scene = halfspace.Scene.load("moon", threads=3)
    cameras = [halfspace.Camera.look_at((3 * np.sin(a), 1, 3 * np.cos(a))) for a in np.linspace(0, 3, 7)]
    calls = []
    batch = scene.render_batch(cameras, size=(80, 60), progress=lambda done, total: calls.append((done, total)))
    assert batch.shape == (7, 60, 80, 3)
    assert sorted(calls) == [(i + 1, 7) for i in range(7)]
    for camera, picture in zip(cameras, batch):
        assert np.array_equal(scene.render((80, 60), camera=camera), picture)
    light = scene.render_batch(cameras[:2], size=(80, 60), linear=True)
    assert light.shape == (2, 60, 80, 4) and light.dtype == np.float32
    assert np.array_equal(light[1], scene.render((80, 60), camera=cameras[1], linear=True))


def test_progress_can_use_the_scene_and_end_the_batch():
    scene = halfspace.Scene.load("moon", threads=2)
    cameras = [None] * 5
    scene.render_batch(cameras, size=(16, 16), progress=lambda done, total: scene["moon.radius"])

    def stop(done, total):
        raise KeyError("enough")

    before = scene.render((16, 16))
    batch = scene.render_batch(cameras, size=(16, 16), progress=lambda done, total: scene.set({"moon.radius": 0.25}))
    assert all(np.array_equal(picture, before) for picture in batch)  # a batch shows the scene at the time of the call
    assert not np.array_equal(scene.render((16, 16)), before)
    with pytest.raises(KeyError, match="enough"):
        scene.render_batch(cameras, size=(16, 16), progress=stop)
    assert scene.render_batch([], size=(16, 16)).shape == (0, 16, 16, 3)


def test_a_scene_can_be_displayed():
    scene = halfspace.Scene.load("moon")
    assert scene._repr_png_() == scene.render((640, 360))._repr_png_()
    assert repr(scene) == "Scene(1 object: moon)" and repr(halfspace.Scene()) == "Scene(0 objects)"


def test_the_text_of_a_scene_can_be_loaded(tmp_path):
    scene = halfspace.Scene.load("moon")
    scene["moon.radius"] = 0.5
    (tmp_path / "own.json").write_text(scene.text())
    assert np.array_equal(halfspace.render(tmp_path / "own.json", size=SMALL), scene.render(SMALL))


def test_a_patch_changes_the_scene_file():
    scene = halfspace.Scene.load("moon")
    scene.merge({"objects": {"ball": {"shape": "icosphere", "radius": 0.25, "position": [1.5, 0, 0]}}})
    assert scene["ball.radius"] == 0.25
    scene.merge({"objects": {"ball": None}})
    with pytest.raises(halfspace.InputError):
        scene["ball.radius"]
    with pytest.raises(halfspace.InputError, match="shape"):
        scene.merge({"objects": {"ball": {"shape": "bal"}}})


def test_a_shape_in_the_studio_has_no_black_side():
    scene = halfspace.Scene()
    scene.merge({"objects": {"ball": {"shape": "uv_sphere"}}})
    labels = scene.labels(["color", "mask"], size=(80, 60), camera=halfspace.Camera.look_at((1, -4, -3)))  # behind the key light
    assert labels["color"][labels["mask"]].min() > 100
    scene["reflections.on"] = False
    assert scene.labels(["color"], size=(80, 60), camera=halfspace.Camera.look_at((1, -4, -3)))["color"].min() == 0


def test_the_tone_curve_applies_to_a_white_background():
    scene = halfspace.Scene()
    scene["background.color"] = 1
    assert (scene.render((8, 8)) == 215).all()  # the number in the guide
