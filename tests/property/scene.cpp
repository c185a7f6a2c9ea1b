// SPDX-License-Identifier: Apache-2.0
#include "property/scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include "halfspace/core/srgb.h"
#include "halfspace/core/texel_codec.h"
#include "oracle/texels.h"

namespace halfspace {

namespace {

constexpr const char* kCompareNames[] = {"never", "less", "equal", "less_equal", "greater", "not_equal", "greater_equal", "always"};

std::size_t pixels_of(const Scene& s) { return static_cast<std::size_t>(s.width) * static_cast<std::size_t>(s.height); }

template <class Target>
std::size_t image_bytes(const Scene& s, const Target& target) {
  return pixels_of(s) * static_cast<std::size_t>(bytes_per_pixel(target.format)) * static_cast<std::size_t>(target.samples * s.layers);
}

// Returns the value of a component, for messages and for finding the worst pixel.
double value_at(const std::vector<std::byte>& bytes, std::size_t index, std::size_t size, bool is_float) {
  const std::byte* p = bytes.data() + index * size;
  if (size == 1) return static_cast<double>(std::to_integer<int>(*p));
  if (size == 2) {
    uint16_t v = 0;
    std::memcpy(&v, p, 2);
    return v;
  }
  if (is_float) {
    float v = 0;
    std::memcpy(&v, p, 4);
    return static_cast<double>(v);
  }
  uint32_t v = 0;
  std::memcpy(&v, p, 4);
  return v;
}

// Compares two pictures with `components` values of `size` bytes each per pixel. Returns a description of the difference; empty if they are
// equal.
std::string compare(const char* name, const Scene& scene, const std::vector<std::byte>& expected, const std::vector<std::byte>& actual,
                    std::size_t components, std::size_t size, bool is_float) {
  if (expected == actual) return {};
  if (expected.size() != actual.size()) return std::string(name) + ": sizes differ";
  std::size_t differing = 0, worst = 0;
  double worst_by = -1.0;
  const std::size_t pixel_bytes = components * size;
  for (std::size_t i = 0; i < expected.size() / pixel_bytes; ++i) {
    if (std::memcmp(&expected[i * pixel_bytes], &actual[i * pixel_bytes], pixel_bytes) == 0) continue;
    ++differing;
    double by = 0.0;
    for (std::size_t k = 0; k < components; ++k) {
      const double d =
          std::fabs(value_at(expected, i * components + k, size, is_float) - value_at(actual, i * components + k, size, is_float));
      by = std::fmax(by, std::isnan(d) ? HUGE_VAL : d);
    }
    if (by > worst_by) {
      worst_by = by;
      worst = i;
    }
  }
  std::ostringstream out;
  out.precision(9);
  const auto width = static_cast<std::size_t>(scene.width);
  const std::size_t place = worst % pixels_of(scene);
  out << name << ": " << differing << " of " << expected.size() / pixel_bytes << " pixels differ; worst, window (" << place % width << ", "
      << static_cast<std::size_t>(scene.height) - 1 - place / width << "), image of sample or layer " << worst / pixels_of(scene) << ":";
  for (std::size_t k = 0; k < components; ++k) out << ' ' << value_at(expected, worst * components + k, size, is_float);
  out << " expected, got";
  for (std::size_t k = 0; k < components; ++k) out << ' ' << value_at(actual, worst * components + k, size, is_float);
  return out.str() + "\n";
}

std::string compare_color(const char* name, const Scene& scene, ColorFormat format, const std::vector<std::byte>& expected,
                          const std::vector<std::byte>& actual) {
  const TexelInfo& info = texel_info(format);  // packed formats are compared as one word
  const std::size_t components = info.bits == 0 ? 1 : info.channels;
  return compare(name, scene, expected, actual, components, info.bytes / components, format == ColorFormat::rgba32f);
}

void copy_texels(const TexelView& from, const TexelView& to) {
  const auto bytes = static_cast<std::size_t>(from.width) * texel_info(from.format).bytes;
  for (int layer = 0; layer < from.layers; ++layer) {
    for (int y = 0; y < from.height; ++y) std::memcpy(to.at(0, y, layer), from.at(0, y, layer), bytes);
  }
}

// A copy of an image in the middle of a larger one, whose rows are stored bottom row first and have an odd pitch.
class Surrounded {
 public:
  explicit Surrounded(const TexelView& image) : image_(image) {
    if (image.data == nullptr) return;
    view_ = image;
    const std::ptrdiff_t bytes = texel_info(image.format).bytes;
    view_.row_pitch = (image.width + 5) * bytes + 1;
    view_.layer_pitch = (image.height + 7) * view_.row_pitch;
    memory_.assign(static_cast<std::size_t>(image.layers * view_.layer_pitch), kGuard);
    view_.data = memory_.data() + 3 * view_.row_pitch + 2 * bytes;
    copy_texels(image_, view_);
  }

