// SPDX-License-Identifier: Apache-2.0
#include "property/random_scene.h"

#include <algorithm>
#include <limits>

#include "support/random_state.h"

namespace halfspace {

namespace {

// A point in window coordinates (px), with a depth from 0 (near) to 1 (far), and w.
struct WindowPoint {
  float x, y, z, w;
};

glm::vec4 to_clip(const Rect& v, ClipDepth clip, const WindowPoint& p) {
  const float half_width = 0.5f * static_cast<float>(v.width), half_height = 0.5f * static_cast<float>(v.height);
  const float x = (p.x - (static_cast<float>(v.x) + half_width)) / half_width;
  const float y = (p.y - (static_cast<float>(v.y) + half_height)) / half_height;
  const float z = clip == ClipDepth::zero_to_one ? p.z : 2.0f * p.z - 1.0f;
  return {x * p.w, y * p.w, z * p.w, p.w};
}

// Adds random geometry in a viewport.
class Placer {
 public:
  Placer(const Rect& viewport, ClipDepth clip, Random& random, Geometry& out) : v_(viewport), clip_(clip), random_(random), out_(out) {}

  WindowPoint anywhere(float beyond) {
    const auto x0 = static_cast<float>(v_.x), y0 = static_cast<float>(v_.y);
    const auto width = static_cast<float>(v_.width), height = static_cast<float>(v_.height);
    const float x = random_.real(x0 - beyond * width, x0 + (1.0f + beyond) * width);
    const float y = random_.real(y0 - beyond * height, y0 + (1.0f + beyond) * height);
    const float z = random_.real(0.0f, 1.0f);
    return {x, y, z, depth_w()};
  }
  WindowPoint near(const WindowPoint& p, float radius) {
    const float x = p.x + random_.real(-radius, radius);
    const float y = p.y + random_.real(-radius, radius);
    const float z = std::clamp(p.z + random_.real(-0.2f, 0.2f), 0.0f, 1.0f);
    return {x, y, z, random_.once_in(3) ? p.w : depth_w()};
  }
  // Half of all triangles are orthographic or nearly so, because equal w and equal z are special cases.
  float depth_w() { return random_.once_in(2) ? 1.0f : random_.real(0.1f, 10.0f); }

  uint32_t add(const WindowPoint& p) { return add(to_clip(v_, clip_, p)); }
  uint32_t add(const glm::vec4& clip) {
    out_.positions.push_back(clip);
    return static_cast<uint32_t>(out_.positions.size() - 1);
  }
  void triangle(uint32_t a, uint32_t b, uint32_t c) {
    if (random_.once_in(2)) std::swap(b, c);
    out_.indices.insert(out_.indices.end(), {a, b, c});
  }
  void triangle(const WindowPoint& a, const WindowPoint& b, const WindowPoint& c) {
    const uint32_t i = add(a);
    add(b);
    triangle(i, i + 1, add(c));
  }
  void around(float beyond, float radius) {
    const WindowPoint p = anywhere(beyond);
    const WindowPoint a = near(p, radius);
    const WindowPoint b = near(p, radius);
    triangle(a, b, near(p, radius));
  }

