// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <random>

#include "conformance/texture_lookups.h"

namespace halfspace::conformance::lookups {

namespace {

using enum TextureKind;

constexpr const char* kKindNames[] = {"1d", "2d", "rectangle", "3d", "1d_array", "2d_array", "cube", "cube_array", "multisample"};
constexpr const char* kFilterNames[] = {
    "nearest", "linear", "linear_mipmap_linear", "nearest_mipmap_nearest", "linear_mipmap_nearest", "nearest_mipmap_linear"};
constexpr const char* kWrapNames[] = {"repeat", "mirror", "clamp", "border", "mirror_clamp"};
constexpr const char* kCompareNames[] = {"never", "less", "equal", "less_or_equal", "greater", "not_equal", "greater_or_equal", "always"};
constexpr TextureKind kFiltered[] = {one_d, two_d, rectangle, three_d, one_d_array, two_d_array, cube, cube_array};

std::string name_of(TextureKind kind) { return kKindNames[static_cast<std::size_t>(kind)]; }
std::string name_of(Filter filter) { return kFilterNames[static_cast<std::size_t>(filter)]; }
std::string name_of(TexelFormat format) { return std::string(texel_info(format).name); }

/// A size that is a power of two along every axis, or along none. Cubes of an array and layers: two and three.
TextureSize size_of(TextureKind kind, bool power_of_two) {
  const int w = power_of_two ? 16 : 13, h = power_of_two ? 8 : 9, n = power_of_two ? 8 : 6;
  switch (kind) {
    case one_d: return {w, 1, 1};
    case one_d_array: return {w, 1, 3};
    case two_d_array: return {w, h, 3};
    case three_d: return {w, h, n};
    case cube: return {n, n, 6};
    case cube_array: return {n, n, 12};
    default: return {w, h, 1};
  }
}

/// A case with all levels that the kind has.
LookupCase case_of(TextureKind kind, TexelFormat format, Function function, bool power_of_two, const std::string& name) {
  LookupCase c;
  c.name = name;
  c.kind = kind;
  c.format = format;
  c.size = size_of(kind, power_of_two);
  c.levels = kind == rectangle ? 1 : full_levels(kind, c.size);
  c.function = function;
  return c;
}

std::vector<TexelFormat> all_formats() {
  std::vector<TexelFormat> formats;
  for (std::size_t f = 1; f < kTexelFormats; ++f) formats.push_back(static_cast<TexelFormat>(f));
  return formats;
}

bool has_mipmaps(TextureKind kind) { return kind != rectangle; }

/// Integer formats are not filtered.
void use_no_filter(LookupCase& c) {
  c.sampler.mag = Filter::nearest;
  c.sampler.min = has_mipmaps(c.kind) ? Filter::nearest_mipmap_nearest : Filter::nearest;
}

constexpr const char* kMagnifies = "llvmpipe magnifies up to a level of detail of 0, not 1/2, if only magnification is linear";
constexpr const char* kRectangleLevel = "llvmpipe multiplies the derivatives of rectangle coordinates by the size of the texture";
constexpr const char* kNoRectangleLevel = "GLSL has no lookup at a given level for rectangles, whose level selects the filter";
constexpr const char* kSizeOfOneLevel = "llvmpipe returns the size of one level for several pixels";
constexpr const char* kTwoLevels = "GLSL has no function with both derivatives and a bias";
constexpr const char* kQuery = "GLSL derives the level from the differences between pixels";
constexpr const char* kNoFetch = "GLSL has no texelFetch for cubes";
constexpr const char* kNoLevel = "GLSL has no comparison at a given level for this kind";

/// Whether OpenGL magnifies up to a level of detail of 1/2 (section 8.15).
bool magnifies_longer(const Sampler& s) {
  return s.mag != Filter::nearest && (s.min == Filter::nearest_mipmap_nearest || s.min == Filter::nearest_mipmap_linear);
}

}  // namespace

LookupCases format_cases() {
  LookupCases cases;
  for (const TexelFormat format : all_formats()) {
    for (const TextureKind kind : {two_d, two_d_array, three_d, cube}) {
      if (is_depth(format) && kind == three_d) continue;  // as in OpenGL
      const bool power_of_two = static_cast<int>(format) % 2 == 0;
      const Function function = is_integer(format) ? Function::sample_integers : Function::sample_level;
      LookupCase c = case_of(kind, format, function, power_of_two, name_of(format) + "_" + name_of(kind));
      if (is_integer(format)) use_no_filter(c);
      cases.push_back(c);
    }
  }
  return cases;
}

LookupCases kind_cases() {
  LookupCases cases;
  for (const TextureKind kind : kFiltered) {
    for (int min = 0; min < (has_mipmaps(kind) ? 6 : 2); ++min) {
      for (int mag = 0; mag < 2; ++mag) {
        for (const bool power_of_two : {false, true}) {
          const Filter mag_filter = static_cast<Filter>(mag), min_filter = static_cast<Filter>(min);
          LookupCase c = case_of(kind, TexelFormat::rgba16f, Function::sample, power_of_two,
                                 name_of(kind) + "_" + name_of(min_filter) + "_" + name_of(mag_filter) + (power_of_two ? "_pot" : "_npot"));
          c.sampler.mag = mag_filter;
          c.sampler.min = min_filter;
          if (kind == rectangle) c.sampler.wrap_s = c.sampler.wrap_t = Wrap::clamp;
          if (magnifies_longer(c.sampler)) c.not_by_mesa = kMagnifies;
          if (kind == rectangle && mag != min) c.not_by_mesa = kRectangleLevel;
          cases.push_back(c);
        }
      }
    }
  }
  return cases;
}

LookupCases wrap_cases() {
  LookupCases cases;
  const auto add = [&](TextureKind kind, int s, int t, int r, int filter, bool power_of_two) {
    const Filter f = static_cast<Filter>(filter);
    std::string name = name_of(kind) + "_" + kWrapNames[s];
    if (detail::texture_axes(kind) > 1) name += std::string("_") + kWrapNames[t];
    if (kind == three_d) name += std::string("_") + kWrapNames[r];
    LookupCase c = case_of(kind, TexelFormat::rgba32f, Function::sample_level, power_of_two,
                           name + "_" + name_of(f) + (power_of_two ? "_pot" : "_npot"));
    c.sampler = {.mag = f,
                 .min = f,
                 .wrap_s = static_cast<Wrap>(s),
                 .wrap_t = static_cast<Wrap>(t),
                 .border_color = {0.5f, -1.5f, 2.0f, 0.25f},
                 .wrap_r = static_cast<Wrap>(r)};
    cases.push_back(c);
  };
  for (int filter = 0; filter < 2; ++filter) {
    for (int s = 0; s < 5; ++s) {
      for (const bool power_of_two : {false, true}) {
        for (const TextureKind kind : {one_d, one_d_array}) add(kind, s, 0, 0, filter, power_of_two);
        for (int t = 0; t < 5; ++t) add(two_d, s, t, 0, filter, power_of_two);
        for (int r = 0; r < 5; ++r) add(three_d, s, (s + r) % 5, r, filter, power_of_two);
        add(two_d_array, s, (s + 2) % 5, 0, filter, power_of_two);
      }
    }
    for (int s = 2; s < 4; ++s) {  // rectangles only clamp to the edge or to the border
      for (int t = 2; t < 4; ++t) add(rectangle, s, t, 0, filter, false);
    }
  }
  return cases;
}

LookupCases shadow_cases() {
  constexpr TexelFormat formats[] = {TexelFormat::d16, TexelFormat::d24, TexelFormat::d32f, TexelFormat::d24s8, TexelFormat::d32fs8};
  LookupCases cases;
  for (const TextureKind kind : {one_d, two_d, rectangle, one_d_array, two_d_array, cube, cube_array}) {
    for (int min = 0; min < (has_mipmaps(kind) ? 6 : 2); ++min) {
      for (int op = 0; op < 8; ++op) {
        const TexelFormat format = formats[cases.size() % 5];
        const Filter filter = static_cast<Filter>(min);
        // Explicit gradients select the level, except for the kinds whose GLSL functions do not have them.
        LookupCase c = case_of(kind, format, kind == cube_array ? Function::sample_compare_level : Function::sample_compare, op % 2 == 0,
                               name_of(kind) + "_" + name_of(filter) + "_" + kCompareNames[op] + "_" + name_of(format));
        c.sampler.min = filter;
        c.sampler.mag = min % 2 == 0 ? Filter::nearest : Filter::bilinear;
        c.sampler.compare = static_cast<CompareOp>(op);
        c.sampler.wrap_s = c.sampler.wrap_t = op % 3 == 0 ? Wrap::border : Wrap::clamp;
        c.sampler.border_color = glm::vec4(0.375f);
        if (magnifies_longer(c.sampler)) c.not_by_mesa = kMagnifies;
        if (kind == cube_array) c.not_by_mesa = kNoLevel;
        cases.push_back(c);
      }
    }
  }
  return cases;
}

LookupCases gather_cases() {
  constexpr glm::ivec3 offsets[] = {{0, 0, 0}, {-8, 7, 0}, {3, -2, 0}};
  LookupCases cases;
  const auto add = [&](TextureKind kind, bool power_of_two, bool compares, int component, const glm::ivec3& offset,
                       const std::string& what) {
    LookupCase c = case_of(kind, compares ? TexelFormat::d32f : TexelFormat::rgba8, compares ? Function::gather_compare : Function::gather,
                           power_of_two, name_of(kind) + what + (power_of_two ? "_pot" : "_npot"));
    const auto wrap = [&](std::size_t k) { return kind == rectangle ? Wrap::clamp : static_cast<Wrap>((cases.size() + k) % 5); };
    c.sampler.min = Filter::bilinear;
    c.sampler.wrap_s = wrap(0);
    c.sampler.wrap_t = wrap(2);
    c.sampler.border_color = {0.25f, 0.75f, 0.5f, 0.125f};
    c.sampler.compare = component % 2 == 0 ? CompareOp::less : CompareOp::greater;
    c.component = compares ? 0 : component;
    c.options.offset = offset;
    cases.push_back(c);
  };
  for (const TextureKind kind : {two_d, rectangle, two_d_array, cube, cube_array}) {
    for (const bool power_of_two : {false, true}) {
      for (std::size_t o = 0; o < (is_cube(kind) ? 1u : 3u); ++o) {
        const std::string with_offset = o == 0 ? "" : "_offset_" + std::to_string(o);
        for (int k = 0; k < 4; ++k) add(kind, power_of_two, false, k, offsets[o], "_component_" + std::to_string(k) + with_offset);
        for (int k = 0; k < 2; ++k) add(kind, power_of_two, true, k, offsets[o], (k == 0 ? "_less" : "_greater") + with_offset);
      }
    }
    for (int turn = 0; turn < 6; ++turn) {
      add(kind, true, false, turn % 4, glm::ivec3(0), "_swizzle_" + std::to_string(turn));
      for (std::size_t k = 0; k < 4; ++k) cases.back().swizzle[k] = static_cast<Swizzle>((k + static_cast<std::size_t>(turn)) % 6);
    }
    for (int level = 1; level < 3 && kind != rectangle; ++level) {
      add(kind, true, false, level, glm::ivec3(0), "_base_level_" + std::to_string(level));
      cases.back().base_level = level;
    }
  }
  return cases;
}

LookupCases function_cases() {
  LookupCases cases;
  constexpr glm::ivec3 kOffset(-3, 2, 5);
  const auto add = [&](TextureKind kind, Function function, TexelFormat format, const char* what) -> LookupCase& {
    cases.push_back(case_of(kind, format, function, false, std::string(what) + "_" + name_of(kind) + "_" + name_of(format)));
    LookupCase& c = cases.back();
    if (kind == rectangle) {
      c.sampler.min = Filter::bilinear;
      c.sampler.wrap_s = c.sampler.wrap_t = Wrap::clamp;
    }
    if (is_integer(format)) use_no_filter(c);
    return c;
  };
  for (const TextureKind kind : kFiltered) {
    const bool offsets = !is_cube(kind), projects = offsets && !is_array(kind);
    for (const TexelFormat format : {TexelFormat::rgba8, TexelFormat::r32f}) {
      add(kind, Function::sample, format, "texturegrad");
      if (offsets) add(kind, Function::sample, format, "texturegradoffset").options.offset = kOffset;
      if (has_mipmaps(kind)) {
        add(kind, Function::sample_level, format, "texturelod");
        if (offsets) add(kind, Function::sample_level, format, "texturelodoffset").options.offset = kOffset;
        LookupCase& biased = add(kind, Function::sample, format, "texture_bias");
        biased.options.bias = 0.75f;
        biased.not_by_mesa = kTwoLevels;
      }
      if (projects) {
        add(kind, Function::sample_projected, format, "textureproj");
        add(kind, Function::sample_projected, format, "textureprojoffset").options.offset = kOffset;
      }
    }
    for (const TexelFormat format : {TexelFormat::rgba8i, TexelFormat::rg16ui, TexelFormat::r32i, TexelFormat::rgb10_a2ui}) {
      add(kind, Function::sample_integers, format, "texturelod");
      if (offsets) add(kind, Function::sample_integers, format, "texturelodoffset").options.offset = kOffset;
    }
    if (kind != cube && kind != cube_array) {
      for (const TexelFormat format : {TexelFormat::rgb8, TexelFormat::rg32f}) add(kind, Function::fetch, format, "texelfetch");
      for (const TexelFormat format : {TexelFormat::rgba16i, TexelFormat::rg32ui})
        add(kind, Function::fetch_integers, format, "texelfetch");
    }
    add(kind, Function::size, TexelFormat::rgba8, "texturesize").not_by_mesa = has_mipmaps(kind) ? kSizeOfOneLevel : nullptr;
    if (kind == rectangle) continue;
    for (int min = 0; min < 6; ++min) {
      LookupCase& query =
          add(kind, Function::query_lod, TexelFormat::rgba8, ("texturequerylod_" + name_of(static_cast<Filter>(min))).c_str());
      query.sampler.min = static_cast<Filter>(min);
      query.sampler.lod = {.bias = 0.25f, .min = 0.75f, .max = 2.25f};
      query.not_by_mesa = kQuery;
    }
  }
  return cases;
}

LookupCases swizzle_cases() {
  using enum Swizzle;
  constexpr Swizzle all[] = {red, green, blue, alpha, zero, one};
  constexpr const char* names[] = {"red", "green", "blue", "alpha", "zero", "one"};
  LookupCases cases;
  const auto add = [&](TexelFormat format, const std::string& name, const std::array<Swizzle, 4>& swizzle) {
    LookupCase c = case_of(two_d, format, is_integer(format) ? Function::sample_integers : Function::sample_level, true, name);
    if (is_integer(format)) use_no_filter(c);
    c.swizzle = swizzle;
    cases.push_back(c);
  };
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t s = 0; s < 6; ++s) {
      std::array<Swizzle, 4> swizzle{red, green, blue, alpha};
      if (swizzle[k] == all[s]) continue;
      swizzle[k] = all[s];
      add(TexelFormat::rgba8, std::string(1, "rgba"[k]) + "_" + names[s], swizzle);
    }
  }
  for (const TexelFormat format : {TexelFormat::r8, TexelFormat::rg8, TexelFormat::rgb8, TexelFormat::srgb8a8, TexelFormat::d24,
                                   TexelFormat::rgba8i, TexelFormat::r16ui}) {
    const std::string name = name_of(format);
    for (std::size_t s = 0; s < 6; ++s) add(format, name + "_all_" + names[s], {all[s], all[s], all[s], all[s]});
    add(format, name + "_bgra", {blue, green, red, alpha});
    add(format, name + "_abgr", {alpha, blue, green, red});
    add(format, name + "_one_one_red_green", {one, one, red, green});
  }
  for (std::size_t s = 0; s < 6; ++s) {  // the swizzle also applies to the result of a comparison
    add(TexelFormat::d32f, std::string("shadow_") + names[s], {all[s], all[s], all[s], all[s]});
    cases.back().function = Function::sample_compare_level;
    add(TexelFormat::d32f, std::string("gather_shadow_") + names[s], {all[s], all[s], all[s], all[s]});
    cases.back().function = Function::gather_compare;
  }
  return cases;
}

