// The governor in a closed loop with simulated GPUs, compared with independent arithmetic.

#include "app/scene/governor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

namespace frustumscreen::scene {
namespace {

pack::LevelOutline level_of(std::uint64_t triangles) {
    pack::LevelOutline level;
    level.triangles = triangles;
    return level;
}

MonotonicTime at_seconds(double seconds) {
    return MonotonicTime(Nanoseconds(static_cast<Nanoseconds::rep>(std::llround(seconds * 1e9))));
}

constexpr double deadline_ms = 1000.0 / 60.0;

TEST(Tolerance, AppliesToTheWorstEyeAndTheWorstPlace) {
    const pack::LevelError error{1e-4F, 3e-4F, 5e-3F, 0.0F};
    const pack::SeenError worst{2e-3F, 9e-3F, 1e-3F, 0.5F}; // on a prop of 120 mm: 0.24 mm, outline 0.12 mm
    EXPECT_TRUE(within_tolerance(error, worst, 120.0, 0.25));
    EXPECT_FALSE(within_tolerance(error, worst, 120.0, 0.23));
    EXPECT_FALSE(within_tolerance(error, worst, 130.0, 0.25)); // a larger prop magnifies the error
    EXPECT_FALSE(within_tolerance(error, {2e-3F, 0.0F, 1.1e-3F, 0.0F}, 120.0, 0.25)); // the outline is off
    EXPECT_FALSE(
        within_tolerance({0.0F, 0.0F, 9e-3F, 0.0F}, pack::SeenError{}, 120.0, 0.25)); // a part is lost
    const float nan = std::nanf("");
    EXPECT_FALSE(within_tolerance({0.0F, 0.0F, nan, 0.0F}, pack::SeenError{}, 120.0, 0.25));
    EXPECT_FALSE(within_tolerance(error, {nan, 0.0F, 0.0F, 0.0F}, 120.0, 0.25));
    EXPECT_FALSE(within_tolerance(error, worst, 120.0, std::nan("")));
}

TEST(Ladder, BeginsWithTheCoarsestLevelThatIsGoodEnoughAndItsSamples) {
    const std::vector<pack::LevelOutline> levels{level_of(1000), level_of(2000), level_of(8000),
                                                 level_of(30000)};
    const std::vector<QualityLevel> quality_levels = ladder(levels, {false, true, true, true}, 4);
    ASSERT_EQ(quality_levels.size(), 6U);
    EXPECT_EQ(quality_levels[0].level, 1U);
    EXPECT_EQ(quality_levels[0].samples, 4);
    EXPECT_TRUE(quality_levels[0].enough);
    EXPECT_EQ(quality_levels[2].samples, 1);
    EXPECT_EQ(quality_levels[3].level, 0U);
    EXPECT_EQ(quality_levels[5].samples, 1);
    for (std::size_t k = 1; k < quality_levels.size(); ++k) {
        EXPECT_FALSE(quality_levels[k].enough);
    }
}

TEST(Ladder, BeginsWithTheFinestLevelWhenNoneSuffices) {
    const std::vector<pack::LevelOutline> levels{level_of(1000), level_of(1200), level_of(4000)};
    const std::vector<QualityLevel> quality_levels = ladder(levels, {false, false, false}, 1);
    ASSERT_EQ(quality_levels.size(),
              2U); // 1000 triangles do not justify a quality level of their own next to 1200
    EXPECT_EQ(quality_levels[0].level, 2U);
    EXPECT_FALSE(quality_levels[0].enough);
    EXPECT_EQ(quality_levels[1].level, 1U);
    EXPECT_EQ(ladder(levels, {false, false, false}, 0)[0].samples, 1);
}

TEST(Ladder, OrdersAReliefByItsError) {
    std::vector<pack::LevelOutline> levels{level_of(1000), level_of(2000)};
    levels[0].error.p95_box = 4e-3F;
    levels[1].error.p95_box = 2e-3F;
    pack::ReliefOutline relief{384, 5000, 2'000'000, {1e-4F, 5e-4F, 1e-3F, 0.0F}, "r"};
    const std::vector<QualityLevel> quality_levels = ladder(levels, {false, true}, 4, relief);
    ASSERT_EQ(quality_levels.size(), 8U);
    EXPECT_TRUE(quality_levels[0].relief && quality_levels[0].enough && quality_levels[0].level == 384 &&
                quality_levels[0].samples == 4);
    EXPECT_TRUE(quality_levels[1].relief && !quality_levels[1].enough && quality_levels[1].samples == 1);
    EXPECT_TRUE(!quality_levels[2].relief && quality_levels[2].enough && quality_levels[2].level == 1);
    relief.error.p95_box = 2.2e-3F; // worse than the mesh level
    EXPECT_TRUE(ladder(levels, {false, true}, 4, relief)[3].relief);
    EXPECT_EQ(ladder(levels, {false, true}, 4).size(), 6U);
}

TEST(Ladder, ContainsAReliefInBothWaysWhenTheGpuMayDrawIt) {
    const std::vector<pack::LevelOutline> levels{level_of(2000)};
    const pack::ReliefOutline relief{384, 5000, 2'000'000, {}, "r"};
    const std::vector<QualityLevel> both = ladder(levels, {true}, 4, relief, true);
    std::size_t on_gpu = 0;
    for (const QualityLevel& quality_level : both) {
        on_gpu += quality_level.on_gpu ? 1U : 0U;
        EXPECT_TRUE(quality_level.relief || !quality_level.on_gpu);
        EXPECT_EQ(quality_level.enough, quality_level.samples == 4);
    }
    EXPECT_EQ(on_gpu, 2U);
    EXPECT_EQ(both.size(), ladder(levels, {true}, 4, relief).size() + 2);
    const QualityLevel raster{384, 4, true, true};
    const QualityLevel drawn{384, 4, true, true, true};
    EXPECT_FALSE(raster.shows_as(drawn));
}

TEST(Governor, TakesTheQuickestOfReliefsAndMeshes) {
    const std::vector<QualityLevel> quality_levels{
        {384, 4, true, true}, {384, 4, true, true, true}, {3, 4, true}};
    for (const std::size_t quickest : {0U, 1U, 2U}) {
        std::vector<QualityLevelTime> times{
            {4, {5000.0, 1e4}, 9.0, true}, {4, {5000.0, 1e4}, 9.0, true, true}, {4, {20000.0, 1e4}, 9.0}};
        times[quickest].ms = 3.0;
        EXPECT_EQ(Governor(quality_levels, times, 16.0).index(), quickest);
    }
}

TEST(Cost, FitsReliefsAndMeshesSeparately) {
    // 1 ms and 1 us per triangle; 2 ms and 0.5 us per block; on the GPU 3 ms and 2 us per block.
    const std::vector<QualityLevelTime> times{{1, {1000.0, 0.0}, 2.0},
                                              {1, {3000.0, 0.0}, 4.0},
                                              {1, {1000.0, 0.0}, 2.5, true},
                                              {1, {9000.0, 0.0}, 6.5, true},
                                              {1, {1000.0, 0.0}, 5.0, true, true},
                                              {1, {9000.0, 0.0}, 21.0, true, true}};
    const FrameCost cost = cost_of(times);
    for (const QualityLevelTime& quality_level : times) {
        EXPECT_NEAR(cost.ms(quality_level), quality_level.ms, 0.02 * quality_level.ms);
    }
    EXPECT_EQ(cost_of({times[0], times[1]}).ms(times[2]), 0.0) << "no relief was measured";
}

TEST(PixelOnProp, IsMeasuredAtThePlaceNearestToTheProjector) {
    const geometry::Pinhole pinhole{1280, 800, 1920.0, 1900.0, 640.0, 400.0};
    const geometry::RigidTransform projector_from_prop =
        geometry::RigidTransform{{0.0, 1.0, 0.0, 0.0}, {0.1, 0.0, 1.2}}.inverse();
    EXPECT_NEAR(pixel_on_prop_m(geometry::make_frustum({}), pinhole, projector_from_prop),
                (1.2 - 0.12) / 1920.0, 1e-12);
}

/// A GPU whose frames take fixed + per_triangle * triangles + per_sample * pixels * samples, in milliseconds.
struct SimulatedGpu {
    std::vector<QualityLevel> quality_levels;
    std::vector<QualityLevelTime> times;
    std::vector<double> lie; ///< true time of a level over its initial measurement
    std::mt19937 random{7};
    double noise = 0.1;

