#include "app/tracking/motion_filter.h"
#include "app/tracking/pose_estimator.h"
#include "app/tracking/pose_math.h"
#include "firmware_host/base/file.h"
#include "firmware_host/tracker/text_rows.h"
#include "tests/folders.h"
#include "tests/render/counted_new.h"
#include "tests/tracking/exact_pose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <random>

namespace frustumscreen::tracking {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

PoseEstimator exhibit_estimator() {
    return PoseEstimator(std::make_unique<MotionFilter>(exhibit_filter()));
}
PoseEstimator glide_estimator() {
    return PoseEstimator(std::make_unique<MotionFilter>(constant_velocity_filter()));
}

MonotonicTime at_us(std::int64_t t_us) {
    return from_microseconds(1'000'000'000 + t_us);
}

geometry::RigidTransform at_x(double x) {
    return {glm::dquat(1.0, 0.0, 0.0, 0.0), {x, 0.0, 0.0}};
}

/// 0.25 m/s along an oblique line, 1 rad/s about an oblique axis, in long double.
struct SteadyMotion {
    exact_pose::Vector axis{0.6L, 0.0L, 0.8L};
    [[nodiscard]] exact_pose::Quaternion rotation(long double t_s) const {
        return exact_pose::about(axis, t_s);
    }
    [[nodiscard]] static glm::dvec3 place(long double t_s) {
        return {static_cast<double>(0.15L * t_s), static_cast<double>(-0.2L * t_s), 0.0};
    }
    [[nodiscard]] geometry::RigidTransform pose(long double t_s) const {
        return {exact_pose::rounded(rotation(t_s)), place(t_s)};
    }
};

/// The estimate after two seconds at 60 Hz, 40 ms ahead.
PoseEstimate steady_answer(PoseEstimator& estimator, const SteadyMotion& motion, std::int64_t& asked_us) {
    std::int64_t t_us = 0;
    for (int k = 0; k < 120; ++k) {
        t_us = k * 16'667;
        EXPECT_EQ(estimator.take(at_us(t_us), motion.pose(static_cast<long double>(t_us) * 1e-6L)),
                  Taken::Used);
    }
    asked_us = t_us + 40'000;
    return estimator.at(at_us(asked_us));
}

TEST(PoseEstimator, PredictsSteadyMotionExactlyWithOneModel) {
    PoseEstimator estimator = glide_estimator();
    const SteadyMotion motion;
    std::int64_t asked_us = 0;
    const PoseEstimate estimate = steady_answer(estimator, motion, asked_us);
    const long double t_s = static_cast<long double>(asked_us) * 1e-6L;
    EXPECT_EQ(estimate.status, PoseStatus::Predicted);
    EXPECT_EQ(estimate.age, milliseconds(40));
    EXPECT_LT(glm::length(estimate.pose.translation - SteadyMotion::place(t_s)), 1e-9);
    EXPECT_LT(exact_pose::angle(estimate.pose.rotation, motion.rotation(t_s)), 1e-8);
}

TEST(PoseEstimator, PredictsSteadyMotionWithinAQuarterWithAllModels) {
    PoseEstimator estimator = exhibit_estimator();
    const SteadyMotion motion;
    std::int64_t asked_us = 0;
    const PoseEstimate estimate = steady_answer(estimator, motion, asked_us);
    const long double t_s = static_cast<long double>(asked_us) * 1e-6L;
    const double way_m = 0.25 * 0.040;
    EXPECT_LT(glm::length(estimate.pose.translation - SteadyMotion::place(t_s)), 0.25 * way_m);
    EXPECT_LT(exact_pose::angle(estimate.pose.rotation, motion.rotation(t_s)), 0.25 * 0.040);
}

/// How far the predicted pose moves from picture to picture beyond the prop's own movement, RMS, in mm:
/// tracker and pictures at 60 Hz, 35 ms ahead, for 40 s.
double tremble_mm(PoseEstimator estimator, double speed_m_s) {
    std::mt19937_64 random(4);
    std::normal_distribution<double> noise(0.0, PoseNoise().place_m);
    double sum = 0.0;
    double before = 0.0;
    constexpr int samples = 2400;
    for (int k = 0; k < samples; ++k) {
        const double t_s = k / 60.0;
        geometry::RigidTransform pose = at_x(speed_m_s * t_s);
        pose.translation += glm::dvec3(noise(random), noise(random), noise(random));
        estimator.take(at_us(std::llround(1e6 * t_s)), pose);
        const double off_m =
            estimator.at(at_us(std::llround(1e6 * (t_s + 0.035)))).pose.translation.x - speed_m_s * t_s;
        sum += k > 60 ? (off_m - before) * (off_m - before) : 0.0;
        before = off_m;
    }
    return 1e3 * std::sqrt(sum / samples);
}

TEST(PoseEstimator, ASlowlySlidPropDoesNotTremble) {
    for (const double speed_m_s : {0.001, 0.002, 0.005, 0.015, 0.05}) {
        EXPECT_LT(tremble_mm(exhibit_estimator(), speed_m_s), 0.25) << speed_m_s;
    }
    EXPECT_GT(tremble_mm(glide_estimator(), 0.015), 0.5); // the tremble of a single bandwidth for all speeds
}

TEST(MotionTrack, ACreepDoesNotDependOnTheStepLength) {
    const std::array models = {MotionModel{MotionModel::Kind::Creep, 0.0125, 0.45}};
    const MotionTrack start({models, 0.0003, 0.065, 2.0, 0.0});
    for (const double length_s : {1e-3, 1.0 / 60.0, 0.25, 2.0}) {
        MotionTrack cut = start;
        for (int k = 0; k < 1000; ++k) { // even the shortest of them glide
            static_cast<void>(cut.advance(length_s / 1000.0));
        }
        EXPECT_NEAR(cut.place_sd(0.0), start.place_sd(length_s), 1e-4 * start.place_sd(length_s)) << length_s;
    }
}

TEST(PoseEstimator, ReportsExactInterpolatedPredictedAndStale) {
    PoseEstimator estimator = glide_estimator();
    EXPECT_EQ(estimator.at(at_us(0)).status, PoseStatus::Stale);
    EXPECT_EQ(estimator.at(at_us(0)).reinitialisations, 0U);
    SteadyMotion motion;
    for (int k = 0; k < 60; ++k) {
        estimator.take(at_us(k * 10'000), motion.pose(0.01L * k));
    }
    const PoseEstimate a = estimator.at(at_us(300'000));
    const PoseEstimate b = estimator.at(at_us(310'000));
    const PoseEstimate within = estimator.at(at_us(303'000));
    EXPECT_EQ(a.status, PoseStatus::Exact);
    EXPECT_EQ(within.status, PoseStatus::Interpolated);
    const auto wide = [](const glm::dquat& q) { return exact_pose::Quaternion{q.w, q.x, q.y, q.z}; };
    EXPECT_LT(exact_pose::angle(within.pose.rotation,
                                exact_pose::slerp(wide(a.pose.rotation), wide(b.pose.rotation), 0.3L)),
              1e-14);
    EXPECT_LT(glm::length(within.pose.translation - glm::mix(a.pose.translation, b.pose.translation, 0.3)),
              1e-15);
    EXPECT_EQ(estimator.at(at_us(590'000)).status, PoseStatus::Exact);
    EXPECT_EQ(estimator.at(at_us(590'001)).status, PoseStatus::Predicted);
    EXPECT_EQ(estimator.at(at_us(590'000 + 2'000'000)).status, PoseStatus::Stale);
    EXPECT_EQ(estimator.at(at_us(-1)).status, PoseStatus::Stale);
}

TEST(PoseEstimator, ATrackerOfOneSampleASecondIsSlowAndNotStale) {
    PoseEstimator estimator = glide_estimator();
    for (std::int64_t t_us = 0; t_us < 20'000'000; t_us += 1'000'000) {
        estimator.take(at_us(t_us), at_x(0.1));
        for (std::int64_t later_us = 100'000; t_us > 1'000'000 && later_us <= 1'100'000;
             later_us += 100'000) {
            EXPECT_EQ(estimator.at(at_us(t_us + later_us)).status, PoseStatus::Predicted) << t_us + later_us;
        }
    }
    EXPECT_EQ(estimator.at(at_us(19'000'000 + 2'600'000)).status, PoseStatus::Stale);
    // A slower tracker is not waited for longer than five seconds, and one gap alone does not mark a tracker
    // as slow.
    for (std::int64_t t_us = 20'000'000; t_us < 60'000'000; t_us += 8'000'000) {
        estimator.take(at_us(t_us), at_x(0.1));
    }
    EXPECT_EQ(estimator.at(at_us(52'000'000 + 4'900'000)).status, PoseStatus::Predicted);
    EXPECT_EQ(estimator.at(at_us(52'000'000 + 5'100'000)).status, PoseStatus::Stale);
    estimator.take(at_us(60'000'000), at_x(0.1));
    estimator.take(at_us(60'010'000), at_x(0.1));
    EXPECT_EQ(estimator.at(at_us(60'010'000 + 1'100'000)).status, PoseStatus::Stale);
    estimator.take(at_us(63'010'000), at_x(0.1));
    EXPECT_EQ(estimator.at(at_us(63'010'000 + 1'100'000)).status, PoseStatus::Stale);
}

TEST(PoseEstimator, ForgetsTheOldestSamplesAndReportsThemStale) {
    PoseEstimator estimator = glide_estimator();
    const auto count = static_cast<std::int64_t>(PoseEstimator::remembered) + 10;
    for (std::int64_t k = 0; k < count; ++k) {
        estimator.take(at_us(k * 10'000), at_x(0.001 * static_cast<double>(k)));
    }
    EXPECT_EQ(estimator.at(at_us(10 * 10'000)).status, PoseStatus::Exact);
    EXPECT_EQ(estimator.at(at_us(10 * 10'000 - 1)).status, PoseStatus::Stale);
}

TEST(PoseEstimator, IsStableForStepsFromAMicrosecondToTenSeconds) {
    for (const std::int64_t step_us :
         {1LL, 17LL, 100LL, 1'000LL, 16'667LL, 100'000LL, 240'000LL, 1'000'000LL, 10'000'000LL}) {
        PoseEstimator estimator = exhibit_estimator();
        std::mt19937_64 random(static_cast<std::uint64_t>(step_us));
        std::normal_distribution<double> noise;
        for (int k = 0; k < 3000; ++k) {
            const geometry::RigidTransform pose{
                rotation_of(0.0026 * glm::dvec3(noise(random), noise(random), noise(random))),
                0.0003 * glm::dvec3(noise(random), noise(random), noise(random))};
            const std::int64_t t_us = k * step_us;
            ASSERT_EQ(estimator.take(at_us(t_us), pose), Taken::Used) << step_us;
            // Within the noise's reach, now and up to the prediction limit.
            for (const std::int64_t ahead_us : {0LL, 40'000LL, 10'000'000LL}) {
                const PoseEstimate estimate = estimator.at(at_us(t_us + ahead_us));
                ASSERT_LT(slip_m(step_between({}, estimate.pose), 0.06), ahead_us == 0 ? 0.003 : 0.08)
                    << step_us << " us, sample " << k << ", ahead " << ahead_us;
            }
        }
    }
}

TEST(PoseEstimator, AcceptsMixedStepLengths) {
    PoseEstimator estimator = exhibit_estimator();
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> power(0.0, 7.0);
    std::int64_t t_us = 0;
    for (int k = 0; k < 20'000; ++k) {
        t_us += static_cast<std::int64_t>(std::pow(10.0, power(random)));
        const double x = 0.1 * std::sin(1e-6 * static_cast<double>(t_us));
        ASSERT_EQ(estimator.take(at_us(t_us), at_x(x)), Taken::Used) << k;
        const geometry::RigidTransform pose = estimator.at(at_us(t_us)).pose;
        ASSERT_NEAR(pose.translation.x, x, 0.02);
        ASSERT_NEAR(glm::length(pose.rotation), 1.0, 1e-12);
    }
}

TEST(PoseEstimator, RejectsDuplicateAndLateSamples) {
    PoseEstimator tidy = exhibit_estimator();
    PoseEstimator untidy = exhibit_estimator();
    SteadyMotion motion;
    for (int k = 0; k < 100; ++k) {
        const geometry::RigidTransform pose = motion.pose(0.016L * k);
        tidy.take(at_us(k * 16'000), pose);
        EXPECT_EQ(untidy.take(at_us(k * 16'000), pose), Taken::Used);
        EXPECT_EQ(untidy.take(at_us(k * 16'000), at_x(5.0)), Taken::Late);
        if (k > 0) {
            EXPECT_EQ(untidy.take(at_us(k * 16'000 - 5'000), at_x(-5.0)), Taken::Late);
        }
    }
    const PoseEstimate a = tidy.at(at_us(1'620'000));
    const PoseEstimate b = untidy.at(at_us(1'620'000));
    EXPECT_EQ(a.pose.translation, b.pose.translation);
    EXPECT_EQ(a.pose.rotation, b.pose.rotation);
}

TEST(PoseEstimator, AcceptsQuaternionsOfAnySignAndLength) {
    PoseEstimator unit = exhibit_estimator();
    PoseEstimator odd = exhibit_estimator();
    SteadyMotion motion;
    for (int k = 0; k < 100; ++k) {
        const geometry::RigidTransform pose = motion.pose(0.016L * k);
        unit.take(at_us(k * 16'000), pose);
        const double factor = (k % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, k % 7 - 3);
        EXPECT_EQ(odd.take(at_us(k * 16'000), {factor * pose.rotation, pose.translation}), Taken::Used);
    }
    const PoseStep off = step_between(unit.at(at_us(1'620'000)).pose, odd.at(at_us(1'620'000)).pose);
    EXPECT_LT(slip_m(off, 1.0), 1e-12);
}

TEST(PoseEstimator, RejectsInvalidPoses) {
    PoseEstimator estimator = exhibit_estimator();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinite = std::numeric_limits<double>::infinity();
    const auto refused = [&](std::int64_t t_us) {
        EXPECT_EQ(estimator.take(at_us(t_us), at_x(nan)), Taken::NoPose);
        EXPECT_EQ(estimator.take(at_us(t_us), at_x(infinite)), Taken::NoPose);
        EXPECT_EQ(estimator.take(at_us(t_us), {glm::dquat(0.0, 0.0, 0.0, 0.0), {}}), Taken::NoPose);
        EXPECT_EQ(estimator.take(at_us(t_us), {glm::dquat(nan, 0.0, 0.0, 1.0), {}}), Taken::NoPose);
    };
    refused(0);
    EXPECT_EQ(estimator.at(at_us(0)).reinitialisations, 0U);
    estimator.take(at_us(0), at_x(0.1));
    refused(10'000);
    EXPECT_EQ(estimator.at(at_us(0)).pose.translation.x, 0.1);
}

TEST(PoseEstimator, IgnoresOutliersUntilThreeAgree) {
    PoseEstimator estimator = exhibit_estimator();
    for (int k = 0; k < 60; ++k) {
        EXPECT_EQ(estimator.take(at_us(k * 16'000), at_x(k % 10 == 9 ? 1.0 + 0.3 * k : 0.001)),
                  k % 10 == 9 ? Taken::Outlier : Taken::Used);
    }
    EXPECT_LT(std::abs(estimator.at(at_us(60 * 16'000)).pose.translation.x - 0.001), 1e-5);
    EXPECT_EQ(estimator.at(at_us(60 * 16'000)).reinitialisations, 1U);
    EXPECT_EQ(estimator.take(at_us(60 * 16'000), at_x(0.5)), Taken::Outlier);
    EXPECT_EQ(estimator.take(at_us(61 * 16'000), at_x(0.5)), Taken::Outlier);
    EXPECT_EQ(estimator.take(at_us(62 * 16'000), at_x(0.5)), Taken::Used);
    EXPECT_EQ(estimator.at(at_us(62 * 16'000)).reinitialisations, 2U);
    EXPECT_EQ(estimator.at(at_us(62 * 16'000)).pose.translation.x, 0.5);
}

TEST(PoseEstimator, RestartsIfTheDeviceClockIsSetBack) {
    PoseEstimator estimator = exhibit_estimator();
    estimator.take(at_us(3'600'000'000), at_x(0.1));
    Taken last = Taken::Late;
    for (int k = 0; k < 16; ++k) {
        last = estimator.take(at_us(k * 16'000), at_x(0.2));
    }
    EXPECT_EQ(last, Taken::Used);
    EXPECT_EQ(estimator.at(at_us(15 * 16'000)).pose.translation.x, 0.2);
}

TEST(PoseEstimator, HoldsThePoseInADropout) {
    PoseEstimator estimator = exhibit_estimator();
    for (int k = 0; k < 100; ++k) {
        estimator.take(at_us(k * 16'000), at_x(0.0048 * k)); // 0.3 m/s
    }
    double before = estimator.at(at_us(99 * 16'000)).pose.translation.x;
    double largest = 0.0;
    for (int ms = 1; ms < 2000; ++ms) {
        const double x = estimator.at(at_us(99 * 16'000 + ms * 1000)).pose.translation.x;
        EXPECT_GE(x, before - 1e-12);
        largest = std::max(largest, x - before);
        before = x;
    }
    EXPECT_LT(largest, 0.00035); // not faster than the hand
    EXPECT_LT(before - 0.0048 * 99, 0.3 * 0.12);
}

TEST(PoseEstimator, AllocatesNothingAfterConstruction) {
    PoseEstimator estimator = exhibit_estimator();
    SteadyMotion motion;
    const geometry::RigidTransform far = at_x(3.0);
    const long before = synthetic::allocations_so_far();
    for (int k = 0; k < 1000; ++k) {
        const std::int64_t t_us = k * 16'000 + (k > 500 ? 3'000'000 : 0);
        estimator.take(at_us(t_us), k % 50 == 7 ? far : motion.pose(0.016L * k));
        (void)estimator.at(at_us(t_us + 35'000));
        (void)estimator.at(at_us(t_us - 50'000));
    }
    EXPECT_EQ(synthetic::allocations_so_far(), before);
}

struct Row {
    MonotonicTime time;
    geometry::RigidTransform pose;
};

/// Rows as in the file, with its misordered and repeated ones.
std::vector<Row> rows_of(const std::filesystem::path& file) {
    std::vector<Row> rows;
    const Result<Bytes> bytes = read_file(file);
    if (!bytes) {
        return rows;
    }
    tracker::TextRows text(as_text(*bytes), "recording");
    while (text.next()) {
        std::array<double, 8> numbers{};
        for (std::size_t k = 0; k < 8; ++k) {
            numbers[k] = tracker::number_in(text.fields()[k]).value_or(0.0);
        }
        const auto t_us = static_cast<std::int64_t>(std::llround(numbers[0] * 1e6));
        rows.push_back({from_microseconds(t_us),
                        {glm::dquat(numbers[7], numbers[4], numbers[5], numbers[6]),
                         {numbers[1], numbers[2], numbers[3]}}});
    }
    return rows;
}

TEST(PoseEstimator, FollowsEveryRecordingAlsoShuffled) {
    const std::filesystem::path folder = std::filesystem::path(shared_dir()) / "data/tracker";
    if (!std::filesystem::exists(folder)) {
        GTEST_SKIP() << "no recordings in " << folder;
    }
    for (const char* name : {"vicon_handheld_1.csv", "tum_fr1_xyz_groundtruth.txt",
                             "camera_target_handheld_1.csv", "tum_fr1_xyz_rgbdslam.txt"}) {
        std::vector<Row> rows = rows_of(folder / name);
        ASSERT_GT(rows.size(), 100U) << name;
        // Swap neighbours, one pair in three.
        for (std::size_t k = 0; k + 1 < rows.size(); k += 3) {
            std::swap(rows[k], rows[k + 1]);
        }
        PoseEstimator estimator = exhibit_estimator();
        std::size_t used = 0;
        std::size_t near = 0;
        for (const Row& row : rows) {
            if (estimator.take(row.time, row.pose) == Taken::Used) {
                ++used;
                const PoseEstimate estimate = estimator.at(row.time);
                EXPECT_EQ(estimate.status, PoseStatus::Exact);
                const geometry::RigidTransform measured{*geometry::normalised(row.pose.rotation),
                                                        row.pose.translation};
                near += slip_m(step_between(estimate.pose, measured), 0.06) < 0.01 ? 1 : 0;
            }
        }
        EXPECT_GT(used, rows.size() * 6 / 10) << name;
        EXPECT_GT(near, used * 95 / 100) << name;
    }
}

} // namespace
} // namespace frustumscreen::tracking
