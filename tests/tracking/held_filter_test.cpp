// The filter of a prop that stands, slides or is held: on the table that of the table bit for bit, in the hand less slip.

#include "app/tracking/held_filter.h"
#include "app/tracking/pose_math.h"
#include "tests/render/counted_new.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace frustumscreen::tracking {
namespace {

constexpr double lever_m = 0.06;
constexpr double rate_hz = 60.0;
constexpr double ahead_s = 0.043; ///< PATRIOT, display, and half a sample

using Motion = std::function<geometry::RigidTransform(double)>;

geometry::RigidTransform stands(double /*t_s*/) {
    return {rotation_of({0.0, 0.0, 0.7}), {0.1, -0.05, 0.0}};
}
geometry::RigidTransform slides(double t_s) {
    return {rotation_of({0.0, 0.0, 0.8 * std::sin(2.1 * t_s)}),
            {0.15 * std::sin(2.6 * t_s), 0.1 * std::sin(3.7 * t_s), 0.0}};
}
/// Like `slides` on another face: the prop's own axes say nothing of the table.
geometry::RigidTransform slides_on_its_side(double t_s) {
    geometry::RigidTransform pose = slides(t_s);
    pose.rotation = pose.rotation * rotation_of({0.5 * 3.14159265358979323846, 0.0, 0.0});
    pose.translation.z = 0.06;
    return pose;
}
geometry::RigidTransform is_held(double t_s) {
    return {rotation_of({0.4 * std::sin(1.9 * t_s), 0.3 * std::sin(2.8 * t_s), 0.5 * std::sin(1.3 * t_s)}),
            {0.15 * std::sin(2.6 * t_s), 0.1 * std::sin(3.7 * t_s), 0.3 + 0.06 * std::sin(2.2 * t_s)}};
}

class Noise {
public:
    explicit Noise(std::uint64_t seed) : random_(seed) {}
    geometry::RigidTransform on(const geometry::RigidTransform& pose) {
        return moved(pose, {PoseNoise().place_m * any(), PoseNoise().turn_rad * any()});
    }

private:
    glm::dvec3 any() {
        const double x = normal_(random_), y = normal_(random_);
        return {x, y, normal_(random_)};
    }
    std::mt19937_64 random_;
    std::normal_distribution<double> normal_;
};

TEST(HeldFilter, EqualsTheTableFilterBitForBitOnTheTable) {
    std::uint64_t seed = 1;
    for (const Motion& motion : {Motion(stands), Motion(slides), Motion(slides_on_its_side)}) {
        HeldFilter filter(PoseNoise{}, lever_m);
        MotionFilter table(exhibit_filter());
        Noise noise(seed++);
        for (int k = 0; k < 60 * 60; ++k) {
            const geometry::RigidTransform pose = noise.on(motion(k / rate_hz));
            if (k == 0) {
                filter.restart(pose);
                table.restart(pose);
                continue;
            }
            filter.take(pose, 1.0 / rate_hz);
            table.take(pose, 1.0 / rate_hz);
            ASSERT_EQ(filter.held(), 0.0) << k;
            ASSERT_EQ(filter.ahead(ahead_s).translation, table.ahead(ahead_s).translation) << k;
            ASSERT_EQ(filter.ahead(ahead_s).rotation, table.ahead(ahead_s).rotation) << k;
            ASSERT_EQ(filter.spread(ahead_s).place_m, table.spread(ahead_s).place_m) << k;
        }
    }
}

/// The mean distance of what is drawn from the truth, in mm.
double slip_mm(PoseFilter& filter, const Motion& motion, std::uint64_t seed) {
    Noise noise(seed);
    filter.restart(noise.on(motion(0.0)));
    double sum = 0.0;
    constexpr int samples = 40 * 60;
    for (int k = 1; k < samples; ++k) {
        filter.take(noise.on(motion(k / rate_hz)), 1.0 / rate_hz);
        sum += 1e3 * slip_m(step_between(motion(k / rate_hz + ahead_s), filter.ahead(ahead_s)), lever_m);
    }
    return sum / samples;
}

TEST(HeldFilter, SlipsLessThanTheTableFilterInTheHand) {
    HeldFilter held(PoseNoise{}, lever_m);
    MotionFilter table(exhibit_filter());
    EXPECT_LT(slip_mm(held, is_held, 5), 0.75 * slip_mm(table, is_held, 5));
}

TEST(HeldFilter, BlendsSmoothlyWhenThePropIsLiftedAndLaidDown) {
    constexpr double lifted_s = 2.0, laid_s = 6.0, lift_s = 0.3;
    // Lifted by 100 mm, carried, and laid down again; the smooth step has no kink.
    const Motion motion = [](double t_s) {
        const auto eased = [](double x) {
            const double c = std::clamp(x, 0.0, 1.0);
            return c * c * (3.0 - 2.0 * c);
        };
        const double high = eased((t_s - lifted_s) / lift_s) - eased((t_s - laid_s) / lift_s);
        const double waves = t_s > lifted_s && t_s < laid_s ? 0.02 * high * std::sin(3.0 * t_s) : 0.0;
        return geometry::RigidTransform{rotation_of({0.3 * waves / 0.02, 0.0, 0.0}),
                                        {0.0, 0.0, 0.1 * high + waves}};
    };
    HeldFilter filter(PoseNoise{}, lever_m);
    Noise noise(6);
    filter.restart(noise.on(motion(0.0)));
    double before = 0.0;
    double held_at_s = 0.0, table_at_s = 0.0;
    for (int k = 1; k < 9 * 60; ++k) {
        const double t_s = k / rate_hz;
        filter.take(noise.on(motion(t_s)), 1.0 / rate_hz);
        held_at_s = held_at_s == 0.0 && filter.held() > 0.9 ? t_s : held_at_s;
        table_at_s = t_s > laid_s && table_at_s == 0.0 && filter.held() == 0.0 ? t_s : table_at_s;
        if (t_s < lifted_s || t_s > laid_s + 2.0) {
            EXPECT_EQ(filter.held(), 0.0) << t_s;
        }
        if (t_s > lifted_s + lift_s && t_s < laid_s) {
            EXPECT_GT(filter.held(), 0.3) << t_s;
        }
        EXPECT_LT(std::abs(filter.held() - before), 0.2) << t_s;
        before = filter.held();
    }
    EXPECT_LT(held_at_s - lifted_s, 0.25);
    EXPECT_LT(table_at_s - laid_s, 1.5);
}

TEST(HeldFilter, IsStableForStepsFromAMicrosecondToASecond) {
    for (const double step_s : {1e-6, 1e-4, 1e-3, 1.0 / 240.0, 1.0 / 60.0, 0.1, 0.25, 1.0}) {
        HeldFilter filter(PoseNoise{}, lever_m);
        Noise noise(7);
        filter.restart(noise.on({}));
        for (int k = 1; k < 3000; ++k) {
            const double height_m =
                0.01 * std::sin(2.0 * std::numbers::pi * 2.0 * k * step_s); // a hand's, twice a second
            filter.take(noise.on({glm::dquat(1.0, 0.0, 0.0, 0.0), {0.0, 0.0, height_m}}), step_s);
            const geometry::RigidTransform pose = filter.ahead(0.08);
            ASSERT_NEAR(glm::length(pose.rotation), 1.0, 1e-12);
            // Samples closer than a tracker's: at most ten times the speed that the noise of two of them makes.
            ASSERT_LT(glm::length(pose.translation),
                      std::fmax(1.0, 10.0 * 0.08 * PoseNoise{}.place_m / step_s))
                << step_s << ' ' << k;
        }
    }
}

TEST(HeldFilter, AllocatesNothingAfterConstruction) {
    HeldFilter filter(PoseNoise{}, lever_m);
    filter.restart(is_held(0.0));
    const long before = synthetic::allocations_so_far();
    for (int k = 1; k < 500; ++k) {
        filter.take(is_held(k / rate_hz), 1.0 / rate_hz);
        (void)filter.ahead(ahead_s);
        (void)filter.spread(ahead_s);
    }
    EXPECT_EQ(synthetic::allocations_so_far(), before);
}

TEST(HeldMeter, DoesNotDependOnTheStepLengthForAStandingProp) {
    HeldMeter often({}, lever_m), rarely({}, lever_m);
    const geometry::RigidTransform low, high{{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.004}};
    for (HeldMeter* const meter : {&often, &rarely}) {
        meter->restart(low);
        meter->take(high, 0.05);
    }
    for (int k = 0; k < 100; ++k) {
        often.take(high, 0.001);
    }
    rarely.take(high, 0.1);
    EXPECT_NEAR(often.share(), rarely.share(), 1e-9);
    EXPECT_GT(often.share(), 0.0);
    EXPECT_LT(often.share(), 1.0);
}

} // namespace
} // namespace frustumscreen::tracking
