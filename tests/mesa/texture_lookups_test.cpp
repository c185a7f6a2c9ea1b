// SPDX-License-Identifier: Apache-2.0
//
// Texture lookups by Mesa: the cases of tests/conformance/texture_lookups.h, with the functions of GLSL at the same points.
//
// HALFSPACE_MESA_PIXELS=1 prints the answers that differ.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>

#include "conformance/texture_lookups.h"
#include "mesa/mesa_context.h"
#include "mesa/mesa_state.h"
#include "mesa/twin_frame.h"
#include "support/long_tests.h"

namespace halfspace::test {
namespace texture_lookups {
namespace {

using conformance::lookups::Answer;
using conformance::lookups::answers_in_double;
using conformance::lookups::answers_of_view;
using conformance::lookups::fill_with_noise;
using conformance::lookups::Function;
using conformance::lookups::LookupCase;
using conformance::lookups::LookupCases;
using conformance::lookups::Point;
using conformance::lookups::points_of;

// ---- GLSL ----------------------------------------------------------------------------------------------------------

// The points, as the words of Point in memory; one for each pixel of 8 x 8.
constexpr int kSide = 8;
static_assert(sizeof(Point) == 19 * sizeof(uint32_t));
constexpr const char* kPoints = R"(#version 450 core
    #extension GL_EXT_texture_shadow_lod : enable
    layout(std430, binding = 0) readonly buffer Points { uint words[]; };
    int base = 19 * (int(gl_FragCoord.x) + 8 * int(gl_FragCoord.y));
    float real(int k) { return uintBitsToFloat(words[base + k]); }
    int integer(int k) { return int(words[base + k]); }
    vec3 p = vec3(real(0), real(1), real(2));
    float layer = real(3);
    vec3 dx = vec3(real(4), real(5), real(6)), dy = vec3(real(7), real(8), real(9));
    float lod = real(10), reference = real(11), divisor = real(12);
    vec3 projected_dx = (dx - p / divisor * real(13)) / divisor, projected_dy = (dy - p / divisor * real(14)) / divisor;
    ivec3 texel = ivec3(integer(15), integer(16), integer(17));
    int level = integer(18);
    )";
constexpr const char* kVertex = R"(#version 450 core
    layout(location = 0) in vec4 position;
    void main() { gl_Position = position; })";

struct KindGlsl {
  const char *sampler, *axes, *coordinates, *shadow_coordinates, *projected, *texel, *size;
};
constexpr std::array<KindGlsl, 9> kKinds{{
    {"1D", ".x", "p.x", "vec3(p.x, 0.0, reference)", "vec2(p.x, divisor)", "texel.x, level", "ivec3(textureSize(image, level), 1, 1)"},
    {"2D", ".xy", "p.xy", "vec3(p.xy, reference)", "vec3(p.xy, divisor)", "texel.xy, level", "ivec3(textureSize(image, level), 1)"},
    {"2DRect", ".xy", "p.xy", "vec3(p.xy, reference)", "vec3(p.xy, divisor)", "texel.xy", "ivec3(textureSize(image), 1)"},
    {"3D", "", "p", "", "vec4(p, divisor)", "texel, level", "textureSize(image, level)"},
    {"1DArray", ".x", "vec2(p.x, layer)", "vec3(p.x, layer, reference)", "", "texel.xz, level", "ivec3(textureSize(image, level), 1).xzy"},
    {"2DArray", ".xy", "vec3(p.xy, layer)", "vec4(p.xy, layer, reference)", "", "texel, level", "textureSize(image, level)"},
    {"Cube", "", "p", "vec4(p, reference)", "", "", "ivec3(textureSize(image, level), 6)"},
    {"CubeArray", "", "vec4(p, layer)", "vec4(p, layer), reference", "", "", "textureSize(image, level) * ivec3(1, 1, 6)"},
    {"2DMS", "", "", "", "", "texel.xy, texel.z", ""},
}};

bool compares(Function f) { return f == Function::sample_compare || f == Function::sample_compare_level || f == Function::gather_compare; }

std::string call_of(const LookupCase& c) {
  const KindGlsl& kind = kKinds[static_cast<std::size_t>(c.kind)];
  const glm::ivec3& o = c.options.offset;
  const bool moved = o != glm::ivec3(0);
  const std::string name = moved ? "Offset(image, " : "(image, ";
  const std::string numbers[] = {std::to_string(o.x), std::to_string(o.y), std::to_string(o.z)};
  const int axes = detail::texture_axes(c.kind);
  const std::string offset = !moved      ? ""
                             : axes == 1 ? ", " + numbers[0]
                             : axes == 2 ? ", ivec2(" + numbers[0] + ", " + numbers[1] + ")"
                                         : ", ivec3(" + numbers[0] + ", " + numbers[1] + ", " + numbers[2] + ")";
  const std::string slopes = std::string(", dx") + kind.axes + ", dy" + kind.axes,
                    projected_slopes = std::string(", projected_dx") + kind.axes + ", projected_dy" + kind.axes;
  switch (c.function) {
    case Function::sample: return "textureGrad" + name + kind.coordinates + slopes + offset + ")";
    case Function::sample_level:
    case Function::sample_integers:
      return c.kind == TextureKind::rectangle ? "texture" + name + kind.coordinates + offset + ")"
                                              : "textureLod" + name + kind.coordinates + ", lod" + offset + ")";
    case Function::sample_projected: return "textureProjGrad" + name + kind.projected + projected_slopes + offset + ")";
    case Function::sample_compare: return "vec4(textureGrad" + name + kind.shadow_coordinates + slopes + offset + "), 0.0, 0.0, 0.0)";
    case Function::sample_compare_level: return "vec4(textureLod" + name + kind.shadow_coordinates + ", lod" + offset + "), 0.0, 0.0, 0.0)";
    case Function::gather: return "textureGather" + name + kind.coordinates + offset + ", " + std::to_string(c.component) + ")";
    case Function::gather_compare: return "textureGather" + name + kind.coordinates + ", reference" + offset + ")";
    case Function::fetch:
    case Function::fetch_integers: return std::string("texelFetch(image, ") + kind.texel + ")";
    case Function::size: return std::string("ivec4(") + kind.size + ", 0)";
    case Function::query_lod: break;
  }
  throw std::runtime_error("no GLSL for this function");
}

// 'i', 'u' or nothing before the names of types.
std::string prefix_of(const LookupCase& c) {
  const TexelKind kind = texel_info(c.format).kind;
  return kind == TexelKind::sints ? "i" : kind == TexelKind::uints ? "u" : "";
}
std::string source_of(const LookupCase& c) {
  const std::string prefix = prefix_of(c), output = c.function == Function::size ? "i" : prefix;
  return "uniform " + prefix + "sampler" + kKinds[static_cast<std::size_t>(c.kind)].sampler + (compares(c.function) ? "Shadow" : "") +
         " image;\n    out " + output + "vec4 answer;\n    void main() { answer = " + call_of(c) + "; }";
}

// ---- drawing -------------------------------------------------------------------------------------------------------

// Draws one pixel for each point.
class Renderer {
 public:
  Renderer() {
    for (std::size_t k = 0; k < 3; ++k) {
      constexpr std::array<GLenum, 3> formats{GL_RGBA32F, GL_RGBA32I, GL_RGBA32UI};
      glCreateTextures(GL_TEXTURE_2D, 1, &targets_[k]);
      glTextureStorage2D(targets_[k], 1, formats[k], kSide, kSide);
      glCreateFramebuffers(1, &framebuffers_[k]);
      glNamedFramebufferTexture(framebuffers_[k], GL_COLOR_ATTACHMENT0, targets_[k], 0);
    }
    glCreateBuffers(1, &buffer_);
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    glDisable(GL_FRAMEBUFFER_SRGB);
  }
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;
  ~Renderer() {
    glDeleteBuffers(1, &buffer_);
    glDeleteFramebuffers(3, framebuffers_.data());
    glDeleteTextures(3, targets_.data());
  }

