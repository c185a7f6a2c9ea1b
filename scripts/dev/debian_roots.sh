# Functions for scripts that test Halfspace in fresh root file systems ("roots") of Debian releases. Source this file; it changes to the top
# folder of the tree. Needs root privileges and debootstrap. The roots are kept in build/roots for inspection.
#
# HALFSPACE_ROOTS: a different folder for the roots. HALFSPACE_MIRROR: a Debian mirror. HALFSPACE_CCACHE: the ccache folder that all builds
# in roots share.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
fail() { echo "$(basename "$0"): $*" >&2; exit 1; }
[ "$(id -u)" -eq 0 ] && command -v debootstrap > /dev/null || fail "needs root and debootstrap"
roots=${HALFSPACE_ROOTS:-$PWD/build/roots}
mirror=${HALFSPACE_MIRROR:-http://deb.debian.org/debian}
mkdir -p "$roots" "${HALFSPACE_CCACHE:=$roots/ccache}"
export HALFSPACE_CCACHE

# in_root ROOT COMMANDS: runs a script in a root, whose home folder is /trial. /proc, which $ORIGIN in a RUNPATH needs, and the ccache folder
# are mounted only while it runs. ccache uses precompiled headers only with these settings.
in_root() {
  unshare --mount sh -euc 'mount -t proc proc "$1/proc"; mount --bind "$HALFSPACE_CCACHE" "$1/ccache"
    exec chroot "$1" env -i PATH=/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/trial LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
      CCACHE_DIR=/ccache CCACHE_BASEDIR=/src CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros \
      bash -euc "$2"' in_root "$@"
}

# quiet_in_root ROOT COMMANDS: like in_root, but writes the output to ROOT.log, and prints the end of it if the script fails.
quiet_in_root() {
  in_root "$@" >> "$1.log" 2>&1 || { tail -20 "$1.log"; fail "failed in $1"; }
}

# new_root RELEASE ROOT PACKAGES...: copies the minimal root of a release, which is created only once, and installs packages.
new_root() {
  if [ ! -d "$roots/$1" ]; then
    debootstrap --variant=minbase "$1" "$roots/$1.part" "$mirror" > "$roots/$1.log"
    mv "$roots/$1.part" "$roots/$1"
  fi
  rm -rf "$2" "$2.log"
  cp -a "$roots/$1" "$2"
  mkdir "$2/ccache" "$2/trial"
  cp /etc/resolv.conf "$2/etc/resolv.conf" 2> /dev/null || true
  quiet_in_root "$2" 'apt-get update -q'
  install_in_root "$2" "${@:3}"
}

# install_in_root ROOT PACKAGES...: installs Debian packages, given by name or as package files in the root.
install_in_root() {
  [ $# -eq 1 ] || quiet_in_root "$1" "apt-get install -q -y --no-install-recommends ${*:2}"
}

# copy_sources ROOT: copies the files of the tree to /src.
copy_sources() {
  mkdir -p "$1/src"
  git ls-files -z | tar -c --null --files-from=- | tar -x -C "$1/src"
}

# run_programs ROOT: renders with the programs that are installed in a root.
run_programs() {
  in_root "$1" 'halfspace --version; halfspace info; halfspace-bench --help | head -1
    halfspace render moon --size 320x180 -o /trial/moon.png; ls -l /trial/moon.png
    halfspace render earth --size 320x180 -o /trial/earth.jpg; halfspace compare /trial/earth.jpg /trial/earth.jpg'
}

# run_python ROOT: renders with the Python module that is installed in a root.
run_python() {
  in_root "$1" 'cd /trial; python3 -c "import halfspace; print(halfspace.__file__, halfspace._core.arch)
print(halfspace.render(\"moon\", size=(64, 36)).shape, halfspace.render(\"earth\", size=(64, 36), set={\"earth.color\": \"/trial/earth.jpg\"}).shape)"'
}

# build_projects ROOT DECODERS: builds the project in tests/consumer and the extension module in python/examples/custom_shader with the
# libraries that are installed in a root, and draws with both. DECODERS is the folder of the programs that decode images.
build_projects() {
  install_in_root "$1" g++ cmake ninja-build pybind11-dev python3-dev python3-numpy
  mkdir -p "$1/trial/projects"
  cp -r tests/consumer python/examples/custom_shader "$1/trial/projects/"
  quiet_in_root "$1" 'cd /trial/projects; cmake -S consumer -B consumer/build -G Ninja -DCMAKE_BUILD_TYPE=Release -DCOMPONENTS="raster;render"
    cmake --build consumer/build; cmake -S custom_shader -B custom_shader/build -G Ninja -DPython_EXECUTABLE=/usr/bin/python3
    cmake --build custom_shader/build -v'
  in_root "$1" "cd /trial/projects; consumer/build/own_shader; consumer/build/scene $2 /trial/scene.jpg
    cd custom_shader/build; "'python3 -c "import numpy, stripes
image = numpy.zeros((16, 64, 4), numpy.uint8)
stripes.draw(numpy.array([[-1, -1, 0], [3, -1, 0], [-1, 3, 0]], numpy.float32), image, count=2)
assert \"\".join(\"#\" if texel else \".\" for texel in image[8, ::8, 0]) == \"#.#.#.#.\", image[8, :, 0]
print(\"the extension module draws its stripes\")"'
}
