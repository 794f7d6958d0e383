// Labels of hotspots, through the exhibit: shown exactly where a cast ray meets the point.

#include "app/geometry/picture_planes.h"
#include "app/settings/lit_zone.h"
#include "tests/exhibit/exhibits.h"
#include "tests/render/counted_new.h"
#include "tests/solid/example_props.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

namespace frustumscreen::exhibit {
namespace {

using sample::start;
using std::chrono::milliseconds;

/// Two adjacent blocks, in the prop's frame: each hides the other's inner side from most eyes.
struct Blocks {
    std::vector<glm::vec3> points;
    std::vector<std::uint32_t> indices;

    Blocks() {
        add({-0.028, -0.015, 0.0}, {-0.008, 0.015, 0.07});
        add({0.008, -0.015, 0.0}, {0.028, 0.015, 0.05});
    }
    void add(const glm::vec3& low, const glm::vec3& high) {
        const auto first = static_cast<std::uint32_t>(points.size());
        for (unsigned k = 0; k < 8; ++k) {
            points.emplace_back((k & 1U) != 0 ? high.x : low.x, (k & 2U) != 0 ? high.y : low.y,
                                (k & 4U) != 0 ? high.z : low.z);
        }
        for (const auto& [a, b, c, d] :
             {std::array{0U, 1U, 3U, 2U}, std::array{4U, 5U, 7U, 6U}, std::array{0U, 1U, 5U, 4U},
              std::array{2U, 3U, 7U, 6U}, std::array{0U, 2U, 6U, 4U}, std::array{1U, 3U, 7U, 5U}}) {
            for (const unsigned corner : {a, b, c, a, c, d}) {
                indices.push_back(first + corner);
            }
        }
    }
    /// True if the segment meets a triangle: Cramer's rule, triangle by triangle.
    [[nodiscard]] bool meets(const glm::dvec3& from, const glm::dvec3& to) const {
        for (std::size_t k = 0; k < indices.size(); k += 3) {
            const glm::dvec3 a(points[indices[k]]);
            const glm::dmat3 m(glm::dvec3(points[indices[k + 1]]) - a, glm::dvec3(points[indices[k + 2]]) - a,
                               from - to);
            const double det = glm::determinant(m);
            if (std::abs(det) < 1e-15) {
                continue;
            }
            const glm::dvec3 x = glm::inverse(m) * (from - a);
            if (x.x >= 0.0 && x.y >= 0.0 && x.x + x.y <= 1.0 && x.z > 0.0 && x.z < 1.0) {
                return true;
            }
        }
        return false;
    }
};

constexpr double tolerance_m = 1e-4;

HotspotSet hotspots_of(const Blocks& blocks) {
    HotspotSet set;
    set.triangles = {std::make_shared<const geometry::TriangleTree>(blocks.points, blocks.indices),
                     tolerance_m};
    for (const auto& [point, normal] :
         {std::pair(glm::dvec3(-0.008, 0.0, 0.03), glm::dvec3(1, 0, 0)), // inner sides
          std::pair(glm::dvec3(0.008, 0.004, 0.02), glm::dvec3(-1, 0, 0)),
          std::pair(glm::dvec3(-0.018, -0.015, 0.05), glm::dvec3(0, -1, 0)), // outer sides
          std::pair(glm::dvec3(0.018, 0.0, 0.05), glm::dvec3(0, 0, 1))}) {
        set.hotspots.push_back({{point, normal}, {{0.04, 0.010}, {0.05, 0.010}}});
    }
    return set;
}

/// The tellable lists one hotspot more than exist.
Exhibit make_exhibit(const HotspotSet& set, const std::vector<geometry::Plane>& picture_edges = {}) {
    const Tellable tellable{{}, std::vector<Nanoseconds>(set.hotspots.size() + 1, std::chrono::seconds(1))};
    CatalogueEntry entry{{"en", "de"}, {2, {{0.1, 0.03}}}, {2, tellable}, {}, set};
    ExhibitPlace place = sample::place();
    place.lens_m = {0.0, 0.0, 1.4};
    place.picture_edges = picture_edges;
    return {{entry}, place, "en", start};
}

struct Shower {
    Exhibit exhibit;
    MonotonicTime now = start;
    tracking::TrackedState tracked_state = sample::tracked_state(start);
    Presentation shown = {};

