// The zone in which an artifact is seen whole, compared with rays from eyes to points of the artifact.
#include "app/settings/lit_zone.h"
#include "app/settings/whole_zone.h"
#include "tests/folders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace frustumscreen::settings {
namespace {

class Seeded {
public:
    double between(double low, double high) {
        return low + (high - low) * std::uniform_real_distribution<double>()(engine_);
    }
    /// More often near `low`, where the outermost eyes are, than near `high`.
    double near(double low, double high) { return low + (high - low) * std::pow(between(0.0, 1.0), 3.0); }

private:
    std::mt19937 engine_{4};
};

/// Settings, and an artifact in their prop.
struct Case {
    Settings settings;
    std::vector<glm::dvec3> hull;
};

Case shipped() {
    Case shown;
    shown.hull = usual_artifact(make_prop(shown.settings.prop));
    return shown;
}

/// A projector off to one side that looks obliquely, a steeper prop, an artifact that is not round and off the
/// axis.
Case askew() {
    Case shown;
    Settings& s = shown.settings;
    s.prop.base_m = 0.22;
    s.prop.top_m = 0.10;
    s.prop.height_m = 0.12;
    s.table = {1.4, 1.0};
    s.projector.pinhole = {1920, 1080, 2400.0, 2400.0, 900.0, 500.0};
    s.projector.table_from_projector = {
        glm::angleAxis(0.12, glm::dvec3(0.6, 0.8, 0.0)) * glm::dquat(0, 1, 0, 0), {0.12, 0.1, 1.7}};
    shown.hull = {{-0.05, -0.02, 0.0}, {0.06, -0.02, 0.0},  {0.06, 0.03, 0.0},
                  {-0.05, 0.03, 0.0},  {-0.05, -0.02, 0.1}, {0.01, 0.01, 0.12}};
    return shown;
}

/// The picture that is wider than the table.
Case wide() {
    Case shown;
    shown.settings = *load_settings(source_dir() + "/config/wide.toml").value();
    shown.hull = usual_artifact(make_prop(shown.settings.prop));
    return shown;
}

glm::dvec3 eye_around(const EyesAround& eyes, const EyeSettings& settings, Seeded& seeded) {
    const double azimuth = seeded.between(-std::numbers::pi, std::numbers::pi);
    const double elevation =
        eyes.higher_and_farther ? seeded.near(eyes.lowest_rad, 0.5 * std::numbers::pi) : eyes.lowest_rad;
    const double distance =
        eyes.higher_and_farther ? seeded.near(eyes.nearest_m, settings.farthest_m) : eyes.nearest_m;
    return distance * glm::dvec3(std::cos(elevation) * std::cos(azimuth),
                                 std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
}

bool is_lit(const Settings& settings, const geometry::RigidTransform& table_from_prop,
            const geometry::PropFace& face, const glm::dvec3& place) {
    const geometry::RigidTransform& table_from_projector = settings.projector.table_from_projector;
    const glm::dvec3 p = table_from_projector.inverse().point(table_from_prop.point(place));
    const geometry::Pinhole& pinhole = settings.projector.pinhole;
    const double u = pinhole.fx * p.x / p.z + pinhole.cx;
    const double v = pinhole.fy * p.y / p.z + pinhole.cy;
    const glm::dvec3 lens = table_from_prop.inverse().point(table_from_projector.translation);
    const bool turned = std::all_of(face.corners.begin(), face.corners.end(), [&](const glm::dvec3& corner) {
        return face.plane.distance(lens) >= min_sine_of_light * glm::distance(lens, corner);
    });
    constexpr double rounding_px = 1e-6;
    return turned && p.z > 0.0 && u >= -rounding_px && v >= -rounding_px &&
           u <= pinhole.width + rounding_px && v <= pinhole.height + rounding_px;
}

/// Number of rays from these eyes to points of the artifact that enter the prop at an unlit point.
int lost_rays(const Case& shown, const EyesAround& eyes, const geometry::RigidTransform& table_from_prop,
              int rays, Seeded& seeded, int& traced) {
    const geometry::PropShape prop = make_prop(shown.settings.prop);
    const auto corner = [&] {
        return shown.hull[static_cast<std::size_t>(
            seeded.between(0.0, static_cast<double>(shown.hull.size()) - 1e-6))];
    };
    int lost = 0;
    for (int k = 0; k < rays; ++k) {
        const glm::dvec3 eye = eye_around(eyes, shown.settings.eye, seeded);
        const double share = std::clamp(seeded.between(-0.3, 1.3), 0.0, 1.0);
        const glm::dvec3 to = glm::mix(corner(), corner(), share);
        geometry::PropHit hit;
        if (!geometry::intersect(prop, eye, to - eye, hit)) {
            continue;
        }
        ++traced;
        const geometry::PropFace& face = prop.faces[static_cast<std::size_t>(hit.face)];
        lost += is_lit(shown.settings, table_from_prop, face, eye + hit.t * (to - eye)) ? 0 : 1;
    }
    return lost;
}

geometry::RigidTransform upright_at(const glm::dvec2& at, double yaw) {
    return {glm::angleAxis(yaw, glm::dvec3(0, 0, 1)), glm::dvec3(at, 0.0)};
}

class WholeZoneOf : public ::testing::TestWithParam<Case (*)()> {};
INSTANTIATE_TEST_SUITE_P(SetUps, WholeZoneOf, ::testing::Values(&shipped, &askew, &wide));

TEST_P(WholeZoneOf, LosesNothingOfTheArtifactAtTenThousandPlaces) {
    const Case shown = GetParam()();
    Seeded seeded;
    for (const EyesAround& eyes : {all_eyes(shown.settings.eye), eyes_like_default(shown.settings.eye)}) {
        const WholeZone zone = whole_zone(shown.settings, eyes, shown.hull);
        ASSERT_GE(zone.places.size(), 3U);
        glm::dvec2 middle(0.0);
        for (const glm::dvec2& corner : zone.places) {
            middle += corner / static_cast<double>(zone.places.size());
        }
        int traced = 0;
        for (int k = 0; k < 5000; ++k) {
            // Half of the places lie on the border.
            const std::size_t side =
                static_cast<std::size_t>(seeded.between(0.0, static_cast<double>(zone.places.size()) - 1e-6));
            const glm::dvec2 border = glm::mix(
                zone.places[side], zone.places[(side + 1) % zone.places.size()], seeded.between(0.0, 1.0));
            const glm::dvec2 at = k % 2 == 0 ? border : glm::mix(middle, border, seeded.between(0.0, 1.0));
            const double yaw = seeded.between(-std::numbers::pi, std::numbers::pi);
            EXPECT_EQ(lost_rays(shown, eyes, upright_at(at, yaw), 40, seeded, traced), 0)
                << at.x << " " << at.y;
        }
        EXPECT_GT(traced, 150000);
    }
}

/// True if both places are at the same edge of the table, as near as the prop's axis may be: half the reach of its
/// foot's corners.
bool ends_at_the_rim(const Settings& settings, const glm::dvec2& from, const glm::dvec2& to) {
    const double rim = 0.5 * std::numbers::sqrt2 * 0.5 * settings.prop.base_m;
    const auto is_at = [&](int axis, double size_m) {
        return std::abs(std::abs(from[axis]) - (0.5 * size_m - rim)) < 1e-9 &&
               std::abs(from[axis] - to[axis]) < 1e-9;
    };
    return is_at(0, settings.table.width_m) || is_at(1, settings.table.depth_m);
}

/// Where the picture limits the zone, an eye loses a part of the artifact a little farther out: the zone is not
/// much too small.
TEST_P(WholeZoneOf, IsNotMuchSmallerThanItMustBe) {
    const Case shown = GetParam()();
    Seeded seeded;
    const EyesAround eyes = all_eyes(shown.settings.eye);
    const WholeZone zone = whole_zone(shown.settings, eyes, shown.hull);
    constexpr double farther_m = 0.012;
    int lost = 0;
    int tried = 0;
    for (std::size_t k = 0; k < zone.places.size(); ++k) {
        const glm::dvec2& from = zone.places[k];
        const glm::dvec2& to = zone.places[(k + 1) % zone.places.size()];
        if (ends_at_the_rim(shown.settings, from, to)) {
            continue; // the table ends the zone there, not the picture
        }
        const glm::dvec2 along = glm::normalize(to - from);
        const glm::dvec2 at = 0.5 * (from + to) + farther_m * glm::dvec2(along.y, -along.x);
        int traced = 0;
        int here = 0;
        for (int turn = 0; turn < 36 && here == 0; ++turn) {
            here += lost_rays(shown, eyes, upright_at(at, 0.25 * turn), 10000, seeded, traced);
        }
        ++tried;
        lost += here > 0 ? 1 : 0;
    }
    EXPECT_EQ(lost, tried);
    EXPECT_GE(tried, 3) << "the table ends the wide zone at its sides";
}

TEST(WholeZone, IsWiderThanTheFacesZoneAndWidestForHighEyes) {
    const Case shown = shipped();
    const Settings& s = shown.settings;
    const Rectangle faces = lit_rectangle(s);
    const Rectangle all = whole_zone(s, all_eyes(s.eye), shown.hull).rectangle;
    const Rectangle high = whole_zone(s, eyes_like_default(s.eye), shown.hull).rectangle;
    EXPECT_GT(all.half_m.x * all.half_m.y, 1.9 * faces.half_m.x * faces.half_m.y);
    EXPECT_GT(high.half_m.x * high.half_m.y, 1.5 * all.half_m.x * all.half_m.y);
}

TEST(WholeZone, ExtentOfAProtrudingArtifactEndsAtTheProp) {
    Case shown = shipped();
    shown.hull.emplace_back(0.2, 0.0, 0.1);
    const Polygon extent =
        seen_extent(make_prop(shown.settings.prop), all_eyes(shown.settings.eye), shown.hull);
    double farthest = 0.0;
    for (const glm::dvec2& round : extent) {
        farthest = std::max(farthest, round.x);
    }
    EXPECT_NEAR(farthest, 0.15 * std::numbers::sqrt2, 1e-9);
}

TEST(WholeZone, IsEmptyWhereTheLensIsTooLow) {
    Case shown = shipped();
    shown.settings.projector.table_from_projector.translation.z = 0.2;
    const WholeZone zone = whole_zone(shown.settings, all_eyes(shown.settings.eye), shown.hull);
    EXPECT_TRUE(zone.places.empty());
    EXPECT_EQ(zone.rectangle.half_m, glm::dvec2(0.0));
}

} // namespace
} // namespace frustumscreen::settings
