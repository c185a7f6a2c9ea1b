#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How long `halfspace render earth --size 512x512` takes from start to file, beside the least that such a picture needs.

  scripts/start_to_file.py [--bin DIR] [--rounds N]     default: build/release/bin, 15

The least is halfspace-least-earth (build the target of that name): it links the same libraries, makes the scene's maps, waits as long as
a further frame takes and writes the same pixels. Twice: its maps are colours and heights, or the normals made of these as well. The three take
turns; the least and the median of each are printed. What halfspace-least-earth needs to read the pixels does not count.
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
MAP_WIDTH = 2048  # what the scene chooses for a picture of this size


def wall_ms(command):
    """Wall time of a command, and what it printed."""
    start = time.perf_counter()
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True)
    return 1000 * (time.perf_counter() - start), done.stdout


def frame_ms(program, folder):
    """What a further frame takes, its picture not written: of 21 frames and of one the difference."""

    def render_ms(frames):
        pictures = os.path.join(folder, "frame%02d.png")
        _, report = wall_ms([program, "render", "earth", "--size", SIZE, "--frames", f"0..{frames - 1}", "--stats=json", "-o", pictures])
        return json.loads(report)["render_ms"]

    return min((render_ms(21) - render_ms(1)) / 20 for _ in range(3))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=Path(__file__).parent.parent / "build/release/bin")
    parser.add_argument("--rounds", type=int, default=15)
    arguments = parser.parse_args()
    program, least = str(arguments.bin / "halfspace"), str(arguments.bin / "halfspace-least-earth")
    with tempfile.TemporaryDirectory() as folder:
        picture, copy = os.path.join(folder, "earth.png"), os.path.join(folder, "copy.png")
        frame = frame_ms(program, folder)
        times = {"render": [], "heights": [], "normals": []}
        for _ in range(arguments.rounds):
            times["render"].append(wall_ms([program, "render", "earth", "--size", SIZE, "-o", picture])[0])
            for maps in ("heights", "normals"):
                ms, read_ms = wall_ms([least, maps, str(MAP_WIDTH), f"{frame:.3f}", picture, copy])
                times[maps].append(ms - float(read_ms))
    print(f"a further frame: {frame:.2f} ms; {arguments.rounds} rounds")
    for name, what in (("render", "halfspace render earth"), ("heights", "colours and heights"), ("normals", "colours, heights and normals")):
        low, middle = min(times[name]), statistics.median(times[name])
        ratio = "" if name == "render" else f"   render takes {min(times['render']) / low:.2f} and {statistics.median(times['render']) / middle:.2f} times as long"
        print(f"{what:30} least {low:6.1f} ms, median {middle:6.1f} ms{ratio}")


if __name__ == "__main__":
    main()
