// SPDX-License-Identifier: Apache-2.0
//
// A function whose result depends on the SIMD width, compiled for two widths and loaded into one process.
#include "halfspace/raster/tile/tile_rect.h"

extern "C" int packet_and_position(int x, int y) { return 256 * halfspace::packet_at(x, y) + halfspace::kPacketPositions[x].x; }
