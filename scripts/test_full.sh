#!/usr/bin/env bash
# Runs the long tests: both compilers, all presets, SIMD widths and instruction sets, the mutation tests and the cost measurements.
# Run it before a release. The results of the last run are in docs/development/testing.md.
#
#   scripts/test_full.sh [--resume] [STEP...]     default: all steps; "scripts/test_full.sh list" names them
#     --resume    skips the steps that have passed for exactly these sources
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install_deps.sh --tests --view --gui-tests --package=clang --package=libclang-rt-dev
# needs PACKAGE...    installs what only some steps need
needs() { scripts/install_deps.sh "${@/#/--package=}"; }

export HALFSPACE_LONG_TESTS=1
export HALFSPACE_NO_SKIPS=1  # a test that is skipped because a package is missing fails
jobs=$(nproc)

# Test programs (test-NAME) whose results can differ between configurations. A step builds and runs only those that can fail because of what
# the step changes; docs/development/testing.md gives the reasons. Only gcc-native runs all programs.
kernels="core shading raster property conformance"          # code that depends on the lanes or is compiled into every shader
pixels="$kernels geometry procedural render"                # all floating-point code that pixels depend on
threads="core image raster property conformance render reference cli"

# build DIR "TARGET..." CMAKE_ARGUMENTS...    configures and builds; an empty target list means all. Steps with the same compiler flags
# share a build folder. --fresh resets the options that another step has set there; object files are kept. Callers must check the exit
# status: set -e has no effect within steps.
build() {
  local dir=$1 targets=$2
  mkdir -p "$dir"
  # shellcheck disable=SC2086
  {
    cmake --fresh -S . -B "$dir" -G Ninja "${@:3}" && cmake --build "$dir" ${targets:+--target $targets} -- -j "$jobs"
  } > "$dir/build.log" 2>&1 && return
  grep -E -m 20 'error|Error|FAILED' "$dir/build.log" || tail -20 "$dir/build.log"
  return 1
}
# The folder of the default configuration. Its objects are those of scripts/test.sh, and the folder has the same depth as build/release, so
# that ccache has them if it is installed.
gcc=build/full-gcc
build_gcc() { build "$gcc" "$1" -DCMAKE_CXX_COMPILER=g++ -DCMAKE_BUILD_TYPE=Release "${@:2}"; }
# build_and_test FOLDER "PROGRAM..." CMAKE_ARGUMENTS...    Tests are compiled at the optimization level of the library.
build_and_test() {
  local dir=build/full/$1
  # shellcheck disable=SC2086
  build "$dir" "$(printf 'test-%s ' $2)" -DHALFSPACE_BUILD_BENCHMARKS=OFF -DHALFSPACE_OPTIMIZE_TESTS=ON "${@:3}" && run_tests "$dir" "$2"
}
# Runs one test program of a folder, and shows its output if it fails.
run_program() {
  local program=$1/bin/test-$2
  "$program" --gtest_brief=1 > "$program.log" 2>&1 && return
  echo "failed: test-$2"
  tail -40 "$program.log"
  return 1
}
export -f run_program
# run_tests DIR "PROGRAM..."    runs whole test programs, one per core, because starting a program for each of thousands of tests under a
# sanitizer takes longer than the tests
run_tests() {
  local name logs=() status=0
  for name in $2; do logs+=("$1/bin/test-$name.log"); done
  rm -f "${logs[@]}"
  # shellcheck disable=SC2086,SC2016
  printf '%s\n' $2 | xargs -P "$jobs" -I{} bash -c 'run_program "$0" {}' "$1" || status=1
  cat "${logs[@]}" | grep -E '^\[=+\].* ran\.' | awk '{n += $2} END {print "   " n " tests ran"}'
  return $status
}
# Names the test programs of a build folder.
programs_of() { find "$1/bin" -name 'test-*' -executable -printf '%f\n' | sed 's/^test-//' | sort; }
# run_ctest DIR PATTERN    runs tests that are not part of a test program
run_ctest() {
  ctest --test-dir "$1" -R "$2" -j "$jobs" --output-on-failure > "$1/ctest.log" 2>&1 || { tail -60 "$1/ctest.log"; return 1; }
  grep 'tests passed' "$1/ctest.log" | sed 's/^/   /'
  ! grep -E '\((Skipped|Not Run)\)$' "$1/ctest.log"
}

