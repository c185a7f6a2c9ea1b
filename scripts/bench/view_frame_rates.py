#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures the overhead of the window of halfspace-view, for the table in docs/howto/view.md.

    view_frame_rates.py [--programs build/release/bin] [--frames 200] [NAME...]

Each scene is rendered without a window, in a window with closed panels and in a window with open panels, three times in alternation; the
table shows the medians. The window overhead is the part of the frame time that is not spent on rendering the scene. The window is on a
virtual X server (Xvfb). NAME selects scenes; the default is all.
"""
import argparse
import os
import pathlib
import statistics
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = ROOT.parent / "shared" / "data"
SPHERE = """{ "version": 1, "cameras": { "main": { "position": [0, 0.5, 3], "fov": 45 } },
  "lights": { "sun": { "type": "directional", "direction": [1, 1, 1] } },
  "objects": { "ball": { "shape": "uv_sphere", "latitudes": 263, "longitudes": 512, "color": [0.8, 0.4, 0.2] } },
  "animations": { "turn": { "type": "rate", "target": "ball.rotation", "rate": [0, 15, 0] } } }"""
SCENES = {
    "earth": ["earth"],
    "moon": ["moon"],
    "day-night": ["day-night"],
    "particles, 100,000": ["particles", "--set", "particles.count=100000", "--set", "particles.arrangement=ball"],
    "horse.ply": [str(DATA / "meshes/horse.ply")],
    "MetalRoughSpheresNoTextures": [str(DATA / "gltf/MetalRoughSpheresNoTextures/glTF-Binary/MetalRoughSpheresNoTextures.glb")],
    "sphere, 268k triangles": ["SPHERE"],
}


def start_server():
    """Starts an X server without a screen. Returns it and its display."""
    read_end, write_end = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(write_end), "-screen", "0", "1920x1200x24"], pass_fds=[write_end],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(write_end)
    with os.fdopen(read_end) as number:
        return server, ":" + number.readline().strip()


def frame_times(program, arguments, options, environment):
    """Returns the frame time, and the part of it that is not spent on rendering the scene."""
    command = [program, *arguments, "--size", "1280x720", "--threads", "2", *options]
    lines = subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout.splitlines()
    values = {name: value for name, value in (line.split() for line in lines)}
    frame = float(values["frame_ms"])
    return frame, frame - float(values["prepare_ms"]) - float(values["draw_ms"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--programs", type=pathlib.Path, default=ROOT / "build/release/bin")
    parser.add_argument("--frames", default="200")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("names", nargs="*")
    args = parser.parse_args()
    server, display = start_server()
    environment = {**os.environ, "DISPLAY": display}
    environment.pop("SDL_VIDEODRIVER", None)
    print("| scene | without window | window | panels open | frames per second | window overhead | overhead with panels |\n"
          "|---|---|---|---|---|---|---|")
    try:
        with tempfile.TemporaryDirectory() as folder:
            sphere, panels = pathlib.Path(folder) / "sphere.json", pathlib.Path(folder) / "panels"
            sphere.write_text(SPHERE)
            panels.write_text("0 key tab\n")
            for name in args.names or SCENES:
                scene = [str(sphere) if word == "SPHERE" else word for word in SCENES[name]]
                frames = ["--frames", args.frames]
                kinds = {"none": [*frames, "--no-window"], "window": frames, "panels": [*frames, "--events", str(panels)]}
                times = {kind: [] for kind in kinds}
                for _ in range(args.rounds):
                    for kind, options in kinds.items():
                        times[kind].append(frame_times(args.programs / "halfspace-view", scene, options, environment))
                none, window, opened = ([statistics.median(column) for column in zip(*times[kind])] for kind in kinds)
                print(f"| {name} | {none[0]:.1f} ms | {window[0]:.1f} ms | {opened[0]:.1f} ms | {1000 / window[0]:.0f} | {window[1]:.1f} ms | "
                      f"{opened[1]:.1f} ms |", flush=True)
    finally:
        server.terminate()
        server.wait()


if __name__ == "__main__":
    main()
