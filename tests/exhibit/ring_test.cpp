// The ring beside the prop's shadow: its place, its direction of filling, and its filled share.

#include "app/typography/ring.h"
#include "app/typography/visitor_side.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace frustumscreen::exhibit {
namespace {

const std::vector<glm::dvec2> wide{{-9.0, -9.0}, {9.0, -9.0}, {9.0, 9.0}, {-9.0, 9.0}};

/// A polygon around some points on a circle that is slightly off the middle.
typography::TablePolygon some_shadow(std::mt19937& random) {
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    const glm::dvec2 middle(0.2 * u(random), 0.1 * u(random));
    typography::TablePolygon shadow;
    const std::size_t corners = 4 + random() % 9;
    for (std::size_t k = 0; k < corners; ++k) {
        const double angle =
            6.283185307179586 * (static_cast<double>(k) + 0.3 * u(random)) / static_cast<double>(corners);
        shadow.points[shadow.count++] = middle + 0.15 * glm::dvec2(std::cos(angle), std::sin(angle));
    }
    return shadow;
}

/// The length of the piece's inner edge along its middle; straight, so that corners do not count twice.
double length_of(const typography::RingPiece& piece) {
    return glm::distance(piece.corners_m[2], piece.corners_m[3]);
}

double filled_share(const typography::Ring& ring) {
    double filled = 0.0;
    double all = 0.0;
    for (const typography::RingPiece& piece : ring.pieces()) {
        filled += piece.filled ? length_of(piece) : 0.0;
        all += length_of(piece);
    }
    return filled / all;
}

TEST(Ring, FillsTheGivenShareAroundAnyShadow) {
    std::mt19937 random(4);
    for (int k = 0; k < 500; ++k) {
        const typography::TablePolygon shadow = some_shadow(random);
        const double full = std::uniform_real_distribution<double>(0.0, 1.0)(random);
        const typography::Ring ring =
            typography::ring_around(shadow, full, static_cast<int>(random() % 4), wide);
        ASSERT_GE(ring.count, shadow.count);
        EXPECT_NEAR(filled_share(ring), full, 0.03);
        for (const typography::RingPiece& piece : ring.pieces()) {
            EXPECT_GE(typography::clearance(piece.corners_m, shadow.corners()),
                      typography::ring_gap_m - 1e-9);
            for (const glm::dvec2& corner : piece.corners_m) {
                const double off = typography::clearance(std::span(&corner, 1), shadow.corners());
                EXPECT_LE(off, 4.0 * (typography::ring_gap_m + typography::ring_width_m) + 1e-9);
            }
        }
        for (std::size_t piece = 0; piece + 1 < ring.count; ++piece) { // pieces are joined
            EXPECT_EQ(ring.all[piece].corners_m[1], ring.all[piece + 1].corners_m[0]);
            EXPECT_TRUE(ring.all[piece].filled || !ring.all[piece + 1].filled);
        }
        EXPECT_EQ(ring.all[ring.count - 1].corners_m[1], ring.all[0].corners_m[0]);
    }
}

TEST(Ring, FillsClockwiseFromTheFarSideForEveryReader) {
    typography::TablePolygon square;
    square.points = {glm::dvec2(-0.1, -0.1), glm::dvec2(0.1, -0.1), glm::dvec2(0.1, 0.1),
                     glm::dvec2(-0.1, 0.1)};
    square.count = 4;
    for (int side = 0; side < 4; ++side) {
        const typography::Ring ring = typography::ring_around(square, 0.25, side, wide);
        glm::dvec2 middle(0.0);
        for (const typography::RingPiece& piece : ring.pieces()) {
            middle +=
                piece.filled ? (piece.corners_m[2] + piece.corners_m[3]) * length_of(piece) : glm::dvec2(0.0);
        }
        const glm::dvec2 seen =
            typography::turned(middle, -side); // at the front the far side is +Y, and clockwise goes to +X
        EXPECT_GT(seen.x, 0.0);
        EXPECT_GT(seen.y, 0.0);
        EXPECT_NEAR(seen.x, seen.y, 1e-9); // from the middle of one side to the middle of the next
    }
}

TEST(Ring, FillsOnlyThePartInThePicture) {
    typography::TablePolygon square;
    square.points = {glm::dvec2(0.2, -0.1), glm::dvec2(0.4, -0.1), glm::dvec2(0.4, 0.1),
                     glm::dvec2(0.2, 0.1)};
    square.count = 4;
    const std::vector<glm::dvec2> room{{-0.3, -0.3}, {0.3, -0.3}, {0.3, 0.3}, {-0.3, 0.3}};
    const typography::Ring half = typography::ring_around(square, 0.5, 0, room);
    EXPECT_NEAR(filled_share(half), 0.5, 0.03);
    for (const typography::RingPiece& piece : half.pieces()) {
        EXPECT_LE((piece.corners_m[2].x + piece.corners_m[3].x) / 2.0, 0.3 + 1e-9);
    }
    EXPECT_EQ(typography::ring_around(square, 0.5, 0,
                                      std::vector<glm::dvec2>{{-0.3, -0.3}, {0.0, -0.3}, {0.0, 0.3}})
                  .count,
              0U);
    EXPECT_EQ(typography::ring_around({}, 0.5, 0, wide).count, 0U);
}

} // namespace
} // namespace frustumscreen::exhibit
