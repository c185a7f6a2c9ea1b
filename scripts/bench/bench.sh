#!/usr/bin/env bash
# Measures Halfspace, llvmpipe, SwiftShader, Embree and the machine's peak rates in one run. Writes the results as JSON, Markdown tables and
# charts. Programs that are not installed (SwiftShader from Chromium, Embree) are skipped with a message.
#
#   scripts/bench/bench.sh [--quick] [--docs] [--out DIR] [ARGUMENT...]
#     --quick   runs one short round, which takes a few minutes instead of about an hour
#     --docs    also updates the tables in docs/results/performance.md and README.md, and the charts in docs/results/benchmark
#     --out     output folder (default: build/bench/results)
#   Other arguments are passed to scripts/bench/bench_measure.py: --only, --threads, --sizes, --rounds, --seconds, --no-sweeps, --no-matrix,
#   --no-scenes.
set -euo pipefail
cd "$(dirname "$0")/../.."

out=build/bench/results
measure=()
report=()
while [ $# -gt 0 ]; do
  case "$1" in
    --quick) measure+=(--quick) ;;
    --docs) report+=(--docs) ;;
    --out) out=${2:?bench.sh: --out needs a directory}; shift ;;
    -h | --help) sed -n '2,11s/^# \{0,1\}//p' "$0"; exit 0 ;;
    *) measure+=("$1") ;;
  esac
  shift
done

scripts/install_deps.sh --benchmarks
build() {
  cmake -S . -B "build/bench/$1" -G Ninja -DCMAKE_BUILD_TYPE=Release -DHALFSPACE_BUILD_TESTS=OFF -DHALFSPACE_ARCH="$2" > "build/bench/$1.log"
  cmake --build "build/bench/$1" --target "${@:3}" >> "build/bench/$1.log" || { tail -20 "build/bench/$1.log" >&2; exit 1; }
}
mkdir -p build/bench
[ ! -t 2 ] || echo "bench.sh: building (native and x86-64-v3)" >&2
build native native benchmarks
build v3 x86-64-v3 halfspace-bench

rm -rf build/bench/truths  # the definition of a workload may have changed
mkdir -p "$out"
python3 scripts/bench/bench_measure.py --native build/bench/native/bin --v3 build/bench/v3/bin --truths build/bench/truths \
  --out "$out/results.json" "${measure[@]}"
/usr/bin/python3 scripts/bench/bench_report.py "$out/results.json" --out "$out" "${report[@]}"