  void sliver() {
    const WindowPoint a = anywhere(0.5f);
    const WindowPoint b = near(a, random_.pick({30.0f, 200.0f, 3000.0f}));
    const float t = random_.real(0.0f, 1.0f);
    const float off = random_.pick({0.004f, 0.05f, 0.5f, 1.0f});
    const float x = a.x + t * (b.x - a.x) + random_.real(-off, off);
    const float y = a.y + t * (b.y - a.y) + random_.real(-off, off);
    triangle(a, b, {x, y, 0.5f * (a.z + b.z), b.w});
  }
  void degenerate() {
    const WindowPoint a = anywhere(0.2f), b = anywhere(0.2f);
    switch (random_.below(3)) {
      case 0: triangle(a, b, a); break;
      case 1: triangle(a, a, a); break;
      default: triangle(a, b, {0.5f * (a.x + b.x), 0.5f * (a.y + b.y), b.z, 1.0f}); break;
    }
  }
  // Vertices on pixel centers, pixel edges or quarters of a pixel, so that samples are exactly on edges and vertices.
  void on_the_grid() {
    const float step = random_.pick({0.5f, 1.0f, 0.25f, 4.0f});
    const bool sloped = random_.once_in(2);  // depth must be exact at vertices, even on a slope
    const float z = random_.pick({0.25f, 0.5f, 0.75f});
    const auto point = [&] {
      const WindowPoint p = anywhere(0.1f);
      return WindowPoint{std::floor(p.x / step) * step, std::floor(p.y / step) * step, !sloped ? z : random_.once_in(3) ? 0.0f : p.z, 1.0f};
    };
    const WindowPoint a = point(), b = point();
    triangle(a, b, point());
  }
  glm::vec4 raw(float low_w, float high_w) {
    const float x = random_.real(-2.0f, 2.0f);
    const float y = random_.real(-2.0f, 2.0f);
    const float z = random_.real(-1.0f, 1.5f);
    return {x, y, z, random_.real(low_w, high_w)};
  }
  void raw_triangle(float low_w, float high_w) {
    const uint32_t i = add(raw(low_w, high_w));
    add(raw(low_w, high_w));
    triangle(i, i + 1, add(raw(low_w, high_w)));
  }
  void non_finite() {
    constexpr float inf = std::numeric_limits<float>::infinity();
    glm::vec4 bad = raw(0.5f, 1.0f);
    bad[random_.below(4)] = random_.pick({inf, -inf, std::numeric_limits<float>::quiet_NaN()});
    const uint32_t i = add(raw(0.5f, 1.0f));
    add(raw(0.5f, 1.0f));
    triangle(i, i + 1, add(bad));
  }
  void tiny_w() {
    const uint32_t i = add(raw(0.5f, 1.0f));
    add(raw(0.5f, 1.0f));
    glm::vec4 odd = raw(0.0f, 1.0f);
    odd.w = random_.pick({0.0f, -0.0f, 1e-30f, 1e-20f, 1e-6f, -1e-6f, 1e20f});
    triangle(i, i + 1, add(odd));
  }
  void whole_target() {
    const float z = random_.real(0.05f, 0.95f);
    const float zc = clip_ == ClipDepth::zero_to_one ? z : 2.0f * z - 1.0f;
    const uint32_t i = add(glm::vec4(-1, -1, zc, 1));
    add(glm::vec4(3, -1, zc, 1));
    out_.indices.insert(out_.indices.end(), {i, i + 1, add(glm::vec4(-1, 3, zc, 1))});
  }
  void fan() {
    const WindowPoint middle = anywhere(0.0f);
    const float radius = random_.pick({3.0f, 20.0f, 80.0f, 2000.0f});
    const uint32_t c = add(middle);
    const int n = random_.between(3, 9);
    for (int i = 0; i < n; ++i) add(near(middle, radius));
    for (int i = 0; i < n; ++i) triangle(c, c + 1 + static_cast<uint32_t>(i), c + 1 + static_cast<uint32_t>((i + 1) % n));
  }
  void mesh() {
    const int n = random_.between(2, 6);
    const float size = random_.pick({2.0f, 9.0f, 25.0f});
    const WindowPoint corner = anywhere(0.1f);
    const auto first = static_cast<uint32_t>(out_.positions.size());
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        const float x = corner.x + size * static_cast<float>(i) + random_.real(-0.3f, 0.3f);
        const float y = corner.y + size * static_cast<float>(j) + random_.real(-0.3f, 0.3f);
        add(WindowPoint{x, y, random_.real(0.3f, 0.7f), corner.w});
      }
    }
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const uint32_t a = first + static_cast<uint32_t>(j * (n + 1) + i);
        const uint32_t b = a + static_cast<uint32_t>(n + 1);
        triangle(a, a + 1, b);
        triangle(b, a + 1, b + 1);
      }
    }
  }
  // A size just below or just above the limit for 32-bit edge functions.
  void about_63_px() {
    const WindowPoint a = anywhere(0.0f);
    const float extent = 63.0f + random_.pick({-1.0f, -1.0f / 256.0f, 0.0f, 1.0f / 256.0f});
    const float x = std::floor(a.x * 256.0f) / 256.0f, y = std::floor(a.y * 256.0f) / 256.0f;
    const float z = random_.real(0.0f, 1.0f);
    const WindowPoint b{x + extent, y + extent * random_.pick({1.0f, 0.9f, -1.0f}), z, 1.0f};
    const float along = random_.real(0.0f, 1.0f);
    triangle({x, y, a.z, 1.0f}, b, {x + along * extent, y, random_.real(0.0f, 1.0f), 1.0f});
  }
  void crossing_depth() {
    const auto point = [&] {
      WindowPoint p = anywhere(0.5f);
      p.z = random_.real(-0.7f, 1.7f);
      return p;
    };
    const WindowPoint a = point(), b = point();
    triangle(a, b, point());
  }

 private:
  Rect v_;
  ClipDepth clip_;
  Random& random_;
  Geometry& out_;
};

}  // namespace

void add_triangles(Kind kind, const Rect& viewport, ClipDepth clip, Random& random, Geometry& out) {
  Placer p(viewport, clip, random, out);
  switch (kind) {
    case Kind::tiny:
      for (int i = 0; i < 8; ++i) p.around(0.05f, 1.5f);
      break;
    case Kind::small:
      for (int i = 0; i < 4; ++i) p.around(0.1f, 12.0f);
      break;
    case Kind::medium: p.around(0.1f, 60.0f); break;
    case Kind::huge: p.around(0.5f, 4000.0f); break;
    case Kind::beyond_guard: p.around(0.5f, 1e5f); break;
    case Kind::sliver:
      for (int i = 0; i < 3; ++i) p.sliver();
      break;
    case Kind::degenerate: p.degenerate(); break;
    case Kind::on_the_grid:
      for (int i = 0; i < 3; ++i) p.on_the_grid();
      break;
    case Kind::behind_the_eye: p.raw_triangle(-1.0f, 2.0f); break;
    case Kind::non_finite: p.non_finite(); break;
    case Kind::whole_target: p.whole_target(); break;
    case Kind::steep: p.raw_triangle(1e-4f, random.pick({1.0f, 1e4f})); break;
    case Kind::tiny_w: p.tiny_w(); break;
    case Kind::fan: p.fan(); break;
    case Kind::mesh: p.mesh(); break;
    case Kind::crossing_depth: p.crossing_depth(); break;
    case Kind::about_63_px: p.about_63_px(); break;
  }
}

