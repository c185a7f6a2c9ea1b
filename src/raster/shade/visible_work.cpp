// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/shade/visible_work.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <limits>

#include "halfspace/core/lane_pairs.h"

namespace halfspace::HS_LANES {

namespace {

constexpr int32_t kNoneInLane = std::bit_cast<int32_t>(kNoTriangle);

bool is_in_cell(const Tile& tile, int packet) { return packet_x(packet) < tile.size && packet_y(packet) < tile.size; }

// A draw and the ids of its triangles. No other draw has ids in between.
struct FoundDraw {
  // Returns the lanes that show the draw.
  HS_INLINE uint32_t lanes(Int packet_ids) const {
    constexpr int32_t sign_bit = std::numeric_limits<int32_t>::min();
    // Comparing unsigned integers: flipping the sign bits of both keeps their order as signed integers.
    const Int offset = detail::wrapping(packet_ids, Int(std::bit_cast<int32_t>(ids.first)), std::minus<>()) ^ sign_bit;
    return bits(offset < Int(std::bit_cast<int32_t>(ids.count) ^ sign_bit));
  }

  const Draw* draw = nullptr;
  TriangleIds ids{};
  bool is_listed = false;
};

// Adds entries to a work list.
class WorkWriter {
 public:
  WorkWriter(const PassContext& context, ShadingFrequency frequency, ShadingWorkList& work)
      : context_(context), frequency_(frequency), work_(work) {}

  // Lists the pixels of a packet by draw. ids: the triangle of each pixel.
  HS_INLINE void add(int packet, const TriangleId* ids) {
    const Int packet_ids = load<Int>(ids);
    uint32_t rest = bits(packet_ids != Int(kNoneInLane));
    if (rest == 0) return;
    // Most tiles show a single draw.
    if (lookups_ == 1 && (found_[0].lanes(packet_ids) & rest) == rest) return add(packet, found_[0], rest);
    rest = add_found(packet, packet_ids, rest);
    while (rest != 0) {
      FoundDraw& found = found_[lookups_++ % kFound];
      found = find(ids[std::countr_zero(rest)]);
      const uint32_t same = found.lanes(packet_ids);
      add(packet, found, same);
      rest &= ~same;
    }
  }

  std::span<ShadingWork> entries() const { return std::span(work_).first(count_); }

 private:
  HS_INLINE void add(int packet, const FoundDraw& found, uint32_t lanes) {
    work_[count_] = {found.draw, {static_cast<uint16_t>(packet), static_cast<uint16_t>(lanes)}};
    count_ += found.is_listed && lanes != 0 ? 1 : 0;
  }

  // Adds the lanes of `rest` whose draw was found before, and returns the others.
  HS_INLINE uint32_t add_found(int packet, Int packet_ids, uint32_t rest) {
    for (const FoundDraw& found : found_) {
      const uint32_t same = found.lanes(packet_ids) & rest;
      if (same == 0) continue;
      add(packet, found, same);
      rest &= ~same;
      if (rest == 0) break;
    }
    return rest;
  }

  FoundDraw find(TriangleId id) const {
    const Draw& draw = draw_of(context_, id);
    const auto index = static_cast<std::size_t>(&draw - context_.draws.data());
    return {&draw, context_.triangle_ids[index], draw.shades_samples == (frequency_ == ShadingFrequency::per_sample)};
  }

  const PassContext& context_;
  ShadingFrequency frequency_;
  ShadingWorkList& work_;
  static constexpr std::size_t kFound = 4;
  std::array<FoundDraw, kFound> found_{};  // the last lookups
  std::size_t lookups_ = 0;                // number of lookups; the next one replaces entry lookups_ % kFound
  std::size_t count_ = 0;
};

// Returns the lanes whose triangle is shaded per pixel. lanes: the lanes that are covered by a triangle.
uint32_t shaded_per_pixel(const PassContext& context, const TriangleId* ids, uint32_t lanes) {
  const Int packet_ids = load<Int>(ids);
  uint32_t result = 0;
  for (uint32_t rest = lanes; rest != 0;) {
    const TriangleId id = ids[std::countr_zero(rest)];
    const uint32_t same = bits(packet_ids == Int(std::bit_cast<int32_t>(id)));
    if (!draw_of(context, id).shades_samples) result |= same & lanes;
    rest &= ~same;
  }
  return result;
}

// The triangles in the samples of a packet of pixels.
class PacketSamples {
 public:
  PacketSamples(const PassContext& context, const Tile& tile, int packet, bool may_shade_samples)
      : context_(context), samples_(static_cast<std::size_t>(tile.samples)), may_shade_samples_(may_shade_samples) {
    for (std::size_t s = 0; s < samples_; ++s) {
      const int sample_packet = packet + packet_shift(sample_plane(tile.samples, static_cast<int>(s), tile.size));
      at_[s] = &tile.visibility[static_cast<std::size_t>(sample_packet) * kLanes];
    }
  }

