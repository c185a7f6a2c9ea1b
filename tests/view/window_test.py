#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests halfspace-view from outside: the effect of each key and the mouse on the picture, saving, dropping files, and its window.

  window_test.py PROGRAM_FOLDER [TEST...]

Events are pushed by --events, and the frames are written by --record. The class Desktop uses real key presses under Xvfb with openbox,
wmctrl and xdotool. A test is skipped if a program that it needs is not installed; the message names the package.
"""
import base64
import functools
import json
import os
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
from png_rows import read_rows  # noqa: E402

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import no_skips  # noqa: E402

SKIPPED = 77  # ctest shows the test as skipped
PROGRAMS = Path(".")
WIDTH, HEIGHT = 320, 180
MESSAGE_ROWS = 40  # at the bottom, where messages are shown
BOX = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"  # a corner of a box, as an OBJ file
STILL = ["--set", "animation.speed=0"]
# With LeakSanitizer: system libraries leak, so the exit code is ignored. A leak is ours if its stack trace contains one of our functions.
LEAKS_ARE_READ = {"LSAN_OPTIONS": "exitcode=0"}


def program(name):
    return str(PROGRAMS / name)


def picture_of(path):
    """Returns the rows of a picture above the messages."""
    return read_rows(path)[2][:HEIGHT - MESSAGE_ROWS]


def rendered_to(out, scene, *options):
    """Writes a picture with `halfspace render` and returns its rows above the messages."""
    subprocess.run([program("halfspace"), "render", scene, "-o", out, "--size", f"{WIDTH}x{HEIGHT}", *options], check=True)
    return picture_of(out)


@functools.cache
def rendered_scene(scene, *options):
    with tempfile.TemporaryDirectory(prefix="halfspace-view-") as folder:
        return rendered_to(Path(folder) / "rendered.png", scene, *options)


def changed_columns(before, after):
    """Returns the columns in which two pictures differ, in any of the rows above the messages."""
    pairs = list(zip(before[:-2 * MESSAGE_ROWS:20], after[::20]))
    return [x for x in range(len(before[0]) // 3) if any(a[3 * x:3 * x + 3] != b[3 * x:3 * x + 3] for a, b in pairs)]


class Folder(unittest.TestCase):
    """Tests with a temporary working folder."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="halfspace-view-")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.addTypeEqualityFunc(list, self.compare_lists)

    def compare_lists(self, first, second, msg=None):
        """Compares pictures and other lists. The default implementation takes minutes to describe how two pictures differ."""
        if first != second:
            self.fail(f"{msg or 'lists differ'}: {str(first)[:100]} … {str(second)[:100]}")

    def rendered(self, scene, *options):
        """Returns the picture that `halfspace render` writes. Pictures of shipped scenes are rendered once."""
        if isinstance(scene, str):
            return rendered_scene(scene, *options)
        return rendered_to(self.folder / "rendered.png", scene, *options)


