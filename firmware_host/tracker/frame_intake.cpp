#include "firmware_host/tracker/frame_intake.h"

namespace frustumscreen {

namespace {

/// A counter this far off is a broken one, or a device that began anew.
constexpr std::int32_t far_off = 1000;
/// So many later ones in a row, and it did begin anew.
constexpr int enough_to_believe = 4;
/// How long a fault must be gone, or the prop's sensor unheard, before the state says so.
constexpr Nanoseconds settling = std::chrono::milliseconds(500);
/// Of 255. Sensors in clean surroundings stay near 0; to be set by a real device beside real metal.
constexpr int metal_near_distortion = 64;

} // namespace

FrameIntake::Order FrameIntake::order_of(int sensor, std::uint32_t counter) {
    Sequence& sequence = sequences_[static_cast<std::size_t>(sensor) % sequences_.size()];
    if (sequence.last) {
        const auto step = static_cast<std::int32_t>(counter - *sequence.last);
        if (step == 0) {
            ++counts_.duplicated;
            return Order::Refused;
        }
        if (step < 0 || step > far_off) {
            const auto strange_step = static_cast<std::int32_t>(counter - sequence.strange.value_or(counter));
            if (sequence.strange && strange_step == 0) {
                ++counts_.duplicated;
                return Order::Refused;
            }
            const bool follows = strange_step > 0 && strange_step <= far_off;
            sequence.strange_run = follows ? sequence.strange_run + 1 : 0;
            sequence.strange = counter;
            if (sequence.strange_run < enough_to_believe) {
                ++(step < 0 && step >= -far_off ? counts_.reordered : counts_.strange);
                return Order::Refused;
            }
        } else {
            counts_.lost += static_cast<std::uint64_t>(step - 1);
        }
    }
    sequence.last = counter;
    sequence.strange.reset();
    return Order::Next;
}

bool FrameIntake::take(const DeviceFrame& frame, MonotonicTime arrival, std::vector<PoseSample>& samples) {
    std::optional<MonotonicTime> time;
    for (std::size_t k = 0; k < frame.count; ++k) {
        const SensorPose& pose = frame.sensors[k];
        if (order_of(pose.sensor, frame.counter) == Order::Refused) {
            continue;
        }
        if (!time) {
            time = clock_.time_of(frame.tick, arrival);
        }
        if (pose.sensor == prop_station && pose.present) {
            prop_seen_ = arrival;
            prop_usable_ = pose.usable ? arrival : prop_usable_;
        }
        if (pose.distortion >= metal_near_distortion) {
            distorted_ = arrival;
        }
        counts_.unusable += pose.usable ? 0U : 1U;
        PoseSample sample;
        sample.time = *time;
        sample.station = pose.sensor;
        sample.ok = pose.usable;
        if (pose.usable) {
            sample.position_m = pose.position_m;
            sample.rotation = glm::normalize(pose.rotation);
        }
        samples.push_back(sample);
    }
    if (time || frame.count == 0) {
        ++counts_.frames;
        latest_ = arrival;
        began_ = began_ ? began_ : arrival;
        return true;
    }
    return false;
}

UsbTrackerState FrameIntake::state(MonotonicTime now) const {
    const auto long_since = [&](const std::optional<MonotonicTime>& last) {
        const std::optional<MonotonicTime> since = last ? last : began_;
        return since && now - *since > settling;
    };
    if (long_since(prop_seen_)) {
        return UsbTrackerState::SensorMissing;
    }
    if (long_since(prop_usable_)) {
        return UsbTrackerState::PosesUnusable;
    }
    if (distorted_ && now - *distorted_ < settling) {
        return UsbTrackerState::MetalNear;
    }
    return UsbTrackerState::Streaming;
}

} // namespace frustumscreen
