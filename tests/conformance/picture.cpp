// SPDX-License-Identifier: Apache-2.0
#include "conformance/picture.h"

#include <bit>
#include <cstring>
#include <numeric>
#include <sstream>

#include "conformance/attribute_arrays.h"
#include "conformance/shaders.h"
#include "oracle/texels.h"

namespace halfspace::conformance {

namespace {

template <class S>
SceneDraw draw_of(const S& shader, const char* name, const Drawing& d) {
  static_assert(sizeof(VertexAttributes<float>) == sizeof(Vertex));
  oracle::Input<S> input;
  const auto row = [](const Vertex& v) { return VertexAttributes<float>{v.pos_clip, v.color, v.extra}; };
  for (const Vertex& v : d.vertices) input.vertices.push_back(row(v));
  input.indices = d.indices;
  if (d.indices.empty()) {
    input.indices.resize(d.vertices.size());
    std::iota(input.indices.begin(), input.indices.end(), 0u);
  }
  input.restart = d.restart;
  input.divisor = d.divisor;
  if (!d.rows.empty()) input.instance_components = 4;
  for (const glm::vec4& r : d.rows) input.instances.push_back(row({glm::vec4(0.0f), glm::vec4(0.0f), r}));
  const IndexLayout layout = d.indices.empty() ? IndexLayout::none : d.index_layout;
  return make_draw(shader, name, input, d.state, VertexLayout::tight, layout);
}

bool same(const GeometryLayout& a, const GeometryLayout& b) {
  return a.input == b.input && a.output == b.output && a.invocations == b.invocations;
}

template <std::size_t... I>
SceneDraw layer_draw_of(const Drawing& d, std::index_sequence<I...>) {
  SceneDraw draw;
  ((same(d.geometry, kLayerLayouts[I]) ? void(draw = draw_of(LayerGeometryShader<I>{d.mode}, "layer_geometry", d)) : void()), ...);
  return draw;
}

template <std::size_t... I>
SceneDraw geometry_draw_of(const Drawing& d, std::index_sequence<I...>) {
  SceneDraw draw;
  ((same(d.geometry, kGeometryLayouts[I]) ? void(draw = draw_of(GeometryShader<I>{d.mode, d.value}, "geometry", d)) : void()), ...);
  return draw;
}

bool same(const TessellationLayout& a, const TessellationLayout& b) {
  return a.domain == b.domain && a.spacing == b.spacing && a.clockwise == b.clockwise && a.point_mode == b.point_mode;
}

template <std::size_t... I>
SceneDraw tessellation_draw_of(const Drawing& d, std::index_sequence<I...>) {
  SceneDraw draw;
  ((same(d.tessellation, kTessellationLayouts[I]) ? void(draw = draw_of(TessellationShader<I>{d.mode, d.value}, "tessellation", d))
                                                  : void()),
   ...);
  return draw;
}

template <std::size_t... I>
SceneDraw outputs_draw_of(const Drawing& d, std::index_sequence<I...>) {
  SceneDraw draw;
  (((d.outputs == kOutputTypes[I]) ? void(draw = draw_of(OutputsShader<I>{d.value}, "outputs", d)) : void()), ...);
  return draw;
}

// The oracle receives the numbers that the arrays contain by their definition (attribute_arrays.h), and the tile path the arrays,
// which must outlive the draw.
SceneDraw arrays_draw_of(const Drawing& d) {
  using Row = ArrayAttributes<float>;
  const std::size_t count = vertex_count(d);
  oracle::Input<ArraysShader> input;
  std::size_t rows = 0;
  for (const AttributeArray& a : d.arrays) {
    if (a.stream.divisor == 0) continue;
    input.instance_components += static_cast<std::size_t>(a.stream.components);
    input.divisor = a.stream.divisor;
    rows = a.stream.count;
  }
  for (std::size_t i = 0; i < count; ++i) input.vertices.push_back(row_of<Row>(d.arrays, i));
  for (std::size_t i = 0; i < rows; ++i) input.instances.push_back(row_of<Row>(d.arrays, i));
  input.indices = d.indices;
  if (d.indices.empty()) {
    input.indices.resize(count);
    std::iota(input.indices.begin(), input.indices.end(), 0u);
  }
  input.restart = d.restart;
  const auto memory = std::make_shared<draw_memory::DrawMemory>();
  for (const AttributeArray& a : d.arrays) memory->streams.push_back(a.stream);
  memory->view = detail::bind_streams(memory->streams, count);
  const auto indexable = static_cast<std::size_t>(static_cast<int64_t>(count) - d.state.base_vertex);
  draw_memory::lay_out_indices(input.indices, indexable, input.restart_at(), d.indices.empty() ? IndexLayout::none : d.index_layout,
                               *memory);
  return make_draw(ArraysShader{d.value}, "arrays", input, d.state, std::shared_ptr<const draw_memory::DrawMemory>(memory));
}

SceneDraw draw_of(const Drawing& d) {
  switch (d.kind) {
    case Kind::color: return draw_of(ColorShader{d.mode}, "color", d);
    case Kind::clip: return draw_of(ClipShader{}, "clip", d);
    case Kind::cutout: return draw_of(CutoutShader{{}, d.value}, "cutout", d);
    case Kind::depth: return draw_of(DepthShader{}, "depth", d);
    case Kind::point: return draw_of(PointShader{}, "point", d);
    case Kind::derivative: return draw_of(DerivativeShader{{}, d.mode, d.value}, "derivative", d);
    case Kind::texture: return draw_of(TextureShader{{}, d.texture, d.sampler, d.mode, d.value}, "texture", d);
    case Kind::instance: return draw_of(InstanceShader{d.value}, "instance", d);
    case Kind::two_colors: return draw_of(ColorsShader<2>{}, "two_colors", d);
    case Kind::tessellation: return tessellation_draw_of(d, std::make_index_sequence<kTessellationLayouts.size()>());
    case Kind::cull: return draw_of(CullShader{}, "cull", d);
    case Kind::sample_inputs: return draw_of(SampleInputsShader{{}, d.mode}, "sample_inputs", d);
    case Kind::sample_mask_in: return draw_of(SampleMaskInShader{}, "sample_mask_in", d);
    case Kind::sample_mask: return draw_of(SampleMaskShader{{}, static_cast<int32_t>(d.value)}, "sample_mask", d);
    case Kind::geometry: return geometry_draw_of(d, std::make_index_sequence<kGeometryLayouts.size()>());
    case Kind::viewport: return draw_of(ViewportShader{}, "viewport", d);
    case Kind::layer: return draw_of(LayerShader{}, "layer", d);
    case Kind::layer_geometry: return layer_draw_of(d, std::make_index_sequence<kLayerLayouts.size()>());
    case Kind::attributes: return arrays_draw_of(d);
    case Kind::outputs: return outputs_draw_of(d, std::make_index_sequence<kOutputTypes.size()>());
    case Kind::four_colors: break;
  }
  return draw_of(ColorsShader<4>{}, "four_colors", d);
}

SceneDraw draw_of(const ClearValues& values) {
  SceneDraw clear;
  clear.shader = "clear";
  clear.submit = [values](Pass& pass) { pass.clear(values); };
  clear.reference = [values](oracle::Renderer& renderer) { renderer.clear(values); };
  return clear;
}

Scene scene_of(const Picture& p) {
  Scene s;
  s.width = p.width;
  s.height = p.height;
  s.samples = p.samples;
  s.supersample = p.supersample;
  s.layers = p.layers;
  for (const ColorFormat f : p.colors) s.more_colors.push_back({.format = f, .clear_value = p.clear_color});
  s.color = s.more_colors.front();
  s.more_colors.erase(s.more_colors.begin());
  s.depth = {.format = p.depth, .clear_value = p.clear_depth, .stencil_clear_value = p.clear_stencil};
  s.has_depth_image = p.depth != DepthFormat::none;
  for (const Drawing& d : p.draws) {
    if (d.clear) s.draws.push_back(draw_of(*d.clear));
    s.draws.push_back(draw_of(d));
  }
  return s;
}

Seen seen_of(const Picture& p, Pictures bytes, std::vector<uint64_t> queries) {
  return {p.width, p.height, p.colors, p.depth, std::move(bytes), std::move(queries)};
}

template <class T>
T read(const std::vector<std::byte>& bytes, std::size_t index) {
  T value;
  std::memcpy(&value, &bytes[index * sizeof(T)], sizeof(T));
  return value;
}

}  // namespace

std::size_t Seen::index(int x, int y, int layer) const {
  return static_cast<std::size_t>(layer * height + height - 1 - y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

std::span<const std::byte> Seen::texel_bytes(int x, int y, std::size_t attachment, int layer) const {
  const std::vector<std::byte>& from = attachment == 0 ? bytes.color : bytes.more[attachment - 1];
  const auto size = static_cast<std::size_t>(bytes_per_pixel(formats[attachment]));
  return std::span(from).subspan(index(x, y, layer) * size, size);
}

glm::vec4 Seen::texel(int x, int y, std::size_t attachment, int layer) const {
  const ColorFormat format = formats[attachment], stored = format == ColorFormat::srgb8a8 ? ColorFormat::rgba8
                                                           : format == ColorFormat::srgb8 ? ColorFormat::rgb8
                                                                                          : format;
  return oracle::read_texel(stored, texel_bytes(x, y, attachment, layer).data());
}

glm::vec4 Seen::color(int x, int y, std::size_t attachment, int layer) const { return texel(x, y, attachment, layer); }

glm::ivec4 Seen::integers(int x, int y, std::size_t attachment) const { return std::bit_cast<glm::ivec4>(texel(x, y, attachment)); }

double Seen::depth(int x, int y, int layer) const {
  const std::size_t i = index(x, y, layer);
  switch (depth_format) {
    case DepthFormat::d16: return read<uint16_t>(bytes.depth, i);
    case DepthFormat::d24: return read<uint32_t>(bytes.depth, i);
    case DepthFormat::d24s8: return read<uint32_t>(bytes.depth, i) >> 8;
    case DepthFormat::d32f: return static_cast<double>(read<float>(bytes.depth, i));
    case DepthFormat::d32fs8: return static_cast<double>(read<DepthStencil>(bytes.depth, i).depth);
    default: return 0.0;
  }
}

int Seen::stencil(int x, int y) const {
  const std::size_t i = index(x, y);
  if (depth_format == DepthFormat::d24s8) return static_cast<int>(read<uint32_t>(bytes.depth, i) & 0xff);
  return static_cast<int>(read<DepthStencil>(bytes.depth, i).stencil);
}

bool Seen::is_constant() const {
  const auto constant = [&](const std::vector<std::byte>& of, ColorFormat format) {
    const auto n = static_cast<std::size_t>(bytes_per_pixel(format));
    return of.size() <= n || std::memcmp(of.data(), of.data() + n, of.size() - n) == 0;
  };
  for (std::size_t i = 0; i < formats.size(); ++i) {
    if (!constant(i == 0 ? bytes.color : bytes.more[i - 1], formats[i])) return false;
  }
  return true;
}

Seen draw(const Picture& picture, const PassOptions& options, int threads) {
  PassResult r = run_pass(scene_of(picture), options, threads);
  return seen_of(picture, std::move(r.pictures), std::move(r.statistics.queries));
}

void draw_into(const Picture& picture, TextureMemory& texture) {
  const Scene scene = scene_of(picture);
  ColorTarget target = layered_color_target(texture.level());
  target.clear_value = picture.clear_color;
  Pass pass(picture.width, picture.height, target, scene.depth, {.samples = picture.samples, .layers = picture.layers});
  for (const SceneDraw& d : scene.draws) d.submit(pass);
  pass.run(Workers(1));
}

Seen draw_by_oracle(const Picture& picture) {
  OracleResult r = run_oracle(scene_of(picture));
  std::vector<uint64_t> queries;
  for (const auto& [query, samples] : r.counts.queries) {
    queries.resize(std::max<std::size_t>(queries.size(), query + 1));
    queries[query] = samples;
  }
  return seen_of(picture, std::move(r.pictures), std::move(queries));
}

std::size_t vertex_count(const Drawing& d) {
  std::size_t count = d.vertices.size();
  for (const AttributeArray& a : d.arrays) {
    if (a.stream.divisor == 0) count = a.stream.count;
  }
  return count;
}

std::string difference_from_oracle(const Picture& picture) {
  const Scene scene = scene_of(picture);
  const OracleResult expected = run_oracle(scene);
  const PassResult deferred = run_pass(scene, {}, 1), at_once = run_pass(scene, {.tuning = {.tile_size = 8, .defer = false}}, 1);
  std::string wrong = difference(scene, expected.pictures, deferred.pictures);
  if (wrong.empty()) {
    wrong = difference(scene, expected.pictures, at_once.pictures);
    if (!wrong.empty()) wrong = "immediate shading in tiles of 8: " + wrong;
  }
  if (wrong.empty() && expected.counts.samples_passed != deferred.statistics.samples_passed) {
    wrong = "samples passed: " + std::to_string(expected.counts.samples_passed) + " expected, got " +
            std::to_string(deferred.statistics.samples_passed) + "\n";
  }
  for (const auto& [query, samples] : expected.counts.queries) {
    const auto& counted = deferred.statistics.queries;
    if (wrong.empty() && (query >= counted.size() || counted[query] != samples)) wrong = "an occlusion query differs\n";
  }
  return wrong;
}

std::string describe(const Picture& picture) {
  std::ostringstream out;
  out << halfspace::describe(scene_of(picture));
  for (const Drawing& d : picture.draws) {
    out << "  mode " << d.mode << ", value " << d.value << ", vertices";
    for (const Vertex& v : d.vertices)
      out << " (" << v.pos_clip.x << ' ' << v.pos_clip.y << ' ' << v.pos_clip.z << ' ' << v.pos_clip.w << ')';
    out << '\n';
  }
  return out.str();
}

std::string check(const Case& c) {
  const Picture picture = c.picture();
  std::string wrong = difference_from_oracle(picture);
  if (!wrong.empty()) return "differs from the oracle: " + wrong + describe(picture);
  const Seen seen = draw(picture);
  if (!c.may_be_constant && seen.is_constant()) return "the picture is constant\n" + describe(picture);
  if (c.truth) wrong = c.truth(picture, seen);
  return wrong.empty() ? wrong : wrong + "\n" + describe(picture);
}

}  // namespace halfspace::conformance