LookupCases level_cases() {
  LookupCases cases;
  for (const TextureKind kind : {one_d, two_d, three_d, one_d_array, two_d_array, cube, cube_array}) {
    for (const Filter min :
         {Filter::nearest_mipmap_nearest, Filter::bilinear_mipmap_nearest, Filter::nearest_mipmap_linear, Filter::trilinear}) {
      const auto add = [&](const char* what) -> LookupCase& {
        cases.push_back(
            case_of(kind, TexelFormat::rgba8, Function::sample, cases.size() % 2 == 0, name_of(kind) + "_" + what + "_" + name_of(min)));
        cases.back().sampler.min = min;
        cases.back().sampler.mag = reads_nearest_texel(min) || cases.size() % 3 == 0 ? Filter::nearest : Filter::bilinear;
        return cases.back();
      };
      add("bias").sampler.lod.bias = 0.75f;
      add("negative_bias").sampler.lod.bias = -1.25f;
      add("min_lod").sampler.lod.min = 1.25f;
      add("max_lod").sampler.lod.max = 0.75f;
      add("base_level").base_level = 1;
      add("max_level").max_level = 1;
      LookupCase& all = add("all_limits");
      all.base_level = 1;
      all.max_level = 2;
      all.sampler.lod = {.bias = 0.5f, .min = 0.25f, .max = 0.8125f};
    }
  }
  return cases;
}

