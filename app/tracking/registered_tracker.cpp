#include "app/tracking/registered_tracker.h"

namespace frustumscreen {

void place_on_table(std::span<PoseSample> samples, const RigidTransform& table_from_tracker) {
    for (PoseSample& sample : samples) {
        if (sample.ok) {
            const RigidTransform tracker_from_station{sample.rotation, sample.position_m};
            const RigidTransform placed = table_from_tracker * tracker_from_station;
            sample.position_m = placed.translation;
            sample.rotation = placed.rotation;
        }
    }
}

RegisteredTracker::RegisteredTracker(std::unique_ptr<Tracker> device,
                                     const RigidTransform& table_from_tracker)
    : device_(std::move(device)) {
    if (!device_->reports_table_frame()) {
        registration_ = table_from_tracker;
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