  std::vector<glm::dvec4> answers(const LookupCase& c, const TwinTexture& texture, const std::vector<Point>& points) {
    glNamedBufferData(buffer_, static_cast<GLsizeiptr>(points.size() * sizeof(Point)), points.data(), GL_STATIC_DRAW);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer_);
    constexpr std::array<GLint, 6> swizzles{GL_RED, GL_GREEN, GL_BLUE, GL_ALPHA, GL_ZERO, GL_ONE};
    std::array<GLint, 4> swizzle{};
    for (std::size_t k = 0; k < 4; ++k) swizzle[k] = swizzles[static_cast<std::size_t>(c.swizzle[k])];
    glTextureParameteriv(texture.mesa(), GL_TEXTURE_SWIZZLE_RGBA, swizzle.data());
    glTextureParameteri(texture.mesa(), GL_TEXTURE_BASE_LEVEL, c.base_level);
    if (c.kind != TextureKind::rectangle) glTextureParameteri(texture.mesa(), GL_TEXTURE_MAX_LEVEL, c.max_level);

    const std::string prefix = c.function == Function::size ? "i" : prefix_of(c);
    const std::size_t target = prefix == "i" ? 1 : prefix == "u" ? 2 : 0;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[target]);
    draw(kPoints + source_of(c), c, texture);
    std::vector<glm::dvec4> answers(points.size());
    const auto read = [&](auto pixels, GLenum format, GLenum type) {
      glGetTextureImage(targets_[target], 0, format, type, static_cast<GLsizei>(pixels.size() * sizeof(pixels[0])), pixels.data());
      for (std::size_t i = 0; i < answers.size(); ++i) answers[i] = glm::dvec4(pixels[i]);
    };
    if (target == 0) read(std::vector<glm::vec4>(points.size()), GL_RGBA, GL_FLOAT);
    if (target == 1) read(std::vector<glm::ivec4>(points.size()), GL_RGBA_INTEGER, GL_INT);
    if (target == 2) read(std::vector<glm::uvec4>(points.size()), GL_RGBA_INTEGER, GL_UNSIGNED_INT);
    expect_no_error();
    return answers;
  }

 private:
  void draw(const std::string& source, const LookupCase& c, const TwinTexture& texture) {
    const MesaDraw draw{"",
                        kVertex,
                        sources_.insert(source).first->c_str(),
                        [&](const UniformSetter& set) { set("image", texture, c.sampler, compares(c.function)); },
                        make_vertex_view(stream(triangle_)),
                        {0, 1, 2},
                        {}};
    run(draw, TargetSpec{.width = kSide, .height = kSide}, programs_);
  }

  std::array<GLuint, 3> targets_{}, framebuffers_{};
  GLuint buffer_ = 0;
  MesaPrograms programs_;
  std::set<std::string> sources_;  // programs are found by the addresses of their sources
  std::vector<glm::vec4> triangle_{{-1.0f, -1.0f, 0.0f, 1.0f}, {3.0f, -1.0f, 0.0f, 1.0f}, {-1.0f, 3.0f, 0.0f, 1.0f}};
};

