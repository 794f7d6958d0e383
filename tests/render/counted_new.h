/// Counts the C++ allocations of the calling thread; not under the sanitizers, which replace `new`
/// themselves.
#pragma once

namespace frustumscreen::synthetic {
inline constexpr bool allocations_are_counted =
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    false;
#else
    true;
#endif
[[nodiscard]] long allocations_so_far();
} // namespace frustumscreen::synthetic