  // Makes a target draw into the copy.
  template <class Target>
  void replace(Target& target) const {
    if (view_.data == nullptr) return;
    const TexelView top_first = view_.flipped();
    target.data = top_first.data;
    target.row_pitch = top_first.row_pitch;
    (target.layers > 1 ? target.layer_pitch : target.sample_pitch) = top_first.layer_pitch;
  }

  // Copies the texels back. Returns true if nothing was written around them.
  bool finish() {
    if (view_.data == nullptr) return true;
    copy_texels(view_, image_);
    const std::vector<std::byte> guards(static_cast<std::size_t>(view_.width) * texel_info(view_.format).bytes, kGuard);
    for (int layer = 0; layer < view_.layers; ++layer) {
      for (int y = 0; y < view_.height; ++y) std::ranges::copy(guards, view_.at(0, y, layer));
    }
    return std::ranges::all_of(memory_, [](std::byte b) { return b == kGuard; });
  }

 private:
  static constexpr std::byte kGuard{0xa5};
  TexelView image_, view_;
  std::vector<std::byte> memory_;
};

}  // namespace

namespace draw_memory {

void lay_out_vertices(const float* rows, std::size_t count, int components, VertexLayout layout, DrawMemory& memory) {
  const auto n = static_cast<std::size_t>(components);
  // One stream with all members, or one with the position and one with the others.
  const std::size_t first_part = layout == VertexLayout::tight ? n : std::min(n, std::size_t{4});
  const std::size_t gap = layout == VertexLayout::padded ? 3 : 0;
  const auto add = [&](const std::vector<float>& buffer, std::size_t first, std::size_t stride, std::size_t floats) {
    const std::byte* data = count == 0 ? nullptr : std::as_bytes(std::span(buffer)).data() + first * sizeof(float);
    memory.streams.push_back({data, static_cast<int32_t>(stride * sizeof(float)), static_cast<int32_t>(floats), count});
  };
  memory.buffers.resize(2);
  std::vector<float>&all = memory.buffers[0], &rest = memory.buffers[1];
  if (layout == VertexLayout::separate) {
    for (std::size_t v = 0; v < count; ++v) {
      all.insert(all.end(), rows + v * n, rows + v * n + first_part);
      rest.insert(rest.end(), rows + v * n + first_part, rows + v * n + n);
    }
    add(all, 0, first_part, first_part);
    if (n > first_part) add(rest, 0, n - first_part, n - first_part);
    return;
  }
  for (std::size_t v = 0; v < count; ++v) {
    all.insert(all.end(), rows + v * n, rows + v * n + n);
    if (v + 1 < count) all.insert(all.end(), gap, 1e30f);
  }
  add(all, 0, n + gap, first_part);
  if (first_part < n) add(all, first_part, n + gap, n - first_part);
}

void lay_out_instances(const float* rows, std::size_t count, int components, std::size_t instance_components, uint32_t divisor,
                       DrawMemory& memory) {
  if (instance_components == 0) return;
  // Remove the last components from the vertex streams. The remaining ones keep their offsets.
  const std::size_t first = static_cast<std::size_t>(components) - instance_components;
  std::size_t rest = first;
  for (VertexStream& s : memory.streams) {
    s.components = std::min(s.components, static_cast<int32_t>(rest));
    rest -= static_cast<std::size_t>(s.components);
  }
  std::erase_if(memory.streams, [](const VertexStream& s) { return s.components == 0; });
  memory.buffers.emplace_back(rows, rows + count * static_cast<std::size_t>(components));
  memory.streams.push_back(
      per_instance(VertexStream{std::as_bytes(std::span(memory.buffers.back())).data() + first * sizeof(float),
                                components * static_cast<int32_t>(sizeof(float)), static_cast<int32_t>(instance_components), count},
                   divisor));
}

void lay_out_indices(const std::vector<uint32_t>& list, std::size_t vertex_count, std::optional<uint32_t> restart, IndexLayout layout,
                     DrawMemory& memory) {
  if (layout == IndexLayout::none) return;
  const PrimitiveRestart mode = !restart                       ? PrimitiveRestart::off
                                : *restart == oracle::kRestart ? PrimitiveRestart::on
                                                               : PrimitiveRestart::at(*restart);
  const auto store = [&]<class T>(std::vector<T>& to) {
    for (const uint32_t i : list) to.push_back(static_cast<T>(i));
    memory.indices.emplace(std::span<const T>(to), vertex_count, mode);
  };
  if (layout == IndexLayout::bytes) store(memory.bytes);
  if (layout == IndexLayout::narrow) store(memory.narrow);
  if (layout == IndexLayout::wide) store(memory.wide);
}

}  // namespace draw_memory

Rect viewport_of(const Scene& scene, const DrawState& state) {
  const ViewportRect v = state.viewport.value_or(Rect{0, 0, scene.width, scene.height});
  return {static_cast<int>(std::floor(v.x)), static_cast<int>(std::floor(std::min(v.y, v.y + v.height))),
          static_cast<int>(std::ceil(v.width)), static_cast<int>(std::ceil(std::fabs(v.height)))};
}

namespace {

// Makes a target refer to its image.
template <class Target>
void set_image(const Scene& s, std::vector<std::byte>& bytes, Target& target) {
  bytes.resize(image_bytes(s, target));
  target.data = bytes.data();
  target.width = s.width, target.height = s.height;
  target.layers = s.layers;
  target.layer_pitch = static_cast<std::ptrdiff_t>(bytes.size()) / s.layers;
}

}  // namespace

PassResult run_pass(const Scene& scene, const PassOptions& options, int threads) {
  PassResult r;
  Pictures& p = r.pictures;
  ColorTarget color = scene.color;
  DepthTarget depth = scene.depth;
  if (scene.has_color_image) {
    p.color = scene.color_before;
    set_image(scene, p.color, color);
  } else {
    color.store = StoreOp::dont_care;
  }
  if (scene.has_depth_image) {
    p.depth = scene.depth_before;
    set_image(scene, p.depth, depth);
    depth.store = StoreOp::store;
  }
  std::vector<ColorTarget> colors{color};
  p.more = scene.more_before;
  p.more.resize(scene.more_colors.size());
  for (std::size_t i = 0; i < scene.more_colors.size(); ++i) {
    colors.push_back(scene.more_colors[i]);
    set_image(scene, p.more[i], colors.back());
  }
  std::vector<Surrounded> views;
  if (scene.in_views) {
    for (ColorTarget& c : colors) views.emplace_back(target_texels(c)).replace(c);
    views.emplace_back(target_texels(depth)).replace(depth);
  }
  PassOptions all_options = options;
  all_options.samples = scene.samples;
  all_options.supersample = scene.supersample;
  all_options.layers = scene.layers;
  Pass pass(scene.width, scene.height, colors, depth, all_options);
  if (scene.post_format != ColorFormat::none) {
    p.post.resize(pixels_of(scene) * static_cast<std::size_t>(bytes_per_pixel(scene.post_format)));
    pass.post(Curve{}, {.format = scene.post_format, .data = p.post.data(), .width = scene.width, .height = scene.height});
  }
  for (const SceneDraw& d : scene.draws) d.submit(pass);
  r.statistics = pass.run(Workers(threads));
  bool is_clean = true;
  for (Surrounded& v : views) is_clean &= v.finish();
  if (!is_clean) p = {};
  return r;
}

namespace {

std::vector<ColorTarget> colors_of(const Scene& scene) {
  std::vector<ColorTarget> colors{scene.color};
  colors.insert(colors.end(), scene.more_colors.begin(), scene.more_colors.end());
  return colors;
}

// Clears a layer or fills it with its part of the contents before the pass.
void load_layer(const Scene& scene, int layer, oracle::Framebuffer& target) {
  const auto fill = [&](std::vector<std::byte>& bytes, const std::vector<std::byte>& before) {
    const std::size_t size = before.size() / static_cast<std::size_t>(scene.layers), begin = size * static_cast<std::size_t>(layer);
    for (std::size_t i = 0; size != 0 && i < bytes.size(); ++i) bytes[i] = before[begin + i % size];  // all samples that are not stored
  };
  fill(target.depth_bytes, scene.depth_before);
  if (scene.depth.load == LoadOp::clear) target.clear_depth(scene.depth.clear_value);
  if (stencil_load_of(scene.depth) == LoadOp::clear) target.clear_stencil(scene.depth.stencil_clear_value);
  const std::vector<ColorTarget> colors = colors_of(scene);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    if (colors[i].load == LoadOp::clear) {
      target.clear_color(i, colors[i].clear_value);
    } else {
      fill(target.color_bytes[i], i == 0 ? scene.color_before : scene.more_before[i - 1]);
    }
  }
}

void append_layer(const Scene& scene, const oracle::Framebuffer& target, Pictures& to) {
  const auto append = [](std::vector<std::byte>& bytes, const std::vector<std::byte>& more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
  };
  const oracle::Framebuffer seen = target.resolved();
  const std::vector<ColorTarget> colors = colors_of(scene);
  const auto color_of = [&](std::size_t i) { return (colors[i].samples > 1 ? target : seen).color_bytes[i]; };
  if (scene.post_format != ColorFormat::none) append(to.post, oracle::post(seen, Curve{}, scene.post_format).color_bytes[0]);
  if (scene.has_color_image) append(to.color, color_of(0));
  if (scene.has_depth_image) append(to.depth, (scene.depth.samples > 1 ? target : seen).depth_bytes);
  to.more.resize(scene.more_colors.size());
  for (std::size_t i = 1; i < colors.size(); ++i) append(to.more[i - 1], color_of(i));
}

}  // namespace

