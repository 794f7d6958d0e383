#include "app/settings/lit_zone.h"
#include "tests/folders.h"
#include "tests/settings/steep_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace frustumscreen::settings {
namespace {

/// Written out independently: the prop's eight corners turned and moved, planes through three corners, the pinhole.
/// Positive if the face is lit; the slack of the tightest condition, in metres for planes and pixels for corners.
struct Slack {
    double light = 1e9;
    double picture = 1e9;
    [[nodiscard]] bool lit(double metres = 0.0, double pixels = 0.0) const {
        return light >= metres && picture >= pixels;
    }
};

Slack slack_of(const Settings& s, double x, double y, double yaw, const glm::dvec3& eye) {
    const double b = s.prop.base_m / 2;
    const double t = s.prop.top_m / 2;
    const auto corner = [&](int around, bool top) {
        const double side = top ? t : b;
        const double px = (around == 0 || around == 3 ? 1 : -1) * side;
        const double py = (around < 2 ? 1 : -1) * side;
        return glm::dvec3(x + std::cos(yaw) * px - std::sin(yaw) * py,
                          y + std::sin(yaw) * px + std::cos(yaw) * py, top ? s.prop.height_m : 0.0);
    };
    const glm::dvec3 lens = s.projector.table_from_projector.translation;
    const glm::dvec3 right = s.projector.table_from_projector.direction({1, 0, 0});
    const glm::dvec3 down = s.projector.table_from_projector.direction({0, 1, 0});
    const glm::dvec3 forward = s.projector.table_from_projector.direction({0, 0, 1});
    Slack slack;
    for (int face = 0; face < 5; ++face) {
        std::vector<glm::dvec3> corners;
        if (face == 4) {
            corners = {corner(0, true), corner(1, true), corner(2, true), corner(3, true)};
        } else {
            const int next = (face + 1) % 4;
            corners = {corner(face, false), corner(next, false), corner(next, true), corner(face, true)};
        }
        glm::dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
        const glm::dvec3 middle(x, y, s.prop.height_m / 2);
        if (glm::dot(normal, corners[0] - middle) < 0) {
            normal = -normal;
        }
        if (glm::dot(normal, eye - corners[0]) <= 0) {
            continue;
        }
        const double grazing = min_sine_of_light * glm::distance(lens, glm::dvec3(x, y, 0));
        slack.light = std::min(slack.light, glm::dot(normal, lens - corners[0]) - grazing);
        for (const glm::dvec3& c : corners) {
            const glm::dvec3 ray = c - lens;
            const geometry::Pinhole& p = s.projector.pinhole;
            const double u = p.fx * glm::dot(ray, right) / glm::dot(ray, forward) + p.cx;
            const double v = p.fy * glm::dot(ray, down) / glm::dot(ray, forward) + p.cy;
            slack.picture = std::min({slack.picture, u, v, p.width - u, p.height - v});
        }
    }
    return slack;
}

bool on_table(const Settings& s, const glm::dvec2& place) {
    const double radius = s.prop.base_m / 2 * std::sqrt(2.0);
    return std::abs(place.x) + radius <= s.table.width_m / 2 &&
           std::abs(place.y) + radius <= s.table.depth_m / 2;
}

/// The smallest slack over many yaws.
Slack worst_yaw(const Settings& s, const glm::dvec2& place, const glm::dvec3& eye, int yaws) {
    Slack worst;
    for (int k = 0; k < yaws; ++k) {
        const Slack slack = slack_of(s, place.x, place.y, k * std::acos(0.0) / yaws, eye);
        worst.light = std::min(worst.light, slack.light);
        worst.picture = std::min(worst.picture, slack.picture);
    }
    return worst;
}

bool inside(const std::vector<glm::dvec2>& polygon, const glm::dvec2& p) {
    bool in = false;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const glm::dvec2& a = polygon[k];
        const glm::dvec2& b = polygon[(k + 1) % polygon.size()];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) {
            in = !in;
        }
    }
    return in;
}

class Draw {
public:
    explicit Draw(unsigned seed) : engine_(seed) {}
    double operator()(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }

private:
    std::mt19937 engine_;
};

/// A projector somewhere above, tilted and shifted; a prop of any size.
Settings random_settings(Draw& draw) {
    Settings s = steep_table();
    s.prop = {PropKind::Frustum, draw(0.1, 0.2), draw(0.03, 0.09), draw(0.06, 0.2)};
    const glm::dquat tilt = glm::normalize(glm::dquat(1, draw(-0.1, 0.1), draw(-0.1, 0.1), draw(-0.4, 0.4)));
    s.projector.table_from_projector.rotation = tilt * glm::dquat(0, 1, 0, 0);
    s.projector.table_from_projector.translation = {draw(-0.2, 0.2), draw(-0.2, 0.2), draw(0.8, 1.4)};
    s.projector.pinhole.fx = draw(1000, 2000);
    s.projector.pinhole.fy = draw(1000, 2000);
    s.projector.pinhole.cx = draw(500, 780);
    s.projector.pinhole.cy = draw(300, 500);
    s.eye.default_m = {draw(-0.5, 0.5), draw(-0.8, -0.3), draw(0.15, 0.7)};
    s.table = {draw(0.6, 1.2), draw(0.5, 0.8)};
    return s;
}

