#include "app/show/set_trial.h"

#include <fmt/format.h>

#include <utility>

namespace frustumscreen {

SetTrial::SetTrial(SetChoice choice, const std::optional<SetVerdict>& verdict) : choice_(std::move(choice)) {
    verdict_.number = choice_.set.number;
    if (verdict && verdict->number == verdict_.number) {
        verdict_ = *verdict;
    }
    begin();
}

void SetTrial::take(SetChoice choice) {
    const bool other = choice.set.number != choice_.set.number;
    choice_ = std::move(choice);
    if (other) {
        verdict_ = {choice_.set.number, Verdict::Trying, 0, {}};
        since_.reset();
        begin();
    }
}

void SetTrial::begin() {
    if (verdict_.verdict != Verdict::Trying) {
        return;
    }
    if (choice_.last_good && verdict_.starts >= most_starts) {
        refuse(verdict_.number,
               fmt::format("the exhibit began with it {} times and never came to show it for {} s",
                           verdict_.starts, long_enough / std::chrono::seconds(1)));
    } else {
        ++verdict_.starts;
    }
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
    if (verdict_.verdict == Verdict::Trying && now - *since_ >= long_enough) {
        verdict_.verdict = Verdict::Good;
    }
}

void SetTrial::refuse(std::uint64_t number, const std::string& reason) {
    if (number == verdict_.number && verdict_.verdict == Verdict::Trying) {
        verdict_.verdict = Verdict::Bad;
        verdict_.reason = reason;
        since_.reset();
    }
}

} // namespace frustumscreen
