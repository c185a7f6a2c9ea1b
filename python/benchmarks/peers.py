#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares frames per second with VTK: the same mesh, picture size and camera, with one light, no shadow and one sample per
pixel. Times include returning the picture as an array.

  peers.py [--size 1280x720] [--frames 60] [--rounds 5] [MESH.ply ...]

VTK (Debian: python3-vtk9) needs a display, for example that of a running Xvfb. Without VTK, only Halfspace is measured. The programs take
turns, and the best round of each is reported. Prints a Markdown table.
"""

import argparse
import time
from pathlib import Path

import numpy as np

import halfspace

YAWS = np.radians(np.arange(0, 360, 7.5))


def read_ply(path):
    """Returns positions and triangles of a binary PLY file whose vertex properties are floats."""
    data = Path(path).read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    header = data[:end].decode().split("\n")
    counts = {line.split()[1]: int(line.split()[2]) for line in header if line.startswith("element")}
    order, width = "<" if "little" in header[1] else ">", sum(line.startswith("property float") for line in header)
    vertices = np.frombuffer(data, order + "f4", counts["vertex"] * width, end).reshape(-1, width)[:, :3]
    faces = np.frombuffer(data, np.dtype([("n", "u1"), ("i", order + "i4", 3)]), counts["face"], end + counts["vertex"] * width * 4)["i"]
    return np.ascontiguousarray(vertices, np.float32), faces.astype(np.int64)


def bumpy_sphere(rows=366, columns=366):
    """Returns a closed surface of 267,180 triangles."""
    v, u = np.meshgrid(np.linspace(0, np.pi, rows + 1), np.linspace(0, 2 * np.pi, columns, endpoint=False), indexing="ij")
    radius = 1 + 0.08 * np.sin(9 * u) * np.sin(v) ** 3 * np.sin(7 * v)
    points = radius[..., None] * np.stack([np.sin(v) * np.sin(u), np.cos(v), np.sin(v) * np.cos(u)], axis=-1)
    i, j = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    a, b = (i * columns + j).ravel(), (i * columns + (j + 1) % columns).ravel()
    faces = np.concatenate([np.stack([a, a + columns, b + columns], axis=1), np.stack([a, b + columns, b], axis=1)])
    corners = points.reshape(-1, 3)[faces]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    return points.reshape(-1, 3).astype(np.float32), faces[area > 1e-12]


def vertex_normals(vertices, faces):
    corners = vertices[faces].astype(np.float64)
    flat = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    sums = np.zeros((len(vertices), 3))
    for k in range(3):
        np.add.at(sums, faces[:, k], flat)
    sums[(sums == 0).all(axis=1)] = (0, 1, 0)
    return (sums / np.linalg.norm(sums, axis=1, keepdims=True)).astype(np.float32)


def views(vertices):
    """Returns the eye of each frame, the target and the radius of the mesh."""
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    center, radius = (low + high) / 2, float(np.linalg.norm(high - low)) / 2
    eyes = [center + 2.6 * radius * np.array([np.sin(a), 0.3, np.cos(a)]) for a in YAWS]
    return eyes, center, radius


class Halfspace:
    """A scene with one directional light."""

    name = "Halfspace"

    def __init__(self, vertices, faces, normals, size):
        eyes, center, radius = views(vertices)
        self.size, self.scene = size, halfspace.Scene(lighting="none")
        self.scene.set({"samples": 1})
        self.scene.add(halfspace.Mesh(vertices, faces, normals=normals))
        self.scene.add_light("directional", direction=(0.3, 0.6, 1), shadow=False)
        self.cameras = [halfspace.Camera.look_at(eye, center, fov=40, near=0.1 * radius, far=10 * radius) for eye in eyes]

    def frame(self, i):
        return self.scene.render(self.size, camera=self.cameras[i % len(self.cameras)])


class Vtk:
    """VTK's OpenGL renderer, with an off-screen window."""

    name = "VTK"

    def __init__(self, vertices, faces, normals, size):
        import vtk
        from vtk.util import numpy_support as convert

        cells = vtk.vtkCellArray()
        cells.SetData(3, convert.numpy_to_vtkIdTypeArray(faces.astype(np.int64).ravel(), deep=True))
        points = vtk.vtkPoints()
        points.SetData(convert.numpy_to_vtk(vertices, deep=True))
        data = vtk.vtkPolyData()
        data.SetPoints(points)
        data.SetPolys(cells)
        data.GetPointData().SetNormals(convert.numpy_to_vtk(normals, deep=True))
        mapper = vtk.vtkPolyDataMapper()
        mapper.SetInputData(data)
        actor = vtk.vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(0.8, 0.8, 0.8)
        self.renderer = vtk.vtkRenderer()
        self.renderer.AddActor(actor)
        self.renderer.AutomaticLightCreationOff()
        light = vtk.vtkLight()
        light.SetLightTypeToSceneLight()
        light.SetPosition(0.3, 0.6, 1)
        light.SetFocalPoint(0, 0, 0)
        self.renderer.AddLight(light)
        self.window = vtk.vtkRenderWindow()
        self.window.SetMultiSamples(0)
        self.window.SetOffScreenRendering(1)
        self.window.SetSize(*size)
        self.window.AddRenderer(self.renderer)
        self.eyes, self.center, self.radius = views(vertices)
        self.pixels, self.convert, self.size = vtk.vtkUnsignedCharArray(), convert, size

    def frame(self, i):
        camera = self.renderer.GetActiveCamera()
        camera.SetPosition(*self.eyes[i % len(self.eyes)])
        camera.SetFocalPoint(*self.center)
        camera.SetViewUp(0, 1, 0)
        camera.SetViewAngle(40)
        camera.SetClippingRange(0.1 * self.radius, 10 * self.radius)
        self.window.Render()
        self.window.GetRGBACharPixelData(0, 0, self.size[0] - 1, self.size[1] - 1, 0, self.pixels)
        return self.convert.vtk_to_numpy(self.pixels).reshape(self.size[1], self.size[0], 4)[::-1]

    def graphics(self):
        return next((line for line in self.window.ReportCapabilities().split("\n") if "renderer string" in line), "?").split(":")[-1].strip()