    SimulatedGpu() {
        const std::vector<double> triangles{40000.0, 10000.0};
        for (std::uint32_t level = 2; level-- > 0;) {
            for (const int samples : {4, 2, 1}) {
                quality_levels.push_back({level, samples, level == 1 && samples == 4});
                times.push_back({samples, {triangles[1 - level], 50000.0}, 0.0});
                times.back().ms = true_ms(times.back().samples, times.back().work);
                lie.push_back(1.0);
            }
        }
    }
    static double true_ms(int samples, const FrameWork& work) {
        return 0.5 + 1e-4 * work.triangles + 2e-5 * work.pixels * samples; // 8.5, 6.5, 5.5; 5.5, 3.5, 2.5
    }
    double frame_ms(std::size_t quality_level, double load) {
        std::lognormal_distribution<double> spread(0.0, noise);
        return times[quality_level].ms * lie[quality_level] * load * spread(random);
    }
    [[nodiscard]] Governor governor() const { return {quality_levels, times, deadline_ms}; }

    struct Outcome {
        std::uint64_t switches = 0;
        double late_share = 0.0;    ///< frames over the deadline
        double quality_share = 0.0; ///< share of the time at the best level
        double shortest_s = 1e9;    ///< between two changes
        std::size_t last = 0;
    };
    Outcome play(Governor& governor, double from_s, double to_s, const std::function<double(double)>& load) {
        Outcome outcome;
        const std::uint64_t before = governor.switches();
        const auto frames = static_cast<int>(std::lround((to_s - from_s) * 60.0));
        double changed_s = -1e9;
        for (int k = 0; k < frames; ++k) {
            const double t = from_s + k / 60.0;
            const std::size_t quality_level = governor.index();
            const double ms = frame_ms(quality_level, load(t));
            outcome.late_share += ms > deadline_ms ? 1.0 : 0.0;
            outcome.quality_share += quality_level == 0 ? 1.0 : 0.0;
            governor.observe(at_seconds(t), times[quality_level].work, ms);
            if (governor.index() != quality_level) {
                outcome.shortest_s = std::fmin(outcome.shortest_s, t - changed_s);
                changed_s = t;
            }
        }
        outcome.late_share /= frames;
        outcome.quality_share /= frames;
        outcome.switches = governor.switches() - before;
        outcome.last = governor.index();
        return outcome;
    }
};

TEST(Governor, KeepsTheBestQualityLevelWhereItFits) {
    SimulatedGpu gpu;
    Governor governor = gpu.governor();
    const auto outcome = gpu.play(governor, 0.0, 120.0, [](double) { return 1.0; });
    EXPECT_EQ(outcome.switches, 0U);
    EXPECT_EQ(outcome.quality_share, 1.0);
}

TEST(Governor, TakesTheQuickestOfSufficientQualityLevels) {
    SimulatedGpu gpu;
    gpu.quality_levels[3].enough = true; // the coarse level with all samples
    EXPECT_EQ(gpu.governor().index(), 3U);
}

TEST(Governor, GivesUpSamplesBeforeTriangles) {
    SimulatedGpu gpu;
    Governor governor = gpu.governor();
    // 8.5, 6.5, 5.5 ms times 2.1: 17.9 is late, 13.7 is above 70 % of 16.7, 11.55 fits: the fine mesh level,
    // 1 sample.
    EXPECT_EQ(gpu.play(governor, 0.0, 30.0, [](double) { return 2.1; }).last, 2U);
    EXPECT_EQ(governor.quality_level().level, 1U);
}

TEST(Governor, TakesTheQuickestWhereNothingFits) {
    SimulatedGpu gpu;
    Governor governor = gpu.governor();
    const auto outcome = gpu.play(governor, 0.0, 60.0, [](double) { return 50.0; });
    EXPECT_EQ(outcome.last, 5U);
    EXPECT_EQ(outcome.switches, 1U);
}

TEST(Governor, ReactsToALoadStepWithin1500MsAndRecovers) {
    SimulatedGpu gpu;
    Governor governor = gpu.governor();
    gpu.play(governor, 0.0, 20.0, [](double) { return 1.0; });
    const auto step = gpu.play(governor, 20.0, 21.5, [](double) { return 3.0; });
    EXPECT_NE(step.last, 0U);
    const auto loaded = gpu.play(governor, 21.5, 60.0, [](double) { return 3.0; });
    EXPECT_LE(loaded.switches, 1U);
    EXPECT_LT(loaded.late_share, 0.01);
    const auto after = gpu.play(governor, 60.0, 90.0, [](double) { return 1.0; });
    EXPECT_EQ(after.last, 0U);
    EXPECT_LE(after.switches, 2U);
}

/// The load ends with the change that it caused: at first the model attributes the speed to the new level.
TEST(Governor, RecoversWhenTheLoadEndsAtTheChange) {
    SimulatedGpu gpu;
    Governor governor = gpu.governor();
    gpu.play(governor, 0.0, 100.0, [&](double) { return governor.switches() == 0 ? 3.0 : 1.0; });
    EXPECT_EQ(governor.index(), 0U);
    EXPECT_LE(governor.switches(), 4U);
}

/// Ten minutes at every load from far below to far above: some level's time lies at every place between the
/// two limits, with frames that vary by 30 %.
TEST(Governor, DoesNotOscillateAtAnySteadyLoad) {
    for (int step = 0; step < 41; ++step) {
        const double load = 0.5 * std::pow(1.07, step); // to 7.5
        SimulatedGpu gpu;
        gpu.noise = 0.3;
        Governor governor = gpu.governor();
        const auto outcome = gpu.play(governor, 0.0, 600.0, [&](double) { return load; });
        EXPECT_LE(outcome.switches, 4U) << load;
    }
}

/// The best level is slower than its initial measurement says: it is tried and left at growing intervals: 2 +
/// 4 + ... + 2^k seconds of backoff fit into the time.
TEST(Governor, TriesAQualityLevelThatNeverFitsOnlyLogarithmicallyOften) {
    for (const double lie : {1.3, 2.0, 5.0}) {
        for (const double swing : {0.0, 0.25, 0.5}) { // a load that invites another try
            SimulatedGpu gpu;
            gpu.lie = {lie * 2.0, 1.0, 1.0, 1.0, 1.0, 1.0};
            Governor governor = gpu.governor();
            const double length_s = 1800.0;
            const auto outcome = gpu.play(governor, 0.0, length_s, [&](double t) {
                return 1.0 + swing * std::sin(2.0 * std::numbers::pi * t / 7.0);
            });
            EXPECT_LE(outcome.switches, 2.0 * (std::log2(length_s / 2.0) + 1.0)) << lie << ' ' << swing;
            EXPECT_LT(outcome.late_share, 0.05) << lie << ' ' << swing;
        }
    }
}

TEST(Governor, NeverChangesMoreOftenThanItsDwellUnderAnyLoad) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> u(0.0, 1.0);
    for (int trial = 0; trial < 20; ++trial) {
        SimulatedGpu gpu;
        Governor governor = gpu.governor();
        const double period_s = 0.05 * std::pow(600.0, u(random));
        const double high = 1.0 + 5.0 * u(random);
        const double length_s = 200.0;
        const auto outcome = gpu.play(governor, 0.0, length_s, [&](double t) {
            return std::fmod(t, period_s) < 0.5 * period_s ? high : 0.7; // square wave
        });
        EXPECT_GE(outcome.shortest_s, to_seconds(Governor::dwell) - 1e-9) << period_s << ' ' << high;
        if (period_s > 20.0) { // slow enough to be followed: by at most two steps each way
            EXPECT_LE(outcome.switches, 4.0 * (length_s / period_s + 1.0)) << period_s << ' ' << high;
        } else {
            EXPECT_LE(outcome.switches, 20U) << period_s << ' ' << high;
        }
    }
}

TEST(Governor, IgnoresSingleLongFrames) {
    SimulatedGpu gpu;
    Governor governor = gpu.governor();
    for (int k = 0; k < 6000; ++k) {
        const double ms = k % 500 == 499 ? 400.0 : gpu.frame_ms(governor.index(), 1.0);
        governor.observe(at_seconds(k / 60.0), gpu.times[governor.index()].work, ms);
    }
    EXPECT_EQ(governor.switches(), 0U);
}

/// Every level's initial time is wrong by a factor between a quarter and four; the true times grow with the
/// work. The level with the least work meets the deadline, so none may be late for long.
TEST(Governor, RecoversFromWrongInitialTimes) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> u(-2.0, 2.0);
    double late = 0.0;
    for (int trial = 0; trial < 60; ++trial) {
        SimulatedGpu gpu;
        for (std::size_t k = 0; k < gpu.times.size(); ++k) {
            gpu.lie[k] = std::exp2(u(random));
            gpu.times[k].ms /= gpu.lie[k];
        }
        Governor governor = gpu.governor();
        const auto load = [](double) { return 4.0; }; // 34, 26, 22; 22, 14, 10 ms
        late = std::fmax(late, gpu.play(governor, 0.0, 120.0, load).late_share);
        EXPECT_LT(gpu.play(governor, 120.0, 420.0, load).late_share, 0.05) << trial;
    }
    EXPECT_LT(late, 0.25);
}

