#include "app/show/set_trial.h"

#include <fmt/format.h>

#include <utility>

namespace frustumscreen::show {

SetTrial::SetTrial(library::SetChoice choice, const std::optional<library::SetVerdict>& verdict, Trust trust)
    : choice_(std::move(choice)), trust_(choice_.last_good ? trust : Trust::Newest) {
    verdict_.number = choice_.set.number;
    if (verdict && verdict->number == verdict_.number) {
        verdict_ = *verdict;
    }
    begin();
}

void SetTrial::take(library::SetChoice choice) {
    const bool other = choice.set.number != choice_.set.number;
    if (!other && trust_ == Trust::Before && !choice.last_good) {
        choice.last_good = std::move(choice_.last_good);
    }
    choice_ = std::move(choice);
    if (other) {
        trust_ = Trust::Newest;
        verdict_ = {
            .number = choice_.set.number, .state = library::TrialState::Trying, .starts = 0, .reason = {}};
        since_.reset();
        begin();
    }
}

void SetTrial::begin() {
    if (verdict_.state != library::TrialState::Trying || trust_ == Trust::Before) {
        return; // the exhibit does not begin with it
    }
    if (choice_.last_good && verdict_.starts >= library::max_starts) {
        refuse(verdict_.number,
               fmt::format("the exhibit started with it {} times and never showed it for {} s",
                           verdict_.starts, long_enough / std::chrono::seconds(1)));
    } else {
        ++verdict_.starts;
    }
}

library::SetVerdict SetTrial::told() const {
    if (trust_ == Trust::Newest || verdict_.state == library::TrialState::Bad) {
        return verdict_;
    }
    return {.number = verdict_.number,
            .state = library::TrialState::Bad,
            .starts = verdict_.starts,
            .reason = "the watchdog returned to the previous set; it tries this one again after ten minutes "
                      "without a fault"};
}

void SetTrial::shown(MonotonicTime now, std::uint64_t number, const std::string& fault) {
    if (number != verdict_.number) {
        since_.reset();
        return;
    }
    if (!fault.empty()) {
        refuse(number, fault);
        return;
    }
    if (!since_ || now < latest_ || now - latest_ > longest_silence) {
        since_ = now;
    }
    latest_ = now;
    if (verdict_.state == library::TrialState::Trying && now - *since_ >= long_enough) {
        verdict_.state = library::TrialState::Good;
    }
}

void SetTrial::refuse(std::uint64_t number, const std::string& reason) {
    if (number == verdict_.number && verdict_.state == library::TrialState::Trying) {
        verdict_.state = library::TrialState::Bad;
        verdict_.reason = reason;
        since_.reset();
    }
}

} // namespace frustumscreen::show
