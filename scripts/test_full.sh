#!/usr/bin/env bash
# Runs the long tests: both compilers, all presets, SIMD widths and instruction sets, the mutation tests and the cost measurements.
# Run it before a release. The results of the last run are in docs/development/testing.md.
#
#   scripts/test_full.sh [--resume] [STEP...]     default: all steps; "scripts/test_full.sh list" names them
#     --resume    skips the steps that have passed for exactly these sources
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install_deps.sh --tests --view
command -v clang++ > /dev/null || { echo "test_full.sh: clang++ is missing; install clang" >&2; exit 1; }

export HALFSPACE_LONG_TESTS=1
jobs=$(nproc)
# build DIR "TARGET..." CMAKE_ARGUMENTS...    configures and builds. The result must be checked: set -e has no effect within steps.
build() {
  local dir=$1 targets=$2
  mkdir -p "$dir"
  # shellcheck disable=SC2086
  { cmake -S . -B "$dir" -G Ninja "${@:3}" && cmake --build "$dir" ${targets:+--target $targets} -- -j "$jobs"; } > "$dir/build.log" 2>&1 && return
  grep -E -m 20 'error|Error|FAILED' "$dir/build.log" || tail -20 "$dir/build.log"
  return 1
}
# build_and_test NAME CMAKE_ARGUMENTS...
build_and_test() {
  local dir=build/full/$1
  build "$dir" "" -DHALFSPACE_BUILD_BENCHMARKS=OFF -DHALFSPACE_OPTIMIZE_TESTS=ON "${@:2}" || return 1
  run_tests "$dir"
}
# Runs whole test programs, one per core, because starting a program for each of thousands of tests under a sanitizer takes longer than the
# tests. Tests that do not use GoogleTest (shaders that must not compile) are run with ctest.
run_tests() {
  local status=0
  find "$1/bin" -name 'test-*' -executable | xargs -P "$jobs" -I{} sh -c '{} --gtest_brief=1 > {}.log 2>&1 || { echo "failed: {}"; tail -40 {}.log; exit 1; }' ||
    status=1
  grep -hE '^\[=+\].* ran\.' "$1"/bin/test-*.log | awk '{n += $2} END {print n " tests ran"}'
  ctest --test-dir "$1" -R '^Compile\.' -j "$jobs" > "$1/ctest.log" 2>&1 || { tail -40 "$1/ctest.log"; status=1; }
  grep 'tests passed' "$1/ctest.log"
  return $status
}
# Sanitizer builds use clang, which compiles them in a fraction of the time.
sanitized() { build_and_test "$1" -DCMAKE_BUILD_TYPE=RelWithDebInfo -DHALFSPACE_ASSERTS=ON "${@:2}"; }

# Renders 100,000 blended points 100 times with 1, 2 and 64 threads; all images must have the same hash.
blended_order() {
  local dir=build/full/gcc-native
  build "$dir" test-conformance -DHALFSPACE_BUILD_BENCHMARKS=OFF -DCMAKE_CXX_COMPILER=g++ -DCMAKE_BUILD_TYPE=Release || return 1
  HALFSPACE_RUNS=100 "$dir/bin/test-conformance" --gtest_filter='ConformanceOrder.*'
}

# Checks the guarantees of --max-error on 208 random views.
random_views() {
  local dir=build/full/gcc-native
  build "$dir" test-reference -DHALFSPACE_BUILD_BENCHMARKS=OFF -DCMAKE_CXX_COMPILER=g++ -DCMAKE_BUILD_TYPE=Release || return 1
  HALFSPACE_VIEWS=208 "$dir/bin/test-reference" --gtest_filter='MaxError.*'
}

