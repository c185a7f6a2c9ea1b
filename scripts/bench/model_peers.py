#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Renders model files with halfspace and with f3d, compares the times, and draws both pictures side by side.

  scripts/bench/model_peers.py PROGRAM FOLDER|FILE... [--rounds 5] [--size 1280x720]
  for example: xvfb-run scripts/bench/model_peers.py build/release/bin/halfspace ../shared/data/gltf

A time is the wall time from the start of the process to the finished PNG file, with the defaults of both programs. The programs take turns.
The first round only warms the caches; the median of the other rounds is printed. f3d needs a display (DISPLAY), for example Xvfb, which
must be running before the measurement. The pictures are written to out/peers, and the sheet to out/peers.png (needs ImageMagick's montage).
"""
import argparse
import os
import shutil
import statistics
import subprocess
import sys
import threading
import time
from pathlib import Path

EXTENSIONS = {".obj", ".gltf", ".glb", ".ply", ".stl"}
TIME_LIMIT = 120  # seconds


def model_files(paths):
    for path in map(Path, paths):
        files = [path] if path.is_file() else sorted(path.rglob("*"))
        yield from (f for f in files if f.suffix.lower() in EXTENSIONS)


def seconds(command):
    """Returns the wall time of a command, or None if it fails or takes longer than TIME_LIMIT."""
    start = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    limit = threading.Timer(TIME_LIMIT, process.kill)
    limit.start()
    code = process.wait()  # with a timeout, Python would poll only every 50 ms
    took = time.perf_counter() - start
    limit.cancel()
    return took if code == 0 else None


def median_times(commands, rounds):
    """Returns the median time of each command, or None for a command that fails."""
    times = [[] for _ in commands]
    for i in range(rounds + 1):
        for command, measured in zip(commands, times):
            if None in measured:
                continue
            elapsed = seconds(command)
            if i > 0 or elapsed is None:
                measured.append(elapsed)
    return [None if None in measured else statistics.median(measured) for measured in times]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("models", nargs="+")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--size", default="1280x720")
    arguments = parser.parse_args()
    for needed in ("f3d", "montage"):
        if shutil.which(needed) is None:
            sys.exit(f"model_peers.py: {needed} is not installed; expected the Debian packages f3d and imagemagick")
    if "DISPLAY" not in os.environ:
        sys.exit("model_peers.py: DISPLAY is not set; expected a display for f3d, for example with xvfb-run")
    folder = Path("out/peers")
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    cells, slower = [], 0
    print(f"{'model':48} {'halfspace':>9} {'f3d':>6}  f3d/halfspace")
    for file in model_files(arguments.models):
        name = f"{file.parent.name}-{file.name}"
        pictures = [folder / f"{name}-{renderer}.png" for renderer in ("halfspace", "f3d")]
        ours, theirs = median_times(
            [[arguments.program, "render", file, "--size", arguments.size, "-o", pictures[0]],
             ["f3d", file, "--output", pictures[1], "--resolution", arguments.size.replace("x", ",")]], arguments.rounds)
        known = ours is not None and theirs is not None
        slower += known and theirs < 2 * ours
        text = [f"{t:.3f}" if t is not None else "fails" for t in (ours, theirs)]
        print(f"{name:48} {text[0]:>9} {text[1]:>6}  " + (f"{theirs / ours:.2f}" if known else ""), flush=True)
        for picture, t in zip(pictures, text):
            cells += ["-label", f"{picture.stem} {t} s", str(picture) if picture.exists() else "xc:white"]
    subprocess.run(["montage", *cells, "-tile", "4x", "-geometry", "480x270+4+4", "out/peers.png"], check=True)
    print(f"out/peers.png; {slower} models for which f3d takes less than twice as long")


if __name__ == "__main__":
    main()
