#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the benchmark programs and writes their results and a description of the machine to a JSON file.

The programs are interleaved for each size and workload, round by round, so that changes in the speed of the machine affect all of them.
"""
import argparse
import datetime
import itertools
import json
import os
import statistics
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "docs"))
from generated_sections import cpu_name  # noqa: E402

SPHERES = [f"sphere_{light}_{count}" for light in ("phong", "gouraud", "flat") for count in ("20k", "200k", "2m")]


@dataclass
class Contender:
    """A program with its arguments and thread count."""

    key: str  # name in tables and charts
    command: list
    threads: int
    only: list = field(default_factory=list)  # supported workloads; empty means all

    def draws(self, workload):
        return not self.only or workload in self.only

    def run(self, *arguments):
        """Returns the JSON lines printed by the program, or None if it fails."""
        done = subprocess.run([*self.command, "--threads", str(self.threads), "--json", *arguments], capture_output=True, text=True)
        if done.returncode != 0:
            print(f"{self.key}: {done.stderr.strip()}", file=sys.stderr)
            return None
        return [json.loads(line) for line in done.stdout.splitlines()]


class Progress:
    """Shows the progress of the run in one line, only on a terminal."""

    def __init__(self, total):
        self.total, self.done, self.start = total, 0, time.monotonic()

    def step(self, what):
        self.done += 1
        if not sys.stderr.isatty():
            return
        left = (time.monotonic() - self.start) / self.done * (self.total - self.done)
        print(f"\r\033[K{self.done}/{self.total}  {what}  {left / 60:.0f} min left", end="", file=sys.stderr, flush=True)
        if self.done == self.total:
            print("\r\033[K", end="", file=sys.stderr)


def machine():
    def first_line(command):
        try:
            return subprocess.run(command, capture_output=True, text=True).stdout.strip().splitlines()[0]
        except (OSError, IndexError):
            return ""

    return {
        "cpu": cpu_name(Path("/proc/cpuinfo").read_text()),
        "cores": len(os.sched_getaffinity(0)),
        "system": next((line.split("=", 1)[1].strip().strip('"') for line in open("/etc/os-release") if line.startswith("PRETTY_NAME")), ""),
        "compiler": first_line(["c++", "--version"]),
        "commit": first_line(["git", "describe", "--always", "--dirty"]),
        "date": datetime.date.today().isoformat(),
        "busy_before": busy_cores(),
    }


def busy_cores(seconds=2.0):
    """Returns the number of cores kept busy by other processes. (The load average would include processes that ended a minute ago.)"""
    def busy_ticks():
        user, nice, system, _idle, _waiting, *rest = map(int, Path("/proc/stat").read_text().splitlines()[0].split()[1:9])
        return user + nice + system + sum(rest)

    before = busy_ticks()
    time.sleep(seconds)
    return (busy_ticks() - before) / os.sysconf("SC_CLK_TCK") / seconds


def contenders(args):
    """Returns all programs that can run on this machine. Reports missing ones on stderr."""
    n = args.threads
    found = []

    def add(key, command, threads, only=()):
        contender = Contender(key, [str(c) for c in command], threads, list(only))
        if not Path(command[0]).exists():
            print(f"{key}: skipped, {command[0]} is not built", file=sys.stderr)
        elif contender.run("--only", "sphere_phong_20k", "--size", "16x16", "--seconds", "0") is None:
            print(f"{key}: skipped", file=sys.stderr)
        else:
            found.append(contender)

    for threads in dict.fromkeys((1, n)):
        for build, folder in (("v3", args.v3), ("native", args.native)):
            add(f"halfspace {build} {threads}", [folder / "halfspace-bench"], threads)
        add(f"llvmpipe {threads}", [args.native / "halfspace-bench-gl", "--driver", "llvmpipe"], threads)
    add(f"SwiftShader {n}", [args.native / "halfspace-bench-gl", "--driver", "swiftshader"], n)
    for threads in dict.fromkeys((1, n)):
        add(f"Embree {threads}", [args.native / "halfspace-bench-embree"], threads, SPHERES)
    return found


def measure_rounds(runners, names, sizes, rounds, seconds, extra=(), progress=None):
    """Returns a row per contender, workload and size, with the median over all rounds of each round's median. A round measures all
    combinations, so that a one-minute disturbance affects one round of a row, not all of them."""
    lines = {}
    for _ in range(rounds):
        for size, name, r in itertools.product(sizes, names, runners):
            if not r.draws(name):
                continue
            got = r.run("--only", name, "--size", size, "--seconds", str(seconds), *extra)
            if got:
                lines.setdefault((size, name, r.key), []).append(got[0])
            if progress:
                progress.step(f"{size} {name} {r.key}")
    return [row_of(contender, of_rounds) for (_, _, contender), of_rounds in lines.items()]


def row_of(key, lines):
    medians = [line["ms"] for line in lines]
    row = {"contender": key, **lines[0]}
    row["frames"] = sum(line["frames"] for line in lines)
    row["ms"] = statistics.median(medians)
    row["ms_rounds"] = medians
    row["ms_min"] = min(line["ms_min"] for line in lines)
    row["ms_max"] = max(line["ms_max"] for line in lines)
    row["cpu_ms"] = statistics.median(line["cpu_ms"] for line in lines)
    return row


def names_of(command, *arguments):
    """Returns the names that the program lists with the given arguments."""
    out = subprocess.run([command, *arguments, "--list"], capture_output=True, text=True, check=True).stdout
    return [line.split()[0] for line in out.splitlines()]


def check_pictures(runners, names, sizes, truths):
    """Compares the images of every program with double-precision references. The first run is slow; the references are cached."""
    rows = []
    progress = Progress(len(sizes) * len(runners))
    for size in sizes:
        for r in runners:
            drawn = [name for name in names if r.draws(name)]
            got = r.run("--only", ",".join(drawn), "--size", size, "--seconds", "0", "--check", str(truths)) or []
            rows += [{"contender": r.key, "workload": line["workload"], "size": size, **line["picture"]} for line in got]
            progress.step(f"images {size} {r.key}")
    return rows


def measure_limits(program, threads, quick):
    seconds = "0.01" if quick else "0.05"
    rows = []
    for n in dict.fromkeys((1, threads)):
        out = subprocess.run([program, "--threads", str(n), "--seconds", seconds, "--json"], capture_output=True, text=True, check=True)
        rows += [json.loads(line) for line in out.stdout.splitlines()]
    return rows


def measure_sweeps(runners, args, progress_of):
    """Measures the parameter sweeps; in each row, "x" is the parameter. They run on one thread, which shows the cost most directly."""
    rows = []
    program = args.native / "halfspace-bench"
    rounds = 1 if args.quick else 3
    for sweep in ("triangle_size", "triangle_count", "overdraw", "varyings"):
        chosen = [r for r in runners if r.key in ("halfspace native 1", "llvmpipe 1") or (sweep == "triangle_count" and r.key == "Embree 1")]
        everyone = [Contender(r.key, r.command, r.threads) for r in chosen]
        points = names_of(program, "--sweep", sweep)
        if args.quick:  # the largest meshes take a long time to prepare
            points = [p for p in points if p not in ("triangle_count=3200000", "triangle_count=10000000")]
        progress = progress_of(len(points) * rounds * len(everyone))
        got = measure_rounds(everyone, points, ["1920x1080"], rounds, args.seconds, ("--sweep", sweep), progress)
        rows += [{"sweep": sweep, "x": float(row["workload"].split("=")[1]), **row} for row in got]
    return rows


def measure_table(runners, args, progress_of, table):
    """Measures the "matrix" of states or the composed "scenes" with all threads, at 1920x1080. The pictures rendered with OpenGL are
    compared with those of Halfspace at 320x180."""
    flag = f"--{table}"
    names = names_of(args.native / "halfspace-bench", flag)
    chosen = [r for r in runners if r.key in (f"halfspace v3 {args.threads}", f"halfspace native {args.threads}", f"llvmpipe {args.threads}")]
    pictures = {}
    for r in chosen:
        for line in r.run(flag, "--size", "320x180", "--seconds", "0", "--check", str(args.truths / table)) or []:
            pictures[r.key, line["workload"]] = {key: line[key] for key in ("picture", "difference") if key in line}
    rounds = min(args.rounds, 3)
    everyone = [Contender(r.key, r.command, r.threads) for r in chosen]
    progress = progress_of(len(names) * rounds * len(everyone))
    got = measure_rounds(everyone, names, ["1920x1080"], rounds, min(args.seconds, 0.2), (flag,), progress)
    return [{**row, **pictures.get((row["contender"], row["workload"]), {})} for row in got]


def measure_threads(runners, args, progress_of):
    """Measures thread counts from 1 to twice the number of cores."""
    rows = []
    names = ["layers_b2f", "sphere_phong_20k", "sphere_phong_2m", "shadow_200k", "tiny_1m"]
    counts = sorted({1, 2, 3, 4, args.threads, args.threads + 1, 2 * args.threads} | {2**k for k in range(8) if 2**k <= args.threads})
    rounds = 1 if args.quick else 3
    everyone = [
        Contender(f"{kind} {n}", r.command, n) for n in counts for kind in ("halfspace native", "llvmpipe") for r in runners if r.key == f"{kind} 1"
    ]
    progress = progress_of(len(names) * rounds * len(everyone))
    got = measure_rounds(everyone, names, ["1920x1080"], rounds, args.seconds, progress=progress)
    return [{"sweep": "threads", "x": row["threads"], **row} for row in got]


def measure_sizes(runners, args, progress_of):
    """Measures square images of 256 to 8192 pixels per side."""
    sides = [256, 512, 1024, 2048] + ([] if args.quick else [4096, 8192])
    names = ["clear", "fill", "layers_f2b", "sphere_phong_20k", "tonemap"]
    chosen = [r for r in runners if r.key in ("halfspace native 1", "llvmpipe 1")]
    rounds = 1 if args.quick else 3
    progress = progress_of(len(names) * len(sides) * rounds * len(chosen))
    got = measure_rounds(chosen, names, [f"{side}x{side}" for side in sides], rounds, args.seconds, progress=progress)
    return [{"sweep": "picture_size", "x": int(row["size"].split("x")[0]), **row} for row in got]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--native", type=Path, required=True, help="folder with the programs of the native build")
    parser.add_argument("--v3", type=Path, required=True, help="folder with the programs of the x86-64-v3 build")
    parser.add_argument("--out", type=Path, required=True, help="JSON file to write")
    parser.add_argument("--truths", type=Path, required=True, help="folder of double-precision reference images; missing ones are created")
    parser.add_argument("--only", default="", help="comma-separated list of workloads to run")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--sizes", default="1920x1080,512x512")
    parser.add_argument("--rounds", type=int)
    parser.add_argument("--seconds", type=float, help="time per program and round")
    parser.add_argument("--no-sweeps", action="store_true", help="skip the parameter sweeps")
    parser.add_argument("--no-matrix", action="store_true", help="skip the matrix of states")
    parser.add_argument("--no-scenes", action="store_true", help="skip the composed scenes")
    parser.add_argument("--quick", action="store_true", help="fewer and shorter rounds, without the largest meshes and images")
    args = parser.parse_args()
    args.rounds = args.rounds or (1 if args.quick else 5)
    args.seconds = args.seconds or (0.1 if args.quick else 0.5)

    runners = contenders(args)
    names = args.only.split(",") if args.only else names_of(args.native / "halfspace-bench")
    sizes = args.sizes.split(",")
    results = {"machine": machine(), "threads": args.threads, "rounds": args.rounds, "seconds": args.seconds, "quick": args.quick}
    results["pictures"] = check_pictures(runners, names, sizes, args.truths)
    results["limits"] = measure_limits(args.native / "halfspace-limits", args.threads, args.quick)
    progress = Progress(len(sizes) * args.rounds * sum(r.draws(name) for r in runners for name in names))
    results["workloads"] = measure_rounds(runners, names, sizes, args.rounds, args.seconds, progress=progress)
    results["matrix"] = [] if args.no_matrix else measure_table(runners, args, Progress, "matrix")
    results["scenes"] = [] if args.no_scenes else measure_table(runners, args, Progress, "scenes")
    results["sweeps"] = []
    if not args.no_sweeps:
        for measure in (measure_sweeps, measure_threads, measure_sizes):
            results["sweeps"] += measure(runners, args, Progress)
    results["machine"]["busy_after"] = busy_cores()
    args.out.parent.mkdir(parents=True, exist_ok=True)
    args.out.write_text(json.dumps(results, indent=1) + "\n")


if __name__ == "__main__":
    main()
