#include "app/tracking/registered_tracker.h"

namespace frustumscreen {

namespace {

/// Pose of the station's target (prop or eye) in its sensor's frame.
RigidTransform sensor_from_target(int station, const Registration& registration) {
    if (station == prop_station) {
        return registration.sensor_from_prop;
    }
    RigidTransform eye;
    if (station == head_station) {
        eye.translation = registration.eye_in_sensor_m;
    }
    return eye;
}

} // namespace

void place_on_table(std::span<PoseSample> samples, const Registration& registration) {
    for (PoseSample& sample : samples) {
        if (sample.ok) {
            const RigidTransform tracker_from_sensor{sample.rotation, sample.position_m};
            const RigidTransform placed = registration.table_from_tracker * tracker_from_sensor *
                                          sensor_from_target(sample.station, registration);
            sample.position_m = placed.translation;
            sample.rotation = placed.rotation;
        }
    }
}

RegisteredTracker::RegisteredTracker(std::unique_ptr<Tracker> device, const Registration& registration)
    : device_(std::move(device)) {
    if (!device_->reports_table_frame()) {
        registration_ = registration;
    }
}

Result<void> RegisteredTracker::poll(MonotonicTime now, std::vector<PoseSample>& samples) {
    const std::size_t before = samples.size();
    Result<void> polled = device_->poll(now, samples);
    if (registration_) {
        place_on_table(std::span(samples).subspan(before), *registration_);
    }
    return polled;
}

} // namespace frustumscreen
