# SPDX-License-Identifier: Apache-2.0
"""Signals during renders: Ctrl-C ends them at the next tile, and the scene can be used afterwards."""

import signal
import threading
import time

import numpy as np
import pytest

import halfspace
from conftest import sphere
from halfspace import draw

# Takes half a minute on two threads. Only the memory of finished tiles is used.
HUGE = (16384, 16384)
# From the signal to the exception: 50 ms until the signal is noticed, and the tiles that have started. The rest allows for other programs.
PATIENCE = 5.0


def ball_scene():
    vertices, faces, normals, _ = sphere()
    scene = halfspace.Scene()
    scene["samples"] = 8
    scene.add(halfspace.Mesh(vertices, faces, normals=normals))
    return scene


@pytest.fixture
def timer():
    """Returns a function that starts a timer whose signal raises KeyboardInterrupt, as Ctrl-C does."""
    old = signal.signal(signal.SIGALRM, signal.default_int_handler)
    try:
        yield lambda seconds=0.15: signal.setitimer(signal.ITIMER_REAL, seconds)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, old)


def interrupt(timer, function):
    timer()
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        function()
    assert time.monotonic() - start < PATIENCE


@pytest.mark.parametrize("function", [
    lambda scene: scene.render(HUGE),
    lambda scene: scene.render(HUGE, alpha=True),
    lambda scene: scene.labels(["depth"], size=HUGE),
    lambda scene: scene.labels(["color", "mask"], size=HUGE),
    lambda scene: next(scene.frames(1, size=HUGE)),
    lambda scene: scene.render_batch([None, None, None], size=(9000, 9000)),
], ids=["render", "alpha", "labels", "color labels", "frames", "first of a batch"])
def test_a_render_ends_at_the_next_tile(timer, function):
    scene = ball_scene()
    expected = scene.render((32, 24))
    interrupt(timer, lambda: function(scene))
    assert np.array_equal(scene.render((32, 24)), expected)


def test_a_batch_ends_at_the_next_tile_of_all_threads(timer):
    scene = ball_scene()
    expected = scene.render((32, 24))
    started = []

    def progress(done, total):
        if not started:  # the first picture is rendered by all threads; from now on, each thread renders its own
            started.append(time.monotonic())
            timer()

    away = halfspace.Camera.look_at((0, 0, 9), (0, 0, 10))  # the first picture shows nothing and takes little time
    with pytest.raises(KeyboardInterrupt):
        scene.render_batch([away] + [None] * 20, size=(4000, 4000), progress=progress)
    assert time.monotonic() - started[0] < PATIENCE
    assert np.array_equal(scene.render_batch([None] * 3, size=(32, 24))[2], expected)


def test_a_pass_ends_at_the_next_tile(timer):
    image = np.zeros((8192, 8192, 4), np.uint8)
    triangle = np.array([[-1, -1, 0], [3, -1, 0], [-1, 3, 0]], np.float32)
    colors = np.ones((3, 4), np.float32)
    p = draw.Pass(image, samples=8)

    def run():
        for _ in range(50):  # each draw is blended over the whole image; more draws would make a task of the setup take seconds
            p.draw(draw.colored(np.eye(4)), positions=triangle, colors=colors, state=draw.State(blend="alpha"))
        p.run()

    interrupt(timer, run)
    p.draw(draw.colored(np.eye(4)), positions=triangle, colors=colors)
    assert draw.Pass(image[:64, :64].copy()).run() == 0


def test_an_exception_of_progress_stops_the_other_pictures():
    scene = ball_scene()
    done = []

    def progress(count, total):
        done.append(count)
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        scene.render_batch([None] * 20, size=(16, 16), progress=progress)
    assert done == [1]


def test_a_handler_that_uses_the_scene_gets_an_error_instead_of_waiting_for_itself(timer):
    scene = halfspace.Scene.load("moon", threads=1)
    scene["surface.width"] = 512  # takes a while to prepare
    signal.signal(signal.SIGALRM, lambda number, frame: scene["samples"])
    signal.setitimer(signal.ITIMER_REAL, 0.02, 0.02)
    with pytest.raises(halfspace.InputError, match="scene: is used by a signal handler"):
        scene.render((16, 16))
    signal.setitimer(signal.ITIMER_REAL, 0)
    assert scene.render((16, 16)).shape == (16, 16, 3)


def test_other_threads_are_not_interrupted():
    scene, other = ball_scene(), ball_scene()
    expected = other.render((600, 400))
    pictures = []
    thread = threading.Thread(target=lambda: pictures.extend(other.render((600, 400)) for _ in range(20)))
    old = signal.signal(signal.SIGALRM, signal.default_int_handler)
    try:
        thread.start()
        signal.setitimer(signal.ITIMER_REAL, 0.1)
        with pytest.raises(KeyboardInterrupt):
            scene.render(HUGE)
    finally:
        signal.signal(signal.SIGALRM, old)
        thread.join()
    assert len(pictures) == 20 and all(np.array_equal(picture, expected) for picture in pictures)
