// SPDX-License-Identifier: Apache-2.0
#include "explain/example_pixel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "explain/fragment_values.h"
#include "explain/stage_terms.h"
#include "halfspace/raster/inspect/inspection.h"
#include "halfspace/raster/pipeline/sample_pattern.h"
#include "halfspace/shading/light/lighting.h"

namespace halfspace {

namespace {

constexpr uint32_t kUnseen = 0xffffffffu;

// The parts of the score, each from 0 to 100. They are integers that depend on comparisons only, so that equal facts give equal scores on
// every machine.

// A triangle that is only a few pixels high has no inside, however long it is.
bool is_sliver(const ExampleFacts& f) { return f.height < 4.0; }

// A triangle of fewer than 10 pixels has no inside: its blocks, edges and weights cannot be seen. One of more than 2,000 pixels fills
// whole tiles, so that hardly any block is crossed by an edge. In between, a triangle of some blocks is best.
// A clipped triangle has vertices that are not in the window, or even behind the eye.
int size_score(const ExampleFacts& f) {
  if (f.is_clipped) return std::min(30, static_cast<int>(3 * f.visible_pixels));
  if (f.visible_pixels < 10) return static_cast<int>(3 * f.visible_pixels);
  if (f.covered_pixels > 2000 || is_sliver(f)) return 40;
  return f.visible_pixels >= 40 && f.covered_pixels <= 600 ? 100 : 80;
}

// Depth tests need at least two primitives in the pixel. More than three make its history long, but show nothing new.
int depth_score(const ExampleFacts& f) { return f.primitives < 2 ? 0 : f.primitives == 2 ? 80 : 100; }

// A surface that faces the light has n·l = 1, and one that faces away has 0: in both cases, a factor of the product cannot be seen.
int light_score(const ExampleFacts& f) { return f.cosine <= 0.0f ? 0 : f.cosine < 0.2f || f.cosine > 0.9f ? 50 : 100; }

// Half a pixel is the smallest displacement that changes which texel a pixel shows.
int perspective_score(const ExampleFacts& f) {
  return f.affine_error >= 0.5 ? 100 : f.affine_error >= 0.1 ? 60 : f.affine_error >= 0.02 ? 20 : 0;
}

// At a factor near a half, about half of the compared texels occlude the point, so that the filter has something to do.
int shadow_score(const ExampleFacts& f) {
  if (f.shadow <= 0.0f || f.shadow >= 1.0f) return 0;
  return f.shadow >= 0.35f && f.shadow <= 0.65f ? 100 : f.shadow >= 0.2f && f.shadow <= 0.8f ? 80 : 50;
}

// Returns true if a pixel shows all ideas of the frame. Such a pixel is better than one that shows some of them very well.
bool shows_everything(const ExampleFacts& f, const ExampleIdeas& ideas) {
  return f.is_triangle && !f.is_clipped && f.visible_pixels >= 10 && f.covered_pixels <= 2000 && !is_sliver(f) && f.primitives >= 2 &&
         (!ideas.light || light_score(f) == 100) && (!ideas.perspective || perspective_score(f) == 100) &&
         (!ideas.shadow || shadow_score(f) == 100);
}

struct PrimitiveKey {
  uint32_t draw, instance, primitive;
  auto operator<=>(const PrimitiveKey&) const = default;
};
PrimitiveKey key_of(const TracedFragment& f) { return {f.draw, f.instance, f.primitive}; }

bool is_mesh_triangle(const PreparedScene& scene, const TracedFragment& f) {
  const PreparedDraw& draw = scene.draws[f.draw];
  return f.round == 0 && draw.source.object >= 0 && !draws_points(draw.state) && !is_lines(draw.state.topology) &&
         !std::holds_alternative<NormalLines>(draw.shader);
}

// Calls f(fragment) for one fragment of each primitive in a pixel. The fragments of a primitive are next to each other.
template <class F>
void for_each_primitive(std::span<const TracedFragment> fragments, const F& f) {
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    if (i == 0 || key_of(fragments[i]) != key_of(fragments[i - 1])) f(fragments[i]);
  }
}

// Returns true if different primitives are visible at the samples of a pixel.
bool has_different_samples(std::span<const TracedFragment> fragments) {
  std::array<const TracedFragment*, kMaxSamples> last{};
  for (const TracedFragment& f : fragments) {
    if (f.outcome == FragmentOutcome::shaded) last[f.sample] = &f;
  }
  const TracedFragment* first = nullptr;
  for (const TracedFragment* f : last) {
    if (f == nullptr) continue;
    if (first != nullptr && key_of(*f) != key_of(*first)) return true;
    first = f;
  }
  return false;
}

// Returns true if the color of a pixel is made of the colors of several primitives.
bool mixes_surfaces(std::span<const TracedFragment> fragments) {
  return has_different_samples(fragments) ||
         std::ranges::any_of(fragments, [](const TracedFragment& f) { return f.outcome > FragmentOutcome::shaded; });
}

double measured_error(const InspectedTriangle& t) {
  std::array<float, 3> inv_w;
  for (std::size_t i = 0; i < 3; ++i) inv_w[i] = t.source.vertex[i]->inv_w;
  return affine_error(t.source.triangle->x, t.source.triangle->y, inv_w);
}

}  // namespace

