// Peers that draw something other than the rasterized source mesh: a ray cast, simplified meshes; and the
// selection of peers by option.

#include "app/bench/techniques/level_of_detail.h"
#include "app/bench/techniques/peer_choice.h"
#include "app/bench/techniques/peers.h"
#include "app/bench/techniques/ray_cast.h"
#include "tests/bench/drawn_near.h"
#include "tests/bench/ring.h"

#include <gtest/gtest.h>

namespace frustumscreen::bench {
namespace {

/// Greatest distance between chord and arc, around both of the torus's circles.
constexpr double facets_m = (ring_major_m + ring_minor_m) * (1.0 - 0.99946) + ring_minor_m * (1.0 - 0.9951);

double distance_from_ring(const glm::dvec3& point) {
    const double across = std::hypot(point.x, point.z - ring_middle_m) - ring_major_m;
    return std::abs(std::hypot(across, point.y) - ring_minor_m);
}

class PeerMeshes : public DrawnNear {
protected:
    std::shared_ptr<bake::SourceMesh> mesh_ = ring();
    std::vector<BenchPose> poses_ = draw_poses(kiosk_.settings, kiosk_.prop, 5, 11).value();
};

TEST_F(PeerMeshes, RayCastMatchesTheTruthToRounding) {
    for (const bool masked : {false, true}) {
        if (masked) { // every other stripe is cut out
            auto image = std::make_shared<image::Image8>(*mesh_->textures[0].image);
            for (int k = 0; k < 256 * 256; ++k) {
                image->texels[static_cast<std::size_t>(k)].a = k / 256 % 64 < 32 ? 255 : 0;
            }
            mesh_->textures[0].image = image;
            mesh_->materials[0].alpha_mask = true;
        }
        const auto truth = Truth::build(mesh_, glm::dmat4(1.0));
        ASSERT_TRUE(truth);
        const auto cast = make_ray_cast(kiosk_, truth->traced());
        ASSERT_TRUE(cast) << cast.error().message;
        for (const BenchPose& pose : poses_) {
            const TruthPicture picture = truth->cast(kiosk_.prop, view_of(kiosk_.settings, pose), false);
            (*cast)->draw(pose);
            const image::Image8 colour = render::read_colour(kiosk_.framebuffer, 640, 400);
            const auto points = (*cast)->hit_points(pose);
            ASSERT_TRUE(points);
            int hits = 0;
            int others = 0;
            for (std::size_t k = 0; k < picture.hit.texels.size(); ++k) {
                const bool hit = !std::isnan(points->texels[k].x);
                hits += hit ? 1 : 0;
                const float off_m = glm::distance(points->texels[k], picture.point_m.texels[k]);
                const glm::ivec3 off =
                    glm::abs(glm::ivec3(colour.texels[k]) - glm::ivec3(picture.colour.texels[k]));
                const bool same = hit == (picture.hit.texels[k] != 0) && (!hit || off_m < 2e-6F) &&
                                  std::max({off.r, off.g, off.b}) <= 1;
                others += same ? 0 : 1;
            }
            EXPECT_GT(hits, 300);
            EXPECT_LE(others, hits / 500) << "rays that graze an edge or a cut";
        }
    }
}

TEST_F(PeerMeshes, ASimplifiedMeshLiesWithinTheSimplifiersError) {
    const std::array<std::size_t, 3> targets = {500, 2000, 100'000};
    const std::vector<LevelOfDetail> levels = levels_of_detail(*mesh_, targets);
    ASSERT_EQ(levels.size(), 2U); // the source has 6144
    for (const LevelOfDetail& level : levels) {
        EXPECT_LE(level.mesh.triangles.size(), level.target);
        EXPECT_GT(level.mesh.triangles.size(), level.target / 2);
        const auto peer = PeerMesh::upload(level.mesh, glm::dmat4(1.0));
        ASSERT_TRUE(peer);
        const auto drawn = make_full_mesh(kiosk_, *peer, nullptr, "LOD");
        ASSERT_TRUE(drawn);
        EXPECT_EQ((*drawn)->name(), "LOD");
        for (const BenchPose& pose : poses_) {
            const auto points = (*drawn)->hit_points(pose);
            ASSERT_TRUE(points);
            int hits = 0;
            double squares = 0.0;
            double farthest_m = 0.0;
            for (const glm::vec3& point : points->texels) {
                if (!std::isnan(point.x)) {
                    const double off_m = distance_from_ring(point);
                    ++hits;
                    squares += off_m * off_m;
                    farthest_m = std::max(farthest_m, off_m);
                }
            }
            EXPECT_GT(hits, 300);
            EXPECT_GT(farthest_m, 0.0);
            // A quadric is a mean of squares: single points may be somewhat farther off.
            EXPECT_LE(std::sqrt(squares / hits), level.error + facets_m) << level.target;
            EXPECT_LE(farthest_m, 2.0 * level.error + facets_m) << level.target;
        }
    }
    EXPECT_LT(levels[1].error, levels[0].error);
}

TEST_F(PeerMeshes, SimplifyingKeepsSeamsAndMaterials) {
    mesh_->materials.push_back(mesh_->materials[0]);
    for (std::size_t t = 0; t < mesh_->triangles.size(); ++t) {
        mesh_->triangle_materials[t] = mesh_->positions[mesh_->triangles[t][0]].x > 0.0 ? 1 : 0;
    }
    const std::array<std::size_t, 1> targets = {1500};
    const std::vector<LevelOfDetail> levels = levels_of_detail(*mesh_, targets);
    ASSERT_EQ(levels.size(), 1U);
    const bake::SourceMesh& level = levels[0].mesh;
    for (std::size_t t = 0; t < level.triangles.size(); ++t) {
        for (const std::uint32_t corner : level.triangles[t]) {
            const double x = level.positions[corner].x;
            EXPECT_TRUE(level.triangle_materials[t] == 1 ? x > -0.004 : x < 0.004); // within a quad's width
        }
        // No triangle spans the texture: around the seam, u goes from 31/32 to 1, never from 31/32 to 0.
        const auto u = [&](std::size_t k) { return level.uvs[level.triangles[t][k]].x; };
        const auto [low, high] = std::minmax({u(0), u(1), u(2)});
        EXPECT_LT(high - low, 0.5F);
    }
}

TEST_F(PeerMeshes, CullingKeepsEverythingVisible) {
    for (const bool closed : {true, false}) {
        if (!closed) { // with triangles missing, the inside is visible
            mesh_->triangles.resize(mesh_->triangles.size() / 2);
            mesh_->triangle_materials.resize(mesh_->triangles.size());
        }
        const auto truth = Truth::build(mesh_, glm::dmat4(1.0));
        const auto peer = PeerMesh::upload(*mesh_, glm::dmat4(1.0));
        ASSERT_TRUE(peer && truth);
        const auto drawn = make_full_mesh(kiosk_, *peer);
        ASSERT_TRUE(drawn);
        for (const BenchPose& pose : poses_) {
            const TruthPicture picture = truth->cast(kiosk_.prop, view_of(kiosk_.settings, pose), false);
            const auto points = (*drawn)->hit_points(pose);
            ASSERT_TRUE(points);
            const PictureError error = measure(picture, {picture.colour, *points});
            EXPECT_LT(error.outline_shift_px, 0.02);
            EXPECT_LT(error.geometric_p95_mm, 0.002); // steps of 16 bits per coordinate are 0.0012 mm
        }
    }
}

TEST(PeerChoice, ParsesAllNoneOrAList) {
    const auto all = parse_peers("all");
    ASSERT_TRUE(all);
    EXPECT_TRUE(all->mesh && all->two_pass && all->ray_cast && all->lod && all->two_pass_lod);
    const auto none = parse_peers("none");
    ASSERT_TRUE(none);
    EXPECT_FALSE(none->mesh || none->two_pass || none->ray_cast || none->lod || none->two_pass_lod);
    const auto some = parse_peers("lod,two-pass-lod");
    ASSERT_TRUE(some);
    EXPECT_TRUE(some->lod && some->two_pass_lod);
    EXPECT_FALSE(some->mesh || some->two_pass || some->ray_cast);
    EXPECT_TRUE(parse_peers("ray-cast")->ray_cast);
}

TEST(PeerChoice, RejectsAnUnknownNameInOneLineWithTheAllowedOnes) {
    for (const char* words :
         {"", "lods", "mesh,", ",mesh", "mesh,,lod", "mesh, lod", "none,mesh", "all,mesh"}) {
        const auto choice = parse_peers(words);
        ASSERT_FALSE(choice) << words;
        EXPECT_NE(choice.error().message.find("two-pass-lod"), std::string::npos);
        EXPECT_EQ(choice.error().message.find('\n'), std::string::npos);
    }
}

} // namespace
} // namespace frustumscreen::bench
