#include "app/show/set_trial.h"

#include <fmt/format.h>

#include <utility>

namespace frustumscreen {

SetTrial::SetTrial(SetChoice choice, const std::optional<SetVerdict>& verdict, Trust trust)
    : choice_(std::move(choice)), trust_(choice_.last_good ? trust : Trust::Newest) {
    verdict_.number = choice_.set.number;
    if (verdict && verdict->number == verdict_.number) {
        verdict_ = *verdict;
    }
    begin();
}

void SetTrial::take(SetChoice choice) {
    const bool other = choice.set.number != choice_.set.number;
    if (!other && trust_ == Trust::Before && !choice.last_good) {
        choice.last_good = std::move(choice_.last_good);
    }
    choice_ = std::move(choice);
    if (other) {
        trust_ = Trust::Newest;
        verdict_ = {choice_.set.number, TrialState::Trying, 0, {}};
        since_.reset();
        begin();
    }
}

void SetTrial::begin() {
    if (verdict_.state != TrialState::Trying || trust_ == Trust::Before) {
        return; // the exhibit does not begin with it
    }
    if (choice_.last_good && verdict_.starts >= max_starts) {
        refuse(verdict_.number,
               fmt::format("the exhibit began with it {} times and never came to show it for {} s",
                           verdict_.starts, long_enough / std::chrono::seconds(1)));
    } else {
        ++verdict_.starts;
    }
}

SetVerdict SetTrial::told() const {
    if (trust_ == Trust::Newest || verdict_.state == TrialState::Bad) {
        return verdict_;
    }
    return {verdict_.number, TrialState::Bad, verdict_.starts,
            "the watchdog went back to the set before, and tries this one again after ten good minutes"};
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
    if (verdict_.state == TrialState::Trying && now - *since_ >= long_enough) {
        verdict_.state = TrialState::Good;
    }
}

void SetTrial::refuse(std::uint64_t number, const std::string& reason) {
    if (number == verdict_.number && verdict_.state == TrialState::Trying) {
        verdict_.state = TrialState::Bad;
        verdict_.reason = reason;
        since_.reset();
    }
}

} // namespace frustumscreen
