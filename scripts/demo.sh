#!/usr/bin/env bash
# Installs what is missing, builds the program, renders the gallery into out/ and prints where.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_deps.sh

# A build directory of its own: the release preset without tests and benchmarks.
build=build/demo
log=$build/demo.log
mkdir -p "$build"
if ! { cmake --preset release -B "$build" -DHALFSPACE_BUILD_TESTS=OFF -DHALFSPACE_BUILD_BENCHMARKS=OFF && cmake --build "$build"; } > "$log" 2>&1; then
  tail -n 30 "$log" >&2
  echo "demo.sh: the build failed; all of it is in $log" >&2
  exit 1
fi

mkdir -p out
for scene in $("$build/bin/halfspace" list --names); do
  "$build/bin/halfspace" render "$scene" -o "out/$scene.png"
  echo "$PWD/out/$scene.png"
done