def measure(program, frames):
    start = time.perf_counter()
    for i in range(frames):
        program.frame(i)
    return frames / (time.perf_counter() - start)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("meshes", nargs="*", metavar="MESH.ply")
    arguments.add_argument("--size", default="1280x720")
    arguments.add_argument("--frames", type=int, default=60)
    arguments.add_argument("--rounds", type=int, default=5)
    arguments.add_argument("--save", metavar="FOLDER", help="write the first frame of each program as PNG")
    args = arguments.parse_args()
    size = tuple(int(n) for n in args.size.split("x"))
    meshes = [(Path(path).name, *read_ply(path)) for path in args.meshes] + [("bumpy sphere", *bumpy_sphere())]
    print("| mesh | triangles | program | frames/s | ratio |\n|---|---:|---|---:|---:|")
    graphics = ""
    for name, vertices, faces in meshes:
        normals = vertex_normals(vertices, faces)
        programs = [Halfspace(vertices, faces, normals, size)]
        try:
            programs.append(Vtk(vertices, faces, normals, size))
        except ImportError:
            print("VTK is not installed (Debian: python3-vtk9)")
        for program in programs:
            picture = program.frame(0)
            if args.save:
                np.ascontiguousarray(picture[..., :3]).view(halfspace.Picture).save(Path(args.save) / f"{name.split('.')[0]}-{program.name}.png")
        best = {program.name: 0.0 for program in programs}
        for _ in range(args.rounds):
            for program in programs:
                best[program.name] = max(best[program.name], measure(program, args.frames))
        for program in programs:
            ratio = best["Halfspace"] / best[program.name]
            print(f"| {name} | {len(faces):,} | {program.name} | {best[program.name]:.1f} | {ratio:.1f} |")
            graphics = program.graphics() if isinstance(program, Vtk) else graphics
    print(f"\n{size[0]}x{size[1]}, best of {args.rounds} rounds of {args.frames} frames; {halfspace._core.arch}, {halfspace._core.lanes} lanes, "
          f"{halfspace._core.cores()} threads; VTK's OpenGL: {graphics or 'none'}. Ratio: Halfspace's frame rate divided by that of the row.")


if __name__ == "__main__":
    main()
