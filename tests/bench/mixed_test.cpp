// frustumscreen-bench mixed: its walk, its measure of popping, and all of it on a small board.

#include "app/bench/mixed/game_board.h"
#include "app/bench/mixed/mixed.h"
#include "app/bench/mixed/mixed_walk.h"
#include "app/bench/mixed/popping.h"
#include "firmware_host/base/file.h"
#include "tests/base/temporary_folder.h"
#include "tests/bench/near_settings.h"
#include "tests/bench/three_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

namespace frustumscreen::bench {
namespace {

TEST(MixedWalk, StaysInTheZoneAndIsContinuous) {
    const settings::Settings settings = near_settings();
    const geometry::PropShape prop = settings::make_prop(settings.prop);
    const Result<std::vector<BenchPose>> walk = draw_walk(settings, prop, 120, 7);
    ASSERT_TRUE(walk) << walk.error().message;
    ASSERT_EQ(walk->size(), 120U);
    double nearest_m = 1e9;
    double farthest_m = 0.0;
    for (std::size_t k = 0; k < walk->size(); ++k) {
        const BenchPose& pose = (*walk)[k];
        EXPECT_TRUE(in_zone(settings, prop, pose)) << k;
        const double away_m = glm::distance(pose.eye_m, pose.table_from_prop.translation);
        nearest_m = std::min(nearest_m, away_m);
        farthest_m = std::max(farthest_m, away_m);
        if (k > 0) { // no faster than a person
            EXPECT_LT(glm::distance(pose.eye_m, (*walk)[k - 1].eye_m), 4.0 / walk_hz) << k;
        }
    }
    EXPECT_GT(farthest_m, 1.1 * nearest_m);
    const Result<std::vector<BenchPose>> again = draw_walk(settings, prop, 120, 7);
    EXPECT_EQ(again->back().eye_m, walk->back().eye_m);
}

TEST(Popping, IsZeroForASteadyErrorAndMeasuresAJump) {
    image::Image<std::uint8_t> prop(4, 2);
    prop.at(0, 0) = prop.at(1, 0) = 1;
    image::Image8 truth(4, 2, glm::u8vec4(100));
    image::Image8 drawn(4, 2, glm::u8vec4(110));
    Popping popping;
    popping.add(drawn, truth, prop);
    truth.at(0, 0) = glm::u8vec4(150); // the artifact itself changes, and the picture with it
    drawn.at(0, 0) = glm::u8vec4(160);
    popping.add(drawn, truth, prop);
    EXPECT_EQ(popping.max_codes(), 0.0);
    drawn.at(1, 0) = glm::u8vec4(130); // by 20 codes, one of two pixels
    drawn.at(3, 1) = glm::u8vec4(255); // not on the prop
    popping.add(drawn, truth, prop);
    EXPECT_NEAR(popping.max_codes(), 20.0 / std::sqrt(2.0), 1e-9);
    EXPECT_EQ(popping.codes().size(), 2U);
}

TEST(GameBoard, HasANodeForEachPart) {
    const bake::SourceMesh board = make_game_board(20'000);
    EXPECT_EQ(board.nodes.size(), game_board_pieces + 1);
    EXPECT_EQ(board.triangle_nodes.size(), board.triangles.size());
    EXPECT_NEAR(static_cast<double>(board.triangles.size()), 20'000.0, 1'500.0);
}

TEST(Mixed, MeasuresBothTechniquesAtEachBudget) {
    const TemporaryFolder folder;
    bake::SourceMesh mesh;
    const pack::Pack pack = small_pack(mesh);
    const std::filesystem::path file = folder.path() / "pieces.fspack";
    ASSERT_TRUE(write_file(file, pack::write_pack(pack).value()));
    MixedOptions options;
    options.frames = 24;
    options.passes = 1;
    options.error_every = 12;
    options.budgets = 2;
    options.steps = 2;
    const Result<MixedResult> result =
        measure_mixed(near_settings(), file, std::make_shared<const bake::SourceMesh>(mesh), options,
                      [](const std::string&, double) {});
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->cells, 3U);
    ASSERT_EQ(result->rows.size(), 4U);
    for (std::size_t k = 0; k < result->rows.size(); ++k) {
        const MixedRow& row = result->rows[k];
        EXPECT_EQ(row.technique, k % 2 == 0 ? "ours" : "paper");
        EXPECT_EQ(row.frame_ms.size(), 24U);
        EXPECT_EQ(row.pop_codes.size(), 23U);
        EXPECT_GT(row.ms_p50(), 0.0);
        EXPECT_GE(row.ms_p99(), row.ms_p50());
        EXPECT_GT(row.error_mm_mean, 0.0);
        EXPECT_LT(row.error_mm_mean, 2.0); // an artifact elsewhere would be off by centimetres
        EXPECT_LT(row.silhouette_percent, 10.0);
        EXPECT_LT(row.max_pop_codes(), 40.0);
    }
    EXPECT_GE(result->rows[0].budget_us,
              result->rows[2].budget_us); // as dear as each other on a busy machine
    EXPECT_TRUE(
        mixed_csv(*result).starts_with("technique,budget_us,ms_p50,ms_p99,error_mm_mean,silhouette_pct,"
                                       "switches,pop_codes\nours,"));
}

TEST(Mixed, APackWithoutCellsIsRefused) {
    const TemporaryFolder folder;
    bake::SourceMesh mesh;
    pack::Pack pack = small_pack(mesh);
    std::erase_if(pack.sections, [](const pack::PackSection& each) { return each.name == "cells"; });
    std::erase_if(pack.section_parts, [](const auto& each) { return each.first.starts_with("cells/"); });
    const std::filesystem::path file = folder.path() / "whole.fspack";
    ASSERT_TRUE(write_file(file, pack::write_pack(pack).value()));
    const Result<MixedResult> result =
        measure_mixed(near_settings(), file, std::make_shared<const bake::SourceMesh>(mesh), {},
                      [](const std::string&, double) {});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().id, "bench.no_cells");
}

} // namespace
} // namespace frustumscreen::bench
