// SPDX-License-Identifier: Apache-2.0
//
// The cases of FramebufferBlit: conversions, rectangles with both filters, depth and stencil, and resolves.
#include <random>

#include "conformance/blits.h"

namespace halfspace::conformance::blits {

namespace {

std::string format_name(TexelFormat f) { return std::string(texel_info(f).name); }

template <class F>
void for_formats(F f) {
  for (std::size_t k = 1; k < kTexelFormats; ++k) f(static_cast<TexelFormat>(k));
}
bool is_color(TexelFormat f) { return !is_depth(f) && !is_integer(f); }

/// Every format to every other one, scaled and mirrored.
void add_conversions(BlitCases& cases) {
  for_formats([&](TexelFormat from) {
    for_formats([&](TexelFormat to) {
      if (is_depth(from) || is_depth(to) || color_type(from) != color_type(to)) return;
      BlitCase c{"convert_" + format_name(from) + "_to_" + format_name(to), from, to, {11, 7}, {13, 9}, {11, 0, -11, 7}, {0, 0, 13, 9}};
      cases.push_back(c);
    });
  });
}

/// Every format that can be filtered, enlarged.
void add_filtered_formats(BlitCases& cases) {
  for_formats([&](TexelFormat f) {
    if (!is_color(f)) return;
    BlitCase c{"linear_" + format_name(f), f, f, {11, 7}, {29, 17}, {0, 0, 11, 7}, {0, 0, 29, 17}};
    c.filter = BlitFilter::linear;
    cases.push_back(c);
  });
}

struct NamedRects {
  const char* name;
  Rect from, to;
  const char* not_by_mesa = nullptr;
};
/// Mirrors one or both rectangles, which exchanges their corners.
Rect mirrored(const Rect& r, bool x, bool y) {
  return {x ? r.x + r.width : r.x, y ? r.y + r.height : r.y, x ? -r.width : r.width, y ? -r.height : r.height};
}
constexpr struct {
  const char* name;
  bool from_x, from_y, to_x, to_y;
} kFlips[] = {{"", false, false, false, false},
              {"_source_x", true, false, false, false},
              {"_source_y", false, true, false, false},
              {"_destination_x", false, false, true, false},
              {"_destination_xy", false, false, true, true},
              {"_both_x", true, false, true, false}};
constexpr struct {
  const char* name;
  BlitFilter filter;
} kFilters[] = {{"nearest", BlitFilter::nearest}, {"linear", BlitFilter::linear}};

void add_rects(BlitCases& cases, const std::string& group, const NamedRects& r, bool outside = false) {
  for (const auto& flip : kFlips) {
    for (const auto& filter : kFilters) {
      BlitCase c{group + "_" + filter.name + "_" + r.name + flip.name};
      c.from_rect = mirrored(r.from, flip.from_x, flip.from_y);
      c.to_rect = mirrored(r.to, flip.to_x, flip.to_y);
      c.filter = filter.filter;
      c.outside = outside;
      c.not_by_mesa = r.not_by_mesa;
      cases.push_back(c);
    }
  }
}

/// Rectangles of a source of 24 x 16 and a destination of 32 x 20 texels.
void add_rectangles(BlitCases& cases) {
  constexpr NamedRects inside[] = {{"copy", {3, 2, 17, 11}, {9, 5, 17, 11}},       {"all", {0, 0, 24, 16}, {0, 0, 32, 20}},
                                   {"twice", {4, 3, 12, 8}, {2, 1, 24, 16}},       {"half", {0, 0, 24, 16}, {11, 7, 12, 8}},
                                   {"part_twice", {7, 5, 9, 6}, {5, 4, 18, 12}},   {"narrower", {2, 1, 19, 13}, {6, 3, 7, 13}},
                                   {"lower", {2, 1, 19, 13}, {6, 3, 19, 5}},       {"one_texel", {5, 6, 1, 1}, {3, 4, 21, 13}},
                                   {"to_one_texel", {1, 2, 21, 11}, {14, 9, 1, 1}}};
  for (const NamedRects& r : inside) add_rects(cases, "rect", r);
  constexpr NamedRects partly[] = {
      {"source", {-5, -3, 24, 16}, {2, 1, 24, 16}},
      {"source_scaled", {-6, 4, 40, 30}, {1, 1, 29, 17}},
      {"destination", {0, 0, 24, 16}, {17, -9, 24, 16}},
      {"destination_scaled", {2, 2, 20, 12}, {-13, 8, 50, 36}},
      {"both", {-7, 5, 24, 16}, {-4, 9, 24, 16}},
      {"both_scaled", {16, -4, 14, 16}, {8, -6, 28, 28}, "llvmpipe rounds the sides of rectangles that are cut to whole texels"}};
  for (const NamedRects& r : partly) add_rects(cases, "out_of_bounds", r);
  constexpr NamedRects completely[] = {{"source", {30, 0, 8, 8}, {4, 4, 8, 8}}, {"destination", {4, 4, 8, 8}, {-20, 4, 8, 8}}};
  for (const NamedRects& r : completely) add_rects(cases, "outside", r, true);
}

/// Rows and columns of the source must be copied as wholes, whatever the factors are.
void add_random_factors(BlitCases& cases) {
  for (unsigned seed = 0; seed < 48; ++seed) {
    std::mt19937 random(seed);
    const auto between = [&](int low, int high) { return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1)); };
    const bool enlarges = seed % 2 == 0;
    BlitCase c{(enlarges ? "consistency_enlarged_" : "consistency_reduced_") + std::to_string(seed / 2)};
    const auto axis = [&](int texels, int to_texels, int& begin, int& size, int& to_begin, int& to_size) {
      size = enlarges ? between(1, 7) : between(9, texels);
      to_size = enlarges ? between(9, to_texels) : between(1, 8);
      begin = between(0, texels - size);
      to_begin = between(0, to_texels - to_size);
    };
    axis(24, 32, c.from_rect.x, c.from_rect.width, c.to_rect.x, c.to_rect.width);
    axis(16, 20, c.from_rect.y, c.from_rect.height, c.to_rect.y, c.to_rect.height);
    cases.push_back(c);
  }
}