namespace {

constexpr int kCompareOps = 8, kBlendFactors = 15, kStencilOps = 8;

Rect random_rect(int width, int height, Random& random) {
  const int x = random.between(-width / 4, width * 3 / 4);
  const int y = random.between(-height / 4, height * 3 / 4);
  const int w = random.between(1, width);
  return {x, y, w, random.between(1, height)};
}

BlendState random_blend(Random& random) {
  if (random.once_in(4)) return {};
  BlendState b = random_equations(random, kBlendFactors);
  b.constant = {random.real(-0.2f, 1.2f), random.real(0, 1), random.real(0, 1), random.real(0, 1)};
  return b;
}

StencilFace random_stencil_face(Random& random) {
  const auto op = [&] { return static_cast<StencilOp>(random.below(kStencilOps)); };
  StencilFace f;
  if (!random.once_in(3)) f.compare = static_cast<CompareOp>(random.below(kCompareOps));
  if (!random.once_in(3)) f.fail = op();
  if (!random.once_in(3)) f.depth_fail = op();
  if (!random.once_in(4)) f.pass = op();
  f.reference = static_cast<uint8_t>(random.pick({0, 1, 2, 127, 128, 255}));
  f.read_mask = static_cast<uint8_t>(random.pick({255, 255, 1, 0xf0, 0}));
  f.write_mask = static_cast<uint8_t>(random.pick({255, 255, 1, 0x3c, 0}));
  return f;
}

// Adds state for the operations after coverage: stencil, masks, per-attachment state, dual-source blending, samples and queries.
// Returns true if a draw can have a logic operation: its attachments have unsigned normalized values, and it does not blend.
bool can_combine_codes(const Scene& scene, const DrawState& s) {
  std::vector<ColorFormat> formats{scene.color.format};
  for (const ColorTarget& c : scene.more_colors) formats.push_back(c.format);
  for (std::size_t i = 0; i < formats.size(); ++i) {
    if (formats[i] != ColorFormat::none && (texel_info(formats[i]).kind != TexelKind::unorm || blend_of(s, i))) return false;
  }
  return true;
}

// Adds a condition, often on the query of a draw before.
void add_condition(const Scene& scene, Random random, DrawState& s) {
  if (scene.layers > 1 || !random.once_in(3)) return;
  auto query = static_cast<uint32_t>(random.below(3));
  for (const SceneDraw& d : scene.draws) {
    if (d.state.query && random.once_in(2)) query = *d.state.query;
  }
  if (s.query != query) s.condition = DrawCondition{query, random.once_in(2)};
}

void add_operations(const Scene& scene, bool dual_sources, Random& random, DrawState& s) {
  if (!random.once_in(3)) {
    s.stencil.emplace();
    s.stencil->front = random_stencil_face(random);
    s.stencil->back = random.once_in(2) ? s.stencil->front : random_stencil_face(random);
  }
  if (random.once_in(3)) s.color_mask = random_mask(random);
  for (std::size_t i = 0; i <= scene.more_colors.size(); ++i) {
    if (!random.once_in(5)) continue;
    s.attachments[i].emplace();
    s.attachments[i]->mask = random_mask(random);
    if (random.once_in(2)) s.attachments[i]->blend = random_blend(random);
  }
  if (dual_sources && scene.more_colors.empty() && random.once_in(2)) {
    s.blend = random_blend(random);
    s.blend->source_color = random.pick({BlendFactor::src1_color, BlendFactor::one_minus_src1_alpha});
    s.blend->destination_color = random.pick({BlendFactor::one_minus_src1_color, BlendFactor::src1_alpha});
    s.blend->destination_alpha = random.pick({BlendFactor::one_minus_src1_color, BlendFactor::src1_alpha});
  }
  if (random.once_in(4)) s.sample_shading = true;
  if (random.once_in(5)) s.alpha_to_coverage = true;
  if (random.once_in(5)) s.sample_mask = random.bits();
  if (random.once_in(6)) s.alpha_to_one = true;
  if (random.once_in(6)) s.sample_coverage = {random.real(0.0f, 1.0f), random.once_in(2)};
  if (random.once_in(4) && can_combine_codes(scene, s)) s.logic_op = static_cast<LogicOp>(random.below(16));
  if (random.once_in(3)) s.query = static_cast<uint32_t>(random.below(3));
  add_condition(scene, other_numbers(random), s);
}

// Returns a random depth state. With most of them, fragments can pass against the cleared depth.
DepthState random_depth(float clear_value, Random& random) {
  DepthState d;
  d.test = !random.once_in(8);
  d.write = !random.once_in(5);
  d.compare = clear_value < 0.5f ? random.pick({CompareOp::greater, CompareOp::greater_equal})
                                 : random.pick({CompareOp::less, CompareOp::less_equal});
  if (random.once_in(3)) d.compare = static_cast<CompareOp>(random.below(kCompareOps));
  d.clip = random.once_in(2) ? ClipDepth::zero_to_one : ClipDepth::negative_one_to_one;
  d.clamp = random.once_in(4);
  if (random.once_in(4)) {
    d.range_near = random.real(0.0f, 1.0f);
    d.range_far = random.once_in(8) ? d.range_near : random.real(0.0f, 1.0f);
  }
  return d;
}

// State that was added later. It leaves the other random numbers as they are.
void add_later_state(const Random& random, DrawState& s) {
  Random copy = other_numbers(random);
  if (s.viewport && copy.once_in(3)) {
    const auto fraction = [&] { return static_cast<float>(copy.below(256)) / 256.0f; };
    s.viewport = ViewportRect{s.viewport->x + fraction(), s.viewport->y + fraction(), s.viewport->width + fraction(),
                              s.viewport->height + fraction()};
  }
  if (s.viewport && copy.once_in(6))
    s.viewport = ViewportRect{s.viewport->x, s.viewport->y + s.viewport->height, s.viewport->width, -s.viewport->height};
  if (copy.once_in(8)) s.clip_origin = ClipOrigin::upper_left;
  if (copy.once_in(6)) {
    const float a = copy.real(0.0f, 1.0f), b = copy.real(0.0f, 1.0f);
    s.depth_bounds = StoredDepthRange{std::min(a, b), copy.once_in(2) ? 1.0f : std::max(a, b)};
  }
  s.polygon_smooth = copy.once_in(10);
  s.line_smooth = copy.once_in(4);
}

DrawState random_state(const Scene& scene, Theme theme, Random& random) {
  DrawState s;
  if (random.once_in(4)) s.viewport = random_rect(scene.width, scene.height, random);
  if (random.once_in(4)) s.scissor = random_rect(scene.width, scene.height, random);
  if (s.scissor && random.once_in(10)) s.scissor->width = 0;
  if (random.once_in(3)) s.cull = random.pick({CullMode::front, CullMode::front, CullMode::back, CullMode::back, CullMode::front_and_back});
  if (random.once_in(3)) s.front = Winding::clockwise;
  if (random.once_in(2)) s.provoking = ProvokingVertex::first;
  s.depth = random_depth(scene.depth.clear_value, random);
  if (random.once_in(4)) {
    s.offset.slope = random.real(-2.0f, 2.0f);
    s.offset.constant = random.pick({0.0f, 1.0f, -3.0f, 1000.0f});
    s.offset.clamp = random.pick({0.0f, 0.0f, 0.01f, -0.01f});
  }
  if (theme == Theme::blended ? !random.once_in(4) : random.once_in(8)) s.blend = random_blend(random);
  add_later_state(random, s);
  return s;
}

Kind random_kind(Theme theme, Random& random) {
  if (theme == Theme::clipped && !random.once_in(4)) {
    return random.pick(
        {Kind::behind_the_eye, Kind::crossing_depth, Kind::beyond_guard, Kind::steep, Kind::tiny_w, Kind::huge, Kind::non_finite});
  }
  if (random.once_in(2))
    return random.pick({Kind::whole_target, Kind::medium, Kind::medium, Kind::mesh, Kind::fan, Kind::huge});  // these cover many pixels
  return static_cast<Kind>(random.below(kKinds));
}

glm::mat4 random_matrix(Random& random) {
  glm::mat4 m(1.0f);
  if (!random.once_in(3)) return m;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) m[column][row] += random.real(-0.05f, 0.05f);
  }
  return m;
}

