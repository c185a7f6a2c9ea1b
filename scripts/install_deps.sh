#!/usr/bin/env bash
# Installs the packages that halfspace needs to build (Debian 12 and 13, Ubuntu 24.04). Does nothing if all are installed.
#
#   scripts/install_deps.sh [--tests | --benchmarks] [--view] [--gui-tests] [--dask] [--mpi] [--package=NAME]...
#     --tests         also installs the packages that the tests need, including matplotlib for charts
#     --benchmarks    also installs the packages that scripts/bench/bench.sh needs
#     --view          also installs the packages that halfspace-view needs, and the font of its text
#     --gui-tests     also installs a browser and a virtual X server, for the tests of web pages and of the window
#     --dask          also installs Dask, which halfspace.render_frames() can use
#     --mpi           also installs OpenMPI, which `halfspace render --mpi` needs
#     --package=NAME  also installs this package
set -euo pipefail

packages=(g++ cmake ninja-build libglm-dev libtbb-dev libopenimageio-dev libopenexr-dev libjpeg-dev libspng-dev libcli11-dev nlohmann-json3-dev
  libfmt-dev libxxhash-dev libwebp-dev zlib1g-dev libzstd-dev libgif-dev libmeshoptimizer-dev libdraco-dev libembree-dev pybind11-dev python3-dev python3-numpy)
benchmark_packages=(libvulkan1)
dask_packages=(python3-distributed)
mpi_packages=(libopenmpi-dev openmpi-bin)
test_packages=("${dask_packages[@]}" "${mpi_packages[@]}" patch python3-jsonschema python3-matplotlib python3-pytest python3-pip python3-setuptools python3-wheel libgtest-dev
  libbenchmark-dev libegl-dev libepoxy-dev libgl1-mesa-dri qemu-user universal-ctags ffmpeg)
document_packages=(doxygen man-db)
view_packages=(libsdl2-dev libimgui-dev libx11-dev fonts-dejavu-core)
gui_test_packages=(chromium chromium-driver python3-selenium xvfb openbox wmctrl xdotool imagemagick)

for argument in "$@"; do
  case "$argument" in
    --tests) packages+=("${test_packages[@]}" "${document_packages[@]}") ;;
    --benchmarks) packages+=("${test_packages[@]}" "${document_packages[@]}" "${benchmark_packages[@]}") ;;
    --view) packages+=("${view_packages[@]}") ;;
    --gui-tests) packages+=("${gui_test_packages[@]}") ;;
    --dask) packages+=("${dask_packages[@]}") ;;
    --mpi) packages+=("${mpi_packages[@]}") ;;
    --package=?*) packages+=("${argument#--package=}") ;;
    *) echo "install_deps.sh: unknown argument '$argument'; expected --tests, --benchmarks, --view, --gui-tests, --dask, --mpi, --package=NAME or nothing" >&2; exit 2 ;;
  esac
done

fail() { echo "install_deps.sh: $*" >&2; exit 1; }

if ! command -v dpkg-query > /dev/null || ! command -v apt-get > /dev/null; then
  fail "this system has no apt; install the equivalents of: ${packages[*]}"
fi

installed() { [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2> /dev/null)" = installed ]; }

missing=()
for package in "${packages[@]}"; do
  installed "$package" || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

run=(env DEBIAN_FRONTEND=noninteractive)
if [ "$(id -u)" -ne 0 ]; then
  sudo -n true 2> /dev/null || fail "cannot install packages (needs root, or sudo without a password); missing: ${missing[*]}"
  run=(sudo -n env DEBIAN_FRONTEND=noninteractive)
fi

echo "install_deps.sh: installing ${missing[*]}"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
# The package lists may be outdated or missing. Update them only if the installation fails without an update.
if ! "${run[@]}" apt-get -o DPkg::Lock::Timeout=120 install -y --no-install-recommends "${missing[@]}" > "$log" 2>&1; then
  "${run[@]}" apt-get update > "$log" 2>&1 || true
  if ! "${run[@]}" apt-get -o DPkg::Lock::Timeout=120 install -y --no-install-recommends "${missing[@]}" > "$log" 2>&1; then
    reason=$(grep -m 1 '^E:' "$log" || tail -n 1 "$log")
    fail "cannot install ${missing[*]} ($reason)"
  fi
fi