# Feeds mutated model files to the readers, one minute per format, with AddressSanitizer and UBSan.
fuzz() {
  local dir=build/full/fuzz format status=0
  build "$dir" fuzz -DCMAKE_CXX_COMPILER=clang++ -DHALFSPACE_FUZZ=ON -DHALFSPACE_BUILD_BENCHMARKS=OFF || return 1
  for format in obj gltf ply stl; do
    mkdir -p "$dir/corpus-$format"
    find ../shared/data -size -64k \( -name "*.$format" -o -name "*.${format/gltf/glb}" \) -exec cp -t "$dir/corpus-$format" {} + 2> /dev/null || true
    "$dir/bin/fuzz-$format" -max_len=65536 -timeout=10 -max_total_time=60 -artifact_prefix="$dir/$format-" "$dir/corpus-$format" \
      > "$dir/$format.log" 2>&1 || { tail -20 "$dir/$format.log"; status=1; }
    grep -oE 'Done [0-9]+ runs' "$dir/$format.log" | sed "s/^/$format: /"
  done
  return $status
}

# Builds the programs that the default target leaves out, and runs the tests of all benchmarks.
benchmarks() {
  local dir=build/full/benchmarks
  build "$dir" "benchmarks test-bench" -DCMAKE_BUILD_TYPE=Release || return 1
  "$dir/bin/test-bench" --gtest_brief=1
}

# Builds shared libraries, checks the list of their symbols, and uses them from a project outside of the tree.
shared() {
  local dir=build/full/shared
  build "$dir" installed -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=ON -DHALFSPACE_BUILD_BENCHMARKS=OFF -DHALFSPACE_BUILD_EXAMPLES=OFF \
    -DHALFSPACE_UNITY=OFF || return 1
  python3 tests/consumer/exports_test.py "$dir/bin" && python3 tests/consumer/consumer_test.py "$dir" c++
}

# Builds the programs of packages for both instruction sets and tests which of them is selected.
portable() {
  local arguments=(-DCMAKE_BUILD_TYPE=Release -DHALFSPACE_PORTABLE=ON -DHALFSPACE_BUILD_TESTS=OFF -DHALFSPACE_BUILD_EXAMPLES=OFF)
  build build/full/portable-v3 installed -DHALFSPACE_ARCH=x86-64-v3 "${arguments[@]}" || return 1
  build build/full/portable-v4 isa -DHALFSPACE_ARCH=x86-64-v4 "${arguments[@]}" || return 1
  python3 tests/consumer/portable_test.py build/full/portable-v3 build/full/portable-v4
}

# Uses the installation of a native build from other projects, with the checks that are too long for every run.
consumer() {
  local dir=build/full/consumer
  build "$dir" installed -DCMAKE_BUILD_TYPE=Release -DHALFSPACE_BUILD_TESTS=OFF -DHALFSPACE_BUILD_EXAMPLES=OFF || return 1
  python3 tests/consumer/consumer_test.py "$dir" c++
}

# Builds the programs of the lessons and their variants, and compares what they draw with the pictures of the lessons.
lessons() {
  local dir=build/full/gcc-native
  build "$dir" "lessons lesson-variants halfspace" -DHALFSPACE_BUILD_BENCHMARKS=OFF -DCMAKE_CXX_COMPILER=g++ -DCMAKE_BUILD_TYPE=Release || return 1
  scripts/lesson_pictures.py check "$dir"
}

# Runs the tests of halfspace-view with AddressSanitizer. They fail if a leak has one of our functions in its stack.
window() {
  local dir=build/full/window
  build "$dir" "halfspace halfspace-view" -DHALFSPACE_BUILD_BENCHMARKS=OFF -DHALFSPACE_BUILD_TESTS=OFF -DHALFSPACE_BUILD_EXAMPLES=OFF \
    -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=RelWithDebInfo -DHALFSPACE_ASSERTS=ON -DHALFSPACE_SANITIZE=address,undefined || return 1
  python3 tests/view/window_test.py "$dir/bin"
}

