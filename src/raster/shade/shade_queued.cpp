// SPDX-License-Identifier: Apache-2.0
//
// Shades the packets of a PacketQueue.
#include <algorithm>
#include <bit>

#include "halfspace/raster/shade/late_tests.h"
#include "halfspace/raster/visibility/centroid.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

namespace {

// Runs the tests of a packet whose colors are packet i of the output. z: depth of the triangle. Returns the lanes whose color must be
// written.
template <class Shading>
uint16_t finish_queued(const Shading& c, const PacketMask& packet, std::size_t i, Real z, TriangleId id) {
  z = late_depth(c, c.output, i, z);
  const Mask mask = late_tests(c, c.output, i, packet.packet, mask_from_bits<Mask>(packet.lanes), z, id);
  if (!c.draw.state.order_independent) return static_cast<uint16_t>(bits(mask));
  add_to_layers(c, c.output, i, packet.packet, mask, z, id);
  return 0;
}

// Writes packets one by one, so that the color after each of them is known.
template <class Shading>
void write_traced(const Shading& c, std::span<const PacketMask> packets, const TriangleId* ids) {
  for (std::size_t i = 0; i < packets.size(); ++i) {
    write_colors(c.draw, c.output, i, packets.subspan(i, 1), c.tile);
    trace_written(c, packets[i], ids[i]);
  }
}

template <class Shading>
void write_queued(const Shading& c, std::span<const PacketMask> packets, const TriangleId* ids) {
  if constexpr (kTracesShading<Shading>) {
    write_traced(c, packets, ids);
  } else {
    write_colors(c.draw, c.output, 0, packets, c.tile);
  }
}

// Finishes sample s of packets of the queue; see finish_batch().
template <class Shading>
void finish_sample_batch(const Shading& c, PacketQueue& queue, std::size_t begin, std::size_t n, int s) {
  std::array<PacketMask, kPacketBatch> packets;
  for (std::size_t i = 0; i < n; ++i) {
    PacketMask& p = packets[i] = queue.sample(c.tile, begin + i, s);
    if (p.lanes != 0 && c.draw.state.alpha_to_coverage)
      p.lanes = static_cast<uint16_t>(p.lanes & bits(alpha_covers(c.output.packet_color(0, i)[3], c.tile.samples, s)));
    if (p.lanes != 0 && c.mode != VisibilityMode::early)
      p.lanes = finish_queued(c, p, i, queue.sample_depth(c.tile, begin + i, s), queue.ids[begin + i]);
  }
  if (!c.draw.state.order_independent) write_queued(c, std::span(packets).first(n), &queue.ids[begin]);
}

// Runs the late tests of packets that were shaded as packets 0, 1, ... of the output, and writes them. begin: position of the first packet
// in the queue.
template <class Shading>
void finish_batch(const Shading& c, PacketQueue& queue, std::size_t begin, std::size_t n) {
  if (c.tile.samples > 1) {
    for (int s = 0; s < c.tile.samples; ++s) finish_sample_batch(c, queue, begin, n, s);
    return;
  }
  PacketMask* packets = &queue.packets[begin];
  for (std::size_t i = 0; c.mode != VisibilityMode::early && i < n; ++i)
    packets[i].lanes = finish_queued(c, packets[i], i, queue.depth[begin + i], queue.ids[begin + i]);
  if (!c.draw.state.order_independent) write_queued(c, {packets, n}, &queue.ids[begin]);
}

// Records that packet k of the queue was shaded as packet i of the output.
template <class Shading>
void trace_queued(const Shading& c, const PacketQueue& queue, std::size_t k, std::size_t i) {
  if (c.tile.samples == 1) return trace_shaded(c, c.output, i, queue.packets[k], queue.ids[k]);
  for (int s = 0; s < c.tile.samples; ++s) trace_shaded(c, c.output, i, queue.sample(c.tile, k, s), queue.ids[k]);
}

// Returns the buffer into which the kernel can blend the colors of the queue, if no test follows.
template <class Shading>
BlendTarget direct_blend(const Shading& c) {
  const std::optional<BlendState>& blend = blend_of(c.draw.state, 0);
  const bool is_single = c.tile.samples == 1 && c.tile.color_count == 1 && c.draw.kernels.color_count == 1;
  const bool is_supported = !kTracesShading<Shading> && c.mode == VisibilityMode::early && !c.draw.kernels.is_constant;
  if (!is_single || !is_supported || !blend || !color_mask_of(c.draw.state, 0).all()) return {};
  return {blend_programs(c.tile.color[0].format, *blend).packet, &c.tile.color[0], &*blend};
}

// Shades packets of the queue as they are. Returns their number.
template <class Shading>
std::size_t shade_batch(const Shading& c, PacketQueue& queue, std::size_t begin) {
  if (const BlendTarget blend = direct_blend(c); blend.program != nullptr) {
    const std::size_t rest = static_cast<std::size_t>(queue.count) - begin;
    c.draw.kernels.fragment(c.draw.shader.get(), {queue.batch(c.context, c.tile, begin, rest), &c.output, nullptr, blend});
    return rest;
  }
  const std::size_t n = std::min(std::size_t{kPacketBatch}, static_cast<std::size_t>(queue.count) - begin);
  FragmentBatch batch{queue.batch(c.context, c.tile, begin, n), &c.output};
  std::array<SamplePosition, kPacketBatch * kLanes> centroids;
  if (needs_centroids(c.draw, c.tile.samples)) batch.centroids = find_centroids(batch, centroids);
  c.draw.kernels.fragment(c.draw.shader.get(), batch);
  if constexpr (kTracesShading<Shading>) {
    for (std::size_t i = 0; i < n; ++i) trace_queued(c, queue, begin + i, i);
  }
  finish_batch(c, queue, begin, n);
  return n;
}

// Blends the colors of packed pixels into the packets to which they belong.
void blend_packed(const FragmentOutput& packed, std::span<const PacketMask> packets, const BlendTarget& to) {
  std::size_t pixel = 0;
  for (const PacketMask& p : packets) {
    const auto channel = [&](std::size_t c) { return unpack_values(packed.color_plane(0, c), pixel, p.lanes); };
    to.program(*to.buffer, p, *to.state, channel(0), channel(1), channel(2), channel(3));
    pixel += static_cast<std::size_t>(std::popcount(p.lanes));
  }
}

// The same as shade_batch(), but packs the pixels first.
template <class Shading>
std::size_t shade_packed(const Shading& c, PacketQueue& queue, std::size_t begin, PackedFragments& packed) {
  const std::span<const PacketMask> packets(&queue.packets[begin], static_cast<std::size_t>(queue.count) - begin);
  const std::size_t count = pack(packets, &queue.ids[begin], packed.pixels);
  c.draw.kernels.fragment(c.draw.shader.get(), {packed.pixels.batch(c.context, c.tile), &packed.output});
  if (const BlendTarget blend = direct_blend(c); blend.program != nullptr) {
    blend_packed(packed.output, packets.first(count), blend);
    return count;
  }
  for (std::size_t done = 0, pixel = 0; done < count;) {
    const std::size_t n = std::min(std::size_t{kPacketBatch}, count - done);
    pixel = unpack(c.draw.kernels, packed.output, pixel, packets.subspan(done, n), c.output);
    finish_batch(c, queue, begin + done, n);
    done += n;
  }
  return count;
}

}  // namespace

template <class Statistics>
void shade_queued(const DrawInTile& d, PacketQueue& queue, TransparentLayers& layers, FragmentOutput& output, PackedFragments& packed,
                  Statistics& statistics) {
  const ImmediateShading<Statistics> c{d.context, d.draw, d.mode, d.tile, layers, output, nullptr, true, statistics};
  const auto count = static_cast<std::size_t>(queue.count);
  const std::span<const PacketMask> packets = std::span(queue.packets).first(count);
  statistics.fragments_shaded += pixel_count(packets);
  const bool packs = !kTraces<Statistics> && packs_queue(d.draw, d.tile, packets);
  for (std::size_t begin = 0; begin < count;) begin += packs ? shade_packed(c, queue, begin, packed) : shade_batch(c, queue, begin);
  queue.count = 0;
}
template void shade_queued(const DrawInTile&, PacketQueue&, TransparentLayers&, FragmentOutput&, PackedFragments&, PassStatistics&);
template void shade_queued(const DrawInTile&, PacketQueue&, TransparentLayers&, FragmentOutput&, PackedFragments&, TracedStatistics&);

}  // namespace halfspace::inline HS_LANES_NAMESPACE
