// SPDX-License-Identifier: Apache-2.0
//
// Draws the images of tests/conformance with Mesa. In each group at least 99.9% of the covered pixels must agree.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "conformance/groups.h"
#include "conformance/random_state.h"
#include "halfspace/core/srgb.h"
#include "mesa/conformance_glsl.h"
#include "mesa/mesa_context.h"
#include "mesa/mesa_draw.h"
#include "mesa/texel_tolerance.h"
#include "support/long_tests.h"

namespace halfspace::test {

namespace {

using conformance::Drawing;
using conformance::Kind;
using namespace conformance_glsl;

struct Glsl {
  const char *vertex, *fragment;
};

// Returns the geometry shader with a layout and a body, or null.
const char* geometry_glsl_of(const GeometryLayout& layout, const char* body) {
  static std::map<std::string, std::string> sources;  // by layout; the addresses stay the same
  constexpr std::array kInputs{"points", "lines", "lines_adjacency", "triangles", "triangles_adjacency"};
  constexpr std::array kOutputs{"points", "line_strip", "triangle_strip"};
  const std::string line = std::string("layout(") + kInputs[static_cast<std::size_t>(layout.input)] +
                           ", invocations = " + std::to_string(layout.invocations) + ") in; layout(" +
                           kOutputs[static_cast<std::size_t>(layout.output)] + ", max_vertices = " + std::to_string(layout.max_vertices) +
                           ") out; const int invocations = " + std::to_string(layout.invocations) + ";";
  std::string& source = sources[line + body];
  if (source.empty()) source = line + body;
  return source.c_str();
}
// Returns the fragment shader with one of the lists of types.
const char* outputs_glsl_of(const conformance::OutputTypes& types) {
  static std::map<conformance::OutputTypes, std::string> sources;  // the addresses stay the same
  constexpr std::array kTypes{"vec4", "ivec4", "uvec4"};
  std::string& source = sources[types];
  if (!source.empty()) return source.c_str();
  source = kOutputsFunctions;
  std::string body = "void main() {\n";
  for (std::size_t i = 0; i < types.size(); ++i) {
    const std::string type = kTypes[static_cast<std::size_t>(types[i])], number = std::to_string(i);
    source += "layout(location = " + number + ") out " + type + " color_" + number + ";\n";
    body += "color_" + number + " = " + (types[i] == ColorType::real ? "fraction" : type + "(integers") + "(" + number + ".0)" +
            (types[i] == ColorType::real ? ";\n" : ");\n");
  }
  source += body + "}";
  return source.c_str();
}

// attachments: the number of color attachments.
Glsl glsl_of(const Drawing& d, std::size_t attachments) {
  switch (d.kind) {
    case Kind::color: return {kColorVertex, kColorFragment};
    case Kind::clip: return {kClipVertex, kPlainFragment};
    case Kind::cutout: return {kVertex, kCutoutFragment};
    case Kind::depth: return {kVertex, kDepthFragment};
    case Kind::point: return {kPointVertex, kPointFragment};
    case Kind::derivative: return {kVertex, kDerivativeFragment};
    case Kind::texture: return {kVertex, kTextureFragment};
    case Kind::instance: return {kInstanceVertex, kPlainFragment};
    case Kind::cull: return {kCullVertex, kPlainFragment};
    case Kind::viewport: return {kViewportVertex, kPlainFragment};
    case Kind::sample_inputs: return {kVertex, kSampleInputsFragment};
    case Kind::sample_mask_in: return {kVertex, kSampleMaskInFragment};
    case Kind::sample_mask: return {kVertex, kSampleMaskFragment};
    case Kind::geometry: return {kGeometryVertex, kGeometryFragment};
    case Kind::tessellation: return {kTessellationVertex, kGeometryFragment};
    case Kind::layer: return {kLayerVertex, kLayerFragment};
    case Kind::layer_geometry: return {kTessellationVertex, kLayerFragment};
    case Kind::outputs: return {kOutputsVertex, outputs_glsl_of(d.outputs)};
    case Kind::attributes: return {kArraysVertex, kArraysFragment};
    case Kind::two_colors:
    case Kind::four_colors: break;
  }
  return {kVertex, attachments == 1 ? kTwoFragment : kFourFragment};  // two colors are the sources of one attachment, or of one each
}

// Return the control and the evaluation shader with one of the layouts.
const char* control_glsl_of(const TessellationLayout& layout) {
  static std::map<int, std::string> sources;  // by number of vertices; the addresses stay the same
  std::string& source = sources[layout.patch_vertices];
  if (source.empty()) source = "layout(vertices = " + std::to_string(layout.patch_vertices) + ") out;" + kControlBody;
  return source.c_str();
}
const char* evaluation_glsl_of(const TessellationLayout& layout) {
  static std::map<std::string, std::string> sources;
  constexpr std::array kDomains{"triangles", "quads", "isolines"};
  constexpr std::array kSpacings{"equal_spacing", "fractional_even_spacing", "fractional_odd_spacing"};
  const std::string line = std::string("layout(") + kDomains[static_cast<std::size_t>(layout.domain)] + ", " +
                           kSpacings[static_cast<std::size_t>(layout.spacing)] + (layout.clockwise ? ", cw" : ", ccw") +
                           (layout.point_mode ? ", point_mode" : "") + ") in;";
  std::string& source = sources[line];
  if (source.empty()) source = line + kEvaluationBody;
  return source.c_str();
}

VertexView vertices_of(const Drawing& d) {
  if (!d.arrays.empty()) {
    std::vector<VertexStream> streams;
    for (const conformance::AttributeArray& a : d.arrays) streams.push_back(a.stream);
    return detail::bind_streams(streams, conformance::vertex_count(d));
  }
  VertexStream extra = stream(d.vertices, &conformance::Vertex::extra);
  if (!d.rows.empty()) extra = per_instance(stream(d.rows), d.divisor);
  return make_vertex_view(stream(d.vertices, &conformance::Vertex::pos_clip), stream(d.vertices, &conformance::Vertex::color), extra);
}

bool has_unsigned_attribute(const Drawing& d) {
  return std::ranges::any_of(d.arrays, [](const conformance::AttributeArray& a) {
    const ComponentType type = a.stream.type;
    return a.stream.read_as == ReadAs::integers &&
           (type == ComponentType::uint8 || type == ComponentType::uint16 || type == ComponentType::uint32);
  });
}

bool has_own_point_size(Kind kind) {
  constexpr std::array kKinds{Kind::point, Kind::clip, Kind::cull, Kind::viewport, Kind::layer, Kind::layer_geometry};
  return std::ranges::find(kKinds, kind) != kKinds.end();
}

const char* shared_glsl_of(const Drawing& d) {
  if (d.kind == Kind::viewport || d.kind == Kind::layer) return kViewportShared;
  if (d.kind == Kind::attributes) return has_unsigned_attribute(d) ? kUnsignedShared : kSignedShared;
  return kShared;
}

MesaDraw mesa_draw_of(const Drawing& d, std::size_t attachments) {
  const auto [vertex, fragment] = glsl_of(d, attachments);
  MesaDraw m{shared_glsl_of(d),
             vertex,
             fragment,
             [&d](const UniformSetter& set) {
               set("mode", static_cast<float>(d.mode));
               set("value", d.value);
               if (d.texture) set("image", *d.texture, d.sampler);
             },
             vertices_of(d),
             d.indices,
             d.state,
             d.restart,
             has_own_point_size(d.kind),
             d.kind == Kind::clip   ? 4
             : d.kind == Kind::cull ? 2
                                    : 0,
             d.kind == Kind::geometry         ? geometry_glsl_of(d.geometry, kGeometryBody)
             : d.kind == Kind::layer_geometry ? geometry_glsl_of(d.geometry, kLayerGeometryBody)
                                              : nullptr,
             d.kind == Kind::tessellation ? control_glsl_of(d.tessellation) : nullptr,
             d.kind == Kind::tessellation ? evaluation_glsl_of(d.tessellation) : nullptr,
             d.tessellation.patch_vertices,
             d.clear};
  for (uint32_t i = 0; d.indices.empty() && i < conformance::vertex_count(d); ++i) m.indices.push_back(i);
  return m;
}

// ---- comparison ----------------------------------------------------------------------------------------------------

struct Agreement {
  MesaPrograms programs;
  int64_t pictures = 0, covered = 0, differing = 0;
};

bool is_inside(const conformance::Vertex& v) {
  const glm::vec4& p = v.pos_clip;
  return std::fabs(p.x) <= p.w && std::fabs(p.y) <= p.w && std::fabs(p.z) <= p.w;
}

// Returns the reason why an image cannot be compared with Mesa, or null if it can.
const char* not_comparable(const conformance::Picture& p) {
  if (p.samples == 2 || p.samples == 8) return "llvmpipe supports only 1 or 4 samples";
  if (p.supersample) return "OpenGL has no supersampling";
  if (p.samples > 1 && p.layers > 1) return "multisampled layers are not resolved by a blit";
  for (const ColorFormat format : p.colors) {
    if (p.samples > 1 && is_integer(format)) return "OpenGL does not specify which sample of integers is resolved";
    const bool may_have_three = format == ColorFormat::rgb8 || texel_info(format).bits == 0;
    if (texel_info(format).channels == 3 && !may_have_three) return "OpenGL implementations need not draw into three channels";
  }
  for (const Drawing& d : p.draws) {
    const DrawState& s = d.state;
    const bool lines = is_lines(s.topology) || s.polygon_mode == PolygonMode::line;
    const bool in_perspective = std::any_of(d.vertices.begin(), d.vertices.end(), [](const auto& v) { return v.pos_clip.w != 1.0f; });
    if (std::ranges::any_of(s.attachments, [](const auto& own) { return own && own->blend; }))
      return "only one blend state for all attachments is compared";
    if (p.samples == 1 && is_smooth(s)) return "OpenGL leaves the areas of smooth primitives to the implementation";
    for (const std::optional<DrawCondition>& c : {s.condition, d.clear ? d.clear->condition : std::nullopt}) {
      if (c && std::ranges::count(p.draws, c->query, [](const Drawing& o) { return o.state.query.value_or(~0u); }) != 1)
        return "a query of OpenGL counts the draws of one scope";
    }
    if (s.alpha_to_coverage) return "OpenGL does not specify which samples an alpha value covers";
    if (p.samples > 1 && (s.sample_shading || d.mode == conformance::kCentroid))
      return "OpenGL does not specify the position at which a sample or centroid is shaded";
    if (lines && d.kind != Kind::geometry && !(d.kind == Kind::color && d.mode == conformance::kFlat))
      return "llvmpipe interpolates only along the major axis of a line";
    if (d.kind == Kind::point && p.samples > 1) return "with multisampling, llvmpipe's point coordinate is off by half a pixel";
    const bool derives = d.kind == Kind::derivative || (d.kind == Kind::texture && d.mode == conformance::kByDerivatives);
    if (derives && in_perspective) return "OpenGL does not specify which differences of a quad give a derivative";
    const bool turns_over = std::any_of(d.vertices.begin(), d.vertices.end(), [](const auto& v) { return v.pos_clip.w < 0.0f; });
    if (d.kind == Kind::color && d.mode == conformance::kLinear && turns_over)
      return "OpenGL does not define noperspective interpolation if w changes sign";
    if (s.stencil && s.polygon_mode != PolygonMode::fill) return "llvmpipe applies the front-face stencil state to outlines of back faces";
    if (d.texture && d.texture->format() != TexelFormat::rgba8 && d.texture->format() != TexelFormat::srgb8a8)
      return "only 8-bit RGBA textures can be uploaded";
    if (draws_points(s) && (d.kind == Kind::clip || d.kind == Kind::cull || !std::all_of(d.vertices.begin(), d.vertices.end(), is_inside)))
      return "Mesa clips points by their center";
    const auto has_scissor = [](const IndexedViewport& v) { return v.scissor.has_value(); };
    const bool has_scissors = s.viewports != nullptr && std::ranges::any_of(*s.viewports, has_scissor);
    if (p.samples > 1 && (s.scissor || has_scissors || (d.clear && d.clear->rect)))
      return "llvmpipe's scissor passes samples of pixels next to the rectangle";
  }
  return nullptr;
}

bool blends(const conformance::Picture& p) {
  return std::any_of(p.draws.begin(), p.draws.end(), [](const Drawing& d) { return d.state.blend.has_value(); });
}

float srgb_to_linear(float code) { return kSrgbToLinear[static_cast<std::size_t>(std::lround(code * 255.0f))]; }

// Returns the allowed difference of a channel.
double tolerance(const conformance::Picture& p, ColorFormat format, int channel, double value) {
  constexpr double kCode = 1.01 / 255.0;
  const double size = std::max(1.0, std::fabs(value));
  const bool textured = std::any_of(p.draws.begin(), p.draws.end(), [](const Drawing& d) { return d.texture != nullptr; });
  if (textured) return 2.0 * kCode * size;  // llvmpipe's log2 has an error of 0.04, its sRGB conversion one of 0.001
  if (format == ColorFormat::rgba16f || format == ColorFormat::rgba32f) return 0x1p-10 * size;
  // Mesa blends 8-bit colors in integers and rounds each product; VK-GL-CTS allows a difference of 3/255.
  const double codes = blends(p) ? 3.0 : 1.0;
  return format == ColorFormat::srgb8a8 ? codes * kCode : codes * texel_tolerance(format, channel, value);
}

// The texels of a pixel in all attachments.
using Texels = std::vector<glm::dvec4>;

Texels texels_at(const conformance::Seen& seen, int x, int y, int layer) {
  Texels texels;
  for (std::size_t a = 0; a < seen.formats.size(); ++a) {
    const glm::dvec4 real(is_integer(seen.formats[a]) ? glm::vec4(0.0f) : seen.color(x, y, a, layer));
    switch (color_type(seen.formats[a])) {
      case ColorType::real: texels.push_back(real); break;
      case ColorType::signed_integer: texels.emplace_back(seen.integers(x, y, a)); break;
      case ColorType::unsigned_integer: texels.emplace_back(glm::uvec4(seen.integers(x, y, a))); break;
    }
  }
  return texels;
}

bool are_near(const conformance::Picture& p, const Texels& ours, const Texels& mesa) {
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const ColorFormat format = p.colors[i];
    const bool in_light = format == ColorFormat::srgb8a8 && blends(p);  // llvmpipe decodes the destination less accurately
    for (int k = 0; k < 4; ++k) {
      if (k >= texel_info(format).channels) {
        if (ours[i][k] != mesa[i][k]) return false;  // 0 or 1
        continue;
      }
      const double allowed = tolerance(p, format, k, ours[i][k]);
      if (std::fabs(ours[i][k] - mesa[i][k]) <= allowed) continue;
      const auto light = [&](const Texels& t) { return srgb_to_linear(static_cast<float>(t[i][k])); };
      if (!in_light || k == 3 || !(std::fabs(static_cast<double>(light(ours) - light(mesa))) <= allowed)) return false;
    }
  }
  return true;
}

void print_pixel(int x, int y, const Texels& ours, const Texels& mesa) {
  for (std::size_t i = 0; i < ours.size(); ++i) {
    std::printf("    (%d, %d), attachment %zu: Halfspace", x, y, i);
    for (int k = 0; k < 4; ++k) std::printf(" %g", ours[i][k]);
    std::printf("  Mesa");
    for (int k = 0; k < 4; ++k) std::printf(" %g", mesa[i][k]);
    std::printf("\n");
  }
}

// A pixel counts as covered if it differs from the clear color in either image.
int64_t compare_with_mesa(const conformance::Picture& p, const std::string& name, Agreement& sum) {
  TargetSpec target{p.width, p.height, p.colors[0], p.clear_color, p.clear_depth, p.depth, p.clear_stencil, p.samples};
  target.layers = p.layers;
  target.kind = p.kind;
  target.more_formats.assign(p.colors.begin() + 1, p.colors.end());
  std::vector<MesaDraw> draws;
  for (const Drawing& d : p.draws) draws.push_back(mesa_draw_of(d, p.colors.size()));
  const std::vector<Texels> mesa = colors_by_mesa(target, draws, sum.programs);
  const conformance::Seen seen = conformance::draw(p);
  conformance::Picture nothing = p;
  nothing.draws.clear();
  const Texels clear = texels_at(conformance::draw(nothing), 0, 0, 0);
  int64_t covered = 0, differing = 0;
  for (int row = 0; row < p.height * p.layers; ++row) {
    for (int x = 0; x < p.width; ++x) {
      const int y = row % p.height;
      const Texels a = texels_at(seen, x, y, row / p.height);
      Texels b;
      for (const Texels& attachment : mesa) b.push_back(attachment[static_cast<std::size_t>(row * p.width + x)]);
      covered += p.draws.empty() || !are_near(p, a, clear) || !are_near(p, b, clear);
      if (are_near(p, a, b)) continue;
      if (++differing <= 3 && std::getenv("HALFSPACE_MESA_PIXELS") != nullptr) print_pixel(x, y, a, b);
    }
  }
  if (differing > 0 && !name.empty())
    std::printf("  %s: %lld of %lld\n", name.c_str(), static_cast<long long>(differing), static_cast<long long>(covered));
  ++sum.pictures;
  sum.covered += covered;
  sum.differing += differing;
  return differing;
}

void expect_agreement(const Agreement& a) {
  std::printf("%lld images, %lld covered pixels, %lld differ\n", static_cast<long long>(a.pictures), static_cast<long long>(a.covered),
              static_cast<long long>(a.differing));
  testing::Test::RecordProperty("covered", std::to_string(a.covered));
  testing::Test::RecordProperty("differing", std::to_string(a.differing));
  EXPECT_GT(a.covered, 0);
  EXPECT_LE(a.differing * 1000, a.covered);
}

}  // namespace