TEST(LitZone, OnePoseMatchesIndependentArithmetic) {
    Draw draw(1);
    int lit = 0;
    for (int k = 0; k < 20000; ++k) {
        const Settings s = random_settings(draw);
        const glm::dvec2 place(draw(-0.4, 0.4), draw(-0.3, 0.3));
        const double yaw = draw(-3, 3);
        const Slack slack = slack_of(s, place.x, place.y, yaw, s.eye.default_m);
        const geometry::RigidTransform pose{glm::dquat(std::cos(yaw / 2), 0, 0, std::sin(yaw / 2)),
                                            glm::dvec3(place, 0.0)};
        const bool answer = every_seen_face_is_lit(s, pose, s.eye.default_m);
        lit += answer ? 1 : 0;
        if (std::abs(slack.light) > 1e-9 && std::abs(slack.picture) > 1e-6) {
            EXPECT_EQ(answer, slack.lit());
        }
    }
    EXPECT_GT(lit, 2000);
    EXPECT_LT(lit, 18000);
}

TEST(LitZone, AnyEyeZoneMatchesThePlacesLitAtEveryYaw) {
    Draw draw(3);
    int inside_count = 0;
    int outside_count = 0;
    for (int k = 0; k < 40; ++k) {
        const Settings s = random_settings(draw);
        const std::vector<glm::dvec2> zone = lit_zone(s).any_eye;
        for (int n = 0; n < 25; ++n) {
            const glm::dvec2 place(draw(-0.5, 0.5), draw(-0.35, 0.35));
            // An eye high above and far away sees every face of a frustum at once.
            const Slack worst = worst_yaw(s, place, glm::dvec3(place, 100.0), 90);
            if (inside(zone, place)) {
                ++inside_count;
                EXPECT_TRUE(worst.lit(-1e-9, -1e-6) && on_table(s, place));
            } else {
                ++outside_count;
                EXPECT_FALSE(worst.lit(3e-4, 1.0) && on_table(s, place * 1.001));
            }
        }
    }
    EXPECT_GT(inside_count, 50);
    EXPECT_GT(outside_count, 100);
}

TEST(LitZone, DefaultEyeZoneIsLitAndEndsWhereAFaceIsDark) {
    Draw draw(4);
    int lit = 0;
    int dark = 0;
    for (int k = 0; k < 20; ++k) {
        const Settings s = random_settings(draw);
        const LitZone zone = lit_zone(s);
        const std::size_t count = zone.default_eye.size();
        ASSERT_GE(count, 360U);
        EXPECT_GE(area_of(zone.default_eye), area_of(zone.any_eye) - 1e-6);
        for (std::size_t n = 0; n < count; n += 7) {
            const glm::dvec2& corner = zone.default_eye[n];
            EXPECT_TRUE(on_table(s, corner * (1 - 1e-9)));
            EXPECT_TRUE(worst_yaw(s, corner, s.eye.default_m, 180).lit(-1e-9, -1e-6));
            ++lit;
            const glm::dvec2 along =
                zone.default_eye[(n + 1) % count] - zone.default_eye[(n + count - 1) % count];
            const glm::dvec2 beyond = corner + 1e-3 * glm::normalize(glm::dvec2(along.y, -along.x));
            if (on_table(s, beyond)) {
                // The worst yaw may lie between two tried ones, a tenth of a degree apart; a face may just come
                // into sight there.
                EXPECT_FALSE(worst_yaw(s, beyond, s.eye.default_m, 900).lit(3e-4, 1.0));
                ++dark;
            }
        }
    }
    EXPECT_GT(lit, 1000);
    EXPECT_GT(dark, 300);
}

TEST(LitZone, TheRectangleFitsAndIsUsefulInBothSetUps) {
    for (const std::string name : {"kiosk", "near"}) {
        const auto settings = load_settings(source_dir() + "/config/" + name + ".toml");
        ASSERT_TRUE(settings) << settings.error().message;
        const LitZone zone = lit_zone(**settings);
        const Rectangle& r = zone.any_eye_rectangle;
        EXPECT_EQ(lit_rectangle(**settings).centre_m, r.centre_m);
        EXPECT_EQ(lit_rectangle(**settings).half_m, r.half_m);
        for (const glm::dvec2 sign :
             {glm::dvec2(1, 1), glm::dvec2(-1, 1), glm::dvec2(1, -1), glm::dvec2(-1, -1)}) {
            EXPECT_TRUE(inside(zone.any_eye, r.centre_m + sign * r.half_m * (1 - 1e-9)));
        }
        EXPECT_GT(r.half_m.x, name == "near" ? 0.08 : 0.17);
        EXPECT_GT(r.half_m.y, name == "near" ? 0.012 : 0.035);
    }
}

