// SPDX-License-Identifier: Apache-2.0
//
// The samples that a draw writes in a multisampled tile.
#pragma once

#include <array>
#include <span>

#include "halfspace/raster/visibility/visibility.h"

namespace halfspace::HS_LANES {

/// The samples in the sample mask of a draw. All arrays except `index` have one element per sample of the tile.
struct SampleSet {
  explicit SampleSet(const DrawInTile& d) : tile_samples(static_cast<std::size_t>(d.tile.samples)) {
    for (std::size_t s = 0; s < tile_samples; ++s) {
      const SamplePlane p = plane[s] = sample_plane(d.tile.samples, static_cast<int>(s), d.tile.size);
      position[s] = sample_position(d.tile.samples, static_cast<int>(s));
      shift[s] = packet_shift(p);
      if ((d.draw.sample_mask >> s & 1) == 0) continue;
      lanes[s] = static_cast<uint16_t>(kAllBits<Mask>);
      index[count++] = s;
    }
  }

  /// Returns the samples in the set.
  std::span<const std::size_t> indices() const { return {index.data(), count}; }

  std::size_t tile_samples;  ///< samples of the tile
  std::size_t count = 0;     ///< samples in the set
  std::array<std::size_t, kMaxSamples> index;
  SampleLanes lanes{};  ///< all lanes of samples in the set, none of other samples
  std::array<SamplePosition, kMaxSamples> position;
  std::array<SamplePlane, kMaxSamples> plane;
  std::array<int, kMaxSamples> shift;  ///< distance of packets from those of sample 0
};

/// Tests and writes the covered samples of a packet of pixels. packet: its number in the plane of sample 0; lanes: covered lanes, 0 for
/// samples that are not in the set; passes: bit s: the depth test passes in all covered lanes of sample s; z_at(s): returns their depth.
/// Calls wrote(s, packet) for samples of which a lane has passed, with the number of the packet in the plane of the sample, but only if the
/// writer writes depth.
template <class Writer, class Depth, class Wrote>
HS_INLINE void write_samples(Writer& writer, const SampleSet& set, TriangleId id, int packet, const SampleLanes& lanes, uint32_t passes,
                             const Depth& z_at, const Wrote& wrote) {
  if constexpr (Writer::kQueues) {
    if (writer.adds_untested(passes == ~0u)) return writer.add_untested(id, packet, lanes);
    writer.begin_packet(id, packet);
  }
  for (std::size_t s = 0; s < set.tile_samples; ++s) {
    if (lanes[s] == 0) continue;
    if constexpr (Writer::kQueues) writer.begin_sample(s);
    const int at = packet + set.shift[s];
    const bool has_passed = writer.write(
        id, at, lanes[s], [&] { return z_at(s); }, (passes >> s & 1) != 0);
    if (has_passed && writer.writes_depth()) wrote(s, at);
  }
  if constexpr (Writer::kQueues) writer.end_packet();
}

}  // namespace halfspace::HS_LANES
