// SPDX-License-Identifier: Apache-2.0
//
// The samples that a draw writes in a tile. The loops over primitives are templates over it: for a tile with one sample per pixel, all its
// values are constants, and the loops over samples disappear.
#pragma once

#include <array>
#include <span>
#include <type_traits>

#include "halfspace/raster/visibility/visibility.h"

namespace halfspace::HS_LANES {

/// Largest number of samples per pixel.
template <bool multisampled>
inline constexpr std::size_t kSamplesOf = multisampled ? static_cast<std::size_t>(kMaxSamples) : 1;
/// Covered lanes of a packet of pixels, as a bit mask for each sample. A single mask has 32 bits: with 16, GCC converts it to a mask of
/// lanes in twice the time, which costs 2% of small triangles.
template <bool multisampled>
using PacketLanes = std::conditional_t<multisampled, SampleLanes, std::array<uint32_t, 1>>;

/// The samples in the sample mask of a draw. All arrays except `index` have one element per sample of the tile.
template <bool multisampled>
struct SampleSet {
  explicit SampleSet(const DrawInTile& d) : tile_samples(static_cast<std::size_t>(d.tile.samples)) {
    for (std::size_t s = 0; s < tile_samples; ++s) {
      const SamplePlane p = sample_plane(d.tile.samples, static_cast<int>(s), d.tile.size);
      plane[s] = p;
      position[s] = sample_position(d.tile.samples, static_cast<int>(s));
      shift[s] = packet_shift(p);
      if ((d.draw.sample_mask >> s & 1) == 0) continue;
      lanes[s] = static_cast<uint16_t>(kAllBits<Mask>);
      index[count++] = s;
    }
  }

  /// Returns the samples in the set.
  std::span<const std::size_t> indices() const { return {index.data(), count}; }
  /// Returns the position of a sample relative to that of sample 0.
  SamplePosition offset(std::size_t s) const { return {position[s].x - position[0].x, position[s].y - position[0].y}; }

  std::size_t tile_samples;  ///< samples of the tile
  std::size_t count = 0;     ///< samples in the set
  std::array<std::size_t, kMaxSamples> index;
  SampleLanes lanes{};  ///< all lanes of samples in the set, none of other samples
  std::array<SamplePosition, kMaxSamples> position;
  std::array<SamplePlane, kMaxSamples> plane;
  std::array<int, kMaxSamples> shift;  ///< distance of packets from those of sample 0
};

/// The sample of a tile with one sample per pixel.
template <>
struct SampleSet<false> {
  explicit SampleSet(const DrawInTile&) {}
  /// For one sample of a multisampled tile, with pixels and packets numbered as in the plane of sample 0.
  explicit SampleSet(SamplePosition at) : position{at} {}

  static constexpr std::span<const std::size_t, 1> indices() { return index; }
  static constexpr SamplePosition offset(std::size_t) { return {0, 0}; }

  static constexpr std::size_t tile_samples = 1, count = 1;
  static constexpr std::array<std::size_t, 1> index{0};
  static constexpr PacketLanes<false> lanes{kAllBits<Mask>};
  std::array<SamplePosition, 1> position{kPixelCenter};
  static constexpr std::array<SamplePlane, 1> plane{{{0, 0}}};
  static constexpr std::array<int, 1> shift{0};
};

/// Tests and writes the covered samples of a packet of pixels. packet: its number in the plane of sample 0; lanes: covered lanes, 0 for
/// samples that are not in the set; passes: bit s: the depth test passes in all covered lanes of sample s; z_at(s): returns their depth.
/// Calls wrote(s, packet) for samples of which a lane has passed, with the number of the packet in the plane of the sample, but only if the
/// writer writes depth.
template <class Writer, class Depth, class Wrote>
HS_INLINE void write_samples(Writer& writer, const SampleSet<Writer::kMultisampled>& set, TriangleId id, int packet,
                             const PacketLanes<Writer::kMultisampled>& lanes, uint32_t passes, const Depth& z_at, const Wrote& wrote) {
  if constexpr (Writer::kQueues) {
    if (writer.adds_untested(passes == ~0u)) return writer.add_untested(id, packet, lanes);
    if constexpr (Writer::kMultisampled) writer.begin_packet(id, packet);
  }
  for (std::size_t s = 0; s < set.tile_samples; ++s) {
    if (Writer::kMultisampled && lanes[s] == 0) continue;
    if constexpr (Writer::kQueues && Writer::kMultisampled) writer.begin_sample(s);
    const int at = packet + set.shift[s];
    const bool has_passed = writer.write(
        id, at, lanes[s], [&] { return z_at(s); }, (passes >> s & 1) != 0);
    if (has_passed && writer.writes_depth()) wrote(s, at);
  }
  if constexpr (Writer::kQueues && Writer::kMultisampled) writer.end_packet();
}

}  // namespace halfspace::HS_LANES
