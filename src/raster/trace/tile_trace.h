// SPDX-License-Identifier: Apache-2.0
//
// Records what the stages of a tile do. The functions of visibility/ and shade/ and the tile worker are templates over the type of their
// statistics and have a second instantiation for TracedStatistics, which records. The one for PassStatistics contains no trace code.
#pragma once

#include <memory>

#include "halfspace/raster/tile/blend.h"
#include "halfspace/raster/tile/tile.h"
#include "halfspace/raster/trace/fragment_trace.h"

namespace halfspace {

/// The fragments of the tile that a task works on. Lanes are bit masks.
class TileTrace {
 public:
  TileTrace() { last_.fill(kNone); }

  /// Adds fragments that reached the depth test, or that a shader will decide about. stored: the depth of the samples. is_tested: they are
  /// compared.
  void add(TriangleId id, int packet, uint32_t lanes, FragmentOutcome outcome, Real z, Real stored, bool is_tested);
  /// Adds fragments that were rejected together by comparing one depth of the primitive with one of the area.
  void add_rejected(TriangleId id, int packet, uint32_t lanes, FragmentOutcome outcome, Real z, float tested, float stored);

  /// These change fragments that have been added.
  void set_outcome(TriangleId id, int packet, uint32_t lanes, FragmentOutcome outcome);
  void set_depth(TriangleId id, int packet, uint32_t lanes, Real z, Real stored);
  void set_shaded(TriangleId id, int packet, uint32_t lanes, const PacketColor& color);
  /// Sets the color of the samples after the fragments were written.
  void set_value(TriangleId id, int packet, uint32_t lanes, const ColorBuffer& buffer);

  /// The lanes were added to the transparent layers. merged: lanes that already had the maximum number of layers.
  void add_layers(TriangleId id, int packet, uint32_t lanes, uint32_t merged);
  /// The transparent layers were blended over the tile.
  void write_layers(const ColorBuffer& buffer);

  /// Visible fragments were shaded after visibility. Each lane shows the triangle that the tile's visibility buffer contains or, if
  /// `uniform` is not kNoTriangle, that one. Call it after the colors were written.
  void set_visible(TriangleId uniform, const Tile& tile, int packet, uint32_t lanes, const PacketColor& color);

  /// Moves the fragments to `out` and forgets them.
  void finish(const Tile& tile, uint16_t round, TileFragments& out);

 private:
  static constexpr int32_t kNone = -1;
  struct Entry {
    TracedFragment fragment;
    uint16_t slot;     // pixel in the tile's storage
    int32_t previous;  // entry of the same slot
  };

  Entry& add_entry(TriangleId id, std::size_t slot, FragmentOutcome outcome);
  // These return the fragment of a triangle, which must have been added.
  std::size_t find_index(TriangleId id, std::size_t slot) const;
  TracedFragment& find(TriangleId id, std::size_t slot);

  std::vector<Entry> entries_;
  std::array<int32_t, kMaxTilePixels> last_;  // latest entry of each slot
  std::vector<std::size_t> layers_;           // entries in transparent layers that have not been written
};

/// Statistics of a task whose fragments are traced.
struct TracedStatistics : PassStatistics {
  std::unique_ptr<TileTrace> trace;
};
template <class Statistics>
inline constexpr bool kTraces = std::is_same_v<Statistics, TracedStatistics>;

/// Writes the color of every sample of the tile to the values of the trace.
void record_values(const Tile& tile, PassTrace& out);
/// Writes the color of every pixel of the tile, whose samples have been resolved.
void record_resolved(const Tile& tile, PassTrace& out);

}  // namespace halfspace
