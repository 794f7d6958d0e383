// Eyes just before the plane of a face, which see it as a line: through it each cell of a relief is drawn out across the face.

#include "app/bench/truth/seeded_draw.h"
#include "app/geometry/collineation.h"
#include "app/relief/item_rows.h"
#include "assets_baked/bake/relief_scene.h"
#include "tests/relief/subject.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace frustumscreen::relief {
namespace {

constexpr geometry::FrustumSize solid{0.16, 0.09, 0.12};

/// The prop with rippled sides and a rippled top, 0.2 to 2.2 mm within it: surfaces that an eye just before a face's plane sees
/// through the face.
std::shared_ptr<bake::SourceMesh> rippled_frustum() {
    constexpr std::uint32_t count = 96; ///< squares along a side
    const std::shared_ptr<bake::SourceMesh> mesh = bench::ring();
    mesh->positions.clear();
    mesh->uvs.clear();
    mesh->triangles.clear();
    const auto add_side = [&](const auto& at) {
        const auto first = static_cast<std::uint32_t>(mesh->positions.size());
        for (std::uint32_t j = 0; j <= count; ++j) {
            for (std::uint32_t i = 0; i <= count; ++i) {
                const glm::dvec2 place = glm::dvec2(i, j) / double{count};
                const double depth_m =
                    0.0002 + 0.001 * (1.0 + std::sin(50.0 * place.x) * std::cos(45.0 * place.y));
                mesh->positions.push_back(at(2.0 * place.x - 1.0, place.y, depth_m));
                mesh->uvs.emplace_back(place);
            }
        }
        for (std::uint32_t j = 0; j < count; ++j) {
            for (std::uint32_t i = 0; i < count; ++i) {
                const std::uint32_t k = first + j * (count + 1) + i;
                mesh->triangles.push_back({k, k + 1, k + count + 1});
                mesh->triangles.push_back({k + 1, k + count + 2, k + count + 1});
            }
        }
    };
    const double lean = std::atan2(0.5 * (solid.base_m - solid.top_m), solid.height_m);
    for (int side = 0; side < 4; ++side) {
        const glm::dquat turn = glm::angleAxis(0.5 * side * std::numbers::pi, glm::dvec3(0.0, 0.0, 1.0));
        add_side([&](double across, double up, double depth_m) {
            const double z = 0.001 + (solid.height_m - 0.002) * up;
            const double half = glm::mix(0.5 * solid.base_m, 0.5 * solid.top_m, z / solid.height_m);
            return turn * glm::dvec3((half - 0.001) * across, -half + depth_m / std::cos(lean), z);
        });
    }
    add_side([&](double x, double y, double depth_m) {
        const double half = 0.5 * solid.top_m - 0.001;
        return glm::dvec3(half * x, half * (2.0 * y - 1.0), solid.height_m - depth_m);
    });
    mesh->triangle_materials.assign(mesh->triangles.size(), 0);
    return mesh;
}

constexpr int px_per_ray = 2; ///< along rows and columns

struct Grazing {
    Subject subject{.mesh = rippled_frustum()};
    BlockRelief relief = subject.relief(192);
    settings::Settings settings = [] {
        settings::Settings settings = bench::near_settings();
        settings.projector.pinhole = {1280, 800, 2850.0, 2850.0, 640.0, 400.0};
        return settings;
    }();
    geometry::PropShape prop = settings::make_prop(settings.prop);
    geometry::RigidTransform table_from_prop{glm::angleAxis(0.4, glm::dvec3(0.0, 0.0, 1.0)), glm::dvec3(0.0)};
    RasterView view;
    BlockItems items;
    RasterSamples picture;

