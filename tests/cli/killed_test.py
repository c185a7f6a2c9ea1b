#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Kills processes that render, and checks that no picture is lost or damaged.

  killed_test.py BUILD [COUNT]

Ranks of MPI, shards, lists and workers of Dask are killed (SIGKILL) at random moments until COUNT processes were killed (default 6). After
each, complete files must be those of an undisturbed run. The command is then repeated with --resume, except that Dask itself renders the frames
of a killed worker again. The pictures must then be those of an undisturbed run, without partial files. Exits with 77, which CTest reports as
skipped, if the program was built without MPI.
"""

import hashlib
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from dask_python import python_with_dask  # noqa: E402

MPIRUN = ["mpirun", "--allow-run-as-root", "--oversubscribe", "--bind-to", "none", "-n", "3"]
FRAMES = ["moon", "--size", "96x54", "--frames", "0..59"]


# Renders the frames with two workers of Dask into the folder of the first argument. Prints the processes of the workers.
DASK = """
import os, sys, distributed, halfspace
if __name__ == "__main__":
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=50) as cluster:
        with distributed.Client(cluster) as client:
            print(*client.run(os.getpid).values(), flush=True)
            halfspace.render_frames("moon", 60, size=(96, 54), out=sys.argv[1] + "/{frame}.png", client=client, batch=1)
"""


def hashes(folder):
    """The contents of all files of a folder."""
    return {p.name: hashlib.sha256(p.read_bytes()).hexdigest() for p in sorted(folder.iterdir())} if folder.exists() else {}


def damaged(folder, want):
    """The complete files of a folder that are not as expected."""
    return [name for name, content in hashes(folder).items() if not name.endswith(".part") and content != want.get(name)]


def run_dask(dask, script, folder, delay=None):
    """Renders the frames with Dask. Kills a worker after a while if `delay` is given. Returns whether one was killed before the end."""
    python, environment = dask
    process = subprocess.Popen([python, str(script), str(folder)], env=environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    workers = [int(pid) for pid in process.stdout.readline().split()]
    killed = False
    if delay is not None:
        time.sleep(delay)
        try:
            os.kill(random.choice(workers), signal.SIGKILL)
            killed = True
        except ProcessLookupError:
            pass  # all frames were rendered before
    assert process.wait(timeout=120) == 0, "rendering with Dask failed"
    return killed


def write_models(folder):
    for i in range(40):
        (folder / f"m{i:02}.obj").write_text(f"v 0 0 0\nv {1 + i / 10} 0 0\nv 0 1 {i}\nv 1 1 1\nf 1 2 3\nf 2 4 3\n")
    (folder / "list.txt").write_text("".join(f"{folder}/m{i:02}.obj\n" for i in range(40)))
    return folder / "list.txt"


def pids_of(program):
    """The processes that run the program."""
    result = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                if os.readlink(entry / "exe") == str(program):
                    result.append(int(entry.name))
            except OSError:
                pass
    return result


def kill_one(program, commands, delay):
    """Starts the commands, kills one process of the program after a while, and waits. Returns whether one was killed."""
    processes = [subprocess.Popen(c, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) for c in commands]
    time.sleep(delay)
    pids = pids_of(program)
    if pids:
        os.kill(random.choice(pids), signal.SIGKILL)
    for process in processes:
        process.wait(timeout=120)
    return bool(pids)


def main():
    build, count = Path(sys.argv[1]).resolve(), int(sys.argv[2]) if len(sys.argv) > 2 else 6
    # A copy of its own name, so that the processes of other tests are not killed.
    original = build / "bin" / "halfspace"
    if not (build / "bin" / "halfspace-mpi.so").exists() or shutil.which("mpirun") is None:
        print("skipped: the program was built without MPI (scripts/install_deps.sh --mpi)")
        return 77
    random.seed(7)
    with tempfile.TemporaryDirectory(prefix="halfspace-test-") as name:
        folder = Path(name)
        program = folder / "halfspace"
        shutil.copy(original, program)
        for tool in (build / "bin").glob("halfspace-*"):
            (folder / tool.name).symlink_to(tool)
        models = folder / "models"
        models.mkdir()
        listed = ["--list", str(write_models(models)), "--size", "96x54"]

        def render(arguments, out, place, *more):
            return [str(program), "render", *arguments, "-o", str(folder / out / place), "--resume", *more]

        engines = {
            "mpi": lambda out: [MPIRUN + render(FRAMES, out, "{frame}.png", "--mpi")],
            "shards": lambda out: [render(FRAMES, out, "{frame}.png", "--shard", f"{i}/3", "--threads", "1") for i in range(3)],
            "list": lambda out: [render(listed, out, "{name}.png")],
            "list by mpi": lambda out: [MPIRUN + render(listed, out, "{name}.png", "--mpi")],
        }
        expected = {}
        for kind, arguments, place in (("frames", FRAMES, "{frame}.png"), ("list", listed, "{name}.png")):
            start = time.time()
            subprocess.run(render(arguments, kind, place), check=True, stderr=subprocess.DEVNULL)
            expected[kind] = (hashes(folder / kind), time.time() - start)
        names = list(engines)
        dask, script = python_with_dask(build), folder / "frames.py"
        if dask is None:
            print("without Dask, which is not installed")
        else:
            script.write_text(DASK)
            start = time.time()
            run_dask(dask, script, folder / "dask")
            # Files that the Python module writes have no fingerprint.
            expected["dask"] = (hashes(folder / "dask"), time.time() - start)
            names.append("dask")
        killed, resumed = 0, 0
        for attempt in range(20 * count):
            if killed == count:
                break
            engine = names[attempt % len(names)]
            want, seconds = expected["list" if engine.startswith("list") else "dask" if engine == "dask" else "frames"]
            out = folder / f"killed-{attempt}"
            if engine == "dask":
                killed += run_dask(dask, script, out, random.uniform(0.0, 1.0))
            else:
                commands = engines[engine](out.name)
                killed += kill_one(program, commands, random.uniform(0.1, 0.4 + seconds))
                assert not damaged(out, want), f"{engine}: {damaged(out, want)} are damaged"
                resumed += len(hashes(out)) < len(want)
                for command in commands:
                    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=120)
            got = hashes(out)
            assert got == want, f"{engine}: {sorted(set(got) ^ set(want))} missing or too many, {[n for n in got if got[n] != want.get(n)]} differ"
            shutil.rmtree(out)
        assert killed == count, f"only {killed} processes could be killed"
        print(f"{killed} processes killed, {resumed} runs continued with pictures missing: all pictures as expected, 0 partial files")
    return 0


if __name__ == "__main__":
    sys.exit(main())
