// SPDX-License-Identifier: Apache-2.0
//
// Which processor this build needs. cpu.cpp is compiled for the baseline instruction set, so that a program can ask
// before it dies of an illegal instruction. For the same reason nothing here is a template or an inline function:
// the linker keeps one copy of those for the whole program, and it may keep one that was compiled for more.
#pragma once

namespace halfspace {

/// What this machine's processor lacks of what the build uses, as one line ("this build needs AVX-512 (F, BW, DQ, VL),
/// which this processor lacks; rebuild with …"), or "". The text lives until the next call; not thread-safe.
const char* missing_cpu_features() noexcept;

/// The instruction set of the build (HALFSPACE_ARCH), for example "native".
const char* build_arch() noexcept;

/// The same with the lane width, for example "native, 16 lanes".
const char* build_description() noexcept;

}  // namespace halfspace