// ---- comparison ----------------------------------------------------------------------------------------------------

bool derives(Function f) { return f == Function::sample || f == Function::sample_projected || f == Function::sample_compare; }

// Returns the allowed difference of a channel whose texels are from `low` to `high`, and why.
double tolerance(const LookupCase& c, double low, double high) {
  const double range = high - low, magnitude = std::max(std::fabs(low), std::fabs(high));
  // Fractions of texels have 15 bits here and are floats in Mesa, for up to three axes; both filter in float.
  double allowed = 0x1p-14 * range + 0x1p-20 * magnitude;
  // llvmpipe multiplies the codes of normalized formats by a rounded factor, with an error of up to 2^-24 for 24 bits.
  const TexelKind kind = texel_info(c.format).kind;
  if (kind == TexelKind::unorm || kind == TexelKind::snorm || kind == TexelKind::depth) allowed += 0x1p-23;
  // The fourth texel at a corner of a cube is the mean of three, of magnitudes up to 4.
  if (c.function == Function::gather) allowed += 0x1p-20;
  // llvmpipe's log2 has an error of up to 0.04, which is the weight of the next level.
  if (derives(c.function)) allowed += 0.05 * range;
  // llvmpipe approximates the sRGB curve by a polynomial.
  if (texel_info(c.format).kind == TexelKind::srgb) allowed += 0.0012;
  return allowed;
}

// llvmpipe's depths of 24 bits are off by a unit in the last place of a float, so a reference that is equal to a texel may be less or
// greater there. A third of the references are equal to a texel, which is rarely one of those that are filtered.
int allowed_to_differ(const LookupCase& c) {
  return compares(c.function) && (c.format == TexelFormat::d24 || c.format == TexelFormat::d24s8) ? 6 : 0;
}

struct Agreement {
  int cases = 0, answers = 0, differing = 0, beyond = 0;
  double worst = 0.0;  // difference divided by the range of the texels
};

