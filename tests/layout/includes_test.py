#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks every #include "..." of the tree against the layout in CONTRIBUTING.md.

  includes_test.py          runs the checks and the tests of the checks
  includes_test.py --list   prints the dependencies between modules and between the phases of raster
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
    "explain": ["render"],
    "reference": ["render"],
    "study": ["reference"],
}
# Headers with only enums and plain structs, which do not include any SIMD headers. Scene descriptions and models may include these, too.
PLAIN_HEADERS = {"shading/sampler.h", "shading/light_types.h", "shading/tone_types.h"}

# The phases within raster, lowest first. A file may include files of its own phase and of lower phases.
RASTER_PHASES = [
    ["draw_state", "target", "vertex_input", "statistics"],
    ["pipeline/"],
    ["primitives/"],
    ["tile/"],
    ["trace/"],
    ["visibility/"],
    ["shade/"],
    ["loop/", "detail/"],
    ["pass", "naive"],
    ["inspect/"],
]
# The only files and folders outside of src/raster that may include files of its folders, which are private.
RASTER_PRIVATE_USERS = [
    "src/explain/",  # shows the results of every stage
    "benchmarks/stages/",  # measures the stages one by one
    "benchmarks/multisample.cpp",  # gives the peers the same sample positions
    "tests/consumer/packet_positions.cpp",  # loads packet functions of two SIMD widths into one process
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
    "meshoptimizer.h": "model/gltf_meshopt.cpp",
    "draco/": "model/draco_tool/",
    "embree": "reference/ray_scene.cpp",
}

# Files of src/ that include each other in a circle. A header and the source file of its name count as one. The list may only shrink.
KNOWN_CIRCLES = [
    {"core/check", "core/task_check"},
    {"explain/page", "explain/page_data", "explain/page_history"},
    {"model/write_formats", "model/write_model"},
    {"raster/primitives/setup_clipped", "raster/primitives/setup_points_lines"},
    {"raster/shade/late_tests", "raster/shade/shade_immediate"},
    {
        "render/model_materials",
        "render/model_preparation",
        "render/prepared_scene",
        "render/scene_background",
        "render/scene_draws",
        "render/scene_lights",
        "render/scene_preparation",
        "render/scene_surfaces",
        "render/shadow/shadow_fit",
        "render/shadow/shadow_renderer",
        "render/shape_preparation",
        "render/sphere_preparation",
        "render/surface_draw",
        "render/wireframe",
    },
    {"scene/animation", "scene/scene_check"},
    {"scene/description", "scene/shape_tessellation", "scene/shapes"},
    {"shading/shadow", "shading/shadow_lookup"},
    {"shading/texels", "shading/texture"},
]

# Folders whose headers are included by their path relative to the folder.
PROGRAM_FOLDERS = ["apps", "benchmarks", "tests"]


def allowed_modules(module):
    """Returns the module and all modules that it may include, directly or indirectly."""
    allowed = {module}
    for lower in MODULES[module]:
        allowed |= allowed_modules(lower)
    return allowed


def raster_phase(path):
    """Returns the row in RASTER_PHASES of a file of raster, for example 'raster/tile/blend.h', or None."""
    rest = path.removeprefix("raster/")
    for row, names in enumerate(RASTER_PHASES):
        for name in names:
            if rest.startswith(name) if name.endswith("/") else rest.rsplit(".", 1)[0] == name:
                return row
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
    if module == target == "raster":
        from_row, to_row = raster_phase(includer), raster_phase(included)
        if from_row is None or to_row is None:
            return f"includes {included}: one of the two files does not belong to a phase of raster"
        if to_row > from_row:
            return f"includes {included}: {RASTER_PHASES[from_row][0]} is below {RASTER_PHASES[to_row][0]}"
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
    """Returns the sets of files that include each other, directly or indirectly. files: (path relative to src/, included paths). A header
    and the source file of its name count as one file, without an extension."""
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

    def test_no_circle_of_files_is_added(self):
        files = [(file.removeprefix("src/"), [i.removeprefix("halfspace/") for i in quoted_includes(text)]) for file, text in sources()
                 if file.startswith("src/")]
        self.assertEqual(circles(files), KNOWN_CIRCLES)

    def test_every_folder_of_src_is_a_module(self):
        folders = {p.name for p in (ROOT / "src").iterdir() if p.is_dir()}
        self.assertEqual(folders, set(MODULES))