/// Windows begin with the top row. Layers are copied together.
void add_windows_and_layers(BlitCases& cases) {
  for (const auto& filter : kFilters) {
    BlitCase window{std::string("window_") + filter.name}, layers{std::string("layers_") + filter.name};
    window.filter = layers.filter = filter.filter;
    window.to = TexelFormat::srgb8a8;
    window.flipped = true;
    window.not_by_mesa = "the context has no window";
    layers.from_size.depth = layers.to_size.depth = 3;
    layers.not_by_mesa = "glBlitFramebuffer copies one layer";
    cases.push_back(window);
    cases.push_back(layers);
  }
}

void add_depth_and_stencil(BlitCases& cases) {
  constexpr NamedRects rects[] = {{"copy", {3, 2, 17, 11}, {9, 5, 17, 11}},
                                  {"scaled", {0, 0, 24, 16}, {0, 0, 32, 20}},
                                  {"mirrored", {24, 0, -24, 16}, {4, 18, 24, -16}},
                                  {"part", {7, 5, 9, 6}, {5, 4, 18, 12}},
                                  {"out_of_bounds", {-6, 4, 40, 30}, {1, 1, 29, 17}}};
  for_formats([&](TexelFormat f) {
    if (!is_depth(f)) return;
    for (const NamedRects& r : rects) cases.push_back({format_name(f) + "_" + r.name, f, f, {24, 16}, {32, 20}, r.from, r.to});
  });
}

void add_resolves(BlitCases& cases) {
  const auto add = [&](const std::string& name, TexelFormat from, TexelFormat to, int samples, ResolveMode mode) {
    BlitCase c{name, from, to, {13, 9, samples}, {13, 9}};
    c.resolve = mode;
    if (samples != 4) c.not_by_mesa = "llvmpipe has 4 samples";
    if (mode != ResolveMode::mean) c.not_by_mesa = "OpenGL does not say which sample is selected";
    if (from != to) c.not_by_mesa = "OpenGL resolves to the same format only";
    cases.push_back(c);
  };
  for_formats([&](TexelFormat f) {
    const std::string name = format_name(f);
    if (is_color(f)) {
      for (const int samples : {1, 2, 4, 8}) add("resolve_" + name + "_" + std::to_string(samples), f, f, samples, ResolveMode::mean);
      add("resolve_" + name + "_to_rgba32f", f, TexelFormat::rgba32f, 4, ResolveMode::mean);
      add("mean_of_rgba16f_as_" + name, TexelFormat::rgba16f, f, 8, ResolveMode::mean);
    }
    add("sample_0_" + name, f, f, 4, ResolveMode::sample_0);
    if (is_depth(f)) {
      for (const int samples : {2, 4, 8}) {
        add("min_" + name + "_" + std::to_string(samples), f, f, samples, ResolveMode::min);
        add("max_" + name + "_" + std::to_string(samples), f, f, samples, ResolveMode::max);
      }
    }
  });
}

}  // namespace

BlitCases blit_cases() {
  BlitCases cases;
  add_conversions(cases);
  add_filtered_formats(cases);
  add_rectangles(cases);
  add_random_factors(cases);
  add_windows_and_layers(cases);
  add_depth_and_stencil(cases);
  add_resolves(cases);
  return cases;
}

}  // namespace halfspace::conformance::blits
