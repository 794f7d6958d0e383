#include "app/guidance/advise.h"

namespace frustumscreen {

std::optional<Advice> advise(const FaceReader& reader, const GuidedSituation& situation,
                             const std::optional<GivenAdvice>& standing) {
    AdviceSearch search;
    search.begin(reader, situation, standing);
    static_cast<void>(search.advance(reader, AdviceSearch::unlimited));
    return search.found();
}

void Advisor::begin(const GuidedSituation& situation) {
    search_.begin(reader_, situation, standing_);
}

bool Advisor::advance(int looks) {
    if (!search_.advance(reader_, looks)) {
        return false;
    }
    const std::optional<Advice>& advice = search_.found();
    if (!advice) {
        standing_.reset();
    } else if (!standing_ || !alike(standing_->move, advice->move) ||
               !standing_->holds(search_.situation())) {
        standing_ = GivenAdvice{advice->move, search_.situation()};
    }
    return true;
}

std::optional<Advice> Advisor::advise(const GuidedSituation& situation) {
    begin(situation);
    static_cast<void>(advance(AdviceSearch::unlimited));
    return search_.found();
}

} // namespace frustumscreen