class Checks(unittest.TestCase):
    """Tests that the checks detect violations of the layout."""

    def check(self, file, spelled, files=()):
        return check_include(file, spelled, lambda path: path in files)

    def test_include_against_the_order_of_modules(self):
        self.assertIn("core may include", self.check("src/core/check.h", "halfspace/scene/keys.h", {"src/scene/keys.h"}))
        self.assertIn("scene may include", self.check("src/scene/keys.h", "halfspace/shading/tone.h", {"src/shading/tone.h"}))
        self.assertIsNone(self.check("src/scene/keys.h", "halfspace/shading/sampler.h", {"src/shading/sampler.h"}))
        self.assertIsNone(self.check("src/render/view.h", "halfspace/core/vec.h", {"src/core/vec.h"}))

    def test_circles(self):
        self.assertEqual(circles([("a.h", ["b.h"]), ("b.cpp", ["b.h", "c.h"]), ("c.h", ["a.h"]), ("d.h", ["a.h"])]), [{"a", "b", "c"}])
        self.assertEqual(circles([("a.cpp", ["a.h"]), ("a.h", ["b.h"]), ("b.h", [])]), [])
        self.assertEqual(circles([("a.h", ["b.h"]), ("b.h", ["a.h"]), ("x.h", ["y.h"]), ("y.h", ["x.h", "a.h"])]), [{"a", "b"}, {"x", "y"}])

    def test_include_against_the_order_of_phases(self):
        files = {"src/raster/shade/fragment_batch.h", "src/raster/tile/tile.h", "src/raster/pass.h"}
        self.assertIn("is below", self.check("src/raster/tile/tile.h", "halfspace/raster/shade/fragment_batch.h", files))
        self.assertIn("is below", self.check("src/raster/loop/tile_worker.cpp", "halfspace/raster/pass.h", files))
        self.assertIsNone(self.check("src/raster/shade/fragment_batch.h", "halfspace/raster/tile/tile.h", files))

    def test_only_listed_files_include_private_folders_of_raster(self):
        files = {"src/raster/tile/tile.h", "src/raster/pass.h"}
        for file in "src/render/view.cpp", "apps/cli/main.cpp", "benchmarks/stages.cpp", "tests/bench/rows_test.cpp":
            self.assertIn("private", self.check(file, "halfspace/raster/tile/tile.h", files))
            self.assertIsNone(self.check(file, "halfspace/raster/pass.h", files))
        for file in "src/explain/page.cpp", "src/raster/shade/fragment_kernel.h", "benchmarks/stages/geometry.cpp":
            self.assertIsNone(self.check(file, "halfspace/raster/tile/tile.h", files))

    def test_every_user_of_private_folders_of_raster_exists(self):
        self.assertEqual([p for p in RASTER_PRIVATE_USERS if not (ROOT / p).exists()], [])

    def test_public_files_are_at_the_top_of_raster(self):
        public = {name for row in RASTER_PHASES for name in row if not name.endswith("/")}
        self.assertEqual({p.stem for p in (ROOT / "src" / "raster").iterdir() if p.is_file()}, public)

    def test_plain_headers_stay_plain(self):
        files = {"src/core/lanes.h"}
        self.assertIn("plain header", self.check("src/shading/sampler.h", "halfspace/core/lanes.h", files))

    def test_other_spellings(self):
        files = {"src/core/check.h", "apps/cli/arguments.h"}
        self.assertIn("expected", self.check("src/core/check.cpp", "check.h", files))
        self.assertIn("expected", self.check("src/core/check.cpp", "core/check.h", files))
        self.assertIn("expected", self.check("apps/cli/main.cpp", "arguments.h", files))
        self.assertIn("does not exist", self.check("apps/cli/main.cpp", "halfspace/cli/arguments.h", files))
        self.assertIsNone(self.check("apps/cli/main.cpp", "cli/arguments.h", files))

    def test_third_party_headers_stay_in_their_files(self):
        self.assertIn("only", check_third_party("src/render/view.cpp", "tbb/parallel_for.h"))
        self.assertIsNone(check_third_party("src/core/parallel.cpp", "tbb/parallel_for.h"))


def print_arrows():
    modules, phases = {}, {}
    for file, text in sources():
        if not file.startswith("src/"):
            continue
        includer = file.removeprefix("src/")
        for spelled in quoted_includes(text):
            included = spelled.removeprefix("halfspace/")
            a, b = includer.split("/")[0], included.split("/")[0]
            if a != b:
                modules[a, b] = modules.get((a, b), 0) + 1
            elif a == "raster":
                row = lambda path: RASTER_PHASES[raster_phase(path)][0]
                if row(includer) != row(included):
                    key = (row(includer), row(included))
                    phases[key] = phases.get(key, 0) + 1
    for title, arrows in ("modules", modules), ("raster", phases):
        print(f"{title}: {len(arrows)} dependencies")
        for (a, b), count in sorted(arrows.items()):
            print(f"  {a} -> {b}: {count}")


if __name__ == "__main__":
    if sys.argv[1:] == ["--list"]:
        print_arrows()
    else:
        unittest.main()
