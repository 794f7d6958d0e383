/// Chooses how each cell is drawn in a frame: the choices with the least sum of measured errors whose times together
/// keep the frame's budget.
///
/// A knapsack with one choice for each cell, solved along the convex hull of each cell's options: the steps of most
/// error saved for each microsecond come first. The unused rest is less than the time of one step.
/// Steady   a choice is left for a better one only if that one saves a tenth of the error, keeps a tenth of the budget
///          free, and no cell that it changes has changed within `cell_dwell`. A choice that breaks the budget is left at
///          once.
///
/// Units    millimetres of error on the configured prop, times the share of the artifact's pixels that the cell has;
///          microseconds of processor time.
/// Time     `now` is a parameter.
/// Threads  values; one caller. `choose` allocates nothing after the constructor.
/// Source   Kim 2008, "Switching between representations", whose Eq. (1) it replaces; Funkhouser & Sequin 1993,
///          "Adaptive display algorithm for interactive frame rates" (the greedy knapsack).
#pragma once

#include "firmware_host/base/time.h"

#include <chrono>
#include <cstddef>
#include <span>
#include <vector>

namespace frustumscreen::scene {

/// One way to draw a cell in this frame.
struct CellOption {
    double error_mm = 0.0;
    double cost_us = 0.0;
};

inline constexpr Nanoseconds cell_dwell = std::chrono::milliseconds(500);

class CellChoice {
public:
    /// `options`: of each cell, their number; at least one for each.
    explicit CellChoice(std::span<const std::size_t> options);

    /// `options`: one list after another, as many as the constructor was told. `budget_us`: for all cells together;
    /// if even the cheapest ones exceed it, these are chosen, or some that are at most a tenth dearer. Returns an
    /// index into each cell's options, valid until the next call.
    [[nodiscard]] std::span<const std::size_t> choose(MonotonicTime now, std::span<const CellOption> options,
                                                      double budget_us);

    [[nodiscard]] std::size_t switches() const { return switches_; }

private:
    /// Along the convex hull of a cell's options.
    struct Step {
        std::size_t to = 0;
        double saved_per_us = 0.0; ///< 0: no step is left
    };
    [[nodiscard]] std::span<const CellOption> of(std::size_t cell,
                                                 std::span<const CellOption> options) const {
        return options.subspan(first_[cell], first_[cell + 1] - first_[cell]);
    }
    /// Sums over all cells.
    [[nodiscard]] CellOption sum(const std::vector<std::size_t>& choice,
                                 std::span<const CellOption> options) const;
    /// Sets `wanted_`.
    void solve(std::span<const CellOption> options, double budget_us);
    [[nodiscard]] bool may_change(MonotonicTime now) const;
    void change(MonotonicTime now);

    std::vector<std::size_t> first_; ///< of each cell's options, and the end
    std::vector<std::size_t> chosen_, wanted_;
    std::vector<Step> steps_; ///< by cell
    std::vector<MonotonicTime> changed_;
    bool begun_ = false;
    std::size_t switches_ = 0;
};

} // namespace frustumscreen::scene
