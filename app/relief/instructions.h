/// The code of lanes.h, compiled once for each supported set of vector instructions; the choice is made at
/// run time.
///
/// Both sets compute equal numbers: nothing is contracted or approximated in either. SSE4.1, between the two,
/// would gain nothing: GCC 12 compares and selects its eight lanes one by one (docs/relief.md).
/// Threads  any.
#pragma once

#include <cstdint>

namespace frustumscreen::relief {

enum class Instructions : std::uint8_t { Plain, Avx2 };

/// The widest set that this processor has.
[[nodiscard]] inline Instructions best_instructions() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) {
        return Instructions::Avx2;
    }
#endif
    return Instructions::Plain;
}

#if defined(__x86_64__)
template <auto run, typename... Given> [[gnu::target("avx2")]] void run_with_avx2(Given&... given) {
    run(given...);
}
#endif

/// Runs `run`, which must be FRUSTUMSCREEN_INLINE, with these instructions, which the processor must have.
template <auto run, typename... Given>
void run_with([[maybe_unused]] Instructions instructions, Given&... given) {
#if defined(__x86_64__)
    if (instructions == Instructions::Avx2) {
        return run_with_avx2<run>(given...);
    }
#endif
    run(given...);
}

} // namespace frustumscreen::relief
