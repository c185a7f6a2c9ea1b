#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures how long models with a million triangles take to load, in comparison with tinygltf and tinyobjloader.

  scripts/bench/model_loading.py PROGRAM [--rounds 5] [--columns 1000]
  for example: scripts/bench/model_loading.py build/release/bin/halfspace

The model is a grid of 2 · 500 · columns triangles over a wavy surface, each different. It is written as GLB, as OBJ with and without normals
and as binary PLY. The time of Halfspace is the stage read_ms of `halfspace render --stats=json`: from the start of the command to meshes that
can be drawn, including computed normals, bounds and the fitted camera. The time of the peers is that of their own parse function alone:
tinygltf::TinyGLTF::LoadBinaryFromFile for GLB, and tinyobj::LoadObj for OBJ. PLY is compared with tinygltf, which has no PLY reader, on the
GLB of the same model. The programs take turns. The first round only warms the caches; the median of the other rounds is printed.

Needs g++ and the Debian packages libtinygltf-dev and libtinyobjloader-dev. All files are written to build/model-loading.
"""
import argparse
import array
import json
import math
import os
import statistics
import struct
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "docs"))
from generated_sections import cpu_name  # noqa: E402

FOLDER = Path("build/model-loading")
ROWS = 500
GOAL = 2.0  # times the peer's parse

PEER = r"""
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <tiny_gltf.h>

#include <chrono>
#include <cstdio>

