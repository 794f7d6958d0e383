#include "assets_baked/bake/triangle_mesh.h"
#include "assets_baked/bake/visibility.h"
#include "tests/relief/subject.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace frustumscreen::relief {
namespace {

struct Frame {
    RasterView view;
    BlockItems items;
    RasterSamples picture; ///< one sample per pixel of the lit part
};

void draw(Frame& frame, const Subject& subject, const BlockRelief& relief, const settings::Settings& settings,
          const geometry::PropShape& prop, const bench::BenchPose& pose) {
    subject.show(frame.view, settings, prop, pose);
    list_blocks(frame.items, relief, frame.view);
    frame.picture.begin(frame.view.lit, 1);
    rasterize(frame.picture, relief, frame.view, frame.items);
}

bool contains(const PixelRectangle& of, int x, int y) {
    return x >= of.x && x < of.x + of.width && y >= of.y && y < of.y + of.height;
}

struct Errors {
    int truth = 0, missing = 0, extra = 0, far = 0;
    double mean_mm = 0.0, colour_rmse = 0.0;
};

Errors errors_of(const Frame& frame, const BlockRelief& relief, const bench::TruthPicture& truth,
                 const geometry::PropShape& prop, const bench::BenchPose& pose,
                 const settings::Settings& settings) {
    const bench::TruthView view = bench::view_of(settings, pose);
    Errors errors;
    int both = 0;
    for (int y = 0; y < truth.hit.height; ++y) {
        for (int x = 0; x < truth.hit.width; ++x) {
            const std::size_t at = contains(frame.view.lit, x, y) ? frame.picture.at(x, y) : 0;
            const bool drawn = contains(frame.view.lit, x, y) && frame.picture.nearness[at] > 0.0F;
            const bool is_true = truth.hit.at(x, y) != 0;
            errors.truth += is_true ? 1 : 0;
            errors.missing += is_true && !drawn ? 1 : 0;
            errors.extra += drawn && !is_true ? 1 : 0;
            if (!drawn || !is_true) {
                continue;
            }
            glm::dvec3 best(INFINITY);
            for (const geometry::PropFace& face : prop.faces) {
                if (face.plane.distance(view.eye_m) > 0.0 &&
                    face.plane.distance(view.prop_from_projector.translation) > 0.0) {
                    const geometry::Pinhole ideal = view.projector.ideal();
                    const geometry::FaceRays rays =
                        geometry::face_rays(face, ideal, view.prop_from_projector, view.eye_m);
                    const glm::dvec3 pixel(ideal.pixel(view.projector.ray({x + 0.5, y + 0.5})).value(), 1.0);
                    bool inside = true;
                    for (const glm::dvec3& edge : rays.edges) {
                        inside = inside && glm::dot(edge, pixel) <= 0.0;
                    }
                    if (inside) {
                        best = view.eye_m +
                               rays.direction * pixel / static_cast<double>(frame.picture.nearness[at]);
                    }
                }
            }
            const double mm = 1e3 * glm::distance(best, glm::dvec3(truth.point_m.at(x, y)));
            errors.mean_mm += mm;
            errors.far += mm > 1.0 ? 1 : 0;
            const glm::u8vec4 code = colour_at(relief, frame.picture.block[at], frame.picture.place[at]);
            const glm::dvec3 off = glm::dvec3(code) - glm::dvec3(truth.colour.at(x, y));
            errors.colour_rmse += glm::dot(off, off) / 3.0;
            ++both;
        }
    }
    errors.mean_mm /= both;
    errors.colour_rmse = std::sqrt(errors.colour_rmse / both);
    return errors;
}

/// Sums of pixels over all poses; the mean of their means.
Errors errors_over(const Subject& subject, const BlockRelief& relief, const settings::Settings& settings,
                   const geometry::PropShape& prop, const std::vector<bench::BenchPose>& poses) {
    Errors sum;
    Frame frame;
    for (const bench::BenchPose& pose : poses) {
        draw(frame, subject, relief, settings, prop, pose);
        const bench::TruthPicture truth = subject.truth.cast(prop, bench::view_of(settings, pose), false);
        const Errors one = errors_of(frame, relief, truth, prop, pose, settings);
        sum.truth += one.truth;
        sum.missing += one.missing;
        sum.extra += one.extra;
        sum.far += one.far;
        sum.mean_mm += one.mean_mm / static_cast<double>(poses.size());
        sum.colour_rmse += one.colour_rmse / static_cast<double>(poses.size());
    }
    return sum;
}

/// Compares a relief of the ring with limits that follow from its cells. Between samples the surface is a chord. It is
/// at most sqrt(6) cells long: a cell's diagonal, on a surface that is inclined by 55 degrees to its direction. Over a
/// chord d, a tube of radius r rises by d^2 / 8 r.
void expect_as_fine_as_its_cells(const Errors& sum, const BlockRelief& relief, double cell_mm) {
    constexpr double radius_mm = 1e3 * bench::ring_minor_m;
    const double rise_mm = 0.75 * cell_mm * cell_mm / radius_mm;
    std::printf("cells of %.3f mm: %zu blocks, %d pixels, missing %d, extra %d, far %d, %.5f mm, RMSE %.2f\n",
                cell_mm, relief.blocks.size(), sum.truth, sum.missing, sum.extra, sum.far, sum.mean_mm,
                sum.colour_rmse);
    // A tube's picture has an outline of 1 / r for each unit of its area. The count has a standard deviation.
    const double at_outline = sum.truth * rise_mm / radius_mm;
    EXPECT_LT(sum.missing + sum.extra, at_outline + 2.0 * std::sqrt(at_outline));
    // Along a ray: the rise's mean over a chord is 2/3 of it, and a tube has pi/2 times the area of its picture.
    EXPECT_LT(sum.mean_mm, std::numbers::pi / 3.0 * rise_mm);
    EXPECT_LT(sum.colour_rmse, 2.0) << "codes; wanted everywhere";
}

/// The size of a cell of the ring's relief.
double ring_cell_mm(int texels) {
    return 1e3 * 2.0 * (bench::ring_major_m + bench::ring_minor_m) / texels;
}

TEST(Raster, RingMatchesTheRayCast) {
    const Subject subject;
    const settings::Settings settings = bench::near_settings();
    const geometry::PropShape prop = settings::make_prop(settings.prop);
    const std::vector<bench::BenchPose> poses = bench::draw_poses(settings, prop, 8, 5).value();
    for (const int texels : {128, 256, 512}) {
        const BlockRelief relief = subject.relief(texels);
        expect_as_fine_as_its_cells(errors_over(subject, relief, settings, prop, poses), relief,
                                    ring_cell_mm(texels));
    }
}

constexpr std::array<geometry::Lens, 3> lenses{geometry::Lens{0.1, 0.0}, geometry::Lens{-0.12, 0.04},
                                               geometry::Lens{0.3, -0.2}};

TEST(Raster, RingMatchesTheRayCastWithLensDistortion) {
    const Subject subject;
    const BlockRelief relief = subject.relief(256);
    for (const geometry::Lens& lens : lenses) {
        settings::Settings settings = bench::near_settings();
        settings.projector.pinhole.lens = lens;
        const geometry::PropShape prop = settings::make_prop(settings.prop);
        const std::vector<bench::BenchPose> poses = bench::draw_poses(settings, prop, 8, 5).value();
        SCOPED_TRACE(lens.k1);
        expect_as_fine_as_its_cells(errors_over(subject, relief, settings, prop, poses), relief,
                                    ring_cell_mm(256));
    }
}

/// Large blocks of a coarse relief behind a lens with strong distortion: each is listed for all pixels of its
/// face, and only for those.
TEST(Raster, BlockListIsCompleteWithLensDistortion) {
    const Subject subject;
    const BlockRelief relief = subject.relief(32);
    for (const geometry::Lens& lens : lenses) {
        settings::Settings settings = bench::near_settings();
        geometry::Pinhole& pinhole = settings.projector.pinhole;
        pinhole.lens = lens;
        const geometry::PropShape prop = settings::make_prop(settings.prop);
        std::size_t narrowed = 0;
        const std::vector<bench::BenchPose> poses = bench::draw_poses(settings, prop, 8, 6).value();
        for (const bench::BenchPose& pose : poses) {
            Frame frame;
            draw(frame, subject, relief, settings, prop, pose);
            const std::vector<float> own = frame.picture.nearness;
            for (std::vector<BlockItem>& part : frame.items.parts) {
                for (BlockItem& item : part) {
                    const PixelRectangle& lit = frame.view.faces[item.face].lit;
                    const PixelSpan whole{
                        static_cast<std::uint16_t>(lit.x), static_cast<std::uint16_t>(lit.x + lit.width),
                        static_cast<std::uint16_t>(lit.y), static_cast<std::uint16_t>(lit.y + lit.height)};
                    narrowed += item.area == whole ? 0U : 1U;
                    item.area = whole;
                }
            }
            end_list(frame.items);
            frame.picture.begin(frame.view.lit, 1);
            rasterize(frame.picture, relief, frame.view, frame.items);
            EXPECT_EQ(own, frame.picture.nearness) << lens.k1;
        }
        EXPECT_GT(narrowed, 100U);
    }
}

/// A block at an angle in the prop: flat faces and sharp edges, none along the grid.
std::shared_ptr<bake::SourceMesh> askew_block() {
    auto mesh = std::make_shared<bake::SourceMesh>();
    mesh->materials.resize(1);
    const glm::dmat3 turn(glm::mat3_cast(glm::angleAxis(0.5, glm::dvec3(0.0, 0.0, 1.0)) *
                                         glm::angleAxis(0.3, glm::dvec3(0.0, 1.0, 0.0))));
    for (unsigned k = 0; k < 8; ++k) {
        const glm::dvec3 corner((k & 1U) != 0 ? 0.022 : -0.022, (k & 2U) != 0 ? 0.014 : -0.014,
                                (k & 4U) != 0 ? 0.02 : -0.02);
        mesh->positions.push_back(turn * corner + glm::dvec3(0.0, 0.0, 0.045));
    }
    mesh->triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                       {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    mesh->triangle_materials.assign(mesh->triangles.size(), 0);
    return mesh;
}

TEST(Raster, DrawsSharpEdgesWithinTheErrorLimits) {
    const Subject subject{askew_block()};
    const settings::Settings settings = bench::near_settings();
    const geometry::PropShape prop = settings::make_prop(settings.prop);
    const BlockRelief relief = subject.relief(96);
    EXPECT_FALSE(relief.covers.empty());
    const std::vector<bench::BenchPose> poses = bench::draw_poses(settings, prop, 8, 5).value();
    const Errors sum = errors_over(subject, relief, settings, prop, poses);
    std::printf("%zu blocks, %zu covers, %d pixels, missing %d, extra %d, far %d, %.5f mm\n",
                relief.blocks.size(), relief.covers.size(), sum.truth, sum.missing, sum.extra, sum.far,
                sum.mean_mm);
    // Two and a half times the measured values. Cells that end in steps miss 150 pixels here, of 23,316.
    EXPECT_LT(sum.missing, sum.truth / 800);
    EXPECT_LT(sum.extra, sum.truth / 200);
    EXPECT_LT(sum.far, sum.truth / 1000);
    EXPECT_LT(sum.mean_mm, 0.01);
}

TEST(Raster, InconsistentWindingLeavesNoHoles) {
    std::shared_ptr<bake::SourceMesh> soup = askew_block();
    for (std::size_t k = 0; k < soup->triangles.size(); k += 3) {
        std::swap(soup->triangles[k][1], soup->triangles[k][2]);
    }
    const Subject subject{soup};
    const bake::TriangleMesh sides =
        bake::visible_sides(bake::weld(*soup, subject.points), subject.surface, {});
    const bake::SourceMesh seen = bake::as_source(sides);
    const bake::SourceScene surface(
        seen, std::vector<glm::dvec3>(sides.positions.begin(), sides.positions.end()), bake::Sides::Front);
    const BlockRelief relief = bake::bake_blocks({surface, subject.frame.box_size, frustum_directions, 96});
    const settings::Settings settings = bench::near_settings();
    const geometry::PropShape prop = settings::make_prop(settings.prop);
    const std::vector<bench::BenchPose> poses = bench::draw_poses(settings, prop, 8, 5).value();
    int truth_pixels = 0;
    int missing = 0;
    for (const bench::BenchPose& pose : poses) {
        Frame frame;
        draw(frame, subject, relief, settings, prop, pose);
        const bench::TruthPicture truth = subject.truth.cast(prop, bench::view_of(settings, pose), false);
        const Errors one = errors_of(frame, relief, truth, prop, pose, settings);
        truth_pixels += one.truth;
        missing += one.missing;
    }
    std::printf("%d pixels, missing %d\n", truth_pixels, missing);
    EXPECT_LT(missing, truth_pixels / 800); // as for the block with consistent winding
}

TEST(Raster, EveryInstructionSetMakesTheSamePicture) {
    const Subject subject;
    const settings::Settings settings = bench::near_settings();
    const geometry::PropShape prop = settings::make_prop(settings.prop);
    const BlockRelief relief = subject.relief(128);
    const std::vector<bench::BenchPose> poses = bench::draw_poses(settings, prop, 4, 9).value();
    for (const bench::BenchPose& pose : poses) {
        Frame frame;
        draw(frame, subject, relief, settings, prop, pose);
        BlockItems plain_items;
        list_blocks(plain_items, relief, frame.view, Instructions::Plain);
        EXPECT_EQ(frame.items.sorted, plain_items.sorted);
        for (const int samples : {1, 4}) {
            RasterSamples best;
            best.begin(frame.view.lit, samples);
            rasterize(best, relief, frame.view, frame.items);
            RasterSamples plain;
            plain.begin(frame.view.lit, samples);
            rasterize(plain, relief, frame.view, frame.items, {}, Instructions::Plain);
            EXPECT_EQ(best.nearness, plain.nearness);
            EXPECT_EQ(best.block, plain.block);
            EXPECT_EQ(best.place, plain.place);
        }
    }
}

} // namespace
} // namespace frustumscreen::relief
