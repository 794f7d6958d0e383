#include "app/tracking/registered_tracker.h"

namespace frustumscreen::tracking {

namespace {

/// The shortest turn of the X axis to `direction`.
glm::dquat turn_of_x_to(const glm::dvec3& direction) {
    constexpr double turned_round = 1e-12;
    const glm::dvec3 d = glm::normalize(direction);
    return 1.0 + d.x > turned_round ? glm::normalize(glm::dquat(1.0 + d.x, 0.0, -d.z, d.y))
                                    : glm::dquat(0.0, 0.0, 0.0, 1.0);
}

/// Pose of the station's target (prop or eye) in its sensor's frame.
geometry::RigidTransform sensor_from_target(int station, const geometry::Registration& registration) {
    if (station == tracker::prop_station) {
        return registration.sensor_from_prop;
    }
    if (station == tracker::head_station) {
        return {turn_of_x_to(registration.right_in_sensor), registration.eye_in_sensor_m};
    }
    if (station == tracker::torch_station) {
        return registration.sensor_from_torch;
    }
    return {};
}

} // namespace

void place_on_table(std::span<tracker::PoseSample> samples, const geometry::Registration& registration) {
    for (tracker::PoseSample& sample : samples) {
        if (sample.ok) {
            const geometry::RigidTransform tracker_from_sensor{sample.rotation, sample.position_m};
            const geometry::RigidTransform placed = registration.table_from_tracker * tracker_from_sensor *
                                                    sensor_from_target(sample.station, registration);
            sample.position_m = placed.translation;
            sample.rotation = placed.rotation;
        }
    }
}

RegisteredTracker::RegisteredTracker(std::unique_ptr<tracker::Tracker> device,
                                     const geometry::Registration& registration)
    : device_(std::move(device)) {
    if (!device_->reports_table_frame()) {
        registration_ = registration;
    }
}

Result<void> RegisteredTracker::poll(MonotonicTime now, std::vector<tracker::PoseSample>& samples) {
    const std::size_t before = samples.size();
    Result<void> polled = device_->poll(now, samples);
    if (registration_) {
        place_on_table(std::span(samples).subspan(before), *registration_);
    }
    return polled;
}

} // namespace frustumscreen::tracking
