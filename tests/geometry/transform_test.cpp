#include "app/geometry/transform.h"
#include "tests/geometry/random_geometry.h"

#include <gtest/gtest.h>

#include <limits>

namespace frustumscreen::geometry {
namespace {

/// Rotation by the matrix of a unit quaternion, written out (Hamilton).
glm::dvec3 rotated_by_hand(const glm::dquat& q, const glm::dvec3& p) {
    const double w = q.w, x = q.x, y = q.y, z = q.z;
    return {(1 - 2 * (y * y + z * z)) * p.x + 2 * (x * y - w * z) * p.y + 2 * (x * z + w * y) * p.z,
            2 * (x * y + w * z) * p.x + (1 - 2 * (x * x + z * z)) * p.y + 2 * (y * z - w * x) * p.z,
            2 * (x * z - w * y) * p.x + 2 * (y * z + w * x) * p.y + (1 - 2 * (x * x + y * y)) * p.z};
}

TEST(Transform, MatchesIndependentArithmetic) {
    Random random(1);
    for (int k = 0; k < 2000; ++k) {
        const RigidTransform t{random.rotation(), random.vector(3.0)};
        const glm::dvec3 p = random.vector(2.0);
        const glm::dvec3 expected = rotated_by_hand(t.rotation, p) + t.translation;
        EXPECT_LT(glm::distance(t.point(p), expected), 1e-14);
        EXPECT_LT(glm::distance(glm::dvec3(t.matrix() * glm::dvec4(p, 1.0)), expected), 1e-14);
        EXPECT_LT(glm::distance(t.direction(p), expected - t.translation), 1e-14);
    }
}

TEST(Transform, AQuarterTurnAboutZTakesXToY) {
    const RigidTransform t{glm::dquat(std::sqrt(0.5), 0, 0, std::sqrt(0.5)), {0, 0, 0}};
    EXPECT_LT(glm::distance(t.point({1, 0, 0}), glm::dvec3(0, 1, 0)), 1e-15);
}

TEST(Transform, TheInverseUndoesAndProductsChain) {
    Random random(2);
    for (int k = 0; k < 2000; ++k) {
        const RigidTransform a_from_b{random.rotation(), random.vector(3.0)};
        const RigidTransform b_from_c{random.rotation(), random.vector(3.0)};
        const glm::dvec3 p = random.vector(2.0);
        EXPECT_LT(glm::distance(a_from_b.inverse().point(a_from_b.point(p)), p), 1e-14);
        EXPECT_LT(glm::distance((a_from_b * b_from_c).point(p), a_from_b.point(b_from_c.point(p))), 1e-14);
    }
}

TEST(Transform, ALongChainOfProductsStaysRigid) {
    Random random(3);
    RigidTransform chain;
    for (int k = 0; k < 100000; ++k) {
        chain = chain * RigidTransform{random.rotation(), {0, 0, 0}};
    }
    EXPECT_NEAR(glm::length(chain.rotation), 1.0, 1e-12);
}

TEST(Transform, MatrixRoundTrip) {
    Random random(4);
    for (int k = 0; k < 2000; ++k) {
        const RigidTransform t{random.rotation(), random.vector(10.0)};
        const auto back = rigid_from_matrix(t.matrix());
        ASSERT_TRUE(back);
        const glm::dvec3 p = random.vector(2.0);
        EXPECT_LT(glm::distance(back->point(p), t.point(p)), 1e-13);
    }
    // Half turns, where the scalar part vanishes.
    for (const glm::dquat& q : {glm::dquat(0, 1, 0, 0), glm::dquat(0, 0, 1, 0), glm::dquat(0, 0, 0, 1)}) {
        const auto back = rigid_from_matrix(RigidTransform{q, {1, 2, 3}}.matrix());
        ASSERT_TRUE(back);
        EXPECT_LT(glm::distance(back->point({1, 2, 3}), RigidTransform({q, {1, 2, 3}}).point({1, 2, 3})),
                  1e-14);
    }
}

TEST(Transform, AMatrixThatIsNotRigidIsRefused) {
    Random random(5);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 200; ++k) {
        const glm::dmat4 rigid = RigidTransform{random.rotation(), random.vector(10.0)}.matrix();
        for (int axis = 0; axis < 3; ++axis) {
            glm::dmat4 mirrored = rigid;
            mirrored[axis] = -mirrored[axis];
            EXPECT_FALSE(rigid_from_matrix(mirrored));
            glm::dmat4 scaled = rigid;
            scaled[axis] *= 1.0 + 1e-4;
            EXPECT_FALSE(rigid_from_matrix(scaled));
            glm::dmat4 sheared = rigid;
            sheared[axis] += 1e-3 * rigid[(axis + 1) % 3];
            EXPECT_FALSE(rigid_from_matrix(sheared));
        }
        for (int element = 0; element < 16; ++element) {
            for (const double bad : {nan, infinity, -infinity}) {
                glm::dmat4 broken = rigid;
                broken[element / 4][element % 4] = bad;
                EXPECT_FALSE(rigid_from_matrix(broken));
            }
        }
        for (int column = 0; column < 4; ++column) {
            glm::dmat4 projective = rigid;
            projective[column][3] += 1e-3;
            EXPECT_FALSE(rigid_from_matrix(projective));
        }
    }
    EXPECT_FALSE(rigid_from_matrix(glm::dmat4(0.0)));
}

TEST(Transform, RoundedNumbersInAMatrixAreStillRigid) {
    glm::dmat4 matrix = RigidTransform{glm::dquat(std::sqrt(0.5), 0, 0, std::sqrt(0.5)), {1, 2, 3}}.matrix();
    matrix[0][0] += 3e-7;
    const auto rigid = rigid_from_matrix(matrix);
    ASSERT_TRUE(rigid);
    EXPECT_NEAR(glm::length(rigid->rotation), 1.0, 1e-15);
}

TEST(Transform, AnyFiniteQuaternionButZeroIsMadeUnit) {
    Random random(6);
    for (int k = 0; k < 1000; ++k) {
        const glm::dquat q = random.rotation();
        const auto unit = normalised(q * random.scale(1e-250, 1e250));
        ASSERT_TRUE(unit);
        EXPECT_NEAR(std::abs(glm::dot(*unit, q)), 1.0, 1e-14);
        EXPECT_NEAR(glm::length(*unit), 1.0, 1e-14);
    }
    EXPECT_FALSE(normalised(glm::dquat(0, 0, 0, 0)));
    EXPECT_FALSE(normalised(glm::dquat(std::nan(""), 0, 0, 1)));
    EXPECT_FALSE(normalised(glm::dquat(1, std::numeric_limits<double>::infinity(), 0, 0)));
}

} // namespace
} // namespace frustumscreen::geometry
