#!/usr/bin/env bash
# Builds Halfspace for this machine and installs programs, libraries, headers and the Python module.
#
#   scripts/install.sh [PREFIX]                default: /usr/local
#   scripts/install.sh --uninstall [PREFIX]    removes what was installed
set -euo pipefail

usage() { sed -n 's/^#   \(scripts.*\)/\1/p' "$0" >&2; exit 2; }
uninstall=false
if [ "${1:-}" = --uninstall ]; then
  uninstall=true
  shift
fi
[[ $# -le 1 && "${1:-}" != -* ]] || usage
prefix=$(realpath -m "${1:-/usr/local}")
cd "$(dirname "$0")/.."
# Lists the installed files and the folders that did not exist before; folders end in "/". Paths are relative to the prefix.
manifest=$prefix/share/halfspace/installed_files.txt
export LC_ALL=C  # sort and comm must agree

# Removes the files and folders on standard input. Folders that contain other files are kept.
remove() {
  local entry
  sort -r | while IFS= read -r entry; do  # a folder comes after its files
    case $entry in
      */) rmdir --ignore-fail-on-non-empty "$prefix/${entry#./}" 2> /dev/null || true ;;
      */halfspace/__init__.py) rm -rf "$prefix/$entry" "$prefix/${entry%/*}/__pycache__" ;;
      *) rm -f "$prefix/$entry" ;;
    esac
  done
}
# Prints the folders of the files on standard input, up to the prefix.
folders_of() {
  local path
  while IFS= read -r path; do
    while [[ $path = */* ]]; do path=${path%/*}; echo "$path/"; done
  done | sort -u
  echo ./
}

if $uninstall; then
  [ -f "$manifest" ] || { echo "install.sh: $manifest does not exist; expected a prefix that scripts/install.sh installed into" >&2; exit 1; }
  entries=$(cat "$manifest")
  remove <<< "$entries"
  echo "removed $(grep -vc '/$' <<< "$entries") files from $prefix"
  exit 0
fi

existing=$prefix
while [ ! -e "$existing" ]; do existing=$(dirname "$existing"); done
[ -d "$existing" ] && [ -w "$existing" ] || { echo "install.sh: cannot write to $existing; expected a different prefix, such as ~/.local, or root" >&2; exit 1; }

scripts/install_deps.sh
build=build/install
# The folder in which Python searches for the modules of the prefix.
modules=$(/usr/bin/python3 -c 'import sys; print("lib/python%d.%d" % sys.version_info[:2])' 2> /dev/null || echo lib/python3)
if [ "$prefix" = "$(realpath -m ~/.local)" ]; then modules+=/site-packages; else modules+=/dist-packages; fi
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$prefix" -DHALFSPACE_BUILD_TESTS=OFF \
  -DHALFSPACE_BUILD_EXAMPLES=OFF -DHALFSPACE_WERROR=OFF -DHALFSPACE_PYTHON_DIR="$modules" > /dev/null
cmake --build "$build" --target installed -- -j "$(nproc)"

# The manifest is written before the files, so that an interrupted installation can be removed. The list of files and folders comes from an
# installation into a temporary folder.
staging=$(mktemp -d)
trap 'rm -rf "$staging"' EXIT
DESTDIR=$staging/root cmake --install "$build" > /dev/null
{ find "$staging/root$prefix" ! -type d -printf '%P\n'; echo share/halfspace/installed_files.txt; } | sort > "$staging/files"
sort "$manifest" 2> /dev/null > "$staging/old" || true
folders_of < "$staging/files" | while IFS= read -r folder; do
  if [ ! -d "$prefix/$folder" ] || grep -qxF "$folder" "$staging/old"; then echo "$folder"; fi
done | sort - "$staging/files" > "$staging/new"
mkdir -p "$(dirname "$manifest")"
sort -u "$staging/new" "$staging/old" > "$manifest"
cmake --install "$build" > /dev/null
comm -13 "$staging/new" "$staging/old" | remove  # files that only the previous installation had
cp "$staging/new" "$manifest"

echo "installed $(wc -l < "$staging/files") files into $prefix"
case ":$PATH:" in *":$prefix/bin:"*) ;; *) echo "add $prefix/bin to PATH to run halfspace" ;; esac
if [ -d "$prefix/$modules/halfspace" ] && ! /usr/bin/python3 -c 'import sys; sys.exit(sys.argv[1] not in sys.path)' "$prefix/$modules"; then
  echo "set PYTHONPATH=$prefix/$modules to import halfspace"
fi