LookupCases multisample_cases() {
  LookupCases cases;
  for (const TexelFormat format : all_formats()) {
    for (const int samples : {2, 4, 8}) {
      LookupCase c;
      c.name = name_of(format) + "_samples_" + std::to_string(samples);
      c.kind = multisample;
      c.format = format;
      c.size = {7, 5, samples};
      c.function = is_integer(format) ? Function::fetch_integers : Function::fetch;
      cases.push_back(c);
    }
  }
  return cases;
}

namespace {

std::vector<Function> functions_of(const LookupCase& c) {
  const bool layers_of_two = c.kind != one_d && c.kind != one_d_array && c.kind != three_d;
  std::vector<Function> functions;
  if (is_integer(c.format)) {
    functions = {Function::sample_integers, Function::fetch_integers};
  } else if (is_depth(c.format)) {
    functions = {Function::sample_compare, Function::sample_compare_level, Function::sample_level, Function::fetch};
    if (layers_of_two) functions.push_back(Function::gather_compare);
  } else {
    functions = {Function::sample, Function::sample_level, Function::query_lod, Function::fetch};
    if (layers_of_two) functions.push_back(Function::gather);
    if (!is_array(c.kind) && !is_cube(c.kind)) functions.push_back(Function::sample_projected);
  }
  return functions;
}

const char* not_by_mesa(const LookupCase& c) {
  const bool derives = c.function == Function::sample || c.function == Function::sample_projected || c.function == Function::sample_compare;
  const bool has_level = c.kind == one_d || c.kind == two_d;
  if (c.function == Function::query_lod) return kQuery;
  if (c.options.bias != 0.0f) return kTwoLevels;
  if (magnifies_longer(c.sampler)) return kMagnifies;
  if (c.kind == rectangle && c.sampler.mag != c.sampler.min) return derives ? kRectangleLevel : kNoRectangleLevel;
  if ((c.function == Function::sample_compare_level && !has_level) || (c.function == Function::sample_compare && c.kind == cube_array))
    return kNoLevel;
  return is_cube(c.kind) && (c.function == Function::fetch || c.function == Function::fetch_integers) ? kNoFetch : nullptr;
}

}  // namespace

