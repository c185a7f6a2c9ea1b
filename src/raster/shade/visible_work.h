// SPDX-License-Identifier: Apache-2.0
//
// Lists the visible pixels of a tile that deferred shading must shade, as packets that show one draw.
#pragma once

#include <span>

#include "halfspace/raster/visibility/visibility.h"

namespace halfspace::HS_LANES {

/// Pixels of a packet that show the same draw.
struct ShadingWork {
  const Draw* draw;
  PacketMask packet;
};

/// At most one entry per pixel. The element after the last one may be written.
using ShadingWorkList = std::array<ShadingWork, kMaxTilePixels + 1>;

/// Which of the pending pixels to list: those whose draw is shaded per pixel, or those whose draw is shaded per sample.
enum class ShadingFrequency : uint8_t { per_pixel, per_sample };

/// Lists the visible pixels of one sample plane by packet. A packet that shows several draws has an entry for each. ids: triangle of each
/// pixel of the tile's storage. Returns the entries.
std::span<ShadingWork> list_work(const PassContext& context, const Tile& tile, const TriangleId* ids, const SamplePlane& plane,
                                 ShadingFrequency frequency, ShadingWorkList& work);

/// Returns false if no draw of the pass runs its fragment function per sample. A long list of draws is not searched for each tile.
bool may_shade_samples(const PassContext& context);

/// Lists the visible pixels of a multisampled tile that are shaded per pixel. Each triangle that is visible in a pixel is listed once. The
/// triangles of a pixel are written to the sample planes of `distinct`, in the order of the samples in which they are visible: the first to
/// plane 0, the second to plane 1, and so on. The entries refer to the packets of `distinct`. Returns the entries.
std::span<ShadingWork> list_distinct(const PassContext& context, const Tile& tile, std::array<TriangleId, kMaxTilePixels>& distinct,
                                     ShadingWorkList& work);

/// Moves the packets of the first draw of `work` to `packets` and returns their number. `work` keeps the other entries, in their order.
std::size_t take_draw(std::span<ShadingWork>& work, std::span<PacketMask> packets);
/// The same for work that is sorted by draw.
std::size_t take_sorted_draw(std::span<ShadingWork>& work, std::span<PacketMask> packets);

}  // namespace halfspace::HS_LANES
