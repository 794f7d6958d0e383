#include "app/bench/techniques/relief/relief_images.h"
#include "app/bench/techniques/relief/relief_peers.h"
#include "app/bench/techniques/relief/relief_technique.h"
#include "tests/bench/drawn_near.h"
#include "tests/bench/ring.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>

namespace frustumscreen::bench {
namespace {

/// Distance of (x, z) from the middle circle of the ring's tube.
double off_circle(double x, double z) {
    return std::abs(std::hypot(x, z - ring_middle_m) - ring_major_m);
}
/// Height of the tube above its middle plane there, from its equation; nullopt outside the tube.
std::optional<double> ring_height(double x, double z) {
    const double off = off_circle(x, z);
    return off > ring_minor_m ? std::nullopt
                              : std::optional(std::sqrt(ring_minor_m * ring_minor_m - off * off));
}

TEST(ReliefImages, HoldTheFirstHitOfEveryTexel) {
    const auto mesh = ring();
    const auto truth = Truth::build(mesh, glm::dmat4(1.0));
    ASSERT_TRUE(truth);
    constexpr int texels = 64;
    const ReliefImages images = rasterize_relief_images(*truth, placed_box(*mesh, glm::dmat4(1.0)),
                                                        geometry::make_frustum({}), texels);
    ASSERT_EQ(images.images.size(), 5U);
    const glm::dvec3 size = images.box.high - images.box.low;
    int hits = 0;
    for (const ReliefImage& image : images.images) {
        if (image.axis != 1) {
            continue;
        }
        for (int j = 0; j < texels; ++j) {
            for (int i = 0; i < texels; ++i) {
                const double x = images.box.low.x + size.x * (i + 0.5) / texels;
                const double z = images.box.low.z + size.z * (j + 0.5) / texels;
                if (std::abs(off_circle(x, z) - ring_minor_m) < 2e-4) {
                    continue; // the mesh is a polygon there
                }
                const std::optional<double> height = ring_height(x, z);
                ASSERT_EQ(image.depth.at(i, j) != no_depth, height.has_value()) << i << ' ' << j;
                ASSERT_EQ(image.colour.at(i, j).a != 0, height.has_value());
                if (height) {
                    const double depth_m = image.depth.at(i, j) / depth_codes * size.y;
                    EXPECT_NEAR(depth_m, images.box.high.y - *height, 3e-4);
                    ++hits;
                }
            }
        }
    }
    EXPECT_GT(hits, 1000);
    // The ring is equally thick on both sides of its middle plane; each of its texels was hit in both images.
    const image::Image<glm::u16vec2> material = material_along(images, 1);
    int solid = 0;
    for (const glm::u16vec2& texel : material.texels) {
        const bool nowhere = texel == glm::u16vec2(65535, 0);
        EXPECT_TRUE(nowhere || (texel.x <= texel.y && std::abs(texel.x + texel.y - 65535) < 400));
        solid += nowhere ? 0 : 1;
    }
    EXPECT_GE(solid, hits / 2);
}

TEST(ReliefImages, ShadowOnAFaceCoversExactlyTheRaysThatHitTheBox) {
    const geometry::PropShape prop = geometry::make_frustum({});
    const geometry::Box box{{-0.02, -0.03, 0.01}, {0.03, 0.01, 0.09}};
    std::mt19937_64 engine(3);
    std::uniform_real_distribution<double> random(0.0, 1.0);
    int met = 0;
    for (int trial = 0; trial < 20; ++trial) {
        const glm::dvec3 eye(random(engine) - 0.5, random(engine) - 0.5, 0.15 + 0.5 * random(engine));
        for (const geometry::PropFace& face : prop.faces) {
            if (face.plane.distance(eye) <= 0.01) {
                continue;
            }
            const std::vector<glm::dvec3> shadow = shadow_on_face(face, eye, box);
            for (int k = 0; k < 50; ++k) {
                const double u = random(engine);
                const double v = random(engine);
                const glm::dvec3 at = (1 - v) * ((1 - u) * face.corners[0] + u * face.corners[1]) +
                                      v * ((1 - u) * face.corners[3] + u * face.corners[2]);
                double least = 1.0; // signed distance inside the polygon
                for (std::size_t c = 0; c < shadow.size(); ++c) {
                    const glm::dvec3 edge = shadow[(c + 1) % shadow.size()] - shadow[c];
                    if (glm::length(edge) > 1e-9) {
                        least = std::fmin(least, glm::dot(glm::cross(face.plane.normal, glm::normalize(edge)),
                                                          at - shadow[c]));
                    }
                }
                const bool in_shadow = !shadow.empty() && least > 0.0;
                const glm::dvec3 a = (box.low - eye) / (at - eye);
                const glm::dvec3 b = (box.high - eye) / (at - eye);
                const glm::dvec3 near = glm::min(a, b);
                const glm::dvec3 far = glm::max(a, b);
                const bool meets =
                    std::fmax(std::fmax(near.x, near.y), near.z) < std::fmin(std::fmin(far.x, far.y), far.z);
                if (shadow.empty() || std::abs(least) > 1e-6) {
                    EXPECT_EQ(in_shadow, meets);
                }
                met += meets ? 1 : 0;
            }
        }
    }
    EXPECT_GT(met, 200);
}

class ReliefPeers : public DrawnNear {};

/// The ring is a relief from two sides, so every method can show it whole.
TEST_F(ReliefPeers, EachApproximatesTheRayCastOfARing) {
    const auto mesh = ring();
    const auto truth = Truth::build(mesh, glm::dmat4(1.0));
    ASSERT_TRUE(truth);
    auto peers = make_relief_peers(kiosk_, *truth, *mesh, glm::dmat4(1.0), 256);
    ASSERT_TRUE(peers) << peers.error().message;
    ASSERT_EQ(peers->size(), 5U);
    const auto poses = draw_poses(kiosk_.settings, kiosk_.prop, 4, 5);
    ASSERT_TRUE(poses);
    for (const BenchPose& pose : *poses) {
        const TruthPicture picture = ray_cast(*truth, pose);
        for (const ReliefPeer& peer : *peers) {
            SCOPED_TRACE(peer.technique->name());
            const PictureError error = error_of(*peer.technique, pose, picture);
            EXPECT_GT(error.truth_pixels, 300);
            EXPECT_LT(error.outline_shift_px, peer.triangles > 0 ? 2.0 : 0.25);
            EXPECT_LT(error.geometric_p95_mm, 0.3);
            EXPECT_LT(error.geometric_mean_mm, 0.3);
            EXPECT_LT(error.one_ray.rmse, 8.0);
        }
    }
}

} // namespace
} // namespace frustumscreen::bench
