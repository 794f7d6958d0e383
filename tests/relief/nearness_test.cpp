// The nearness alone, as a torch takes it, against rays that are cast onto the same relief.
#include "app/relief/rasterize_nearness.h"
#include "app/relief/relief_painter.h"
#include "assets_baked/bake/relief_scene.h"
#include "tests/relief/subject.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace frustumscreen::relief {
namespace {

constexpr int torch_px = TileMask::max_px;
constexpr double before_m = 0.01; ///< of the face before the torch

geometry::RigidTransform looking(const glm::dvec3& from, const glm::dvec3& at) {
    const glm::dvec3 z = glm::normalize(at - from);
    const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0.0, 0.0, -1.0), z));
    return {glm::quat_cast(glm::dmat3(x, glm::cross(z, x), z)), from};
}

/// A torch of 40 degrees before the ring.
struct Torch {
    Subject subject;
    BlockRelief relief = subject.relief(128);
    geometry::RigidTransform prop_from_torch;
    double focal_px = 0.5 * torch_px / std::tan(0.349);
    RasterView view;
    BlockItems items;

    explicit Torch(const glm::dvec3& from) : prop_from_torch(looking(from, {0.0, 0.0, 0.05})) {
        geometry::PropShape square;
        geometry::PropFace& face = square.faces.emplace_back();
        face.plane = {prop_from_torch.direction({0.0, 0.0, -1.0}), 0.0};
        face.plane.offset = glm::dot(face.plane.normal, prop_from_torch.point({0.0, 0.0, before_m}));
        const double half = 0.5 * before_m;
        for (const glm::dvec2& corner : {glm::dvec2(-half, half), glm::dvec2(half, half),
                                         glm::dvec2(half, -half), glm::dvec2(-half, -half)}) {
            face.corners.push_back(prop_from_torch.point({corner, before_m}));
        }
        set_up(view, square,
               {.prop_from_box = glm::inverse(subject.frame.box_from_file),
                .box_size = subject.frame.box_size,
                .projector = {.width = torch_px,
                              .height = torch_px,
                              .fx = focal_px,
                              .fy = focal_px,
                              .cx = 0.5 * torch_px,
                              .cy = 0.5 * torch_px},
                .prop_from_projector = prop_from_torch,
                .eye_m = from});
        list_blocks(items, relief, view);
    }
    /// At a pixel's centre, 1 / z over that of the face; 0 without a hit.
    [[nodiscard]] double cast(const bake::ReliefScene& scene, int x, int y) const {
        const glm::dvec3 ray((x + 0.5 - 0.5 * torch_px) / focal_px, (y + 0.5 - 0.5 * torch_px) / focal_px,
                             1.0);
        const glm::dmat4& box_from_prop = subject.frame.box_from_file;
        const glm::vec3 from(box_from_prop * glm::dvec4(prop_from_torch.translation, 1.0));
        const glm::dvec3 step = glm::dmat3(box_from_prop) * prop_from_torch.direction(ray);
        const bake::SurfaceHit hit = scene.trace(from, glm::vec3(glm::normalize(step)));
        return hit.hit ? before_m * glm::length(step) / static_cast<double>(hit.distance) : 0.0;
    }
    [[nodiscard]] std::vector<float> paint(const TileMask& asked, int threads = 2) const {
        std::vector<float> nearness(std::size_t{torch_px} * torch_px, 0.0F);
        ReliefPainter painter(threads);
        const SeenRelief seen{.relief = &relief, .view = &view};
        painter.paint_nearness(std::span(&seen, 1), asked, {nearness.data(), torch_px, torch_px, torch_px});
        return nearness;
    }
};

TileMask whole() {
    TileMask all;
    all.ask({.x = 0, .y = 0, .width = torch_px, .height = torch_px});
    return all;
}

std::size_t at(int x, int y) {
    return static_cast<std::size_t>(y) * torch_px + static_cast<std::size_t>(x);
}

TEST(Nearness, MatchesRaysCastOntoTheRelief) {
    for (const glm::dvec3& from : {glm::dvec3(0.1, -0.15, 0.2), glm::dvec3(-0.08, 0.03, 0.12)}) {
        const Torch torch(from);
        const bake::ReliefScene scene(torch.relief);
        const std::vector<float> nearness = torch.paint(whole());
        int met = 0;
        int others = 0;
        for (int y = 0; y < torch_px; y += 3) {
            for (int x = 0; x < torch_px; x += 3) {
                const double cast = torch.cast(scene, x, y);
                met += cast > 0.0 ? 1 : 0;
                // A pixel of rounding in the cells' edges: some pixels at outlines meet the next surface.
                others += std::abs(cast - static_cast<double>(nearness[at(x, y)])) > 2e-3 * cast ? 1 : 0;
            }
        }
        EXPECT_GT(met, 1000);
        EXPECT_LT(others, met / 100);
    }
}

