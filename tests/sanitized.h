// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Whether the tests are built with the address or thread sanitizer, which reserve terabytes of address space, so that
// no program starts under `ulimit -v`, and slow programs down by 3 to 20.

namespace seaglint {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace seaglint
