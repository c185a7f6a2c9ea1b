// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/primitives/vertex_stage.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

#include "halfspace/core/transpose.h"
#include "halfspace/raster/pipeline/window.h"
#include "halfspace/raster/primitives/point_sprite.h"

namespace halfspace::HS_LANES {

namespace {

// Transforms clip-space positions to window coordinates and outcodes. clip: four rows with x, y, z and w. Returns the union of the
// outcodes.
Outcode project(const Draw& draw, const float* clip, int count, ScreenVertex* screen, Outcode* outcodes) {
  const Viewport& v = draw.viewport;
  Int any(0);
  for (int begin = 0; begin < count; begin += kLanes) {
    const Real x = load<Real>(clip + begin);
    const Real y = load<Real>(clip + kVertexBatch + begin);
    const Real z = load<Real>(clip + 2 * kVertexBatch + begin);
    const Real w = load<Real>(clip + 3 * kVertexBatch + begin);
    const WindowVertex<Real> vertex = window_vertex(v, draw.state.depth, x, y, z, w);
    const int rest = std::min(kLanes, count - begin);
    static_assert(sizeof(ScreenVertex) == 16 && offsetof(ScreenVertex, z) == 8);
    ScreenVertex spare;
    store_aos4<Int>({vertex.x, vertex.y, as_int(vertex.z), as_int(vertex.inv_w)},
                    [&](int k) { return k < rest ? &screen[begin + k] : &spare; });
    alignas(64) std::array<int32_t, kLanes> codes;
    store(codes.data(), vertex.outcode);
    std::array<Outcode, kLanes> narrow;
    for (std::size_t k = 0; k < narrow.size(); ++k) narrow[k] = static_cast<Outcode>(codes[k]);
    std::copy_n(narrow.begin(), rest, outcodes + begin);
    any = any | select(first_lanes<Mask>(rest), vertex.outcode, Int(0));
  }
  Outcode all = 0;
  for (int k = 0; k < kLanes; ++k) all |= static_cast<Outcode>(lane(any, k));
  return all;
}

// Stores clip and cull distances, which are given in rows, and marks vertices with a distance that is NaN or infinite. slot_of(i): slot of
// vertex i.
template <class SlotOf>
Outcode store_distances(const float* rows, int count, SlotOf slot_of, ShadedVertices& out) {
  Outcode any = 0;
  const auto distances = static_cast<std::size_t>(out.distance_count());
  for (int i = 0; i < count; ++i) {
    const std::size_t slot = slot_of(i);
    bool is_finite = true;
    for (std::size_t k = 0; k < distances; ++k) {
      const float distance = rows[k * kVertexBatch + static_cast<std::size_t>(i)];
      is_finite &= std::isfinite(distance);
      out.distances[slot * distances + k] = distance;
    }
    if (!is_finite) any |= out.outcodes[slot] |= kOutNonFinite;
  }
  return any;
}

/// Vertices that are converted at once, so that their attributes stay in the L1 cache and on a small stack.
constexpr int kConvertedBatch = 64;
static_assert(kConvertedBatch % kLanes == 0);

// Converts the rows of the given vertices to streams of floats that start at `values`.
std::span<const VertexStream> convert_streams(std::span<const VertexStream> from, std::span<const uint32_t> vertices, float* values,
                                              StreamStorage& to) {
  for (std::size_t i = 0; i < from.size(); ++i) {
    const bool is_constant = from[i].stride == 0;
    const std::span<const uint32_t> rows = vertices.first(is_constant ? 1 : vertices.size());
    read_rows(from[i], rows, values);
    to[i] = {.data = reinterpret_cast<const std::byte*>(values),
             .stride = is_constant ? 0 : from[i].components * static_cast<int32_t>(sizeof(float)),
             .components = from[i].components,
             .count = rows.size()};
    values += rows.size() * static_cast<std::size_t>(from[i].components);
  }
  return {to.data(), from.size()};
}

// Runs a kernel on streams that are not read in place. Not inlined, because other draws do not need its memory.
__attribute__((noinline)) void run_on_converted(VertexKernel kernel, const void* shader, const VertexBatch& batch) {
  std::array<float, kConvertedBatch * kMaxStreamComponents> values;
  std::array<uint32_t, kConvertedBatch> vertices;
  StreamStorage storage;
  for (int begin = 0; begin < batch.count; begin += kConvertedBatch) {
    VertexBatch part = batch;
    part.count = std::min(kConvertedBatch, batch.count - begin);
    if (part.ids != nullptr) part.ids += begin;
    part.first += static_cast<uint32_t>(begin);
    if (part.clip != nullptr) part.clip += begin;
    if (part.extra != nullptr) part.extra += begin;
    for (uint32_t i = 0; i < static_cast<uint32_t>(part.count); ++i)
      vertices[i] = (part.ids != nullptr ? part.ids[i] : part.first + i) + static_cast<uint32_t>(batch.base_vertex);
    part.streams = convert_streams(batch.streams, std::span(vertices).first(static_cast<std::size_t>(part.count)), values.data(), storage);
    part.is_converted = true;
    kernel(shader, part);
  }
}

void run_kernel(VertexKernel kernel, const Draw& draw, const VertexBatch& batch) {
  if (draw.vertices.needs_conversion) return run_on_converted(kernel, draw.shader.get(), batch);
  kernel(draw.shader.get(), batch);
}

// Runs a kernel for vertices [begin, end) of the list of vertices that the draw uses, and calls f(batch) after each batch. outputs: the
// arrays that the kernel writes; slots: per instance.
template <class F>
void for_each_batch(VertexKernel kernel, const Draw& draw, std::size_t begin, std::size_t end, uint32_t slots, const VertexBatch& outputs,
                    const F& f) {
  const uint32_t first = draw.indices->first_vertex();
  const std::span<const uint32_t> used = draw.indices->used();
  const std::size_t per_instance = draw.indices->used_count();
  StreamStorage storage;
  for (std::size_t b = begin; b < end;) {
    const auto instance = static_cast<uint32_t>(b / per_instance), number = draw.first_instance + instance;
    const std::size_t local = b % per_instance;
    VertexBatch batch = outputs;
    batch.streams = at_instance(draw.vertices, number, storage);
    batch.ids = used.empty() ? nullptr : used.data() + local;
    batch.first = first + static_cast<uint32_t>(local);
    batch.count = static_cast<int>(std::min<std::size_t>(kVertexBatch, std::min(end - b, per_instance - local)));
    batch.slot_base = first - instance * slots;
    batch.base_vertex = draw.state.base_vertex;
    batch.instance = static_cast<int32_t>(number);
    b += static_cast<std::size_t>(batch.count);
    run_kernel(kernel, draw, batch);
    f(batch);
  }
}

// Returns the slot of vertex i of a batch.
std::size_t slot_of(const VertexBatch& batch, int i) {
  return std::size_t{(batch.ids != nullptr ? batch.ids[i] : batch.first + static_cast<uint32_t>(i)) - batch.slot_base};
}

std::size_t slots_of(const Draw& draw) {
  return (draw.indices->end_vertex() - draw.indices->first_vertex()) * std::size_t{draw.state.instances};
}

}  // namespace

Viewport make_viewport(const ViewportRect& r, const DepthState& depth, ClipOrigin origin, bool clips_sides) {
  Viewport v{};
  v.half_width = 0.5f * r.width;
  v.half_height = 0.5f * r.height;
  v.center_x = r.x + v.half_width;
  v.center_y = r.y + v.half_height;
  if (origin == ClipOrigin::upper_left) v.half_height = -v.half_height;
  const float range = depth.range_far - depth.range_near;
  const bool gl = depth.clip == ClipDepth::negative_one_to_one;
  v.depth_scale = gl ? 0.5f * range : range;
  v.depth_bias = gl ? 0.5f * (depth.range_near + depth.range_far) : depth.range_near;
  v.guard_left = (-kGuardBand - v.center_x) / v.half_width;
  v.guard_right = (kGuardBand - v.center_x) / v.half_width;
  v.guard_bottom = (-kGuardBand - v.center_y) / v.half_height;
  v.guard_top = (kGuardBand - v.center_y) / v.half_height;
  if (v.half_height < 0.0f) std::swap(v.guard_bottom, v.guard_top);
  if (clips_sides) {
    v.guard_left = v.guard_bottom = -1.0f;
    v.guard_right = v.guard_top = 1.0f;
  }
  return v;
}

void check_vertex_count(const Draw& draw) {
  HS_CHECK_OP(slots_of(draw), <, std::size_t{1} << 32, "Pass::draw: too many vertices; expected fewer than 2^32 over all instances");
}

std::size_t shaded_bytes(const Draw& draw) {
  const std::size_t n = slots_of(draw);
  const auto floats =
      static_cast<std::size_t>(draw.kernels.varying_count + draw.kernels.clip_distance_count + draw.kernels.cull_distance_count);
  return n * (sizeof(ScreenVertex) + sizeof(Outcode) + floats * sizeof(float) + (draws_points(draw.state) ? sizeof(PointSpriteRect) : 0));
}

void allocate_vertices(const Draw& draw, ShadedVertices& out) {
  out.first = draw.indices->first_vertex();
  out.count = draw.indices->end_vertex() - out.first;
  out.varying_count = draw.kernels.varying_count;
  check_vertex_count(draw);
  const std::size_t n = slots_of(draw);
  out.screen.reset(n);
  out.outcodes.reset(n);
  out.any_outcode = 0;
  out.varyings.reset(n * static_cast<std::size_t>(out.varying_count) + kRowSlack);
  out.clip_distance_count = draw.kernels.clip_distance_count;
  out.cull_distance_count = draw.kernels.cull_distance_count;
  out.distances.reset(n * static_cast<std::size_t>(out.distance_count()));
  out.has_sprites = draws_points(draw.state);
  if (out.has_sprites) out.sprites.reset(n);
}

std::array<glm::vec4, 3> clip_positions(const Draw& draw, uint32_t instance, const std::array<uint32_t, 3>& index) {
  alignas(64) std::array<float, 4 * kVertexBatch> rows;
  StreamStorage storage;
  const uint32_t number = draw.first_instance + instance;
  run_kernel(draw.kernels.vertex, draw,
             {.streams = at_instance(draw.vertices, number, storage),
              .ids = index.data(),
              .count = 3,
              .base_vertex = draw.state.base_vertex,
              .instance = static_cast<int32_t>(number),
              .clip = rows.data()});
  std::array<glm::vec4, 3> out;
  for (std::size_t i = 0; i < 3; ++i) out[i] = {rows[i], rows[kVertexBatch + i], rows[2 * kVertexBatch + i], rows[3 * kVertexBatch + i]};
  return out;
}

Outcode shade_vertices(const Draw& draw, std::size_t begin, std::size_t end, ShadedVertices& out) {
  alignas(64) std::array<float, 4 * kVertexBatch> clip;
  std::array<ScreenVertex, kVertexBatch> screen;
  std::array<Outcode, kVertexBatch> outcodes;
  alignas(64) std::array<float, kMaxExtraRows * kVertexBatch> extra;
  std::array<PointSpriteRect, kVertexBatch> sprites;
  Outcode any = 0;
  const VertexBatch outputs{.varyings = out.varyings.get(), .clip = clip.data(), .extra = extra.data()};
  for_each_batch(draw.kernels.vertex, draw, begin, end, out.count, outputs, [&](const VertexBatch& batch) {
    const int count = batch.count;
    if (batch.ids == nullptr) {
      const std::size_t slot = slot_of(batch, 0);
      ScreenVertex* to = out.screen.get() + slot;
      Outcode* codes = out.outcodes.get() + slot;
      any |= project(draw, clip.data(), count, to, codes);
      if (out.has_sprites) make_point_sprites(draw, clip.data(), extra.data(), count, to, codes, out.sprites.get() + slot);
    } else {
      any |= project(draw, clip.data(), count, screen.data(), outcodes.data());
      if (out.has_sprites) make_point_sprites(draw, clip.data(), extra.data(), count, screen.data(), outcodes.data(), sprites.data());
      for (int i = 0; i < count; ++i) {
        const std::size_t slot = slot_of(batch, i);
        if (out.has_sprites) out.sprites[slot] = sprites[static_cast<std::size_t>(i)];
        out.screen[slot] = screen[static_cast<std::size_t>(i)];
        out.outcodes[slot] = outcodes[static_cast<std::size_t>(i)];
      }
    }
    if (out.distance_count() != 0)
      any |= store_distances(
          extra.data() + kVertexBatch, count, [&](int i) { return slot_of(batch, i); }, out);
  });
  return any;
}

void allocate_clip_vertices(const Draw& draw, int varying_count, ClipVertices& out) {
  out.first = draw.indices->first_vertex();
  out.count = draw.indices->end_vertex() - out.first;
  check_vertex_count(draw);
  const std::size_t n = slots_of(draw);
  out.positions.reset(n);
  out.varyings.reset(n * static_cast<std::size_t>(varying_count) + kRowSlack);
}

void shade_clip_vertices(const Draw& draw, VertexKernel kernel, std::size_t begin, std::size_t end, ClipVertices& out) {
  alignas(64) std::array<float, 4 * kVertexBatch> clip;
  const VertexBatch outputs{.varyings = out.varyings.get(), .clip = clip.data(), .extra = nullptr};
  for_each_batch(kernel, draw, begin, end, out.count, outputs, [&](const VertexBatch& batch) {
    for (int i = 0; i < batch.count; ++i) {
      const float* const p = clip.data() + i;
      out.positions[slot_of(batch, i)] = {p[0], p[kVertexBatch], p[2 * kVertexBatch], p[3 * kVertexBatch]};
    }
  });
}

std::optional<Destination> common_destination(const Draw& draw, VertexKernel kernel, std::size_t begin, std::size_t end, bool has_layers) {
  alignas(64) std::array<float, 2 * kVertexBatch> extra;
  std::optional<Destination> common;
  bool is_common = true;
  for_each_batch(kernel, draw, begin, end, 0, {.varyings = nullptr, .clip = nullptr, .extra = extra.data()}, [&](const VertexBatch& batch) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
      const Destination d{has_layers ? std::bit_cast<int32_t>(extra[i]) : 0, std::bit_cast<int32_t>(extra[kVertexBatch + i])};
      if (!common) common = d;
      is_common &= d == *common;
    }
  });
  return is_common ? common : std::nullopt;
}

}  // namespace halfspace::HS_LANES