TEST(Nearness, RequestedTilesMatchTheWholePicture) {
    const Torch torch({0.1, -0.15, 0.2});
    const std::vector<float> all = torch.paint(whole());
    TileMask asked;
    for (int k = 0; k + 30 < torch_px; k += 56) {
        asked.ask({.x = k, .y = k, .width = 20, .height = 3});
        asked.ask({.x = torch_px - 9 - k, .y = k, .width = 9, .height = 30});
    }
    const std::vector<float> some = torch.paint(asked, 1);
    int met = 0;
    int untouched = 0;
    for (int y = 0; y < torch_px; ++y) {
        for (int x = 0; x < torch_px; ++x) {
            if (asked.some({.x = x, .y = y, .width = 1, .height = 1})) {
                ASSERT_EQ(some[at(x, y)], all[at(x, y)]) << x << " " << y;
                met += all[at(x, y)] > 0.0F ? 1 : 0;
            } else {
                untouched += all[at(x, y)] > 0.0F && some[at(x, y)] == 0.0F ? 1 : 0;
            }
        }
    }
    EXPECT_GT(met, 500);
    EXPECT_GT(untouched, met);
}

TEST(Nearness, DoesNotDependOnReliefOrderOrUnseenReliefs) {
    const Torch torch({0.1, -0.15, 0.2});
    RasterView unseen = torch.view;
    unseen.faces.clear();
    unseen.lit = {};
    const SeenRelief own{.relief = &torch.relief, .view = &torch.view};
    const SeenRelief beside{.relief = &torch.relief, .view = &unseen};
    ReliefPainter painter(2);
    for (const std::array<SeenRelief, 2>& both :
         {std::array{beside, own}, std::array{own, beside}, std::array{own, own}}) {
        std::vector<float> nearness(std::size_t{torch_px} * torch_px, 0.0F);
        painter.paint_nearness(both, whole(), {nearness.data(), torch_px, torch_px, torch_px});
        EXPECT_EQ(nearness, torch.paint(whole()));
    }
}

TEST(Nearness, IsTheSameForEachInstructionSet) {
    const Torch torch({0.1, -0.15, 0.2});
    std::vector<float> best(std::size_t{torch_px} * torch_px, 0.0F);
    std::vector<float> plain = best;
    for (int band = 0; band < torch_px / rows_of_band; ++band) {
        rasterize_nearness({best.data(), torch_px, torch_px, torch_px}, whole(), band, torch.relief,
                           torch.view, torch.items);
        rasterize_nearness({plain.data(), torch_px, torch_px, torch_px}, whole(), band, torch.relief,
                           torch.view, torch.items, Instructions::Plain);
    }
    EXPECT_EQ(best, plain);
    EXPECT_GT(*std::max_element(best.begin(), best.end()), 0.0F);
}

TEST(TileMask, ContainsTheTilesThatARectangleTouches) {
    TileMask mask;
    EXPECT_TRUE(mask.bounds().empty());
    mask.ask(PixelRectangle{});
    EXPECT_TRUE(mask.bounds().empty());
    mask.ask({.x = 15, .y = 8, .width = 2, .height = 1});
    EXPECT_EQ(mask.bounds(), (PixelRectangle{.x = 8, .y = 8, .width = 16, .height = 8}));
    mask.ask({.x = 504, .y = 511, .width = 8, .height = 1});
    EXPECT_EQ(mask.tiles_at(511), std::uint64_t{1} << 63);
    EXPECT_TRUE(mask.some({.x = 0, .y = 0, .width = 9, .height = 9}));
    EXPECT_FALSE(mask.some({.x = 0, .y = 0, .width = 8, .height = 512}));
    EXPECT_TRUE(mask.each({.x = 8, .y = 8, .width = 16, .height = 8}));
    EXPECT_FALSE(mask.each({.x = 8, .y = 8, .width = 17, .height = 8}));
    EXPECT_FALSE(mask.each({.x = 8, .y = 8, .width = 16, .height = 9}));
    TileMask both;
    both.ask({.x = 0, .y = 0, .width = 512, .height = 512});
    EXPECT_TRUE(both.each({.x = 0, .y = 0, .width = 512, .height = 512}));
    mask.ask(both);
    EXPECT_EQ(mask.bounds(), (PixelRectangle{.x = 0, .y = 0, .width = 512, .height = 512}));
}

} // namespace
} // namespace frustumscreen::relief
