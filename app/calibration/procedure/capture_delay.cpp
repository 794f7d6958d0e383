#include "app/calibration/procedure/capture_delay.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::calibration {

namespace {

/// Tolerances as a share of a part's change and in grey levels, for noise and flicker.
constexpr double near_share = 0.1;
constexpr double near_levels = 4.0;

} // namespace

CaptureDelay::Parts CaptureDelay::parts_of(const camera::CameraFrame& frame) {
    constexpr int every = 3; // samples enough pixels of each part
    Parts sums{};
    Parts counts{};
    for (int y = 0; y < frame.height; y += every) {
        for (int x = 0; x < frame.width; x += every) {
            const int row = y * rows / frame.height;
            const int column = x * columns / frame.width;
            const std::size_t part =
                static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
            sums[part] += frame.luma[static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
                                     static_cast<std::size_t>(x)];
            counts[part] += 1.0;
        }
    }
    for (std::size_t part = 0; part < sums.size(); ++part) {
        sums[part] /= std::fmax(1.0, counts[part]);
    }
    return sums;
}

void CaptureDelay::step(std::optional<MonotonicTime> lit, const camera::CameraFrame* frame) {
    if (frame == nullptr || !lit || is_done() || frame->time < *lit) {
        return;
    }
    looks_.push_back({frame->time, parts_of(*frame)});
    if (frame->time - *lit >= settled) {
        judge(*lit);
        before_ = looks_.back().parts;
        looks_.clear();
        ++change_;
    }
}

void CaptureDelay::judge(MonotonicTime lit) {
    if (change_ == 0) {
        return;
    }
    const Parts& end = looks_.back().parts;
    const auto has_settled = [&](const Look& look) {
        for (std::size_t part = 0; part < end.size(); ++part) {
            const double limit = std::fmax(near_levels, near_share * std::abs(end[part] - before_[part]));
            if (std::abs(look.parts[part] - end[part]) > limit) {
                return false;
            }
        }
        return true;
    };
    for (std::size_t part = 0; part < end.size(); ++part) {
        swing_ = std::fmax(swing_, std::abs(end[part] - before_[part]));
    }
    const auto last_other = std::find_if_not(looks_.rbegin(), looks_.rend(), has_settled);
    delay_ = std::max(delay_, last_other.base()->time - lit); // dereferences: the last look has settled
}

} // namespace frustumscreen::calibration