/// Five frames at the start rated the slowest level as the fastest.
TEST(Governor, LeavesALevelWronglyMeasuredAsTheQuickest) {
    SimulatedGpu gpu;
    for (std::size_t k = 1; k < gpu.times.size(); ++k) {
        gpu.lie[k] = 0.1;
        gpu.times[k].ms *= 10.0;
    }
    Governor governor = gpu.governor();
    ASSERT_EQ(governor.index(), 0U);
    const auto outcome = gpu.play(governor, 0.0, 8.0, [](double) { return 4.0; });
    EXPECT_EQ(outcome.last, 5U);
    EXPECT_LT(outcome.late_share, 0.5);
}

TEST(Governor, IgnoresAndCountsInvalidTimes) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    SimulatedGpu gpu;
    Governor governor = gpu.governor();
    const double before = governor.expected_ms();
    std::uint64_t fed = 0;
    for (int k = 0; k < 1000; ++k) {
        for (const double ms : {std::nan(""), infinity, -infinity, 0.0, -3.0, 1e9}) {
            governor.observe(at_seconds(k / 60.0), {std::nan(""), -1.0}, ms);
            ++fed;
        }
    }
    EXPECT_EQ(governor.ignored(), fed);
    EXPECT_EQ(governor.switches(), 0U);
    EXPECT_EQ(governor.expected_ms(), before);
    // Invalid times between good ones change nothing either; nor does invalid work.
    for (int k = 0; k < 3000; ++k) {
        const double ms = k % 3 == 0 ? std::nan("") : gpu.frame_ms(governor.index(), 1.0);
        governor.observe(at_seconds(20.0 + k / 60.0), {k % 2 == 0 ? infinity : std::nan(""), -infinity}, ms);
    }
    EXPECT_EQ(governor.switches(), 0U);
    EXPECT_TRUE(std::isfinite(governor.expected_ms()));
}

