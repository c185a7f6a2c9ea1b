#!/usr/bin/env bash
# Builds what the lessons (docs/tutorial/lessons) need into build/learn: the programs of the lessons, and `halfspace`, which checks the
# exercises. Installs missing packages first. The programs of the lessons are built first, so that a student can begin.
#
#   scripts/learn.sh               builds everything
#   scripts/learn.sh --lessons     builds only the programs of the lessons
set -euo pipefail
cd "$(dirname "$0")/.."

targets=(lessons halfspace)
case "${1:-}" in
  "") ;;
  --lessons) targets=(lessons) ;;
  *) echo "learn.sh: unknown argument '$1'; expected --lessons or nothing" >&2; exit 2 ;;
esac

scripts/install_deps.sh
# Without optimization, the library compiles in a fraction of the time, and draws the same pictures.
cmake --preset release -B build/learn -DHALFSPACE_BUILD_TESTS=OFF -DHALFSPACE_BUILD_BENCHMARKS=OFF -DHALFSPACE_WITH_EMBREE=OFF \
  -DHALFSPACE_INSTALL=OFF -DHALFSPACE_WERROR=OFF > /dev/null
for target in "${targets[@]}"; do
  cmake --build build/learn --target "$target"
done
echo "The programs are in build/learn/bin."
