// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "explain/history_text.h"
#include "explain/page_data.h"
#include "explain/page_encode.h"
#include "explain/stage_shadow.h"
#include "explain/stage_terms.h"
#include "explain/stage_tone.h"
#include "halfspace/raster/pipeline/sample_pattern.h"
#include "halfspace/shading/shadow/terminator.h"

namespace halfspace {

namespace {

glm::vec3 rgb(const glm::vec4& c) { return glm::vec3(c); }

Image<glm::u8vec4> displayed(const PreparedScene& scene, const ToneMapping& tone, const Image<glm::vec4>& light) {
  Image<glm::u8vec4> out(light.width(), light.height());
  std::ranges::transform(light.texels(), out.data(),
                         [&](const glm::vec4& c) { return glm::u8vec4(tone_steps(scene, tone, rgb(c)).code, 255); });
  return out;
}

glm::dvec3 mean_of(const Image<glm::vec4>& light) {
  glm::dvec3 sum(0.0);
  for (const glm::vec4& c : light.texels()) sum += glm::dvec3(c);
  return sum / static_cast<double>(light.texels().size());
}

// Returns a gray picture of the shadow factors of a light, computed from its diffuse light with and without shadows. Pixels that the light
// does not reach are transparent. Counts the pixels that are fully or partly in shadow.
Image<glm::u8vec4> shadow_factors(const Image<glm::vec4>& with, const Image<glm::vec4>& without, std::array<int, 2>& shadowed) {
  Image<glm::u8vec4> out(with.width(), with.height());
  std::ranges::transform(with.texels(), without.texels(), out.data(), [&](const glm::vec4& a, const glm::vec4& b) {
    const float full = b.x + b.y + b.z;
    if (!(full > 0.0f)) return glm::u8vec4(0, 0, 0, 0);
    const auto code = static_cast<uint8_t>(std::clamp((a.x + a.y + a.z) / full, 0.0f, 1.0f) * 255.0f + 0.5f);
    if (code < 255) ++shadowed[code == 0 ? 0 : 1];
    return glm::u8vec4(code, code, code, 255);
  });
  return out;
}

// Counts the pixels with a channel of at least 1 after exposure. Without HDR, light is stored in 8 bits, and 1 is the largest value.
int64_t clamped_pixels(const Image<glm::vec4>& light, float exposure) {
  return std::ranges::count_if(light.texels(), [&](const glm::vec4& c) { return std::max({c.x, c.y, c.z}) * exposure >= 1.0f; });
}

struct SurfaceAt {
  glm::vec3 position_rws, face_ws, normal_ws;
  SmoothSurface smooth;
};

const PreparedDraw* draw_at(const PageInput& in, int x, int y) {
  const uint32_t object = in.values.object.at(x, y), instance = in.values.instance.at(x, y);
  for (const PreparedDraw& d : in.scene.draws) {
    const auto first = static_cast<uint32_t>(d.source.instance);
    if (d.source.object == static_cast<int>(object) && instance == first && !d.source.streams.positions.empty()) return &d;
  }
  return nullptr;
}

// corners: of the triangle at pixel p. side: −1 if its clockwise side is visible, otherwise 1.
SmoothSurface smooth_surface(const PageInput& in, const PreparedDraw& draw, const std::array<glm::dvec3, 3>& corners, double side,
                             const glm::ivec2& p) {
  if (draw.source.streams.normals.empty()) return {};
  const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(draw.source.world_from_object)));
  if (glm::determinant(turn) < 0.0) side = -side;
  const glm::vec3 weights = in.values.barycentrics.at(p.x, p.y);
  std::array<vec3<double>, 3> points, normals;
  glm::dvec3 sum(0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const uint32_t vertex = (*draw.indices)[std::size_t{in.values.triangle.at(p.x, p.y)} * 3 + k];
    const glm::dvec3 n = side * unit_or_zero(turn * glm::dvec3(draw.source.streams.normals[vertex]));
    points[k] = vec3<double>(corners[k]);
    normals[k] = vec3<double>(n);
    sum += n * double{weights[static_cast<int>(k)]};
  }
  const double height = smooth_height<double>(points, normals, {double{weights.x}, double{weights.y}, double{weights.z}});
  return {glm::vec3(unit_or_zero(sum)), static_cast<float>(height)};
}

