#!/usr/bin/env bash
# How far varyings are from long double at ratios of w beyond 10^4: docs/explanation/w_ratio_error.csv and its chart docs/explanation/w_ratio_error.svg.
# The data are what the test Interpolation.LargeRatiosOfWStayWithinTolerance prints. Needs gnuplot.
#
#   scripts/chart_w_ratio.sh [TEST_PROGRAM]     default: build/release/bin/test-raster
set -euo pipefail
cd "$(dirname "$0")/.."
program=${1:-build/release/bin/test-raster}
command -v gnuplot > /dev/null || { echo "chart_w_ratio.sh: gnuplot is missing; install gnuplot-nox" >&2; exit 1; }
rows=$("$program" --gtest_filter=Interpolation.LargeRatiosOfWStayWithinTolerance | awk '/^w ratio/ { print $3 "," $5 "," $7 "," $9 }')
{ echo "w_ratio,largest_error,mean_error,values"; echo "$rows"; } > docs/explanation/w_ratio_error.csv
gnuplot << 'END'
set terminal svg size 640,400 font "sans,12" background "white"
set output "docs/explanation/w_ratio_error.svg"
set datafile separator ","
set logscale x
set format x "10^{%L}"
set yrange [0:3.5e-7]
set format y "%.1e"
set xlabel "ratio of the largest to the smallest w of a triangle"
set ylabel "error of a varying relative to the largest vertex value"
set key center right
set grid
plot "docs/explanation/w_ratio_error.csv" skip 1 using 1:2 with linespoints pointtype 7 title "largest", \
     "docs/explanation/w_ratio_error.csv" skip 1 using 1:3 with linespoints pointtype 6 title "mean", \
     3e-7 with lines dashtype 2 title "bound at ratios to 10,000"
END
cat docs/explanation/w_ratio_error.csv