OracleResult run_oracle(const Scene& scene) {
  std::vector<ColorFormat> formats;
  for (const ColorTarget& c : colors_of(scene)) formats.push_back(c.format);
  std::vector<oracle::Framebuffer> layers;
  for (int layer = 0; layer < scene.layers; ++layer) {
    layers.emplace_back(scene.width, scene.height, formats, scene.depth.format, scene.samples);
    load_layer(scene, layer, layers.back());
  }
  oracle::Renderer renderer(layers, scene.supersample);
  for (const SceneDraw& d : scene.draws) d.reference(renderer);
  OracleResult r;
  r.counts = renderer.counts();
  for (const oracle::Framebuffer& target : layers) append_layer(scene, target, r.pictures);
  return r;
}

std::string difference(const Scene& scene, const Pictures& expected, const Pictures& actual) {
  const bool two_words = scene.depth.format == DepthFormat::d32fs8;
  const std::size_t depth_bytes = two_words ? 4 : static_cast<std::size_t>(bytes_per_pixel(scene.depth.format));
  std::string out = compare_color("color", scene, scene.color.format, expected.color, actual.color) +
                    compare("depth", scene, expected.depth, actual.depth, two_words ? 2 : 1, depth_bytes,
                            scene.depth.format == DepthFormat::d32f || two_words) +
                    compare_color("post", scene, scene.post_format, expected.post, actual.post);
  for (std::size_t i = 0; i < scene.more_colors.size(); ++i) {
    out += compare_color("additional color", scene, scene.more_colors[i].format, expected.more[i], actual.more[i]);
  }
  return out;
}

