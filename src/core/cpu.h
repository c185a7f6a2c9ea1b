// SPDX-License-Identifier: Apache-2.0
//
// Checks whether the processor supports this build. cpu.cpp is compiled for the baseline instruction set, so that a program
// can check before it executes an illegal instruction. For the same reason this header has no templates or inline functions:
// the linker keeps a single copy of each, which may have been compiled for a newer instruction set.
#pragma once

namespace halfspace {

/// Returns one line that lists the features which this build needs but the processor lacks, for example "this build needs
/// AVX-512 (F, BW, DQ, VL), which this processor does not support; rebuild with ...", or "" if none are missing. The string
/// is valid until the next call. Not thread-safe.
const char* missing_cpu_features() noexcept;

/// Returns the instruction set of the build (HALFSPACE_ARCH), for example "native".
const char* build_arch() noexcept;

/// Returns the instruction set and the SIMD width of the build, for example "native, 16 lanes".
const char* build_description() noexcept;

}  // namespace halfspace
