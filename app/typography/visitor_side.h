/// The side of the table that a visitor reads from, in quarter turns; pictures on the table are turned to it.
///
/// 0: the front edge (-Y). Each quarter turn continues counter-clockwise seen from above: 1 is the right edge
/// (+X), 2 the far one, 3 the left one.
///
/// Frames   table T, metres.
/// Threads  values; one caller. Allocates nothing.
#pragma once

#include <glm/glm.hpp>

namespace frustumscreen::typography {

/// Rotates a point about the table's centre by quarter turns counter-clockwise; exact.
[[nodiscard]] glm::dvec2 turned(const glm::dvec2& point, int quarter_turns);

class VisitorSide {
public:
    /// A visitor must be this much nearer to another side, as seen from the table's middle, before the side
    /// changes. This avoids toggling at a table's corner.
    static constexpr double hysteresis_deg = 12.0;
    /// A visitor who leans over the middle of the table keeps the side.
    static constexpr double leaning_m = 0.15;

    /// Takes the eye's position and returns the side.
    int update(const glm::dvec3& eye_m);
    [[nodiscard]] int quarter_turns() const { return quarter_turns_; }

private:
    bool known_ = false; ///< the first eye needs no hysteresis
    int quarter_turns_ = 0;
};

} // namespace frustumscreen::typography