// Fills a sample of all pixels with finite and moderate floats and with depths in [0, 1].
void fill_sample(int sample, Random& random, oracle::Framebuffer& f) {
  for (int y = 0; y < f.height(); ++y) {
    for (int x = 0; x < f.width(); ++x) {
      for (std::size_t i = 0; i < f.color_formats().size(); ++i) {
        f.set_color(i, {x, y, sample}, glm::vec4{random.real(0, 1), random.real(0, 1), random.real(0, 2), random.real(0, 1)});
      }
      f.set_depth({x, y, sample}, f.depth_value(random.real(0, 1)));
      f.set_stencil({x, y, sample}, static_cast<uint8_t>(random.below(256)));
    }
  }
}

// Fills the images that the pass loads. Only the first sample and layer changes the random numbers of the rest of the scene.
void fill_images(Scene& s, Random& random) {
  std::vector<ColorFormat> formats{s.color.format};
  for (const ColorTarget& c : s.more_colors) formats.push_back(c.format);
  const auto add = [&](const std::vector<std::byte>& bytes, int samples, std::vector<std::byte>& to) {
    to.insert(to.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size()) / s.samples * samples);
  };
  s.more_before.resize(s.more_colors.size());
  const oracle::Framebuffer empty(s.width, s.height, formats, s.depth.format, s.samples);
  oracle::Framebuffer f = empty;
  fill_sample(0, random, f);
  Random more = random;
  for (int layer = 0; layer < s.layers; ++layer) {
    for (int sample = layer == 0 ? 1 : 0; sample < s.samples; ++sample) fill_sample(sample, more, f);
    add(f.color_bytes[0], s.color.samples, s.color_before);
    for (std::size_t i = 0; i < s.more_colors.size(); ++i) add(f.color_bytes[i + 1], s.more_colors[i].samples, s.more_before[i]);
    add(f.depth_bytes, s.depth.samples, s.depth_before);
  }
}

// Draws into views, and stores all samples, without changing the random numbers of the rest of the scene.
void vary_images(Random random, Scene& s) {
  s.in_views = random.once_in(3);
  if (random.once_in(2)) return;
  const auto samples = [&] { return random.once_in(2) ? s.samples : 1; };
  s.color.samples = samples();
  s.depth.samples = samples();
  for (ColorTarget& c : s.more_colors) c.samples = samples();
}

// Returns rows with the given positions and random values for all other attributes.
template <class A>
std::vector<A> random_rows(const std::vector<glm::vec4>& positions, Random& random) {
  std::vector<A> rows;
  for (const glm::vec4& p : positions) {
    std::array<float, kComponents<A>> row{};
    for (std::size_t k = 0; k < row.size(); ++k) row[k] = k < 4 ? p[static_cast<int>(k)] : random.real(-0.5f, 1.5f);
    rows.push_back(from_components<A, float>(row));
  }
  return rows;
}

// Returns the number of components of the last vectors of A that have at least n components together.
template <class A>
std::size_t last_vectors(std::size_t n) {
  constexpr auto vectors = detail::VectorsOf<detail::FieldsOf<A>>::value;
  std::size_t components = 0;
  for (auto v = vectors.rbegin(); components < n; ++v) components += v->components;
  return components;
}

// Replaces the attributes after the position by the nearest numbers of the format.
template <class A>
void round_rows(StreamFormat format, std::vector<A>& rows) {
  constexpr uint64_t integers = kIntegerComponents<A>;
  for (A& row : rows) {
    auto numbers = to_components<float>(row);
    for (std::size_t k = 4; k < numbers.size(); ++k) {
      if ((integers >> k & 1) == 0) numbers[k] = rounded_to(format, numbers[k]);
    }
    row = from_components<A, float>(numbers);
  }
}

// Selects a part of the vertices or indices.
void select_range(std::size_t size, Random& random, DrawState& state) {
  state.first = static_cast<uint32_t>(random.below(static_cast<int>(size) + 1));
  if (random.once_in(2)) state.count = static_cast<uint32_t>(random.below(static_cast<int>(size - state.first) + 1));
}

// Changes the format of the streams, the range of indices, the first instance and the restart index, without changing the random numbers of
// the rest of the scene. Returns the format.
template <class S>
StreamFormat vary_vertex_data(Random random, oracle::Input<S>& input, DrawState& state) {
  if (random.once_in(3)) return StreamFormat::in_place;
  if (random.once_in(2)) select_range(input.indices.size(), random, state);
  if (input.restart && random.once_in(2)) {
    // An index that the geometry uses ends primitives.
    input.restart_index = input.indices[static_cast<std::size_t>(random.below(static_cast<int>(input.indices.size())))];
    std::ranges::replace(input.indices, oracle::kRestart, input.restart_index);
  }
  if (input.instance_components != 0 && random.once_in(2)) {
    state.base_instance = random.pick({1u, 2u, 9u});
    input.instances.insert(input.instances.begin(), state.base_instance, input.instances.front());
  }
  const auto format = static_cast<StreamFormat>(random.below(static_cast<int>(StreamFormat::scaled8) + 1));
  round_rows(format, input.vertices);
  round_rows(format, input.instances);
  return format;
}

