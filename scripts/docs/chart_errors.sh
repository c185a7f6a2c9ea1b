#!/usr/bin/env bash
# Measures errors as a function of one parameter. Writes docs/explanation/NAME_error.csv and its chart, NAME_error.svg. Needs matplotlib.
#
#   scripts/docs/chart_errors.sh sprite [BIN]     the original sprite, by the angle off the view axis; also needs ImageMagick
#   scripts/docs/chart_errors.sh w_ratio [BIN]    varyings, compared with long double, for ratios of w beyond 10^4; the values are those
#                                                 that the test Interpolation.LargeRatiosOfWStayWithinTolerance prints
#     BIN    folder of the programs; default: build/release/bin
set -euo pipefail
cd "$(dirname "$0")/../.."

sprite() {
  local program=$1/halfspace angle sprite wrong sphere
  for tool in compare convert; do
    command -v "$tool" > /dev/null || { echo "chart_errors.sh: $tool is missing; install imagemagick" >&2; exit 1; }
  done
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT

  # The silhouette of a white sphere with ambient light only. Its radius is 1/6 of its distance; the field of view is 100 degrees.
  cat > "$work/scene.json" << 'END'
{ "version": 1, "ambient": 1, "background": { "color": [0, 0, 0] },
  "cameras": { "main": { "position": [0, 0, 0], "target": [0, 0, -1], "fov": 100, "near": 0.1, "far": 100 } },
  "particles": { "file": "one.csv" } }
END
  echo "angle_degrees,sphere_px,wrong_px,wrong_share,one_minus_cos" > docs/explanation/sprite_error.csv
  for angle in $(seq 0 5 50); do
    awk -v a="$angle" 'BEGIN { t = a * atan2(0, -1) / 180; printf "%.17g,0,%.17g,0.5\n", 3 * sin(t), -3 * cos(t) }' > "$work/one.csv"
    for sprite in original exact; do
      "$program" render "$work/scene.json" --set "particles.sprite=$sprite" --size 1920x1080 -o "$work/$sprite.png" > /dev/null
    done
    wrong=$(compare -metric AE "$work/original.png" "$work/exact.png" null: 2>&1 || true)
    sphere=$(convert "$work/exact.png" -colorspace gray -threshold 50% -format '%[fx:mean*w*h]' info:)
    awk -v a="$angle" -v s="$sphere" -v w="$wrong" \
      'BEGIN { printf "%d,%d,%d,%.4f,%.4f\n", a, s + 0.5, w, w / s, 1 - cos(a * atan2(0, -1) / 180) }' >> docs/explanation/sprite_error.csv
  done
  scripts/docs/draw_charts.py curves docs/explanation/sprite_error.csv --x-label "angle off the axis (degrees)" \
    --y-label "wrong pixels relative to the sphere's area" --line "wrong_share=particles.sprite=original" \
    --dashed "one_minus_cos=1 - cos of the angle"
}

w_ratio() {
  local program=$1/test-raster rows
  rows=$("$program" --gtest_filter=Interpolation.LargeRatiosOfWStayWithinTolerance | awk '/^w ratio/ { print $3 "," $5 "," $7 "," $9 }')
  { echo "w_ratio,largest_error,mean_error,values"; echo "$rows"; } > docs/explanation/w_ratio_error.csv
  scripts/docs/draw_charts.py curves docs/explanation/w_ratio_error.csv --log-x --x-label "ratio of the largest to the smallest w of a triangle" \
    --y-label "error of a varying relative to the largest vertex value" --line "largest_error=largest" --line "mean_error=mean" \
    --bound "3e-7=bound at ratios to 10,000"
}

case "${1:-}" in
  sprite | w_ratio) ;;
  *) echo "chart_errors.sh: expected sprite or w_ratio, got '${1:-}'" >&2; exit 2 ;;
esac
"$1" "$(realpath "${2:-build/release/bin}")"
cat "docs/explanation/$1_error.csv"
