/// An advice, the one that a visitor has, and whether a move helps however people carry it out: with its direction up to 20
/// degrees off, its amount up to 40 per cent off.
///
/// Threads  pure; any. Allocates nothing.
#pragma once

#include "app/guidance/face_reader.h"
#include "app/guidance/move.h"

namespace frustumscreen {

inline constexpr double sloppy_direction_deg = 20.0;
inline constexpr double sloppy_amount = 0.4;

struct Advice {
    Move move;
    int steps = 1; ///< moves until every seen face is lit, this one included
};

/// The advice that a visitor has, and the situation that it was given in.
struct GivenAdvice {
    Move move;
    GuidedState given;
    /// Whether the visitor has hardly begun to follow it.
    [[nodiscard]] bool holds(const GuidedState& tracked_state) const;
};

struct Help {
    bool always =
        false; ///< every way in which people carry the move out leads to a smaller unlit area, or to none
    double whole_share = 0.0; ///< of these ways, that lead to none
};
/// `margin`: a factor on how sloppy they are. `looks`: the situations looked at are added to it.
[[nodiscard]] Help help_of(const FaceReader& reader, const GuidedState& tracked_state, const Move& move,
                           double margin = 1.0, int* looks = nullptr);

} // namespace frustumscreen
