#include "app/programs/bench/bench_board.h"

#include "app/bench/mixed/game_board.h"
#include "app/pack/container/sha256.h"
#include "app/pack/pack_world.h"
#include "assets_baked/artifacts/write_glb.h"
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/world_cells.h"
#include "firmware_host/base/file.h"

#include <utility>

namespace frustumscreen::programs {

Result<BenchArtifact> bake_board(const std::filesystem::path& folder, bake::SourceMesh& mesh,
                                 BenchProgress& progress) {
    constexpr std::int64_t triangles = 96'000;
    mesh = bench::make_game_board(triangles);
    bake::BakeOptions options;
    options.size = 256;
    options.unlit = true;
    options.up = "y";
    options.table_picture = false;
    options.measuring = 0.3;
    options.progress = [&](std::string_view, double done) {
        progress.show("the game board's pack", 0.3 * done);
    };
    TRY(pack::Pack pack, bake::bake(mesh, options));
    pack.title = "Game board";
    const BenchArtifact made{folder / "game_board.fspack", folder / "game_board.glb"};
    TRY(const Bytes glb, artifacts::write_glb(mesh));
    TRY_VOID(write_file(made.mesh, glb));
    pack.provenance.source_name = made.mesh.filename().string();
    pack.provenance.source_sha256 = pack::sha256_hex(glb);
    pack.provenance.source_triangles = mesh.triangles.size();
    TRY(const bake::BoxFrame frame, bake::make_box_frame(mesh, {options.up, options.turn_deg, options.lift}));
    options.progress = [&](std::string_view, double done) {
        progress.show("the game board's pack", 0.3 + 0.7 * done);
    };
    bake::WorldCells cells = bake::bake_cells(mesh, frame, options);
    for (std::size_t k = 0; k < cells.cells.size(); ++k) {
        cells.geometry[k].provenance = pack.provenance;
        cells.geometry[k].provenance.source_triangles = cells.cells[k].triangles;
    }
    TRY_VOID(pack::put_world(pack, {.cells = std::move(cells.cells), .behaviours = {}}, cells.geometry));
    TRY(const Bytes bytes, pack::write_pack(pack));
    TRY_VOID(write_file(made.pack, bytes));
    return made;
}

void add_board_options(CommandLine& command, BenchArtifact& artifact) {
    command.add_option("--pack", artifact.pack, "pack with cells (default: a game board, baked into --out)");
    command.add_option("--mesh", artifact.mesh, "file that the pack was baked from");
}

Result<void> check_board_options(const BenchArtifact& artifact) {
    if (artifact.pack.empty() != artifact.mesh.empty()) {
        return bad_input("bench.pack_without_mesh", "give --pack and --mesh together, or neither of them");
    }
    return {};
}

Result<std::shared_ptr<const bake::SourceMesh>>
given_or_board(const std::filesystem::path& folder, BenchArtifact& artifact, BenchProgress& progress) {
    if (!artifact.pack.empty()) {
        TRY(LoadedArtifact loaded, load_artifact(artifact));
        return loaded.mesh;
    }
    bake::SourceMesh board;
    TRY(artifact, bake_board(folder, board, progress));
    return std::make_shared<const bake::SourceMesh>(std::move(board));
}

} // namespace frustumscreen::programs
