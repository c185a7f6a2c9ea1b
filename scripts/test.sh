#!/usr/bin/env bash
# Installs what is missing, builds the release preset and runs all its tests; ends in ctest's summary.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_deps.sh --tests
cmake --preset release
cmake --build --preset release
ctest --preset release -j "$(nproc)"