// Returns the surface at a pixel, or nullopt if it is not part of a mesh.
std::optional<SurfaceAt> surface_at(const PageInput& in, int x, int y) {
  const PreparedDraw* draw = draw_at(in, x, y);
  if (draw == nullptr || draw->state.topology != Topology::triangles) return std::nullopt;
  const std::size_t first = std::size_t{in.values.triangle.at(x, y)} * 3;
  std::array<glm::dvec3, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::vec3 os = draw->source.streams.positions[(*draw->indices)[first + k]];
    corners[k] = glm::dvec3(draw->source.world_from_object * glm::dvec4(os, 1.0)) - in.scene.view.eye_ws;
  }
  const glm::dvec3 position = glm::dvec3(in.values.position.at(x, y)) - in.scene.view.eye_ws;
  glm::dvec3 face = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  const double side = glm::dot(face, position) > 0.0 ? -1.0 : 1.0;
  face *= side;
  return SurfaceAt{glm::vec3(position), glm::vec3(face), in.values.normal.at(x, y), smooth_surface(in, *draw, corners, side, {x, y})};
}

std::optional<ShadowLookup> lookup_at(const PageInput& in, const Light& light, int x, int y) {
  const std::optional<SurfaceAt> s = surface_at(in, x, y);
  if (!s) return std::nullopt;
  const glm::vec2 window(static_cast<float>(x) + 0.5f, static_cast<float>(in.scene.view.height_px - y) - 0.5f);
  return shadow_lookup(light, s->position_rws, s->face_ws, s->normal_ws, window, s->smooth);
}

// Returns the pixel whose shadow lookup the page shows: the example pixel if it is partially shadowed. Otherwise, searches every fourth
// pixel in x and y for the partially shadowed pixel nearest to the example pixel. If there is none, takes the nearest pixel that faces the
// light and is inside one of its views.
glm::ivec2 shadow_pixel(const PageInput& in, const Light& light) {
  constexpr int64_t kNone = INT64_MAX, kNotPartial = int64_t{1} << 40;
  const auto distance_of = [&](int x, int y) {
    const std::optional<ShadowLookup> at = lookup_at(in, light, x, y);
    if (!at || at->view < 0 || glm::dot(at->normal_ws, at->to_light_ws) <= 0.0f) return kNone;
    const int64_t dx = x - in.pixel.x, dy = y - in.pixel.y;
    return dx * dx + dy * dy + (at->factor > 0.0f && at->factor < 1.0f ? 0 : kNotPartial);
  };
  glm::ivec2 best = in.pixel;
  int64_t nearest = distance_of(best.x, best.y);
  if (nearest == 0) return best;
  for (int y = 0; y < in.scene.view.height_px; y += 4) {
    for (int x = 0; x < in.scene.view.width_px; x += 4) {
      const int64_t distance = distance_of(x, y);
      if (distance >= nearest) continue;
      nearest = distance;
      best = {x, y};
    }
  }
  return best;
}

PageJson json_of_lookup(const ShadowLookup& s) {
  return {{"view", s.view},
          {"position_rws", json_of(glm::dvec3(s.position_rws))},
          {"normal", json_of(glm::dvec3(s.normal_ws))},
          {"to_light", json_of(glm::dvec3(s.to_light_ws))},
          {"x", s.x},
          {"y", s.y},
          {"i", s.i},
          {"j", s.j},
          {"depth", s.depth},
          {"biased", s.biased},
          {"dx", s.depth_dx},
          {"dy", s.depth_dy},
          {"factor", s.factor},
          {"filtered", s.filtered},
          {"terminator", s.terminator},
          {"texels", s.texels},
          {"lit", s.lit},
          {"weights", s.weights.empty() ? PageJson(nullptr) : PageJson(s.weights)},
          {"side", kShadowSide}};
}

const char* name_of(ShadowFilter f) {
  static constexpr std::array kNames{"hard", "bilinear", "pcf3", "pcf5", "pcf7", "vogel", "pcss", "vsm", "moments"};
  return kNames[static_cast<std::size_t>(f)];
}

}  // namespace

PageJson terms_json(const PageInput& in) {
  const StageTone tone = stage_tone(in.scene, in.light, in.workers);
  PageJson json = PageJson::array();
  for (const LightTerm& term : light_terms(in.scene)) {
    const Image<glm::vec4> light = render_term(in.scene, term, TermShadow::with, in.workers);
    PageJson item{{"name", term.name},
                  {"picture", picture_uri(displayed(in.scene, tone.tone, light))},
                  {"mean", json_of(mean_of(light))},
                  {"value", json_of(glm::dvec3(rgb(light.at(in.pixel.x, in.pixel.y))))}};
    const bool shadowed = term.light >= 0 && in.scene.lights[static_cast<std::size_t>(term.light)].light.shadow != nullptr;
    if (shadowed && term.kind == TermKind::diffuse) {
      std::array<int, 2> counts{};
      item["shadow"] = picture_uri(shadow_factors(light, render_term(in.scene, term, TermShadow::without, in.workers), counts));
      item["shadowed"] = counts;
    }
    json.push_back(item);
  }
  return json;
}

