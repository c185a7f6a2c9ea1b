#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks every #include "..." of the tree against the layout in CONTRIBUTING.md.

  includes_test.py          runs the checks and the tests of the checks
  includes_test.py --list   prints the dependencies between modules and between the rooms of each module
"""

import re
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# Modules of src/ and the modules that each may include directly. Indirect dependencies are allowed as well.
MODULES = {
    "core": [],
    "shading": ["core"],
    "image": ["core"],
    "geometry": ["shading"],
    "procedural": ["geometry"],
    "raster": ["shading"],
    "scene": ["core"],
    "model": ["core"],
    "render": ["raster", "image", "procedural", "scene", "model"],
    "reference": ["render"],
}
# Headers with only enums and plain structs, which do not include any SIMD headers. Scene descriptions and models may include these, too.
PLAIN_HEADERS = {"core/compare_op.h", "shading/texture/sampler.h", "shading/values/light_types.h", "shading/values/tone_types.h"}

# The rooms of modules, lowest first: folders, or the names of files without extensions at the top of the module. A file may include files of
# its own row and of lower rows. The rooms of raster are the phases of the pipeline.
ROOMS = {
    "raster": [
        ["draw_state", "target", "vertex_stream", "vertex_input", "clusters", "depth_pyramid", "statistics", "pass_tuning",
         "clear_values"],
        ["pipeline/"],
        ["primitives/"],
        ["amplify/"],
        ["tile/"],
        ["trace/"],
        ["visibility/tests/"],
        ["visibility/visibility"],
        ["visibility/sink/"],
        ["visibility/coverage/"],
        ["visibility/full_tile"],
        ["shade/"],
        ["loop/", "detail/"],
        ["pass", "depth_on_demand", "naive", "blit", "capture", "sample_location"],
        ["inspect/"],
    ],
    "shading": [
        ["sample_positions", "varyings", "pixel", "contract", "geometry_stage", "tessellation_types", "tessellation_stage", "vertex_traits",
         "shader_traits"],
        ["values/", "texture/"],
        ["shadow/"],
        ["light/"],
        ["environment/"],
        ["surface/"],
        ["sphere/"],
    ],
    "model": [
        ["model", "written_model"],
        ["text/", "used_images"],
        ["pose/", "geometry/", "detail/"],
        ["draco_tool/"],
        ["gltf/", "obj/", "ply/", "stl/"],
        ["read_model", "write_model", "up_axis_hint"],
    ],
    "render": [
        ["view", "particles", "particle_file", "mesh_streams", "prepared_scene"],
        ["assets/"],
        ["shadow/"],
        ["prepare/"],
        ["frame/"],
        ["error_budget/"],
        ["scene_assets"],
        ["model_file/"],
        ["export/"],
        ["program_info"],
    ],
    "benchmarks": [["workloads/"], ["matrix/"], ["scenes/"], ["runner/", "limits/"], ["stages/", "peers/"]],
}
# The only files and folders outside of src/raster that may include files of its folders, which are private.
RASTER_PRIVATE_USERS = [
    "apps/explain/",  # shows the results of every stage
    "benchmarks/stages/",  # measures the stages one by one
    "benchmarks/workloads/multisample.cpp",  # gives the peers the same sample positions
    "tests/consumer/packet_positions.cpp",  # loads packet functions of two SIMD widths into one process
    "tests/oracle/shader_call.h",  # divides patches in the same way; the tessellator has tests of its own
    "tests/raster/",
    "tests/explain/",
    "tests/render/display_test.cpp",  # counts allocations that are as large as tile memory
]

# Third-party headers and the only files or folders of src/ that may include them.
THIRD_PARTY = {
    "OpenImageIO/": "image/tool/",
    "OpenEXR/": "image/exr_encode.cpp",
    "jpeglib.h": "image/jpeg_errors.h",
    "spng.h": "image/png.cpp",
    "tbb/": "core/parallel.cpp",
    "meshoptimizer.h": "model/",
    "draco/": "model/draco_tool/",
    "embree": "reference/ray_scene.cpp",
}

# Folders whose headers are included by their path relative to the folder.
PROGRAM_FOLDERS = ["apps", "benchmarks", "tests"]


def allowed_modules(module):
    """Returns the module and all modules that it may include, directly or indirectly."""
    allowed = {module}
    for lower in MODULES[module]:
        allowed |= allowed_modules(lower)
    return allowed


def room_row(module, path):
    """Returns the row in ROOMS of a file, for example 3 for 'tile/blend.h' in raster, or None."""
    for row, names in enumerate(ROOMS[module]):
        for name in names:
            if path.startswith(name) if name.endswith("/") else path.rsplit(".", 1)[0] == name:
                return row
    return None


def check_rooms(module, includer, included):
    """Returns the problem with an include within a module, or None. Both paths are relative to the module."""
    from_row, to_row = room_row(module, includer), room_row(module, included)
    if from_row is None or to_row is None:
        return f"includes {included}: one of the two files does not belong to a room of {module}"
    if to_row > from_row:
        return f"includes {included}: {ROOMS[module][from_row][0]} is below {ROOMS[module][to_row][0]}"
    return None


def check_raster_include(file, included):
    """Describes the error if a file outside raster includes a private header of raster (path relative to src/); otherwise returns None."""
    is_private = included.count("/") > 1
    if is_private and not file.startswith(tuple(RASTER_PRIVATE_USERS)):
        return f"includes {included}: the folders of raster are private; expected a header of src/raster itself"
    return None


def check_library_include(includer, included):
    """Returns the problem with an include between files of src/, or None. Both paths are relative to src/."""
    module, target = includer.split("/")[0], included.split("/")[0]
    if module not in MODULES or target not in MODULES:
        return f"includes {included}: unknown module; expected one of {', '.join(MODULES)}"
    if included in PLAIN_HEADERS and module in ("scene", "model"):
        return None
    if target not in allowed_modules(module):
        return f"includes {included}: {module} may include {', '.join(sorted(allowed_modules(module)))}"
    if includer in PLAIN_HEADERS and included not in PLAIN_HEADERS | {"core/namespace.h"}:
        return f"includes {included}: plain headers may only include other plain headers"
    if module == target and module in ROOMS:
        return check_rooms(module, includer.removeprefix(module + "/"), included.removeprefix(module + "/"))
    return None


def check_include(file, spelled, exists):
    """Returns the problem with `#include "spelled"` in a file (path relative to the root), or None. exists(path) tests for a file."""
    if spelled.startswith("halfspace/"):
        included = spelled.removeprefix("halfspace/")
        if not exists("src/" + included):
            return f"includes {spelled}: src/{included} does not exist"
        if included.startswith("raster/") and not file.startswith("src/raster/"):
            problem = check_raster_include(file, included)
            if problem:
                return problem
        return check_library_include(file.removeprefix("src/"), included) if file.startswith("src/") else None
    if file.startswith("src/"):
        return f'includes "{spelled}": expected "halfspace/MODULE/FILE.h"'
    if file.startswith("benchmarks/") and exists("benchmarks/" + spelled):
        return check_rooms("benchmarks", file.removeprefix("benchmarks/"), spelled)
    if any(exists(f"{folder}/{spelled}") for folder in PROGRAM_FOLDERS):
        return None
    return f'includes "{spelled}": expected "halfspace/MODULE/FILE.h" or a path from {", ".join(PROGRAM_FOLDERS)}'


def check_third_party(file, spelled):
    """Returns the problem with `#include <spelled>` in a file of src/, or None."""
    for prefix, home in THIRD_PARTY.items():
        if spelled.startswith(prefix) and not file.removeprefix("src/").startswith(home):
            return f"includes <{spelled}>: only {home} may include it"
    return None


def sources():
    """Yields the path (relative to the root) and the text of every C++ file."""
    for folder in ["src"] + PROGRAM_FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in (".h", ".cpp"):
                yield path.relative_to(ROOT).as_posix(), path.read_text(encoding="utf-8")


def quoted_includes(text):
    return re.findall(r'^\s*#\s*include\s*"([^"]+)"', text, re.M)


def angle_includes(text):
    return re.findall(r"^\s*#\s*include\s*<([^>]+)>", text, re.M)


def circles(files):
    """Returns the sets of files that include each other, directly or indirectly. files: (path, included paths). A header and the source file
    of its name count as one file, without an extension."""
    arrows = {}
    for file, included in files:
        name = file.rsplit(".", 1)[0]
        arrows.setdefault(name, set()).update(i.rsplit(".", 1)[0] for i in included)

    def reached(name):
        seen, waiting = set(), [name]
        while waiting:
            for other in arrows.get(waiting.pop(), set()) - seen:
                seen.add(other)
                waiting.append(other)
        return seen

    reach = {name: reached(name) for name in arrows}
    found = {frozenset(b for b in reach[a] if a in reach.get(b, set())) for a in arrows if a in reach[a]}
    return [set(circle) for circle in sorted(found, key=sorted) if len(circle) > 1]


def problems():
    found = []
    exists = lambda path: (ROOT / path).is_file()
    for file, text in sources():
        messages = [check_include(file, i, exists) for i in quoted_includes(text)]
        if file.startswith("src/"):
            messages += [check_third_party(file, i) for i in angle_includes(text)]
        found += [f"{file}: {m}" for m in messages if m]
    return found


class Tree(unittest.TestCase):
    def test_every_include_follows_the_layout(self):
        self.assertEqual(problems(), [])

    def test_no_files_of_src_and_apps_include_each_other_in_a_circle(self):
        name = lambda path: path.removeprefix("halfspace/").removeprefix("src/").removeprefix("apps/")
        files = [(name(file), [name(i) for i in quoted_includes(text)]) for file, text in sources() if file.startswith(("src/", "apps/"))]
        self.assertEqual(circles(files), [])

    def test_every_folder_of_src_is_a_module(self):
        folders = {p.name for p in (ROOT / "src").iterdir() if p.is_dir()}
        self.assertEqual(folders, set(MODULES))


class Checks(unittest.TestCase):
    """Tests that the checks detect violations of the layout."""

    def check(self, file, spelled, files=()):
        return check_include(file, spelled, lambda path: path in files)

    def test_include_against_the_order_of_modules(self):
        self.assertIn("core may include", self.check("src/core/check.h", "halfspace/scene/keys.h", {"src/scene/keys.h"}))
        self.assertIn("scene may include", self.check("src/scene/keys.h", "halfspace/shading/values/tone.h", {"src/shading/values/tone.h"}))
        self.assertIsNone(self.check("src/scene/keys.h", "halfspace/shading/texture/sampler.h", {"src/shading/texture/sampler.h"}))
        self.assertIsNone(self.check("src/render/view.h", "halfspace/core/vec.h", {"src/core/vec.h"}))

    def test_circles(self):
        self.assertEqual(circles([("a.h", ["b.h"]), ("b.cpp", ["b.h", "c.h"]), ("c.h", ["a.h"]), ("d.h", ["a.h"])]), [{"a", "b", "c"}])
        self.assertEqual(circles([("a.cpp", ["a.h"]), ("a.h", ["b.h"]), ("b.h", [])]), [])
        self.assertEqual(circles([("a.h", ["b.h"]), ("b.h", ["a.h"]), ("x.h", ["y.h"]), ("y.h", ["x.h", "a.h"])]), [{"a", "b"}, {"x", "y"}])

    def test_include_against_the_order_of_rooms(self):
        files = {"src/raster/shade/fragment_batch.h", "src/raster/tile/tile.h", "src/raster/pass.h"}
        self.assertIn("is below", self.check("src/raster/tile/tile.h", "halfspace/raster/shade/fragment_batch.h", files))
        self.assertIn("is below", self.check("src/raster/loop/tile_worker.cpp", "halfspace/raster/pass.h", files))
        self.assertIsNone(self.check("src/raster/shade/fragment_batch.h", "halfspace/raster/tile/tile.h", files))
        files = {"src/model/obj/read_obj.h", "src/render/newroom/file.h", "benchmarks/scenes/scene.h"}
        self.assertIn("is below", self.check("src/model/text/text_lines.h", "halfspace/model/obj/read_obj.h", files))
        self.assertIn("does not belong", self.check("src/render/view.h", "halfspace/render/newroom/file.h", files))
        self.assertIn("is below", self.check("benchmarks/workloads/fills.cpp", "scenes/scene.h", files))
        self.assertIsNone(self.check("benchmarks/runner/main.cpp", "scenes/scene.h", files))

    def test_only_listed_files_include_private_folders_of_raster(self):
        files = {"src/raster/tile/tile.h", "src/raster/pass.h"}
        for file in "src/render/view.cpp", "apps/cli/main.cpp", "benchmarks/stages.cpp", "tests/bench/rows_test.cpp":
            self.assertIn("private", self.check(file, "halfspace/raster/tile/tile.h", files))
            self.assertIsNone(self.check(file, "halfspace/raster/pass.h", files))
        for file in "apps/explain/page.cpp", "src/raster/shade/fragment_kernel.h", "benchmarks/stages/geometry.cpp":
            self.assertIsNone(self.check(file, "halfspace/raster/tile/tile.h", files))

    def test_every_user_of_private_folders_of_raster_exists(self):
        self.assertEqual([p for p in RASTER_PRIVATE_USERS if not (ROOT / p).exists()], [])

    def test_public_files_are_at_the_top_of_raster(self):
        public = {name for row in ROOMS["raster"] for name in row if "/" not in name}
        self.assertEqual({p.stem for p in (ROOT / "src" / "raster").iterdir() if p.is_file()}, public)

    def test_plain_headers_stay_plain(self):
        files = {"src/core/lanes.h"}
        self.assertIn("plain header", self.check("src/shading/texture/sampler.h", "halfspace/core/lanes.h", files))

    def test_other_spellings(self):
        files = {"src/core/check.h", "apps/command_line/arguments.h"}
        self.assertIn("expected", self.check("src/core/check_handler.cpp", "check.h", files))
        self.assertIn("expected", self.check("src/core/check_handler.cpp", "core/check.h", files))
        self.assertIn("expected", self.check("apps/cli/main.cpp", "arguments.h", files))
        self.assertIn("does not exist", self.check("apps/cli/main.cpp", "halfspace/cli/arguments.h", files))
        self.assertIsNone(self.check("apps/cli/main.cpp", "command_line/arguments.h", files))

    def test_third_party_headers_stay_in_their_files(self):
        self.assertIn("only", check_third_party("src/render/view.cpp", "tbb/parallel_for.h"))
        self.assertIsNone(check_third_party("src/core/parallel.cpp", "tbb/parallel_for.h"))


def print_arrows():
    modules, rooms = {}, {}
    for file, text in sources():
        if not file.startswith("src/"):
            continue
        includer = file.removeprefix("src/")
        for spelled in quoted_includes(text):
            included = spelled.removeprefix("halfspace/")
            a, b = includer.split("/")[0], included.split("/")[0]
            if a != b:
                modules[a, b] = modules.get((a, b), 0) + 1
            else:
                room = lambda path: path.rsplit("/", 1)[0]
                if room(includer) != room(included):
                    key = (room(includer), room(included))
                    rooms[key] = rooms.get(key, 0) + 1
    for title, arrows in ("modules", modules), ("rooms", rooms):
        print(f"{title}: {len(arrows)} dependencies")
        for (a, b), count in sorted(arrows.items()):
            print(f"  {a} -> {b}: {count}")


if __name__ == "__main__":
    if sys.argv[1:] == ["--list"]:
        print_arrows()
    else:
        unittest.main()
