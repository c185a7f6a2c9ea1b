#!/usr/bin/env bash
# Plants faults in a copy of the tree, one by one, and shows that the tests catch each.
#
#   scripts/mutate.sh        all faults
#   scripts/mutate.sh N      the N-th alone
#   scripts/mutate.sh N M    the N-th to the M-th
#   scripts/mutate.sh list   their names
#
# Ends in "N caught, M missed"; exit 1 if any was missed. A fault is a text in one file and what it becomes; the text
# must stand in the file exactly once. It counts as caught if a test fails; a fault that does not build proves nothing and
# counts as missed (warnings are no errors here).
set -euo pipefail
cd "$(dirname "$0")/.."

names=() files=() olds=() news=()
fault() { names+=("$1"); files+=("$2"); olds+=("$3"); news+=("$4"); }

fault "fill rule: left edges lose their samples" src/raster/pipeline/edge.h 'ey < I(0) ||' 'ey > I(0) ||'
fault "fill rule: horizontal edges the wrong way" src/raster/pipeline/edge.h 'ey == I(0) && ex' 'ey == I(0) && -ex'
fault "fill rule: shared edges drawn twice" src/raster/pipeline/edge.h 'owns_its_samples(ex, ey), I(0), I(1)' 'owns_its_samples(ex, ey), I(0), I(0)'
fault "snapping truncates" src/raster/primitives/vertex_stage.cpp 'round_to_int(whole) + round_to_int(rest)' 'round_to_int(whole) + truncate_to_int(rest)'
fault "snapping to 1/128 px" src/raster/primitives/vertex_stage.cpp 'return round_to_int(whole) + round_to_int(rest);' 'return (round_to_int(whole) + round_to_int(rest)) & Int(-2);'
fault "pixel centres half a pixel off" src/raster/pipeline/sample_pattern.h '{128, 128},' '{0, 0},'
fault "clip: near plane left out" src/raster/primitives/clip.cpp 'case 1: return depth.clip == ClipDepth::negative_one_to_one ? p.z + p.w : p.z;' 'case 1: return 1.0;'
fault "clip: far plane before w is made positive" src/raster/primitives/clip.cpp 'const bool near_or_far = plane == 1 || plane == 2;' 'const bool near_or_far = plane == 0 || plane == 2;'
fault "clip: place of a new corner rounded to float" src/raster/primitives/clip.cpp 'const double length = d_in - d_out;' 'const double length = static_cast<double>(static_cast<float>(d_in - d_out));'
fault "clip: guard band not applied" src/raster/primitives/vertex_stage.cpp 'bit(!inside_guard, kOutGuard)' 'bit(!inside_guard & Mask(false), kOutGuard)'
fault "clip: flat varyings interpolated" src/raster/primitives/clip.cpp 'kernels.interpolations[i] == Interpolation::flat' 'kernels.interpolations[i] == Interpolation::flat && false'
fault "non-finite vertices drawn" src/raster/primitives/setup.cpp 'all &= shaded_.outcodes[i];
    }
    if (any & kOutNonFinite) {' 'all &= shaded_.outcodes[i];
    }
    if (false) {'
fault "depth function: less also passes equal" src/raster/visibility/compare.h 'case CompareOp::less: return z < stored;' 'case CompareOp::less: return z <= stored;'
fault "depth function: greater and greater_equal swapped" src/raster/visibility/compare.h 'case CompareOp::greater_equal: return z >= stored;' 'case CompareOp::greater_equal: return z > stored;'
fault "depth: plane not from the nearest vertex" src/raster/primitives/setup_scalar.cpp 'const float z_min = std::min({v[0]->z, v[1]->z, v[2]->z});' 'const float z_min = v[0]->z;'
fault "depth: block bounds too narrow" src/raster/visibility/block_edges.h 'if (!raises) tile.block_min[b] = std::min(tile.block_min[b], low);' 'if (!raises) tile.block_min[b] = std::min(tile.block_min[b], high);'
fault "depth: hierarchical test drops equal values" src/raster/visibility/block_edges.h 'case CompareOp::less_equal: return say(low > block_max,' 'case CompareOp::less_equal: return say(low >= block_max,'
fault "depth written although the test has write off" src/raster/visibility/opaque_writer.h 'writes_depth_(d.tests && d.draw.state.depth.write)' 'writes_depth_(d.tests)'
fault "depth offset: slope ignores y" src/raster/primitives/setup_scalar.cpp 'std::max(std::fabs(dz_dx), std::fabs(dz_dy))' 'std::fabs(dz_dx)'
fault "perspective divide left out" src/shading/pixel.h 'return fma(w.p2, delta2, fma(w.p1, delta1, value0));' 'return fma(w.b2, delta2, fma(w.b1, delta1, value0));'
fault "interpolation: products rounded separately" src/core/lanes.h 'return fma(a, b, -cd) + error;' 'return (void)error, a * b - cd;'
fault "derivatives: x and y swapped" src/shading/pixel.h 'return derivative(member, dy, triangle->e1y, triangle->e2y, R(256));' 'return derivative(member, dx, triangle->e1x, triangle->e2x, R(-256));'
fault "cull: winding turned round" src/raster/draw_state.h 'front_facing ? CullMode::front : CullMode::back' 'front_facing ? CullMode::back : CullMode::front'
fault "provoking vertex: always the last" src/raster/primitives/setup.cpp 'provoking_(draw_.state.provoking == ProvokingVertex::first ? 0 : 2)' 'provoking_(2)'
fault "bins: last column of a triangle's box left out" src/raster/primitives/bin.cpp '((pixels.x1 - 1) >> shift) + 1, ((pixels.y1 - 1)' '((pixels.x1 - 2) >> shift) + 1, ((pixels.y1 - 1)'
fault "bins: tile rejected by the wrong corner" src/raster/primitives/bin.cpp 'e.ey < 0 ? size - 1 : 0' 'e.ey > 0 ? size - 1 : 0'
fault "scissor ignored inside a packet" src/raster/visibility/visibility_small.cpp 'if (d_.cut) lanes &=' 'if (false) lanes &='
fault "blending before the pixels that wait are shaded" src/raster/tile_worker.cpp 'if (shades && waiting && has_color_) shade_deferred(frame_, d.tile, statistics);' ''
fault "flush forgets the depth" src/raster/tile_worker.cpp 'if (!round.first) load_depth(between_flushes(depth_, depth_spill_), width, height, kept, tile);' 'if (!round.first) load_depth(depth_, width, height, kept, tile);'
fault "stencil: increments wrap where they should be held" src/raster/visibility/depth_stencil_test.cpp 'min(value + Int(1), most)' '(value + Int(1)) & most'
fault "setup in lanes: degenerate triangles are kept" src/raster/primitives/setup_simd.cpp 'take(bits(area == Int(0)), statistics.culled_degenerate);' 'take(0, statistics.culled_degenerate);'
fault "setup in lanes: the nearest vertex is not the first" src/raster/primitives/setup_simd.cpp 'rotate_lanes(one, two, z);' ''
fault "recent triangles: the one just given is written over" src/raster/shade/packet_triangles.h 'same &= ~(1u << next_);' ''
fault "gathered triangles: vertices of equal w out of order" src/raster/shade/packet_triangles.cpp '(q[2] < q[0]) & (q[2] < q[1])' '(q[2] <= q[0]) & (q[2] < q[1])'
fault "small triangles: a row of packets asked at its first pixels" src/raster/visibility/visibility_small.cpp '(e.step_x * kPacketWidth) + (e.e + rise)' '(e.step_x * kPacketWidth) + e.e'
fault "blocks that may fail the test are written whole" src/raster/visibility/block_edges.h 'case CompareOp::less: return say(low >= block_max, high < block_min);' 'case CompareOp::less: return say(low >= block_max, low < block_min);'
fault "a tile's depth bounds are those of a few blocks" src/raster/visibility/block_edges.h 'for (int b = kLanes; b < kBlocks; b += kLanes)' 'for (int b = kBlocks; b < kBlocks; b += kLanes)'
fault "constant tiles: a triangle that covers half of one fills it" src/raster/visibility/visibility_blocks.cpp 'whole &= edges.e[i] == 0 &&' 'whole &= edges.e[i] >= 0 ||'
fault "halves: rows of a quad swapped" src/raster/tile/tile_layout.h 'f(in_tile, 4 * in_image, 4 * (in_image - static_cast<std::size_t>(place.width)));' 'f(in_tile, 4 * (in_image - static_cast<std::size_t>(place.width)), 4 * in_image);'
fault "stencil: rejected blocks forget what failed" src/raster/visibility/visibility.cpp '!(d.asks_shader && d.draw.kernels.writes_depth) && !counts_failures &&' '!(d.asks_shader && d.draw.kernels.writes_depth) &&'
fault "colour mask: deferred draws forget what they keep" src/raster/pass.cpp '!blend && mask.all()' '!blend'
fault "samples: resolved without their mean in light" src/raster/tile/resolve.cpp 'x = x * share;' 'x = x * share * share;'
fault "samples: shaded for the first alone" src/raster/shade/shade.cpp 'shows & mask_from_bits<Mask>(packet.lanes);' 'shows & mask_from_bits<Mask>(s == 0 ? packet.lanes : 0);'
fault "lines: the last pixel is drawn" src/raster/pipeline/line.cpp 'end = to - (holds(b, to - 1) ? 1 : 0);' 'end = to;'
fault "lines: between two pixels always down" src/raster/pipeline/line.cpp 'const bool raised = y_major || dy > 0;' 'const bool raised = y_major;'
fault "points: clipped by their centre" src/raster/primitives/setup.cpp '(code & (kOutNear | kOutFar)) != 0' '(code & (kOutView)) != 0'
fault "point coordinate from the other side" src/raster/primitives/point_sprite.cpp 'origin == PointOrigin::upper_left' 'origin != PointOrigin::upper_left'
fault "clip distances: points are not cut" src/raster/primitives/setup.cpp ' || beyond_distances(id) != 0) {' ') {'
fault "strips: every triangle turned alike" src/raster/primitives/primitive_assembly.cpp 'if (i % 2 == 0) return' 'if (true) return'
fault "restart: the run goes on" src/raster/primitives/primitive_assembly.cpp 'begin = end + 1;' 'begin = begin + 0;'
fault "instances: rows do not move on" src/raster/vertex_input.cpp 'instance / s.divisor' 'instance / s.divisor * 0'
fault "rows stored bottom up" src/raster/tile/tile_layout.h 'target_height - 1 - (tile.y0 + y)' 'tile.y0 + y'
fault "texture: one level too coarse" src/shading/footprint.h 'return R(0.5f) * log2(' 'return R(1.0f) + R(0.5f) * log2('
fault "anisotropy: level of the longer axis" src/shading/footprint.h 'half * log2(size2)' 'half * log2(major2)'
fault "anisotropy: probes along the shorter axis" src/shading/footprint.h 'select(flat, d + root, b), y = select(flat, b, root - d)' 'select(flat, -b, d - root), y = select(flat, d + root, b)'
fault "mirrored wrap: nearest takes the wrong side of an edge" src/shading/texture_lookup.cpp 'select(coordinate < R(0.0f), !back, back)' 'back'
fault "border shows through as the edge" src/shading/texture_lookup.cpp 'select(inside, texels.to_linear(v), border)' 'texels.to_linear(v)'
fault "r16: halves of a word swapped" src/shading/texels.h 'select((i & 1) != 0, two >> 16, two) & 0xffff' 'select((i & 1) == 0, two >> 16, two) & 0xffff'
fault "environment: a cube's faces know nothing of their neighbours" src/shading/environment_levels.cpp 'out.at(0, i + 1) = beyond_edge(faces, face, -1, i);' 'out.at(0, i + 1) = middle.at(0, i);'
fault "environment: no half turn beyond the poles" src/shading/environment_levels.cpp '(x + width / 2) % width, b = (x + (width + 1) / 2) % width' 'x, b = x'
fault "environment: levels not averaged towards the poles" src/shading/environment_levels.cpp 'levels_ == 0 ? level : low_passed(level)' 'level'
fault "environment: right face mirrored" src/shading/environment.cpp 'select(is_x, -z,' 'select(is_x, z,'
fault "environment: level of a panorama twice too coarse" src/shading/environment.cpp 'log2(turn2 * (texels * texels))' 'log2(turn2 * (texels * texels) * R(4.0f))'
fault "environment: a packet reads one face alone" src/shading/environment.cpp 'left &= ~bits(here);' 'left = 0;'
fault "reflection: the normal does not turn" src/shading/reflection.h ' + dn * along)' ')'
fault "tone: light that is NaN passes" src/shading/tone.h 'return clamp(x, 0.0f, kMostLight);' 'return select(x > R(kMostLight), R(kMostLight), x);'
fault "tone: white point not squared" src/shading/tone.h 'x / R(white * white)' 'x / R(white)'
fault "tone: curves not held to 1" src/shading/tone.h 'c[k] = clamp(c[k], 0.0f, 1.0f);' 'c[k] = max(c[k], R(0.0f));'
fault "dithering: thresholds repeat" src/shading/tone.h 'bit(y, 2, 0)' 'bit(y, 1, 0)'
fault "blending: a second source is looked for in the colour's factors alone" src/raster/tile/blend.cpp ' || second(blend.source_alpha) || second(blend.destination_alpha);' ';'
fault "derivatives: quads of half a pixel" src/shading/pixel.h 'const R to_y = (R(static_cast<float>(j)) - quad_y) * R(256);' 'const R to_y = (R(static_cast<float>(j)) - quad_y) * R(128);'
fault "exact spheres: near ones as distant ones" src/shading/sphere_lens.h 'R(25) * radius * radius > dot(c, c)' 'R(0) * radius * radius > dot(c, c)'
fault "exact spheres: the rim is not decided in double" src/shading/sphere_lens.h 'if (any(close_call)) decide_in_double' 'if (false && any(close_call)) decide_in_double'
fault "shadows: the automatic bias lifts nothing" src/shading/shadow_map.h 'kAutomaticLift = 0.5f' 'kAutomaticLift = 0.0f'
fault "shadows: where nothing was drawn a steep plane is dark" src/shading/shadow_view.h 'max(depth, R(0)) >= nearest' 'depth >= nearest'
fault "map rows: the last texels are taken for inside" src/shading/map_row.h 'IntOf<R>(width - 4)' 'IntOf<R>(width - 2)'
fault "differences: one code counts as above" src/image/image_difference.cpp 'e > 1.0 / 255.0' 'e >= 1.0 / 255.0'
fault "differences: percentile a rank too low" src/image/image_difference.cpp 'std::ceil(0.999 * count)) - 1' 'std::ceil(0.999 * count)) - 2'
fault "differences: alpha never counts" src/image/image_difference.cpp 'is_opaque(a) && is_opaque(b) ? 3 : 4' 'is_opaque(a) || is_opaque(b) ? 3 : 4'
fault "similarity: the sign of the covariance is lost" src/image/image_difference.cpp '(2.0 * covariance + c2)' '(2.0 * std::abs(covariance) + c2)'
fault "studies: the front keeps what is beaten" src/study/study.cpp '(error(b) < error(a) || b.time.median_ms < a.time.median_ms)' 'error(b) < error(a)'
fault "studies: coverage upside down" src/study/polygon_area.cpp 'share.at(x, height - 1 - y)' 'share.at(x, y)'
fault "whole tiles: depth alone hides colours that wait" src/raster/visibility/full_tile.cpp 'if (shows() && d.mode != VisibilityMode::deferred) write();' ''
fault "whole tiles: what writes no depth takes the place of what does" src/raster/visibility/full_tile.cpp '(d.tests && d.draw.state.depth.write)' 'd.tests'
fault "cones: too few bands for their maps" src/render/model/chord_error.cpp 'scaled(sectors, 1.0 / 3.0)' 'scaled(sectors, 1.0 / 12.0)'
fault "exact spheres: an object's scale is lost" src/render/prepare_spheres.cpp 'o.radius * glm::length(glm::dvec3(world[0]))' 'o.radius'
fault "small triangles: no edge owns its samples" src/raster/primitives/small_coverage.h '- fill_bias(ex, ey);' '- I(1);'
fault "small triangles: the last row of samples is not asked" src/raster/primitives/small_coverage.h 'r < kCoverSide &&' 'r + 1 < kCoverSide &&'
fault "known pixels: cut at the left border alone" src/raster/visibility/visibility_small.cpp '&& py >= Int(d.bounds.y0) && px < Int(d.bounds.x1) && py < Int(d.bounds.y1);' ';'
fault "known pixels: counted from the box that nothing cuts" src/raster/visibility/visibility_small.cpp 'find_pixels(d, x, y, cut(box, d.draw.bounds), covered' 'find_pixels(d, x, y, box, covered'
fault "known pixels: more than there are" src/raster/visibility/visibility_small.cpp 'count + select(covered != Int(0), Int(1), Int(0))' 'count + Int(1)'
fault "small triangles of several draws taken for one draw's" src/raster/tile_worker.cpp '.segment() == segment) ++n;' '.segment() >= segment) ++n;'
fault "large ones among the small are left out" src/raster/visibility/visibility_small.cpp 'rasterize_plain(d, c.triangles[indices[k]], id, statistics);' ''
fault "known pixels: also of boxes with too many rows" src/raster/primitives/small_coverage.h 'select(box.is_at_most(kCoverSide, rows), centers' 'select(box.is_at_most(kCoverSide, kCoverSide), centers'
fault "triangles without a list: their first corner thrice" src/raster/primitives/setup_simd.cpp 'corner + static_cast<int32_t>(i)' 'corner'
fault "textures: the border above is the first row" src/shading/texture.cpp 'i == 0 ? last_y :' 'i == 0 ? 0 :'
fault "flat tiles: the first draw's colour goes on" src/raster/tile_worker.cpp ' && area.draw == draw' ''
fault "constant tiles: pairs whose edges only run the same way" src/raster/visibility/covered_area.h ' && a->y0 + a->ey == b->y0' ''
fault "fixed powers: one entry too low" src/core/fixed_power.h 'look_up(high_, (i >> 27) & 15)' 'look_up(high_, (i >> 27) & 7)'
fault "setup in lanes: outcodes of later vertices forgotten" src/raster/pass.cpp 'frame_.shaded[t.draw].any_outcode |= t.any' 'frame_.shaded[t.draw].any_outcode = 0 & t.any'
fault "textures: the level is one too small" src/shading/texture.h '>> 23) - 127;' '>> 23) - 129;'
fault "rows of words: from right to left" src/core/transpose.h 'row[n] = words[n];' 'row[n] = words[N - 1 - n];'
fault "fours: two words of a record swapped" src/core/transpose.h 'word(_mm512_maskz_unpacklo_pd(all8, low_ab, low_cd)), word(_mm512_maskz_unpackhi_pd(all8, low_ab, low_cd))' 'word(_mm512_maskz_unpackhi_pd(all8, low_ab, low_cd)), word(_mm512_maskz_unpacklo_pd(all8, low_ab, low_cd))'
fault "small draws: outcodes forgotten" src/raster/pass.cpp '.any_outcode = shade_vertices(' '.any_outcode = 0 & shade_vertices('
fault "small draws: the last of a task is left out" src/raster/pass.cpp 'last.end_draw = draw + 1;' 'last.end_draw = draw;'
fault "an interrupted program leaves what it had begun to write" src/image/atomic_output.cpp 'if (unfinished) ::unlink(unfinished_name);' ''

if [ "${1:-}" = list ]; then
  for i in "${!names[@]}"; do echo "$((i + 1)) ${names[$i]}"; done
  exit 0
fi
first=${1:-1} last=${2:-${1:-${#names[@]}}}
for number in "$first" "$last"; do
  [[ $number =~ ^[0-9]+$ ]] && [ "$number" -ge 1 ] && [ "$number" -le ${#names[@]} ] && continue
  echo "mutate.sh: '$number' is not a fault; expected 1 to ${#names[@]}, or list" >&2
  exit 2
done

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
git ls-files -z --cached --others --exclude-standard | xargs -0 cp --parents -t "$work"
mkdir -p "$work/build"
# The test programs that may notice a fault in a file, in the order in which they are asked: most fall in the first.
tests_of() {
  case $1 in
    src/image/atomic_output.cpp) echo scene apps ;;
    src/scene/*) echo scene ;;
    src/study/*) echo study ;;
    src/reference/*) echo reference ;;
    src/shading/*) echo shading raster property conformance ;;
    *) echo raster property conformance shading core ;;
  esac
}
# Builds and runs test programs, one after the other, up to the first that fails.
check() {
  for t in "$@"; do
    cmake --build "$work/build" --target "test-$t" > "$work/build.log" 2>&1 || return 2
    (cd "$work" && timeout 600 "build/bin/test-$t" --gtest_fail_fast --gtest_brief=1) > "$work/test.log" 2>&1 || return 1
  done
}
mapfile -t selected < <(seq $((first - 1)) $((last - 1)))

echo "building the tree without faults"
cmake -S "$work" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DHALFSPACE_BUILD_BENCHMARKS=OFF -DHALFSPACE_WERROR=OFF > "$work/cmake.log" || { cat "$work/cmake.log"; exit 1; }
check $(for i in "${selected[@]}"; do tests_of "${files[$i]}"; done | tr ' ' '\n' | awk '!seen[$0]++') || { echo "the tests fail without any fault:"; tail -30 "$work/build.log" "$work/test.log"; exit 1; }

caught=0 missed=0
for i in "${selected[@]}"; do
  file=$work/${files[$i]}
  text=$(cat "$file"; echo .)
  text=${text%.}
  once=${text/"${olds[$i]}"/"${news[$i]}"}
  rest=${text#*"${olds[$i]}"}
  if [ "$once" = "$text" ] || [[ $rest == *"${olds[$i]}"* ]]; then
    echo "fault $((i + 1)) (${names[$i]}): its text does not stand exactly once in ${files[$i]}" >&2
    exit 1
  fi
  printf '%s' "$once" > "$file"
  status=0
  check $(tests_of "${files[$i]}") || status=$?
  if [ "$status" -eq 1 ]; then
    caught=$((caught + 1))
    echo "caught $((i + 1)) ${names[$i]} ($(grep -m1 -oE '\[  FAILED  \] [A-Za-z0-9_/.]+' "$work/test.log" | cut -c14- || tail -1 "$work/test.log"))"
  else
    missed=$((missed + 1))
    echo "MISSED $((i + 1)) ${names[$i]}$([ "$status" -eq 0 ] || echo ' (does not build)')"
  fi
  printf '%s' "$text" > "$file"
  : > "$work/test.log"
done
echo "$caught caught, $missed missed"
[ "$missed" -eq 0 ]
