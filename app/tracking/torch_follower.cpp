#include "app/tracking/torch_follower.h"

#include <memory>

namespace frustumscreen::tracking {

namespace {

/// From the torch to what it lights: its light's place moves by the torch's turn times this.
constexpr double throw_m = 0.4;

/// A torch is waved faster than a prop is carried.
PoseEstimatorOptions torch_options() {
    PoseEstimatorOptions options;
    options.surprise_m = 0.08;
    options.surprise_rad = 0.7;
    options.speed_m_s = 4.0;
    options.turn_rad_s = 25.0;
    return options;
}

} // namespace

TorchFollower::TorchFollower(const SteadyFilterOptions& options, Nanoseconds lost_after)
    : estimator_(std::make_unique<SteadyFilter>(options), torch_options()),
      shown_({.slack_m = 0.0004, .lever_m = throw_m}), lost_after_(lost_after) {}

TrackedTorch TorchFollower::at(MonotonicTime lit) {
    const PoseEstimate estimate = estimator_.at(lit);
    if (estimate.reinitialisations == 0) {
        return {};
    }
    const bool known = estimate.status != PoseStatus::Stale && estimate.age <= lost_after_;
    TrackedTorch torch;
    torch.table_from_torch = shown_.follow(estimate, lit);
    torch.share = share_.update(lit, known ? std::optional(estimate.pose) : std::nullopt);
    torch.presence = !known         ? TorchPresence::Lost
                     : share_.lit() ? TorchPresence::InHand
                                    : TorchPresence::Lies;
    return torch;
}

} // namespace frustumscreen::tracking