class MesaConformance : public MesaTest, public testing::WithParamInterface<conformance::Group> {};

TEST_P(MesaConformance, AgreesOnTheGroup) {
  Agreement sum;
  const conformance::Cases cases = GetParam().cases();
  // llvmpipe compiles code for each state, which takes most of the time. Seven has no common factor with the numbers of factors and
  // equations, so all of them are among every seventh case.
  const std::size_t step = cases.size() > 150 && !runs_long_tests() ? 7 : 1;
  for (std::size_t i = 0; i < cases.size(); i += step) {
    const conformance::Picture picture = cases[i].picture();
    if (cases[i].not_by_mesa == nullptr && not_comparable(picture) == nullptr) compare_with_mesa(picture, cases[i].name, sum);
  }
  expect_agreement(sum);
}

INSTANTIATE_TEST_SUITE_P(Groups, MesaConformance, testing::ValuesIn(conformance::kGroups),
                         [](const auto& test) { return std::string(test.param.name); });

class MesaRandomStates : public MesaTest {
 protected:
  // Mip levels are random here, and llvmpipe's level of detail has an error of 0.04, which matters where the filter or level changes.
  static bool comparable(const conformance::Picture& p) {
    const bool filter_changes = std::any_of(p.draws.begin(), p.draws.end(), [](const Drawing& d) {
      const bool by_level = d.sampler.min == Filter::trilinear || (d.sampler.mag == Filter::nearest) != (d.sampler.min == Filter::nearest);
      return d.texture && by_level;
    });
    return !filter_changes && not_comparable(p) == nullptr;
  }
};

TEST_F(MesaRandomStates, Agree) {
  Agreement sum;
  const uint64_t count = runs_long_tests() ? 1000 : 400;
  for (uint64_t seed = 0; seed < count; ++seed) {
    const conformance::RandomState state{seed, 0};
    const conformance::Picture picture = conformance::random_picture(state);
    if (!comparable(picture) || compare_with_mesa(picture, state.text(), sum) < 12) continue;
    const auto differs = [](const conformance::Picture& p) {
      Agreement one;
      return comparable(p) && compare_with_mesa(p, "", one) >= 12;
    };
    std::printf("  shrunk: HALFSPACE_STATE=%s\n", conformance::shrink(state, differs).text().c_str());
  }
  expect_agreement(sum);
}

}  // namespace halfspace::test
