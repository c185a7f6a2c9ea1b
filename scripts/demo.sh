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
# picture NAME SCENE OPTIONS...   What is newer than the program and this script would only become the same again.
picture() {
  local out=out/$1.png
  if [ ! "$out" -nt "$build/bin/halfspace" ] || [ ! "$out" -nt scripts/demo.sh ]; then
    "$build/bin/halfspace" render "$2" -o "$out" "${@:3}"
  fi
  echo "$PWD/$out"
}
for scene in $("$build/bin/halfspace" list --names); do picture "$scene" "$scene"; done
picture day-night-noon day-night --set time.hours=12
picture day-night-dusk day-night --set time.hours=17.5
picture day-night-midnight day-night --set time.hours=0
picture three-lights-from-green three-lights --camera green_light
picture three-lights-mirror three-lights --camera mirror
picture moon-terminator moon --camera terminator
for rate in flat gouraud; do picture "earth-$rate" earth --shading "$rate" --set earth.latitudes=24 --set earth.longitudes=48; done