TEST(LitZone, GoesDarkWhereTheLensPassesBehindAFacesPlane) {
    // By hand: a face leans back 0.035 m over 0.12 m, so the lens at 0.9 m clears its plane up to
    // 0.08 - 0.9 * 0.035 / 0.12 = -0.1825 m from the prop's middle (facts: 'beyond about 180 mm').
    Settings s = steep_table();
    s.projector.table_from_projector.translation.z = 0.9;
    s.projector.pinhole.fx = s.projector.pinhole.fy = 500.0; // the picture is no limit
    const glm::dvec3 eye(5.0, 0.0, 5.0);
    EXPECT_GT(slack_of(s, 0.14, 0.0, 0.0, eye).light, 0.0);
    EXPECT_TRUE(every_seen_face_is_lit(s, {glm::dquat(1, 0, 0, 0), {0.14, 0, 0}}, eye));
    EXPECT_FALSE(every_seen_face_is_lit(s, {glm::dquat(1, 0, 0, 0), {0.19, 0, 0}}, eye));
    // An eye on the other side does not see that face.
    EXPECT_TRUE(every_seen_face_is_lit(s, {glm::dquat(1, 0, 0, 0), {0.19, 0, 0}}, {-5.0, 0.0, 1.0}));
}

TEST(LitZone, ACubesSidesAreNeverLitFromStraightAbove) {
    Settings s = steep_table();
    s.prop = {PropKind::Cube, 0.12, 0.12, 0.12};
    const LitZone zone = lit_zone(s);
    EXPECT_TRUE(zone.any_eye.empty());
    EXPECT_EQ(zone.any_eye_rectangle.half_m, glm::dvec2(0.0));
    EXPECT_TRUE(zone.default_eye.empty());
}

TEST(LitZone, HandZoneKeepsThePropInThePictureAtAnyRotation) {
    Settings s = steep_table();
    s.prop = cube_settings(0.12);
    s.projector.pinhole.cx = 500.0; // lens shift
    const geometry::PropShape prop = make_prop(s.prop);
    const double reach = 0.06 * std::sqrt(3.0);
    const LitZone zone = lit_zone(s);
    ASSERT_GE(zone.any_eye.size(), 4U);
    EXPECT_EQ(zone.default_eye, zone.any_eye);
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    const auto leaves = [&](const glm::dvec2& place) {
        for (int k = 0; k < 20000; ++k) {
            const glm::dquat rotation =
                glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random)));
            for (const glm::dvec3& corner : prop.corners) {
                const glm::dvec3 at = glm::dvec3(place, reach) + rotation * (corner - prop.middle);
                const auto pixel =
                    s.projector.pinhole.pixel(s.projector.table_from_projector.inverse().point(at));
                const bool on_table = std::abs(at.x) <= 0.4 + 1e-9 && std::abs(at.y) <= 0.25 + 1e-9;
                if (!on_table || !pixel || pixel->x < -1e-6 || pixel->y < -1e-6 || pixel->x > 1280.0 + 1e-6 ||
                    pixel->y > 800.0 + 1e-6) {
                    return true;
                }
            }
        }
        return false;
    };
    glm::dvec2 middle(0.0);
    for (const glm::dvec2& corner : zone.any_eye) {
        EXPECT_FALSE(leaves(corner)) << corner.x << ' ' << corner.y;
        middle += corner / static_cast<double>(zone.any_eye.size());
    }
    for (const glm::dvec2& corner : zone.any_eye) {
        const glm::dvec2 outside = corner + 0.01 * glm::normalize(corner - middle);
        EXPECT_TRUE(leaves(outside)) << outside.x << ' ' << outside.y;
    }
}

TEST(LitZone, TerminatesOnATableHardlyDeeperThanTheProp) {
    Settings settings;
    settings.projector.pinhole.fx = settings.projector.pinhole.fy = 200.0;
    settings.prop = {PropKind::Frustum, 0.16, 0.02, 0.05};
    settings.table.width_m = 10.0;
    settings.table.depth_m = 0.16 * std::sqrt(2.0) + 1e-8;
    const LitZone zone = lit_zone(settings);
    double farthest = 0.0;
    for (const glm::dvec2& place : zone.default_eye) {
        EXPECT_LE(std::abs(place.y), 0.5e-8 + 1e-15);
        farthest = std::max(farthest, std::abs(place.x));
    }
    EXPECT_GT(farthest, 0.5) << "and the places along it are found";
}

TEST(LitZone, ThePictureOnTheTableHasTheFootprintsArea) {
    Settings s = steep_table(); // exactly the table
    EXPECT_NEAR(area_of(picture_on_table(s, 0.0)), 0.4, 1e-9);
    EXPECT_NEAR(area_of(picture_on_table(s, 0.6)), 0.1, 1e-9);
    s.projector.table_from_projector.translation.x = 0.4;
    EXPECT_NEAR(area_of(picture_on_table(s, 0.0)), 0.2, 1e-9);
    s.projector.table_from_projector.translation.x = 0.9;
    EXPECT_TRUE(picture_on_table(s, 0.0).empty());
}

} // namespace
} // namespace frustumscreen::settings
