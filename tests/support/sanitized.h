// SPDX-License-Identifier: Apache-2.0
//
// HS_SANITIZED is 1 if the build uses a sanitizer, and 0 otherwise. kSanitized is the same as a bool.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define HS_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define HS_SANITIZED 1
#endif
#endif
#ifndef HS_SANITIZED
#define HS_SANITIZED 0
#endif

namespace halfspace {
inline constexpr bool kSanitized = HS_SANITIZED != 0;
}