Image<glm::u8vec4> codes_of(const Scene& scene, const Pictures& pictures) {
  const bool is_color = !pictures.color.empty(), is_post = !is_color && !pictures.post.empty();
  const std::vector<std::byte>& bytes = is_color ? pictures.color : is_post ? pictures.post : pictures.depth;
  const TexelFormat format = is_color ? scene.color.format : is_post ? scene.post_format : scene.depth.format;
  Image<glm::u8vec4> codes(scene.width, scene.height);
  for (std::size_t i = 0; i < pixels_of(scene); ++i) {
    const std::byte* const texel = bytes.data() + i * texel_info(format).bytes;
    const glm::vec4 c = is_depth(format) ? glm::vec4(decode_texel(format, texel).x) : oracle::read_texel(format, texel);
    const auto code = [&](int k) {
      const bool is_encoded = format == ColorFormat::rgba8 || is_depth(format);
      return is_encoded ? std::lround(255.0f * std::clamp(c[k], 0.0f, 1.0f)) : linear_to_srgb(c[k]);
    };
    codes.data()[i] = glm::u8vec4(code(0), code(1), code(2), 255);
  }
  return codes;
}

std::string describe(const PassOptions& o, int threads) {
  std::ostringstream out;
  out << threads << " threads, tiles of " << o.tuning.tile_size << ", chunks of " << o.tuning.chunk_triangles << ", "
      << (o.tuning.defer ? "deferred" : "immediate") << ", budget " << o.tuning.bin_budget;
  return out.str();
}

