// SPDX-License-Identifier: Apache-2.0
#include "conformance/random_state.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <vector>

#include "conformance/geometry.h"
#include "conformance/outputs.h"
#include "conformance/shaders.h"
#include "support/random_state.h"

namespace halfspace::conformance {

namespace {

BlendState random_blend(Random& r, bool two_sources) {
  if (r.once_in(3)) return {};
  BlendState b = random_equations(r, two_sources ? 19 : 15);
  b.constant = {r.real(0, 1), r.real(0, 1), r.real(0, 1), r.real(0, 1)};
  return b;
}

StencilFace random_face(Random& r) {
  const auto op = [&] { return static_cast<StencilOp>(r.below(8)); };
  StencilFace f;
  f.compare = r.once_in(2) ? CompareOp::always : static_cast<CompareOp>(r.below(8));
  f.fail = op();
  f.depth_fail = op();
  f.pass = op();
  f.reference = static_cast<uint8_t>(r.pick({0, 1, 2, 0x80, 0xff}));
  f.read_mask = static_cast<uint8_t>(r.pick({0xff, 0xff, 1, 0xf0}));
  f.write_mask = static_cast<uint8_t>(r.pick({0xff, 0xff, 3, 0x3c}));
  return f;
}

Rect random_rect(const Picture& p, Random& r) {
  const int x = r.between(-4, p.width / 2);
  const int y = r.between(-4, p.height / 2);
  const int width = r.between(p.width / 3, p.width);
  return {x, y, width, r.between(p.height / 3, p.height)};
}

DepthState random_depth(Random& r) {
  DepthState d;
  d.test = !r.once_in(4);
  d.write = !r.once_in(5);
  d.compare = r.once_in(2) ? r.pick({CompareOp::less, CompareOp::less_equal}) : static_cast<CompareOp>(r.below(8));
  d.clamp = r.once_in(6);
  if (r.once_in(5)) {
    d.range_near = r.real(0, 1);
    d.range_far = r.real(0, 1);
  }
  return d;
}

void random_tests(const Picture& p, Random& r, Drawing& d) {
  DrawState& s = d.state;
  s.depth = random_depth(r);
  if (r.once_in(3)) s.scissor = random_rect(p, r);
  if (r.once_in(6)) s.viewport = Rect{r.between(-8, 8), r.between(-8, 8), 32, 32};
  if (r.once_in(3)) s.cull = r.pick({CullMode::front, CullMode::back});
  if (r.once_in(3)) s.front = Winding::clockwise;
  if (r.once_in(4)) s.provoking = ProvokingVertex::first;
  if (r.once_in(6)) s.offset = {.slope = r.real(-2, 2), .constant = r.pick({0.0f, 2.0f, -900.0f})};
  if (r.once_in(3)) s.stencil = StencilState{random_face(r), random_face(r)};
  if (r.once_in(3)) s.blend = random_blend(r, d.kind == Kind::two_colors);
  if (r.once_in(6)) s.color_mask = random_mask(r);
  if (p.samples > 1) {
    s.sample_shading = r.once_in(4);
    s.alpha_to_coverage = r.once_in(5);
    if (r.once_in(5)) s.sample_mask = r.bits();
  }
  if (r.once_in(5)) s.query = static_cast<uint32_t>(r.below(3));
}

void random_primitives(Random& r, Drawing& d) {
  DrawState& s = d.state;
  s.topology = r.once_in(2) ? Topology::triangles : static_cast<Topology>(r.below(7));
  if (d.kind == Kind::point) s.topology = Topology::points;
  s.point_size = r.pick({1.0f, 4.0f, 9.5f});
  s.line_width = r.pick({1.0f, 1.0f, 3.0f});
  if (r.once_in(10) && s.topology != Topology::points) s.polygon_mode = r.pick({PolygonMode::line, PolygonMode::point});
  if (d.kind == Kind::instance) s.instances = static_cast<uint32_t>(r.between(1, 4));
  if (r.once_in(4)) {  // indices, possibly with primitive restart
    d.restart = r.once_in(2);
    if (r.once_in(2)) d.index_layout = IndexLayout::narrow;
    const int n = static_cast<int>(d.vertices.size());
    for (int i = 0; i < n; ++i) d.indices.push_back(d.restart && r.once_in(6) ? oracle::kRestart : static_cast<uint32_t>(r.below(n)));
  }
}

Drawing random_drawing(const Picture& p, Random& r, bool first) {
  Drawing d;
  d.kind =
      r.once_in(2)
          ? Kind::color
          : r.pick({Kind::clip, Kind::cutout, Kind::depth, Kind::point, Kind::derivative, Kind::texture, Kind::instance, Kind::two_colors});
  if (p.colors.size() > 1) d.kind = Kind::four_colors;
  d.mode = d.kind == Kind::color ? r.below(3) : d.kind == Kind::derivative ? r.below(6) : 0;
  d.value = r.real(0.05f, 0.6f);
  const uint64_t seed = r.bits();
  const bool projected = r.once_in(2);  // in this order, since the evaluation order of arguments is unspecified
  d.vertices = scattered(p, r.between(6, 20), seed, projected);
  for (Vertex& v : d.vertices) {
    if (first && r.once_in(2)) v.pos_clip.x = v.pos_clip.x * 2.0f;  // covers more pixels and is clipped
    if (r.once_in(12)) v.pos_clip.z *= 3.0f;
    if (r.once_in(25)) v.pos_clip.w *= -1.0f;
    v.color = {r.real(0, 1), r.real(0, 1), r.real(0, 1), r.real(0, 1)};
    v.extra = {r.real(-0.2f, 1), r.real(-0.2f, 1), r.real(-0.2f, 1), r.real(-0.2f, 1)};
    if (d.kind == Kind::point) v.extra.x = r.pick({1.0f, 5.0f, 12.5f});
    if (d.kind == Kind::instance) v.extra *= 0.1f;
  }
  if (d.kind == Kind::texture) {
    Image<glm::u8vec4> texels(8, 4);
    for (int i = 0; i < 32; ++i) texels.at(i % 8, i / 8) = glm::u8vec4(color_number(i + static_cast<int>(seed % 50)) * 255.0f);
    d.texture = std::make_shared<const Texture2D>(texels, r.once_in(2) ? TexelFormat::rgba8 : TexelFormat::srgb8a8);
    d.sampler = {.mag = r.pick({Filter::nearest, Filter::bilinear}),
                 .min = r.pick({Filter::nearest, Filter::bilinear, Filter::trilinear}),
                 .wrap_s = static_cast<Wrap>(r.below(3)),
                 .wrap_t = static_cast<Wrap>(r.below(3))};
  }
  random_primitives(r, d);
  random_tests(p, r, d);
  if (first) {  // ensures that something is drawn
    if (!r.once_in(4)) d.state.depth.compare = CompareOp::less;
    if (!r.once_in(4)) d.state.cull = CullMode::none;
    if (!r.once_in(4)) d.state.stencil.reset();
    if (!r.once_in(4)) d.state.color_mask = {};
  }
  return d;
}

ClearValues random_clear(const Picture& p, Random& random) {
  ClearValues values;
  if (!random.once_in(3)) values.rect = random_rect(p, random);
  for (std::size_t i = 0; i < p.colors.size(); ++i) {
    if (!random.once_in(3)) values.colors[i] = {random.real(0, 1), random.real(0, 1), random.real(0, 1), random.real(0, 1)};
  }
  if (random.once_in(2)) values.mask = random_mask(random);
  if (p.depth != DepthFormat::none && random.once_in(2)) values.depth = random.pick({0.0f, 0.5f, 1.0f});
  if (has_stencil(p.depth) && random.once_in(2)) values.stencil = static_cast<uint8_t>(random.pick({0, 1, 0x80, 0xa5}));
  values.stencil_mask = static_cast<uint8_t>(random.pick({0xff, 0xff, 3, 0xf0}));
  return values;
}

// Adds clears, smooth primitives, and conditions on the queries of draws before, to the draws of a picture.
void add_later_state(Picture& p, Random random) {
  std::vector<uint32_t> queries;
  for (Drawing& d : p.draws) {
    DrawState& s = d.state;
    s.line_smooth = random.once_in(6);
    s.polygon_smooth = random.once_in(10);
    const int number = random.below(3);
    if (!queries.empty() && random.once_in(2)) {
      const uint32_t query = queries[static_cast<std::size_t>(number) % queries.size()];
      if (s.query != query) s.condition = DrawCondition{query, random.once_in(2)};
    }
    if (s.query) queries.push_back(*s.query);
    if (random.once_in(8)) {
      d.clear = random_clear(p, random);
      if (random.once_in(2)) d.clear->condition = s.condition;
    }
  }
}

// Replaces the attachments of some pictures by integers, or by integers and colors, and the shaders of their draws.
void add_integers(Picture& p, Random random) {
  if (!random.once_in(8)) return;
  using enum TexelFormat;
  const OutputTypes& types = kOutputTypes[static_cast<std::size_t>(random.between(1, static_cast<int>(kOutputTypes.size()) - 1))];
  for (std::size_t i = 0; i < p.colors.size(); ++i) {
    const ColorFormat a = random.pick({r8i, rgba8i, rg16i, rgba16i, r32i, rgba32i}),
                      b = random.pick({r8ui, rgba8ui, rg16ui, rgba16ui, r32ui, rgba32ui, rgb10_a2ui});
    if (types[i] != ColorType::real) p.colors[i] = types[i] == ColorType::signed_integer ? a : b;
  }
  // Bits of small integers, which are numbers near 0 in other attachments.
  const auto integers = [&] {
    return std::bit_cast<glm::vec4>(glm::ivec4{random.below(4), random.below(4), random.below(4), random.below(4)});
  };
  const IntegerRange range = integer_range(p.colors);
  p.clear_color = integers();
  for (Drawing& d : p.draws) {
    d.kind = Kind::outputs;
    d.mode = 0;
    d.outputs = types;
    d.value = range.factor;
    d.texture.reset();
    d.state.blend.reset();
    for (Vertex& v : d.vertices) v.extra = random_integers(range, random);
    for (std::size_t i = 0; i < p.colors.size(); ++i) {
      if (random.once_in(3)) d.state.attachments[i] = AttachmentState{{}, random_mask(random)};
      if (d.clear && d.clear->colors[i] && is_integer(p.colors[i])) d.clear->colors[i] = integers();
    }
  }
}

// Drops the primitives whose number has the value `which` in bit k.
void drop_primitives(Picture& p, int k, int which) {
  for (Drawing& d : p.draws) {
    const DrawState& s = d.state;
    const std::size_t n = s.topology == Topology::triangles ? 3 : s.topology == Topology::lines ? 2 : 1;
    const auto dropped = [&](std::size_t i) { return static_cast<int>(i / n >> k & 1) == which; };
    std::vector<uint32_t> left;
    const std::size_t all = d.indices.empty() ? d.vertices.size() : d.indices.size();
    for (std::size_t i = 0; i < all; ++i) {
      if (!dropped(i)) left.push_back(d.indices.empty() ? static_cast<uint32_t>(i) : d.indices[i]);
    }
    if (!left.empty()) d.indices = left;
  }
}

ColorFormat simplest_format(ColorFormat f) {
  switch (color_type(f)) {
    case ColorType::signed_integer: return ColorFormat::rgba8i;
    case ColorType::unsigned_integer: return ColorFormat::rgba8ui;
    case ColorType::real: break;
  }
  return ColorFormat::rgba8;
}

// Returns the simplifications in the order of their bits.
std::vector<std::function<void(Picture&)>> simplifications() {
  std::vector<std::function<void(Picture&)>> all;
  for (int k = 0; k < 5; ++k) {
    for (int which = 0; which < 2; ++which) all.push_back([=](Picture& p) { drop_primitives(p, k, which); });
  }
  const auto each_drawing = [&](auto change) {
    for (std::size_t i = 0; i < 4; ++i) {
      all.push_back([=](Picture& p) {
        if (i < p.draws.size()) change(p.draws[i]);
      });
    }
  };
  const auto each = [&](auto change) { each_drawing([=](Drawing& d) { change(d.state); }); };
  each([](DrawState& s) { s.blend.reset(); });
  each([](DrawState& s) { s.stencil.reset(); });
  each([](DrawState& s) { s.depth = {}; });
  each([](DrawState& s) { s.scissor.reset(), s.viewport.reset(); });
  each([](DrawState& s) { s.cull = CullMode::none, s.front = Winding::counter_clockwise; });
  each([](DrawState& s) { s.color_mask = {}, s.attachments = {}, s.offset = {}, s.query.reset(); });
  each([](DrawState& s) { s.sample_shading = s.alpha_to_coverage = false, s.sample_mask = ~0u; });
  each([](DrawState& s) { s.polygon_mode = PolygonMode::fill, s.instances = 1; });
  each_drawing([](Drawing& d) {
    d.state.line_smooth = d.state.polygon_smooth = false;
    d.state.condition.reset();
    if (d.clear) d.clear->condition.reset();
  });
  each_drawing([](Drawing& d) { d.clear.reset(); });
  all.push_back([](Picture& p) {
    for (Drawing& d : p.draws) {
      // Not with two colors, because blending may need both, and not with integers.
      if (p.colors.size() == 1 && d.kind != Kind::two_colors && d.kind != Kind::outputs) d.kind = Kind::color;
      d.mode = kSmooth;
    }
  });
  all.push_back([](Picture& p) { p.samples = 1, p.supersample = false; });
  all.push_back([](Picture& p) {
    for (ColorFormat& f : p.colors) f = simplest_format(f);
  });
  all.push_back([](Picture& p) { p.depth = DepthFormat::d32fs8; });
  for (std::size_t i = 4; i-- > 0;) {  // draws are removed from last to first, so that the numbers above stay valid
    all.push_back([=](Picture& p) {
      if (i < p.draws.size() && p.draws.size() > 1) p.draws.erase(p.draws.begin() + static_cast<std::ptrdiff_t>(i));
    });
  }
  return all;  // 58
}

}  // namespace

std::string RandomState::text() const {
  if (simplified == 0) return std::to_string(seed);
  std::array<char, 20> hex{};
  const auto end = std::to_chars(hex.data(), hex.data() + hex.size(), simplified, 16).ptr;
  return std::to_string(seed) + ":" + std::string(hex.data(), end);
}

bool RandomState::parse(const std::string& text, RandomState& state) {
  const char* end = text.data() + text.size();
  const auto seed = std::from_chars(text.data(), end, state.seed);
  if (seed.ec != std::errc() || (seed.ptr != end && *seed.ptr != ':')) return false;
  state.simplified = 0;
  if (seed.ptr == end) return true;
  const auto bits = std::from_chars(seed.ptr + 1, end, state.simplified, 16);
  return bits.ec == std::errc() && bits.ptr == end;
}

Picture random_picture(const RandomState& state) {
  Random r(state.seed * 0x9e3779b9u + 77);
  Picture p;
  p.width = r.pick({16, 32, 32, 64});
  p.height = r.pick({16, 32, 32});
  p.samples = r.pick({1, 1, 1, 1, 2, 4, 4, 8});
  p.supersample = p.samples > 1 && r.once_in(6);
  p.colors = {r.pick({ColorFormat::rgba8, ColorFormat::rgba8, ColorFormat::srgb8a8, ColorFormat::rgba16f, ColorFormat::rgba32f})};
  if (r.once_in(10)) p.colors.assign(static_cast<std::size_t>(r.between(2, 4)), p.colors[0]);
  p.depth = r.pick({DepthFormat::d32fs8, DepthFormat::d24s8, DepthFormat::d32fs8, DepthFormat::d24, DepthFormat::d16, DepthFormat::none});
  p.clear_color = {r.real(0, 1), r.real(0, 1), r.real(0, 1), r.real(0, 1)};
  p.clear_depth = r.pick({1.0f, 1.0f, 0.75f});
  p.clear_stencil = static_cast<uint8_t>(r.pick({0, 0, 1, 0x80}));
  const int draws = r.between(1, 4);
  for (int i = 0; i < draws; ++i) p.draws.push_back(random_drawing(p, r, i == 0));
  add_later_state(p, other_numbers(r));
  add_integers(p, other_numbers(other_numbers(r)));
  const auto simplify = simplifications();
  for (std::size_t i = 0; i < simplify.size(); ++i) {
    if (state.simplified >> i & 1) simplify[i](p);
  }
  return p;
}

RandomState shrink(RandomState state, const std::function<bool(const Picture&)>& fails) {
  const std::size_t n = simplifications().size();
  for (bool shrank = true; shrank;) {
    shrank = false;
    for (std::size_t i = n; i-- > 0;) {  // try to remove whole draws first
      const uint64_t bit = uint64_t{1} << i;
      if ((state.simplified & bit) != 0 || !fails(random_picture({state.seed, state.simplified | bit}))) continue;
      state.simplified |= bit;
      shrank = true;
    }
  }
  return state;
}

}  // namespace halfspace::conformance