TEST(Governor, StartsWithoutTimes) {
    SimulatedGpu gpu;
    for (QualityLevelTime& time : gpu.times) {
        time = {0, {-1.0, std::nan("")}, std::nan("")};
    }
    Governor governor = gpu.governor();
    EXPECT_EQ(governor.index(), 5U); // no measurement: the level with the least expected cost
    governor.observe(at_seconds(0.0), {}, 3.0);
    EXPECT_DOUBLE_EQ(governor.expected_ms(), 3.0);
}

TEST(Governor, SurvivesTimesThatDoNotAdvance) {
    SimulatedGpu gpu;
    Governor governor = gpu.governor();
    std::mt19937 random(1);
    std::uniform_real_distribution<double> t(-1e3, 1e3);
    for (int k = 0; k < 10000; ++k) {
        governor.observe(at_seconds(k % 3 == 0 ? 5.0 : t(random)), gpu.times[governor.index()].work,
                         gpu.frame_ms(governor.index(), 1.0));
        ASSERT_TRUE(std::isfinite(governor.expected_ms()));
    }
    EXPECT_LT(governor.index(), gpu.quality_levels.size());
}

TEST(Governor, EntersWithTheGivenLoad) {
    SimulatedGpu gpu;
    Governor governor = gpu.governor();
    governor.enter(at_seconds(1.0), 3.0);
    EXPECT_NE(governor.index(), 0U);
    governor.enter(at_seconds(1.1), 1.0);
    EXPECT_EQ(governor.index(), 0U);
    governor.enter(at_seconds(1.2), std::nan(""));
    EXPECT_EQ(governor.index(), 0U);
}

