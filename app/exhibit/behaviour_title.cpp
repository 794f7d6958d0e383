#include "app/exhibit/behaviour_title.h"

#include "app/geometry/time_curves.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::exhibit {

std::optional<PresentedTitle> BehaviourTitle::step(MonotonicTime now, const Input& input) {
    const double step = to_seconds(now - std::exchange(last_, now)) / to_seconds(Sentences::leaves);
    const bool stays = placed_ == input.title;
    share_ = std::clamp(share_ + (stays ? step : -step), 0.0, 1.0);
    // Another artifact fades in with its own light, so the old title need not fade out.
    const bool other_artifact = placed_ && input.title && placed_->artifact != input.title->artifact;
    if (!stays && (share_ <= 0.0 || placer_.at(now).opacity <= 0.0 || other_artifact)) {
        placed_ = input.title;
        share_ = 1.0; // the placer fades it in
        placer_.set_shapes(placed_ ? std::span(&input.size_m, 1) : std::span<const glm::dvec2>());
    }
    changing_ = false;
    if (!placed_) {
        return std::nullopt;
    }
    const SentenceEnvironment& environment = input.environment;
    placer_.set_obstacles(input.obstacles);
    placer_.update(now, environment.around, environment.hidden, environment.prop_m,
                   environment.quarter_turns);
    const typography::CaptionPlace place = placer_.at(now);
    const double brightness = place.opacity * geometry::ease(share_) * input.light;
    changing_ = placed_ != input.title || share_ < 1.0 || (place.opacity > 0.0 && place.opacity < 1.0);
    return brightness > 0.0 ? std::optional(PresentedTitle{
                                  .title = *placed_, .rectangle = place.rectangle, .brightness = brightness})
                            : std::nullopt;
}

} // namespace frustumscreen::exhibit
