#include "firmware_host/tracker/simulated_tracker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace frustumscreen::tracker {
namespace {

constexpr MonotonicTime start{Nanoseconds(123456789)};
constexpr Nanoseconds minute = std::chrono::minutes(1);

std::vector<PoseSample> polled_once(const SimulatedVisitor& visitor, Nanoseconds length = minute) {
    SimulatedTracker tracker(visitor, start);
    std::vector<PoseSample> samples;
    EXPECT_TRUE(tracker.poll(start + length, samples));
    return samples;
}

bool same(const PoseSample& a, const PoseSample& b) {
    return a.time == b.time && a.station == b.station && a.position_m == b.position_m &&
           a.rotation == b.rotation;
}

TEST(SimulatedTracker, SamplesDoNotDependOnThePollTimes) {
    const SimulatedVisitor visitor;
    const std::vector<PoseSample> expected = polled_once(visitor);
    SimulatedTracker tracker(visitor, start);
    std::vector<PoseSample> samples;
    std::mt19937 engine(1);
    MonotonicTime now = start - std::chrono::seconds(1);
    while (now < start + minute) {
        now = std::min(now + Nanoseconds(std::uniform_int_distribution<int>(0, 50'000'000)(engine)),
                       start + minute);
        EXPECT_TRUE(tracker.poll(now, samples));
        EXPECT_TRUE(samples.empty() || samples.back().time <= now);
    }
    ASSERT_EQ(samples.size(), expected.size());
    EXPECT_TRUE(std::equal(samples.begin(), samples.end(), expected.begin(), same));
}

/// A visitor with a torch moves the prop and the head as before.
TEST(SimulatedTracker, HasATorchOnlyOnRequest) {
    SimulatedVisitor visitor;
    visitor.torch = true;
    std::vector<PoseSample> samples = polled_once(visitor);
    const auto torch_begins =
        std::stable_partition(samples.begin(), samples.end(),
                              [](const PoseSample& sample) { return sample.station != torch_station; });
    EXPECT_EQ(std::distance(torch_begins, samples.end()), std::distance(samples.begin(), torch_begins) / 2);
    const std::vector<PoseSample> without = polled_once({});
    ASSERT_EQ(static_cast<std::size_t>(std::distance(samples.begin(), torch_begins)), without.size());
    EXPECT_TRUE(std::equal(samples.begin(), torch_begins, without.begin(), same));
}

TEST(SimulatedTracker, PointsTheTorchAtThePropAndSometimesLaysItDown) {
    SimulatedVisitor visitor;
    visitor.torch = true;
    int on_prop = 0, lies = 0;
    glm::dvec3 last(0.0);
    for (int k = 0; k < 60 * 100; ++k) {
        const Nanoseconds at = std::chrono::milliseconds(10) * k;
        const PoseSample torch = simulated_torch(visitor, start, at);
        const PoseSample prop = simulated_prop(visitor, start, at);
        EXPECT_NEAR(glm::length(torch.rotation), 1.0, 1e-12);
        const glm::dvec3 light = torch.rotation * glm::dvec3(0, 0, 1);
        const glm::dvec3 to_prop =
            glm::normalize(prop.position_m + glm::dvec3(0, 0, 0.07) - torch.position_m);
        const bool down = torch.position_m.z < 0.021;
        lies += down ? 1 : 0;
        on_prop += !down && glm::dot(light, to_prop) > std::cos(0.5) ? 1 : 0;
        if (down) {
            EXPECT_GT(light.z, -0.3); // it points across the table, but for the moments of the movement
        }
        EXPECT_LT(k == 0 ? 0.0 : glm::distance(light, last), 0.05) << k; // 5 rad/s
        last = light;
    }
    EXPECT_GT(on_prop, 3600);
    EXPECT_GT(lies, 300);
}

TEST(SimulatedTracker, ReportsBothStationsAtItsRate) {
    const std::vector<PoseSample> samples = polled_once({}, std::chrono::seconds(10));
    EXPECT_EQ(samples.size(), 2U * 1201U);
    EXPECT_TRUE(std::is_sorted(samples.begin(), samples.end(),
                               [](const PoseSample& a, const PoseSample& b) { return a.time < b.time; }));
}

TEST(SimulatedTracker, DifferentSeedsGiveDifferentMovements) {
    SimulatedVisitor other;
    other.seed = 2;
    const auto a = polled_once({}, std::chrono::seconds(1));
    const auto b = polled_once(other, std::chrono::seconds(1));
    EXPECT_NE(a.front().position_m, b.front().position_m);
    EXPECT_NE(a[1].position_m, b[1].position_m);
}

TEST(SimulatedTracker, KeepsThePropUprightInItsAreaAndTheHeadNearTheEye) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SimulatedVisitor visitor;
        visitor.seed = seed;
        visitor.centre_m = {0.05, -0.02};
        for (const PoseSample& sample : polled_once(visitor)) {
            EXPECT_NEAR(glm::length(sample.rotation), 1.0, 1e-12);
            EXPECT_LT(glm::distance(sample.rotation * glm::dvec3(0, 0, 1), glm::dvec3(0, 0, 1)), 1e-12);
            if (sample.station == prop_station) {
                const glm::dvec2 off = glm::abs(glm::dvec2(sample.position_m) - visitor.centre_m);
                EXPECT_TRUE(off.x <= visitor.half_extent_m.x + 1e-12 &&
                            off.y <= visitor.half_extent_m.y + 1e-12);
                EXPECT_EQ(sample.position_m.z, 0.0);
            } else {
                const glm::dvec3 off = glm::abs(sample.position_m - visitor.eye_m) - visitor.half_sway_m;
                EXPECT_LE(std::max({off.x, off.y, off.z}), 1e-12);
            }
        }
    }
}

