#include "firmware_host/tracker/simulated_tracker.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustumscreen::tracker {

namespace {

/// Purposes of the random numbers; each has its own sequence.
enum class Purpose : std::uint64_t {
    PropX,
    PropY,
    BendX,
    BendY,
    Yaw,
    Begin,
    Length,
    TurnOnly,
    HeadX,
    HeadY,
    HeadZ
};

/// Each slot contains one movement.
constexpr double prop_slot_s = 4.0;
constexpr double head_slot_s = 3.1;

/// SplitMix64 (Steele, Lea and Flood 2014) of seed, purpose and number; from 0 to 1.
double random(std::uint64_t seed, Purpose purpose, std::int64_t number) {
    std::uint64_t z = seed * 0x9E3779B97F4A7C15U + static_cast<std::uint64_t>(purpose) * 0xD1B54A32D192ED03U +
                      static_cast<std::uint64_t>(number) * 0x8CB92BA72F3D8DD7U + 0x9E3779B97F4A7C15U;
    for (int round = 0; round < 2; ++round) {
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
        z ^= z >> 31U;
    }
    return static_cast<double>(z >> 11U) * 0x1p-53;
}

double random(std::uint64_t seed, Purpose purpose, std::int64_t number, double low, double high) {
    return low + (high - low) * random(seed, purpose, number);
}

double minimum_jerk(double s) {
    return s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
}

/// Progress of movement `slot` at `seconds`: 0 before it begins, 1 after it ends.
double progress(std::uint64_t seed, std::int64_t slot, double seconds, double slot_s) {
    const double length = random(seed, Purpose::Length, slot, 0.3, 0.65) * slot_s;
    const double begin = random(seed, Purpose::Begin, slot, 0.0, slot_s - length);
    const double within = seconds - static_cast<double>(slot) * slot_s;
    return minimum_jerk(std::clamp((within - begin) / length, 0.0, 1.0));
}

/// Only odd movements may be turns on the spot, so a place depends on at most one earlier movement.
bool turns_only(std::uint64_t seed, std::int64_t slot) {
    return slot % 2 != 0 && random(seed, Purpose::TurnOnly, slot) < 0.5;
}

glm::dvec2 place(const SimulatedVisitor& visitor, std::int64_t slot) {
    const std::int64_t number = turns_only(visitor.seed, slot - 1) ? slot - 1 : slot;
    return {random(visitor.seed, Purpose::PropX, number, -1.0, 1.0),
            random(visitor.seed, Purpose::PropY, number, -1.0, 1.0)};
}

double yaw(std::uint64_t seed, std::int64_t slot) {
    constexpr double widest = 0.8 * std::numbers::pi;
    return random(seed, Purpose::Yaw, slot, -widest, widest);
}

glm::dvec3 head(const SimulatedVisitor& visitor, std::int64_t slot) {
    return {random(visitor.seed, Purpose::HeadX, slot, -1.0, 1.0),
            random(visitor.seed, Purpose::HeadY, slot, -1.0, 1.0),
            random(visitor.seed, Purpose::HeadZ, slot, -1.0, 1.0)};
}

glm::dquat about_z(double angle) {
    return {std::cos(angle / 2.0), 0.0, 0.0, std::sin(angle / 2.0)};
}

} // namespace

PoseSample simulated_prop(const SimulatedVisitor& visitor, MonotonicTime start, Nanoseconds since_start) {
    const double seconds = to_seconds(since_start);
    const auto slot = static_cast<std::int64_t>(std::floor(seconds / prop_slot_s));
    const double s = progress(visitor.seed, slot, seconds, prop_slot_s);
    const glm::dvec2 from = place(visitor, slot);
    const glm::dvec2 to = place(visitor, slot + 1);
    glm::dvec2 at = from;
    if (!turns_only(visitor.seed, slot)) {
        // A control point within the unit square keeps the whole parabola within it.
        const glm::dvec2 bend =
            0.6 * 0.5 * (from + to) + 0.4 * glm::dvec2(random(visitor.seed, Purpose::BendX, slot, -1.0, 1.0),
                                                       random(visitor.seed, Purpose::BendY, slot, -1.0, 1.0));
        at = (1.0 - s) * (1.0 - s) * from + 2.0 * s * (1.0 - s) * bend + s * s * to;
    }
    PoseSample sample;
    sample.time = start + since_start;
    sample.station = prop_station;
    sample.position_m = glm::dvec3(visitor.centre_m + at * visitor.half_extent_m, 0.0);
    sample.rotation = about_z(glm::mix(yaw(visitor.seed, slot), yaw(visitor.seed, slot + 1), s));
    return sample;
}

PoseSample simulated_head(const SimulatedVisitor& visitor, MonotonicTime start, Nanoseconds since_start) {
    // The head has its own movements, hence another seed.
    SimulatedVisitor other = visitor;
    other.seed = visitor.seed ^ 0xA5A5A5A5A5A5A5A5U;
    const double seconds = to_seconds(since_start);
    const auto slot = static_cast<std::int64_t>(std::floor(seconds / head_slot_s));
    const double s = progress(other.seed, slot, seconds, head_slot_s);
    const PoseSample prop = simulated_prop(visitor, start, since_start);
    PoseSample sample;
    sample.time = prop.time;
    sample.station = head_station;
    sample.position_m =
        visitor.eye_m + visitor.half_sway_m * glm::mix(head(other, slot), head(other, slot + 1), s);
    const glm::dvec3 to_prop = prop.position_m - sample.position_m;
    sample.rotation = about_z(std::atan2(-to_prop.x, to_prop.y));
    return sample;
}

Result<void> SimulatedTracker::poll(MonotonicTime now, std::vector<PoseSample>& samples) {
    while (true) {
        const Nanoseconds since_start(std::llround(static_cast<double>(next_) * 1e9 / visitor_.rate_hz));
        if (start_ + since_start > now) {
            return {};
        }
        samples.push_back(simulated_prop(visitor_, start_, since_start));
        samples.push_back(simulated_head(visitor_, start_, since_start));
        ++next_;
    }
}

} // namespace frustumscreen::tracker