// Returns a draw with a random combination of topology, primitive restart, instances, base vertex and formats.
template <class S>
SceneDraw primitives_draw(const S& shader, const char* name, const Geometry& g, DrawState state, Random& random,
                          std::initializer_list<Topology> topologies = {Topology::triangles, Topology::triangle_strip,
                                                                        Topology::triangle_fan}) {
  using A = typename S::template Attributes<float>;
  oracle::Input<S> input;
  input.vertices = random_rows<A>(g.positions, random);
  input.indices = g.indices;
  state.topology = random.pick(topologies);
  input.restart = random.once_in(2);
  for (std::size_t i = 0; input.restart && i < input.indices.size(); ++i) {
    if (random.once_in(random.pick({2, 5, 20}))) input.indices[i] = oracle::kRestart;
  }
  if (!input.vertices.empty() && random.once_in(3)) {  // add unused rows in front, or use a negative base
    state.base_vertex = random.pick({1, 5, -3});
    const auto extra = static_cast<std::size_t>(std::max(state.base_vertex, 0));
    input.vertices.insert(input.vertices.begin(), extra, input.vertices.front());
    for (uint32_t& i : input.indices) {
      if (state.base_vertex < 0 && !(input.restart && i == oracle::kRestart)) i += 3;
    }
  }
  state.instances = random.pick({1u, 1u, 2u, 3u, 7u, 0u});
  if (kComponents < A >> 4 && random.once_in(2)) {
    input.instance_components = last_vectors<A>(static_cast<std::size_t>(random.between(1, static_cast<int>(kComponents<A>) - 4)));
    input.divisor = random.pick({1u, 2u, 5u});
    input.instances = random_rows<A>(std::vector<glm::vec4>(state.instances / input.divisor + 1), random);
  }
  const auto vertex_layout = random.pick({VertexLayout::tight, VertexLayout::padded, VertexLayout::separate});
  IndexLayout index_layout = random.once_in(2) ? IndexLayout::narrow : IndexLayout::wide;
  StreamFormat format = input.indices.empty() ? StreamFormat::in_place : vary_vertex_data(random, input, state);
  if (kHasIntegers<A> && format == StreamFormat::in_place) format = StreamFormat::floats;
  const bool fits = std::ranges::all_of(input.indices, [&](uint32_t i) { return i < 255 || i == oracle::kRestart; });
  if (fits && index_layout == IndexLayout::narrow) index_layout = IndexLayout::bytes;
  return make_draw(shader, name, input, state, vertex_layout, index_layout, format);
}

template <class S>
SceneDraw shader_draw(const S& shader, const char* name, const Geometry& g, const DrawState& state, Random& random) {
  using A = typename S::template Attributes<float>;
  std::vector<A> rows = random_rows<A>(g.positions, random);
  const auto vertex_layout = random.pick({VertexLayout::tight, VertexLayout::padded, VertexLayout::separate});
  if (HasFragmentFunction<S> && random.once_in(4)) {  // without an index list, vertices are repeated, and one or two may remain unused
    std::vector<A> repeated;
    std::vector<uint32_t> sequence;
    for (const uint32_t i : g.indices) repeated.push_back(rows[i]);
    for (int i = random.below(3); i > 0 && !rows.empty(); --i) repeated.push_back(rows.front());
    for (uint32_t i = 0; i < repeated.size(); ++i) sequence.push_back(i);
    DrawState part = state;
    Random copy(random);  // leaves the random numbers of the rest of the scene as they are
    if (copy.once_in(2)) select_range(repeated.size(), copy, part);
    return make_draw(shader, name, std::move(repeated), std::move(sequence), part, vertex_layout, IndexLayout::none);
  }
  return make_draw(shader, name, std::move(rows), g.indices, state, vertex_layout,
                   random.once_in(2) ? IndexLayout::narrow : IndexLayout::wide);
}

SceneDraw random_primitives(bool depth_only, const Geometry& g, const DrawState& state, const glm::mat4& matrix, Random& random) {
  if (depth_only) return primitives_draw(DepthShader{matrix}, "DepthShader", g, state, random);
  const int which = random.below(4);
  const bool has_integers = Random(random).once_in(2);  // from a copy, which leaves the other scenes as they are
  if (which >= 2 && has_integers) return primitives_draw(IntegerShader{}, "IntegerShader", g, state, random);
  switch (which) {
    case 0: return primitives_draw(MixedShader{}, "MixedShader", g, state, random);
    case 1: return primitives_draw(FaceShader{}, "FaceShader", g, state, random);
    default: return primitives_draw(InstanceShader{}, "InstanceShader", g, state, random);
  }
}

// Returns the viewports of a draw whose shader chooses among them. The last ones that it chooses do not exist.
std::shared_ptr<const ViewportArray> random_viewports(const Scene& scene, Random& random) {
  ViewportArray viewports;
  for (int i = random.between(1, 3); i > 0; --i) {
    IndexedViewport& v = viewports.emplace_back();
    if (random.once_in(2)) v.viewport = random_rect(scene.width, scene.height, random);
    if (random.once_in(4)) v.scissor = random_rect(scene.width, scene.height, random);
    if (random.once_in(3)) v.range_near = random.real(0.0f, 1.0f);
  }
  return std::make_shared<const ViewportArray>(std::move(viewports));
}

