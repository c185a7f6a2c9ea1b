// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "conformance/geometry.h"
#include "conformance/groups.h"

namespace halfspace::conformance {

namespace {

// ---- clears --------------------------------------------------------------------------------------------------------

constexpr std::pair<const char*, ColorFormat> kColors[] = {
    {"rgba8", ColorFormat::rgba8}, {"srgb8", ColorFormat::srgb8a8}, {"rgba16f", ColorFormat::rgba16f}, {"rgba32f", ColorFormat::rgba32f}};
constexpr std::pair<const char*, DepthFormat> kDepthFormats[] = {{"d16", DepthFormat::d16},
                                                                 {"d24", DepthFormat::d24},
                                                                 {"d32f", DepthFormat::d32f},
                                                                 {"d24s8", DepthFormat::d24s8},
                                                                 {"d32fs8", DepthFormat::d32fs8}};

// Every pixel must have the clear value, converted to the format.
std::string cleared(const Picture& p, const Seen& seen) {
  const ColorFormat format = p.colors[0];
  glm::dvec4 color(p.clear_color);
  for (int k = 0; k < 4; ++k) {
    if (format == ColorFormat::rgba32f || format == ColorFormat::rgba16f) continue;
    color[k] = std::clamp(color[k], 0.0, 1.0);
    if (format == ColorFormat::srgb8a8 && k < 3)
      color[k] = color[k] <= 0.0031308 ? 12.92 * color[k] : 1.055 * std::pow(color[k], 1.0 / 2.4) - 0.055;
  }
  const double codes = depth_part(p.depth) == DepthFormat::d24 ? 16777215.0 : p.depth == DepthFormat::d16 ? 65535.0 : 0.0;
  const auto z = static_cast<double>(p.clear_depth), depth = codes > 0.0 ? std::floor(z * codes + 0.5) : z;
  return for_each_pixel(seen, [&](int x, int y) -> std::string {
    if (seen.depth(x, y) != depth) return "depth " + std::to_string(seen.depth(x, y)) + ", expected " + std::to_string(depth);
    if (has_stencil(p.depth) && seen.stencil(x, y) != p.clear_stencil) return "stencil " + std::to_string(seen.stencil(x, y));
    const double largest = std::max({std::fabs(color.x), std::fabs(color.y), std::fabs(color.z), std::fabs(color.w)});
    const double tolerance = format == ColorFormat::rgba32f ? 0.0 : format == ColorFormat::rgba16f ? largest * 0x1p-11 : kHalfCode;
    return expect_near(color, seen.color(x, y), tolerance);
  });
}

void add_clears(Cases& cases) {
  constexpr glm::vec4 kValues[] = {
      {0, 0, 0, 0}, {1, 1, 1, 1}, {0.25f, 0.5f, 0.75f, 0.125f}, {0.999f, 0.001f, 0.5019f, 0.7f}, {-2.0f, 3.0f, 0.3f, 5.0f}};
  for (const auto& [name, format] : kColors) {
    for (int i = 0; i < 5; ++i) {
      const ColorFormat f = format;
      cases.push_back({std::string("color_") + name + "_" + std::to_string(i),
                       [=] {
                         Picture p;
                         p.width = p.height = 16;
                         p.colors = {f};
                         p.clear_color = kValues[i];
                         p.samples = i == 3 ? 4 : 1;
                         return p;
                       },
                       cleared, true});
    }
  }
  constexpr std::pair<float, uint8_t> kPairs[] = {{0.0f, 0}, {1.0f, 255}, {0.3f, 0x5a}};
  for (const auto& [name, format] : kDepthFormats) {
    for (int i = 0; i < 3; ++i) {
      const DepthFormat f = format;
      cases.push_back({std::string("depth_stencil_") + name + "_" + std::to_string(i),
                       [=] {
                         Picture p;
                         p.width = p.height = 16;
                         p.depth = f;
                         p.clear_color = color_number(i);
                         p.clear_depth = kPairs[i].first;
                         p.clear_stencil = kPairs[i].second;
                         return p;
                       },
                       cleared, true});
    }
  }
}

// A quad that writes color, depth and stencil, which a clear then replaces in part, in the middle of the pass.
constexpr glm::vec4 kUnder{0.25f, 0.5f, 0.75f, 1.0f}, kOver{0.75f, 0.125f, 0.5f, 0.25f};
constexpr uint8_t kUnderStencil = 0xa5;

Picture cleared_in_part(const ClearValues& values, ColorFormat format, int samples) {
  Picture p;
  p.width = p.height = 16;
  p.colors = {format};
  p.samples = samples;
  Drawing quad;
  add_rectangle(quad, p, {0.0, 0.0, 16.0, 16.0}, kUnder, 0.5f);  // depth 3/4
  const StencilFace face{.pass = StencilOp::replace, .reference = kUnderStencil};
  quad.state.stencil = StencilState{face, face};
  p.draws.push_back(std::move(quad));
  Drawing nothing;
  nothing.vertices.resize(3);  // no area
  nothing.clear = values;
  p.draws.push_back(std::move(nothing));
  return p;
}

std::string partly_cleared(const Picture& p, const Seen& seen) {
  const ClearValues& values = *p.draws[1].clear;
  const std::array<bool, 4> written{values.mask.r, values.mask.g, values.mask.b, values.mask.a};
  const bool has_codes = p.colors[0] == ColorFormat::rgba8 || p.colors[0] == ColorFormat::srgb8a8;
  return for_each_pixel(seen, [&](int x, int y) -> std::string {
    const Rect r = values.rect.value_or(Rect{0, 0, p.width, p.height});
    const bool inside = x >= r.x && x < r.x + r.width && y >= r.y && y < r.y + r.height;
    glm::dvec4 color(kUnder);
    for (int k = 0; k < 4; ++k) {
      if (inside && values.colors[0] && written[static_cast<std::size_t>(k)]) color[k] = static_cast<double>((*values.colors[0])[k]);
      if (p.colors[0] == ColorFormat::srgb8a8 && k < 3) color[k] = 1.055 * std::pow(color[k], 1.0 / 2.4) - 0.055;
    }
    const double depth = inside && values.depth ? static_cast<double>(*values.depth) : 0.75;
    const int mask = inside && values.stencil ? values.stencil_mask : 0;
    const int stencil = (kUnderStencil & ~mask) | (values.stencil.value_or(0) & mask);
    if (seen.depth(x, y) != depth) return "depth " + std::to_string(seen.depth(x, y)) + ", expected " + std::to_string(depth);
    if (seen.stencil(x, y) != stencil) return "stencil " + std::to_string(seen.stencil(x, y)) + ", expected " + std::to_string(stencil);
    // The values are exact in floats and halfs; 8-bit values are rounded.
    return expect_near(color, seen.color(x, y), has_codes ? kHalfCode : 0.0);
  });
}

void add_partial_clears(Cases& cases) {
  const auto add = [&](const std::string& name, const ClearValues& values, ColorFormat format, int samples, bool may_be_constant) {
    cases.push_back({name, [=] { return cleared_in_part(values, format, samples); }, partly_cleared, may_be_constant});
  };
  constexpr std::pair<const char*, ColorMask> kMasks[] = {{"all", {}},
                                                          {"red", {true, false, false, false}},
                                                          {"green_alpha", {false, true, false, true}},
                                                          {"not_green", {true, false, true, true}},
                                                          {"none", {false, false, false, false}}};
  for (const bool scissored : {false, true}) {
    const std::optional<Rect> rect = scissored ? std::optional(Rect{3, 2, 9, 20}) : std::nullopt;
    const std::string prefix = scissored ? "scissored_" : "";
    for (const auto& [format_name, format] : kColors) {
      for (const auto& [mask_name, mask] : kMasks) {
        add(prefix + "masked_color_" + format_name + "_" + mask_name, {.rect = rect, .colors = {kOver}, .mask = mask}, format,
            format == ColorFormat::rgba8 ? 4 : 1, true);
      }
    }
    const ClearValues depth{.rect = rect, .depth = 0.125f};
    add(prefix + "depth", depth, ColorFormat::rgba8, 1, true);
    for (const uint8_t mask : {uint8_t{0xff}, uint8_t{0x0f}, uint8_t{0x81}})
      add(prefix + "masked_stencil_" + std::to_string(mask), {.rect = rect, .stencil = uint8_t{0x3c}, .stencil_mask = mask},
          ColorFormat::rgba8, mask == 0x0f ? 4 : 1, true);
  }
}

// ---- instances -----------------------------------------------------------------------------------------------------

// Draws a 2 px wide column for each instance, starting at the left. `rows` contains their green values, one row per `divisor` instances.
Picture instanced(uint32_t instances, uint32_t divisor, bool indexed, bool strip) {
  Picture p;
  Drawing d;
  d.kind = Kind::instance;
  d.value = 2.0f / 16.0f;  // 2 px in NDC
  d.state.instances = instances;
  add_rectangle(d, p, {0, 4, 2, 28}, {0.75f, 0, 0, 1});
  if (strip) {
    d.state.topology = Topology::triangle_strip;
    d.indices = {0, 1, 3, 2};
  }
  if (!indexed) {
    std::vector<Vertex> in_order;
    for (const uint32_t i : d.indices) in_order.push_back(d.vertices[i]);
    d.vertices = in_order;
    d.indices.clear();
  }
  if (divisor > 0) {
    d.divisor = divisor;
    for (uint32_t i = 0; i <= instances / divisor; ++i) d.rows.push_back({0, 0, 0, static_cast<float>(i + 1) / 32.0f});
  }
  p.draws.push_back(std::move(d));
  return p;
}

std::string columns_in_order(const Picture& p, const Seen& seen) {
  const Drawing& d = p.draws[0];
  return for_each_pixel(seen, [&](int x, int y) {
    const auto instance = static_cast<uint32_t>(x / 2);
    glm::dvec4 expected(0.0);
    if (instance < d.state.instances && y >= 4 && y < 28) {
      const double green = d.rows.empty() ? 0.0 : (instance / d.divisor + 1) / 32.0;
      expected = {0.75, green, instance / 32.0, 1.0};
    }
    return expect_near(expected, seen.color(x, y), kHalfCode);
  });
}

void add_instances(Cases& cases) {
  for (const uint32_t instances : {0u, 1u, 2u, 4u, 16u}) {
    for (const uint32_t divisor : {0u, 1u, 2u, 4u}) {
      for (const bool indexed : {false, true}) {
        const std::string name =
            std::string(indexed ? "elements_" : "arrays_") + std::to_string(instances) + "_instances_divisor_" + std::to_string(divisor);
        const bool strip = (instances + divisor) % 3 == 1;
        cases.push_back({name, [=] { return instanced(instances, divisor, indexed, strip); }, columns_in_order, instances == 0});
      }
    }
  }
}

// ---- primitive restart ---------------------------------------------------------------------------------------------

constexpr std::pair<const char*, Topology> kTopologies[] = {{"points", Topology::points},
                                                            {"lines", Topology::lines},
                                                            {"line_strip", Topology::line_strip},
                                                            {"line_loop", Topology::line_loop},
                                                            {"triangles", Topology::triangles},
                                                            {"triangle_strip", Topology::triangle_strip},
                                                            {"triangle_fan", Topology::triangle_fan}};
constexpr const char* kPlaces[] = {"begin", "end", "middle", "twice", "every_third", "every_fourth", "incomplete", "often", "only"};
constexpr int kPlaceCount = 9, kIndices = 13;

// Returns whether a restart precedes index i (0 to 12).
bool restarts_before(int place, int i) {
  switch (place) {
    case 0: return i == 0;
    case 1: return i == kIndices;
    case 2:
    case 3: return i == 6;
    case 4: return i > 0 && i % 3 == 0;
    case 5: return i > 0 && i % 4 == 0;
    case 6: return i == 2 || i == 7 || i == 8;
    case 7: return i % 2 == 1;
    default: return true;
  }
}

Picture restarted(Topology topology, int place, bool narrow, uint32_t instances) {
  Picture p;
  Drawing d;
  d.mode = kFlat;
  d.state.topology = topology;
  d.state.point_size = 3.0f;
  d.state.depth.test = false;
  d.state.instances = instances;
  if (instances > 1) {
    d.kind = Kind::instance;
    d.value = 0.2f;
  }
  d.vertices = scattered(p, kIndices, 31);
  d.restart = true;
  if (narrow) d.index_layout = IndexLayout::narrow;
  for (int i = 0; i <= kIndices; ++i) {
    const int times = !restarts_before(place, i) ? 0 : place == 3 ? 2 : 1;
    d.indices.insert(d.indices.end(), static_cast<std::size_t>(times), oracle::kRestart);
    if (i < kIndices) d.indices.push_back(static_cast<uint32_t>((i * 5) % kIndices));
  }
  p.draws.push_back(std::move(d));
  return p;
}

// The picture must equal that of separate draws: one for each instance and each run of indices between restarts.
std::string as_single_draws(const Picture& p, const Seen& seen) {
  Picture single = p;
  single.draws.clear();
  const Drawing& all = p.draws[0];
  for (uint32_t instance = 0; instance < all.state.instances; ++instance) {
    Drawing run = all;
    run.restart = false;
    run.state.instances = 1;
    if (all.kind == Kind::instance) {  // in these draws, the single instance is number 0
      run.kind = Kind::color;
      run.mode = kSmooth;
      for (Vertex& v : run.vertices) {
        v.pos_clip.x += static_cast<float>(instance) * all.value;
        v.color.y = v.extra.w;
        v.color.z = static_cast<float>(instance) / 32.0f;
      }
    }
    run.indices.clear();
    for (const uint32_t i : all.indices) {
      if (i != oracle::kRestart) run.indices.push_back(i);
      if (i == oracle::kRestart && !run.indices.empty()) {
        single.draws.push_back(run);
        run.indices.clear();
      }
    }
    if (!run.indices.empty()) single.draws.push_back(run);
  }
  const Seen expected = draw(single);
  return for_each_pixel(seen, [&](int x, int y) { return expect_near(glm::dvec4(expected.color(x, y)), seen.color(x, y), 0.0); });
}

void add_restarts(Cases& cases) {
  for (const auto& [name, topology] : kTopologies) {
    for (int place = 0; place < kPlaceCount; ++place) {
      for (const bool narrow : {false, true}) {
        const Topology t = topology;
        const uint32_t instances = (place + (narrow ? 1 : 0)) % 4 == 3 ? 3 : 1;
        const std::string suffix = std::string(narrow ? "_u16" : "_u32") + (instances > 1 ? "_instanced" : "");
        cases.push_back({std::string(name) + "_" + kPlaces[place] + suffix, [=] { return restarted(t, place, narrow, instances); },
                         as_single_draws, place >= 6});
      }
    }
  }
}

}  // namespace

Cases clears_cases() {
  Cases cases;
  add_clears(cases);
  add_partial_clears(cases);
  return cases;
}

Cases instanced_cases() {
  Cases cases;
  add_instances(cases);
  return cases;
}

Cases primitive_restart_cases() {
  Cases cases;
  add_restarts(cases);
  return cases;
}

}  // namespace halfspace::conformance
