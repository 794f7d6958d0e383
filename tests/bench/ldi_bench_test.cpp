// frustumscreen-bench ldi: its scene and path, and a small run of the whole command.

#include "app/bench/ldi/ldi_bench.h"
#include "tests/bench/near_settings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace frustumscreen::bench {
namespace {

TEST(WindowPath, VisitsEveryPatchAndNeverStops) {
    const ldi::Hemisphere hemisphere(frozen_from_m);
    const std::vector<WindowFrame> path = window_path(40, 3);
    std::set<std::size_t> patches;
    for (std::size_t k = 0; k < path.size(); ++k) {
        for (std::size_t window = 0; window < path[k].eyes_m.size(); ++window) {
            const glm::dvec3& eye_m = path[k].eyes_m.at(window);
            const std::optional<std::size_t> patch = hemisphere.patch_of(eye_m);
            ASSERT_TRUE(patch) << k;
            patches.insert(*patch);
            EXPECT_GT(glm::distance(eye_m, path[(k + 1) % path.size()].eyes_m.at(window)), 1e-3) << k;
        }
    }
    EXPECT_EQ(patches.size(), ldi::patch_count);
    EXPECT_EQ(window_path(40, 3).back().eyes_m, path.back().eyes_m);
    for (std::size_t patch = 0; patch < ldi::patch_count; ++patch) {
        for (const glm::dvec3& eye_m : eyes_in_patch(hemisphere, patch, 20, 1)) {
            EXPECT_EQ(nearest_patch(hemisphere, eye_m), patch);
        }
    }
}

TEST(WindowScene, LiesBehindTheWindow) {
    const WindowScene scene = make_window_scene(60'000, 1);
    ASSERT_EQ(scene.world->positions.size(), scene.mesh->positions.size());
    double nearest_m = -1.0;
    for (std::size_t k = 0; k < scene.world->positions.size(); ++k) {
        nearest_m = std::fmax(nearest_m, static_cast<double>(scene.world->positions[k].z));
    }
    EXPECT_LT(nearest_m, -0.001);
    EXPECT_GT(nearest_m, -0.003);
}

const LdiRow& row_of(const LdiResult& result, const std::string& technique) {
    return *std::find_if(result.rows.begin(), result.rows.end(),
                         [&](const LdiRow& row) { return row.technique == technique; });
}

TEST(LdiBench, MeasuresEachTechnique) {
    LdiOptions options;
    options.triangles = {42'000};
    options.pixels = 96;
    options.frames = 4;
    options.passes = 1;
    options.errors = 4;
    options.resolutions = {96};
    const Result<LdiResult> result = measure_ldi(near_settings(), options, [](const std::string&, double) {});
    ASSERT_TRUE(result) << result.error().message;
    const std::string csv = ldi_csv(*result);
    EXPECT_TRUE(csv.starts_with(
        "triangles,windows,technique,ms_p50,ms_p99,silhouette_pct,error_mm_mean,rmse,mb,make_ms\n"
        "42000,0,geometry,"));
    EXPECT_EQ(result->by_patch.size(), ldi::patch_count * result->rows.size());
    EXPECT_EQ(result->pictures.size(), result->rows.size() + 1);
    for (const char* const name :
         {"geometry", "geometry_lod", "relief_pack", "ours", "patch_relief", "multi_ldi_paper", "single_ldi",
          "ibo", "points", "cube_depth", "view_depth"}) {
        EXPECT_NE(csv.find(std::string("\n42000,4,") + name + ","), std::string::npos) << name;
    }
    for (const LdiRow& row : result->rows) {
        for (std::size_t windows = 1; windows < row.frame_ms.size(); ++windows) {
            ASSERT_EQ(row.frame_ms.at(windows).size(), 4U) << row.technique;
            EXPECT_GE(row.ms_p50(windows), row.ms_p50(windows - 1)) << row.technique;
            EXPECT_GE(row.ms_p99(windows), row.ms_p50(windows)) << row.technique;
        }
        EXPECT_EQ(row.error.pictures, 4) << row.technique;
    }
    // The same triangles: a pixel at an edge may fall on either side.
    const LdiRow& geometry = row_of(*result, "geometry");
    EXPECT_LT(geometry.error.silhouette_pct, 0.5);
    EXPECT_LT(geometry.error.error_mm, 0.05);
    EXPECT_EQ(geometry.mb, 0.0);
    // A pixel of the window is 1.25 mm wide, and a point may be seen a pixel beside its place: these are nearer than a house is
    // wide.
    for (const char* const name : {"geometry_lod", "relief_pack", "ours", "multi_ldi_paper"}) {
        EXPECT_LT(row_of(*result, name).error.error_mm, 6.0) << name;
        EXPECT_LT(row_of(*result, name).error.silhouette_pct, 20.0) << name;
        EXPECT_GT(row_of(*result, name).mb, 0.1) << name;
        EXPECT_GT(row_of(*result, name).make_ms, 0.0) << name;
    }
    EXPECT_NE(ldi_verdicts(*result).find("x cheaper than geometry"), std::string::npos);
}

} // namespace
} // namespace frustumscreen::bench
