#include "app/guidance/advise.h"

namespace frustumscreen::guidance {

std::optional<Advice> advise(const FaceReader& reader, const GuidedState& tracked_state,
                             const std::optional<GivenAdvice>& standing) {
    AdviceSearch search;
    search.begin(reader, tracked_state, standing);
    static_cast<void>(search.advance(reader, AdviceSearch::unlimited));
    return search.found();
}

void Advisor::begin(const GuidedState& tracked_state) {
    search_.begin(reader_, tracked_state, standing_);
}

bool Advisor::advance(int looks) {
    if (!search_.advance(reader_, looks)) {
        return false;
    }
    const std::optional<Advice>& advice = search_.found();
    if (!advice) {
        standing_.reset();
    } else if (!standing_ || !alike(standing_->move, advice->move) ||
               !standing_->holds(search_.tracked_state())) {
        standing_ = GivenAdvice{advice->move, search_.tracked_state()};
    }
    return true;
}

std::optional<Advice> Advisor::advise(const GuidedState& tracked_state) {
    begin(tracked_state);
    static_cast<void>(advance(AdviceSearch::unlimited));
    return search_.found();
}

} // namespace frustumscreen::guidance
