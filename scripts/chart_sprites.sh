#!/usr/bin/env bash
# Measures the error of the original sprite by the angle off the axis. Writes docs/explanation/sprite_error.csv and its chart,
# docs/explanation/sprite_error.svg.
# Needs ImageMagick (compare) and gnuplot.
#
#   scripts/chart_sprites.sh [PROGRAM]     default: build/release/bin/halfspace
set -euo pipefail
cd "$(dirname "$0")/.."
program=$(realpath "${1:-build/release/bin/halfspace}")
for tool in compare convert gnuplot; do
  command -v "$tool" > /dev/null || { echo "chart_sprites.sh: $tool is missing; install imagemagick and gnuplot-nox" >&2; exit 1; }
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
gnuplot << 'END'
set terminal svg size 640,400 font "sans,12" background "white"
set output "docs/explanation/sprite_error.svg"
set datafile separator ","
set xlabel "angle off the axis (degrees)"
set ylabel "wrong pixels relative to the sphere's area"
set key top left
set grid
plot "docs/explanation/sprite_error.csv" skip 1 using 1:4 with linespoints pointtype 7 title "particles.sprite=original", \
     "docs/explanation/sprite_error.csv" skip 1 using 1:5 with lines dashtype 2 title "1 - cos of the angle"
END
cat docs/explanation/sprite_error.csv
