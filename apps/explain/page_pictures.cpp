// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numeric>

#include "explain/page_data.h"
#include "explain/page_encode.h"
#include "halfspace/raster/inspect/inspection.h"
#include "halfspace/render/frame/scene_pass.h"
#include "halfspace/scene/scene_paths.h"

namespace halfspace {

namespace {

constexpr glm::u8vec4 kNothing(0, 0, 0, 0);

// Number of timed runs. The shortest time of each tile is used.
constexpr int kTimedRuns = 5;

// Returns a picture of the colors that a function returns for each pixel.
template <class F>
std::string picture_of(const PageInput& in, const F& code_at) {
  Image<glm::u8vec4> out(in.scene.view.width_px, in.scene.view.height_px);
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) out.at(x, y) = code_at(x, y);
  }
  return picture_uri(out);
}

uint8_t code_of(float unit) { return static_cast<uint8_t>(std::clamp(unit, 0.0f, 1.0f) * 255.0f + 0.5f); }
float fraction(float x) { return x - std::floor(x); }

bool is_surface(const PageInput& in, int x, int y) { return in.values.object.at(x, y) != 0xffffffffu; }

std::string normal_picture(const PageInput& in) {
  return picture_of(in, [&](int x, int y) {
    const glm::vec3 n = in.values.normal.at(x, y) * 0.5f + 0.5f;
    return is_surface(in, x, y) ? glm::u8vec4(code_of(n.x), code_of(n.y), code_of(n.z), 255) : kNothing;
  });
}

std::string uv_picture(const PageInput& in) {
  return picture_of(in, [&](int x, int y) {
    const glm::vec2 uv = in.values.uv.at(x, y);
    return is_surface(in, x, y) ? glm::u8vec4(code_of(fraction(uv.x)), code_of(fraction(uv.y)), 64, 255) : kNothing;
  });
}

std::string position_picture(const PageInput& in) {
  glm::vec3 low(1e30f), high(-1e30f);
  for (int y = 0; y < in.scene.view.height_px; ++y) {
    for (int x = 0; x < in.scene.view.width_px; ++x) {
      if (!is_surface(in, x, y)) continue;
      low = glm::min(low, in.values.position.at(x, y));
      high = glm::max(high, in.values.position.at(x, y));
    }
  }
  const glm::vec3 size = glm::max(high - low, glm::vec3(1e-20f));
  return picture_of(in, [&](int x, int y) {
    const glm::vec3 p = (in.values.position.at(x, y) - low) / size;
    return is_surface(in, x, y) ? glm::u8vec4(code_of(p.x), code_of(p.y), code_of(p.z), 255) : kNothing;
  });
}

std::string albedo_picture(const PageInput& in) {
  return picture_of(in, [&](int x, int y) { return is_surface(in, x, y) ? srgb_code(in.values.albedo.at(x, y)) : kNothing; });
}

// Returns a picture with one color per triangle, the same on every machine.
std::string triangle_picture(const PageInput& in) {
  return picture_of(in, [&](int x, int y) {
    uint32_t h = (in.values.object.at(x, y) * 31 + in.values.instance.at(x, y)) * 977 + in.values.triangle.at(x, y);
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    h ^= h >> 15;
    const auto part = [&](int shift) { return static_cast<uint8_t>(70 + (h >> shift & 127)); };
    return is_surface(in, x, y) ? glm::u8vec4(part(0), part(8), part(16), 255) : kNothing;
  });
}

std::string barycentric_picture(const PageInput& in) {
  return picture_of(in, [&](int x, int y) {
    const glm::vec3 b = in.values.barycentrics.at(x, y);
    return is_surface(in, x, y) ? glm::u8vec4(code_of(b.x), code_of(b.y), code_of(b.z), 255) : kNothing;
  });
}

}  // namespace

PageJson pictures_json(const PageInput& in, const Image<glm::u8vec4>& picture) {
  return {{"final", picture_uri(picture)},          {"normal", normal_picture(in)}, {"uv", uv_picture(in)},
          {"position", position_picture(in)},       {"albedo", albedo_picture(in)}, {"triangles", triangle_picture(in)},
          {"barycentrics", barycentric_picture(in)}};
}

// The objects whose shaders read a normal or bump map.
struct HasRelief {
  template <ShadingRate rate, bool mapped, NormalDetail detail, bool highlight>
  bool operator()(const SurfaceShader<rate, mapped, detail, highlight>&) const {
    return detail != NormalDetail::none;
  }
  template <class S>
  requires std::derived_from<S, MetallicMaterial>
  bool operator()(const S& s) const { return s.maps[kNormalMap].map != nullptr; }
  bool operator()(const auto&) const { return false; }
};

PageJson surfaces_json(const PageInput& in) {
  std::vector<std::string> relief;
  for (const PreparedDraw& draw : in.scene.draws) {
    const std::string name = object_name(in.description, draw.source.object);
    if (std::visit(HasRelief{}, draw.shader) && std::ranges::find(relief, name) == relief.end()) relief.push_back(name);
  }
  glm::vec2 low(0.0f), high(0.0f);
  bool is_first = true;
  for (int y = 0; y < in.scene.view.height_px; ++y) {
    for (int x = 0; x < in.scene.view.width_px; ++x) {
      if (!is_surface(in, x, y)) continue;
      const glm::vec2 uv = in.values.uv.at(x, y);
      low = is_first ? uv : glm::min(low, uv);
      high = is_first ? uv : glm::max(high, uv);
      is_first = false;
    }
  }
  return {{"relief", relief}, {"uv_low", json_of(glm::dvec2(low))}, {"uv_high", json_of(glm::dvec2(high))}};
}

