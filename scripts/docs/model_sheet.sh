#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
#
# Renders every model file of some folders and writes a contact sheet to out/models.png, with the pictures in out/models.
# Needs ImageMagick (montage).
#
#   scripts/docs/model_sheet.sh PROGRAM FOLDER...     for example: scripts/docs/model_sheet.sh build/release/bin/halfspace ../shared/data/gltf
set -euo pipefail
if [ $# -lt 2 ]; then
  echo "model_sheet.sh: expected a program and at least one folder" >&2
  exit 2
fi
command -v montage > /dev/null || { echo "model_sheet.sh: montage is missing; install imagemagick" >&2; exit 1; }
program=$(realpath "$1")
shift
pictures=out/models
mkdir -p "$pictures"
rm -f "$pictures"/*.png
failed=0
while IFS= read -r -d '' file; do
  # The name of the folder distinguishes variants of a model whose files have the same name.
  name=$(basename "$(dirname "$file")")-$(basename "$file")
  axis=()
  case "$(basename "$file")" in horse.ply | teapot_mitsuba.ply) axis=(--up-axis z) ;; esac  # their format does not say which axis is up
  "$program" render "$file" "${axis[@]}" --size 480x270 -o "$pictures/$name.png" || failed=$((failed + 1))
done < <(find "$@" -type f \( -iname '*.obj' -o -iname '*.gltf' -o -iname '*.glb' -o -iname '*.ply' -o -iname '*.stl' \) -print0 | sort -z)
montage -label '%t' "$pictures"/*.png -tile 4x -geometry +4+4 out/models.png
echo "out/models.png: $(find "$pictures" -name '*.png' | wc -l) models, $failed failed"
[ "$failed" = 0 ]
