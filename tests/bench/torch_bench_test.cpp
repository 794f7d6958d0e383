// frustumscreen-bench torch: its sweep, its truth, and all of it on three small pieces.

#include "app/bench/torch/torch_bench.h"
#include "app/bench/torch/torch_wall.h"
#include "firmware_host/base/file.h"
#include "tests/base/temporary_folder.h"
#include "tests/bench/near_settings.h"
#include "tests/bench/three_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace frustumscreen::bench {
namespace {

TEST(TorchSweep, MovesContinuouslyAroundTheArtifactAndAimsAtIt) {
    const settings::Settings settings = near_settings();
    const geometry::PropShape prop = settings::make_prop(settings.prop);
    const geometry::Box box{{-0.05, -0.04, 0.0}, {0.05, 0.04, 0.1}};
    const Result<std::vector<TorchFrame>> sweep = draw_sweep(settings, prop, box, 60, 3);
    ASSERT_TRUE(sweep) << sweep.error().message;
    ASSERT_EQ(sweep->size(), 60U);
    for (std::size_t k = 0; k < sweep->size(); ++k) {
        const TorchFrame& frame = (*sweep)[k];
        const geometry::RigidTransform prop_from_torch =
            frame.pose.table_from_prop.inverse() * frame.table_from_torch;
        const glm::dvec3 at = prop_from_torch.translation;
        const glm::dvec3 middle(0.0, 0.0, 0.05);
        const glm::dvec3 half(0.05, 0.04, 0.05);
        EXPECT_TRUE(glm::any(glm::greaterThan(glm::abs(at - middle), half))) << k; // outside
        const glm::dvec3 ahead = prop_from_torch.direction({0.0, 0.0, 1.0});
        EXPECT_GT(glm::dot(ahead, middle - at), 0.0) << k;
        EXPECT_LT(glm::length(glm::cross(ahead, middle - at)), 0.75 * glm::length(half)) << k;
        if (k > 0) {
            EXPECT_LT(glm::distance(frame.table_from_torch.translation,
                                    (*sweep)[k - 1].table_from_torch.translation),
                      2.0 / sweep_hz)
                << k;
        }
    }
    EXPECT_EQ(draw_sweep(settings, prop, box, 60, 3)->back().table_from_torch.translation,
              sweep->back().table_from_torch.translation);
}

TEST(IntensityError, CountsOnlyLitPixelsAndReportsLightInShadow) {
    TorchTruth truth{.place = {4, 1, TorchPlace::Lit}, .intensity = {4, 1, 0.5F}};
    truth.place.at(2, 0) = TorchPlace::Shadow;
    truth.place.at(3, 0) = TorchPlace::Unclear;
    image::Image8 drawn(4, 1, glm::u8vec4(188)); // 0.5 in linear light, within a third of a code
    drawn.at(1, 0) = glm::u8vec4(0);
    IntensityError error;
    error.add(truth, drawn);
    EXPECT_EQ(error.pixels(), 2U);
    EXPECT_NEAR(error.max(), 50.0, 1e-6);
    EXPECT_NEAR(error.rmse(), 50.0 / std::sqrt(2.0), 0.1);
    EXPECT_EQ(error.leak(), 100.0);
}

/// Two squares of a metre across the beam, one behind the other.
TEST(TorchTruth, HasAttenuationAndShadowsOfOccluders) {
    auto level = std::make_shared<scene::LevelTriangles>();
    const auto add_square = [&](float half, float z) {
        const auto first = static_cast<std::uint32_t>(level->positions.size());
        for (const glm::vec2 corner :
             {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
            level->positions.emplace_back(half * corner.x, half * corner.y, z);
        }
        for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) {
            level->indices.push_back(first + corner);
        }
    };
    add_square(0.02F, 0.2F); // before
    add_square(0.5F, 0.4F);
    scene::Part part;
    part.level.triangles = level;
    part.level.box_size = {1.0, 1.0, 0.4};
    const DrawnSurface surface(std::span(&part, 1));
    const glm::dvec3 eye_m(0.0, 1.0, 0.0);
    const torch::Beam beam = {.opening_rad = 1.0, .full_m = 0.1}; // from the origin along +Z
    const std::vector<std::pair<glm::vec3, TorchPlace>> places{
        {{0.0F, 0.0F, 0.2F}, TorchPlace::Lit},
        {{0.0F, 0.0F, 0.4F}, TorchPlace::Shadow},
        {{0.1F, 0.0F, 0.4F}, TorchPlace::Lit},
        {{0.04F, 0.0F, 0.4F}, TorchPlace::Unclear},
        {{0.4F, 0.0F, 0.4F}, TorchPlace::Outside},
        {{0.4F * 0.54630249F, 0.0F, 0.4F}, TorchPlace::Unclear},
        {glm::vec3(std::numeric_limits<float>::quiet_NaN()), TorchPlace::Outside}};
    image::ImageFloat points(static_cast<int>(places.size()), 1);
    for (std::size_t k = 0; k < places.size(); ++k) {
        points.texels[k] = places[k].first;
    }
    const TorchTruth cast = cast_torch(surface, points, eye_m, {}, beam);
    for (std::size_t k = 0; k < places.size(); ++k) {
        EXPECT_EQ(cast.place.texels[k], places[k].second) << k;
    }
    EXPECT_NEAR(static_cast<double>(cast.intensity.texels[2]), 0.01 / 0.17, 1e-6);
}

TEST(TorchWall, ShorterEdgesReduceTheErrorAndTheBoundIsKept) {
    const std::vector<WallRow> rows = measure_wall();
    for (std::size_t k = 0; k < rows.size(); ++k) {
        if (rows[k].splitting.by == torch::Splitting::By::Bound) {
            EXPECT_LE(rows[k].max, 100.0 * rows[k].splitting.tolerance + 1e-4) << k;
        } else if (k > 0 && rows[k - 1].attenuation == rows[k].attenuation) {
            EXPECT_LT(rows[k].rmse, rows[k - 1].rmse) << k;
            EXPECT_GT(rows[k].triangles, rows[k - 1].triangles) << k;
        }
    }
    EXPECT_TRUE(torch_triangles_csv().starts_with(
        "heuristic,tolerance,triangle,x_m,y_m,intensity,s,t,q\nlength,100,0,"));
}

TEST(TorchBench, MeasuresEachTechniqueInEachScene) {
    const TemporaryFolder folder;
    bake::SourceMesh mesh;
    const pack::Pack pack = small_pack(mesh);
    const std::filesystem::path file = folder.path() / "pieces.fspack";
    ASSERT_TRUE(write_file(file, pack::write_pack(pack).value()));
    const Result<std::unique_ptr<TorchSet>> set = TorchSet::open(near_settings(), file);
    ASSERT_TRUE(set) << set.error().message;
    TorchOptions options;
    options.frames = 12;
    options.passes = 1;
    options.errors = 3;
    const Result<TorchResult> result = measure_torch(**set, options, [](const std::string&, double) {});
    ASSERT_TRUE(result) << result.error().message;
    ASSERT_EQ(result->rows.size(), 33U);
    const std::string csv = torch_csv(*result);
    EXPECT_TRUE(csv.starts_with("scene,technique,tolerance_mm,ms_p50,ms_p99,intensity_rmse,intensity_max\n"
                                "mesh,none,0,"));
    for (const char* const row : {"\nmesh,ours,0,", "\nmesh,paper,2,", "\nrelief,ours_no_shadow,0,",
                                  "\ncells,paper_steered,", "\ncells,paper_curvature_2pct,0,"}) {
        EXPECT_NE(csv.find(row), std::string::npos) << row;
    }
    for (const TorchRow& row : result->rows) {
        const std::string what = row.scene + ", " + row.way.name;
        EXPECT_EQ(row.frame_ms.size(), 12U) << what;
        EXPECT_GT(row.ms_p50(), 0.0) << what;
        EXPECT_GE(row.ms_p99(), row.ms_p50()) << what;
        EXPECT_GT(row.error.pixels(), 200U) << what;
        if (row.way.kind == TorchWay::Kind::None) {
            EXPECT_GT(row.error.rmse(), 1.0) << what; // nothing is lit
            continue;
        }
        // Unlit it were 12 or more. Shadows are of the drawn level, at one pixel of the torch's own picture.
        EXPECT_LT(row.error.rmse(), row.way.kind == TorchWay::Kind::Ours ? 5.0 : 1.0) << what;
        if (row.way.kind == TorchWay::Kind::Ours) {
            EXPECT_LT(row.error.leak(), 1.0) << what;
        } else {
            EXPECT_GT(row.error.leak(), 50.0) << what; // it has no shadows
        }
    }
    EXPECT_NE(torch_verdicts(*result).find("x the frame without a torch"), std::string::npos);
}

} // namespace
} // namespace frustumscreen::bench