PageJson depth_json(const PageInput& in) {
  const Image<float> depth = depth_buffer(in.scene, in.workers);
  float low = 1.0f, high = 0.0f;
  for (const float z : depth.texels()) {
    if (z <= 0.0f) continue;
    low = std::min(low, z);
    high = std::max(high, z);
  }
  // Depth is shown on a logarithmic scale, because most of the scene is close to 0.
  const float from = std::log2(std::max(low, 1e-30f)), range = std::max(std::log2(std::max(high, 1e-30f)) - from, 1e-6f);
  const std::string picture = picture_of(in, [&](int x, int y) {
    const float z = depth.at(x, y);
    return z > 0.0f ? heat_color((std::log2(z) - from) / range) : kNothing;
  });
  const DepthBlocks blocks = depth_blocks(in.scene, in.trace);
  return {{"picture", picture},
          {"low", low},
          {"high", high},
          {"values", packed_planes(depth.texels())},
          {"block_low", packed_planes(std::span<const float>(blocks.low))},
          {"block_high", packed_planes(std::span<const float>(blocks.high))}};
}

PageJson mip_json(const PageInput& in) {
  const Image<MipLookup> mips = mip_levels(in.scene, in.workers);
  float low = 0.0f, high = 0.0f;
  uint64_t pixels = 0;
  glm::ivec2 pixel = in.pixel;  // or the first pixel with a color map
  const bool has_map = mips.at(pixel.x, pixel.y).probes != 0.0f;
  for (int y = mips.height() - 1; y >= 0; --y) {
    for (int x = mips.width() - 1; x >= 0; --x) {
      const MipLookup& m = mips.at(x, y);
      if (m.probes == 0.0f) continue;
      low = pixels == 0 ? m.lod : std::min(low, m.lod);
      high = pixels == 0 ? m.lod : std::max(high, m.lod);
      ++pixels;
      if (!has_map) pixel = {x, y};
    }
  }
  if (pixels == 0) return nullptr;
  const float range = std::max(high + 1.0f, 1.0f);  // from level −1 (magnified) to the highest level
  const std::string picture = picture_of(in, [&](int x, int y) {
    const MipLookup& m = mips.at(x, y);
    return m.probes == 0.0f ? kNothing : heat_color((std::max(m.lod, -1.0f) + 1.0f) / range);
  });
  std::vector<float> lods;
  for (const MipLookup& m : mips.texels()) lods.push_back(m.probes == 0.0f ? -100.0f : std::round(m.lod * 64.0f) / 64.0f);
  const MipLookup& at = mips.at(pixel.x, pixel.y);
  return {{"picture", picture},
          {"low", low},
          {"high", high},
          {"pixels", pixels},
          {"values", packed_planes(std::span<const float>(lods))},
          {"pixel",
           {{"at", {pixel.x, pixel.y}},
            {"lod", at.lod},
            {"probes", at.probes},
            {"anisotropic", at.is_anisotropic},
            {"axes", {at.axes.x, at.axes.y}}}}};
}

PageJson overdraw_json(const PageInput& in, const FrameTrace& trace) {
  std::vector<uint32_t> counts;
  for (int y = 0; y < trace.height; ++y) {
    for (int x = 0; x < trace.width; ++x) counts.push_back(trace.count({x, y}));
  }
  const uint32_t max_count = *std::ranges::max_element(counts);
  std::vector<uint64_t> histogram(std::min<uint32_t>(max_count, 64) + 1);
  uint64_t total = 0;
  for (const uint32_t n : counts) {
    ++histogram[std::min<std::size_t>(n, histogram.size() - 1)];
    total += n;
  }
  const auto unshaded = std::ranges::count(trace.fragments, false, &TracedFragment::is_shaded);
  const auto dropped = std::accumulate(trace.others.begin(), trace.others.end(), uint64_t{0});
  const std::string picture = picture_of(in, [&](int x, int y) {
    const auto n = static_cast<float>(trace.count({x, y}));
    return n == 0.0f ? kNothing : heat_color(n / static_cast<float>(max_count));
  });
  return {{"picture", picture},
          {"most", max_count},
          {"least", *std::ranges::min_element(counts)},
          {"total", total},
          {"unshaded", static_cast<uint64_t>(unshaded) + dropped},
          {"histogram", histogram},
          {"counts", packed_planes(std::span<const uint32_t>(counts))}};
}

PageJson tile_times_json(const PageInput& in) {
  const Workers one(1);
  std::vector<float> best;
  for (int i = 0; i < kTimedRuns; ++i) {
    Image<glm::u8vec4> picture(in.scene.view.width_px, in.scene.view.height_px);
    std::vector<float> ms;
    render_with(in.scene, picture, one, [&](Pass& pass) { return run_timed(pass, one, ms); });
    if (best.empty()) best = ms;
    std::ranges::transform(best, ms, best.begin(), [](float a, float b) { return std::min(a, b); });
  }
  return {{"runs", kTimedRuns}, {"ms", best}};
}

}  // namespace halfspace
