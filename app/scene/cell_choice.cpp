#include "app/scene/cell_choice.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace frustumscreen::scene {

namespace {

constexpr double entered_share = 0.9; ///< of the budget, at most, after a change
constexpr double worth_changing = 0.9;

/// The cheapest one; of equally cheap ones the most exact.
std::size_t cheapest_of(std::span<const CellOption> options) {
    std::size_t found = 0;
    for (std::size_t k = 1; k < options.size(); ++k) {
        const CellOption& best = options[found];
        const bool is_cheaper = options[k].cost_us < best.cost_us || std::isnan(best.cost_us);
        const bool is_better = options[k].cost_us == best.cost_us && options[k].error_mm < best.error_mm;
        found = is_cheaper || is_better ? k : found;
    }
    return found;
}

} // namespace

CellChoice::CellChoice(std::span<const std::size_t> options)
    : first_{0}, chosen_(options.size()), wanted_(options.size()), steps_(options.size()),
      changed_(options.size()) {
    for (const std::size_t count : options) {
        assert(count > 0);
        first_.push_back(first_.back() + count);
    }
}

CellOption CellChoice::sum(const std::vector<std::size_t>& choice,
                           std::span<const CellOption> options) const {
    CellOption sum;
    for (std::size_t cell = 0; cell < choice.size(); ++cell) {
        const CellOption& option = of(cell, options)[choice[cell]];
        sum.error_mm += option.error_mm;
        sum.cost_us += option.cost_us;
    }
    return sum;
}

void CellChoice::solve(std::span<const CellOption> options, double budget_us) {
    // From a corner of the hull, the steepest step to a more exact option leads to the hull's next corner.
    const auto next = [&](std::size_t cell) {
        const std::span<const CellOption> own = of(cell, options);
        const CellOption& from = own[wanted_[cell]];
        Step step;
        for (std::size_t k = 0; k < own.size(); ++k) {
            const double saved_mm = from.error_mm - own[k].error_mm;
            const double more_us = own[k].cost_us - from.cost_us;
            if (saved_mm > 0.0 && more_us > 0.0 && saved_mm > step.saved_per_us * more_us) {
                step = {k, saved_mm / more_us};
            }
        }
        return step;
    };
    for (std::size_t cell = 0; cell < wanted_.size(); ++cell) {
        wanted_[cell] = cheapest_of(of(cell, options));
        steps_[cell] = next(cell);
    }
    double spent_us = sum(wanted_, options).cost_us;
    while (true) {
        const auto best = std::max_element(steps_.begin(), steps_.end(), [](const Step& a, const Step& b) {
            return a.saved_per_us < b.saved_per_us;
        });
        if (best == steps_.end() || !(best->saved_per_us > 0.0)) {
            return;
        }
        const auto cell = static_cast<std::size_t>(best - steps_.begin());
        const std::span<const CellOption> own = of(cell, options);
        const double after_us = spent_us + own[best->to].cost_us - own[wanted_[cell]].cost_us;
        if (after_us <= budget_us) {
            wanted_[cell] = best->to;
            spent_us = after_us;
            *best = next(cell);
        } else {
            *best = {};
        }
    }
}

bool CellChoice::may_change(MonotonicTime now) const {
    for (std::size_t cell = 0; cell < chosen_.size(); ++cell) {
        if (wanted_[cell] != chosen_[cell] && now - changed_[cell] < cell_dwell) {
            return false;
        }
    }
    return true;
}

void CellChoice::change(MonotonicTime now) {
    for (std::size_t cell = 0; cell < chosen_.size(); ++cell) {
        if (wanted_[cell] != chosen_[cell]) {
            chosen_[cell] = wanted_[cell];
            changed_[cell] = now;
            ++switches_;
        }
    }
}

std::span<const std::size_t> CellChoice::choose(MonotonicTime now, std::span<const CellOption> options,
                                                double budget_us) {
    assert(options.size() == first_.back());
    if (!begun_) {
        begun_ = true;
        solve(options, budget_us);
        chosen_ = wanted_;
        std::fill(changed_.begin(), changed_.end(), now);
        return chosen_;
    }
    const CellOption present = sum(chosen_, options);
    solve(options, entered_share * budget_us);
    const CellOption better = sum(wanted_, options);
    if (present.cost_us > budget_us) {
        if (better.cost_us <= budget_us || better.cost_us < worth_changing * present.cost_us) {
            change(now);
        }
    } else if (better.error_mm < worth_changing * present.error_mm && may_change(now)) {
        change(now);
    }
    return chosen_;
}

} // namespace frustumscreen::scene
