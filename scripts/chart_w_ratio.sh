#!/usr/bin/env bash
# Charts the error of varyings, compared with long double, for ratios of w beyond 10^4. Writes docs/explanation/w_ratio_error.csv, which the
# test Interpolation.LargeRatiosOfWStayWithinTolerance prints, and its chart docs/explanation/w_ratio_error.svg. Needs matplotlib.
#
#   scripts/chart_w_ratio.sh [TEST_PROGRAM]     default: build/release/bin/test-raster
set -euo pipefail
cd "$(dirname "$0")/.."
program=${1:-build/release/bin/test-raster}
rows=$("$program" --gtest_filter=Interpolation.LargeRatiosOfWStayWithinTolerance | awk '/^w ratio/ { print $3 "," $5 "," $7 "," $9 }')
{ echo "w_ratio,largest_error,mean_error,values"; echo "$rows"; } > docs/explanation/w_ratio_error.csv
scripts/draw_charts.py curves docs/explanation/w_ratio_error.csv --log-x --x-label "ratio of the largest to the smallest w of a triangle" \
  --y-label "error of a varying relative to the largest vertex value" --line "largest_error=largest" --line "mean_error=mean" \
  --bound "3e-7=bound at ratios to 10,000"
cat docs/explanation/w_ratio_error.csv
