#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures the time of `halfspace render earth --size 512x512` from process start to finished file, and compares it with a minimum.

  scripts/bench/start_to_file.py [--bin DIR] [--rounds N]     default: build/release/bin, 15
  scripts/bench/start_to_file.py --before DIR [--scenes NAME,...] [--bin DIR] [--rounds N]

The minimum is given by halfspace-start-to-file-bound (a build target): it links the same libraries, generates the maps of the scene, sleeps for the
duration of an additional frame and writes the same pixels. It runs in two variants: with color and height maps, and with normal maps
derived from the heights as well. The three programs are interleaved, and the minimum and median of each are printed. The time that
halfspace-start-to-file-bound spends on reading the pixels is subtracted.

With --before, the same time is measured for other scenes (default: day-night,shapes) at 1920x1080, alternating between the program in --bin
and the one in the folder DIR.
"""
import argparse
import json
import os
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

SIZE = "512x512"
MAP_WIDTH = 2048  # the width that the scene selects for an image of this size


def wall_ms(command):
    """Returns the wall time of a command and its output."""
    start = time.perf_counter()
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True)
    return 1000 * (time.perf_counter() - start), done.stdout


def frame_ms(program, folder):
    """Returns the time per additional frame, excluding the output, from the difference between 21 frames and one."""

    def render_ms(frames):
        pictures = os.path.join(folder, "frame%02d.png")
        _, report = wall_ms([program, "render", "earth", "--size", SIZE, "--frames", f"0..{frames - 1}", "--stats=json", "-o", pictures])
        return json.loads(report)["render_ms"]

    return min((render_ms(21) - render_ms(1)) / 20 for _ in range(3))


def compare_builds(programs, scenes, rounds):
    """Prints the times of two programs, (before, after), from start to file."""
    with tempfile.TemporaryDirectory() as folder:
        for scene in scenes:
            times = [[], []]
            for _ in range(rounds):
                for program, list_of in zip(programs, times):
                    list_of.append(wall_ms([program, "render", scene, "--size", "1920x1080", "-o", os.path.join(folder, "picture.png")])[0])
            (low, middle), (new_low, new_middle) = ((min(t), statistics.median(t)) for t in times)
            print(f"{scene:12} before: minimum {low:6.1f} ms, median {middle:6.1f} ms; after: minimum {new_low:6.1f} ms, median {new_middle:6.1f} ms; "
                  f"{low / new_low:.2f} and {middle / new_middle:.2f} times as fast")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=Path(__file__).resolve().parents[2] / "build/release/bin")
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--before", type=Path, help="folder of a halfspace program to compare with")
    parser.add_argument("--scenes", default="day-night,shapes", help="with --before: scenes to render")
    arguments = parser.parse_args()
    if arguments.before:
        return compare_builds([str(arguments.before / "halfspace"), str(arguments.bin / "halfspace")], arguments.scenes.split(","), arguments.rounds)
    program, least = str(arguments.bin / "halfspace"), str(arguments.bin / "halfspace-start-to-file-bound")
    with tempfile.TemporaryDirectory() as folder:
        picture, copy = os.path.join(folder, "earth.png"), os.path.join(folder, "copy.png")
        frame = frame_ms(program, folder)
        times = {"render": [], "heights": [], "normals": []}
        for _ in range(arguments.rounds):
            times["render"].append(wall_ms([program, "render", "earth", "--size", SIZE, "-o", picture])[0])
            for maps in ("heights", "normals"):
                ms, read_ms = wall_ms([least, maps, str(MAP_WIDTH), f"{frame:.3f}", picture, copy])
                times[maps].append(ms - float(read_ms))
    print(f"additional frame: {frame:.2f} ms; {arguments.rounds} rounds")
    for name, what in (("render", "halfspace render earth"), ("heights", "colors and heights"), ("normals", "colors, heights and normals")):
        low, middle = min(times[name]), statistics.median(times[name])
        ratio = "" if name == "render" else f"   render takes {min(times['render']) / low:.2f} and {statistics.median(times['render']) / middle:.2f} times as long"
        print(f"{what:30} minimum {low:6.1f} ms, median {middle:6.1f} ms{ratio}")


if __name__ == "__main__":
    main()
