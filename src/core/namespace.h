// SPDX-License-Identifier: Apache-2.0
//
// The inline namespace of all names of Halfspace. It is named after the SIMD width, so that object files and libraries that were compiled
// for different widths do not link with each other, and can be loaded into one process. Code that uses Halfspace does not name it. Files of
// Halfspace open it as "namespace halfspace::HS_LANES".
#pragma once

// Each #error below falls back to one lane, so that no further errors hide the message.
#ifndef HALFSPACE_LANES
#error "HALFSPACE_LANES is not defined: link the CMake target Halfspace::raster, which sets it and the compiler flags it needs"
#define HALFSPACE_LANES 1
#elif HALFSPACE_LANES != 1 && HALFSPACE_LANES != 4 && HALFSPACE_LANES != 8 && HALFSPACE_LANES != 16
#error "HALFSPACE_LANES must be 1, 4, 8 or 16"
#undef HALFSPACE_LANES
#define HALFSPACE_LANES 1
#elif HALFSPACE_LANES == 8 && !defined(__AVX2__)
#error "HALFSPACE_LANES is 8, which needs AVX2: compile with -march=x86-64-v3, or link the CMake target Halfspace::raster"
#undef HALFSPACE_LANES
#define HALFSPACE_LANES 1
#elif HALFSPACE_LANES == 16 && !(defined(__AVX512F__) && defined(__AVX512BW__) && defined(__AVX512DQ__) && defined(__AVX512VL__))
#error \
    "HALFSPACE_LANES is 16, which needs AVX-512 F, BW, DQ and VL: compile with -march=x86-64-v4, or link the CMake target Halfspace::raster"
#undef HALFSPACE_LANES
#define HALFSPACE_LANES 1
#endif

#define HS_JOIN_EXPANDED(a, b) a##b
#define HS_JOIN(a, b) HS_JOIN_EXPANDED(a, b)
#define HS_LANES HS_JOIN(lanes, HALFSPACE_LANES)

// The namespace is declared inline only here, because editors and ctags do not understand "namespace a::inline MACRO". Clang warns when it
// is reopened without `inline`, although the meaning is the same. The warning stays off in files that include Halfspace.
#ifdef __clang__
#pragma clang diagnostic ignored "-Winline-namespace-reopened-noninline"
#endif
namespace halfspace {
inline namespace HS_LANES {}
}  // namespace halfspace
