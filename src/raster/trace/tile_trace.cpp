// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/trace/tile_trace.h"

#include <bit>

#include "halfspace/core/check.h"

namespace halfspace::HS_LANES {

namespace {

// Calls f(slot, lane) for each lane.
template <class F>
void for_each_lane(int packet, uint32_t lanes, const F& f) {
  for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
    const int lane = std::countr_zero(rest);
    f(static_cast<std::size_t>(packet) * kLanes + static_cast<std::size_t>(lane), lane);
  }
}

glm::vec4 color_of(const PacketColor& c, int i) { return {lane(c[0], i), lane(c[1], i), lane(c[2], i), lane(c[3], i)}; }

// Returns the pixel and the sample that a slot of the tile's storage contains.
struct SlotPixel {
  int x, y, sample;
};
SlotPixel pixel_of(const Tile& tile, std::size_t slot) {
  const int i = static_cast<int>(slot), block = i / kPixelsPerBlock, within = i % kPixelsPerBlock;
  const int x = block % kBlocksPerRow * kBlockSize + block_x(within), y = block / kBlocksPerRow * kBlockSize + block_y(within);
  if (tile.samples == 1) return {x, y, 0};
  const int columns = sample_plane(tile.samples, tile.samples - 1, tile.size).x / tile.size + 1;
  if (x / tile.size >= columns) return {x % tile.size, y % tile.size, kMaxSamples};  // unused storage
  return {x % tile.size, y % tile.size, y / tile.size * columns + x / tile.size};
}

}  // namespace

TileTrace::Entry& TileTrace::add_entry(TriangleId id, std::size_t slot, FragmentOutcome outcome) {
  Entry& e = entries_.emplace_back();
  e.fragment.id = id;
  e.fragment.outcome = outcome;
  e.slot = static_cast<uint16_t>(slot);
  e.previous = last_[slot];
  last_[slot] = static_cast<int32_t>(entries_.size()) - 1;
  return e;
}

std::size_t TileTrace::find_index(TriangleId id, std::size_t slot) const {
  int32_t i = last_[slot];
  while (i != kNone && entries_[static_cast<std::size_t>(i)].fragment.id != id) i = entries_[static_cast<std::size_t>(i)].previous;
  HS_CHECK(i != kNone, "trace: a fragment belongs to no draw; expected a draw of this pass");
  return static_cast<std::size_t>(i);
}

TracedFragment& TileTrace::find(TriangleId id, std::size_t slot) { return entries_[find_index(id, slot)].fragment; }

void TileTrace::add(TriangleId id, int packet, uint32_t lanes, FragmentOutcome outcome, Real z, Real stored, bool is_tested) {
  for_each_lane(packet, lanes, [&](std::size_t slot, int i) {
    TracedFragment& f = add_entry(id, slot, outcome).fragment;
    f.depth = f.tested_depth = lane(z, i);
    f.stored_depth = is_tested ? lane(stored, i) : 0.0f;
    f.is_tested = is_tested;
  });
}

void TileTrace::add_rejected(TriangleId id, int packet, uint32_t lanes, FragmentOutcome outcome, Real z, float tested, float stored) {
  for_each_lane(packet, lanes, [&](std::size_t slot, int i) {
    TracedFragment& f = add_entry(id, slot, outcome).fragment;
    f.depth = lane(z, i);
    f.tested_depth = tested;
    f.stored_depth = stored;
    f.is_tested = true;
  });
}

void TileTrace::set_outcome(TriangleId id, int packet, uint32_t lanes, FragmentOutcome outcome) {
  for_each_lane(packet, lanes, [&](std::size_t slot, int) { find(id, slot).outcome = outcome; });
}

void TileTrace::set_depth(TriangleId id, int packet, uint32_t lanes, Real z, Real stored) {
  for_each_lane(packet, lanes, [&](std::size_t slot, int i) {
    TracedFragment& f = find(id, slot);
    f.depth = f.tested_depth = lane(z, i);
    if (f.is_tested) f.stored_depth = lane(stored, i);
  });
}

void TileTrace::set_shaded(TriangleId id, int packet, uint32_t lanes, const PacketColor& color) {
  for_each_lane(packet, lanes, [&](std::size_t slot, int i) {
    TracedFragment& f = find(id, slot);
    f.is_shaded = true;
    f.color = color_of(color, i);
  });
}

