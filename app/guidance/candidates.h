/// The moves that guidance chooses from, in the visitor's own directions, each with its effort.
///
/// Effort   about 1 for one calm movement of the hand.
/// Threads  pure; any. Allocates nothing: the lists are of a fixed size.
#pragma once

#include "app/guidance/move.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace frustumscreen::guidance {

struct Candidate {
    Move move;
    double effort = 0.0;
};

class Candidates {
public:
    static constexpr std::size_t most = 1200;

    void add(const Move& move, double effort) {
        if (count_ < most) {
            list_[count_++] = {move, effort};
        }
    }
    void sort_by_effort() {
        std::sort(list_.begin(), list_.begin() + static_cast<std::ptrdiff_t>(count_),
                  [](const Candidate& a, const Candidate& b) { return a.effort < b.effort; });
    }
    void add_effort(std::size_t which, double effort) { list_.at(which).effort += effort; }
    [[nodiscard]] std::span<const Candidate> all() const { return std::span(list_).first(count_); }

private:
    std::array<Candidate, most> list_{};
    std::size_t count_ = 0;
};

/// Only: directions and amounts are fine. Last of a sequence: places all over the table. Inner: coarse, sufficient to
/// find which moves follow one another.
enum class MoveSet { Only, Last, Inner };
[[nodiscard]] Candidates candidates(const GuidanceSetup& setup, const GuidedState& tracked_state,
                                    MoveSet set);

} // namespace frustumscreen::guidance
