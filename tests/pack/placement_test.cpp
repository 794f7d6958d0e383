#include "app/geometry/convex_hull.h"
#include "app/pack/pack_hull.h"
#include "tests/pack/samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace frustumscreen;
using namespace frustumscreen::pack;

namespace {

/// Box-frame points of a cloud that just reaches the sides of its box.
struct Cloud {
    std::vector<glm::dvec3> points;
    glm::dvec3 size{1.0};
};

Cloud random_cloud(std::mt19937& random) {
    std::uniform_real_distribution<double> u(0.0, 1.0);
    Cloud cloud;
    for (int k = 0; k < 200; ++k) {
        cloud.points.push_back({u(random) * u(random), u(random), u(random) * (1.0 - u(random))});
    }
    glm::dvec3 low(1e9);
    glm::dvec3 high(-1e9);
    for (const glm::dvec3& p : cloud.points) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::dvec3 extent = high - low;
    const double longest = std::max({extent.x, extent.y, extent.z});
    for (glm::dvec3& p : cloud.points) {
        p = (p - glm::dvec3((low.x + high.x) / 2.0, (low.y + high.y) / 2.0, low.z)) / longest;
    }
    cloud.size = extent / longest;
    return cloud;
}

/// How far a point is outside the prop, by similar triangles, without the planes of its shape.
double outside_by(const geometry::FrustumSize& prop, const glm::dvec3& p) {
    const double half = (prop.base_m + (prop.top_m - prop.base_m) * p.z / prop.height_m) / 2.0;
    return std::max({std::abs(p.x) - half, std::abs(p.y) - half, p.z - prop.height_m, -p.z});
}

} // namespace

TEST(Placement, keeps_every_vertex_inside_and_touches_a_side) {
    std::mt19937 random(11);
    for (int k = 0; k < 300; ++k) {
        const Cloud cloud = random_cloud(random);
        Pack pack;
        pack.extremes = cloud.points;
        pack.box_size = cloud.size;
        const glm::dvec3 offset(random() % 100, random() % 100, random() % 100);
        pack.box_from_file = glm::translate(glm::scale(glm::dmat4(1.0), glm::dvec3(0.5)), -offset);
        const geometry::FrustumSize prop =
            k % 2 == 0 ? geometry::FrustumSize{} : geometry::FrustumSize{0.1, 0.1, 0.1};
        const Placement placement =
            place(pack, k % 2 == 0 ? geometry::make_frustum(prop) : geometry::make_cube(prop.base_m));
        double most = -1.0;
        for (const glm::dvec3& box_point : cloud.points) {
            const glm::dvec3 file_point = box_point * 2.0 + offset;
            const glm::dvec3 p(placement.prop_from_artifact * glm::dvec4(file_point, 1.0));
            // The bottom is touched by construction; the test is about the other sides.
            EXPECT_GE(p.z, -1e-12);
            most = std::max(most, outside_by(prop, p + glm::dvec3(0.0, 0.0, 1e-15)));
        }
        EXPECT_LE(most, 1e-12);
        const Placement larger{placement.metres_per_box * 1.0001, {}};
        const bool leaves = std::any_of(cloud.points.begin(), cloud.points.end(), [&](const glm::dvec3& p) {
            return outside_by(prop, p * larger.metres_per_box) > 1e-9;
        });
        EXPECT_TRUE(leaves) << "a larger scale would have fitted";
    }
}

TEST(Placement, matches_a_hand_computed_cube) {
    // A unit cube in a frustum of base 16, top 9, height 12 cm: side s at height s, s = 16 - 7 s / 12 cm.
    Pack pack;
    pack.extremes.clear();
    for (const double x : {-0.5, 0.5}) {
        for (const double y : {-0.5, 0.5}) {
            pack.extremes.insert(pack.extremes.end(), {{x, y, 0.0}, {x, y, 1.0}});
        }
    }
    const Placement placement = place(pack, geometry::make_frustum({}));
    const double side_m = 0.16 * 12.0 / 19.0;
    EXPECT_NEAR(placement.metres_per_box, side_m, 1e-15);
    EXPECT_NEAR(placement.prop_from_artifact[1][1], side_m, 1e-15);
}

