/// Simulated visitors who play with the prop for a minute: with the exhibit's advice, with the paper's, with none, and
/// with perfect advice. Perfect advice is shown at once, seen, understood and carried out exactly, with one reaction
/// time for a whole sequence. The lost time that remains with it is the visitors' own (play, reaction time and
/// speed), a lower bound for any advice.
///
/// A visitor finds the prop where an earlier one left it, and turns, slides and lifts it at will while the picture is
/// whole. When it is not, the visitor follows the advice after a reaction time of 0.3 to 1.5 s; one in ten advices is
/// misunderstood, and one loss in seven is not noticed at first. A changed sign is read even during a movement, and a
/// visitor on a wrong way turns back. Without advice the visitor undoes the latest move or tries another. All stop
/// moving half a second after the picture has become whole. Eyes are those of children, of adults and of people in
/// wheelchairs: 0.9 to 1.9 m above the floor, at a table 0.8 m high.
///
/// Time     simulated, in steps of a sixtieth of a second.
/// Frames   table T, metres.
/// Threads  pure; any.
#pragma once

#include "app/bench/guidance/shown_sign.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace frustumscreen::bench {

[[nodiscard]] std::string_view name_of(Adviser adviser);

/// The visitor's activity while the picture is not whole.
enum class DarkWhile : std::uint8_t { Playing, Waiting, Overlooking, Reacting, GoingWrong, Mending };
inline constexpr std::size_t dark_while_count = 6;

struct VisitResult {
    std::vector<double> restored_s;                ///< duration of each loss that exceeds the debounce time
    double whole_share = 0.0;                      ///< share of the time
    std::array<double, dark_while_count> dark_s{}; ///< seconds without a whole picture, by `DarkWhile`
    int losses = 0;                                ///< number of times that the picture ceased to be whole
    int advices = 0;
    double seconds = 0.0;
};

/// Equal seeds give the same visitor at the same prop.
[[nodiscard]] VisitResult simulate_visit(const guidance::GuidanceSetup& setup, Adviser adviser,
                                         std::uint64_t seed, double seconds);

} // namespace frustumscreen::bench
