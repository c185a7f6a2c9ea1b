#!/usr/bin/env bash
# Runs scripts/install.sh in a fresh root of a Debian release, renders there, builds C++ projects and a Python extension module, and
# uninstalls. Needs root privileges and debootstrap; debian_roots.sh lists the environment variables.
#
#   scripts/dev/try_install.sh [bookworm | trixie]...      default: both
source "$(dirname "$0")/debian_roots.sh"
[ $# -gt 0 ] || set -- bookworm trixie

for release in "$@"; do
  root=$roots/$release-install
  echo "== $release: building and installing"
  new_root "$release" "$root" ccache
  copy_sources "$root"
  quiet_in_root "$root" '/src/scripts/install_deps.sh'  # some packages create folders in /usr/local
  before=$(in_root "$root" 'find /usr/local | sort')
  quiet_in_root "$root" '/src/scripts/install.sh'
  grep '^installed' "$root.log"
  run_programs "$root"
  run_python "$root"
  build_projects "$root" /usr/local/lib/halfspace
  echo "== $release: uninstalling"
  in_root "$root" '/src/scripts/install.sh --uninstall'
  left=$(diff <(echo "$before") <(in_root "$root" 'find /usr/local | sort')) || fail "uninstalling left or removed files: $left"
done
