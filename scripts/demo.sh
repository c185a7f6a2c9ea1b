#!/usr/bin/env bash
# Installs missing packages, builds the program, renders the gallery to out/ and prints the path of each image.
set -euo pipefail
cd "$(dirname "$0")/.."

# Uses a separate build directory: the release preset without tests and benchmarks.
build=build/demo
log=$build/demo.log
program=$build/bin/halfspace
mkdir -p "$build" out

# Appends the output of a build to the log and shows ninja's progress ("[12/150] ..."): on a terminal, as one line that is updated in place;
# otherwise, as one line per tenth of the build.
show_progress() {
  local line count total tenths=0
  while IFS= read -r line; do
    echo "$line" >> "$log"
    [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] || continue
    count=${BASH_REMATCH[1]} total=${BASH_REMATCH[2]}
    if [ -t 1 ]; then
      printf '\r\033[K  step %d of %d' "$count" "$total"
    elif ((count * 10 / total > tenths)); then
      tenths=$((count * 10 / total))
      echo "  step $count of $total"
    fi
  done
  if [ -t 1 ]; then printf '\r\033[K'; fi
}

# build_target TARGET: builds a target; exits if that fails.
build_target() {
  if ! cmake --build "$build" --target "$1" 2>&1 | show_progress; then fail; fi
}

fail() {
  tail -n 30 "$log" >&2
  echo "demo.sh: the build failed; the complete output is in $log" >&2
  exit 1
}

echo "Checking for required packages"
scripts/install_deps.sh
cmake --preset release -B "$build" -DHALFSPACE_BUILD_TESTS=OFF -DHALFSPACE_BUILD_BENCHMARKS=OFF > "$log" 2>&1 || fail

# The smallest program that draws: its image is available long before the complete program is built.
echo "Building the first example"
build_target example-triangle
"$build/bin/example-triangle" out/triangle.png
echo "  $PWD/out/triangle.png"

echo "Building the program (several minutes the first time)"
build_target halfspace

# Image names, each followed by the arguments that render it.
pictures=()
for scene in $("$program" list --names); do pictures+=("$scene $scene"); done
pictures+=(
  "day-night-noon day-night --set time.hours=12"
  "day-night-dusk day-night --set time.hours=17.5"
  "day-night-midnight day-night --set time.hours=0"
  "three-lights-from-green three-lights --camera green_light"
  "three-lights-mirror three-lights --camera mirror"
  "moon-terminator moon --camera terminator"
)
for rate in flat gouraud; do
  pictures+=("earth-$rate earth --shading $rate --set earth.latitudes=24 --set earth.longitudes=48")
done

echo "Rendering ${#pictures[@]} images"
number=0
for picture in "${pictures[@]}"; do
  read -r -a words <<< "$picture"
  out=out/${words[0]}.png
  number=$((number + 1))
  # Images newer than the program and this script would not change, so they are skipped.
  if [ ! "$out" -nt "$program" ] || [ ! "$out" -nt scripts/demo.sh ]; then
    "$program" render "${words[@]:1}" -o "$out"
  fi
  echo "  $number/${#pictures[@]} $PWD/$out"
done
