#include "app/scene/room_choice.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::scene {

namespace {

constexpr double kept_cost = 1.34;     ///< of the quickest that is enough
constexpr double entered_budget = 0.9; ///< share of the budget that new choices may take
constexpr double wasted_budget = 0.75; ///< choices that use a smaller share are made again

std::span<const RoomOption> of_object(const RoomSeen& seen, std::span<const RoomOption> options) {
    return options.subspan(seen.first, seen.count);
}

} // namespace

RoomChoice::RoomChoice(std::size_t objects) : chosen_(objects, none) {
    wanted_.reserve(objects);
    next_.reserve(objects);
    steps_.reserve(objects);
}

std::uint32_t RoomChoice::enough(std::span<const RoomOption> own, std::uint32_t present,
                                 double tolerance_px) {
    const bool is_there = present < own.size() && std::isfinite(own[present].cost_us);
    std::uint32_t quickest = none;
    std::uint32_t finest = none;
    for (std::uint32_t k = 0; k < own.size(); ++k) {
        const RoomOption& option = own[k];
        if (!std::isfinite(option.cost_us)) {
            continue;
        }
        const bool is_coarser = is_there && option.error_px > own[present].error_px;
        const double within = is_coarser ? entered_tolerance * tolerance_px : tolerance_px;
        if (option.error_px <= within && (quickest == none || option.cost_us < own[quickest].cost_us)) {
            quickest = k;
        }
        if (finest == none || option.error_px < own[finest].error_px) {
            finest = k;
        }
    }
    if (quickest != none && is_there && own[present].error_px <= tolerance_px &&
        own[present].cost_us <= kept_cost * own[quickest].cost_us) {
        return present;
    }
    return quickest != none ? quickest : finest;
}

void RoomChoice::push_step(std::span<const RoomSeen> seen, std::span<const RoomOption> options,
                           std::uint32_t of) {
    if (next_[of] == none) {
        return;
    }
    const std::span<const RoomOption> own = of_object(seen[of], options);
    const RoomOption& from = own[next_[of]];
    Step best{.added_per_us = INFINITY, .seen = of, .to = none};
    for (std::uint32_t k = 0; k < own.size(); ++k) {
        const double saved_us = from.cost_us - own[k].cost_us;
        if (saved_us > 0.0) {
            const double added = seen[of].pixels * (own[k].error_px - from.error_px) / saved_us;
            best = best.to == none || added < best.added_per_us ? Step{added, of, k} : best;
        }
    }
    if (best.to != none) {
        steps_.push_back(best);
        std::push_heap(steps_.begin(), steps_.end(),
                       [](const Step& a, const Step& b) { return a.added_per_us > b.added_per_us; });
    }
}

void RoomChoice::coarsen(std::span<const RoomSeen> seen, std::span<const RoomOption> options,
                         double budget_us) {
    steps_.clear();
    for (std::uint32_t k = 0; k < seen.size(); ++k) {
        push_step(seen, options, k);
    }
    while (cost_us_ > budget_us && !steps_.empty()) {
        std::pop_heap(steps_.begin(), steps_.end(),
                      [](const Step& a, const Step& b) { return a.added_per_us > b.added_per_us; });
        const Step step = steps_.back();
        steps_.pop_back();
        const std::span<const RoomOption> own = of_object(seen[step.seen], options);
        cost_us_ -= own[next_[step.seen]].cost_us - own[step.to].cost_us;
        next_[step.seen] = step.to;
        push_step(seen, options, step.seen);
    }
}

void RoomChoice::choose(double seconds, std::span<const RoomSeen> seen, std::span<const RoomOption> options,
                        double tolerance_px, double budget_us) {
    wanted_.clear();
    next_.clear();
    double wanted_us = 0.0;
    double kept_us = 0.0;
    for (const RoomSeen& each : seen) {
        const std::span<const RoomOption> own = of_object(each, options);
        const std::uint32_t present = chosen_[each.object];
        const std::uint32_t wanted = enough(own, present, tolerance_px);
        const bool saves =
            wanted != none && present < own.size() && own[present].cost_us < own[wanted].cost_us;
        const std::uint32_t kept = short_ && saves ? present : wanted; // an earlier frame saved time here
        wanted_us += wanted != none ? own[wanted].cost_us : 0.0;
        kept_us += kept != none ? own[kept].cost_us : 0.0;
        wanted_.push_back(wanted);
        next_.push_back(kept);
    }
    const bool waits = seconds >= changed_s_ && seconds - changed_s_ < dwell_s;
    const double limit_us = short_ ? entered_budget * budget_us : budget_us;
    if (wanted_us <= limit_us) {
        if (!short_ || !waits) {
            short_ = false;
            next_ = wanted_;
            kept_us = wanted_us;
        }
        cost_us_ = kept_us;
    } else if (short_ && kept_us <= budget_us && (waits || kept_us >= wasted_budget * budget_us)) {
        cost_us_ = kept_us;
    } else {
        next_ = wanted_;
        cost_us_ = wanted_us;
        coarsen(seen, options, entered_budget * budget_us);
        short_ = true;
        changed_s_ = seconds;
    }
    for (std::size_t k = 0; k < seen.size(); ++k) {
        chosen_[seen[k].object] = next_[k];
    }
}

} // namespace frustumscreen::scene
