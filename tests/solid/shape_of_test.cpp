// A solid becomes a prop's shape: which faces are lit, and what the shape's own functions say of it.
#include "app/geometry/prop_edges.h"
#include "app/solid/shape_of.h"
#include "tests/solid/bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

namespace frustumscreen::solid {
namespace {

TEST(ShapeOf, CubeEqualsTheGeometryCube) {
    const geometry::PropShape cube = geometry::make_cube(0.12);
    const geometry::PropShape shape = shape_of(read(solid::cube(120.0))->solid, Underside::Lit);
    ASSERT_EQ(shape.faces.size(), 6U);
    EXPECT_LT(glm::distance(shape.middle, cube.middle), 1e-15);
    for (const geometry::PropFace& face : cube.faces) {
        const auto same =
            std::find_if(shape.faces.begin(), shape.faces.end(), [&](const geometry::PropFace& other) {
                return glm::distance(other.plane.normal, face.plane.normal) < 1e-12;
            });
        ASSERT_NE(same, shape.faces.end()) << face.name;
        EXPECT_NEAR(same->plane.offset, face.plane.offset, 1e-15) << face.name;
        EXPECT_LT(glm::distance(same->middle(), face.middle()), 1e-15) << face.name;
        ASSERT_EQ(same->corners.size(), 4U);
        for (const glm::dvec3& corner : face.corners) {
            EXPECT_TRUE(std::any_of(same->corners.begin(), same->corners.end(), [&](const glm::dvec3& other) {
                return glm::distance(other, corner) < 1e-15;
            })) << face.name;
        }
    }
}

TEST(ShapeOf, DarkUndersideBoundsThePropWithoutBeingAFace) {
    const Solid solid = read(solid::cube(120.0))->solid;
    const geometry::PropShape lit = shape_of(solid, Underside::Lit);
    const geometry::PropShape dark = shape_of(solid, Underside::Dark);
    EXPECT_EQ(lit.bounds.size(), 6U);
    ASSERT_EQ(dark.faces.size(), 5U);
    ASSERT_EQ(dark.bounds.size(), 6U);
    for (std::size_t k = 0; k < dark.faces.size(); ++k) {
        EXPECT_EQ(dark.bounds[k].normal, dark.faces[k].plane.normal);
        EXPECT_GT(dark.faces[k].plane.normal.z, -0.5);
    }
    EXPECT_EQ(dark.bounds.back().normal, glm::dvec3(0, 0, -1));
    geometry::PropHit hit;
    EXPECT_TRUE(geometry::enter(dark, {0.0, 0.0, -1.0}, {0.0, 0.0, 1.0}, hit));
    EXPECT_FALSE(geometry::intersect(dark, {0.0, 0.0, -1.0}, {0.0, 0.0, 1.0}, hit));
    EXPECT_TRUE(geometry::intersect(lit, {0.0, 0.0, -1.0}, {0.0, 0.0, 1.0}, hit));
}

/// Prisms and pyramids on polygons: each edge of a lit face has the neighbour that shares both of its ends.
TEST(ShapeOf, EachEdgeHasTheCorrectNeighbour) {
    for (std::size_t sides = 3; sides <= 14; ++sides) {
        const Result<PropFile> file = read(prism(sides, 60.0, 100.0));
        ASSERT_TRUE(file.has_value()) << sides;
        const geometry::PropShape shape = shape_of(file->solid, Underside::Dark);
        ASSERT_EQ(shape.faces.size(), sides + 1);
        EXPECT_EQ(geometry::foot_of(shape).size(), sides);
        std::size_t dark_edges = 0;
        for (const geometry::PropFace& face : shape.faces) {
            for (std::size_t k = 0; k < face.corners.size(); ++k) {
                const geometry::PropFace* const other = geometry::neighbour_of(shape, face, k);
                dark_edges += other == nullptr ? 1U : 0U;
                if (other != nullptr) {
                    EXPECT_NEAR(other->plane.distance(face.corners[k]), 0.0, 1e-12);
                    EXPECT_NEAR(other->plane.distance(face.corners[face.corners.next(k)]), 0.0, 1e-12);
                    EXPECT_NE(other, &face);
                }
            }
        }
        EXPECT_EQ(dark_edges, sides) << "those of the underside";
    }
}

} // namespace
} // namespace frustumscreen::solid