const TracedFragment* visible_fragment(const FrameTrace& trace, glm::ivec2 pixel) {
  const TracedFragment* best = nullptr;
  for (const TracedFragment& f : trace.at(pixel)) {
    const bool replaces = f.outcome == FragmentOutcome::shaded;
    if (replaces || (f.is_shaded && (best == nullptr || best->outcome != FragmentOutcome::shaded))) best = &f;
  }
  return best;
}

// Between two vertices with 1/w = a and 1/w = b, the point in the middle of the edge on the screen has the perspective-correct weight
// a / (a + b). The two interpolations differ most where the weight is √a / (√a + √b), by |√a − √b| / (√a + √b) of the edge.
double affine_error(const std::array<int32_t, 3>& x, const std::array<int32_t, 3>& y, const std::array<float, 3>& inv_w) {
  double error = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = (i + 1) % 3;
    const double q = std::sqrt(static_cast<double>(inv_w[i]) / static_cast<double>(inv_w[k]));
    const double dx = x[k] - x[i], dy = y[k] - y[i], length = std::sqrt(dx * dx + dy * dy) / kSubPixels;
    error = std::max(error, std::fabs(1.0 - q) / (1.0 + q) * std::min(length, 4096.0));
  }
  return error;
}

double height_above_longest_edge(const std::array<int32_t, 3>& x, const std::array<int32_t, 3>& y) {
  double longest = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double dx = x[(i + 1) % 3] - x[i], dy = y[(i + 1) % 3] - y[i];
    longest = std::max(longest, std::sqrt(dx * dx + dy * dy));
  }
  const double area = static_cast<double>(int64_t{x[1] - x[0]} * (y[2] - y[0]) - int64_t{y[1] - y[0]} * (x[2] - x[0]));
  return std::fabs(area) / longest / kSubPixels;
}

int example_score(const ExampleFacts& f, const ExampleIdeas& ideas) {
  // A triangle shows edges, coverage and interpolation; a point, a line or the background does not. The size comes next, because nothing
  // else can be seen on a triangle that is too small.
  int score = (f.is_triangle ? 10000 : 0) + 4 * size_score(f) + 2 * depth_score(f);
  if (ideas.light) score += 2 * light_score(f);
  if (ideas.perspective) score += 2 * perspective_score(f);
  if (ideas.shadow) score += 2 * shadow_score(f);
  if (ideas.samples && f.has_different_samples) score += 100;
  if (shows_everything(f, ideas)) score += 2000;  // more than the sum of the parts
  return score;
}

ExampleSearch::ExampleSearch(const ExampleSource& source) : source_(source) {
  ideas_.perspective = source.scene.view.to_eye_ws == glm::dvec3(0.0);
  ideas_.light = !source.scene.lights.empty();
  ideas_.samples = source.trace.samples > 1;
  count_primitives();
  measure_triangles();
  render_shadow();
}

void ExampleSearch::count_primitives() {
  const FrameTrace& trace = source_.trace;
  std::map<PrimitiveKey, uint32_t> indices;
  primitive_of_.assign(trace.others.size(), kUnseen);
  visible_.assign(trace.others.size(), nullptr);
  const auto seen = [&](const TracedFragment& f) {
    const auto [found, is_new] = indices.try_emplace(key_of(f), static_cast<uint32_t>(seen_.size()));
    if (is_new) seen_.emplace_back();
    return found->second;
  };
  for (std::size_t i = 0; i < visible_.size(); ++i) {
    const glm::ivec2 pixel(static_cast<int>(i % static_cast<std::size_t>(trace.width)),
                           static_cast<int>(i / static_cast<std::size_t>(trace.width)));
    for_each_primitive(trace.at(pixel), [&](const TracedFragment& f) { ++seen_[seen(f)].covered; });
    visible_[i] = visible_fragment(trace, pixel);
    if (visible_[i] == nullptr) continue;
    primitive_of_[i] = seen(*visible_[i]);
    ++seen_[primitive_of_[i]].visible;
  }
}

void ExampleSearch::measure_triangles() {
  const TriangleInspector triangles(source_.context);
  std::vector<bool> is_measured(seen_.size());
  for (std::size_t i = 0; i < visible_.size(); ++i) {
    if (visible_[i] == nullptr || !is_mesh_triangle(source_.scene, *visible_[i]) || is_measured[primitive_of_[i]]) continue;
    is_measured[primitive_of_[i]] = true;
    InspectedTriangle t;
    triangles.find(visible_[i]->id, t);
    Seen& seen = seen_[primitive_of_[i]];
    seen.is_clipped = t.source.triangle->is(kClipped);
    seen.height = height_above_longest_edge(t.source.triangle->x, t.source.triangle->y);
    if (ideas_.perspective) seen.affine_error = measured_error(t);
  }
}

