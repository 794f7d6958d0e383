#include "app/typography/caption_image.h"
#include "app/typography/captions.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <span>

namespace frustumscreen::exhibit {
namespace {

using std::chrono::milliseconds;

const glm::dvec3 lens(0.0, 0.0, 1.2);
const glm::dvec3 eye(0.0, -0.55, 0.5);
const std::vector<glm::dvec2> shipped_table{{-0.4, -0.25}, {0.4, -0.25}, {0.4, 0.25}, {-0.4, 0.25}};
const std::vector<glm::dvec2> near_table{{-0.2, -0.126}, {0.2, -0.126}, {0.2, 0.126}, {-0.2, 0.126}};

geometry::RigidTransform standing(double x, double y, double yaw) {
    return {glm::angleAxis(yaw, glm::dvec3(0, 0, 1)), {x, y, 0.0}};
}

struct Table {
    geometry::PropShape prop = geometry::make_frustum({});
    typography::CaptionPlacer placer;
    glm::dvec3 lens_m = lens;

    explicit Table(const std::vector<glm::dvec2>& picture_m) : placer(picture_m) {}
    typography::CaptionPlace step(MonotonicTime now, const geometry::RigidTransform& pose) {
        placer.update(now, typography::hidden_by_prop(prop, pose, lens_m),
                      typography::hidden_by_prop(prop, pose, eye), glm::dvec2(pose.translation));
        return placer.at(now);
    }
};

/// True if the ray to a table point meets the prop, grown by `grown_m` on every side: each plane cuts off a part of the ray.
bool lands_on_prop(const geometry::PropShape& prop, const geometry::RigidTransform& pose,
                   const glm::dvec3& from, const glm::dvec2& p, double grown_m = -1e-9) {
    const glm::dvec3 a = pose.inverse().point(from);
    const glm::dvec3 b = pose.inverse().point({p, 0.0});
    double enters = 0.0;
    double leaves = 1.0;
    for (const geometry::Plane& bound : prop.bounds) {
        const double begin = bound.distance(a) - grown_m;
        const double end = bound.distance(b) - grown_m;
        if (begin > 0.0 && end > 0.0) {
            return false;
        }
        if (begin > 0.0) {
            enters = std::max(enters, begin / (begin - end));
        } else if (end > 0.0) {
            leaves = std::min(leaves, begin / (begin - end));
        }
    }
    return enters <= leaves;
}

TEST(Captions, ShadowMatchesTheRaysThatMeetTheProp) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> x(-0.3, 0.3);
    std::uniform_real_distribution<double> turn(-3.2, 3.2);
    const geometry::PropShape prop = geometry::make_frustum({});
    int hidden = 0;
    int free = 0;
    for (int k = 0; k < 200; ++k) {
        const geometry::RigidTransform pose = standing(x(random), x(random), turn(random));
        const auto shadow = typography::hidden_by_prop(prop, pose, lens);
        ASSERT_TRUE(shadow);
        for (int n = 0; n < 20; ++n) {
            const glm::dvec2 p = glm::dvec2(pose.translation) + 0.6 * glm::dvec2(x(random), x(random));
            const double clear = typography::clearance(std::span(&p, 1), shadow->corners());
            // Between the two lies the shadow's border.
            if (lands_on_prop(prop, pose, lens, p, -1e-9)) {
                EXPECT_EQ(clear, 0.0);
                ++hidden;
            } else if (!lands_on_prop(prop, pose, lens, p, 1e-9)) {
                EXPECT_GT(clear, 0.0);
                ++free;
            }
        }
    }
    EXPECT_GT(hidden, 700); // the base alone covers a fifth of the places
    EXPECT_GT(free, 1000);
    EXPECT_GE(hidden + free, 3999);
}

TEST(Captions, NeverOverlapAJumpingProp) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> x(-0.32, 0.32);
    std::uniform_real_distribution<double> y(-0.17, 0.17);
    std::uniform_real_distribution<double> turn(-3.2, 3.2);
    std::uniform_int_distribution<int> pause(1, 900);
    Table table(shipped_table);
    const std::array<glm::dvec2, 2> sizes{glm::dvec2(0.30, 0.05), glm::dvec2(0.12, 0.11)};
    table.placer.set_shapes(sizes);
    MonotonicTime now{};
    int shown = 0;
    for (int k = 0; k < 3000; ++k) {
        now += milliseconds(pause(random));
        const geometry::RigidTransform pose = standing(x(random), y(random), turn(random));
        const typography::CaptionPlace place = table.step(now, pose);
        if (place.opacity <= 0.0) {
            continue;
        }
        ++shown;
        for (int n = 0; n < 25; ++n) {
            const glm::dvec2 part((n % 5) / 4.0 - 0.5, (n / 5) / 4.0 - 0.5);
            EXPECT_FALSE(lands_on_prop(table.prop, pose, lens,
                                       place.rectangle.centre_m + part * place.rectangle.size_m));
        }
        for (const glm::dvec2& corner : place.rectangle.corners()) {
            EXPECT_LE(std::abs(corner.x), 0.4);
            EXPECT_LE(std::abs(corner.y), 0.25);
        }
    }
    EXPECT_GT(shown, 300);
}