PageJson shadow_json(const PageInput& in) {
  for (const PreparedLight& l : in.scene.lights) {
    if (l.light.shadow == nullptr || l.light.shadow->views.empty()) continue;
    const glm::ivec2 pixel = shadow_pixel(in, l.light);
    const std::optional<ShadowLookup> at = lookup_at(in, l.light, pixel.x, pixel.y);
    const int shown = at && at->view >= 0 ? at->view : 0;
    const ShadowView& view = l.light.shadow->views[static_cast<std::size_t>(shown)];
    PageJson json{{"light", l.name},
                  {"pixel", {pixel.x, pixel.y}},
                  {"views", l.light.shadow->views.size()},
                  {"view", shown},
                  {"size", view.size},
                  {"filter", name_of(l.light.shadow->settings.filter)},
                  {"map", picture_uri(shadow_map_picture(view, 512))}};
    if (at) json["lookup"] = json_of_lookup(*at);
    return json;
  }
  return nullptr;
}

PageJson tone_json(const PageInput& in) {
  static constexpr std::array kCurves{"none", "reinhard", "reinhard_extended", "exponential", "aces"};
  const StageTone t = stage_tone(in.scene, in.light, in.workers);
  const ToneSteps s = tone_steps(in.scene, t.tone, rgb(in.light.at(in.pixel.x, in.pixel.y)));
  const glm::u8vec4 code = in.trace.picture.at(in.pixel.x, in.pixel.y);
  PageJson samples = PageJson::array();
  const auto first =
      (static_cast<std::size_t>(in.pixel.y) * static_cast<std::size_t>(in.trace.width) + static_cast<std::size_t>(in.pixel.x)) *
      static_cast<std::size_t>(in.trace.samples);
  for (std::size_t i = 0; i < static_cast<std::size_t>(in.trace.samples); ++i)
    samples.push_back(json_of(glm::dvec4(in.trace.values[first + i])));
  return {{"hdr", t.hdr},
          {"stored_as", storage_text(in.trace.format)},
          {"is_8_bit", in.trace.format == ColorFormat::srgb8a8},
          {"exposure", t.tone.exposure},
          {"auto", in.scene.post.hdr && in.scene.post.auto_exposure},
          {"log_average", t.log_average},
          {"key", in.scene.post.key_value},
          {"curve", kCurves[static_cast<std::size_t>(t.tone.curve)]},
          {"white", t.tone.white},
          {"gamma", in.scene.post.hdr && in.scene.post.encode == DisplayEncoding::gamma ? in.scene.post.gamma : 0.0},
          {"dither", in.scene.post.hdr && in.scene.post.dither},
          {"low", kLowStop},
          {"high", kHighStop},
          {"bins", kBinsPerStop},
          {"histogram", t.histogram},
          {"dark", t.dark},
          {"bright", t.bright},
          {"clamped", clamped_pixels(in.light, t.tone.exposure)},
          {"points", t.curve},
          {"pixel",
           {{"light", json_of(glm::dvec3(s.light))},
            {"exposed", json_of(glm::dvec3(s.exposed))},
            {"display", json_of(glm::dvec3(s.display))},
            {"encoded", json_of(glm::dvec3(s.encoded))},
            {"rounded", {s.code.x, s.code.y, s.code.z}},
            {"code", {code.x, code.y, code.z}}}},
          {"samples", samples}};
}

PageJson sample_block_json(const PageInput& in) {
  const ToneMapping tone = stage_tone(in.scene, in.light, in.workers).tone;
  const int x0 = in.pixel.x / 8 * 8, row0 = (in.trace.height - 1 - in.pixel.y) / 8 * 8;
  PageJson json = PageJson::array();
  for (int i = 0; i < 64; ++i) {
    const int x = x0 + i % 8, y = in.trace.height - 1 - (row0 + i / 8);
    if (x >= in.trace.width || y < 0) continue;
    const std::size_t first = (static_cast<std::size_t>(y) * static_cast<std::size_t>(in.trace.width) + static_cast<std::size_t>(x)) *
                              static_cast<std::size_t>(in.trace.samples);
    for (std::size_t s = 0; s < static_cast<std::size_t>(in.trace.samples); ++s) {
      const glm::ivec3 code = tone_steps(in.scene, tone, rgb(in.trace.values[first + s])).code;
      json.push_back({i % 8, i / 8, s, code.x, code.y, code.z});
    }
  }
  return json;
}

PageJson samples_json(const PageInput& in) {
  PageJson json = PageJson::array();
  for (int s = 0; s < in.scene.samples; ++s) {
    const SamplePosition p = sample_position(in.scene.samples, s);
    json.push_back({p.x, p.y});
  }
  return json;
}

}  // namespace halfspace
