#!/usr/bin/env bash
# Installs what is missing, builds the program, renders the gallery into out/ and prints each picture's path.
set -euo pipefail
cd "$(dirname "$0")/.."

# A build directory of its own: the release preset without tests and benchmarks.
build=build/demo
log=$build/demo.log
program=$build/bin/halfspace
mkdir -p "$build" out

# Reads the output of a build into the log and shows ninja's counts ("[12/150] ..."): on a terminal in a line that
# changes, elsewhere a line for each tenth of the way.
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

# build_target TARGET: ends the script if that fails.
build_target() {
  if ! cmake --build "$build" --target "$1" 2>&1 | show_progress; then fail; fi
}

fail() {
  tail -n 30 "$log" >&2
  echo "demo.sh: the build failed; all of it is in $log" >&2
  exit 1
}

echo "Looking for what the build needs"
scripts/install_deps.sh
cmake --preset release -B "$build" -DHALFSPACE_BUILD_TESTS=OFF -DHALFSPACE_BUILD_BENCHMARKS=OFF > "$log" 2>&1 || fail

# The smallest program that draws: its picture is there long before the whole program is built.
echo "Building the first example"
build_target example-triangle
"$build/bin/example-triangle" out/triangle.png
echo "  $PWD/out/triangle.png"

echo "Building the program (some minutes the first time)"
build_target halfspace

# Names of pictures, each with the arguments that render it.
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

echo "Rendering ${#pictures[@]} pictures"
number=0
for picture in "${pictures[@]}"; do
  read -r -a words <<< "$picture"
  out=out/${words[0]}.png
  number=$((number + 1))
  # A picture that is newer than the program and this script would only become the same again.
  if [ ! "$out" -nt "$program" ] || [ ! "$out" -nt scripts/demo.sh ]; then
    "$program" render "${words[@]:1}" -o "$out"
  fi
  echo "  $number/${#pictures[@]} $PWD/$out"
done