TEST(SimulatedTracker, MovesThePropWithRestsTurnsAndSlides) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        SimulatedVisitor visitor;
        visitor.seed = seed;
        std::vector<PoseSample> prop;
        for (const PoseSample& sample : polled_once(visitor, 3 * minute)) {
            if (sample.station == prop_station) {
                prop.push_back(sample);
            }
        }
        int at_rest = 0;
        int turning_on_the_spot = 0;
        double fastest_m_s = 0.0;
        double fastest_turn_s = 0.0;
        glm::dvec3 low = prop[0].position_m;
        glm::dvec3 high = low;
        for (std::size_t k = 1; k < prop.size(); ++k) {
            const double step = glm::distance(prop[k].position_m, prop[k - 1].position_m);
            const double cosine = std::abs(glm::dot(prop[k].rotation, prop[k - 1].rotation));
            const double turn = 2 * std::acos(std::fmin(1.0, cosine));
            const bool turned = prop[k].rotation != prop[k - 1].rotation;
            at_rest += step == 0.0 && !turned ? 1 : 0;
            turning_on_the_spot += step < 1e-15 && turned ? 1 : 0;
            fastest_m_s = std::max(fastest_m_s, step * visitor.rate_hz);
            fastest_turn_s = std::max(fastest_turn_s, turn * visitor.rate_hz);
            low = glm::min(low, prop[k].position_m);
            high = glm::max(high, prop[k].position_m);
        }
        const auto count = static_cast<int>(prop.size());
        EXPECT_GT(at_rest, count / 4);
        EXPECT_LT(at_rest, count * 3 / 4);
        EXPECT_GT(turning_on_the_spot, count / 50);
        EXPECT_GT(fastest_m_s, 0.1);
        EXPECT_LT(fastest_m_s, 1.0);
        EXPECT_LT(fastest_turn_s, 9.0);
        EXPECT_GT(high.x - low.x, 0.2);
        EXPECT_GT(high.y - low.y, 0.13);
    }
}

TEST(SimulatedTracker, NeverJumpsFromOneMovementToTheNext) {
    SimulatedVisitor visitor;
    for (visitor.seed = 0; visitor.seed < 50; ++visitor.seed) {
        // Movements join at whole slots: 4 s for the prop, 3.1 s for the head.
        for (int slot = 1; slot < 40; ++slot) {
            const Nanoseconds prop_at = slot * std::chrono::milliseconds(4000);
            EXPECT_LT(glm::distance(simulated_prop(visitor, start, prop_at - Nanoseconds(1)).position_m,
                                    simulated_prop(visitor, start, prop_at).position_m),
                      1e-9);
            const Nanoseconds head_at = slot * std::chrono::milliseconds(3100);
            EXPECT_LT(glm::distance(simulated_head(visitor, start, head_at - Nanoseconds(1)).position_m,
                                    simulated_head(visitor, start, head_at + Nanoseconds(1)).position_m),
                      1e-8);
        }
    }
}

TEST(SimulatedTracker, TheHeadFacesTheProp) {
    const SimulatedVisitor visitor;
    for (int tenth = 0; tenth < 600; ++tenth) {
        const Nanoseconds t = tenth * std::chrono::milliseconds(100);
        const PoseSample prop = simulated_prop(visitor, start, t);
        const PoseSample head = simulated_head(visitor, start, t);
        const glm::dvec3 ahead = head.rotation * glm::dvec3(0, 1, 0);
        const glm::dvec2 to_prop = glm::normalize(glm::dvec2(prop.position_m - head.position_m));
        EXPECT_LT(glm::distance(glm::dvec2(ahead), to_prop), 1e-12);
    }
}

} // namespace
} // namespace frustumscreen::tracker
