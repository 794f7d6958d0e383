#include "firmware_host/tracker/sequence_checker.h"

namespace frustumscreen::tracker {

namespace {

/// A counter this far off is corrupt, or the device restarted.
constexpr std::int32_t far_off = 1000;
/// This many consistent counters in a row mean that the device restarted.
constexpr int enough_to_believe = 4;
/// A fault must be gone, or the prop's sensor silent, for this long before the state changes; longer for a
/// slow device.
constexpr Nanoseconds settling = std::chrono::milliseconds(500);
/// The timeout of a device until its second frame, while its frame interval is unknown.
constexpr Nanoseconds unknown_pace = std::chrono::milliseconds(1500);
constexpr int gaps_until_timeout = 3;
constexpr Nanoseconds min_timeout = std::chrono::milliseconds(250);
constexpr Nanoseconds max_timeout = std::chrono::seconds(4);
constexpr int frames_to_forget = 10; ///< after which a long gap is forgotten
/// A pose that arrives this late cannot show where the prop is now.
constexpr Nanoseconds old_age = std::chrono::milliseconds(500);
/// Limit on a scale to 255. Sensors in clean surroundings stay near 0. Not yet confirmed with a real device
/// near metal.
constexpr int metal_near_distortion = 64;

} // namespace

SequenceChecker::Order SequenceChecker::order_of(int sensor, std::uint32_t counter) {
    Sequence& sequence = sequences_[static_cast<std::size_t>(sensor) % sequences_.size()];
    if (sequence.last) {
        const auto step = static_cast<std::int32_t>(counter - *sequence.last);
        if (step == 0) {
            ++counts_.duplicated;
            return Order::Refused;
        }
        if (step < 0 || step > far_off) {
            const auto implausible_step =
                static_cast<std::int32_t>(counter - sequence.implausible.value_or(counter));
            if (sequence.implausible && implausible_step == 0) {
                ++counts_.duplicated;
                return Order::Refused;
            }
            const bool follows = implausible_step > 0 && implausible_step <= far_off;
            sequence.implausible_run = follows ? sequence.implausible_run + 1 : 0;
            sequence.implausible = counter;
            if (sequence.implausible_run < enough_to_believe) {
                ++(step < 0 && step >= -far_off ? counts_.reordered : counts_.implausible);
                return Order::Refused;
            }
        } else {
            counts_.lost += static_cast<std::uint64_t>(step - 1);
        }
    }
    sequence.last = counter;
    sequence.implausible.reset();
    return Order::Next;
}

bool SequenceChecker::take(const DeviceFrame& frame, MonotonicTime arrival,
                           std::vector<PoseSample>& samples) {
    std::optional<MonotonicTime> time;
    for (std::size_t k = 0; k < frame.count; ++k) {
        const SensorPose& pose = frame.sensors[k];
        if (order_of(pose.sensor, frame.counter) == Order::Refused) {
            continue;
        }
        if (!time) {
            time = clock_.time_of(frame.tick, arrival);
            late_ = !clock_.believed() || arrival - *time > old_age ? arrival : late_;
        }
        if (pose.sensor == prop_station && pose.present) {
            prop_seen_ = arrival;
            prop_usable_ = pose.usable ? arrival : prop_usable_;
        }
        // Metal near the torch alone bends no pose of the prop or the head.
        if (pose.distortion >= metal_near_distortion && pose.sensor != torch_station) {
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
        if (latest_ && frame.counter != latest_counter_) { // otherwise another sensor of the same instant
            longest_gap_ = std::max(arrival - *latest_, longest_gap_ - longest_gap_ / frames_to_forget);
        }
        latest_ = arrival;
        latest_counter_ = frame.counter;
        began_ = began_ ? began_ : arrival;
        faulty_ = frame.fault ? arrival : faulty_;
        return true;
    }
    return false;
}

TrackerCounts SequenceChecker::counts() const {
    TrackerCounts counts = counts_;
    counts.clock_restarts = clock_.restarts();
    counts.clock_drift = clock_.drift();
    return counts;
}

Nanoseconds SequenceChecker::timeout() const {
    return longest_gap_ > Nanoseconds::zero()
               ? std::clamp<Nanoseconds>(gaps_until_timeout * longest_gap_, min_timeout, max_timeout)
               : unknown_pace;
}

UsbTrackerState SequenceChecker::state(MonotonicTime now) const {
    const Nanoseconds settled = std::max(settling, timeout());
    const auto lately = [&](const std::optional<MonotonicTime>& last) {
        return last && now - *last < settled;
    };
    const auto long_since = [&](const std::optional<MonotonicTime>& last) {
        const std::optional<MonotonicTime> since = last ? last : began_;
        return since && now - *since > settled;
    };
    if (long_since(prop_seen_)) {
        return UsbTrackerState::SensorMissing;
    }
    if (lately(faulty_)) {
        return UsbTrackerState::DeviceFault;
    }
    if (long_since(prop_usable_)) {
        return UsbTrackerState::PosesUnusable;
    }
    if (lately(late_)) {
        return UsbTrackerState::PosesLate;
    }
    if (lately(distorted_)) {
        return UsbTrackerState::MetalNear;
    }
    return UsbTrackerState::Streaming;
}

} // namespace frustumscreen::tracker
