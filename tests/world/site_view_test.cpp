// The way into a site: sizes by exponentials of the share, places by straight lines in long double, regions by trial of each.
#include "app/world/site_view.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace frustumscreen::world {
namespace {

SiteView somewhere(std::mt19937& random) {
    std::uniform_real_distribution<double> any(-0.5, 0.5);
    std::uniform_real_distribution<double> octaves(0.0, 9.0);
    return view_of({any(random), any(random), 0.2 + any(random)}, std::exp2(octaves(random)));
}

TEST(SiteView, CentresThePlace) {
    const SiteView view = view_of({0.25, -0.5, 0.125}, 8.0);
    EXPECT_EQ(view.point({0.25, -0.5, 0.125}), glm::dvec3(0.0));
    EXPECT_EQ(view.point({0.375, -0.5, 0.25}), glm::dvec3(1.0, 0.0, 1.0));
    EXPECT_EQ(view.place_at({1.0, 0.0, 1.0}), glm::dvec3(0.375, -0.5, 0.25));
    EXPECT_EQ(glm::dvec3(view.matrix() * glm::dvec4(0.375, -0.5, 0.25, 1.0)), glm::dvec3(1.0, 0.0, 1.0));
}

TEST(SiteView, ZoomsExponentiallyWithTheShare) {
    const SiteView to = view_of({0.25, 0.125, 0.0}, 16.0);
    for (int k = 0; k <= 16; ++k) {
        EXPECT_NEAR(between({}, to, k / 16.0).zoom, std::exp2(k / 4.0), 1e-13 * 16.0) << k;
    }
    EXPECT_EQ(between({}, to, 0.0), SiteView{});
    EXPECT_EQ(between({}, to, 1.0), to);
    EXPECT_EQ(between({}, to, -1.0), SiteView{});
    EXPECT_EQ(between({}, to, 2.0), to);
}

TEST(SiteView, MovesEachPlaceMonotonicallyOnAStraightLine) {
    std::mt19937 random(62);
    std::uniform_real_distribution<double> any(-0.5, 0.5);
    for (int trial = 0; trial < 200; ++trial) {
        const SiteView from = somewhere(random);
        const SiteView to = somewhere(random);
        const glm::dvec3 place(any(random), any(random), any(random));
        const glm::dvec3 begin = from.point(place);
        const glm::dvec3 way = to.point(place) - begin;
        const double length = glm::length(way);
        double before = 0.0;
        constexpr int steps = 100;
        for (int k = 1; k <= steps; ++k) {
            const glm::dvec3 at = between(from, to, static_cast<double>(k) / steps).point(place) - begin;
            const double along = glm::dot(at, way) / length;
            EXPECT_GE(along, before - 1e-12 * length) << trial << " " << k;
            EXPECT_LE(glm::length(at - along / length * way), 1e-9 * (1.0 + length)) << trial << " " << k;
            // No jump: the steepest part of an exponential over L octaves is L ln 2 times the mean, or less.
            const double steepest = 1.0 + 9.0 * std::log(2.0);
            EXPECT_LE(along - before, 1.5 * steepest * length / steps) << trial << " " << k;
            before = along;
        }
        EXPECT_NEAR(before, length, 1e-9 * (1.0 + length));
    }
}

/// In long double, with the formula of the exponential itself.
TEST(SiteView, IsExactForZoomsFromAlmostOneToAMillion) {
    for (const double zoom : {1.0, 1.0 + 1e-15, 1.0 + 1e-10, 1.0 + 1e-6, 2.0, 1e6}) {
        const SiteView to = view_of({0.5, -0.5, 0.0}, zoom); // a corner of the site
        for (const double share : {0.001, 0.25, 0.5, 0.999}) {
            const long double ratio = std::log(static_cast<long double>(to.zoom));
            const long double weight = ratio > 1e-12L ? std::expm1(ratio * share) / std::expm1(ratio) : share;
            const SiteView view = between({}, to, share);
            EXPECT_NEAR(view.zoom, static_cast<double>(1.0L + weight * (to.zoom - 1.0L)), 1e-9 * zoom)
                << zoom;
            EXPECT_NEAR(view.offset.x, static_cast<double>(weight * to.offset.x), 1e-9 * zoom) << zoom;
            EXPECT_NEAR(view.offset.y, static_cast<double>(weight * to.offset.y), 1e-9 * zoom) << zoom;
        }
        EXPECT_NEAR(glm::length(to.point({0.5, -0.5, 0.0})), 0.0, 1e-15 * zoom);
    }
}

/// Four by four squares of the ground, each of another height.
std::vector<RegionBox> squares() {
    std::vector<RegionBox> regions;
    for (int k = 0; k < 16; ++k) {
        const double x = -0.5 + 0.25 * (k % 4);
        const double y = -0.5 + 0.25 * (k / 4);
        regions.push_back({{x, y, 0.0}, {x + 0.25, y + 0.25, 0.02 + 0.01 * (k % 5)}});
    }
    return regions;
}

TEST(SiteRegions, AreFoundByAGroundPoint) {
    const std::vector<RegionBox> regions = squares();
    for (std::size_t k = 0; k < regions.size(); ++k) {
        EXPECT_EQ(region_at(regions, glm::dvec2(ground_of(regions[k]))), k);
    }
    EXPECT_TRUE(region_at(regions, {0.5, 0.5})); // the border belongs to the site
    EXPECT_TRUE(region_at(regions, {-0.25, 0.0}));
    EXPECT_FALSE(region_at(regions, {0.5 + 1e-9, 0.0}));
    EXPECT_FALSE(region_at({}, {0.0, 0.0}));
}

TEST(SiteRegions, RayFindsTheRegionThatItCrossesLongest) {
    const std::vector<RegionBox> regions = squares();
    std::mt19937 random(63);
    std::uniform_real_distribution<double> any(-0.6, 0.6);
    int found = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const glm::dvec3 from(any(random), any(random) - 1.0, 1.5);
        const glm::dvec3 to(any(random), any(random), 0.0);
        std::optional<std::size_t> longest; // by points along the ray
        int most = 0, second = 0;
        for (std::size_t k = 0; k < regions.size(); ++k) {
            int inside = 0;
            for (int step = 0; step <= 20000; ++step) {
                const glm::dvec3 at = from + (step / 20000.0) * (to - from);
                inside += glm::all(glm::greaterThanEqual(at, regions[k].low)) &&
                                  glm::all(glm::lessThanEqual(at, regions[k].high))
                              ? 1
                              : 0;
            }
            if (inside > most) {
                second = most;
                most = inside;
                longest = k;
            } else {
                second = std::max(second, inside);
            }
        }
        if (most - second > 4) { // otherwise a draw
            EXPECT_EQ(region_on_ray(regions, from, to - from), longest) << trial;
            ++found;
        }
    }
    EXPECT_GT(found, 100);
    EXPECT_FALSE(region_on_ray(regions, {0.0, 0.0, 1.0}, {0.0, 0.0, 1.0})); // upwards
    EXPECT_EQ(region_on_ray(regions, {0.1, 0.1, 1.0}, {0.0, 0.0, -1.0}), 10U);
    const std::vector<RegionBox> flat{{{-0.5, -0.5, 0.0}, {0.0, 0.5, 0.0}},
                                      {{0.0, -0.5, 0.0}, {0.5, 0.5, 0.0}}};
    EXPECT_EQ(region_on_ray(flat, {0.3, -2.0, 2.0}, {0.0, 2.0, -2.0}), 1U);
    EXPECT_FALSE(region_on_ray(flat, {0.3, -2.0, 2.0}, {0.0, 5.0, -2.0}));
}

} // namespace
} // namespace frustumscreen::world
