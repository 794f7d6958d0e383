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
    HeadZ,
    TorchX,
    TorchY,
    TorchZ,
    AimX,
    AimY,
    AimZ,
    TorchRoll
};

/// Each slot contains one movement.
constexpr double prop_slot_s = 4.0;
constexpr double head_slot_s = 3.1;
constexpr double torch_slot_s = 2.6;
/// Movements with the torch in a round; the last two are to where it lies, and there.
constexpr std::int64_t torch_round = 9;

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

/// Where the torch is at the end of a movement, what it aims at there, and its twist.
struct Aim {
    glm::dvec3 from_m{0.0}, at_m{0.0};
    double roll = 0.0;
};

Aim mix(const Aim& a, const Aim& b, double s) {
    return {glm::mix(a.from_m, b.from_m, s), glm::mix(a.at_m, b.at_m, s), glm::mix(a.roll, b.roll, s)};
}

Aim aim(const SimulatedVisitor& visitor, std::int64_t slot, const glm::dvec3& prop_m) {
    const glm::dvec3 hand(visitor.centre_m + visitor.half_extent_m * glm::dvec2(1.3, -1.6), 0.24);
    if ((slot % torch_round + torch_round) % torch_round >= torch_round - 2) {
        const glm::dvec3 lies(hand.x + 0.05, hand.y, 0.02);
        return {lies, lies + glm::dvec3(0.0, 0.3, 0.0), 0.0};
    }
    const auto any = [&](Purpose purpose, double half) {
        return random(visitor.seed, purpose, slot, -half, half);
    };
    return {
        hand + glm::dvec3(any(Purpose::TorchX, 0.06), any(Purpose::TorchY, 0.05), any(Purpose::TorchZ, 0.05)),
        prop_m +
            glm::dvec3(any(Purpose::AimX, 0.07), any(Purpose::AimY, 0.07), 0.07 + any(Purpose::AimZ, 0.04)),
        any(Purpose::TorchRoll, 0.7)};
}

/// +Z along `direction`, +Y down, then turned about +Z.
glm::dquat pointing(const glm::dvec3& direction, double roll) {
    const glm::dvec3 z = glm::normalize(direction);
    const glm::dvec3 x = glm::normalize(glm::cross(z, glm::dvec3(0.0, 0.0, 1.0)));
    return glm::normalize(glm::quat_cast(glm::dmat3(x, glm::cross(z, x), z)) * about_z(roll));
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

PoseSample simulated_torch(const SimulatedVisitor& visitor, MonotonicTime start, Nanoseconds since_start) {
    SimulatedVisitor hand = visitor; // has its own movements, hence another seed
    hand.seed = visitor.seed ^ 0x5A5A5A5A5A5A5A5AU;
    const double seconds = to_seconds(since_start);
    const auto slot = static_cast<std::int64_t>(std::floor(seconds / torch_slot_s));
    const PoseSample prop = simulated_prop(visitor, start, since_start);
    Aim now = mix(aim(hand, slot, prop.position_m), aim(hand, slot + 1, prop.position_m),
                  progress(hand.seed, slot, seconds, torch_slot_s));
    constexpr double tremor_m = 0.0015; // at what is lit, 0.3 m away: a quarter of a degree
    const double held = std::clamp(now.from_m.z / 0.1 - 0.5, 0.0, 1.0);
    now.at_m += held * tremor_m *
                glm::dvec3(std::sin(41.0 * seconds), std::sin(53.0 * seconds), std::sin(37.0 * seconds));
    PoseSample sample;
    sample.time = prop.time;
    sample.station = torch_station;
    sample.position_m = now.from_m;
    sample.rotation = pointing(now.at_m - now.from_m, now.roll);
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
        if (visitor_.torch) {
            samples.push_back(simulated_torch(visitor_, start_, since_start));
        }
        ++next_;
    }
}

} // namespace frustumscreen::tracker