    /// Draws the picture for an eye in the prop's frame.
    void draw(const glm::dvec3& eye_m) {
        subject.show(view, settings, prop, {table_from_prop, table_from_prop.point(eye_m)});
        list_blocks(items, relief, view);
        picture.begin(view.lit, 1);
        rasterize(picture, relief, view, items);
    }
    /// The rasterizer's steps for it: eight cells at a pixel each.
    [[nodiscard]] double steps() const {
        double steps = 0.0;
        for (const BlockItem& item : items.sorted) {
            const ReadyItem of = ready(relief, view, items, item, {});
            for_each_row(of, [&](const CellCorners& corners, Ints cells, int) {
                const CellRow row = cell_row(corners, cells, of.outward);
                const CellPixels pixels = cell_pixels(row, item.area, glm::vec2(0.5F));
                if (any(pixels.there)) {
                    for_each_pixel(pixels, row, corners, cell_steps(corners), glm::vec2(0.5F),
                                   [&](const Weights&, Ints, Ints, int) { steps += 1.0; });
                }
            });
        }
        return steps;
    }
};

struct Eye {
    std::size_t face = 0; ///< of the prop, before whose plane it lies
    glm::dvec3 at_m{0.0}; ///< prop frame
};

/// 0.1 to 10 mm before the plane of a face, which it sees at `min_sine` or more, and beside the prop.
std::vector<Eye> draw_eyes(const geometry::PropShape& prop, std::size_t count) {
    bench::SeededDraw draw(7);
    std::vector<Eye> eyes;
    for (std::size_t face = 0; eyes.size() < count; face = (face + 1) % prop.faces.size()) {
        const geometry::PropFace& before = prop.faces[face];
        const double height_m = 1e-4 * std::pow(100.0, draw.between(0.0, 1.0));
        const double away_m = 0.15 * std::pow(6.0, draw.between(0.0, 1.0));
        const double turn = draw.between(0.0, 2.0 * std::numbers::pi);
        const glm::dvec3 x = glm::normalize(before.corners[1] - before.corners[0]);
        const glm::dvec3 y = glm::cross(before.plane.normal, x);
        const glm::dvec3 at = before.middle() + away_m * (std::cos(turn) * x + std::sin(turn) * y) +
                              height_m * before.plane.normal;
        constexpr double lowest_m = 0.05; // below it an eye looks in from beneath the artifact
        if (at.z > lowest_m && height_m > 1.1 * geometry::min_sine * glm::distance(at, prop.middle)) {
            eyes.push_back({face, at});
        }
    }
    return eyes;
}

/// Calls visit(pixel as (x, y, 1), index in the picture) for pixels of the eye's face, but for those at its edges.
template <typename Visit>
void for_pixels_of(const Grazing& drawn, const RasterFace& face, const Visit& visit) {
    const PixelRectangle& lit = face.lit;
    for (int y = lit.y; y < lit.y + lit.height; y += px_per_ray) {
        for (int x = lit.x; x < lit.x + lit.width; x += px_per_ray) {
            const glm::dvec3 pixel(x + 0.5, y + 0.5, 1.0);
            if (std::all_of(face.edges.begin(), face.edges.end(),
                            [&](const glm::dvec3& edge) { return glm::dot(edge, pixel) > 0.01; })) {
                visit(pixel, drawn.picture.at(x, y));
            }
        }
    }
}

const RasterFace* find_face(const Grazing& drawn, std::size_t face) {
    const auto found =
        std::find_if(drawn.view.faces.begin(), drawn.view.faces.end(),
                     [&](const RasterFace& each) { return each.face == static_cast<int>(face); });
    return found != drawn.view.faces.end() ? &*found : nullptr;
}

/// The cell that a sample shows, its corners in the box.
struct ShownCell {
    std::array<glm::dvec3, 4> corners;
    glm::dvec2 place; ///< in it, 0..1