LookupCase random_case(unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
  LookupCase c;
  c.name = "random_" + std::to_string(seed);
  c.kind = kFiltered[below(8)];
  do {
    c.format = static_cast<TexelFormat>(1 + below(static_cast<int>(kTexelFormats) - 1));
  } while (is_depth(c.format) && c.kind == three_d);
  const int w = 1 + below(17), h = 1 + below(17), d = 1 + below(9);
  switch (c.kind) {
    case one_d: c.size = {w, 1, 1}; break;
    case one_d_array: c.size = {w, 1, d}; break;
    case cube: c.size = {w, w, 6}; break;
    case cube_array: c.size = {w, w, 6 * (1 + d % 3)}; break;
    case three_d:
    case two_d_array: c.size = {w, h, d}; break;
    default: c.size = {w, h, 1};
  }
  if (has_mipmaps(c.kind)) c.levels = 1 + below(full_levels(c.kind, c.size));
  c.base_level = below(c.levels);
  c.max_level = c.base_level + below(4);
  const std::vector<Function> functions = functions_of(c);
  c.function = functions[static_cast<std::size_t>(below(static_cast<int>(functions.size())))];
  const auto wrap = [&] { return static_cast<Wrap>(c.kind == rectangle ? 2 + below(2) : below(5)); };
  const auto number = [&] { return static_cast<float>(below(49) - 24) / 16.0f; };
  c.sampler = {.mag = static_cast<Filter>(below(2)),
               .min = static_cast<Filter>(below(has_mipmaps(c.kind) ? 6 : 2)),
               .wrap_s = wrap(),
               .wrap_t = wrap(),
               .wrap_r = wrap(),
               .compare = static_cast<CompareOp>(below(8))};
  if (is_integer(c.format)) use_no_filter(c);
  for (int k = 0; k < 4; ++k) c.sampler.border_color[k] = is_integer(c.format) ? 0.0f : number();
  if (has_mipmaps(c.kind) && below(2) == 0) {
    c.sampler.lod.bias = static_cast<float>(below(9) - 4) / 4.0f;
    c.sampler.lod.min = static_cast<float>(2 * below(16) - 7) / 16.0f;
    c.sampler.lod.max = c.sampler.lod.min + static_cast<float>(below(32)) / 8.0f;
  }
  if (!is_cube(c.kind) && below(2) == 0) c.options.offset = {below(16) - 8, below(16) - 8, below(16) - 8};
  if ((c.function == Function::sample || c.function == Function::sample_compare) && below(4) == 0)
    c.options.bias = static_cast<float>(below(9) - 4) / 4.0f;
  if (c.function == Function::gather) c.component = below(4);
  if (below(2) == 0) {
    for (Swizzle& s : c.swizzle) s = static_cast<Swizzle>(below(6));
  }
  c.not_by_mesa = not_by_mesa(c);
  return c;
}

}  // namespace halfspace::conformance::lookups
