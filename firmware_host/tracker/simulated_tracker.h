/// A simulated visitor, who slides the prop about, rests, turns it, and moves the head. With a torch, the visitor lets its
/// light sweep over the prop, trembles, twists it, and lays it down now and then.
///
/// Frame    table T. The prop stands upright on the table; the head's rotation turns its +Y towards the prop.
/// Time     everything is a function of the seed and the time since `start`: polls at any rate give the same
///          samples. During rests the pose does not change at all.
/// Threads  one caller; the functions are pure.
/// Method   each movement follows the minimum-jerk profile of human reaching (Flash and Hogan 1985, eq. 8)
///          along a parabola. Target, start and length are hashes of the seed and the movement's number.
#pragma once

#include "firmware_host/tracker/tracker.h"

#include <cstdint>

namespace frustumscreen::tracker {

struct SimulatedVisitor {
    std::uint64_t seed = 1;
    glm::dvec2 centre_m{0.0};                 ///< middle of the area that the prop moves in
    glm::dvec2 half_extent_m{0.15, 0.10};     ///< bounds of the prop's centre, from `centre_m`
    glm::dvec3 eye_m{0.0, -0.55, 0.50};       ///< between the eyes, in the middle of the sway
    glm::dvec3 half_sway_m{0.10, 0.05, 0.05}; ///< bounds of the head, from `eye_m`
    double rate_hz = 120.0;                   ///< samples per second and station
    bool torch = false;                       ///< station 3 is there
};

/// Poses of the prop, the head and the torch at start + `since_start`.
[[nodiscard]] PoseSample simulated_prop(const SimulatedVisitor& visitor, MonotonicTime start,
                                        Nanoseconds since_start);
[[nodiscard]] PoseSample simulated_head(const SimulatedVisitor& visitor, MonotonicTime start,
                                        Nanoseconds since_start);
[[nodiscard]] PoseSample simulated_torch(const SimulatedVisitor& visitor, MonotonicTime start,
                                         Nanoseconds since_start);

class SimulatedTracker final : public Tracker {
public:
    SimulatedTracker(const SimulatedVisitor& visitor, MonotonicTime start)
        : visitor_(visitor), start_(start) {}

    [[nodiscard]] Result<void> poll(MonotonicTime now, std::vector<PoseSample>& samples) override;
    [[nodiscard]] std::string name() const override { return "simulated"; }
    [[nodiscard]] std::string_view state() const override {
        return "a simulated visitor moves the prop; no tracker is used";
    }

private:
    SimulatedVisitor visitor_;
    MonotonicTime start_;
    std::int64_t next_ = 0;
};

} // namespace frustumscreen::tracker
