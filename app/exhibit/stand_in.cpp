#include "app/exhibit/stand_in.h"

#include "app/geometry/time_curves.h"

#include <algorithm>

namespace frustumscreen {

std::optional<PresentedStandIn> StandIn::step(MonotonicTime now, const Input& input) {
    if (artifact_) {
        const double step = to_seconds(now - last_) / to_seconds(each_way);
        presence_ = std::clamp(presence_ + (artifact_ == input.artifact ? step : -step), 0.0, 1.0);
    }
    last_ = now;
    if (presence_ <= 0.0 && artifact_ != input.artifact) {
        artifact_ = input.artifact;
        from_ =
            input.from.value_or(TableRectangle{input.to.centre_m, glm::dvec2(0.0), input.to.quarter_turns});
        since_ = now;
    }
    if (!artifact_ || presence_ <= 0.0) {
        return std::nullopt;
    }
    const double grown = ease(to_seconds(now - since_) / to_seconds(growing));
    return PresentedStandIn{*artifact_,
                            {glm::mix(from_.centre_m, input.to.centre_m, grown),
                             glm::mix(from_.size_m, input.to.size_m, grown), input.to.quarter_turns},
                            ease(presence_)};
}

} // namespace frustumscreen