TEST(Captions, VisibleForARestingPropOnBothSetUps) {
    for (const auto& [picture_m, height] : {std::pair{shipped_table, 1.2}, std::pair{near_table, 0.9}}) {
        Table table(picture_m);
        table.lens_m.z = height;
        const std::array<glm::dvec2, 2> sizes{glm::dvec2(0.30, 0.05), glm::dvec2(0.07, 0.15)};
        table.placer.set_shapes(sizes);
        (void)table.step(MonotonicTime{}, standing(0.0, 0.0, 0.3));
        const typography::CaptionPlace place =
            table.step(MonotonicTime{} + milliseconds(500), standing(0.0, 0.0, 0.3));
        EXPECT_EQ(place.opacity, 1.0) << height;
        if (height > 1.0) {
            EXPECT_LT(place.rectangle.centre_m.y, -0.1);
            EXPECT_NEAR(place.rectangle.centre_m.x, 0.0, 0.011);
        }
    }
}

TEST(Captions, StayInPlaceWhileThePropMovesElsewhere) {
    Table table(shipped_table);
    const std::array<glm::dvec2, 1> sizes{glm::dvec2(0.20, 0.05)};
    table.placer.set_shapes(sizes);
    (void)table.step(MonotonicTime{}, standing(0.0, 0.05, 0.0));
    const glm::dvec2 centre = table.placer.at(MonotonicTime{}).rectangle.centre_m;
    for (int k = 1; k < 600; ++k) {
        const double phase = 0.01 * k;
        const typography::CaptionPlace place =
            table.step(MonotonicTime{} + milliseconds(16 * k),
                       standing(0.1 * std::sin(phase), 0.08 + 0.03 * std::cos(phase), phase));
        EXPECT_EQ(place.rectangle.centre_m, centre);
    }
}

TEST(Captions, FadeToAnotherPlaceWhenThePropMovesOverThem) {
    Table table(shipped_table);
    const std::array<glm::dvec2, 1> sizes{glm::dvec2(0.20, 0.05)};
    table.placer.set_shapes(sizes);
    MonotonicTime now{};
    double before = 0.0;
    double largest_step = 0.0;
    glm::dvec2 first(0.0);
    for (int k = 0; k < 300; ++k) {
        now += milliseconds(16);
        // From the far side over the caption at 0.1 m/s.
        const double y = std::max(-0.14, 0.10 - 0.0016 * std::max(0, k - 60));
        const typography::CaptionPlace place = table.step(now, standing(0.0, y, 0.0));
        largest_step = std::max(largest_step, std::abs(place.opacity - before));
        before = place.opacity;
        if (k == 50) {
            first = place.rectangle.centre_m;
        }
    }
    EXPECT_EQ(before, 1.0);
    EXPECT_GT(glm::distance(first, table.placer.at(now).rectangle.centre_m), 0.05);
    EXPECT_LT(largest_step, 0.35); // eased, not switched
}

TEST(Captions, HiddenWithoutRoomAndNoShadowUnderALowLens) {
    Table table(near_table);
    const std::array<glm::dvec2, 1> sizes{glm::dvec2(0.5, 0.05)};
    table.placer.set_shapes(sizes);
    EXPECT_EQ(table.step(MonotonicTime{} + milliseconds(900), standing(0, 0, 0)).opacity, 0.0);
    EXPECT_FALSE(typography::hidden_by_prop(table.prop, standing(0, 0, 0), {0.0, 0.0, 0.1}));
}

