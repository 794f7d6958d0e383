/// A small pack with cells, for the tests of commands that measure cells.
#pragma once

#include "app/bench/mixed/game_board.h"
#include "app/pack/pack_world.h"
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/world_cells.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace frustumscreen::bench {

/// Three parts of the board, baked small.
inline pack::Pack small_pack(bake::SourceMesh& mesh) {
    mesh = make_game_board(16'000);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> nodes;
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
        if (mesh.triangle_nodes[k] > 0 && mesh.triangle_nodes[k] < 4) {
            triangles.push_back(mesh.triangles[k]);
            nodes.push_back(mesh.triangle_nodes[k] - 1);
        }
    }
    mesh.triangles = triangles;
    mesh.triangle_nodes = nodes;
    mesh.triangle_materials.assign(triangles.size(), 0);
    mesh.nodes = {mesh.nodes[1], mesh.nodes[2], mesh.nodes[3]};
    bake::BakeOptions options;
    options.size = 96;
    options.unlit = true;
    options.up = "y";
    options.table_picture = false;
    options.measuring = 0.1;
    pack::Pack pack = bake::bake(mesh, options).value();
    pack.title = "Three pieces";
    pack.provenance.source_name = "three pieces";
    pack.provenance.source_triangles = mesh.triangles.size();
    const bake::BoxFrame frame = bake::make_box_frame(mesh, {"y", 0.0, 0.0}).value();
    bake::WorldCells cells = bake::bake_cells(mesh, frame, options);
    for (pack::Pack& geometry : cells.geometry) {
        geometry.provenance = pack.provenance;
    }
    EXPECT_TRUE(pack::put_world(pack, {.cells = cells.cells, .behaviours = {}}, cells.geometry));
    return pack;
}

} // namespace frustumscreen::bench
