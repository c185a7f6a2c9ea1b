#!/usr/bin/env bash
# Builds what the lessons (docs/tutorial/lessons) need into build/learn, in three steps: the library with the program of lesson 6, the
# programs of the other lessons, and `halfspace`, which checks the exercises. Installs missing packages first.
#
#   scripts/learn.sh            all steps
#   scripts/learn.sh --first    only the first step; the program of another lesson is then built when it is needed
set -euo pipefail
cd "$(dirname "$0")/.."

targets=(lesson-06_library lessons halfspace)
case "${1:-}" in
  "") ;;
  --first) targets=(lesson-06_library) ;;
  *) echo "learn.sh: unknown argument '$1'; expected --first or nothing" >&2; exit 2 ;;
esac

scripts/install_deps.sh
# Leaves out what no lesson needs.
cmake --preset release -B build/learn -DHALFSPACE_BUILD_TESTS=OFF -DHALFSPACE_BUILD_BENCHMARKS=OFF -DHALFSPACE_WITH_EMBREE=OFF \
  -DHALFSPACE_INSTALL=OFF -DHALFSPACE_WERROR=OFF > /dev/null
for target in "${targets[@]}"; do
  echo "learn.sh: building $target"
  cmake --build build/learn --target "$target"
done
echo "learn.sh: the programs are in build/learn/bin"