// Returns a draw that chooses layers and viewports in its vertex or geometry function.
SceneDraw layered_draw(const Scene& scene, const Geometry& g, DrawState state, Random& random) {
  using In = GeometryInputPrimitive;
  using Out = GeometryOutputPrimitive;
  std::shared_ptr<const ViewportArray> viewports;
  if (!random.once_in(3)) viewports = random_viewports(scene, random);
  state.viewports = viewports.get();
  const auto triangles = {Topology::triangles, Topology::triangle_strip, Topology::triangle_fan};
  SceneDraw d;
  switch (random.below(6)) {
    case 0:
      d = primitives_draw(GeometryShader<In::triangles, Out::triangle_strip>{}, "triangles to layers", g, state, random, triangles);
      break;
    case 1: d = primitives_draw(GeometryShader<In::triangles, Out::line_strip>{}, "lines in layers", g, state, random, triangles); break;
    case 2: d = primitives_draw(GeometryShader<In::triangles, Out::points>{}, "points in layers", g, state, random, triangles); break;
    case 3: d = primitives_draw(LayerShader{}, "LayerShader", g, state, random, {Topology::line_strip, Topology::points}); break;
    default: d = primitives_draw(LayerShader{}, "LayerShader", g, state, random, triangles); break;
  }
  d.viewports = viewports;
  return d;
}

SceneDraw random_geometry(const Scene& scene, const Geometry& g, DrawState state, Random& random) {
  using In = GeometryInputPrimitive;
  using Out = GeometryOutputPrimitive;
  state.line_width = random.pick({1.0f, 1.0f, 3.0f});
  if (random.once_in(4)) state.polygon_mode = random.pick({PolygonMode::line, PolygonMode::point});
  if (random.once_in(3)) state.point_size = random.pick({3.7f, 16.0f});
  if (random.once_in(3)) add_operations(scene, false, random, state);
  if (Random copy = other_numbers(random); copy.once_in(3)) return layered_draw(scene, g, state, copy);
  const auto triangles = {Topology::triangles, Topology::triangle_strip, Topology::triangle_fan};
  const auto adjacent = {Topology::triangles_adjacency, Topology::triangle_strip_adjacency};
  const auto lines = {Topology::lines, Topology::line_strip, Topology::line_loop};
  const auto adjacent_lines = {Topology::lines_adjacency, Topology::line_strip_adjacency};
  using Domain = TessellationDomain;
  using Spacing = TessellationSpacing;
  const auto patches = {Topology::patches};
  switch (random.below(13)) {
    case 8:
      return primitives_draw(PatchShader<Domain::triangles, Spacing::equal, false, 3>{}, "triangle patches", g, state, random, patches);
    case 9:
      return primitives_draw(PatchShader<Domain::quads, Spacing::fractional_odd, false, 4>{}, "quad patches", g, state, random, patches);
    case 10:
      return primitives_draw(PatchShader<Domain::isolines, Spacing::fractional_even, false, 2>{}, "isolines", g, state, random, patches);
    case 11:
      return primitives_draw(PatchShader<Domain::quads, Spacing::fractional_even, true, 5>{}, "points of patches", g, state, random,
                             patches);
    case 12: return primitives_draw(PatchGeometryShader{}, "lines of patches", g, state, random, patches);
    case 0:
      return primitives_draw(GeometryShader<In::triangles, Out::triangle_strip>{}, "triangles to triangles", g, state, random, triangles);
    case 1: return primitives_draw(GeometryShader<In::triangles, Out::line_strip>{}, "triangles to lines", g, state, random, triangles);
    case 2: return primitives_draw(GeometryShader<In::triangles, Out::points>{}, "triangles to points", g, state, random, triangles);
    case 3:
      return primitives_draw(GeometryShader<In::points, Out::triangle_strip>{}, "points to triangles", g, state, random,
                             {Topology::points});
    case 4: return primitives_draw(GeometryShader<In::lines, Out::triangle_strip>{}, "lines to triangles", g, state, random, lines);
    case 5:
      return primitives_draw(GeometryShader<In::lines_adjacency, Out::line_strip>{}, "adjacent lines to lines", g, state, random,
                             adjacent_lines);
    case 6:
      return primitives_draw(MixedShader{}, "MixedShader with adjacency", g, state, random, random.once_in(2) ? adjacent : adjacent_lines);
    default:
      return primitives_draw(GeometryShader<In::triangles_adjacency, Out::triangle_strip>{}, "adjacent triangles to triangles", g, state,
                             random, adjacent);
  }
}

template <class S>
SceneDraw operations_draw(const S& shader, const char* name, const Scene& scene, const Geometry& g, DrawState state, Random& random) {
  bool dual_sources = false;
  if constexpr (HasFragmentFunction<S>) dual_sources = kColors<S> > 1;
  add_operations(scene, dual_sources, random, state);
  return shader_draw(shader, name, g, state, random);
}

SceneDraw random_operations(const Scene& scene, const Geometry& g, const DrawState& state, const glm::mat4& matrix, Random& random) {
  const float value = random.real(0.05f, 0.4f);
  if (random.once_in(scene.color.format == ColorFormat::none ? 2 : 12))
    return operations_draw(DepthShader{matrix}, "DepthShader", scene, g, state, random);
  if (Random copy = other_numbers(random); copy.once_in(4)) {
    switch (copy.below(4)) {
      case 0: return operations_draw(SampleShader<false, ConservativeDepth::any>{value}, "SampleShader", scene, g, state, random);
      case 1:
        return operations_draw(SampleShader<true, ConservativeDepth::any>{value}, "SampleShader with early tests", scene, g, state, random);
      case 2:
        return operations_draw(SampleShader<false, ConservativeDepth::greater>{value}, "SampleShader, greater", scene, g, state, random);
      default: return operations_draw(SampleShader<false, ConservativeDepth::less>{value}, "SampleShader, less", scene, g, state, random);
    }
  }
  switch (random.below(10)) {
    case 0: return operations_draw(ColorShader{matrix, 1.0f}, "ColorShader", scene, g, state, random);
    case 1: return operations_draw(CutoutShader<false>{value}, "CutoutShader", scene, g, state, random);
    case 2: return operations_draw(CutoutShader<true>{value}, "CutoutShader with visibility", scene, g, state, random);
    case 3: return operations_draw(BumpShader<false>{value}, "BumpShader", scene, g, state, random);
    case 4: return operations_draw(BumpShader<true>{value}, "BumpShader with visibility", scene, g, state, random);
    case 5: return operations_draw(DerivativeShader{}, "DerivativeShader", scene, g, state, random);
    case 6: return operations_draw(PixelShader{matrix, glm::vec4{value, 1, 1, 0.75f}}, "PixelShader", scene, g, state, random);
    case 7: return operations_draw(ManyColorsShader<2>{value}, "ManyColorsShader<2>", scene, g, state, random);
    default: return operations_draw(ManyColorsShader<4>{value}, "ManyColorsShader<4>", scene, g, state, random);
  }
}

