// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plotscan::testing {

// Whether the tests were built with a sanitizer, which takes crashes for its own and has to be
// loaded before all else.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace plotscan::testing
