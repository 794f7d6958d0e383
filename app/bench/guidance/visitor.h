/// Simulated visitors who play with the prop for a minute: with the exhibit's advice, with the paper's, and with none.
///
/// A visitor finds the prop as somebody left it, and turns, slides and lifts it at will while the picture is whole. When it
/// is not, the visitor follows the advice after a reaction time of 0.3 to 1.5 s; one in ten advices is misunderstood, one in
/// seven is not noticed at first. Without advice the visitor undoes the latest move or tries another. All stop
/// moving half a second after the picture has become whole. Eyes are those of children, of adults and of people in wheelchairs:
/// 0.9 to 1.9 m over the floor, at a table 0.8 m high.
///
/// Time     simulated, in steps of 50 ms; the advice comes after the patience of Guide.
/// Frames   table T, metres.
/// Threads  pure; any.
#pragma once

#include "app/guidance/advise.h"

#include <cstdint>
#include <vector>

namespace frustumscreen {

enum class Adviser : std::uint8_t { Exhibit, Paper, None };
[[nodiscard]] std::string_view name_of(Adviser adviser);

struct VisitResult {
    std::vector<double>
        mended_s; ///< from the loss of the whole picture until it is whole, where it lasted beyond the patience
    double whole_share = 0.0; ///< of the time
    int advices = 0;
    double seconds = 0.0;
};

/// Equal seeds: the same visitor at the same prop.
[[nodiscard]] VisitResult simulate_visit(const GuidanceSetup& setup, Adviser adviser, std::uint64_t seed,
                                         double seconds);

} // namespace frustumscreen