// Returns a draw of points with a size from the state or the shader, or of sprites with explicit bounds.
template <class S>
SceneDraw points_draw(const S& shader, const char* name, const Scene& scene, const Geometry& g, DrawState state, Random& random) {
  state.topology = Topology::points;
  state.point_size = random.pick({1.0f, 1.0f, 3.7f, 16.0f, 90.5f, 4096.0f});
  if (random.once_in(2)) state.point_origin = PointOrigin::lower_left;
  if (random.once_in(2)) state.cull = CullMode::none;
  if (random.once_in(3)) add_operations(scene, false, random, state);
  return shader_draw(shader, name, g, state, random);
}

SceneDraw random_points(const Scene& scene, const Geometry& g, const DrawState& state, Random& random) {
  const float size = random.pick({2.0f, 15.0f, 60.0f, 4096.0f, -1.0f});
  if (scene.color.format == ColorFormat::none) return points_draw(DepthShader{}, "DepthShader", scene, g, state, random);
  switch (random.below(7)) {
    case 0: return points_draw(MixedShader{}, "MixedShader", scene, g, state, random);
    case 1: return points_draw(FaceCutoutShader{}, "FaceCutoutShader", scene, g, state, random);
    case 2: return points_draw(DerivativeShader{}, "DerivativeShader", scene, g, state, random);
    case 3: return points_draw(PointShader<false>{size}, "PointShader", scene, g, state, random);
    case 4: return points_draw(PointShader<true>{size}, "PointShader with visibility", scene, g, state, random);
    case 5: return points_draw(BoundsShader<false>{random.real(0.01f, 1.5f)}, "BoundsShader", scene, g, state, random);
    default: return points_draw(BoundsShader<true>{random.real(0.01f, 1.5f)}, "BoundsShader with visibility", scene, g, state, random);
  }
}

// Returns a draw of lines, outlines or triangles with clip distances.
template <class S>
SceneDraw lines_draw(const S& shader, const char* name, const Scene& scene, const Geometry& g, DrawState state, Random& random) {
  if (random.once_in(2)) {
    state.topology = random.pick({Topology::lines, Topology::line_strip, Topology::line_loop});
  } else if (!random.once_in(3)) {
    state.polygon_mode = random.pick({PolygonMode::line, PolygonMode::line, PolygonMode::point});
  }
  state.line_width = random.pick({1.0f, 1.0f, 1.0f, 1.6f, 3.0f, 4.0f, 11.3f});
  state.point_size = random.pick({1.0f, 5.0f, 20.0f});
  if (Random copy(random); state.polygon_mode != PolygonMode::fill && copy.once_in(2)) {  // leaves the other random numbers as they are
    state.offset.slope = copy.pick({0.0f, 1.0f, -2.5f});
    state.offset.constant = copy.pick({0.0f, 4.0f, -1000.0f});
    state.offset.outlines = copy.once_in(2);
    state.offset.corners = copy.once_in(2);
    state.offset.fill = copy.once_in(2);
  }
  if (random.once_in(4)) add_operations(scene, false, random, state);
  return shader_draw(shader, name, g, state, random);
}

SceneDraw random_lines(const Scene& scene, const Geometry& g, const DrawState& state, Random& random) {
  if (scene.color.format == ColorFormat::none) return lines_draw(DepthShader{}, "DepthShader", scene, g, state, random);
  switch (random.below(7)) {
    case 0: return lines_draw(MixedShader{}, "MixedShader", scene, g, state, random);
    case 1: return lines_draw(FaceShader{}, "FaceShader", scene, g, state, random);
    case 2: return lines_draw(DerivativeShader{}, "DerivativeShader", scene, g, state, random);
    case 3: return lines_draw(CutoutShader<true>{0.2f}, "CutoutShader with visibility", scene, g, state, random);
    case 4: return lines_draw(ClipShader<1>{}, "ClipShader<1>", scene, g, state, random);
    case 5: return lines_draw(ClipShader<8>{}, "ClipShader<8>", scene, g, state, random);
    default: return lines_draw(PixelShader{}, "PixelShader", scene, g, state, random);
  }
}