    void wait(milliseconds time, std::span<const settings::Command> commands = {}) {
        for (milliseconds each{0}; each < time; each += milliseconds(20)) {
            now += milliseconds(20);
            shown = exhibit.step(now, each.count() == 0 ? commands : std::span<const settings::Command>{},
                                 tracked_state);
        }
    }
    /// Presses until this hotspot is told; nothing: until none is.
    void point_out(std::optional<std::size_t> hotspot) {
        for (int press = 0; press < 100 && shown.tells_of != hotspot; ++press) {
            wait(milliseconds(20), std::array{settings::Command::Choose});
        }
        ASSERT_EQ(shown.tells_of, hotspot);
    }
};

/// True if the face through which the eye looks at the point is lit by the lens.
bool looks_through_a_lit_face(const geometry::PropShape& prop, const glm::dvec3& eye, const glm::dvec3& lens,
                              const glm::dvec3& point) {
    double entry = -1.0;
    bool lit = false;
    for (const geometry::PropFace& face : prop.faces) {
        const double from = face.plane.distance(eye);
        const double to = face.plane.distance(point);
        if (from > 0.0 && from / (from - to) > entry) {
            entry = from / (from - to);
            lit = face.plane.distance(lens) > 0.0;
        }
    }
    return lit;
}

TEST(HotspotLabels, AreShownWhereARayFromTheEyeMeetsThePoint) {
    const Blocks blocks;
    const HotspotSet set = hotspots_of(blocks);
    const ExhibitPlace place = sample::place();
    std::mt19937 random(8);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    Shower shower{make_exhibit(set)};
    int seen = 0;
    int turned_away = 0;
    int hidden = 0;
    for (int k = 0; k < 300; ++k) {
        const std::size_t which = static_cast<std::size_t>(k) % set.hotspots.size();
        const double yaw = 3.14159 * u(random);
        shower.tracked_state.table_from_prop = {glm::angleAxis(yaw, glm::dvec3(0, 0, 1)),
                                                {0.15 * u(random), 0.05 * u(random), 0.0}};
        const double azimuth = 3.14159 * u(random);
        const double elevation = 0.7 + 0.5 * u(random);
        shower.tracked_state.eye_m =
            0.8 * glm::dvec3(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                             std::sin(elevation));
        shower.point_out(which);
        shower.wait(milliseconds(2000));
        const geometry::RigidTransform prop_from_table = shower.tracked_state.table_from_prop.inverse();
        const glm::dvec3 eye = prop_from_table.point(shower.tracked_state.eye_m);
        const Hotspot& at = set.hotspots[which].at;
        const bool faces = glm::dot(eye - at.point_m, at.normal) > 0.0;
        const bool is_hidden = blocks.meets(eye, at.point_m + tolerance_m * at.normal);
        const bool lit =
            looks_through_a_lit_face(place.prop, eye, prop_from_table.point({0.0, 0.0, 1.4}), at.point_m);
        const bool expected = faces && !is_hidden && lit;
        EXPECT_EQ(shower.shown.hotspot.has_value(), expected) << "pose " << k << ", hotspot " << which;
        seen += expected ? 1 : 0;
        turned_away += faces ? 0 : 1;
        hidden += faces && is_hidden ? 1 : 0;
        if (shower.shown.hotspot) {
            const PresentedHotspot& shown = *shower.shown.hotspot;
            EXPECT_EQ(shown.hotspot, which);
            ASSERT_TRUE(shown.line);
            const auto shadow =
                typography::hidden_by_prop(place.prop, shower.tracked_state.table_from_prop, {0.0, 0.0, 1.4});
            EXPECT_GT(typography::clearance(shown.label.corners(), shadow->corners()), 0.0);
            ASSERT_TRUE(shower.shown.caption);
            EXPECT_GT(typography::clearance(shown.label.corners(), shower.shown.caption->rectangle.corners()),
                      0.0);
            EXPECT_EQ(typography::clearance(shown.label.corners(), shown.line->points().last(1)), 0.0);
        }
    }
    EXPECT_GT(seen, 60);
    EXPECT_GT(turned_away, 60);
    EXPECT_GT(hidden, 20);
}

/// The point where a ray from outside enters the prop, by bisection from a point inside.
glm::dvec3 entry_of(const geometry::PropShape& prop, glm::dvec3 outside, glm::dvec3 inside) {
    for (int halving = 0; halving < 60; ++halving) {
        const glm::dvec3 middle = 0.5 * (outside + inside);
        const bool is_inside =
            std::all_of(prop.bounds.begin(), prop.bounds.end(),
                        [&](const geometry::Plane& plane) { return plane.distance(middle) <= 0.0; });
        (is_inside ? inside : outside) = middle;
    }
    return inside;
}

/// At the picture's edge a face that is turned to the lens is lit in part: a label is shown only if the place through
/// which its point is seen is in the picture.
TEST(HotspotLabels, HiddenWhereTheRayEntersOutsideThePicture) {
    const Blocks blocks;
    const HotspotSet set = hotspots_of(blocks);
    const geometry::PropShape prop = sample::place().prop;
    // From 1.4 m above, the picture covers 0.7 x 0.4 m of the table.
    const geometry::Pinhole pinhole{1400, 800, 2800.0, 2800.0, 700.0, 400.0};
    const glm::dvec3 lens(0.0, 0.0, 1.4);
    const auto edges = geometry::picture_planes(pinhole, {glm::dquat(0.0, 1.0, 0.0, 0.0), lens});
    Shower shower{make_exhibit(set, {edges.begin(), edges.end()})};
    Shower by_faces{make_exhibit(set)};
    std::mt19937 random(9);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    int shown = 0;
    int beside = 0;
    int shown_by_faces = 0; // beside the picture
    for (int k = 0; k < 400; ++k) {
        const std::size_t which = static_cast<std::size_t>(k) % set.hotspots.size();
        shower.tracked_state.table_from_prop = {glm::angleAxis(3.14159 * u(random), glm::dvec3(0, 0, 1)),
                                                {0.35 * u(random), 0.2 * u(random), 0.0}};
        shower.tracked_state.eye_m = {0.8 * u(random), 0.8 * u(random), 0.6 + 0.3 * u(random)};
        by_faces.tracked_state = shower.tracked_state;
        for (Shower* each : {&shower, &by_faces}) {
            each->point_out(which);
            each->wait(milliseconds(1200));
        }
        const geometry::RigidTransform& table_from_prop = shower.tracked_state.table_from_prop;
        const geometry::RigidTransform prop_from_table = table_from_prop.inverse();
        const glm::dvec3 eye = prop_from_table.point(shower.tracked_state.eye_m);
        const Hotspot& at = set.hotspots[which].at;
        if (!(glm::dot(eye - at.point_m, at.normal) > 0.0) ||
            blocks.meets(eye, at.point_m + tolerance_m * at.normal)) {
            EXPECT_FALSE(shower.shown.hotspot) << k;
            continue;
        }
        const glm::dvec3 place = table_from_prop.point(entry_of(prop, eye, at.point_m));
        const double x_px = 2800.0 * place.x / (1.4 - place.z) + 700.0; // the lens looks straight down
        const double y_px = -2800.0 * place.y / (1.4 - place.z) + 400.0;
        const bool in_picture = x_px >= 0.0 && x_px <= 1400.0 && y_px >= 0.0 && y_px <= 800.0;
        const bool turned = looks_through_a_lit_face(prop, eye, prop_from_table.point(lens), at.point_m);
        EXPECT_FALSE(shower.shown.hotspot && !(in_picture && turned)) << k;
        beside += turned && !in_picture ? 1 : 0;
        shown_by_faces += by_faces.shown.hotspot && !in_picture ? 1 : 0;
        shown += shower.shown.hotspot ? 1 : 0;
    }
    EXPECT_GT(beside, 15);
    EXPECT_GT(shown_by_faces, 10);
    EXPECT_GT(shown, 60);
}

/// The label goes dark without a fade, in the very step in which the point turns away.
TEST(HotspotLabels, HiddenAsSoonAsThePointTurnsAway) {
    const Blocks blocks;
    Shower shower{make_exhibit(hotspots_of(blocks))};
    shower.point_out(2); // on -Y
    shower.wait(milliseconds(1000));
    ASSERT_TRUE(shower.shown.hotspot);
    EXPECT_EQ(shower.shown.hotspot->brightness, 1.0);
    double last = 1.0;
    int dark = 0;
    for (int degree = 0; degree <= 180; degree += 2) {
        shower.tracked_state.table_from_prop.rotation =
            glm::angleAxis(glm::radians(1.0 * degree), glm::dvec3(0, 0, 1));
        shower.wait(milliseconds(20));
        const glm::dvec3 eye =
            shower.tracked_state.table_from_prop.inverse().point(shower.tracked_state.eye_m);
        const double brightness = shower.shown.hotspot ? shower.shown.hotspot->brightness : 0.0;
        if (eye.y >= -0.015) {
            EXPECT_EQ(brightness, 0.0) << degree;
            ++dark;
        }
        EXPECT_LT(last - brightness, 0.4) << degree; // gradual
        last = brightness;
    }
    EXPECT_GT(dark, 30);
}

/// Over a triangle's plane the lens is low, and its distance decides: that to the mean of the corners, also where the
/// middle of an edge is farther away or nearer.
TEST(HotspotLabels, TriangularFaceIsLitAsSeenFromItsCentroid) {
    const geometry::PropShape prop = solid::example_prop("tetrahedron");
    for (std::size_t k = 0; k < prop.faces.size(); ++k) {
        const geometry::PropFace& face = prop.faces[k];
        ASSERT_EQ(face.corners.size(), 3U);
        const glm::dvec3 middle = (face.corners[0] + face.corners[1] + face.corners[2]) / 3.0;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            for (const double towards : {-1.0, 1.0}) {
                const glm::dvec3 along = towards * 0.5 * glm::normalize(face.corners[corner] - middle);
                for (const double share : {0.99, 1.01}) {
                    const double sine = share * settings::min_sine_of_light;
                    const glm::dvec3 lens =
                        middle + along + 0.5 * sine / std::sqrt(1.0 - sine * sine) * face.plane.normal;
                    EXPECT_EQ((faces_lit_from(prop, lens) >> k & 1U) != 0, share > 1.0)
                        << face.name << ' ' << corner << ' ' << towards;
                }
            }
        }
    }
}

TEST(HotspotLabels, FollowTheLanguageAndHideWhenNotTold) {
    const Blocks blocks;
    Shower shower{make_exhibit(hotspots_of(blocks))};
    shower.point_out(2);
    shower.wait(milliseconds(1000));
    ASSERT_TRUE(shower.shown.hotspot);
    EXPECT_EQ(shower.shown.hotspot->label.size_m.x, 0.04);
    shower.wait(milliseconds(1500), std::array{settings::Command::NextLanguage});
    EXPECT_FALSE(shower.shown.hotspot);
    shower.point_out(2);
    shower.wait(milliseconds(1000));
    ASSERT_TRUE(shower.shown.hotspot);
    EXPECT_EQ(shower.shown.hotspot->language, 1U);
    EXPECT_EQ(shower.shown.hotspot->label.size_m.x, 0.05);
    EXPECT_TRUE(shower.shown.settled);
    shower.point_out(4); // does not exist
    shower.wait(milliseconds(500));
    EXPECT_FALSE(shower.shown.hotspot);
    shower.point_out(2);
    shower.wait(milliseconds(800));
    EXPECT_TRUE(shower.shown.hotspot);
    shower.point_out(std::nullopt);
    shower.wait(milliseconds(500));
    EXPECT_FALSE(shower.shown.hotspot);
}

TEST(HotspotLabels, AllocateNothing) {
    if (!synthetic::allocations_are_counted) {
        GTEST_SKIP() << "the sanitizers have allocations of their own";
    }
    const Blocks blocks;
    Shower shower{make_exhibit(hotspots_of(blocks))};
    shower.wait(milliseconds(100));
    const long before = synthetic::allocations_so_far();
    for (std::size_t k = 0; k < 4; ++k) {
        shower.point_out(k);
        shower.wait(milliseconds(600));
    }
    EXPECT_EQ(synthetic::allocations_so_far(), before);
}

} // namespace
} // namespace frustumscreen::exhibit
