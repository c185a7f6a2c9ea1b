#!/usr/bin/env bash
# Installs missing packages, builds the release preset and runs all its tests. The output ends with the summary of ctest. The benchmarks take
# a tenth of the time to build, so scripts/test_full.sh tests them.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_deps.sh --tests
cmake --preset release -DHALFSPACE_BUILD_BENCHMARKS=OFF
cmake --build --preset release -j "$(nproc)"  # more jobs than cores would only compete for the caches
# Large pages for malloc (glibc) save half or more of the page faults of test-image and test-render, and a third of their time.
export GLIBC_TUNABLES=glibc.malloc.hugetlb=1
ctest --preset release -j "$(($(nproc) + 1))"  # some tests wait most of the time, for a browser or a window