void TileTrace::set_value(TriangleId id, int packet, uint32_t lanes, const ColorBuffer& buffer) {
  if (buffer.format == ColorFormat::none || lanes == 0) return;
  const PacketColor value = read_color(buffer, packet);
  for_each_lane(packet, lanes, [&](std::size_t slot, int i) { find(id, slot).value = color_of(value, i); });
}

void TileTrace::add_layers(TriangleId id, int packet, uint32_t lanes, uint32_t merged) {
  set_outcome(id, packet, lanes & ~merged, FragmentOutcome::layered);
  set_outcome(id, packet, merged, FragmentOutcome::layer_merged);
  for_each_lane(packet, lanes, [&](std::size_t slot, int) { layers_.push_back(find_index(id, slot)); });
}

void TileTrace::write_layers(const ColorBuffer& buffer) {
  for (const std::size_t i : layers_) {
    Entry& e = entries_[i];
    e.fragment.value = color_of(read_color(buffer, e.slot / kLanes), e.slot % kLanes);
  }
  layers_.clear();
}

void TileTrace::set_visible(TriangleId uniform, const Tile& tile, int packet, uint32_t lanes, const PacketColor& color) {
  for_each_lane(packet, lanes, [&](std::size_t slot, int i) {
    const TriangleId id = uniform == kNoTriangle ? tile.visibility[slot] : uniform;
    const uint32_t one = 1u << i;
    set_shaded(id, packet, one, color);
    set_outcome(id, packet, one, FragmentOutcome::shaded);
    set_value(id, packet, one, tile.color[0]);
  });
}

void TileTrace::finish(const Tile& tile, uint16_t round, TileFragments& out) {
  out = {.x0 = tile.x0, .y0 = tile.y0, .width = tile.width, .height = tile.height, .first = {}, .fragments = {}};
  const auto index_of = [&](const SlotPixel& p) { return static_cast<std::size_t>(p.y * tile.width + p.x); };
  out.first.assign(static_cast<std::size_t>(tile.width * tile.height) + 1, 0);
  for (const Entry& e : entries_) ++out.first[index_of(pixel_of(tile, e.slot)) + 1];
  for (std::size_t i = 1; i < out.first.size(); ++i) out.first[i] += out.first[i - 1];
  std::vector<uint32_t> next(out.first.begin(), out.first.end() - 1);
  out.fragments.resize(entries_.size());
  for (Entry& e : entries_) {
    const SlotPixel p = pixel_of(tile, e.slot);
    e.fragment.sample = static_cast<uint8_t>(p.sample);
    e.fragment.round = round;
    out.fragments[next[index_of(p)]++] = e.fragment;
  }
  entries_.clear();
  layers_.clear();
  last_.fill(kNone);
}

namespace {

// Calls f(index of the pixel in the image, sample, color) for each sample of the tile.
template <class F>
void for_each_value(const Tile& tile, const PassTrace& out, const F& f) {
  if (tile.color_count == 0 || tile.color[0].format == ColorFormat::none) return;
  for (int packet = 0; packet < kPackets; ++packet) {
    const PacketColor color = read_color(tile.color[0], packet);
    for_each_lane(packet, kAllBits<Mask>, [&](std::size_t slot, int i) {
      const SlotPixel p = pixel_of(tile, slot);
      if (p.x >= tile.width || p.y >= tile.height || p.sample >= tile.samples) return;
      const auto row = static_cast<std::size_t>(out.height - 1 - (tile.y0 + p.y)) * static_cast<std::size_t>(out.width);
      f(row + static_cast<std::size_t>(tile.x0 + p.x), p.sample, color_of(color, i));
    });
  }
}

}  // namespace

void record_values(const Tile& tile, PassTrace& out) {
  for_each_value(tile, out, [&](std::size_t pixel, int sample, const glm::vec4& color) {
    out.values[pixel * static_cast<std::size_t>(tile.samples) + static_cast<std::size_t>(sample)] = color;
  });
}

void record_resolved(const Tile& tile, PassTrace& out) {
  for_each_value(tile, out, [&](std::size_t pixel, int sample, const glm::vec4& color) {
    if (sample == 0) out.resolved[pixel] = color;
  });
}

}  // namespace halfspace::HS_LANES