# Builds everything and runs all tests.
gcc_native() {
  build_gcc "" || return 1
  local status=0
  run_tests "$gcc" "$(programs_of "$gcc")" || status=1
  run_ctest "$gcc" '^(Compile|Docs|Faults|Layout|Page|Python|Study|View)[.]|^bench-tables|^Consumer.install_script' || status=1
  return $status
}
# Like build_and_test, but with a different compiler; its messages about shaders that must not compile are checked as well.
clang_native() {
  build_and_test clang-native "$pixels" -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Release || return 1
  run_ctest build/full/clang-native '^Compile[.]'
}
# The default configuration without optional dependencies, and the programs that they affect.
without_libraries() {
  local programs="core image model raster render cli view"
  # shellcheck disable=SC2086
  build_gcc "halfspace $(printf 'test-%s ' $programs)" -DHALFSPACE_WITH_TBB=OFF -DHALFSPACE_WITH_OPENIMAGEIO=OFF \
    -DHALFSPACE_WITH_EMBREE=OFF -DCMAKE_DISABLE_FIND_PACKAGE_SDL2=ON && run_tests "$gcc" "$programs"
}
# Sanitizer builds use clang, which compiles them in a fraction of the time. They draw as many random cases as scripts/test.sh, because they
# run up to 50 times slower than others.
# NDEBUG is defined as in other builds; HALFSPACE_ASSERTS checks our own preconditions.
checked=(-DCMAKE_BUILD_TYPE=None -DHALFSPACE_ASSERTS=ON "-DCMAKE_CXX_FLAGS=-O1 -gline-tables-only -DNDEBUG")
address() {
  build build/full/asan-ubsan "$1" -DHALFSPACE_BUILD_BENCHMARKS=OFF -DCMAKE_CXX_COMPILER=clang++ -DHALFSPACE_SANITIZE=address,undefined \
    "${checked[@]}"
}
asan_ubsan() {
  address "" && (unset HALFSPACE_LONG_TESTS; run_tests build/full/asan-ubsan "$(programs_of build/full/asan-ubsan)")
}
thread_sanitizer() (
  unset HALFSPACE_LONG_TESTS
  build_and_test tsan "$threads" -DCMAKE_CXX_COMPILER=clang++ -DHALFSPACE_SANITIZE=thread -DHALFSPACE_WITH_TBB=OFF "${checked[@]}"
)

# Renders 100,000 blended points 100 times with 1, 2 and 64 threads; all images must have the same hash.
blended_order() {
  build_gcc test-conformance || return 1
  HALFSPACE_RUNS=100 "$gcc/bin/test-conformance" --gtest_filter='ConformanceOrder.*'
}

# Checks the guarantees of --max-error on 208 random views.
random_views() {
  build_gcc test-reference || return 1
  HALFSPACE_VIEWS=208 "$gcc/bin/test-reference" --gtest_filter='MaxError.*'
}

# Feeds mutated model files to the readers, one minute per format, with AddressSanitizer and UBSan.
fuzz() {
  local dir=build/full/fuzz format status=0
  build "$dir" fuzz -DCMAKE_CXX_COMPILER=clang++ -DHALFSPACE_FUZZ=ON -DHALFSPACE_BUILD_BENCHMARKS=OFF || return 1
  rm -rf "$dir/seeds"
  "$dir/bin/fuzz-seeds" "$dir/seeds" && tests/fuzz/collect_seeds.py "$dir/seeds" tests/fuzz/crashes ../shared/data || return 1
  for format in obj mtl gltf ply stl; do
    mkdir -p "$dir/corpus-$format"  # new inputs are written to the first folder
    "$dir/bin/fuzz-$format" -max_len=65536 -timeout=10 -max_total_time=60 -artifact_prefix="$dir/$format-" "$dir/corpus-$format" \
      "$dir/seeds/$format" > "$dir/$format.log" 2>&1 || { tail -20 "$dir/$format.log"; status=1; }
    grep -oE 'Done [0-9]+ runs' "$dir/$format.log" | sed "s/^/$format: /"
  done
  return $status
}

# Builds the programs that are not part of the default target, and runs the tests of all benchmarks.
benchmarks() {
  build_gcc "benchmarks test-bench" && run_tests "$gcc" bench
}

# Builds shared libraries, checks their exported symbols, and uses them from a project outside the tree.
shared() {
  local dir=build/full/shared
  needs pkg-config || return 1
  build "$dir" installed -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=ON -DHALFSPACE_BUILD_BENCHMARKS=OFF -DHALFSPACE_BUILD_EXAMPLES=OFF \
    -DHALFSPACE_UNITY=OFF || return 1
  python3 tests/consumer/exports_test.py "$dir/bin" && python3 tests/consumer/consumer_test.py "$dir" c++
}

