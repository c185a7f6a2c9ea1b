// SPDX-License-Identifier: Apache-2.0
//
// Records what the stages of a tile do. Shading calls it if there is a trace; visibility has writers of its own for traced draws
// (visibility/coverage/traced_writer.h), so that the loops over packets contain no trace code.
#pragma once

#include <vector>

#include "halfspace/raster/tile/blend.h"
#include "halfspace/raster/tile/tile.h"
#include "halfspace/raster/trace/fragment_trace.h"

namespace halfspace::HS_LANES {

/// The fragments of the tile that a task works on. All `lanes` parameters are bit masks.
class TileTrace {
 public:
  TileTrace() { last_.fill(kNone); }

  /// Adds fragments that reached the depth test, or whose visibility the shader decides later. z: depth of the fragments. stored: depth of
  /// the samples. is_tested: z and stored are compared.
  void add(TriangleId id, int packet, uint32_t lanes, FragmentOutcome outcome, Real z, Real stored, bool is_tested);
  /// Adds fragments that were rejected together. tested: the compared depth of the primitive. stored: the depth bound of the block or tile
  /// that it was compared with.
  void add_rejected(TriangleId id, int packet, uint32_t lanes, FragmentOutcome outcome, Real z, float tested, float stored);

  /// These functions change fragments that have been added.
  void set_outcome(TriangleId id, int packet, uint32_t lanes, FragmentOutcome outcome);
  void set_depth(TriangleId id, int packet, uint32_t lanes, Real z, Real stored);
  void set_shaded(TriangleId id, int packet, uint32_t lanes, const PacketColor& color);
  /// Sets TracedFragment::value. Must be called after the colors were written to the buffer.
  void set_value(TriangleId id, int packet, uint32_t lanes, const ColorBuffer& buffer);

  /// Records that fragments were added to the transparent layers. merged: lanes that already had the maximum number of layers.
  void add_layers(TriangleId id, int packet, uint32_t lanes, uint32_t merged);
  /// Records that the transparent layers were blended over the tile.
  void write_layers(const ColorBuffer& buffer);

  /// Records that the visible fragments of a packet were shaded. Each lane shows the triangle in the tile's visibility buffer or, if
  /// `uniform` is not kNoTriangle, triangle `uniform`. Must be called after the colors were written.
  void set_visible(TriangleId uniform, const Tile& tile, int packet, uint32_t lanes, const PacketColor& color);

  /// Moves the fragments to `out` and resets the trace.
  void finish(const Tile& tile, uint16_t round, TileFragments& out);

 private:
  static constexpr int32_t kNone = -1;
  struct Entry {
    TracedFragment fragment;
    uint16_t slot;     // index in the tile's storage
    int32_t previous;  // previous entry of the same slot, or kNone
  };

  Entry& add_entry(TriangleId id, std::size_t slot, FragmentOutcome outcome);
  // These functions return the fragment of a triangle in a slot. It must have been added.
  std::size_t find_index(TriangleId id, std::size_t slot) const;
  TracedFragment& find(TriangleId id, std::size_t slot);

  std::vector<Entry> entries_;
  std::array<int32_t, kMaxTilePixels> last_;  // latest entry of each slot
  std::vector<std::size_t> layers_;           // entries of transparent layers that have not been blended yet
};

/// Copies the colors of all samples of the tile to PassTrace::values.
void record_values(const Tile& tile, PassTrace& out);
/// Copies the colors of all pixels of the tile to PassTrace::resolved. The samples must have been resolved.
void record_resolved(const Tile& tile, PassTrace& out);

}  // namespace halfspace::HS_LANES