declare -A steps
names=()
step() { names+=("$1"); steps[$1]=$2; }
step gcc-native        "build_and_test gcc-native -DCMAKE_CXX_COMPILER=g++ -DCMAKE_BUILD_TYPE=Release"
step clang-native      "build_and_test clang-native -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Release"
step gcc-v3            "build_and_test gcc-v3 -DCMAKE_CXX_COMPILER=g++ -DCMAKE_BUILD_TYPE=Release -DHALFSPACE_ARCH=x86-64-v3"
step clang-v3          "build_and_test clang-v3 -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Release -DHALFSPACE_ARCH=x86-64-v3"
step gcc-lanes1        "build_and_test gcc-lanes1 -DCMAKE_CXX_COMPILER=g++ -DCMAKE_BUILD_TYPE=Release -DHALFSPACE_LANES=1"
step gcc-lanes4        "build_and_test gcc-lanes4 -DCMAKE_CXX_COMPILER=g++ -DCMAKE_BUILD_TYPE=Release -DHALFSPACE_LANES=4"
step gcc-lanes8        "build_and_test gcc-lanes8 -DCMAKE_CXX_COMPILER=g++ -DCMAKE_BUILD_TYPE=Release -DHALFSPACE_LANES=8"
step gcc-O1            "build_and_test gcc-O1 -DCMAKE_CXX_COMPILER=g++ -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS=-O1"
step dev               "sanitized dev -DCMAKE_CXX_COMPILER=g++"
step asan-ubsan        "sanitized asan-ubsan -DCMAKE_CXX_COMPILER=clang++ -DHALFSPACE_SANITIZE=address,undefined"
step tsan              "sanitized tsan -DCMAKE_CXX_COMPILER=clang++ -DHALFSPACE_SANITIZE=thread -DHALFSPACE_WITH_TBB=OFF"
step without-tbb       "build_and_test without-tbb -DCMAKE_BUILD_TYPE=Release -DHALFSPACE_WITH_TBB=OFF"
step without-oiio      "build_and_test without-oiio -DCMAKE_BUILD_TYPE=Release -DHALFSPACE_WITH_OPENIMAGEIO=OFF"
step without-embree    "build_and_test without-embree -DCMAKE_BUILD_TYPE=Release -DHALFSPACE_WITH_EMBREE=OFF"
step without-window    "build_and_test without-window -DCMAKE_BUILD_TYPE=Release -DCMAKE_DISABLE_FIND_PACKAGE_SDL2=ON"
step window            "window"
step shared            "shared"
step portable          "portable"
step consumer          "consumer"
step pip               "python3 tests/consumer/pip_test.py"
step packages          "scripts/try_packages.sh"
step install           "scripts/try_install.sh"
step lessons           "lessons"
step fuzz              "fuzz"
step benchmarks        "benchmarks"
step compile-time      "scripts/shader_compile_time.sh g++ && scripts/shader_compile_time.sh clang++"
step order             "blended_order"
step views             "random_views"
step off-costs         "scripts/off_costs.sh"
step mutate            "scripts/mutate.py"

if [ "${1:-}" = list ]; then
  printf '%s\n' "${names[@]}"
  exit 0
fi
resume=false
if [ "${1:-}" = --resume ]; then
  resume=true
  shift
fi
[ $# -gt 0 ] || set -- "${names[@]}"
# Identifies the sources, including changes that are not committed.
mkdir -p build/full
index=$(mktemp)
cp "$(git rev-parse --git-path index)" "$index"
tree=$(GIT_INDEX_FILE=$index git add -A && GIT_INDEX_FILE=$index git write-tree)
rm -f "$index"
passed=build/full/passed.txt  # lines "TREE STEP"
touch "$passed"
failed=()
for name in "$@"; do
  if [ -z "${steps[$name]:-}" ]; then
    echo "test_full.sh: no step '$name'; expected one of: ${names[*]}" >&2
    exit 2
  fi
  echo "== $name"
  if $resume && grep -qxF "$tree $name" "$passed"; then
    echo "   has passed before"
    continue
  fi
  begin=$SECONDS
  if eval "${steps[$name]}"; then echo "$tree $name" >> "$passed"; else failed+=("$name"); fi
  echo "   $((SECONDS - begin)) s"
done
if [ ${#failed[@]} -gt 0 ]; then
  echo "failed: ${failed[*]}"
  exit 1
fi
echo "all $# steps passed"
