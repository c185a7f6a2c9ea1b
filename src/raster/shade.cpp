// SPDX-License-Identifier: Apache-2.0
#include "raster/shade.h"

#include <algorithm>

#include "raster/output.h"

namespace halfspace {

TriangleSource find_triangle(const Frame& frame, TriangleId id) {
  const Chunk& chunk = frame.chunks[id >> 16];
  const uint32_t index = id & 0xffff;
  const Triangle& t = chunk.triangles[index];
  const Segment& segment = chunk.segments[t.segment()];
  const Draw& draw = frame.draws[segment.draw];
  TriangleSource s{&t, {}, {}, nullptr, nullptr};
  if (t.is(kClipped)) {
    for (std::size_t i = 0; i < 3; ++i) {
      const ClipVertex& v = chunk.clip_vertices[t.vertex[i]];
      s.vertex[i] = &v.screen;
      s.varyings[i] = chunk.clip_varyings.data() + v.first_varying;
    }
  } else {
    const ShadedVertices& shaded = frame.shaded[segment.draw];
    for (std::size_t i = 0; i < 3; ++i) {
      s.vertex[i] = &shaded.screen[t.vertex[i]];
      s.varyings[i] = shaded.varyings.get() + std::size_t{t.vertex[i]} * static_cast<std::size_t>(shaded.varying_count);
    }
  }
  s.flat_varyings = s.varyings[t.provoking()];
  if (draw.kernels.primitive_count != 0) {
    const std::size_t row = index - segment.first_triangle;
    s.primitive = chunk.primitives.data() + segment.first_primitive + row * static_cast<std::size_t>(draw.kernels.primitive_count);
  }
  return s;
}

namespace {

const Draw& draw_of(const Frame& frame, TriangleId id) {
  const Chunk& chunk = frame.chunks[id >> 16];
  return frame.draws[chunk.segments[chunk.triangles[id & 0xffff].segment()].draw];
}

const BlendState* blend_of(const Draw& draw) { return draw.state.blend ? &*draw.state.blend : nullptr; }

// One packet's pixels of one draw.
struct Work {
  const Draw* draw;
  PacketMask packet;
};

// The pixels that wait, packet by packet; a packet that shows several draws appears once for each.
int list_work(const Frame& frame, const Tile& tile, std::array<Work, kMaxTilePixels>& work) {
  int count = 0;
  for (int p = 0; p < kPackets; ++p) {
    const TriangleId* ids = &tile.id[static_cast<std::size_t>(p) * kLanes];
    const Int packet_ids = load<Int>(ids);
    uint32_t rest = bits(packet_ids != Int(std::bit_cast<int32_t>(kNoTriangle)));
    const int first = count;
    while (rest != 0) {
      const TriangleId id = ids[std::countr_zero(rest)];
      const uint32_t same = bits(packet_ids == Int(std::bit_cast<int32_t>(id)));
      const Draw* draw = &draw_of(frame, id);
      int i = first;
      while (i < count && work[static_cast<std::size_t>(i)].draw != draw) ++i;
      if (i == count) work[static_cast<std::size_t>(count++)] = {draw, {static_cast<uint16_t>(p), 0}};
      Work& w = work[static_cast<std::size_t>(i)];
      w.packet.lanes = static_cast<uint16_t>(w.packet.lanes | same);
      rest &= ~same;
    }
  }
  return count;
}

}  // namespace

void shade_deferred(const Frame& frame, Tile& tile, PassStatistics& statistics) {
  std::array<Work, kMaxTilePixels> work;
  const int count = list_work(frame, tile, work);
  // By draw, so that each shader runs on full batches; pixels are independent, so the order makes no difference.
  std::stable_sort(work.begin(), work.begin() + count, [](const Work& a, const Work& b) { return a.draw < b.draw; });
  FragmentOutput out;
  std::array<PacketMask, kFragmentBatch> packets;
  for (int begin = 0; begin < count;) {
    const Draw& draw = *work[static_cast<std::size_t>(begin)].draw;
    int n = 0;
    while (n < kFragmentBatch && begin + n < count && work[static_cast<std::size_t>(begin + n)].draw == &draw) {
      packets[static_cast<std::size_t>(n)] = work[static_cast<std::size_t>(begin + n)].packet;
      statistics.fragments_shaded += static_cast<uint64_t>(std::popcount(packets[static_cast<std::size_t>(n)].lanes));
      ++n;
    }
    draw.kernels.fragment(draw.shader.get(), {&frame, tile.x0, tile.y0, tile.id.data(), kNoTriangle, packets.data(), n, &out});
    for (int i = 0; i < n; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const PacketColor color{out.color[4 * at], out.color[4 * at + 1], out.color[4 * at + 2], out.color[4 * at + 3]};
      write_color(tile.color, packets[at].packet, mask_from_bits<Mask>(packets[at].lanes), color, blend_of(draw));
    }
    begin += n;
  }
  tile.id.fill(kNoTriangle);
}

void shade_immediate(const Frame& frame, TriangleId id, VisibilityMode mode, const CoverageList& list, Tile& tile,
                     PassStatistics& statistics) {
  const Draw& draw = draw_of(frame, id);
  const DepthState& state = draw.state.depth;
  FragmentOutput out;
  for (int begin = 0; begin < list.count; begin += kFragmentBatch) {
    const PacketMask* packets = &list.packets[static_cast<std::size_t>(begin)];
    const int n = std::min(kFragmentBatch, list.count - begin);
    draw.kernels.fragment(draw.shader.get(), {&frame, tile.x0, tile.y0, nullptr, id, packets, n, &out});
    for (int i = 0; i < n; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const int packet = packets[i].packet;
      statistics.fragments_shaded += static_cast<uint64_t>(std::popcount(packets[i].lanes));
      Mask mask = mask_from_bits<Mask>(packets[i].lanes);
      if (mode != VisibilityMode::early) {
        Real z(0.0f);
        if (mode == VisibilityMode::cover_only) {
          z = depth_value(tile.depth_format, clamp(out.depth[at], Real(draw.depth_low), Real(draw.depth_high)));
          mask = depth_test(state, tile, packet, z, mask);
        } else {
          z = load<Real>(&list.depth[static_cast<std::size_t>(packet) * kLanes]);
        }
        mask = mask & mask_from_bits<Mask>(out.keep[at]);
        statistics.samples_passed += static_cast<uint64_t>(std::popcount(bits(mask)));
        write_depth(state, tile, packet, z, mask);
      }
      const PacketColor color{out.color[4 * at], out.color[4 * at + 1], out.color[4 * at + 2], out.color[4 * at + 3]};
      if (tile.color.format != ColorFormat::none) write_color(tile.color, packet, mask, color, blend_of(draw));
    }
  }
}

}  // namespace halfspace
