// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/shade/shade_queued.h"

#include <algorithm>
#include <bit>

#include "halfspace/raster/shade/late_tests.h"
#include "halfspace/raster/visibility/coverage/smooth.h"
#include "halfspace/raster/visibility/sink/centroid.h"

namespace halfspace::HS_LANES {

namespace {

// Runs the tests of a packet whose colors are packet i of the output. z: depth of the triangle. Returns the lanes whose color must be
// written.
uint16_t finish_queued(const QueuedShading& c, const PacketMask& packet, std::size_t i, Real z, TriangleId id) {
  const Mask lanes = mask_from_bits<Mask>(packet.lanes);
  z = late_depth(c, c.output, i, z, lanes);
  const Mask mask = late_tests(c, c.output, i, packet.packet, lanes, z, id);
  if (!c.d.draw.state.order_independent) return static_cast<uint16_t>(bits(mask));
  add_to_layers(c, c.output, i, packet.packet, mask, z, id);
  return 0;
}

// Writes packets one by one, so that the color after each of them is known.
void write_traced(const QueuedShading& c, std::span<const PacketMask> packets, const TriangleId* ids) {
  for (std::size_t i = 0; i < packets.size(); ++i) {
    write_colors(c.d.draw, c.output, i, packets.subspan(i, 1), c.d.tile);
    trace_written(c, packets[i], ids[i]);
  }
}

void write_queued(const QueuedShading& c, std::span<const PacketMask> packets, const TriangleId* ids) {
  if (c.d.trace != nullptr) {
    write_traced(c, packets, ids);
  } else {
    write_colors(c.d.draw, c.output, 0, packets, c.d.tile);
  }
}

// Finishes sample s of n packets, which are `packets` in the tile's storage and were shaded as packets 0, 1, ... of the output. index(i):
// number of packet i in the queue; ids: triangles of the packets.
template <class Index>
void finish_sample(const QueuedShading& c, PacketQueue& queue, std::span<PacketMask> packets, const TriangleId* ids, int s,
                   const Index& index) {
  for (std::size_t i = 0; i < packets.size(); ++i) {
    PacketMask& p = packets[i];
    if (p.lanes != 0 && c.d.draw.covers_by_alpha)
      p.lanes = static_cast<uint16_t>(p.lanes & bits(alpha_covers(c.output.packet_color(0, i)[3], c.d.tile.samples, s)));
    if (p.lanes != 0 && c.d.draw.covers_by_shader)
      p.lanes = static_cast<uint16_t>(p.lanes & bits(((c.output.sample_mask[i] >> s) & Int(1)) == Int(1)));
    if (p.lanes == 0) continue;
    if (c.d.mode == VisibilityMode::early) {
      if (c.d.draw.kernels.discards) p.lanes &= c.output.keep[i];
    } else {
      p.lanes = finish_queued(c, p, i, queue.sample_depth(c.d.tile, index(i), s), ids[i]);
    }
  }
  if (!c.d.draw.state.order_independent) write_queued(c, std::span<const PacketMask>(packets), ids);
}

// The same for n packets of the queue that were shaded once for all samples. begin: number of the first packet.
void finish_sample_of_pixels(const QueuedShading& c, PacketQueue& queue, std::size_t begin, std::size_t n, int s) {
  std::array<PacketMask, kPacketBatch> packets;
  for (std::size_t i = 0; i < n; ++i) packets[i] = queue.sample(c.d.tile, begin + i, s);
  finish_sample(c, queue, std::span(packets).first(n), &queue.ids[begin], s, [begin](std::size_t i) { return begin + i; });
}

// Returns the buffer to which the colors of the queue can be written directly, if no test follows the shader.
WriteTarget queue_target(const QueuedShading& c) {
  const bool is_single = c.d.tile.color_count == 1 && c.d.draw.kernels.color_count == 1;
  const Draw& draw = c.d.draw;
  if (draw.state.logic_op || draw.sets_alpha_to_one || draw.covers_by_alpha || draw.covers_by_shader || draw.kernels.discards ||
      draw.is_smooth)
    return {};
  const bool is_supported = c.d.trace == nullptr && c.d.mode == VisibilityMode::early && !c.d.draw.kernels.is_constant;
  if (!is_single || !is_supported) return {};
  const AttachmentState state{blend_of(c.d.draw.state, 0), color_mask_of(c.d.draw.state, 0)};
  return {write_program(c.d.tile.color[0].format, state), &c.d.tile.color[0], state};
}

// Writes the samples of n packets of the queue, which were shaded as packets 0, 1, ... of the output.
void write_sampled_packets(const Tile& tile, const FragmentOutput& output, const PacketQueue& queue, std::size_t begin, std::size_t n,
                           const WriteTarget& to) {
  std::array<int, kMaxSamples> shift;
  for (int s = 0; s < tile.samples; ++s) shift[static_cast<std::size_t>(s)] = packet_shift(sample_plane(tile.samples, s, tile.size));
  for (std::size_t i = 0; i < n; ++i) {
    const auto [r, g, b, a] = output.packet_color(0, i);
    for (std::size_t s = 0; s < static_cast<std::size_t>(tile.samples); ++s) {
      const uint16_t lanes = queue.sample_lanes[begin + i][s];
      const auto packet = static_cast<uint16_t>(queue.packets[begin + i].packet + shift[s]);
      if (lanes != 0) to.write({packet, lanes}, r, g, b, a);
    }
  }
}

// Multiplies the alpha of n packets of the queue, which were shaded as packets 0, 1, ... of the output, by the area that they cover.
void apply_areas(const QueuedShading& c, const PacketQueue& queue, std::size_t begin, std::size_t n) {
  const ShaderKernels& kernels = c.d.draw.kernels;
  for (std::size_t i = 0; i < n; ++i) {
    const SmoothArea area(c.d.draw, triangle_of(c.d.context, queue.ids[begin + i]));
    const Real covered = areas_in_packet(area, c.d.tile, queue.packets[begin + i]);
    for (std::size_t k = 0; k < static_cast<std::size_t>(kernels.color_count); ++k) {
      if (kernels.color_types[k] == ColorType::real) c.output.packet_color(k, i)[3] = c.output.packet_color(k, i)[3] * covered;
    }
  }
}

// Runs the late tests of packets that were shaded as packets 0, 1, ... of the output, and writes them. begin: position of the first packet
// in the queue; target: see queue_target().
void finish_batch(const QueuedShading& c, PacketQueue& queue, std::size_t begin, std::size_t n, const WriteTarget& target) {
  if (c.d.tile.samples > 1) {
    if (target.program != nullptr) return write_sampled_packets(c.d.tile, c.output, queue, begin, n, target);
    for (int s = 0; s < c.d.tile.samples; ++s) finish_sample_of_pixels(c, queue, begin, n, s);
    return;
  }
  PacketMask* packets = &queue.packets[begin];
  if (c.d.draw.is_smooth) apply_areas(c, queue, begin, n);
  if (c.d.mode != VisibilityMode::early) {
    for (std::size_t i = 0; i < n; ++i) packets[i].lanes = finish_queued(c, packets[i], i, queue.depth[begin + i], queue.ids[begin + i]);
  } else if (c.d.draw.kernels.discards) {
    for (std::size_t i = 0; i < n; ++i) packets[i].lanes &= c.output.keep[i];
  }
  if (!c.d.draw.state.order_independent) write_queued(c, {packets, n}, &queue.ids[begin]);
}

// Records that packet k of the queue was shaded as packet i of the output.
void trace_queued(const QueuedShading& c, const PacketQueue& queue, std::size_t k, std::size_t i) {
  if (c.d.tile.samples == 1) return trace_shaded(c, c.output, i, queue.packets[k], queue.ids[k]);
  for (int s = 0; s < c.d.tile.samples; ++s) trace_shaded(c, c.output, i, queue.sample(c.d.tile, k, s), queue.ids[k]);
}

// Shades packets of the queue as they are. Returns their number.
std::size_t shade_batch(const QueuedShading& c, PacketQueue& queue, std::size_t begin, const WriteTarget& target) {
  if (c.d.tile.samples == 1 && target.program != nullptr) {
    const std::size_t rest = static_cast<std::size_t>(queue.count) - begin;
    c.d.draw.kernels.fragment(c.d.draw.shader.get(), {queue.batch(c.d.context, c.d.tile, begin, rest), &c.output, nullptr, target});
    return rest;
  }
  const std::size_t n = std::min(std::size_t{kPacketBatch}, static_cast<std::size_t>(queue.count) - begin);
  FragmentBatch batch{queue.batch(c.d.context, c.d.tile, begin, n), &c.output};
  std::array<SamplePosition, kPacketBatch * kLanes> centroids;
  if (needs_centroids(c.d.draw, c.d.tile.samples)) batch.centroids = find_centroids(batch, centroids);
  c.d.draw.kernels.fragment(c.d.draw.shader.get(), batch);
  if (c.d.trace != nullptr) {
    for (std::size_t i = 0; i < n; ++i) trace_queued(c, queue, begin + i, i);
  }
  finish_batch(c, queue, begin, n, target);
  return n;
}

// The same as shade_batch(), but packs the pixels first.
std::size_t shade_packed(const QueuedShading& c, PacketQueue& queue, std::size_t begin, PackedFragments& packed,
                         const WriteTarget& target) {
  const std::span<const PacketMask> packets(&queue.packets[begin], static_cast<std::size_t>(queue.count) - begin);
  const std::size_t count = pack(packets, &queue.ids[begin], packed.pixels);
  c.d.draw.kernels.fragment(c.d.draw.shader.get(), {packed.pixels.batch(c.d.context, c.d.tile), &packed.output});
  if (c.d.tile.samples == 1 && target.program != nullptr) {
    write_packed(packed.output, packets.first(count), target);
    return count;
  }
  for (std::size_t done = 0, pixel = 0; done < count;) {
    const std::size_t n = std::min(std::size_t{kPacketBatch}, count - done);
    pixel = unpack(c.d.draw.kernels, packed.output, pixel, packets.subspan(done, n), c.output);
    finish_batch(c, queue, begin + done, n, target);
    done += n;
  }
  return count;
}

// Shades each covered sample of the queue separately. The order of the packets of one sample is kept; samples do not affect each other.
void shade_each_sample(const QueuedShading& c, PacketQueue& queue) {
  for (int s = 0; s < c.d.tile.samples; ++s) {
    const QueuedSample sample(c.d.context, c.d.tile, queue, s);
    c.statistics.fragments_shaded += pixel_count(sample.packets());
    for (std::size_t begin = 0; begin < sample.count(); begin += kPacketBatch) {
      const std::size_t n = std::min(std::size_t{kPacketBatch}, sample.count() - begin);
      c.d.draw.kernels.fragment(c.d.draw.shader.get(), {sample.batch(begin, n), &c.output});
      std::array<PacketMask, kPacketBatch> packets;
      std::ranges::copy(sample.packets().subspan(begin, n), packets.begin());
      if (c.d.trace != nullptr) {
        for (std::size_t i = 0; i < n; ++i) trace_shaded(c, c.output, i, packets[i], sample.ids()[begin + i]);
      }
      finish_sample(c, queue, std::span(packets).first(n), sample.ids() + begin, s, [&](std::size_t i) { return sample.index(begin + i); });
    }
  }
}

// Shades each pixel of the queue once.
void shade_each_pixel(const QueuedShading& c, PacketQueue& queue, PackedFragments& packed) {
  const auto count = static_cast<std::size_t>(queue.count);
  const std::span<const PacketMask> packets = std::span(queue.packets).first(count);
  c.statistics.fragments_shaded += pixel_count(packets);
  const bool packs = c.d.trace == nullptr && packs_queue(c.d.draw, c.d.tile, packets);
  const WriteTarget target = queue_target(c);
  for (std::size_t begin = 0; begin < count;)
    begin += packs ? shade_packed(c, queue, begin, packed, target) : shade_batch(c, queue, begin, target);
}

}  // namespace

void shade_queued(const DrawInTile& d, PacketQueue& queue, TransparentLayers& layers, FragmentOutput& output, PackedFragments& packed,
                  PassStatistics& statistics) {
  const QueuedShading c{d, layers, output, statistics};
  if (d.tile.samples > 1 && d.draw.shades_samples) {
    shade_each_sample(c, queue);
  } else {
    shade_each_pixel(c, queue, packed);
  }
  queue.count = 0;
}

}  // namespace halfspace::HS_LANES
