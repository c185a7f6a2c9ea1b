#!/usr/bin/env bash
# Checks that unused features have no cost. For each feature, callgrind counts the instructions executed for a scene that does not use the
# feature. The x86-64-v3 build is compared with a build from which a patch in tests/off has removed the feature's code path. The difference
# must be at most 1%.
#
# emitted_primitives removes what draws of emitted primitives need in a pass; geometry_stage, tessellation and layers_and_viewports remove
# what only these stages need. There is no patch for transform feedback and blits: capture() and blit() are functions of their own, which no
# pass calls. A clear in a pass is recorded as a draw, and a target is always a view of texels.
#
#   scripts/dev/off_costs.sh [FEATURE...]     default: all patches in tests/off, which takes about an hour on two cores
set -euo pipefail
cd "$(dirname "$0")/../.."
command -v valgrind > /dev/null || { echo "off_costs.sh: valgrind is missing (Debian and Ubuntu: valgrind)" >&2; exit 1; }

root=$PWD
tree=$root/build/off/tree
build=$root/build/off/build
[ $# -gt 0 ] || set -- $(cd tests/off && ls ./*.patch | sed 's|./||; s|\.patch$||')
for feature in "$@"; do
  [ -f "tests/off/$feature.patch" ] || { echo "off_costs.sh: no feature '$feature'; expected one of: $(cd tests/off && echo *.patch)" >&2; exit 2; }
done

# Patches a copy of the tree. Only files that differ are copied, also those that an interrupted run has left patched, so that only they are
# compiled again.
mkdir -p "$tree"
git ls-files -z | while IFS= read -r -d '' file; do
  [ ! -L "$file" ] && cmp -s "$file" "$tree/$file" && continue
  mkdir -p "$tree/$(dirname "$file")"
  cp -P --remove-destination "$file" "$tree/$file"
done
comm -13 <(git ls-files | sort) <(cd "$tree" && find . -type f -printf '%P\n' | sort) | while IFS= read -r file; do rm "$tree/$file"; done
build_program() {
  cmake --build "$build" --target halfspace > "$build/build.log" 2>&1 || { grep -E 'error|FAILED' "$build/build.log" | head -20 >&2; exit 1; }
}
mkdir -p "$build"
# Without Embree, the program has neither validation nor studies, which would be compiled again for each patch. A patch can leave functions
# that nothing calls.
cmake -S "$tree" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DHALFSPACE_ARCH=x86-64-v3 -DHALFSPACE_BUILD_BENCHMARKS=OFF \
  -DHALFSPACE_WITH_EMBREE=OFF -DHALFSPACE_WERROR=OFF > /dev/null
build_program

# A globe with a color map and a highlight, but no shadow, normal map, reflection, HDR, multisampling or blending.
instructions() {
  valgrind --tool=callgrind --callgrind-out-file=/dev/null --collect-atstart=no --toggle-collect='halfspace::*Pass::run(*' \
    "$build/bin/halfspace" render earth --size 640x360 --threads 1 -o "$build/picture.png" \
    --set earth.normal=none --set surface.width=512 2>&1 | sed -n 's/.*Collected : //p'
}
whole=$(instructions)
[ "${whole:-0}" -gt 0 ] || { echo "off_costs.sh: callgrind found no call of Pass::run()" >&2; exit 1; }
cp "$build/picture.png" "$build/whole.png"
echo "whole         $whole instructions"

failed=()
for feature in "$@"; do
  patch -s -p1 --fuzz=0 -d "$tree" < "tests/off/$feature.patch"
  build_program
  without=$(instructions)
  # A patch must not change the image.
  cmp -s "$build/picture.png" "$build/whole.png" || failed+=("$feature (the image changed)")
  awk -v f="$feature" -v a="$whole" -v b="$without" \
    'BEGIN { printf "%-13s %s without its code path: %+.3f %% overhead when unused\n", f, b, 100 * (a / b - 1); exit a > 1.01 * b }' ||
    failed+=("$feature")
  patch -s -R -p1 --fuzz=0 -d "$tree" < "tests/off/$feature.patch"
done
if [ ${#failed[@]} -gt 0 ]; then
  echo "failed: ${failed[*]}"
  exit 1
fi
