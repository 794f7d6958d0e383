// The cost of frames in several set-ups: ratios to the first, and samples against a ray cast.

#include "app/bench/setup/frame_cost.h"
#include "app/bench/truth/truth.h"
#include "app/pack/pack_file.h"
#include "assets_baked/bake/bake.h"
#include "tests/bench/near_settings.h"
#include "tests/bench/ring.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace frustumscreen::bench {
namespace {

const pack::Pack& ring_pack() {
    static const pack::Pack pack = [] {
        bake::BakeOptions options;
        options.size = 64;
        options.measuring = 0.05;
        return bake::bake(*ring(), options).value();
    }();
    return pack;
}

class FrameCosts : public ::testing::Test {
protected:
    FrameCosts() { large_.projector.pinhole = settings_.projector.pinhole.scaled_to(1280, 800); }
    /// Pixels that show the ring, averaged over one rotation of the prop at the table's middle.
    [[nodiscard]] double pixels_hit(const settings::Settings& settings) const {
        const geometry::PropShape prop = settings::make_prop(settings.prop);
        const Result<Truth> truth = Truth::build(ring(), pack::place(pack_, prop).prop_from_artifact);
        constexpr int turns = 12;
        double hits = 0.0;
        for (int k = 0; k < turns; ++k) {
            BenchPose pose = pose_at(0.0, 0.0, 2.0 * std::numbers::pi * k / turns);
            pose.eye_m = settings.eye.default_m;
            const TruthPicture cast = truth->cast(prop, view_of(settings, pose), false);
            hits +=
                static_cast<double>(std::count(cast.hit.texels.begin(), cast.hit.texels.end(), 1)) / turns;
        }
        return hits;
    }

    settings::Settings settings_ = near_settings();
    settings::Settings large_ = near_settings(); ///< with four times as many pixels
    const pack::Pack& pack_ = ring_pack();
};

TEST_F(FrameCosts, AreRelativeToTheFirstSetUp) {
    const std::array<const settings::Settings*, 3> set_ups{&settings_, &large_, &settings_};
    double done = 0.0;
    const Result<std::vector<SetUpCost>> costs = frame_costs(set_ups, pack_, [&](double share) {
        EXPECT_GE(share, done);
        done = share;
    });
    ASSERT_TRUE(costs) << costs.error().message;
    ASSERT_EQ(costs->size(), 3U);
    EXPECT_EQ(done, 1.0);
    EXPECT_EQ((*costs)[0].times_first, 1.0);
    EXPECT_EQ((*costs)[0].cpu_times_first, 1.0);
    for (const SetUpCost& cost : *costs) {
        EXPECT_TRUE(std::isfinite(cost.times_first) && cost.times_first > 0.0);
        EXPECT_TRUE(std::isfinite(cost.cpu_times_first) && cost.cpu_times_first > 0.0);
    }
    EXPECT_EQ((*costs)[2].samples, (*costs)[0].samples) << "the same set-up";
}

TEST_F(FrameCosts, TheSamplesHoldEveryPixelThatTheRayCastHits) {
    const std::array<const settings::Settings*, 2> set_ups{&settings_, &large_};
    const Result<std::vector<SetUpCost>> costs = frame_costs(set_ups, pack_, [](double) {});
    ASSERT_TRUE(costs) << costs.error().message;
    for (std::size_t k = 0; k < set_ups.size(); ++k) {
        const double hit = pixels_hit(*set_ups[k]) * pack_.samples;
        EXPECT_GE((*costs)[k].samples, hit);
        EXPECT_LE((*costs)[k].samples, 4.0 * hit) << "tiles of 16 pixels around the outline";
    }
    const double growth = (*costs)[1].samples / (*costs)[0].samples;
    EXPECT_LT(growth, 4.0) << "smaller tiles in the larger picture waste less";
    EXPECT_GT(growth, 2.0);
}

} // namespace
} // namespace frustumscreen::bench
