#!/usr/bin/env bash
# Measures the compile time that each additional shader adds to a translation unit: the time for 9 copies of Blinn-Phong minus the time for
# one, divided by 8.
# Usage: shader_compile_time.sh [COMPILER]
set -euo pipefail
cd "$(dirname "$0")/../.."
compiler=${1:-g++}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unit() {
  echo '#include "halfspace/raster/pass.h"'
  echo '#include "halfspace/shading/surface/surface_shader.h"'
  echo 'using namespace halfspace;'
  for i in $(seq "$1"); do
    echo "struct Shader$i : SurfaceShader<ShadingRate::phong, true> {};"
    echo "void draw$i(Pass& pass, const Shader$i& shader, const VertexView& view) { pass.draw(shader, view); }"
  done
}
seconds() {
  unit "$1" > "$work/unit.cpp"
  local begin end
  begin=$(date +%s.%N)
  "$compiler" -std=c++20 -O3 -march=native -ffp-contract=off -fno-math-errno -Wno-psabi -DGLM_FORCE_XYZW_ONLY -DGLM_FORCE_EXPLICIT_CTOR \
    -DHALFSPACE_LANES="${HALFSPACE_LANES:-16}" -Iinclude -c "$work/unit.cpp" -o "$work/unit.o"
  end=$(date +%s.%N)
  awk -v a="$begin" -v b="$end" 'BEGIN { print b - a }'
}
one=$(seconds 1)
nine=$(seconds 9)
awk -v c="$compiler" -v a="$one" -v b="$nine" 'BEGIN { printf "%s: 1 shader %.2f s, 9 shaders %.2f s, %.2f s per additional shader\n", c, a, b, (b - a) / 8 }'
