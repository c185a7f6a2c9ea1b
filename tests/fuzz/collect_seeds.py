#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Collects seeds for the fuzz targets: all model files of at most 64 KiB in some folders.

  tests/fuzz/collect_seeds.py SEEDS FOLDER...    writes to SEEDS/FORMAT (obj, mtl, gltf, ply, stl)

The name of a seed is the hash of its contents, so that files with the same name are all kept. A .gltf file with buffers in other files is
converted to .glb if the buffers are small; otherwise a fuzz target would only see that the buffer is missing.
"""
import hashlib
import json
import struct
import sys
from pathlib import Path
from urllib.parse import unquote

FORMATS = {".obj": "obj", ".mtl": "mtl", ".gltf": "gltf", ".glb": "gltf", ".ply": "ply", ".stl": "stl"}
MAX_BYTES = 64 << 10


def as_glb(path, text):
    """Returns the file as GLB, or None if it has no buffers in small files in its folder."""
    try:
        document = json.loads(text)
        buffers = document["buffers"]
        files = [path.parent / unquote(b["uri"]) for b in buffers]
        if sum(f.stat().st_size for f in files) > MAX_BYTES:
            return None
        data = [f.read_bytes() for f in files]
        starts = []
        binary = b""
        for b in data:
            starts.append(len(binary))
            binary += b + bytes(-len(b) % 4)
        for view in document["bufferViews"]:
            view["byteOffset"] = view.get("byteOffset", 0) + starts[view["buffer"]]
            view["buffer"] = 0
        document["buffers"] = [{"byteLength": len(binary)}]
    except (ValueError, LookupError, TypeError, AttributeError, OSError, RecursionError):  # damaged files are seeds as they are
        return None
    chunk = json.dumps(document, separators=(",", ":")).encode()
    chunk += b" " * (-len(chunk) % 4)
    glb = struct.pack("<4sIIII", b"glTF", 2, 28 + len(chunk) + len(binary), len(chunk), 0x4E4F534A) + chunk
    return glb + struct.pack("<II", len(binary), 0x004E4942) + binary


def main():
    if len(sys.argv) < 3:
        sys.exit("usage: collect_seeds.py SEEDS FOLDER...")
    count = {}
    for file in (f for folder in sys.argv[2:] for f in sorted(Path(folder).rglob("*"))):
        name = FORMATS.get(file.suffix.lower())
        if name is None or not file.is_file() or file.stat().st_size > MAX_BYTES:
            continue
        contents = file.read_bytes()
        if file.suffix.lower() == ".gltf":
            contents = as_glb(file, contents) or contents
        if len(contents) > MAX_BYTES:
            continue
        target = Path(sys.argv[1]) / name
        target.mkdir(parents=True, exist_ok=True)
        (target / hashlib.sha256(contents).hexdigest()[:16]).write_bytes(contents)
        count[name] = count.get(name, 0) + 1
    print("seeds:", ", ".join(f"{n} {name}" for name, n in sorted(count.items())))


if __name__ == "__main__":
    main()
