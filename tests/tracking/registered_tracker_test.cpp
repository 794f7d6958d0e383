#include "app/tracking/registered_tracker.h"

#include <gtest/gtest.h>

#include <cmath>

namespace frustumscreen::tracking {
namespace {

class FakeTracker final : public tracker::Tracker {
public:
    explicit FakeTracker(bool table_frame) : table_frame_(table_frame) {}

    [[nodiscard]] Result<void> poll(MonotonicTime now, std::vector<tracker::PoseSample>& samples) override {
        tracker::PoseSample sample;
        sample.time = now;
        sample.position_m = {0.1, 0.2, 0.3};
        samples.push_back(sample);
        sample.ok = false;
        samples.push_back(sample);
        return fail(ErrorKind::DeviceLost, "test.device", "the cable was cut after these");
    }
    [[nodiscard]] std::string name() const override { return "fake"; }
    [[nodiscard]] bool reports_table_frame() const override { return table_frame_; }
    [[nodiscard]] std::string_view state() const override { return "the fake is well"; }
    [[nodiscard]] tracker::TrackerCounts counts() const override { return {.frames = 7}; }
    [[nodiscard]] std::optional<MonotonicTime> alive_until() const override { return from_microseconds(9); }

private:
    bool table_frame_;
};

/// The device's +Z points down; its origin is 0.3 m above the table.
const geometry::RigidTransform table_from_tracker{glm::dquat(0, 1, 0, 0), {0, 0, 0.3}};

TEST(RegisteredTracker, TransformsEachSampleToTheTableOnce) {
    RegisteredTracker tracker(std::make_unique<FakeTracker>(false), {table_from_tracker});
    EXPECT_TRUE(tracker.reports_table_frame());
    ASSERT_TRUE(tracker.registration());
    std::vector<tracker::PoseSample> samples;
    for (int round = 0; round < 2; ++round) {
        EXPECT_FALSE(tracker.poll(from_microseconds(5 + round), samples)); // samples arrive although poll
                                                                           // returns false
    }
    ASSERT_EQ(samples.size(), 4U);
    for (const std::size_t k : {0U, 2U}) {
        EXPECT_LT(glm::distance(samples[k].position_m, glm::dvec3(0.1, -0.2, 0.0)), 1e-15);
        EXPECT_LT(glm::distance(samples[k].rotation * glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1)), 1e-15);
        EXPECT_EQ(samples[k + 1].position_m, glm::dvec3(0.1, 0.2, 0.3)); // has no pose
    }
}

/// The prop's origin is 0.05 m below its sensor, rotated a quarter about Z; the eye is 0.1 m in front of the
/// head's sensor.
TEST(RegisteredTracker, AppliesTheSensorsOffsets) {
    const double half = std::sqrt(0.5);
    const glm::dquat quarter(half, 0, 0, half);
    const geometry::Registration registration{.table_from_tracker = {{1, 0, 0, 0}, {0, 0, 1.0}},
                                              .sensor_from_prop = {quarter, {0, 0, -0.05}},
                                              .eye_in_sensor_m = {0.1, 0, 0},
                                              .sensor_from_torch = {quarter, {0, 0.2, 0}}};
    std::vector<tracker::PoseSample> samples(3);
    for (int k = 0; k < 3; ++k) {
        samples[static_cast<std::size_t>(k)].station = k + 1;
        samples[static_cast<std::size_t>(k)].position_m = {1, 2, 3};
        samples[static_cast<std::size_t>(k)].rotation = quarter;
    }
    place_on_table(samples, registration);
    EXPECT_LT(glm::distance(samples[0].position_m, glm::dvec3(1, 2, 3.95)), 1e-15);
    EXPECT_LT(glm::distance(samples[0].rotation * glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0)), 1e-15);
    EXPECT_LT(glm::distance(samples[1].position_m, glm::dvec3(1, 2.1, 4)),
              1e-15); // the head's +X is the table's +Y
    EXPECT_LT(glm::distance(samples[1].rotation * glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)), 1e-15);
    EXPECT_LT(glm::distance(samples[2].position_m, glm::dvec3(0.8, 2, 4)),
              1e-15); // the sensor's +Y is the table's -X
    EXPECT_LT(glm::distance(samples[2].rotation * glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0)), 1e-15);
}

/// However the sensor is turned on the glasses, the head's +X is the direction from the left eye to the right one, and the point
/// between the eyes stays where it is.
TEST(RegisteredTracker, TurnsTheHeadByTheDirectionToTheRightEye) {
    const glm::dquat sensor = glm::normalize(glm::dquat(0.3, -0.5, 0.7, 0.2));
    const glm::dvec3 eye(0.02, -0.01, 0.05);
    for (const glm::dvec3& right :
         {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -0.5),
          glm::dvec3(0.3, -0.8, 0.1), glm::dvec3(-1, 1e-9, 0)}) {
        tracker::PoseSample sample;
        sample.station = tracker::head_station;
        sample.position_m = {0.1, 0.2, 0.3};
        sample.rotation = sensor;
        place_on_table(std::span(&sample, 1), {.table_from_tracker = table_from_tracker,
                                               .sensor_from_prop = {},
                                               .eye_in_sensor_m = eye,
                                               .right_in_sensor = right});
        const auto on_table =
            [&](const glm::dvec3& in_sensor) { // by the axes, without a quaternion of the head
                const glm::dvec3 k = glm::dvec3(0.1, 0.2, 0.3) + sensor * in_sensor;
                return glm::dvec3(k.x, -k.y, 0.3 - k.z);
            };
        EXPECT_LT(glm::distance(sample.position_m, on_table(eye)), 1e-15);
        const glm::dvec3 expected = on_table(eye + glm::normalize(right)) - on_table(eye);
        EXPECT_LT(glm::distance(sample.rotation * glm::dvec3(1, 0, 0), expected), 1e-8);
        EXPECT_NEAR(glm::length(sample.rotation), 1.0, 1e-12);
    }
}

TEST(RegisteredTracker, PassesThroughTableCoordinates) {
    RegisteredTracker tracker(std::make_unique<FakeTracker>(true), {table_from_tracker});
    EXPECT_FALSE(tracker.registration());
    std::vector<tracker::PoseSample> samples;
    EXPECT_FALSE(tracker.poll(from_microseconds(5), samples));
    ASSERT_EQ(samples.size(), 2U);
    EXPECT_EQ(samples[0].position_m, glm::dvec3(0.1, 0.2, 0.3));
}

TEST(RegisteredTracker, ForwardsTheDevicesOtherProperties) {
    const RegisteredTracker tracker(std::make_unique<FakeTracker>(false), {table_from_tracker});
    EXPECT_EQ(tracker.name(), "fake");
    EXPECT_EQ(tracker.state(), "the fake is well");
    EXPECT_EQ(tracker.counts().frames, 7U);
    EXPECT_EQ(tracker.alive_until(), from_microseconds(9));
}

} // namespace
} // namespace frustumscreen::tracking
