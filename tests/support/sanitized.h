// SPDX-License-Identifier: Apache-2.0
//
// Does a sanitizer watch this build? HS_SANITIZED is 1 then and 0 else, for the preprocessor; kSanitized says the same.
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