# Builds the packaged programs for both instruction sets and tests which of them is selected.
portable() {
  needs qemu-user || return 1
  local arguments=(-DCMAKE_BUILD_TYPE=Release -DHALFSPACE_PORTABLE=ON -DHALFSPACE_BUILD_TESTS=OFF -DHALFSPACE_BUILD_EXAMPLES=OFF)
  build build/full/portable-v3 installed -DHALFSPACE_ARCH=x86-64-v3 "${arguments[@]}" || return 1
  build build/full/portable-v4 isa -DHALFSPACE_ARCH=x86-64-v4 "${arguments[@]}" || return 1
  python3 tests/consumer/portable_test.py build/full/portable-v3 build/full/portable-v4
}

# Installs a native build and uses it from other projects, including the checks that take too long for every test run.
consumer() {
  needs pkg-config && build_gcc installed && python3 tests/consumer/consumer_test.py "$gcc" c++
}

# Builds the programs of the lessons and their variants, and compares their output with the pictures of the lessons.
lessons() {
  build_gcc "lessons lesson-variants halfspace" && scripts/docs/lesson_pictures.py check "$gcc"
}

# Runs the tests of halfspace-view with AddressSanitizer. They fail if the stack trace of a leak contains one of our functions.
window() {
  address "halfspace halfspace-view" && python3 tests/view/window_test.py build/full/asan-ubsan/bin
}

declare -A steps
names=()
step() { names+=("$1"); steps[$1]=$2; }
step gcc-native        gcc_native
step clang-native      clang_native
# Each of these changes several things at once, so that every value of the compiler, the instruction set, the lanes, the optimization level
# and the checks is built once or twice.
step gcc-v3            "build_and_test gcc-v3 '$pixels' -DCMAKE_CXX_COMPILER=g++ -DCMAKE_BUILD_TYPE=Release -DHALFSPACE_ARCH=x86-64-v3"
step clang-v3-lanes4   "build_and_test clang-v3-lanes4 '$kernels' -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Release -DHALFSPACE_ARCH=x86-64-v3 -DHALFSPACE_LANES=4"
step gcc-O1-lanes1     "build_and_test gcc-O1-lanes1 '$pixels' -DCMAKE_CXX_COMPILER=g++ -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS=-O1 -DHALFSPACE_LANES=1"
step dev-lanes8        "build_and_test dev-lanes8 '$pixels explain' -DCMAKE_CXX_COMPILER=g++ -DCMAKE_BUILD_TYPE=RelWithDebInfo -DHALFSPACE_ASSERTS=ON -DHALFSPACE_LANES=8"
step asan-ubsan        asan_ubsan
step window            window
step killed            "build_gcc halfspace && python3 tests/cli/killed_test.py \$gcc 50"
step tsan              thread_sanitizer
step without-libraries without_libraries
step shared            "shared"
step portable          "portable"
step consumer          "consumer"
step pip               "python3 tests/consumer/pip_test.py"
step packages          "needs debootstrap dpkg-dev && scripts/dev/try_packages.sh"
step install           "needs debootstrap && scripts/dev/try_install.sh"
step lessons           "lessons"
step fuzz              "fuzz"
step benchmarks        "benchmarks"
step compile-time      "scripts/dev/shader_compile_time.sh g++ && scripts/dev/shader_compile_time.sh clang++"
step order             "blended_order"
step views             "random_views"
step off-costs         "scripts/dev/off_costs.sh"
step mutate            "scripts/dev/mutate.py"

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
times=()
for name in "$@"; do
  if [ -z "${steps[$name]:-}" ]; then
    echo "test_full.sh: no step '$name'; expected one of: ${names[*]}" >&2
    exit 2
  fi
  echo "== $name"
  if $resume && grep -qxF "$tree $name" "$passed"; then
    echo "   skipped: it passed before with the same sources"
    continue
  fi
  begin=$SECONDS
  verdict=passed
  eval "${steps[$name]}" || verdict=failed
  if [ $verdict = passed ]; then echo "$tree $name" >> "$passed"; else failed+=("$name"); fi
  times+=("$(printf '%-16s %-8s %6d s' "$name" $verdict $((SECONDS - begin)))")
  echo "   ${times[-1]}"
done
echo "== times"
[ ${#times[@]} -eq 0 ] || printf '%s\n' "${times[@]}"
if [ ${#failed[@]} -gt 0 ]; then
  echo "failed: ${failed[*]}"
  exit 1
fi
echo "all $# steps passed"