TEST(Placement, rotates_translates_and_scales_in_that_order) {
    Pack pack = samples::pack();
    // The file's +Y up at scale 1/2 about (1, 2, 3): file (x, y, z) -> box ((x-1)/2, -(z-3)/2, (y-2)/2).
    pack.box_from_file = glm::dmat4(glm::dvec4(0.5, 0, 0, 0), glm::dvec4(0, 0, 0.5, 0),
                                    glm::dvec4(0, -0.5, 0, 0), glm::dvec4(-0.5, 1.5, -1.0, 1));
    const Placement placement = place(pack, geometry::make_frustum({}));
    const double s = placement.metres_per_box;
    const glm::dvec4 p = placement.prop_from_artifact * glm::dvec4(5.0, 6.0, 7.0, 1.0);
    EXPECT_NEAR(p.x, s * 2.0, 1e-15);
    EXPECT_NEAR(p.y, s * -2.0, 1e-15);
    EXPECT_NEAR(p.z, s * 2.0, 1e-15);
    EXPECT_EQ(p.w, 1.0);
}

TEST(Placement, ignores_rounding_below_the_bottom) {
    Pack pack = samples::pack();
    const double whole = place(pack, geometry::make_frustum({})).metres_per_box;
    pack.extremes[0].z = -1e-12;
    EXPECT_NEAR(place(pack, geometry::make_frustum({})).metres_per_box, whole, 1e-12);
}

TEST(Placement, a_scale_is_a_factor_on_the_largest_size) {
    Pack pack = samples::pack();
    const geometry::PropShape prop = geometry::make_frustum({});
    const double largest = place(pack, prop).metres_per_box;
    for (const double scale : {0.05, 0.5, 1.25, 20.0}) {
        pack.scale = scale;
        EXPECT_DOUBLE_EQ(place(pack, prop).metres_per_box, scale * largest);
        const Result<VerifiedPack> read = verify_pack(samples::bytes_of(pack));
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ((*read)->scale, scale);
    }
}

TEST(Placement, a_pack_without_a_scale_is_at_the_largest_size) {
    const Bytes written = samples::bytes_of(samples::pack());
    EXPECT_FALSE(samples::take_apart(written).manifest["placement"].contains("scale"));
    const Result<VerifiedPack> read = verify_pack(written);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ((*read)->scale, 1.0);
}

/// Planes that are slanted in both x and y touch places that the extremes leave out.
TEST(Placement, keeps_every_vertex_inside_a_hexagonal_prism) {
    constexpr double flat_m = 0.060; // from the axis to a side
    constexpr double height_m = 0.130;
    geometry::PropShape prism;
    for (int k = 0; k < 6; ++k) {
        const double angle = (2.0 * k + 1.0) * std::numbers::pi / 6.0;
        prism.bounds.push_back({{std::cos(angle), std::sin(angle), 0.0}, flat_m});
    }
    prism.bounds.push_back({{0.0, 0.0, 1.0}, height_m});
    prism.bounds.push_back({{0.0, 0.0, -1.0}, 0.0});
    std::mt19937 random(12);
    for (int k = 0; k < 100; ++k) {
        const Cloud cloud = random_cloud(random);
        Pack pack;
        pack.extremes = cloud.points;
        pack.box_size = cloud.size;
        Pack older = pack; // without a hull its box counts
        put_hull(geometry::enclosing_corners(cloud.points, max_hull_corners), pack);
        const double scale = place(pack, prism).metres_per_box;
        double most = 0.0; // share of the way to the nearest side
        for (const glm::dvec3& point : cloud.points) {
            const glm::dvec3 p = scale * point;
            const double beside =
                std::sqrt(0.75) * std::abs(p.x) + 0.5 * std::abs(p.y); // the four slanted sides
            most = std::max({most, beside / flat_m, std::abs(p.y) / flat_m, p.z / height_m});
        }
        EXPECT_LE(most, 1.0 + 1e-9);
        EXPECT_GE(most, 0.999);
        EXPECT_LE(place(older, prism).metres_per_box, scale * (1.0 + 1e-9));
    }
}
