/// The code of lanes.h, compiled once for each set of vector instructions that our processors have: which one runs is chosen at run time.
///
/// Every set makes the same numbers: nothing is contracted or approximated in any of them.
/// Threads  any.
#pragma once

#include <cstdint>

namespace frustumscreen {

/// Each has what those before it have.
enum class Instructions : std::uint8_t { Plain, Sse41, Avx2 };

/// The widest that this processor has. Small processors of mini PCs have SSE4.1 alone.
[[nodiscard]] inline Instructions best_instructions() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) {
        return Instructions::Avx2;
    }
    if (__builtin_cpu_supports("sse4.1")) {
        return Instructions::Sse41;
    }
#endif
    return Instructions::Plain;
}

#if defined(__x86_64__)
template <auto run, typename... Given> [[gnu::target("avx2")]] void run_with_avx2(Given&... given) {
    run(given...);
}
template <auto run, typename... Given> [[gnu::target("sse4.1")]] void run_with_sse41(Given&... given) {
    run(given...);
}
#endif

/// `run`, which must be FRUSTUMSCREEN_INLINE, with instructions that this processor has.
template <auto run, typename... Given>
void run_with([[maybe_unused]] Instructions instructions, Given&... given) {
#if defined(__x86_64__)
    if (instructions == Instructions::Avx2) {
        return run_with_avx2<run>(given...);
    }
    if (instructions == Instructions::Sse41) {
        return run_with_sse41<run>(given...);
    }
#endif
    run(given...);
}

} // namespace frustumscreen
