#!/usr/bin/env bash
# Builds the Debian packages in a new root of a Debian release, installs them in a second new root, renders there and builds the project in
# tests/consumer. Needs root and debootstrap. A root and the packages stay in build/roots for inspection.
#
#   scripts/try_packages.sh [bookworm | trixie]...      default: both
#
# HALFSPACE_CCACHE: folder of ccache that is copied into the root to save time.
set -euo pipefail
cd "$(dirname "$0")/.."
[ "$(id -u)" -eq 0 ] && command -v debootstrap > /dev/null || { echo "try_packages.sh: needs root and debootstrap" >&2; exit 1; }
[ $# -gt 0 ] || set -- bookworm trixie
roots=${HALFSPACE_ROOTS:-$PWD/build/roots}
mirror=${HALFSPACE_MIRROR:-http://deb.debian.org/debian}

# in_root FOLDER COMMANDS: runs a script in a root. /proc, which $ORIGIN in a RUNPATH needs, is mounted only for it.
in_root() {
  unshare --mount sh -euc 'mount -t proc proc "$1/proc"; exec chroot "$1" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
    DEBIAN_FRONTEND=noninteractive bash -euc "$2"' in_root "$@"
}
# new_root RELEASE FOLDER: copies the minimal root of a release, which is made once.
new_root() {
  if [ ! -d "$roots/$1" ]; then
    debootstrap --variant=minbase "$1" "$roots/$1.part" "$mirror" > "$roots/$1.log"
    mv "$roots/$1.part" "$roots/$1"
  fi
  rm -rf "$2"
  cp -a "$roots/$1" "$2"
  cp /etc/resolv.conf "$2/etc/resolv.conf" 2> /dev/null || true
  in_root "$2" 'apt-get update -q' > /dev/null
}

mkdir -p "$roots"
for release in "$@"; do
  build=$roots/$release-build
  use=$roots/$release-use
  echo "== $release: building"
  new_root "$release" "$build"
  in_root "$build" 'apt-get install -q -y --no-install-recommends ca-certificates dpkg-dev file ccache' > "$roots/$release-build.log" 2>&1
  mkdir -p "$build/src" "$build/root/.cache"
  git ls-files -z | tar -c --null --files-from=- | tar -x -C "$build/src"
  [ -z "${HALFSPACE_CCACHE:-}" ] || cp -a "$HALFSPACE_CCACHE" "$build/root/.cache/ccache"
  in_root "$build" 'CCACHE_BASEDIR=/src CCACHE_NOHASHDIR=1 /src/scripts/package.sh' >> "$roots/$release-build.log" 2>&1 ||
    { tail -20 "$roots/$release-build.log"; exit 1; }
  ls "$build/src/build/packages"

  echo "== $release: installing and rendering"
  new_root "$release" "$use"
  cp "$build"/src/build/packages/*.deb "$use/root/"
  in_root "$use" 'apt-get install -q -y --no-install-recommends /root/halfspace_*.deb' > "$roots/$release-use.log" 2>&1
  in_root "$use" 'halfspace --version; halfspace info; halfspace render moon --size 320x180 -o /root/moon.png; ls -l /root/moon.png
    halfspace render earth --size 320x180 -o /root/earth.jpg; halfspace compare /root/earth.jpg /root/earth.jpg
    ls /usr/share/man/man1/halfspace*.1* | wc -l'

  echo "== $release: building a project with libhalfspace-dev"
  in_root "$use" 'apt-get install -q -y --no-install-recommends g++ cmake ninja-build /root/libhalfspace-dev_*.deb' >> "$roots/$release-use.log" 2>&1
  mkdir -p "$use/root/consumer"
  cp tests/consumer/* "$use/root/consumer/" 2> /dev/null || true
  in_root "$use" 'cd /root/consumer; cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DCOMPONENTS="raster;render" > /dev/null
    cmake --build build > /dev/null; build/own_shader; build/scene /usr/lib/x86_64-linux-gnu/halfspace /root/scene.jpg'
  if ls "$use"/root/python3-halfspace_*.deb > /dev/null 2>&1; then
    in_root "$use" 'apt-get install -q -y --no-install-recommends /root/python3-halfspace_*.deb' >> "$roots/$release-use.log" 2>&1
    in_root "$use" 'python3 -c "import halfspace; print(halfspace._core.arch, halfspace.render(\"moon\", size=(64, 36)).shape)"
      python3 -c "import halfspace; print(halfspace.render(\"earth\", size=(64, 36), set={\"earth.color\": \"/root/earth.jpg\"}).shape)"'
  fi
  echo "== $release: removing"
  left=$(in_root "$use" 'apt-get purge -q -y "halfspace*" "libhalfspace*" "python3-halfspace*" > /root/purge.log 2>&1
    find / -xdev -path /root -prune -o -path /proc -prune -o -name "*halfspace*" -print')
  [ -z "$left" ] || { echo "try_packages.sh: files of the packages are left: $left" >&2; exit 1; }
done
