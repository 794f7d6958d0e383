// The museum's light at a ray's hit, against a sum over far more directions and boxes intersected
// analytically.

#include "app/bench/truth/lit_source.h"
#include "app/bench/truth/truth.h"
#include "tests/bake/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace frustumscreen::bench {
namespace {

struct SimpleBox {
    glm::dvec3 low, high;

    [[nodiscard]] bool is_met(const glm::dvec3& from, const glm::dvec3& direction) const {
        double enter = 0.0;
        double leave = 1.5; // anything farther away casts no shadow
        for (int axis = 0; axis < 3; ++axis) {
            const double a = (low[axis] - from[axis]) / direction[axis];
            const double b = (high[axis] - from[axis]) / direction[axis];
            enter = std::fmax(enter, std::fmin(a, b));
            leave = std::fmin(leave, std::fmax(a, b));
        }
        return enter < leave;
    }
};

/// At a place that faces up, next to the box: 90,000 directions, each with the definition of the museum's
/// light.
double light_of_dome(const glm::dvec3& place, const SimpleBox& box) {
    const glm::dvec3 key = glm::normalize(glm::dvec3(-0.45, -0.60, 0.80));
    constexpr int side = 300;
    double sum = 0.0;
    for (int k = 0; k < side * side; ++k) {
        const double radius = std::sqrt((k % side + 0.5) / side);
        const double angle = 2.0 * std::numbers::pi * (k / side + 0.5) / side;
        const glm::dvec3 direction(radius * std::cos(angle), radius * std::sin(angle),
                                   std::sqrt(1.0 - radius * radius));
        const double towards_key = std::fmax(glm::dot(direction, key), 0.0);
        sum += box.is_met(place, direction) ? 0.12
                                            : 0.42 + 0.30 * direction.z + 1.1 * std::pow(towards_key, 4.0);
    }
    return sum / (side * side);
}

const SimpleBox box{{0.1, -0.4, 0.0}, {0.2, 0.4, 0.5}};

/// A floor and the box on it, as one mesh; the box's frame is the file's.
std::shared_ptr<bake::SourceMesh> floor_and_box() {
    auto mesh = std::make_shared<bake::SourceMesh>(test::empty_mesh());
    mesh->positions = {{-0.5, -0.5, 0.0}, {0.5, -0.5, 0.0}, {0.5, 0.5, 0.0}, {-0.5, 0.5, 0.0}};
    test::add_triangle(*mesh, 0, 1, 2);
    test::add_triangle(*mesh, 0, 2, 3);
    test::add_box(*mesh, box.low, box.high);
    mesh->materials[0].base_colour = {0.5F, 0.25F, 0.125F, 1.0F};
    return mesh;
}

/// Barycentric weights at a place in the floor's first triangle, (-.5, -.5), (.5, -.5), (.5, .5).
glm::dvec2 weights_at(double x, double y) {
    return {x - y, y + 0.5};
}

TEST(LitSource, IsTheLightThatFallsOnThePlaceItself) {
    const auto mesh = floor_and_box();
    const LitSource lit(mesh, glm::dmat4(1.0));
    const glm::dvec3 down(0.0, 0.0, -1.0);
    double darkest = 1.0;
    double brightest = 0.0;
    for (const double x : {-0.2, 0.0, 0.05, 0.08, 0.25, 0.45}) {
        const double y = -0.25;
        const glm::dvec2 w = weights_at(x, y);
        const double light = static_cast<double>(lit.light(lit.place(0, w.x, w.y, down)));
        const double exact = light_of_dome({x, y, 1.5e-3}, box);
        EXPECT_NEAR(light, exact, 0.03) << x;
        darkest = std::fmin(darkest, exact);
        brightest = std::fmax(brightest, exact);
    }
    EXPECT_GT(brightest, 1.15 * darkest) << "the box shadows some of these places";
}

TEST(LitSource, UsesTheSideHitByTheRay) {
    const auto mesh = floor_and_box();
    const LitSource lit(mesh, glm::dmat4(1.0));
    const glm::dvec2 w = weights_at(-0.3, -0.45);
    EXPECT_GT(lit.light(lit.place(0, w.x, w.y, {0.3, 0.0, -1.0})), 0.5F);
    EXPECT_NEAR(lit.light(lit.place(0, w.x, w.y, {0.3, 0.0, 1.0})), 0.10F, 1e-6F); // the dark table
}

TEST(LitSource, TheTruthsSixteenRaysAreLitByIt) {
    const auto mesh = floor_and_box();
    Truth truth = Truth::build(mesh, glm::scale(glm::dmat4(1.0), glm::dvec3(0.1))).value();
    truth.light_by(std::make_shared<const LitSource>(mesh, glm::dmat4(1.0)));
    TruthView view;
    view.projector = {64, 48, 220.0, 220.0, 32.0, 24.0};
    view.prop_from_projector = {glm::dquat(0.0, 1.0, 0.0, 0.0), {0.0, 0.0, 0.9}};
    view.eye_m = {-0.1, -0.3, 0.6};
    const TruthPicture picture = truth.cast(geometry::make_frustum({}), view, true);
    int compared = 0;
    for (std::size_t k = 0; k < picture.hit.texels.size(); ++k) {
        if (picture.hit.texels[k] == 0 || picture.point_m.texels[k].z > 1e-6F) {
            continue; // not on the floor
        }
        const glm::dvec3 place = glm::dvec3(picture.point_m.texels[k]) / 0.1;
        const double light = light_of_dome({place.x, place.y, 1.5e-3}, box);
        const glm::u8vec4& colour = picture.colour.texels[k];
        EXPECT_NEAR(static_cast<double>(image::linear_from_srgb8()[colour.r]), 0.5 * light, 0.5 * 0.04);
        EXPECT_NEAR(static_cast<double>(image::linear_from_srgb8()[colour.g]), 0.25 * light, 0.25 * 0.04);
        ++compared;
    }
    EXPECT_GT(compared, 50);
    const TruthPicture shape = truth.cast(geometry::make_frustum({}), view, false);
    EXPECT_EQ(shape.hit.texels, picture.hit.texels);
}

} // namespace
} // namespace frustumscreen::bench