// The texture must have the same texels in both.
void compare_with_mesa(const LookupCase& c, TwinTexture& texture, Renderer& renderer, Agreement& sum) {
  const std::vector<Point> points = points_of(c, texture.ours());
  const std::vector<Answer> reference = answers_in_double(c, texture.ours(), points);
  const std::vector<glm::dvec4> ours = answers_of_view(c, texture.ours(), points), mesa = renderer.answers(c, texture, points);
  int differing = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    bool differs = false;
    for (int k = 0; k < 4; ++k) {
      const double low = reference[i].low[k], high = reference[i].high[k], difference = std::fabs(ours[i][k] - mesa[i][k]);
      if (high > low) sum.worst = std::max(sum.worst, difference / (high - low));
      if (difference <= tolerance(c, low, high)) continue;
      differs = true;
      if (std::getenv("HALFSPACE_MESA_PIXELS") != nullptr)
        std::printf("    %s, point %zu, channel %d: Halfspace %.7g, Mesa %.7g, reference %.7g (%.7g to %.7g)\n", c.name.c_str(), i, k,
                    ours[i][k], mesa[i][k], reference[i].value[k], low, high);
    }
    differing += differs;
  }
  ++sum.cases;
  sum.answers += static_cast<int>(points.size());
  sum.differing += differing;
  if (differing <= allowed_to_differ(c)) return;
  sum.beyond += differing;
  std::printf("  %s: %d of %zu differ\n", c.name.c_str(), differing, points.size());
}
void compare_with_mesa(const LookupCase& c, Renderer& renderer, Agreement& sum) {
  TwinTexture texture(c.kind, c.format, c.size, c.levels);
  fill_with_noise(texture.ours());
  texture.upload();
  compare_with_mesa(c, texture, renderer, sum);
}

void expect_agreement(const Agreement& sum) {
  std::printf("%d cases, %d answers, %d differ; the largest difference is %.2g of the range of the texels\n", sum.cases, sum.answers,
              sum.differing, sum.worst);
  EXPECT_GT(sum.cases, 0);
  EXPECT_EQ(sum.beyond, 0);
}

struct Group {
  const char* name;
  LookupCases (*cases)();
  std::size_t step;  // of runs that are not long: llvmpipe compiles code for each state, which takes most of the time
};
LookupCases formats() {
  LookupCases cases = conformance::lookups::format_cases();
  if (runs_long_tests()) return cases;
  const auto same = [](const LookupCase& a, const LookupCase& b) { return a.format == b.format; };
  cases.erase(std::unique(cases.begin(), cases.end(), same), cases.end());  // the first of each format
  return cases;
}
LookupCases random_cases() {
  LookupCases cases;
  for (unsigned seed = 0; seed < (runs_long_tests() ? 2000u : 30u); ++seed) cases.push_back(conformance::lookups::random_case(seed));
  return cases;
}
constexpr Group kGroups[] = {{"Formats", formats, 1},
                             {"Kinds", conformance::lookups::kind_cases, 4},
                             {"Wrap", conformance::lookups::wrap_cases, 17},
                             {"Shadow", conformance::lookups::shadow_cases, 13},
                             {"Gather", conformance::lookups::gather_cases, 17},
                             {"Functions", conformance::lookups::function_cases, 11},
                             {"Swizzle", conformance::lookups::swizzle_cases, 13},
                             {"Levels", conformance::lookups::level_cases, 17},
                             {"Random", random_cases, 1}};

void PrintTo(const Group& g, std::ostream* os) { *os << g.name; }

class MesaTextureLookups : public MesaTest, public testing::WithParamInterface<Group> {};

TEST_P(MesaTextureLookups, Agree) {
  Agreement sum;
  {
    Renderer renderer;
    const LookupCases cases = GetParam().cases();
    for (std::size_t i = 0; i < cases.size(); i += runs_long_tests() ? 1 : GetParam().step) {
      if (cases[i].not_by_mesa == nullptr) compare_with_mesa(cases[i], renderer, sum);
    }
  }
  expect_agreement(sum);
}

INSTANTIATE_TEST_SUITE_P(Groups, MesaTextureLookups, testing::ValuesIn(kGroups),
                         [](const auto& test) { return std::string(test.param.name); });

class MesaMultisampleTexture : public MesaTest {};

TEST_F(MesaMultisampleTexture, SamplesAgree) {
  Agreement sum;
  {
    Renderer renderer;
    for (const LookupCase& c : conformance::lookups::multisample_cases()) {
      if (c.size.depth != 4) continue;  // the number of samples of llvmpipe
      switch (c.format) {
        case TexelFormat::rgba8:
        case TexelFormat::rg16:
        case TexelFormat::rgb10_a2:
        case TexelFormat::r11f_g11f_b10f:
        case TexelFormat::rgba16f:
        case TexelFormat::rg32f:
        case TexelFormat::rgba8i:
        case TexelFormat::r32ui: break;
        default: continue;
      }
      TwinTexture layers(TextureKind::two_d_array, c.format, c.size), samples(c.kind, c.format, c.size);
      fill_with_noise(layers.ours());
      layers.upload();
      samples.copy_samples(layers);
      compare_with_mesa(c, samples, renderer, sum);
    }
  }
  expect_agreement(sum);
}

}  // namespace
}  // namespace texture_lookups
}  // namespace halfspace::test
