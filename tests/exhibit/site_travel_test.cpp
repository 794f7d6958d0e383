// The way into a site and back, in simulated time.
#include "app/exhibit/site_travel.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <optional>

namespace frustumscreen::exhibit {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// Four squares of the ground; the prop is a frustum.
SiteGround four_squares() {
    std::vector<world::RegionBox> regions;
    for (int k = 0; k < 4; ++k) {
        const glm::dvec3 low(k % 2 == 0 ? -0.5 : 0.0, k / 2 == 0 ? -0.5 : 0.0, 0.01 * k);
        regions.push_back({low, low + glm::dvec3(0.5, 0.5, 0.1)});
    }
    return site_ground(regions, {1.0, 1.0, 0.13}, 0.12, geometry::make_frustum({}));
}

class SiteVisit : public testing::Test {
protected:
    PresentedSite step(bool pressed = false) {
        now += milliseconds(10);
        return travel.step(now, {.site = site,
                                 .artifact = artifact,
                                 .shown = shown,
                                 .attracts = attracts,
                                 .pressed = pressed,
                                 .towards = at(pointed)});
    }
    PresentedSite run(Nanoseconds time) {
        PresentedSite last;
        for (const MonotonicTime end = now + time; now < end;) {
            last = step();
        }
        return last;
    }
    /// From above onto a region's middle.
    [[nodiscard]] SiteTravel::Ray at(std::size_t region) const {
        const glm::dvec3 ground = 0.12 * world::ground_of(ground_.regions[region]);
        const glm::dvec3 eye(0.0, -0.3, 0.5);
        return {eye, ground - eye};
    }

    SiteGround ground_ = four_squares();
    const SiteGround* site = &ground_;
    SiteTravel travel;
    MonotonicTime now{seconds(100)};
    std::size_t artifact = 3;
    std::size_t pointed = 2;
    bool shown = true, attracts = false;
};

TEST(SiteGround, FitsEachRegionIntoTheProp) {
    const geometry::PropShape prop = geometry::make_frustum({});
    const SiteGround ground = four_squares();
    ASSERT_EQ(ground.views.size(), 4U);
    for (std::size_t k = 0; k < 4; ++k) {
        const world::RegionBox& region = ground.regions[k];
        double nearest = 1.0;
        for (unsigned c = 0; c < 8; ++c) {
            const glm::dvec3 corner((c & 1U) != 0 ? region.high.x : region.low.x,
                                    (c & 2U) != 0 ? region.high.y : region.low.y,
                                    (c & 4U) != 0 ? region.high.z : region.low.z);
            const glm::dvec3 in_prop = 0.12 * ground.views[k].point(corner);
            EXPECT_GE(in_prop.z, -1e-12);
            for (const geometry::PropFace& face : prop.faces) {
                nearest = std::fmin(nearest, -face.plane.distance(in_prop));
            }
        }
        EXPECT_NEAR(nearest, 0.0, 1e-9) << k; // as large as it fits
    }
}

TEST_F(SiteVisit, MarksThePointedRegionAndTravelsThereAndBack) {
    EXPECT_EQ(step().marked, 2U);
    pointed = 1;
    EXPECT_EQ(run(milliseconds(190)).marked, 2U); // not at once
    EXPECT_EQ(run(milliseconds(30)).marked, 1U);
    PresentedSite seen = step(true);
    EXPECT_EQ(seen.view, world::SiteView{}); // the whole fades to its regions first
    EXPECT_FALSE(seen.marked);
    EXPECT_EQ(run(SiteTravel::fades - milliseconds(20)).view, world::SiteView{});
    world::SiteView before{};
    double share = 0.0;
    for (int k = 0; k < 500; ++k) {
        seen = step();
        ASSERT_TRUE(seen.view);
        EXPECT_GE(seen.share, share);
        EXPECT_LE(seen.view->zoom / before.zoom, 1.02); // in 10 ms
        EXPECT_LE(glm::distance(seen.view->offset, before.offset), 0.05);
        before = *seen.view;
        share = seen.share;
    }
    EXPECT_EQ(seen.view, ground_.views[1]);
    EXPECT_EQ(seen.region, 1U);
    EXPECT_FALSE(travel.changing());
    pointed = 3; // does not matter now
    seen = step(true);
    while (seen.view) {
        EXPECT_LE(before.zoom / seen.view->zoom, 1.02);
        before = *seen.view;
        seen = step();
    }
    EXPECT_NEAR(before.zoom, 1.0, 0.01);
    EXPECT_FALSE(travel.is_away());
    EXPECT_EQ(seen.marked, 3U);
}

TEST_F(SiteVisit, ReversesOnTheWayWithoutAJump) {
    (void)step();
    (void)step(true);
    world::SiteView before = run(milliseconds(1300)).view.value();
    EXPECT_GT(before.zoom, 1.05);
    for (const bool pressed : {true, false, false, true, false, false, true, false}) {
        const PresentedSite seen = step(pressed);
        ASSERT_TRUE(seen.view);
        EXPECT_NEAR(seen.view->zoom / before.zoom, 1.0, 0.02);
        before = *seen.view;
    }
    EXPECT_FALSE(run(seconds(4)).view); // the last press went back
}

TEST_F(SiteVisit, ReturnsWithoutAVisitorAndEndsWithTheArtifact) {
    (void)step();
    (void)step(true);
    ASSERT_EQ(run(seconds(5)).view, ground_.views[2]);
    attracts = true;
    const PresentedSite seen = step(true); // nobody is there to press
    ASSERT_TRUE(seen.view);
    EXPECT_FALSE(run(seconds(5)).view);
    attracts = false;
    (void)step();
    (void)step(true);
    ASSERT_TRUE(run(seconds(5)).view);
    artifact = 4;
    EXPECT_FALSE(step().view);
    (void)step(true);
    ASSERT_TRUE(run(seconds(5)).view);
    shown = false;
    EXPECT_FALSE(step().view);
}

TEST_F(SiteVisit, DoesNothingForAnArtifactThatIsNoSite) {
    site = nullptr;
    for (const bool pressed : {false, true, false}) {
        const PresentedSite seen = step(pressed);
        EXPECT_FALSE(seen.view || seen.marked || seen.region);
    }
    EXPECT_FALSE(travel.is_away());
}

} // namespace
} // namespace frustumscreen::exhibit
