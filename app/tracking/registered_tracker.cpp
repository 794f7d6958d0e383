#include "app/tracking/registered_tracker.h"

namespace frustumscreen::tracking {

namespace {

/// Pose of the station's target (prop or eye) in its sensor's frame.
geometry::RigidTransform sensor_from_target(int station, const geometry::Registration& registration) {
    if (station == tracker::prop_station) {
        return registration.sensor_from_prop;
    }
    geometry::RigidTransform eye;
    if (station == tracker::head_station) {
        eye.translation = registration.eye_in_sensor_m;
    }
    return eye;
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
