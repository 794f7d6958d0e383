#include "app/exhibit/visitor_guide.h"

#include "app/exhibit/guidance_setup.h"

namespace frustumscreen::exhibit {

VisitorGuide::VisitorGuide(const std::optional<guidance::GuidanceSetup>& setup)
    : guide_(setup ? std::optional<guidance::Guide>(*setup) : std::nullopt) {}

void VisitorGuide::step(MonotonicTime now, const VisitorGuideInput& input) {
    guidance_ = guide(now, input);
}

const guidance::Guidance* VisitorGuide::guide(MonotonicTime now, const VisitorGuideInput& input) {
    answers_ = false;
    const tracking::TrackedState& tracked_state = input.tracked_state;
    const guidance::Sensing sensing =
        sensed_.update(now, tracked_state, input.lost, input.presence.touched());
    const bool on_way = sensing == guidance::Sensing::Good && is_on_way_to_picture(now, input);
    const bool can_be_guided = input.lost || (tracked_state.prop_known && !input.drawn.attracts);
    if (!guide_ || !input.presence.is_there() || !can_be_guided || !input.permitted) {
        return nullptr;
    }
    if (input.table != nullptr && input.table->prop_is_on_picture()) {
        guide_->be_quiet(now); // a prop that chooses a picture needs no advice
        return nullptr;
    }
    guide_->show(input.hull);
    if (input.help) {
        guide_->ask();
    } else if (on_way) {
        guide_->be_quiet(now);
        return nullptr;
    }
    const guidance::Guidance& guidance =
        guide_->step(now, guided_state(guide_->reader().setup(), tracked_state), sensing, input.may_speak);
    answers_ = input.help && guide_->answers();
    return guidance.stage != guidance::GuidanceStage::Quiet ? &guidance : nullptr;
}

/// True while the prop slides between pictures, on the way to one and back: new advice waits until the prop stands,
/// or has been moving for long.
bool VisitorGuide::is_on_way_to_picture(MonotonicTime now, const VisitorGuideInput& input) {
    constexpr Nanoseconds longest_way = std::chrono::seconds(4);
    if (!input.presence.prop_moves(now)) {
        way_since_.reset();
        return false;
    }
    way_since_ = way_since_ ? way_since_ : now;
    const bool pictures = input.table != nullptr && input.table->presented().count > 0;
    return pictures && guidance_ == nullptr && now - *way_since_ < longest_way;
}

void VisitorGuide::forget_visitor() {
    sensed_.forget();
    if (guide_) {
        guide_->forget();
    }
}

void VisitorGuide::drop_artifact() {
    if (guide_) {
        guide_->show({});
    }
    answers_ = false;
}

} // namespace frustumscreen::exhibit