int main(int, char** argv) {
  const std::string file = argv[1];
  std::string warnings, errors;
  std::size_t indices = 0;
  const auto start = std::chrono::steady_clock::now();
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  tinygltf::Model model;
  bool good;
  if (file.ends_with(".obj")) {
    good = tinyobj::LoadObj(&attributes, &shapes, &materials, &warnings, &errors, file.c_str());
  } else {
    good = tinygltf::TinyGLTF().LoadBinaryFromFile(&model, &errors, &warnings, file);
  }
  const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - start;
  for (const auto& shape : shapes) indices += shape.mesh.indices.size();
  if (!model.accessors.empty()) indices = model.accessors.back().count;
  std::printf("%.3f %zu\n", ms.count(), indices);
  return good ? 0 : 1;
}
"""


class Grid:
    """Positions, normals, texture coordinates and triangles of a wavy surface, as flat lists."""

    def __init__(self, columns):
        self.positions, self.normals, self.uvs = array.array("f"), array.array("f"), array.array("f")
        for j in range(ROWS + 1):
            for i in range(columns + 1):
                u, v = i / columns, j / ROWS
                slope_u, slope_v = 2.0 * math.cos(20.0 * u), -1.5 * math.sin(15.0 * v)  # derivatives of the height
                length = math.sqrt(slope_u * slope_u + slope_v * slope_v + 1.0)
                self.positions.extend((u, 0.1 * math.sin(20.0 * u) + 0.1 * math.cos(15.0 * v), v))
                self.normals.extend((-slope_u / length, 1.0 / length, -slope_v / length))
                self.uvs.extend((u, v))
        self.triangles = array.array("I")
        for j in range(ROWS):
            for i in range(columns):
                a = j * (columns + 1) + i
                b = a + columns + 1
                self.triangles.extend((a, b, a + 1, a + 1, b, b + 1))


def groups(values, width):
    return zip(*[iter(values)] * width)


def write_obj(grid, path, normals):
    with open(path, "w", encoding="ascii") as out:
        out.writelines("v %.6f %.6f %.6f\n" % p for p in groups(grid.positions, 3))
        if normals:
            out.writelines("vn %.6f %.6f %.6f\n" % n for n in groups(grid.normals, 3))
            out.writelines("vt %.6f %.6f\n" % t for t in groups(grid.uvs, 2))
        corner = "%d/%d/%d" if normals else "%d"
        line = f"f {corner} {corner} {corner}\n"
        for triangle in groups(grid.triangles, 3):
            out.write(line % tuple(i + 1 for i in triangle for _ in range(3 if normals else 1)))


def write_glb(grid, path):
    data = [grid.positions.tobytes(), grid.normals.tobytes(), grid.uvs.tobytes(), grid.triangles.tobytes()]
    views, binary = [], b""
    for part in data:
        views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(part)})
        binary += part
    count = len(grid.positions) // 3
    types = [(5126, count, "VEC3"), (5126, count, "VEC3"), (5126, count, "VEC2"), (5125, len(grid.triangles), "SCALAR")]
    accessors = [{"bufferView": i, "componentType": c, "count": n, "type": t} for i, (c, n, t) in enumerate(types)]
    for key, reduce in (("min", min), ("max", max)):
        accessors[0][key] = [reduce(grid.positions[k::3]) for k in range(3)]
    document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3}]}],
                "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": len(binary)}]}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    header = struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(binary), len(text), 0x4E4F534A)
    path.write_bytes(header + text + struct.pack("<II", len(binary), 0x004E4942) + binary)


def write_ply(grid, path):
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(grid.positions) // 3}"]
    header += [f"property float {name}" for name in ("x", "y", "z", "nx", "ny", "nz")]
    header += [f"element face {len(grid.triangles) // 3}", "property list uchar uint vertex_indices", "end_header", ""]
    vertices = b"".join(struct.pack("<6f", *p, *n) for p, n in zip(groups(grid.positions, 3), groups(grid.normals, 3)))
    faces = b"".join(struct.pack("<BIII", 3, *t) for t in groups(grid.triangles, 3))
    path.write_bytes("\n".join(header).encode() + vertices + faces)


def build_peer():
    source, program = FOLDER / "peer.cpp", FOLDER / "peer"
    source.write_text(PEER, encoding="ascii")
    subprocess.run(["g++", "-std=c++20", "-O3", "-DNDEBUG", "-march=native", "-w", source, "-o", program], check=True)
    return program


def run(command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"model_loading.py: {' '.join(map(str, command))} failed: {done.stderr.strip()}")
    return done.stdout


def our_ms(program, file):
    out = run([program, "render", file, "--size", "16x16", "-o", FOLDER / "picture.png", "--stats=json"])
    return json.loads(out)["read_ms"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--columns", type=int, default=1000)
    arguments = parser.parse_args()
    FOLDER.mkdir(parents=True, exist_ok=True)
    grid = Grid(arguments.columns)
    files = {"GLB": "grid.glb", "OBJ": "grid.obj", "OBJ without normals": "bare.obj", "binary PLY": "grid.ply"}
    write_glb(grid, FOLDER / "grid.glb")
    write_obj(grid, FOLDER / "grid.obj", True)
    write_obj(grid, FOLDER / "bare.obj", False)
    write_ply(grid, FOLDER / "grid.ply")
    peer = build_peer()
    cpu = cpu_name(Path("/proc/cpuinfo").read_text(encoding="utf-8"))
    print(f"{len(grid.triangles) // 3} triangles, {cpu}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}\n")
    print("| model | Halfspace | peer | its time | Halfspace / peer |\n|---|---|---|---|---|")
    misses = 0
    for name, file in files.items():
        peer_file = "grid.glb" if file.endswith(".ply") else file
        times = []
        for _ in range(arguments.rounds + 1):
            peer_ms, indices = run([peer, FOLDER / peer_file]).split()
            if int(indices) != len(grid.triangles):
                sys.exit(f"model_loading.py: {peer_file}: the peer read {indices} indices; expected {len(grid.triangles)}")
            times.append((our_ms(arguments.program, FOLDER / file), float(peer_ms)))
        ours, theirs = (statistics.median(t) for t in zip(*times[1:]))
        misses += ours > GOAL * theirs
        peer_name = "tinyobjloader" if file.endswith(".obj") else "tinygltf"
        if file.endswith(".ply"):
            peer_name += " (GLB)"
        print(f"| {name} | {ours:.0f} ms | {peer_name} | {theirs:.0f} ms | {ours / theirs:.2f} |", flush=True)
    print(f"\n{misses} models take more than {GOAL:g} times as long as the peer's parse")
    return 1 if misses else 0


if __name__ == "__main__":
    sys.exit(main())