class Events(Folder):
    """Tests with events that are pushed before a frame, using SDL's driver without a display."""

    def run_events(self, scene, events, frames, *options, size=f"{WIDTH}x{HEIGHT}", scale="1"):
        """Runs the program and returns the files of the recorded frames. events: lines of an event file."""
        (self.folder / "events").write_text("".join(line + "\n" for line in events))
        record = self.folder / "record"
        shutil.rmtree(record, ignore_errors=True)
        record.mkdir()
        environment = {**os.environ, "SDL_VIDEODRIVER": "dummy", **LEAKS_ARE_READ}
        done = subprocess.run(
            [program("halfspace-view"), scene, "--size", size, "--frames", str(frames), "--threads", "2", "--ui-scale", scale,
             "--events", "events", "--record", "record", *options], cwd=self.folder, env=environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("halfspace::", done.stderr)
        return sorted(record.glob("frame_*.png"))

    def pictures(self, *arguments):
        return [picture_of(file) for file in self.run_events(*arguments)]

    def test_keys_match_the_options_of_render(self):
        cases = [
            ("earth", "0", ["--shading", "none"]),
            ("earth", "1", ["--shading", "flat"]),
            ("earth", "2", ["--shading", "gouraud"]),
            ("earth", "3", ["--shading", "phong"]),
            ("earth", "n", ["--set", "earth.normal=bump"]),
            ("earth", "t", ["--set", "earth.textured=false"]),
            ("earth", "v", ["--set", "earth.visible=false"]),
            ("earth", "x", ["--camera", "inside"]),
            ("earth", "]", ["--set", "post.hdr=true", "--set", "post.tone=none", "--set", "post.exposure=1.189207115002721"]),
            ("three-lights", "y", ["--set", "shadow.method=none"]),
            ("three-lights", "[", ["--set", "post.hdr=true", "--set", "post.tone=none", "--set", "post.exposure=0.8408964152537145"]),
            ("moon", "n", ["--set", "moon.normals=vertex"]),
            ("moon", "y", ["--set", "shadow.method=none"]),
            ("day-night", "1", ["--shading", "flat"]),
            ("day-night", "t", [part for name in ("ground", "houses", "trunks", "crowns", "boulder", "wall")
                                for part in ("--set", f"{name}.textured=false")]),
            ("particles", "v", ["--set", "particles.count=0"]),
        ]
        for scene, key, settings in cases:
            with self.subTest(scene=scene, key=key):
                before, after = self.pictures(scene, [f"1 key {key}"], 2, *STILL)
                self.assertEqual(before, self.rendered(scene, *STILL), "the first frame is the picture of the scene")
                self.assertEqual(after, self.rendered(scene, *STILL, *settings))
                if key != "3":  # the rate that the scene already has
                    self.assertNotEqual(before, after)

    def test_a_key_is_visible_in_the_frame_before_which_it_is_pushed(self):
        frames = self.pictures("earth", ["2 key t", "4 key t", "5 down a", "7 up a"], 9, *STILL)
        changes = [a != b for a, b in zip(frames, frames[1:])]
        self.assertEqual(changes, [False, True, False, True, True, True, False, False])

    def test_movements_change_the_view_and_x_restores_it(self):
        keys = "wasdrfqezc"
        events = [line for i, key in enumerate(keys) for line in (f"{2 * i + 1} key {key}", f"{2 * i + 2} key x")]
        frames = self.pictures("earth", events, 2 * len(keys) + 1, *STILL)
        for i, key in enumerate(keys):
            with self.subTest(key=key):
                self.assertNotEqual(frames[2 * i + 1], frames[0])
                self.assertEqual(frames[2 * i + 2], frames[0])
        moved = frames[1::2]
        self.assertEqual(len({tuple(picture) for picture in moved}), len(keys), "each key has a view of its own")

    def test_the_mouse_orbits_pans_and_zooms(self):
        for name, events in [("orbit", ["1 mouse 100 80", "2 button 1 down", "3 mouse 130 90", "4 button 1 up"]),
                             ("pan", ["1 mouse 100 80", "2 button 3 down", "3 mouse 130 90", "4 button 3 up"]),
                             ("zoom", ["3 wheel 2"])]:
            with self.subTest(name):
                frames = self.pictures("earth", [*events, "5 mouse 10 10"], 7, *STILL)
                changes = [a != b for a, b in zip(frames, frames[1:])]
                self.assertEqual(changes, [False, False, True, False, False, False])

    def test_space_stops_time(self):
        frames = self.pictures("earth", ["2 key space", "5 key space"], 7)
        changes = [a != b for a, b in zip(frames, frames[1:])]
        self.assertEqual(changes, [True, False, False, False, True, True])

    def test_overlays_and_panels_are_drawn_over_the_picture(self):
        for key, shown in [("o", 6), ("h", 1), ("tab", 1), ("i", 1), ("p", 1)]:
            with self.subTest(key=key):
                # ImGui shows a new window in its second frame, when its size is known.
                files = self.run_events("three-lights", [f"{2 * i + 1} key {key}" for i in range(shown + 1)], 2 * shown + 3)
                frames = [read_rows(f)[2][:HEIGHT - MESSAGE_ROWS * (key != "p")] for f in files[::2]]
                self.assertEqual(len({tuple(frame) for frame in frames[:-1]}), shown + 1, "each step has a picture of its own")
                if key != "p":
                    self.assertEqual(frames[-1], frames[0], "the last press restores it")

    def test_long_work_shows_a_note(self):
        model = self.folder / "box.obj"
        model.write_text(BOX)
        frames = self.run_events("three-lights", ["2 mouse 10 10", "3 key p", "4 key p", "5 key f12", f"7 drop {model}"], 9)
        notes = {file.name: read_rows(file)[2] for file in (self.folder / "record").glob("busy_*.png")}
        self.assertEqual(sorted(notes), ["busy_0000.png", "busy_0003.png", "busy_0005.png", "busy_0007.png"])
        for before, name in [(2, "busy_0003.png"), (4, "busy_0005.png"), (6, "busy_0007.png")]:
            middle = [row[3 * WIDTH // 2 - 60:3 * WIDTH // 2 + 60] for row in notes[name][HEIGHT // 2 - 8:HEIGHT // 2 + 8]]
            picture = [row[3 * WIDTH // 2 - 60:3 * WIDTH // 2 + 60] for row in read_rows(frames[before])[2][HEIGHT // 2 - 8:HEIGHT // 2 + 8]]
            self.assertNotEqual(middle, picture, f"{name}: the note is in the middle of the window")

    def test_the_history_does_not_cover_its_pixel(self):
        for x, y in [(40, 30), (40, 85), (40, 100), (40, 170), (300, 170)]:
            with self.subTest(pixel=(x, y)):
                frames = [read_rows(file)[2] for file in self.run_events("three-lights", [f"1 mouse {x} {y}", "2 key p"], 6)]
                self.assertEqual(frames[5][y][3 * x:3 * x + 3], frames[0][y][3 * x:3 * x + 3], "the pixel has its color")
                changed = [row for row in range(HEIGHT - MESSAGE_ROWS) if frames[5][row][:3 * WIDTH // 4] != frames[0][row][:3 * WIDTH // 4]]
                self.assertGreater(len(changed), 20, "the history is shown")

    def test_v_hides_the_picked_object(self):
        # The cube is at the center of the picture.
        events = [f"1 mouse {WIDTH // 2} {HEIGHT // 2}", "2 key p", "3 key v", "4 key p"]
        frames = self.pictures("three-lights", events, 6)
        self.assertEqual(frames[5], self.rendered("three-lights", "--set", "cube.visible=false"))

    def test_f12_saves_a_scene_that_render_reproduces(self):
        for scene, options in [("earth", []), ("day-night", ["--time", "30.3"]), ("particles", [])]:
            with self.subTest(scene):
                events = ["2 key q", "3 key w", "4 key 1", "5 key ]", "6 key f12"]
                frames = self.pictures(scene, events, 7, *options)
                saved, text = self.folder / f"{scene}-view-1.png", self.folder / f"{scene}-view-1.json"
                again = self.folder / "again.png"
                subprocess.run([program("halfspace"), "render", text, "-o", again, "--size", f"{WIDTH}x{HEIGHT}"], check=True)
                self.assertEqual(read_rows(saved), read_rows(again))
                self.assertNotEqual(picture_of(saved), self.rendered(scene))
                if scene != "day-night":  # its time is divided by the length of a day, which can change the last bit
                    rows = HEIGHT - 2 * MESSAGE_ROWS  # the message can have two lines
                    self.assertEqual(picture_of(saved)[:rows], frames[5][:rows], "what was shown when the key was pressed")

    def test_f12_never_replaces_a_file(self):
        self.run_events("particles", ["1 key f12", "2 key f12"], 3)
        self.assertTrue((self.folder / "particles-view-2.png").exists())

    def test_a_model_is_viewed_as_render_views_it(self):
        model, panorama = self.folder / "box.obj", self.folder / "panorama.png"
        model.write_text(BOX)
        subprocess.run([program("halfspace"), "render", "earth", "-o", panorama, "--size", "64x32"], check=True)
        plain = self.rendered(model)
        for options in (["--yaw", "120", "--pitch", "40", "--zoom", "1.5"], ["--eye", "2,2,2", "--look-at", "0,0.5,0", "--fov", "50"],
                        ["--up-axis", "z"], ["--environment", panorama, "--background", "environment"], ["--background", "#203040"],
                        ["--set", "post.exposure=1"], ["--inside"]):
            with self.subTest(options):
                first = self.pictures(model, [], 1, *options)[0]
                self.assertEqual(first, self.rendered(model, *options))
                self.assertTrue(first != plain, "the option has an effect")

    def test_keys_act_on_the_materials_of_a_model(self):
        texture, material, model = self.folder / "checks.png", self.folder / "square.mtl", self.folder / "square.obj"
        subprocess.run([program("halfspace"), "render", "earth", "-o", texture, "--size", "64x64"], check=True)
        material.write_text("newmtl m\nKd 0.9 0.8 0.7\nmap_Kd checks.png\nmap_Bump -bm 0.1 checks.png\n")
        model.write_text("mtllib square.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3 4/4\n")
        plain = self.rendered(model)
        for key, setting in [("t", "model.textured=false"), ("n", "model.normal=none"), ("0", "model.shading=none")]:
            with self.subTest(key=key):
                before, after = self.pictures(model, [f"1 key {key}"], 2)
                self.assertEqual(before, plain)
                self.assertEqual(after, self.rendered(model, "--set", setting))
                self.assertNotEqual(after, plain)

    def test_without_its_color_map_a_cut_out_keeps_its_shape(self):
        """The map of a square is red, and transparent in its right half."""
        def chunk(kind, body):
            return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

        row = b"\0" + b"\xff\0\0\xff" * 8 + b"\xff\0\0\0" * 8
        png = (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 16, 16, 8, 6, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(row * 16)) +
               chunk(b"IEND", b""))
        corners = [(-1, -1), (1, -1), (1, 1), (-1, -1), (1, 1), (-1, 1)]
        data = struct.pack("<18f12f", *(v for x, y in corners for v in (x, y, 0)), *(0.5 + 0.5 * v for corner in corners for v in corner))
        encoded = {kind: f"data:{kind};base64," + base64.b64encode(body).decode() for kind, body in
                   (("image/png", png), ("application/octet-stream", data))}
        model = self.folder / "square.gltf"
        model.write_text(json.dumps({
            "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
            "materials": [{"alphaMode": "MASK", "doubleSided": True, "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0}}],
            "textures": [{"source": 0}], "images": [{"uri": encoded["image/png"]}],
            "buffers": [{"uri": encoded["application/octet-stream"], "byteLength": len(data)}],
            "bufferViews": [{"buffer": 0, "byteLength": 72}, {"buffer": 0, "byteOffset": 72, "byteLength": 48}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]},
                          {"bufferView": 1, "componentType": 5126, "count": 6, "type": "VEC2"}]}))
        options = ["--no-floor", "--yaw", "0", "--set", "samples=1", "--set", "shadow.method=none"]
        before, after = self.pictures(model, ["1 key t"], 2, *options)
        background = before[0][:3]
        shape = [[row[3 * x:3 * x + 3] != background for x in range(WIDTH)] for row in before]
        self.assertGreater(sum(map(sum, shape)), 1000)
        self.assertEqual([[row[3 * x:3 * x + 3] != background for x in range(WIDTH)] for row in after], shape)
        self.assertNotEqual(after, before)

    def test_turntable_moves_the_camera_around_the_model(self):
        model = self.folder / "box.obj"
        model.write_text(BOX)
        turn = self.folder / "turn.png"
        subprocess.run([program("halfspace"), "render", model, "-o", turn, "--size", f"{WIDTH}x{HEIGHT}", "--turntable", "8"], check=True)
        expected = [picture_of(self.folder / f"turn_{i:04}.png") for i in (1, 2, 3)]
        self.assertEqual(self.pictures(model, [], 3, "--turntable", "8"), expected)

    def test_a_dropped_model_is_opened_and_a_bad_file_is_not(self):
        model = self.folder / "box.obj"
        model.write_text(BOX)
        (self.folder / "bad.obj").write_text("f 1 2 3\n")
        frames = self.run_events("earth", [f"1 drop {model}", f"2 drop {self.folder / 'bad.obj'}", "3 drop nothing.json"], 4, *STILL)
        frames = [picture_of(frame)[:HEIGHT - 3 * MESSAGE_ROWS] for frame in frames]  # messages contain long paths
        self.assertNotEqual(frames[1], frames[0])
        self.assertEqual(frames[2], frames[1])
        self.assertEqual(frames[3], frames[1])

    def test_the_picture_follows_the_size_of_the_window(self):
        sizes = [read_rows(file)[:2] for file in self.run_events("earth", ["1 size 200 120"], 4, *STILL)]
        self.assertEqual(sizes[0], (WIDTH, HEIGHT))
        self.assertEqual(sizes[-1], (200, 120))

    def test_the_interface_has_the_requested_scale(self):
        def box(scale):
            """Returns the width and height of the shortcut overlay: the area of the pixels that change when h is pressed."""
            first, second = [read_rows(f)[2] for f in self.run_events("earth", ["1 key h"], 3, *STILL, size="1000x900", scale=scale)[::2]]
            rows = [y for y in range(800) if first[y] != second[y]]
            row = rows[len(rows) // 2]
            columns = [x for x in range(1000) if first[row][3 * x:3 * x + 3] != second[row][3 * x:3 * x + 3]]
            return columns[-1] - columns[0], rows[-1] - rows[0]

        small, large = box("0.75"), box("1.5")
        # If no scalable font is installed, the font is rounded to whole pixels: 10 and 21.
        self.assertAlmostEqual(large[0] / small[0], 2, delta=0.2)
        self.assertAlmostEqual(large[1] / small[1], 2, delta=0.3)

    def test_a_timed_run_reports_its_times(self):
        for option in ([], ["--no-window"]):
            done = subprocess.run([program("halfspace-view"), "earth", "--size", "64x64", "--frames", "3", *option],
                                  env={**os.environ, "SDL_VIDEODRIVER": "dummy"}, capture_output=True, text=True, check=True)
            lines = dict(line.split() for line in done.stdout.splitlines())
            self.assertEqual(lines["frames"], "3")
            self.assertGreater(float(lines["frame_ms"]), 0.0)

    def test_mistakes_are_reported_in_one_line(self):
        environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER")}
        for arguments, code, words in [(["earth"], 3, "display"), (["erth"], 3, "earth"), (["earth", "--size", "0x0"], 2, "--size"),
                                       (["earth", "--no-window"], 2, "--frames"), (["earth", "--ui-scale", "9"], 2, "--ui-scale"),
                                       (["earth", "--frames", "0"], 2, "--frames"), (["earth", "--camera", "nort"], 3, "north"),
                                       (["earth", "--set", "earth.x=1"], 3, "earth.x"), ([], 2, "SCENE"),
                                       (["earth", "--yaw", "20"], 2, "--yaw"), (["earth", "--shading", "phnog"], 2, "phong"),
                                       (["earth", "--max-pixels", "1000"], 3, "--max-pixels")]:
            with self.subTest(arguments):
                done = subprocess.run([program("halfspace-view"), *arguments], env=environment, capture_output=True, text=True)
                self.assertEqual(done.returncode, code)
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
                self.assertIn(words, done.stderr)


@unittest.skipIf(any(shutil.which(tool) is None for tool in ("Xvfb", "openbox", "wmctrl", "xdotool", "import")),
                 "a program is absent (Debian and Ubuntu: xvfb openbox wmctrl xdotool imagemagick)")
class Desktop(Folder):
    """A window on an X server with a window manager."""

    @classmethod
    def setUpClass(cls):
        read_end, write_end = os.pipe()
        # With -noreset: without it, the server resets itself when its only client leaves. If that is wmctrl, which asks for the window manager,
        # the server closes the connection of the window manager that starts at that moment, and the window manager ends.
        cls.server = subprocess.Popen(["Xvfb", "-displayfd", str(write_end), "-noreset", "-screen", "0", "1280x1024x24", "-dpi", "96"],
                                      pass_fds=[write_end], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        cls.addClassCleanup(cls.end, cls.server)
        os.close(write_end)
        with os.fdopen(read_end) as number:
            cls.environment = {**os.environ, "DISPLAY": ":" + number.readline().strip(), **LEAKS_ARE_READ}
        cls.environment.pop("SDL_VIDEODRIVER", None)
        cls.manager = subprocess.Popen(["openbox"], env=cls.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        cls.addClassCleanup(cls.end, cls.manager)
        cls.wait_for(cls.manager_runs, "window manager starts")

    @staticmethod
    def end(process):
        process.terminate()
        process.wait()

    @classmethod
    def manager_runs(cls):
        """Returns whether a window manager answers. Fails if it has ended."""
        if cls.manager.poll() is not None:
            raise AssertionError(f"openbox ended with code {cls.manager.returncode}")
        return cls.tool("wmctrl", "-m", check=False)

    @classmethod
    def tool(cls, *command, check=True):
        return subprocess.run([str(word) for word in command], env=cls.environment, check=check, capture_output=True, text=True, timeout=30).stdout

    @staticmethod
    def wait_for(condition, what):
        """Waits until the condition holds. The limit is long because of busy machines, and because of the first start of a newly built
        program: a window once took more than 20 s to open while other tests ran."""
        limit = 180
        end = time.monotonic() + limit
        while time.monotonic() < end:
            if value := condition():
                return value
            time.sleep(0.05)
        raise AssertionError(f"{what}: did not happen within {limit} s")

    def start(self, scene, *options, size=f"{WIDTH}x{HEIGHT}"):
        self.process = subprocess.Popen([program("halfspace-view"), scene, "--size", size, "--threads", "2", *options],
                                        cwd=self.folder, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.stop)
        self.window = self.wait_for(self.window_id, "window opens")
        self.tool("xdotool", "windowactivate", "--sync", self.window)

    def window_id(self):
        """Returns the window of the program, or nothing if it is not visible yet. Fails if the program has ended."""
        if self.process.poll() is not None:
            self.fail(f"halfspace-view ended with code {self.process.returncode}: {self.process.communicate()[1]}")
        find = ("xdotool", "search", "--all", "--onlyvisible", "--pid", self.process.pid, "--name", "^halfspace-view")
        return next(iter(self.tool(*find, check=False).split()), None)

    def stop(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
        self.process.communicate()

    def screenshot(self):
        out = self.folder / "screen.png"
        self.tool("import", "-silent", "-window", self.window, "-depth", "8", f"PNG24:{out}")
        return read_rows(out)

    def wait_for_picture(self, expected, what):
        self.wait_for(lambda: self.screenshot()[2][:HEIGHT - MESSAGE_ROWS] == expected, what)

    def press(self, key):
        self.tool("xdotool", "key", "--window", self.window, key)

    def test_each_key_changes_the_picture_as_render_does(self):
        self.start("earth", *STILL)
        plain = self.rendered("earth", *STILL)
        self.wait_for_picture(plain, "first frame")
        for key, settings, back in [("0", ["--shading", "none"], "3"), ("1", ["--shading", "flat"], "3"), ("2", ["--shading", "gouraud"], "3"),
                                    ("t", ["--set", "earth.textured=false"], "t"), ("v", ["--set", "earth.visible=false"], "v")]:
            with self.subTest(key=key):
                self.press(key)
                self.wait_for_picture(self.rendered("earth", *STILL, *settings), f"key {key}")
                self.press(back)
                self.wait_for_picture(plain, f"key {back} after {key}")
        self.press("n")
        self.wait_for_picture(self.rendered("earth", *STILL, "--set", "earth.normal=bump"), "key n")
        self.press("n")
        self.wait_for_picture(self.rendered("earth", *STILL, "--set", "earth.normal=none"), "key n again")
        self.press("n")
        for key in ("w", "a", "s", "d", "r", "f", "q", "e", "z", "c", "h", "Tab", "i", "o"):
            with self.subTest(key=key):
                self.press(key)
                self.wait_for(lambda: self.screenshot()[2][:HEIGHT - MESSAGE_ROWS] != plain, f"key {key}")
                self.press({"o": "shift+o", "h": "h", "Tab": "Tab", "i": "i"}.get(key, "x"))
                self.wait_for_picture(plain, f"restored after {key}")

    def test_at_rest_the_statistics_do_not_change(self):
        self.start("earth", *STILL, size="640x400")
        self.wait_for(lambda: any(self.screenshot()[2][0]), "first frame")  # the background is not black
        plain = self.screenshot()[2][:200]  # above the message, which disappears after a while
        self.press("i")
        self.wait_for(lambda: self.screenshot()[2][:200] != plain, "statistics are shown")
        pictures = []
        for _ in range(4):
            time.sleep(0.5)  # the window is drawn every 0.2 s
            pictures.append(self.screenshot()[2][:200])
        self.assertEqual(len({tuple(rows) for rows in pictures}), 1)

    def test_keys_do_nothing_while_a_text_field_has_the_focus(self):
        self.start("earth", *STILL)
        plain = self.rendered("earth", *STILL)
        self.wait_for_picture(plain, "first frame")
        left = lambda rows: [row[:3 * WIDTH // 2] for row in rows]  # noqa: E731  the part next to the panel
        self.press("Tab")
        self.wait_for(lambda: self.screenshot()[2][:HEIGHT - MESSAGE_ROWS] != plain, "panel opens")
        self.tool("xdotool", "mousemove", "--window", self.window, WIDTH // 2 + 12, 60, "click", "1")
        time.sleep(0.5)
        self.tool("xdotool", "mousemove", "--window", self.window, 10, 10)  # so that there is no tooltip
        time.sleep(0.5)
        self.tool("xdotool", "type", "--window", self.window, "ttv1")
        time.sleep(1.0)
        self.assertEqual(left(self.screenshot()[2][:HEIGHT - MESSAGE_ROWS]), left(plain))

    def test_the_window_manager_resizes_and_closes_the_window(self):
        self.start("earth", *STILL)
        self.tool("wmctrl", "-i", "-r", self.window, "-e", "0,20,20,400,300")
        self.wait_for(lambda: self.screenshot()[:2] == (400, 300), "window has the new size")
        out = self.folder / "large.png"
        subprocess.run([program("halfspace"), "render", "earth", "-o", out, "--size", "400x300", *STILL], check=True)
        expected = read_rows(out)[2][:300 - MESSAGE_ROWS]
        self.wait_for(lambda: self.screenshot()[2][:300 - MESSAGE_ROWS] == expected, "picture has the new size")
        self.tool("wmctrl", "-i", "-c", self.window)
        errors = self.process.communicate(timeout=60)[1]
        self.assertEqual(self.process.returncode, 0, errors)
        self.assertNotIn("halfspace::", errors)

    def test_the_default_scale_follows_the_desktop(self):
        def panel_width(*options):
            self.start("earth", *STILL, *options, size="1000x400")
            self.wait_for(lambda: any(self.screenshot()[2][0]), "first frame")  # the background is not black
            before = self.screenshot()[2]
            self.press("Tab")
            changed = self.wait_for(lambda: changed_columns(before, self.screenshot()[2]), "panel opens")
            self.stop()
            return 1000 - changed[0]

        self.assertAlmostEqual(panel_width("--ui-scale", "1"), 380, delta=3)
        resources = self.folder / "resources"  # as `xrdb -merge` would store them in the server
        resources.write_text("Xft.dpi: 120\n")
        self.environment = {**self.environment, "XENVIRONMENT": str(resources)}
        self.assertAlmostEqual(panel_width(), 475, delta=3)


if __name__ == "__main__":
    if len(sys.argv) < 2 or not Path(sys.argv[1]).is_dir():
        sys.exit("window_test.py: expected the folder of the built programs")
    PROGRAMS = Path(sys.argv.pop(1)).resolve()
    if not (PROGRAMS / "halfspace-view").exists():
        print("window_test.py: skipped: halfspace-view is not built (Debian and Ubuntu: libsdl2-dev libimgui-dev)")
        sys.exit(SKIPPED)
    sys.exit(no_skips.main(sys.argv[1:]))