std::string describe(const Scene& s) {
  std::ostringstream out;
  out << s.width << 'x' << s.height << ' ' << texel_info(s.color.format).name << ' ' << texel_info(s.depth.format).name << ", "
      << 1 + s.more_colors.size() << " colors, " << s.samples << " samples" << (s.supersample ? ", supersampled" : "");
  if (s.layers > 1) out << ", " << s.layers << " layers";
  out << '\n';
  for (const SceneDraw& d : s.draws) {
    const DepthState& z = d.state.depth;
    out << "  " << d.shader << ", " << d.triangles << " triangles (topology " << static_cast<int>(d.state.topology) << ", "
        << d.state.instances << " instances, base vertex " << d.state.base_vertex << "), cull " << static_cast<int>(d.state.cull)
        << (d.state.front == Winding::clockwise ? " cw" : " ccw") << ", depth "
        << (z.test ? kCompareNames[static_cast<int>(z.compare)] : "off") << (z.write ? "" : " (no write)") << (z.clamp ? " clamp" : "")
        << (z.clip == ClipDepth::zero_to_one ? " [0,w]" : " [-w,w]") << " range " << z.range_near << ' ' << z.range_far << ", polygon mode "
        << static_cast<int>(d.state.polygon_mode) << ", line width " << d.state.line_width << (d.state.blend ? ", blend" : "")
        << (d.state.stencil ? ", stencil" : "") << (d.state.color_mask.all() ? "" : ", mask")
        << (d.state.sample_shading ? ", sample shading" : "") << (d.state.alpha_to_coverage ? ", alpha to coverage" : "");
    if (d.state.offset.slope != 0 || d.state.offset.constant != 0) out << ", offset";
    const auto print = [&](const auto& r) {
      if (r) out << " [" << r->x << ' ' << r->y << ' ' << r->width << 'x' << r->height << ']';
    };
    print(d.state.viewport);
    print(d.state.scissor);
    if (d.state.clip_origin == ClipOrigin::upper_left) out << ", upper left";
    if (d.state.query) out << ", query " << *d.state.query;
    if (d.state.condition) out << ", if " << (d.state.condition->inverted ? "no " : "any ") << d.state.condition->query;
    if (is_smooth(d.state)) out << ", smooth";
    if (d.state.viewports != nullptr) out << ", " << d.state.viewports->size() << " viewports";
    if (d.state.depth_bounds) out << ", depth bounds " << d.state.depth_bounds->low << ' ' << d.state.depth_bounds->high;
    out << '\n';
  }
  return out.str();
}

}  // namespace halfspace
