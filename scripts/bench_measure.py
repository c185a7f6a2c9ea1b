#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the programs of the benchmark side by side and writes what they print, with the machine it came from, as one JSON file.

For each size and workload the programs take turns, round after round, so that a machine that changes its speed changes it for all.
"""
import argparse
import datetime
import json
import os
import platform
import statistics
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

SPHERES = [f"sphere_{light}_{count}" for light in ("phong", "gouraud", "flat") for count in ("20k", "200k", "2m")]


@dataclass
class Contender:
    """A program with its arguments, at one number of threads."""

    key: str  # as tables and charts name it
    command: list
    threads: int
    only: list = field(default_factory=list)  # workloads it draws; empty: all

    def draws(self, workload):
        return not self.only or workload in self.only

    def run(self, *arguments):
        """The JSON lines that the program prints; None where it fails."""
        done = subprocess.run([*self.command, "--threads", str(self.threads), "--json", *arguments], capture_output=True, text=True)
        if done.returncode != 0:
            print(f"{self.key}: {done.stderr.strip()}", file=sys.stderr)
            return None
        return [json.loads(line) for line in done.stdout.splitlines()]


class Progress:
    """One line that says how far the run is; nothing unless on a terminal."""

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

    cpu = next((line.split(":", 1)[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")), platform.machine())
    return {
        "cpu": cpu,
        "cores": len(os.sched_getaffinity(0)),
        "system": next((line.split("=", 1)[1].strip().strip('"') for line in open("/etc/os-release") if line.startswith("PRETTY_NAME")), ""),
        "compiler": first_line(["c++", "--version"]),
        "commit": first_line(["git", "describe", "--always", "--dirty"]),
        "date": datetime.date.today().isoformat(),
        "load_before": os.getloadavg()[0],
    }


def contenders(args):
    """All that can run here. What is absent is named once on stderr."""
    n = args.threads
    found = []

    def add(key, command, threads, only=()):
        contender = Contender(key, [str(c) for c in command], threads, list(only))
        if not Path(command[0]).exists():
            print(f"{key}: left out, {command[0]} is not built", file=sys.stderr)
        elif contender.run("--only", "sphere_phong_20k", "--size", "16x16", "--seconds", "0") is None:
            print(f"{key}: left out", file=sys.stderr)
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
    """Lines of (contender, workload, size): the median over rounds of each round's median, and how far rounds lie apart."""
    rows = []
    for size in sizes:
        for name in names:
            lines = {r.key: [] for r in runners if r.draws(name)}
            for _ in range(rounds):
                for r in runners:
                    if r.key not in lines:
                        continue
                    got = r.run("--only", name, "--size", size, "--seconds", str(seconds), *extra)
                    if got:
                        lines[r.key].append(got[0])
                    if progress:
                        progress.step(f"{size} {name} {r.key}")
            rows += [row_of(key, of_rounds) for key, of_rounds in lines.items() if of_rounds]
    return rows


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


def names_of(command):
    return [line.split()[0] for line in subprocess.run([command, "--list"], capture_output=True, text=True, check=True).stdout.splitlines()]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--native", type=Path, required=True, help="folder of the native build's programs")
    parser.add_argument("--v3", type=Path, required=True, help="folder of the x86-64-v3 build's programs")
    parser.add_argument("--out", type=Path, required=True, help="the JSON file to write")
    parser.add_argument("--only", default="", help="these workloads alone, by comma")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--sizes", default="1920x1080,512x512")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=0.5, help="of each program in each round")
    args = parser.parse_args()

    runners = contenders(args)
    names = args.only.split(",") if args.only else names_of(args.native / "halfspace-bench")
    sizes = args.sizes.split(",")
    progress = Progress(len(sizes) * args.rounds * sum(r.draws(name) for r in runners for name in names))
    results = {"machine": machine(), "threads": args.threads}
    results["workloads"] = measure_rounds(runners, names, sizes, args.rounds, args.seconds, progress=progress)
    results["machine"]["load_after"] = os.getloadavg()[0]
    args.out.parent.mkdir(parents=True, exist_ok=True)
    args.out.write_text(json.dumps(results, indent=1) + "\n")


if __name__ == "__main__":
    main()
