#!/usr/bin/env bash
# Builds Halfspace for this machine and installs programs, libraries, headers and the Python module.
#
#   scripts/install.sh [PREFIX]                default: /usr/local
#   scripts/install.sh --uninstall [PREFIX]    removes what was installed
set -euo pipefail
cd "$(dirname "$0")/.."

usage() { sed -n 's/^#   \(scripts.*\)/\1/p' scripts/install.sh >&2; exit 2; }
uninstall=false
if [ "${1:-}" = --uninstall ]; then
  uninstall=true
  shift
fi
[[ $# -le 1 && "${1:-}" != -* ]] || usage
prefix=$(realpath -m "${1:-/usr/local}")
manifest=$prefix/share/halfspace/installed_files.txt

if $uninstall; then
  [ -f "$manifest" ] || { echo "install.sh: $manifest does not exist; expected a prefix that scripts/install.sh installed into" >&2; exit 1; }
  mapfile -t files < "$manifest"
  for file in "${files[@]}"; do
    rm -f "$prefix/$file"
  done
  rm -rf "$prefix"/lib/python3*/*-packages/halfspace/__pycache__
  # Remove the folders that are empty now, deepest first.
  for file in "${files[@]}"; do
    folder=$(dirname "$file")
    while [ "$folder" != . ]; do echo "$folder"; folder=$(dirname "$folder"); done
  done | sort -ru | while read -r folder; do rmdir --ignore-fail-on-non-empty "$prefix/$folder" 2> /dev/null || true; done
  echo "removed ${#files[@]} files from $prefix"
  exit 0
fi

scripts/install_deps.sh
build=build/install
# The folder in which Python searches the modules of the prefix.
modules=$(/usr/bin/python3 -c 'import sys; print("lib/python%d.%d" % sys.version_info[:2])' 2> /dev/null || echo lib/python3)
if [ "$prefix" = "$(realpath -m ~/.local)" ]; then modules+=/site-packages; else modules+=/dist-packages; fi
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$prefix" -DHALFSPACE_BUILD_TESTS=OFF \
  -DHALFSPACE_BUILD_EXAMPLES=OFF -DHALFSPACE_PYTHON_DIR="$modules" > /dev/null
cmake --build "$build" --target installed -- -j "$(nproc)"
cmake --install "$build" > /dev/null
mkdir -p "$(dirname "$manifest")"
{ sed "s|^$prefix/||" "$build/install_manifest.txt"; echo; echo share/halfspace/installed_files.txt; } | sed '/^$/d' > "$manifest"
echo "installed $(wc -l < "$manifest") files into $prefix"
case ":$PATH:" in *":$prefix/bin:"*) ;; *) echo "add $prefix/bin to PATH to run halfspace" ;; esac
