#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A dataset: random views of random objects with depth, normals, instance masks and bounding boxes.

  dataset.py [--views 1000] [--size 320x240] [--out FOLDER]

Prints the number of frames per second. With --out, writes NPZ files of up to 100 views and a sheet of the labels of the first views.
"""

import argparse
import time
from pathlib import Path

import numpy as np

import halfspace


def tube(turns, rings=24, segments=120):
    """Returns vertices and faces of a knotted tube."""
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, segments, endpoint=False), np.linspace(0, 2 * np.pi, rings, endpoint=False), indexing="ij")
    radius = 1 + 0.35 * np.cos(turns * u)
    center = np.stack([radius * np.cos(2 * u), 0.5 * np.sin(turns * u), radius * np.sin(2 * u)], axis=-1)
    along = np.roll(center, -1, axis=0) - np.roll(center, 1, axis=0)
    side = np.cross(along, (0, 1, 0))
    side /= np.linalg.norm(side, axis=-1, keepdims=True)
    up = np.cross(side, along)
    up /= np.linalg.norm(up, axis=-1, keepdims=True)
    points = center + 0.18 * (np.cos(v)[..., None] * side + np.sin(v)[..., None] * up)
    i, j = np.meshgrid(np.arange(segments), np.arange(rings), indexing="ij")
    a, b = i * rings + j, i * rings + (j + 1) % rings
    c, d = (i + 1) % segments * rings + j, (i + 1) % segments * rings + (j + 1) % rings
    faces = np.concatenate([np.stack([a, b, c], axis=-1).reshape(-1, 3), np.stack([b, d, c], axis=-1).reshape(-1, 3)])
    return points.reshape(-1, 3), faces


def random_transforms(rng, count, spread):
    transforms = np.tile(np.eye(4), (count, 1, 1))
    for transform in transforms:
        rotation, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        transform[:3, :3] = rng.uniform(0.4, 0.9) * rotation * np.linalg.det(rotation)
        transform[:3, 3] = rng.uniform(-spread, spread, 3)
    return transforms


def boxes_of(ids):
    """Returns (id, left, top, right, bottom) of each object in an image of ids."""
    rows = []
    for number in np.unique(ids[ids != halfspace.NO_ID]):
        y, x = np.nonzero(ids == number)
        rows.append((number, x.min(), y.min(), x.max() + 1, y.max() + 1))
    return np.array(rows, dtype=np.int64).reshape(-1, 5)


def sheet_of(labels, count=4):
    """Returns a picture of the first views: color, depth, normals, objects."""
    palette = np.random.default_rng(3).integers(60, 255, (256, 3), np.uint8)
    rows = []
    for i in range(min(count, len(labels["color"]))):
        depth = labels["depth"][i]
        seen = np.isfinite(depth)
        near, far = (depth[seen].min(), depth[seen].max()) if seen.any() else (0.0, 1.0)
        gray = np.where(seen, 255 * (1 - 0.8 * (np.where(seen, depth, near) - near) / max(far - near, 1e-6)), 0).astype(np.uint8)
        normals = np.where(seen[..., None], 127.5 * (labels["camera_normal"][i] + 1), 0).astype(np.uint8)
        ids = np.where((labels["object"][i] != halfspace.NO_ID)[..., None], palette[labels["object"][i] % 256], 0).astype(np.uint8)
        rows.append(np.concatenate([labels["color"][i], np.repeat(gray[..., None], 3, axis=2), normals, ids], axis=1))
    return np.concatenate(rows)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--views", type=int, default=1000)
    arguments.add_argument("--size", default="320x240")
    arguments.add_argument("--out", type=Path)
    args = arguments.parse_args()
    width, height = (int(n) for n in args.size.split("x"))
    rng = np.random.default_rng(7)
    scene = halfspace.Scene()
    scene.set({"samples": 1})
    for transform in random_transforms(rng, 12, 2.5):
        vertices, faces = tube(rng.integers(3, 8))
        scene.add(halfspace.Mesh(vertices, faces, material=halfspace.Material(rng.uniform(0.1, 0.9, 3), roughness=rng.uniform(0.2, 0.9))),
                  transform)
    names = ("color", "depth", "camera_normal", "object")
    seconds, done = 0.0, 0
    while done < args.views:
        directions = rng.normal(size=(min(100, args.views - done), 3))
        eyes = directions / np.linalg.norm(directions, axis=1, keepdims=True) * rng.uniform(5, 8, (len(directions), 1))
        cameras = [halfspace.Camera.look_at(eye, rng.uniform(-0.5, 0.5, 3), up=rng.normal(size=3), near=0.5, far=20) for eye in eyes]
        start = time.perf_counter()
        labels = scene.label_batch(cameras, names, size=(width, height))
        seconds += time.perf_counter() - start
        if args.out:
            args.out.mkdir(parents=True, exist_ok=True)
            boxes = [boxes_of(ids) for ids in labels["object"]]
            np.savez_compressed(args.out / f"views_{done:05}.npz", **labels, boxes=np.concatenate(boxes), box_counts=[len(b) for b in boxes])
            if done == 0:
                sheet_of(labels).view(halfspace.Picture).save(args.out / "labels.png")
        done += len(cameras)
    print(f"{done} views of {width}x{height} with {', '.join(names)}: {done / seconds:.0f} frames/s")


if __name__ == "__main__":
    main()
