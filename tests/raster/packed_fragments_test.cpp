// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/shade/packed_fragments.h"

#include <gtest/gtest.h>

#include <bit>
#include <memory>
#include <random>
#include <vector>

#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/tile/tile.h"

namespace halfspace {
namespace {

struct Packets {
  std::vector<PacketMask> packets;
  std::vector<TriangleId> ids;
};

// Returns packets with about an eighth of their lanes covered, but at least one.
Packets sparse_packets(std::mt19937& random, std::size_t count) {
  Packets p;
  for (std::size_t i = 0; i < count; ++i) {
    const uint32_t lanes = (random() & random() & random() & kAllBits<Mask>) | 1u << random() % kLanes;
    p.packets.push_back({static_cast<uint16_t>(random() % kPackets), static_cast<uint16_t>(lanes)});
    p.ids.push_back(static_cast<TriangleId>(random() >> 1));
  }
  return p;
}

int32_t position(const PacketMask& packet, int lane_number) {
  return (packet_y(packet.packet) + lane(lane_y(), lane_number)) << 16 | (packet_x(packet.packet) + lane(lane_x(), lane_number));
}

TEST(PackedPixels, KeepTheOrderPixelsAndTrianglesOfPackets) {
  if (kLanes == 1) GTEST_SKIP() << "a packet of one lane is always full";
  std::mt19937 random(1);
  const auto packed = std::make_unique<PackedPixels>();
  for (int round = 0; round < 100; ++round) {
    const Packets p = sparse_packets(random, 8 + random() % 90);
    const std::size_t taken = pack(p.packets, p.ids.data(), *packed);
    ASSERT_NE(taken, 0u);
    std::size_t n = 0;
    for (std::size_t i = 0; i < taken; ++i) {
      for (uint32_t rest = p.packets[i].lanes; rest != 0; rest &= rest - 1, ++n) {
        ASSERT_EQ(packed->pixels[n], position(p.packets[i], std::countr_zero(rest)));
        ASSERT_EQ(packed->ids[n], p.ids[i]);
      }
    }
    ASSERT_EQ(packed->count, n);
    const bool has_next = taken < p.packets.size();
    ASSERT_TRUE(!has_next || n + static_cast<std::size_t>(std::popcount(p.packets[taken].lanes)) > PackedPixels::kCapacity);
    std::size_t lanes = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(packed->packet_count()); ++i) {
      ASSERT_EQ(packed->packets[i].packet, i);
      lanes += static_cast<std::size_t>(std::popcount(packed->packets[i].lanes));
    }
    ASSERT_EQ(lanes, n);
  }
}

TEST(PackedFragments, ReturnResultsToTheirLanes) {
  if (kLanes == 1) GTEST_SKIP() << "a packet of one lane is always full";
  std::mt19937 random(2);
  const auto packed = std::make_unique<PackedFragments>();
  const auto out = std::make_unique<FragmentOutput>();
  ShaderKernels kernels;
  kernels.color_count = 2;
  kernels.discards = kernels.writes_depth = true;
  const Packets p = sparse_packets(random, 60);
  const std::size_t taken = pack(p.packets, p.ids.data(), packed->pixels);
  ASSERT_NE(taken, 0u);
  // The result of fragment n: component c of color k is n + 1000 c + 10000 k, the depth is n, and every third fragment is kept.
  packed->output.keep.fill(0);
  for (std::size_t n = 0; n < packed->pixels.count; ++n) {
    for (std::size_t k = 0; k < 2; ++k) {
      for (std::size_t c = 0; c < 4; ++c) packed->output.color_plane(k, c)[n] = static_cast<float>(n + 1000 * c + 10000 * k);
    }
    set_lane(packed->output.depth[n / kLanes], static_cast<int>(n % kLanes), static_cast<float>(n));
    if (n % 3 == 0) packed->output.keep[n / kLanes] = static_cast<uint16_t>(packed->output.keep[n / kLanes] | 1u << n % kLanes);
  }
  std::size_t n = 0;
  for (std::size_t begin = 0, first = 0; begin < taken; begin += kPacketBatch) {
    const auto some = std::span(p.packets).subspan(begin, std::min(std::size_t{kPacketBatch}, taken - begin));
    first = unpack(kernels, packed->output, first, some, *out);
    for (std::size_t i = 0; i < some.size(); ++i) {
      for (uint32_t rest = some[i].lanes; rest != 0; rest &= rest - 1, ++n) {
        const int at = std::countr_zero(rest);
        for (std::size_t k = 0; k < 2; ++k) {
          for (std::size_t c = 0; c < 4; ++c) ASSERT_EQ(lane(out->packet_color(k, i)[c], at), static_cast<float>(n + 1000 * c + 10000 * k));
        }
        ASSERT_EQ(lane(out->depth[i], at), static_cast<float>(n));
        ASSERT_EQ((out->keep[i] >> at & 1) != 0, n % 3 == 0);
      }
    }
    ASSERT_EQ(first, n);
  }
}

TEST(PackedPixels, AreUsedWhereTheySaveAQuarterOfThePackets) {
  if (kLanes == 1) GTEST_SKIP() << "a packet of one lane is always full";
  std::vector<PacketMask> packets(4, PacketMask{0, static_cast<uint16_t>(kAllBits<Mask>)});
  EXPECT_FALSE(pays_to_pack(packets));
  packets[0].lanes = 1;  // with this packet, three full packets plus one lane still need four packets
  EXPECT_FALSE(pays_to_pack(packets));
  packets[1].lanes = 1;
  EXPECT_TRUE(pays_to_pack(packets));
}

TEST(PackedPixels, AreNotUsedInQueuesOfPointsOrForConstantOrCentroidShaders) {
  if (kLanes == 1) GTEST_SKIP() << "a packet of one lane is always full";
  ShaderKernels kernels;
  DrawState state;
  Draw draw(kernels, KeptShader(nullptr, [](const void*) {}), nullptr, {}, state, {});
  const auto tile = std::make_unique<Tile>();
  const std::vector<PacketMask> packets(4, PacketMask{0, 1});
  EXPECT_TRUE(packs_queue(draw, *tile, packets));
  state.topology = Topology::points;
  EXPECT_FALSE(packs_queue(draw, *tile, packets));
  EXPECT_TRUE(can_pack(draw, *tile));
  kernels.uses_centroid = true;
  EXPECT_TRUE(can_pack(draw, *tile));
  tile->samples = 4;
  EXPECT_FALSE(can_pack(draw, *tile));
  kernels.uses_centroid = false;
  kernels.is_constant = true;
  EXPECT_FALSE(can_pack(draw, *tile));
}

}  // namespace
}  // namespace halfspace