// Replaces the quotients of pixels that mix several surfaces by the shadow factor of the visible fragment.
void ExampleSearch::correct_shadow(int light) {
  const FrameTrace& trace = source_.trace;
  const TriangleInspector triangles(source_.context);
  const std::vector<std::string> names(source_.scene.lights.size());
  for (std::size_t i = 0; i < visible_.size(); ++i) {
    float& shadow = shadow_.data()[i];
    if (shadow <= 0.0f || shadow >= 1.0f || visible_[i] == nullptr) continue;
    const TracedFragment& f = *visible_[i];
    const glm::ivec2 pixel(static_cast<int>(i % static_cast<std::size_t>(trace.width)),
                           static_cast<int>(i / static_cast<std::size_t>(trace.width)));
    if (!is_mesh_triangle(source_.scene, f) || !mixes_surfaces(trace.at(pixel))) continue;
    InspectedTriangle t;
    triangles.find(f.id, t);
    const SamplePosition at = t.draw->shades_samples ? sample_position(trace.samples, f.sample) : kPixelCenter;
    const FragmentPlace place{t, {pixel.x, trace.height - 1 - pixel.y}, at, f.depth};
    const LightingDetail detail = lighting_detail(source_.scene.draws[f.draw].shader, place, names);
    if (!detail.lights.empty()) shadow = detail.lights[static_cast<std::size_t>(light)].shadow;
  }
}

// The shadow factor is the quotient of the diffuse light with and without shadows.
void ExampleSearch::render_shadow() {
  for (const LightTerm& term : light_terms(source_.scene)) {
    if (term.kind != TermKind::diffuse || source_.scene.lights[static_cast<std::size_t>(term.light)].light.shadow == nullptr) continue;
    const Image<glm::vec4> with = render_term(source_.scene, term, TermShadow::with, source_.workers);
    const Image<glm::vec4> without = render_term(source_.scene, term, TermShadow::without, source_.workers);
    shadow_ = Image<float>(with.width(), with.height());
    std::ranges::transform(with.texels(), without.texels(), shadow_.data(), [](const glm::vec4& a, const glm::vec4& b) {
      const float full = b.x + b.y + b.z;
      return full > 0.0f ? (a.x + a.y + a.z) / full : 0.0f;
    });
    correct_shadow(term.light);
    ideas_.shadow = true;
    return;
  }
}

ExampleFacts ExampleSearch::facts(glm::ivec2 pixel) const {
  ExampleFacts out;
  const FrameTrace& trace = source_.trace;
  const std::size_t i = static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(trace.width) + static_cast<std::size_t>(pixel.x);
  if (visible_[i] == nullptr) return out;
  const TracedFragment& f = *visible_[i];
  out.is_triangle = is_mesh_triangle(source_.scene, f);
  const Seen& seen = seen_[primitive_of_[i]];
  out.visible_pixels = seen.visible;
  out.covered_pixels = seen.covered;
  out.is_clipped = seen.is_clipped;
  out.height = seen.height;
  out.affine_error = seen.affine_error;
  for_each_primitive(trace.at(pixel), [&](const TracedFragment&) { ++out.primitives; });
  out.has_different_samples = has_different_samples(trace.at(pixel));
  if (shadow_.width() > 0) out.shadow = shadow_.at(pixel.x, pixel.y);
  if (source_.values.object.at(pixel.x, pixel.y) == 0xffffffffu) return out;
  const vec3<float> normal(source_.values.normal.at(pixel.x, pixel.y));
  const vec3<float> position(glm::vec3(glm::dvec3(source_.values.position.at(pixel.x, pixel.y)) - source_.scene.view.eye_ws));
  for (const PreparedLight& l : source_.scene.lights) {
    const IncidentLight<float> arriving = light_at<float>(l.light, position);
    if (arriving.strength > 0.0f) out.cosine = std::max(out.cosine, std::min(dot(normal, arriving.l_ws), 1.0f));
  }
  return out;
}

glm::ivec2 ExampleSearch::best() const {
  const FrameTrace& trace = source_.trace;
  glm::ivec2 best(trace.width / 2, trace.height / 2);
  std::tuple<int, int64_t> highest{-1, 0};
  for (int y = 0; y < trace.height; ++y) {
    for (int x = 0; x < trace.width; ++x) {
      const int64_t dx = 2 * x + 1 - trace.width, dy = 2 * y + 1 - trace.height;
      const std::tuple<int, int64_t> here{example_score(facts({x, y}), ideas_), -(dx * dx + dy * dy)};
      if (here <= highest) continue;
      highest = here;
      best = {x, y};
    }
  }
  return best;
}

}  // namespace halfspace
