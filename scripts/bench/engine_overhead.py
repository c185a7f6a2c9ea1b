#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures what each way of docs/howto/scale.md costs, and prints a table in Markdown and a line about lists of models.

  PYTHONPATH=BUILD/python scripts/bench/engine_overhead.py BUILD [FRAMES [MODELS]]

Renders small frames with two workers of one thread each: FRAMES (default 200; a tenth of them with one process per frame) and twice as many.
The difference gives the time per frame, and what remains is the time to start. The overhead is the time per frame and worker, minus that of one
process with one thread. Engines that are not installed are left out.

Then renders a list of MODELS models (default 1000) with 256 quads each at 256x256 in one process, and a tenth of them with one process each.
"""

import math
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

SCENE = ["shapes", "--size", "160x90", "--threads", "1"]
SIZE = (160, 90)
ROUNDS = 3


def run(command, **more):
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **more)


def engines(program, folder):
    """Yields names, numbers of workers, and functions that render a number of frames."""

    def render(*more):
        return [program, "render", *SCENE, "-o", f"{folder}/{{frame}}.png", *more]

    yield "one process", 1, lambda n: run(render("--frames", f"0..{n - 1}"))
    if shutil.which("parallel"):
        yield "GNU parallel, one process per shard", 2, lambda n: run(
            ["parallel", "-j", "2", *render("--frames", f"0..{n - 1}", "--shard", "{}/2"), ":::", "0", "1"])
        yield "GNU parallel, one process per frame", 2, lambda n: run(
            ["parallel", "-j", "2", *render("--frames", "{}"), ":::", *map(str, range(n))])
    if shutil.which("mpirun") and (Path(program).parent / "halfspace-mpi.so").exists():
        mpirun = ["mpirun", "--allow-run-as-root", "--oversubscribe", "--bind-to", "none", "-n", "2"]
        yield "MPI, one rank per core", 2, lambda n: run([*mpirun, *render("--frames", f"0..{n - 1}", "--mpi")])
    if shutil.which("srun") and subprocess.run(["sinfo"], capture_output=True).returncode == 0:
        # Not sbatch --wait, which looks for the end of a job only every few seconds.
        yield "Slurm, one task per shard", 2, lambda n: run(
            ["srun", "-n", "2", "sh", "-c", " ".join(render("--frames", f"0..{n - 1}")) + " --shard $SLURM_PROCID/2"])
    import halfspace

    scene = halfspace.Scene.load("shapes", threads=1)

    def frames(n, client):
        halfspace.render_frames(scene, n, size=SIZE, out=f"{folder}/{{frame}}.png", client=client)

    def pool(n):
        with ProcessPoolExecutor(2) as executor:
            frames(n, executor)

    yield "Python, ProcessPoolExecutor", 2, pool
    try:
        from distributed import Client, LocalCluster
    except ImportError:
        return

    def dask(n):
        with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=50) as cluster, Client(cluster) as client:
            frames(n, client)

    yield "Python, Dask", 2, dask


def write_model(path, number):
    """Writes a wavy square of 16 x 16 quads."""
    with open(path, "w") as out:
        for i in range(17 * 17):
            out.write(f"v {i % 17} {i // 17} {math.sin(i + number):.6f}\n")
        for i in range(16 * 16):
            corner = i // 16 * 17 + i % 16 + 1
            out.write(f"f {corner} {corner + 1} {corner + 18} {corner + 17}\n")


def seconds_of(work):
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def compare_lists(program, folder, count):
    """Prints the times of one process for a list of models and of one process per model."""
    models = [f"{folder}/model{i}.obj" for i in range(count)]
    for i, model in enumerate(models):
        write_model(model, i)
    render = [program, "render", "--size", "256x256"]
    one = seconds_of(lambda: run([*render, *models, "-o", f"{folder}/one-{{name}}.png"]))
    some = models[:max(count // 10, 1)]
    each = seconds_of(lambda: [run([*render, model, "-o", f"{folder}/each-{Path(model).stem}.png"]) for model in some])
    each *= count / len(some)
    print(f"\n{count} models: {one:.1f} s in one process, {each:.1f} s in {count} processes (measured with {len(some)}), "
          f"{each / one:.1f} times as long")


def main():
    program, count = str(Path(sys.argv[1]).resolve() / "bin" / "halfspace"), int(sys.argv[2]) if len(sys.argv) > 2 else 200
    models = int(sys.argv[3]) if len(sys.argv) > 3 else 1000
    with tempfile.TemporaryDirectory(prefix="halfspace-") as folder:
        print("| engine | start, s | ms per frame | overhead, ms per frame and worker |\n|---|---:|---:|---:|")
        base = 0.0
        for name, workers, work in engines(program, folder):
            frames = max(count // 10, 1) if "per frame" in name else count
            best = {}
            for n in ROUNDS * [frames, 2 * frames]:
                best[n] = min(best.get(n, 1e9), seconds_of(lambda: work(n)))
            per_frame = (best[2 * frames] - best[frames]) / frames
            base = base or per_frame
            overhead = "" if name == "one process" else f"{1e3 * (workers * per_frame - base):.2f}"
            print(f"| {name} | {max(best[frames] - frames * per_frame, 0.0):.2f} | {1e3 * per_frame:.2f} | {overhead} |", flush=True)
        compare_lists(program, folder, models)


if __name__ == "__main__":
    main()
