/// Chooses how each cell is drawn in a frame: the choices with the least sum of measured errors whose times together
/// keep the frame's budget.
///
/// A knapsack with one choice for each cell, solved along the convex hull of each cell's options: the steps of most
/// error saved for each microsecond come first. What this leaves unused is less than the time of one step.
/// Steady   a choice is left only for one that saves clearly more than it costs to change, and each cell changes at
///          most once in `cell_dwell`; a choice that would break the budget is left at once.
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
    /// if even the cheapest ones exceed it, these are chosen. Returns an index into each cell's options, valid until
    /// the next call.
    [[nodiscard]] std::span<const std::size_t> choose(MonotonicTime now, std::span<const CellOption> options,
                                                      double budget_us);

    [[nodiscard]] std::size_t switches() const { return switches_; }

private:
    std::vector<std::size_t> first_; ///< of each cell's options, and the end
    std::vector<std::size_t> chosen_;
    std::vector<MonotonicTime> changed_;
    bool begun_ = false;
    std::size_t switches_ = 0;
};

} // namespace frustumscreen::scene