TEST(FrameTimeModel, DoesNotDependOnHowAnIntervalIsCutIntoFrames) {
    const std::vector<QualityLevelTime> start{{1, {1e4, 5e4}, 5.0}};
    std::vector<double> ends;
    for (const int frames : {1, 2, 10, 1000}) {
        FrameTimeModel model(start);
        model.set_load(1.0);
        model.observe(0, {1e4, 5e4}, 5.0, at_seconds(0.0));
        for (int k = 1; k <= frames; ++k) {
            model.observe(0, {1e4, 5e4}, 20.0, at_seconds(0.09 * k / frames));
        }
        ends.push_back(std::log(model.expected_ms(0) / 5.0));
    }
    for (const double end : ends) {
        EXPECT_NEAR(end, std::log(4.0) * (1.0 - std::exp(-0.09 / FrameTimeModel::time_constant_s)), 1e-6);
    }
}

TEST(FrameTimeModel, IsStableForEveryStep) {
    for (const double dt : {1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6}) {
        FrameTimeModel model({{1, {1e4, 5e4}, 5.0}});
        double last = 5.0;
        for (int k = 0; k < 1000; ++k) {
            model.observe(0, {1e4, 5e4}, 50.0, at_seconds(k * dt));
            EXPECT_GE(model.expected_ms(0), last - 1e-9); // monotone towards it,
            EXPECT_LE(model.expected_ms(0), 50.0 + 1e-9); // never past it
            last = model.expected_ms(0);
        }
    }
}

TEST(FrameTimeModel, PredictsOtherQualityLevelsAtAnotherPose) {
    SimulatedGpu gpu;
    FrameTimeModel model(gpu.times);
    // The prop is nearer: more of the artifact and 1.8 times the pixels; only level 5 is ever drawn.
    const auto nearer = [&](std::size_t quality_level) {
        return FrameWork{1.3 * gpu.times[quality_level].work.triangles,
                         1.8 * gpu.times[quality_level].work.pixels};
    };
    for (int k = 0; k < 600; ++k) {
        model.observe(5, nearer(5), 1.2 * SimulatedGpu::true_ms(1, nearer(5)), at_seconds(k / 60.0));
    }
    for (std::size_t quality_level = 0; quality_level < gpu.quality_levels.size(); ++quality_level) {
        const double truth =
            1.2 * SimulatedGpu::true_ms(gpu.quality_levels[quality_level].samples, nearer(quality_level));
        EXPECT_NEAR(model.expected_ms(quality_level), truth, 0.02 * truth) << quality_level;
    }
}

} // namespace
} // namespace frustumscreen::scene