  // Returns true if, in every pixel, all samples show the same triangle or none, and all triangles are shaded per pixel.
  bool agree() const {
    const Int first = load<Int>(at_[0]);
    Mask same(true);
    for (std::size_t s = 1; s < samples_; ++s) same = same & (load<Int>(at_[s]) == first);
    if (!all(same)) return false;
    const uint32_t shown = bits(first != Int(kNoneInLane));
    return !may_shade_samples_ || shaded_per_pixel(context_, at_[0], shown) == shown;
  }

  // Selects, for each pixel, one triangle that was not selected before, in the order of the samples.
  Int next() {
    Int chosen(kNoneInLane);
    for (std::size_t s = 0; s < samples_; ++s) {
      const Int ids = load<Int>(at_[s]);
      const Mask open = !mask_from_bits<Mask>(taken_[s]), is_empty = ids == Int(kNoneInLane);
      Mask may_start = chosen == Int(kNoneInLane);
      if (may_shade_samples_) may_start = may_start & mask_from_bits<Mask>(shaded_per_pixel(context_, at_[s], bits(open & !is_empty)));
      const Mask selected = open & !is_empty & (may_start | (ids == chosen));
      chosen = select(selected, ids, chosen);
      taken_[s] |= bits(selected | (open & is_empty));
    }
    return chosen;
  }

 private:
  const PassContext& context_;
  std::size_t samples_;
  bool may_shade_samples_;  // false: no draw of the pass runs its fragment function per sample
  std::array<const TriangleId*, kMaxSamples> at_{};
  std::array<uint32_t, kMaxSamples> taken_{};  // lanes that were selected or show no triangle
};

}  // namespace

std::span<ShadingWork> list_work(const PassContext& context, const Tile& tile, const TriangleId* ids, const SamplePlane& plane,
                                 ShadingFrequency frequency, ShadingWorkList& work) {
  WorkWriter writer(context, frequency, work);
  const bool whole = tile.size == kMaxTileSize;
  const int shift = packet_shift(plane);
  for (int pixels = 0; pixels < kPackets; ++pixels) {
    if (!whole && !is_in_cell(tile, pixels)) continue;
    writer.add(pixels + shift, ids + static_cast<std::size_t>(pixels + shift) * kLanes);
  }
  return writer.entries();
}

bool may_shade_samples(const PassContext& context) {
  constexpr std::size_t max_searched = 64;
  return context.draws.size() > max_searched || std::ranges::any_of(context.draws, &Draw::shades_samples);
}

std::span<ShadingWork> list_distinct(const PassContext& context, const Tile& tile, std::array<TriangleId, kMaxTilePixels>& distinct,
                                     ShadingWorkList& work) {
  const bool per_sample = may_shade_samples(context);
  WorkWriter writer(context, ShadingFrequency::per_pixel, work);
  for (int packet = 0; packet < kPackets; ++packet) {
    if (!is_in_cell(tile, packet)) continue;
    PacketSamples samples(context, tile, packet, per_sample);
    if (samples.agree()) {
      const std::size_t first = static_cast<std::size_t>(packet) * kLanes;
      store(&distinct[first], load<Int>(&tile.visibility[first]));
      writer.add(packet, &distinct[first]);
      continue;
    }
    for (int n = 0; n < tile.samples; ++n) {
      const Int chosen = samples.next();
      if (!any(chosen != Int(kNoneInLane))) break;
      const int to = packet + packet_shift(sample_plane(tile.samples, n, tile.size));
      store(&distinct[static_cast<std::size_t>(to) * kLanes], chosen);
      writer.add(to, &distinct[static_cast<std::size_t>(to) * kLanes]);
    }
  }
  return writer.entries();
}

std::size_t take_draw(std::span<ShadingWork>& work, std::span<PacketMask> packets) {
  const Draw* draw = work.front().draw;
  std::size_t taken = 0, kept = 0;
  for (const ShadingWork w : work) {  // without a branch, because neighboring packets often show different draws
    packets[taken] = w.packet;
    work[kept] = w;
    taken += w.draw == draw ? 1 : 0;
    kept += w.draw == draw ? 0 : 1;
  }
  work = work.first(kept);
  return taken;
}

std::size_t take_sorted_draw(std::span<ShadingWork>& work, std::span<PacketMask> packets) {
  const Draw* draw = work.front().draw;
  std::size_t taken = 0;
  for (; taken < work.size() && work[taken].draw == draw; ++taken) packets[taken] = work[taken].packet;
  work = work.subspan(taken);
  return taken;
}

}  // namespace halfspace::HS_LANES
