#!/usr/bin/env bash
# Builds the Debian packages in a fresh root of a Debian release, installs them in a second fresh root, renders there, and builds C++
# projects and a Python extension module with them. Needs root privileges and debootstrap; debian_roots.sh lists the environment variables.
#
#   scripts/dev/try_packages.sh [bookworm | trixie]...      default: both
source "$(dirname "$0")/debian_roots.sh"
[ $# -gt 0 ] || set -- bookworm trixie

# check_packages ROOT: checks the properties that every installed package must have.
check_packages() {
  in_root "$1" 'status=0
    complain() { echo "$1" >&2; status=1; }
    for package in halfspace libhalfspace-dev python3-halfspace; do
      cmp -s "/usr/share/doc/$package/copyright" /trial/copyright || complain "$package has no license"
      dpkg-parsechangelog -l "/usr/share/doc/$package/changelog.Debian.gz" > /dev/null || complain "$package has no valid changelog"
      while read -r file; do
        if [[ $file != *.a && -f $file ]] && readelf -SW "$file" 2> /dev/null | grep -q " \.symtab "; then complain "$file is not stripped"; fi
      done < <(dpkg -L "$package")
    done
    exit $status' || fail "the packages in $1 are not as expected"
}

for release in "$@"; do
  build=$roots/$release-build
  use=$roots/$release-use
  echo "== $release: building"
  new_root "$release" "$build" dpkg-dev file ccache
  copy_sources "$build"
  quiet_in_root "$build" '/src/scripts/package.sh'
  (cd "$build/src/build/packages" && stat -c '%n: %s bytes' ./*)

  echo "== $release: installing and rendering"
  new_root "$release" "$use"
  cp cmake/debian/copyright "$build"/src/build/packages/*.deb "$use/trial/"
  in_root "$use" 'apt-get install -q -y --no-install-recommends /trial/halfspace_*.deb' 2>&1 | grep -E '^(Get:.*halfspace|Unpacking halfspace|Setting up halfspace)'
  run_programs "$use"
  in_root "$use" '/lib64/ld-linux-x86-64.so.2 --glibc-hwcaps-mask x86-64-v3 /usr/bin/halfspace info
    echo "$(ls /usr/share/man/man1/halfspace*.1* | wc -l) manual pages"'
  install_in_root "$use" '/trial/python3-halfspace_*.deb'
  run_python "$use"

  echo "== $release: building projects with libhalfspace-dev"
  install_in_root "$use" '/trial/libhalfspace-dev_*.deb' dpkg-dev
  build_projects "$use" /usr/lib/x86_64-linux-gnu/halfspace
  check_packages "$use"

  echo "== $release: removing"
  left=$(in_root "$use" 'apt-get purge -q -y "halfspace*" "libhalfspace*" "python3-halfspace*" > /trial/purge.log 2>&1
    find / -xdev \( -path /trial -o -path /proc -o -path /ccache \) -prune -o -name "*halfspace*" -print')
  [ -z "$left" ] || fail "files of the packages are left: $left"
done