    ShownCell(const BlockRelief& relief, std::uint32_t block, std::uint32_t at) {
        constexpr auto unit = double{RasterSamples::places_per_cell};
        const glm::dvec2 in_block = glm::dvec2(at & 0xFFFFU, at >> 16U) / unit;
        const glm::dvec2 cell = glm::floor(in_block);
        place = in_block - cell;
        const auto after = std::upper_bound(relief.first_block.begin(), relief.first_block.end(), block);
        const ReliefGrid& grid =
            relief.grids[static_cast<std::size_t>(after - relief.first_block.begin()) - 1];
        for (unsigned k = 0; k < corners.size(); ++k) {
            corners[k] =
                corner_in_box(relief, grid, block, static_cast<std::size_t>(8.0 * cell.y + cell.x), k);
        }
    }
    [[nodiscard]] glm::dvec3 point() const {
        const auto& [a, b, c, d] = corners;
        return place.x + place.y <= 1.0 ? a + place.x * (b - a) + place.y * (c - a)
                                        : d + (1.0 - place.x) * (c - d) + (1.0 - place.y) * (b - d);
    }
    [[nodiscard]] double length() const {
        double longest = 0.0;
        for (const glm::dvec3& a : corners) {
            for (const glm::dvec3& b : corners) {
                longest = std::max(longest, glm::distance(a, b));
            }
        }
        return longest;
    }
};

/// A cell is drawn wider by 4 % of its size along both its axes, and 2 % may be perspective.
TEST(GrazingEye, ShowsEachPlaceOnItsRay) {
    Grazing drawn;
    const double px_box = 0.9 / drawn.settings.projector.pinhole.fx *
                          glm::length(glm::dvec3(drawn.subject.frame.box_from_file[0]));
    int count = 0;
    double sum_px = 0.0;
    for (const Eye& eye : draw_eyes(drawn.prop, 30)) {
        drawn.draw(eye.at_m);
        const RasterFace* const face = find_face(drawn, eye.face);
        ASSERT_NE(face, nullptr);
        for_pixels_of(drawn, *face, [&](const glm::dvec3& pixel, std::size_t at) {
            if (drawn.picture.nearness[at] <= 0.0F) {
                return;
            }
            const ShownCell cell(drawn.relief, drawn.picture.block[at], drawn.picture.place[at]);
            const glm::dvec3 ray = glm::normalize(face->direction * pixel);
            const glm::dvec3 to_place = cell.point() - drawn.view.eye_box;
            const double beside = glm::length(to_place - glm::dot(to_place, ray) * ray);
            EXPECT_LT(beside, 0.08 * cell.length()) << eye.at_m.x << " " << eye.at_m.y << " " << eye.at_m.z;
            sum_px += beside / px_box;
            ++count;
        });
    }
    std::printf("%d places, %.4f px beside their rays\n", count, sum_px / count);
    EXPECT_GT(count, 20000);
    EXPECT_LT(sum_px / count, 0.05);
}

/// A cell is drawn wider by 4 % of its size: beyond an outline, and over a neighbour.
TEST(GrazingEye, MatchesRaysCastOntoTheRelief) {
    Grazing drawn;
    const bake::ReliefScene scene(drawn.relief);
    int met = 0;
    int missing = 0;
    int others = 0;
    for (const Eye& eye : draw_eyes(drawn.prop, 30)) {
        drawn.draw(eye.at_m);
        const RasterFace* const face = find_face(drawn, eye.face);
        ASSERT_NE(face, nullptr);
        for_pixels_of(drawn, *face, [&](const glm::dvec3& pixel, std::size_t at) {
            const glm::dvec3 ray = face->direction * pixel;
            const bake::SurfaceHit hit =
                scene.trace(glm::vec3(drawn.view.eye_box), glm::vec3(glm::normalize(ray)));
            const double cast = hit.hit ? glm::length(ray) / static_cast<double>(hit.distance) : 0.0;
            const auto nearness = static_cast<double>(drawn.picture.nearness[at]);
            met += hit.hit ? 1 : 0;
            missing += hit.hit && nearness == 0.0 ? 1 : 0;
            others += std::abs(cast - nearness) > 2e-3 * cast ? 1 : 0;
        });
    }
    std::printf("%d met, %d missing, %d others\n", met, missing, others);
    EXPECT_GT(met, 20000);
    EXPECT_LT(missing, met / 1000);
    EXPECT_LT(others, met / 25);
}

TEST(GrazingEye, PictureIsTheSameForEachInstructionSet) {
    Grazing drawn;
    RasterSamples plain;
    for (const Eye& eye : draw_eyes(drawn.prop, 5)) {
        drawn.draw(eye.at_m);
        plain.begin(drawn.view.lit, 1);
        rasterize(plain, drawn.relief, drawn.view, drawn.items, {}, Instructions::Plain);
        ASSERT_EQ(plain.nearness, drawn.picture.nearness);
        for (std::size_t k = 0; k < plain.nearness.size(); ++k) {
            const bool met = plain.nearness[k] > 0.0F;
            ASSERT_TRUE(!met || (plain.block[k] == drawn.picture.block[k] &&
                                 plain.place[k] == drawn.picture.place[k]))
                << k;
        }
    }
}

TEST(GrazingEye, TakesAtMostThreeTimesTheOrdinarySteps) {
    Grazing drawn;
    const std::vector<bench::BenchPose> poses = bench::draw_poses(drawn.settings, drawn.prop, 20, 5).value();
    double ordinary = 0.0;
    for (const bench::BenchPose& pose : poses) {
        drawn.draw(pose.table_from_prop.inverse().point(pose.eye_m));
        ordinary += drawn.steps() / static_cast<double>(poses.size());
    }
    double max_steps = 0.0;
    for (const Eye& eye : draw_eyes(drawn.prop, 60)) {
        drawn.draw(eye.at_m);
        const double steps = drawn.steps();
        EXPECT_LT(steps, 3.0 * ordinary) << eye.at_m.x << " " << eye.at_m.y << " " << eye.at_m.z;
        max_steps = std::max(max_steps, steps);
    }
    std::printf("%.0f steps, at most %.0f before a face's plane\n", ordinary, max_steps);
}

} // namespace
} // namespace frustumscreen::relief