TEST(Captions, ClearanceEqualsTheGapBetweenRectangles) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> x(-1.0, 1.0);
    for (int k = 0; k < 300; ++k) {
        const typography::TableRectangle a{{x(random), x(random)},
                                           {0.1 + std::abs(x(random)), 0.1 + std::abs(x(random))}};
        const typography::TableRectangle b{{x(random), x(random)},
                                           {0.1 + std::abs(x(random)), 0.1 + std::abs(x(random))}};
        const glm::dvec2 gap =
            glm::max(glm::abs(a.centre_m - b.centre_m) - (a.size_m + b.size_m) / 2.0, glm::dvec2(0.0));
        EXPECT_NEAR(typography::clearance(a.corners(), b.corners()), glm::length(gap), 1e-12);
    }
}

TEST(Captions, TypeIsNeverSmallerThanTwentyFourPoint) {
    const Result<typography::Typesetter> typesetter = typography::Typesetter::open();
    ASSERT_TRUE(typesetter) << typesetter.error().message;
    constexpr double texels_per_m = 8000.0;
    // A capital of DejaVu Sans is 0.729 em high; 'H' has neither overshoot nor descender.
    const typography::CaptionImage caption = typography::make_caption(
        *typesetter, std::array{typography::PlainPart{typography::CaptionRole::Text, "HHH"}}, 0.002, 0.2,
        texels_per_m);
    int rows = 0;
    for (int y = 0; y < caption.coverage.height; ++y) {
        bool ink = false;
        for (int x = 0; x < caption.coverage.width; ++x) {
            ink = ink || caption.coverage.at(x, y) > 128;
        }
        rows += ink ? 1 : 0;
    }
    EXPECT_NEAR(rows / texels_per_m, 0.729 * 0.0254 / 3.0, 2.0 / texels_per_m);
    EXPECT_NEAR(caption.size_m.y * texels_per_m, caption.coverage.height, 1e-9);
}

TEST(Captions, FitTheWidthAndGrowTallerWhenNarrow) {
    const Result<typography::Typesetter> typesetter = typography::Typesetter::open();
    ASSERT_TRUE(typesetter);
    const std::string text =
        "Wine was carried and poured from vessels like this one in every house of the town";
    const std::array parts{typography::PlainPart{typography::CaptionRole::Title, "Amphora"},
                           typography::PlainPart{typography::CaptionRole::Text, text}};
    const typography::CaptionImage wide = typography::make_caption(*typesetter, parts, 0.010, 0.30, 2000.0);
    const typography::CaptionImage narrow = typography::make_caption(*typesetter, parts, 0.010, 0.12, 2000.0);
    EXPECT_LE(wide.size_m.x, 0.302);
    EXPECT_LE(narrow.size_m.x, 0.122);
    EXPECT_GT(narrow.size_m.y, 1.5 * wide.size_m.y);
}

TEST(HiddenByProp, ContainsTheShadowOfEachCornerOfAGem) {
    geometry::PropShape gem;
    for (int k = 0; k < 28; ++k) { // two rings, the upper one narrower
        const double angle = 2.0 * std::numbers::pi * k / 14.0;
        const double radius_m = k < 14 ? 0.08 : 0.05;
        gem.corners.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle), k < 14 ? 0.0 : 0.09);
    }
    const glm::dvec3 lens(0.3, -0.1, 1.2);
    const geometry::RigidTransform pose{glm::angleAxis(0.3, glm::dvec3(0.0, 0.0, 1.0)), {0.05, 0.02, 0.0}};
    const auto shadow = typography::hidden_by_prop(gem, pose, lens);
    ASSERT_TRUE(shadow);
    const auto corners = shadow->corners();
    EXPECT_GT(corners.size(), 12U);
    for (const glm::dvec3& in_prop : gem.corners) {
        const glm::dvec3 corner = pose.point(in_prop);
        const glm::dvec2 lit = glm::dvec2(lens) + lens.z / (lens.z - corner.z) * glm::dvec2(corner - lens);
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const glm::dvec2 along = corners[(k + 1) % corners.size()] - corners[k];
            const glm::dvec2 to = lit - corners[k];
            EXPECT_GE(along.x * to.y - along.y * to.x, -1e-12);
        }
    }
}

} // namespace
} // namespace frustumscreen::exhibit
