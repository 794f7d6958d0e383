#include "app/tracking/signal_meter.h"

#include "app/geometry/rotation_angle.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::tracking {

void SignalMeter::take(const tracker::PoseSample& sample) {
    samples_[count_++ % max_samples] = sample;
}

TrackerSignal SignalMeter::at(MonotonicTime now) const {
    const std::size_t kept = std::min(count_, max_samples);
    const auto each = [&](const auto& use) {
        for (std::size_t k = 0; k < kept; ++k) {
            if (const tracker::PoseSample& sample = samples_[k]; now - sample.time < window) {
                use(sample);
            }
        }
    };
    std::size_t all = 0, usable = 0;
    glm::dvec3 middle(0.0);
    glm::dquat turn(0.0, 0.0, 0.0, 0.0);
    each([&](const tracker::PoseSample& sample) {
        ++all;
        if (sample.ok) {
            ++usable;
            middle += sample.position_m;
            turn += glm::dot(turn, sample.rotation) < 0.0 ? -sample.rotation : sample.rotation;
        }
    });
    TrackerSignal signal;
    signal.rate_hz = static_cast<double>(all) / to_seconds(window);
    signal.usable = all > 0 ? static_cast<double>(usable) / static_cast<double>(all) : 0.0;
    if (usable < min_samples || !(glm::length(turn) > 0.0)) {
        return signal;
    }
    middle /= static_cast<double>(usable);
    turn = glm::normalize(turn);
    double squares_m2 = 0.0, squares_rad2 = 0.0;
    each([&](const tracker::PoseSample& sample) {
        if (sample.ok) {
            const glm::dvec3 off_m = sample.position_m - middle;
            const double off_rad = geometry::rotation_angle(sample.rotation, turn);
            squares_m2 += glm::dot(off_m, off_m);
            squares_rad2 += off_rad * off_rad;
        }
    });
    signal.noise_mm = 1e3 * std::sqrt(squares_m2 / static_cast<double>(usable));
    signal.noise_deg = glm::degrees(std::sqrt(squares_rad2 / static_cast<double>(usable)));
    return signal;
}

} // namespace frustumscreen::tracking
