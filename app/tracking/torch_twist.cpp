#include "app/tracking/torch_twist.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::tracking {

namespace {

/// Below this the axis has turned by more than 150 degrees, and the twist beside such a swing is not defined well.
constexpr double min_cosine_of_half_swing = 0.26;

} // namespace

void TorchTwist::begin(const glm::dquat& table_from_torch) {
    reference_ = table_from_torch;
    before_rad_ = twist_rad_ = counted_rad_ = usual_at_rad_ = 0.0;
    opening_rad_ = bounds_.usual_rad;
}

double TorchTwist::follow(const glm::dquat& table_from_torch) {
    const glm::dquat since = glm::conjugate(reference_) * table_from_torch;
    if (std::hypot(since.w, since.z) < min_cosine_of_half_swing) {
        before_rad_ = twist_rad_;
        reference_ = table_from_torch;
        return opening_rad_;
    }
    constexpr double turn = 2.0 * std::numbers::pi;
    const double twist = before_rad_ + 2.0 * std::atan2(since.z, since.w);
    twist_rad_ = twist + turn * std::round((twist_rad_ - twist) / turn); // the turn that is nearest to before
    counted_rad_ = std::clamp(counted_rad_, twist_rad_ - dead_rad, twist_rad_ + dead_rad);
    const double low = doubles_rad * std::log2(bounds_.min_rad / bounds_.usual_rad);
    const double high = doubles_rad * std::log2(bounds_.max_rad / bounds_.usual_rad);
    usual_at_rad_ = std::clamp(usual_at_rad_, counted_rad_ - high, counted_rad_ - low);
    opening_rad_ = std::clamp(bounds_.usual_rad * std::exp2((counted_rad_ - usual_at_rad_) / doubles_rad),
                              bounds_.min_rad, bounds_.max_rad);
    return opening_rad_;
}

} // namespace frustumscreen::tracking
