/// The sign on the table for a simulated visitor: the exhibit's own Guide, or the paper's rule in the same rhythm.
///
/// Time     simulated seconds, never decreasing; stepped like the exhibit, 60 times a second.
/// Threads  values; one caller.
/// Source   Kim, Shin, Kim 2008, 'Guiding the user'.
#pragma once

#include "app/guidance/guide.h"

#include <optional>

namespace frustumscreen::bench {

/// Perfect: no sign; the visitor knows the advice (perfect_advice.h).
enum class Adviser : std::uint8_t { Exhibit, Paper, None, Perfect };

struct SignOnTable {
    guidance::Move move;  ///< Wait: no known move helps
    double since_s = 0.0; ///< start of its display; another amount of the move keeps the sign
};

class ShownSign {
public:
    ShownSign(const guidance::GuidanceSetup& setup, Adviser adviser) : adviser_(adviser), guide_(setup) {}

    void step(double now_s, const guidance::GuidedState& tracked_state);
    /// The sign after the latest step.
    [[nodiscard]] const std::optional<SignOnTable>& shown() const { return shown_; }

private:
    void step_paper(double now_s, const guidance::GuidedState& tracked_state);

    Adviser adviser_;
    guidance::Guide guide_;
    std::optional<SignOnTable> shown_;
    std::optional<double> dark_since_s_;
    double next_look_s_ = 0.0;
};

} // namespace frustumscreen::bench
