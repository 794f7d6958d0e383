#include "app/exhibit/idle_pose.h"
#include "tests/solid/example_props.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::exhibit {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const MonotonicTime start{seconds(100)};
const geometry::RigidTransform held_pose{{1.0, 0.0, 0.0, 0.0}, {0.2, -0.1, 0.0}};
constexpr glm::dvec2 place_m{0.03, 0.01};

/// A tracker that gives a good pose in every frame until `lost`, and again from `found` on; the pose counts as known
/// for a second after the last good one.
struct Visit {
    MonotonicTime lost;
    MonotonicTime found = lost + seconds(10'000);
    IdlePose idle_pose{place_m, true, start};

    [[nodiscard]] DrawnPose at(MonotonicTime now) {
        const Nanoseconds age = now >= lost && now < found ? Nanoseconds(now - lost) : Nanoseconds(0);
        return idle_pose.at(now, age <= seconds(1), age, held_pose);
    }
};

TEST(IdlePose, HoldsThePoseDuringAShortDropout) {
    Visit visit{start + seconds(1), start + seconds(3) - milliseconds(1)};
    for (MonotonicTime now = start; now < start + seconds(10); now += milliseconds(16)) {
        const DrawnPose drawn = visit.at(now);
        EXPECT_EQ(drawn.brightness, 1.0);
        EXPECT_FALSE(drawn.changing);
        EXPECT_FALSE(drawn.attracts);
        EXPECT_EQ(drawn.table_from_prop.translation, held_pose.translation);
    }
}

TEST(IdlePose, FadesToTheTurningPictureAndMovesOnlyInTheDark) {
    Visit visit{start + seconds(1)};
    double before = 1.0;
    bool attracted = false;
    double darkest = 1.0;
    for (MonotonicTime now = start; now < start + seconds(20); now += milliseconds(1)) {
        const DrawnPose drawn = visit.at(now);
        EXPECT_NEAR(drawn.brightness, before, 0.0026); // 1.5 / 600 ms
        if (drawn.attracts != attracted) {
            EXPECT_LT(drawn.brightness, 1e-4);
            EXPECT_GE(now, start + seconds(3) + milliseconds(599));
            attracted = drawn.attracts;
        }
        darkest = std::fmin(darkest, drawn.brightness);
        before = drawn.brightness;
    }
    EXPECT_TRUE(attracted);
    EXPECT_LT(darkest, 1e-4);
    EXPECT_EQ(before, 1.0);
}

TEST(IdlePose, TurnsOnceInFortySecondsAtItsPlace) {
    Visit visit{start + seconds(1)};
    for (int s = 5; s < 120; ++s) {
        const DrawnPose drawn = visit.at(start + seconds(s));
        EXPECT_EQ(drawn.table_from_prop.translation, glm::dvec3(place_m, 0.0));
        const double angle = 2.0 * std::numbers::pi * (s - 3) / 40.0; // since the fade began
        const glm::dvec3 ahead = drawn.table_from_prop.direction({1.0, 0.0, 0.0});
        EXPECT_NEAR(ahead.x, std::cos(angle), 1e-9) << s;
        EXPECT_NEAR(ahead.y, std::sin(angle), 1e-9) << s;
    }
}

TEST(IdlePose, NeverJumpsWhenThePropReturnsDuringTheFade) {
    for (int ms = 1000; ms < 5000; ms += 13) {
        Visit visit{start + seconds(1), start + seconds(1) + milliseconds(ms)};
        double before = 1.0;
        bool attracted = false;
        for (MonotonicTime now = start; now < visit.found + seconds(3); now += milliseconds(1)) {
            const DrawnPose drawn = visit.at(now);
            ASSERT_NEAR(drawn.brightness, before, 0.0026) << ms;
            ASSERT_TRUE(drawn.attracts == attracted || drawn.brightness < 1e-4) << ms;
            attracted = drawn.attracts;
            before = drawn.brightness;
        }
        EXPECT_FALSE(attracted);
        EXPECT_EQ(before, 1.0);
    }
}

TEST(IdlePose, IsIndependentOfTheFrameRate) {
    const auto stand_at = [](MonotonicTime end, Nanoseconds step) {
        Visit visit{start + seconds(1)};
        for (MonotonicTime now = start; now < end; now += step) {
            (void)visit.at(now);
        }
        return visit.at(end);
    };
    for (int ms = 2900; ms < 6000; ms += 50) {
        const MonotonicTime end = start + milliseconds(ms);
        const DrawnPose often = stand_at(end, milliseconds(1));
        const DrawnPose rarely = stand_at(end, seconds(2));
        EXPECT_EQ(often.brightness, rarely.brightness) << ms;
        EXPECT_EQ(often.table_from_prop.rotation, rarely.table_from_prop.rotation) << ms;
    }
}

TEST(IdlePose, TurnsAtOnceUntilTheFirstPose) {
    IdlePose idle_pose(place_m, false, start);
    const DrawnPose first = idle_pose.at(start, false, Nanoseconds(0), {});
    EXPECT_TRUE(first.attracts);
    EXPECT_EQ(first.brightness, 1.0);
    EXPECT_TRUE(idle_pose.at(start + seconds(5), false, Nanoseconds(0), {}).attracts);
    (void)idle_pose.at(start + seconds(6), true, Nanoseconds(0), held_pose);
    const DrawnPose later = idle_pose.at(start + seconds(8), true, Nanoseconds(0), held_pose);
    EXPECT_FALSE(later.attracts);
    EXPECT_EQ(later.brightness, 1.0);
}

struct IdleProp {
    std::string name;
    geometry::PropShape shape;
    bool square = false; ///< its area is that of two turns
};

std::vector<IdleProp> idle_props() {
    std::vector<IdleProp> props{{"frustum", geometry::make_frustum(geometry::shipped_frustum), true},
                                {"cube", geometry::make_cube(0.12), true}};
    for (const char* const name : {"hexagon", "tetrahedron", "gem"}) {
        props.push_back({name, solid::example_prop(name, solid::Underside::Dark), false});
    }
    return props;
}

DrawnPose turned_by(double yaw) {
    return {.table_from_prop = {glm::angleAxis(yaw, glm::dvec3(0.0, 0.0, 1.0)), glm::dvec3(place_m, 0.0)},
            .brightness = 1.0,
            .changing = false,
            .attracts = true};
}

/// How often a ray from the point to a place on the table meets the prop's planes at some turn, in and beside the area.
struct Counted {
    int hidden = 0;          ///< places that some turn hides
    int outside = 0;         ///< of them, those that do not lie in the area
    int free = 0;            ///< places in the area that no turn hides
    double farthest_m = 0.0; ///< how far outside
    double beyond_m = 0.0;   ///< how far the farthest free place lies from the hull of the hidden ones
};

constexpr double cell_m = 0.005; ///< from place to place

/// How far a point lies from the hull of others, along the direction in which it is farthest.
double farthest_beyond(std::span<const glm::dvec2> points, std::span<const glm::dvec2> hull_of) {
    double farthest_m = 0.0;
    for (int k = 0; k < 360; ++k) {
        const glm::dvec2 ahead(std::cos(k * std::numbers::pi / 180.0),
                               std::sin(k * std::numbers::pi / 180.0));
        const auto reach = [&](std::span<const glm::dvec2> of) {
            double most = -1.0;
            for (const glm::dvec2& each : of) {
                most = std::fmax(most, glm::dot(each, ahead));
            }
            return most;
        };
        farthest_m = std::fmax(farthest_m, reach(points) - reach(hull_of));
    }
    return farthest_m;
}

Counted count_hidden(const geometry::PropShape& prop, const typography::TablePolygon& area,
                     const glm::dvec3& from_m) {
    std::vector<geometry::RigidTransform> prop_from_table;
    for (int k = 0; k < 120; ++k) {
        prop_from_table.push_back(turned_by(2.0 * std::numbers::pi * k / 120.0).table_from_prop.inverse());
    }
    Counted counted;
    std::vector<glm::dvec2> hidden_places, free_places;
    for (double x = -0.4; x < 0.4; x += cell_m) {
        for (double y = -0.4; y < 0.4; y += cell_m) {
            const glm::dvec3 place(place_m.x + x, place_m.y + y,
                                   1e-4); // just above a foot that lies on the table
            const bool hidden = std::any_of(
                prop_from_table.begin(), prop_from_table.end(), [&](const geometry::RigidTransform& in_prop) {
                    geometry::PropHit hit;
                    return geometry::enter(prop, in_prop.point(from_m), in_prop.direction(place - from_m),
                                           hit) &&
                           hit.t < 1.0;
                });
            const std::array<glm::dvec2, 1> at{glm::dvec2(place)};
            const double away_m = typography::clearance(area.corners(), at);
            counted.outside += hidden && away_m > 1e-3 ? 1 : 0;
            counted.farthest_m = std::fmax(counted.farthest_m, hidden ? away_m : 0.0);
            if (hidden) {
                hidden_places.emplace_back(place);
            } else if (away_m == 0.0) {
                free_places.emplace_back(place);
            }
        }
    }
    counted.hidden = static_cast<int>(hidden_places.size());
    counted.free = static_cast<int>(free_places.size());
    counted.beyond_m = farthest_beyond(free_places, hidden_places);
    return counted;
}

TEST(IdlePose, HiddenAreaCoversAllTurns) {
    const glm::dvec3 lens_m(0.1, 0.2, 1.9);
    const glm::dvec3 eye_m(-0.2, -0.55, 0.5);
    for (const IdleProp& prop : idle_props()) {
        double radius_m = 0.0;
        for (const glm::dvec3& corner : prop.shape.corners) {
            radius_m = std::fmax(radius_m, glm::length(glm::dvec2(corner)));
        }
        for (const glm::dvec3& from_m : {lens_m, eye_m}) {
            const auto area = area_hidden_by(prop.shape, turned_by(0.3), from_m);
            ASSERT_TRUE(area) << prop.name;
            const Counted counted = count_hidden(prop.shape, *area, from_m);
            std::printf("%s from %.2f m: %d places hidden, %d outside by up to %.1f mm, %d free up to %.1f "
                        "mm beyond\n",
                        prop.name.c_str(), from_m.z, counted.hidden, counted.outside,
                        1e3 * counted.farthest_m, counted.free, 1e3 * counted.beyond_m);
            EXPECT_GT(counted.hidden, 300) << prop.name;
            const double larger = from_m.z / (from_m.z - 2.0 * prop.shape.middle.z);
            if (prop.square) {
                EXPECT_LT(counted.farthest_m, 0.08 * radius_m * larger) << prop.name;
                EXPECT_GT(counted.outside, 0) << prop.name << ": otherwise this test sees nothing";
            } else {
                EXPECT_EQ(counted.outside, 0) << prop.name;
                // The area is convex and the hidden places need not be. Beyond their hull it has the corners of its sides,
                // 1 per cent wider than a circle, and what lies between the last hidden places and the next ones.
                EXPECT_LT(counted.beyond_m, 0.01 * radius_m * larger + std::numbers::sqrt2 * cell_m)
                    << prop.name;
            }
        }
    }
}

TEST(IdlePose, HiddenAreaIsTheSameAtEveryYaw) {
    const glm::dvec3 eye_m(-0.2, -0.55, 0.5);
    for (const IdleProp& prop : idle_props()) {
        const auto first = area_hidden_by(prop.shape, turned_by(0.0), eye_m);
        const auto later = area_hidden_by(prop.shape, turned_by(1.1), eye_m);
        ASSERT_TRUE(first && later) << prop.name;
        ASSERT_EQ(first->count, later->count) << prop.name;
        EXPECT_TRUE(std::equal(first->corners().begin(), first->corners().end(), later->corners().begin()))
            << prop.name;
    }
}

/// The places of captions beside an idle frustum or cube have been chosen with this area.
TEST(IdlePose, HiddenAreaOfFrustumAndCubeIsTheHullOfTwoTurns) {
    for (const IdleProp& prop : idle_props()) {
        if (!prop.square) {
            continue;
        }
        for (const glm::dvec3& from_m : {glm::dvec3(0.1, 0.2, 1.9), glm::dvec3(-0.2, -0.55, 0.5)}) {
            const auto area = area_hidden_by(prop.shape, turned_by(0.7), from_m);
            ASSERT_TRUE(area);
            typography::TablePolygon two;
            for (const double yaw : {0.0, 0.25 * std::numbers::pi}) {
                two = typography::hull_of(
                    two, typography::hidden_by_prop(prop.shape, turned_by(yaw).table_from_prop, from_m)
                             ->corners());
            }
            ASSERT_EQ(area->count, two.count) << prop.name;
            EXPECT_TRUE(std::equal(area->corners().begin(), area->corners().end(), two.corners().begin()))
                << prop.name;
        }
    }
}

} // namespace
} // namespace frustumscreen::exhibit
