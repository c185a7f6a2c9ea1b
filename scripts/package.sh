#!/usr/bin/env bash
# Builds the Debian packages for the release of this system into build/packages. The programs run on any processor that supports x86-64-v3,
# and use AVX-512 if it supports x86-64-v4.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_deps.sh
command -v dpkg-shlibdeps > /dev/null || { echo "package.sh: dpkg-shlibdeps is missing; install dpkg-dev and file" >&2; exit 1; }
release=$(. /etc/os-release && echo "${VERSION_ID:-${VERSION_CODENAME:-0}}")
configure() {
  cmake -S . -B "build/package-$1" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr -DHALFSPACE_PORTABLE=ON \
    -DHALFSPACE_ARCH="x86-64-$1" -DHALFSPACE_BUILD_TESTS=OFF -DHALFSPACE_BUILD_EXAMPLES=OFF -DHALFSPACE_WERROR=OFF \
    -DHALFSPACE_PACKAGE_RELEASE="1~deb$release" "${@:2}" > "build/package-$1.log"
}
mkdir -p build/packages
configure v4 -DCMAKE_SHARED_LINKER_FLAGS=-s -DCMAKE_MODULE_LINKER_FLAGS=-s  # CPack strips only what its own build links
cmake --build build/package-v4 --target isa -- -j "$(nproc)"
configure v3 -DHALFSPACE_SECOND_BUILD="$PWD/build/package-v4"
cmake --build build/package-v3 --target installed -- -j "$(nproc)"
rm -f build/packages/*.deb
cpack --config build/package-v3/CPackConfig.cmake -B build/packages
rm -rf build/packages/_CPack_Packages
ls -l build/packages
