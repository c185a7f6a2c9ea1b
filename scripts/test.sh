#!/usr/bin/env bash
# Installs missing packages, builds the release preset and runs all its tests. The output ends with the summary of ctest.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_deps.sh --tests
cmake --preset release
cmake --build --preset release -j "$(nproc)"  # more jobs than cores would only compete for the caches
ctest --preset release -j "$(($(nproc) + 1))"  # some tests wait most of the time, for a browser or a window
