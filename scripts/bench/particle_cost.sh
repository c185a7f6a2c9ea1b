#!/usr/bin/env bash
# Measures the cost per sphere for 100,000 and 1,000,000 particles. The cost is the CPU time of a complete image on one thread minus the
# time of an image without spheres. Runs are interleaved, and the shortest run of each kind is used. Additional scene keys can be given.
#
#   scripts/bench/particle_cost.sh [PROGRAM [--set KEY=VALUE...]]     default: build/release/bin/halfspace
set -euo pipefail
cd "$(dirname "$0")/../.."
program=${1:-build/release/bin/halfspace}
[ $# -eq 0 ] || shift
picture=$(mktemp --suffix=.png)
trap 'rm -f "$picture"' EXIT

seconds() {
  local TIMEFORMAT=%U
  { time "$program" render particles --threads 1 --size 1280x720 --set "particles.count=$1" "${@:2}" -o "$picture" > /dev/null; } 2>&1 | tail -1
}
for sprite in exact original; do
  for arrangement in ball grid galaxy; do
    declare -A least=()
    for _ in 1 2 3 4 5; do
      for count in 0 100000 1000000; do
        time=$(seconds "$count" --set "particles.sprite=$sprite" --set "particles.arrangement=$arrangement" "$@")
        least[$count]=$(awk -v a="${least[$count]:-1e9}" -v b="$time" 'BEGIN { print a < b ? a : b }')
      done
    done
    awk -v s="$sprite" -v r="$arrangement" -v a="${least[0]}" -v b="${least[100000]}" -v c="${least[1000000]}" 'BEGIN {
      p = (b - a) * 1e4; q = (c - a) * 1e3
      printf "%-8s %-6s  100k: %4.0f ns per sphere  1M: %4.0f ns  ratio %.2f\n", s, r, p, q, q / p }'
  done
done
