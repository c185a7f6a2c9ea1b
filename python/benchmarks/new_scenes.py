#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Renders many new scenes, as a maker of a data set does: ten small objects at 256x256 with color, depth and ids.

  PYTHONPATH=build/release/python python3 python/benchmarks/new_scenes.py [--scenes 1000] [--threads 2] [--profile]

Prints the scenes per second, the processor time per scene, and the growth of memory after the first 50 scenes.
"""

import argparse
import cProfile
import os
import pstats
import resource
import time

import numpy as np

import halfspace


def resident_bytes():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def ball(radius, rows=12, columns=24):
    v, u = np.meshgrid(np.linspace(0, 1, rows + 1), np.linspace(0, 1, columns + 1), indexing="ij")
    normals = np.stack([np.sin(np.pi * v) * np.sin(2 * np.pi * u), np.cos(np.pi * v), np.sin(np.pi * v) * np.cos(2 * np.pi * u)], axis=-1)
    i, j = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    a = (i * (columns + 1) + j).ravel()
    faces = np.concatenate([np.stack([a, a + columns + 1, a + columns + 2], 1), np.stack([a, a + columns + 2, a + 1], 1)])
    return halfspace.Mesh(radius * normals.reshape(-1, 3), faces, normals=normals.reshape(-1, 3))


def render_scene(random, threads):
    scene = halfspace.Scene(threads=threads)
    for _ in range(10):
        place = np.eye(4)
        place[:3, 3] = random.uniform(-2, 2, 3)
        scene.add(ball(random.uniform(0.1, 0.5)), place)
    return scene.labels(["color", "depth", "object"], size=(256, 256))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scenes", type=int, default=1000)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--profile", action="store_true", help="print the functions that take most time")
    arguments = parser.parse_args()
    random = np.random.default_rng(1)
    for _ in range(50):
        render_scene(random, arguments.threads)
    before = resident_bytes()
    profile = cProfile.Profile()
    if arguments.profile:
        profile.enable()
    start, start_cpu = time.perf_counter(), time.process_time()
    for _ in range(arguments.scenes):
        render_scene(random, arguments.threads)
    seconds, cpu = time.perf_counter() - start, time.process_time() - start_cpu
    if arguments.profile:
        profile.disable()
        pstats.Stats(profile).sort_stats("tottime").print_stats(12)
    print(f"{arguments.scenes / seconds:.1f} scenes per second, {1000 * cpu / arguments.scenes:.1f} ms of processor time per scene, "
          f"memory grew by {(resident_bytes() - before) / 2**20:.1f} MiB to at most {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MiB")


if __name__ == "__main__":
    main()
