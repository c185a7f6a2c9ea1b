// SPDX-License-Identifier: Apache-2.0
#include "explain/page_quotes.h"

#include <algorithm>
#include <array>
#include <vector>

#include "halfspace/core/check.h"

namespace halfspace {

namespace {

// The quotes of a chapter are in the order in which the renderer takes these steps.
constexpr std::array kRanges{
    QuoteRange{"spaces", "src/shading/surface/surface_shader.h", "return clip_from_object * vec4<R>(in.position_os, R(1));",
               "return clip_from_object"},
    QuoteRange{"spaces", "src/raster/pipeline/window.h", "HS_INLINE WindowVertex<R> window_vertex(", "outcode(v, depth, x, y, z, w)};"},
    QuoteRange{"geometry", "src/shading/surface/normal_lines.h", "void geometry(const GeometryInput", "out.end_primitive();"},
    QuoteRange{"clipping", "src/raster/primitives/clip.cpp", "const auto keep = [&kept]", "if (!a_in && b_in) keep(cut_edge(b, a));"},
    QuoteRange{"culling", "src/raster/primitives/setup_scalar.cpp", "const int64_t area = e1x * e2y", "return Cull::face;"},
    QuoteRange{"setup", "src/raster/pipeline/edge.h", "int64_t at(int64_t x, int64_t y) const", "int64_t at("},
    QuoteRange{"setup", "src/raster/primitives/setup_scalar.cpp", "out.z0 = z_min + offset;", "out.z_edge2 ="},
    QuoteRange{"binning", "src/raster/primitives/bin.cpp", "// Returns the maximum of E over the bounding box", "return e.at(int64_t{px}"},
    QuoteRange{"binning", "src/raster/primitives/bin.cpp", "const auto is_inside = [&]", "runs.put_row(first, x, y, index);"},
    QuoteRange{"coverage", "src/raster/visibility/coverage/tile_edges.h", "BlockCoverage block_coverage(int x, int y) const",
               "return whole ?"},
    QuoteRange{"coverage", "src/raster/visibility/coverage/blocks.cpp", "const auto lanes_at = [&](int p, std::size_t k)",
               "return seen & ~negative_bits("},
    QuoteRange{"coverage", "src/raster/pipeline/edge.h", "HS_INLINE auto is_top_left(I ex, I ey)", "return ey < I(0)"},
    QuoteRange{"depth", "src/raster/visibility/tests/depth_bounds.h", "case CompareOp::greater: return outcome(",
               "case CompareOp::greater: return"},
    QuoteRange{"depth", "src/raster/visibility/coverage/depth_plane.h", "return depth_value(format, clamp(fma(e1, z_edge1",
               "return depth_value(format, clamp(fma("},
    QuoteRange{"interpolation", "src/shading/pixel.h", "const R e0 = difference_of_products(t.e1x - dx", "return {p.p1, p.p2"},
    QuoteRange{"varyings", "src/shading/pixel.h", "HS_INLINE R interpolate(const Weights<R>& w", "return fma(w.p2, delta2"},
    QuoteRange{"mips", "src/shading/texture/footprint.h", "HS_INLINE R squared_scale_factor(", "return max("},
    QuoteRange{"mips", "src/shading/texture/footprint.h", "HS_INLINE R level_of_detail(", "return R(0.5f)"},
    QuoteRange{"mips", "src/shading/texture/footprint.h", "const R a = fma(ux, ux, uy * uy)", "const R size2 = max("},
    QuoteRange{"lighting", "src/shading/light/lighting.h", "for (const Light& light : lights) {", "sum.specular += light.specular"},
    QuoteRange{"lighting", "src/shading/surface/lit_surface.h", "static HS_INLINE vec3<R> reflected(", "return m[kColor]"},
    QuoteRange{"shadows", "src/shading/shadow/shadow_bias.h", "const R tangent = min(tangent_of(", "automatic_depth_offset(s, tangent)"},
    QuoteRange{"shadows", "src/shading/shadow/shadow_view.h", "HS_INLINE R lit(const ShadowCoordinates<R>& p", "return select("},
    QuoteRange{"shadows", "src/shading/shadow/shadow_filter.h", "HS_INLINE R box_pcf(const ShadowView& view", "return sum * R("},
    QuoteRange{"tone", "src/shading/values/tone.h", "HS_INLINE R tone_curve(ToneCurve curve", "case ToneCurve::aces:"},
    QuoteRange{"srgb", "src/core/srgb_curve.h", "static constexpr FixedPower power_of", "return min(select("},
    QuoteRange{"samples", "src/raster/tile/resolve.cpp", "// Returns the mean of `samples` colors.", "for (Real& x : mean)"},
    QuoteRange{"layers", "src/raster/tile/layers.cpp", "Mask TransparentLayers::add(", "return "},
    QuoteRange{"layers", "src/raster/tile/layers.cpp", "void TransparentLayers::write(", "write_color("},
    QuoteRange{"final", "src/raster/loop/tile_worker.cpp", "load(tile, replaces_color(tile_x, tile_y));",
               "if (has_post_step) run_post_step("},
    QuoteRange{"history", "src/raster/trace/tile_trace.cpp", "void TileTrace::add(", "f.is_tested = "},
    QuoteRange{"history", "src/raster/trace/tile_trace.cpp", "void TileTrace::set_shaded(", "f.color = color_of("},
    QuoteRange{"overdraw", "src/raster/visibility/tests/depth_bounds.h", "case CompareOp::greater: return outcome(",
               "case CompareOp::greater: return"},
    QuoteRange{"overdraw", "apps/explain/pixel_history.cpp", "uint32_t FrameTrace::count(", "return first"},
    QuoteRange{"times", "src/raster/loop/tile_worker.cpp", "const auto start = std::chrono", "const std::chrono::duration"},
    QuoteRange{"statistics", "src/raster/statistics.h", "uint64_t vertices_in", "uint64_t flushes"},
};

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    lines.push_back(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  }
  return lines;
}

std::size_t indentation(std::string_view line) { return std::min(line.find_first_not_of(' '), line.size()); }

}  // namespace

std::span<const QuoteRange> quote_ranges() { return kRanges; }

std::string_view embedded_text(std::string_view name) {
  for (const EmbeddedFile& file : embedded_files()) {
    if (file.name == name) return file.text;
  }
  HS_CHECK(false, "explain: the quoted source was not found; expected it in the sources that are built in");
  return {};
}

Quote quote(const QuoteRange& range) {
  const std::vector<std::string_view> lines = lines_of(embedded_text(range.file));
  const auto contains = [](std::string_view part) { return [part](std::string_view line) { return line.find(part) != line.npos; }; };
  const auto first = std::find_if(lines.begin(), lines.end(), contains(range.from));
  const auto last = std::find_if(first, lines.end(), contains(range.to));
  Quote out{std::string(range.file), 0, {}};
  if (last == lines.end()) return out;
  out.line = static_cast<int>(first - lines.begin()) + 1;
  std::size_t margin = indentation(*first);
  for (auto line = first; line <= last; ++line) {
    if (!line->empty()) margin = std::min(margin, indentation(*line));
  }
  for (auto line = first; line <= last; ++line) out.text += std::string(line->substr(std::min(margin, line->size()))) + "\n";
  return out;
}

}  // namespace halfspace