SceneDraw random_draw(Theme theme, const Scene& scene, bool depth_only, const Geometry& g, const DrawState& state, const glm::mat4& matrix,
                      Random& random) {
  if (theme == Theme::lines) return random_lines(scene, g, state, random);
  if (theme == Theme::points) return random_points(scene, g, state, random);
  if (theme == Theme::operations || theme == Theme::samples) return random_operations(scene, g, state, matrix, random);
  if (theme == Theme::geometry && !depth_only) return random_geometry(scene, g, state, random);
  if (theme == Theme::primitives && !random.once_in(4)) return random_primitives(depth_only, g, state, matrix, random);
  if (depth_only) return shader_draw(DepthShader{matrix}, "DepthShader", g, state, random);
  const bool themed = !random.once_in(3);
  const float value = random.real(0.05f, 0.4f);
  int which = random.below(10);
  if (themed && theme == Theme::discarding) which = random.pick({4, 5, 9});
  if (themed && theme == Theme::depth_writing) which = random.pick({6, 7});
  if (themed && theme == Theme::faces) which = random.pick({8, 9});
  switch (which) {
    case 0: return shader_draw(PixelShader{matrix, glm::vec4{value, 1, 1, 0.75f}}, "PixelShader", g, state, random);
    case 1: return shader_draw(ColorShader{matrix, random.once_in(8) ? 1e5f : 1.0f}, "ColorShader", g, state, random);
    case 2: return shader_draw(MixedShader{}, "MixedShader", g, state, random);
    case 3: return shader_draw(DerivativeShader{}, "DerivativeShader", g, state, random);
    case 4: return shader_draw(CutoutShader<false>{value}, "CutoutShader", g, state, random);
    case 5: return shader_draw(CutoutShader<true>{value}, "CutoutShader with visibility", g, state, random);
    case 6: return shader_draw(BumpShader<false>{value}, "BumpShader", g, state, random);
    case 7: return shader_draw(BumpShader<true>{value}, "BumpShader with visibility", g, state, random);
    case 8: return shader_draw(FaceShader{}, "FaceShader", g, state, random);
    default: return shader_draw(FaceCutoutShader{}, "FaceCutoutShader", g, state, random);
  }
}

// Returns the format of a color attachment: often one of those that have code of their own.
ColorFormat random_color_format(Random& random) {
  if (!random.once_in(3)) return random.pick({ColorFormat::rgba8, ColorFormat::srgb8a8, ColorFormat::rgba16f, ColorFormat::rgba32f});
  for (;;) {
    const auto format = static_cast<ColorFormat>(random.between(1, static_cast<int>(kTexelFormats) - 1));
    if (!is_integer(format) && !is_depth(format) && format != ColorFormat::rgb9_e5) return format;
  }
}

// Adds a stencil buffer, more color attachments and more samples.
void add_attachments(Theme theme, bool depth_only, Random& random, Scene& s) {
  s.depth.format = random.pick({DepthFormat::d24s8, DepthFormat::d32fs8, DepthFormat::d32fs8, DepthFormat::d24});
  s.depth.stencil_clear_value = static_cast<uint8_t>(random.pick({0, 0, 1, 128, 255}));
  for (int i = depth_only ? 0 : random.pick({0, 0, 1, 3}); i > 0; --i) {
    ColorTarget c;
    c.format = random.once_in(5) ? ColorFormat::none : random_color_format(random);
    c.clear_value = {random.real(0, 1), random.real(0, 1), random.real(0, 1), random.real(0, 1)};
    s.more_colors.push_back(c);
  }
  if (theme != Theme::operations) {
    s.samples = random.pick({2, 4, 4, 8});
    s.supersample = random.once_in(6);
  }
}

}  // namespace

Scene random_scene(Theme theme, uint64_t seed) {
  Random random(seed * 8 + static_cast<uint64_t>(theme));
  Scene s;
  s.width = random.between(20, 200);
  s.height = random.between(20, 130);
  if (random.once_in(10)) s.width = random.pick({1, 8, 64, 65, 128});
  if (random.once_in(10)) s.height = random.pick({1, 8, 64, 65, 127});
  const bool depth_only = random.once_in(15);
  s.color.format = depth_only ? ColorFormat::none : random_color_format(random);
  s.depth.format = random.pick({DepthFormat::d32f, DepthFormat::d32f, DepthFormat::d24, DepthFormat::d16, DepthFormat::none});
  s.color.clear_value = {random.real(0, 1), random.real(0, 1), random.real(-0.5f, 1.5f), random.real(0, 1)};
  s.depth.clear_value = random.pick({0.0f, 0.0f, 0.4f, 1.0f, 1.0f, 1.0f});
  const bool many_points = (theme == Theme::points || theme == Theme::lines) && random.once_in(theme == Theme::points ? 2 : 4);
  if (theme == Theme::operations || theme == Theme::samples || many_points) add_attachments(theme, depth_only, random, s);
  if (theme == Theme::geometry) s.layers = other_numbers(random).pick({1, 1, 2, 3});
  vary_images(random, s);
  if (random.once_in(4)) {
    fill_images(s, random);
    s.color.load = s.depth.load = LoadOp::load;
    if (random.once_in(3)) s.depth.stencil_load = LoadOp::clear;
    for (ColorTarget& c : s.more_colors) c.load = LoadOp::load;
  }
  if (!depth_only && random.once_in(4)) {
    s.post_format = random_color_format(random);
    s.has_color_image = s.color.load == LoadOp::load || random.once_in(2);
  }
  if (s.layers > 1) s.post_format = ColorFormat::none, s.has_color_image = true;
  s.has_depth_image = s.depth.load == LoadOp::load || !random.once_in(5);

  const int draws = theme == Theme::many_draws ? random.between(8, 30) : random.between(1, 4);
  Geometry g;
  glm::mat4 matrix(1.0f);
  for (int d = 0; d < draws; ++d) {
    DrawState state = random_state(s, theme, random);
    if (d == 0 || !random.once_in(3)) {  // otherwise draw the last geometry again, for equal depths
      g = {};
      matrix = random_matrix(random);
      const Rect viewport = viewport_of(s, state);
      const int kinds = theme == Theme::many_draws ? random.between(0, 3) : random.between(2, 10);
      for (int k = 0; k < kinds; ++k) add_triangles(random_kind(theme, random), viewport, state.depth.clip, random, g);
    } else if (random.once_in(2)) {
      state.depth = s.draws.back().state.depth;
      state.viewport = s.draws.back().state.viewport;
      state.clip_origin = s.draws.back().state.clip_origin;
      state.offset = {};
      state.depth.compare = random.pick({CompareOp::equal, CompareOp::equal, CompareOp::not_equal, CompareOp::greater_equal});
    }
    s.draws.push_back(random_draw(theme, s, depth_only, g, state, matrix, random));
  }
  return s;
}

}  // namespace halfspace
