#include "app/bench/room/room_pieces.h"

#include "app/bench/mixed/game_board.h"
#include "app/pack/pack_file.h"
#include "assets_baked/artifacts/atlas.h"
#include "assets_baked/artifacts/builtin.h"
#include "assets_baked/artifacts/profile.h"
#include "assets_baked/artifacts/surface.h"
#include "assets_baked/bake/bake.h"
#include "firmware_host/base/file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace frustumscreen::bench {

namespace {

using artifacts::AtlasStrip;
using artifacts::Patch;
using artifacts::Profile;
using artifacts::SurfacePoint;

constexpr double turn = 2.0 * std::numbers::pi;
constexpr int atlas_size = 512;
constexpr AtlasStrip all_rows{0, atlas_size};

/// A turned body whose radius varies around it.
struct Turned {
    std::vector<artifacts::ProfileKnot>
        outline; ///< from the middle of the underside to the end of the inside or the top
    /// Factor of the radius at an angle and a share of the height.
    std::function<double(double angle, double height)> factor;
    double height_mm = 100.0;
    glm::vec3 ground{0.8F}, vein{0.4F}; ///< sRGB, 0..1
    double bands = 8.0;
};

glm::vec3 mottled(const glm::vec3& ground, const glm::vec3& vein, double bands, float u, float v) {
    const double angle = turn * u;
    const double wave = std::sin(bands * turn * v + 2.0 * std::sin(angle) + std::sin(3.0 * angle + 11.0 * v));
    const double share = 0.6 * std::pow(0.5 + 0.5 * wave, 5.0) + 0.1 * std::sin(37.0 * turn * v) +
                         0.1 * std::sin(24.0 * angle);
    return glm::mix(ground, vein, static_cast<float>(std::clamp(share, 0.0, 1.0)));
}

image::Image8 painted(const glm::vec3& ground, const glm::vec3& vein, double bands) {
    image::Image8 texture(atlas_size, atlas_size, glm::u8vec4(128, 128, 128, 255));
    artifacts::paint_strip(all_rows, texture,
                           [&](float u, float v) { return mottled(ground, vein, bands, u, v); });
    return texture;
}

bake::SourceMesh as_mesh(const std::vector<Patch>& patches, std::int64_t triangles, image::Image8 texture) {
    bake::SourceMesh mesh = artifacts::make_mesh(patches, triangles, std::move(texture));
    mesh.is_unlit = true;
    return mesh;
}

bake::SourceMesh turned(const Turned& made, std::int64_t triangles) {
    const Profile profile(made.outline);
    Patch patch;
    patch.at = [made, profile](double u, double v) {
        const Profile::Point at = profile.at_row(v);
        const double angle = u < 1.0 ? turn * u : 0.0;
        const double radius = at.position.x * made.factor(angle, at.position.y / made.height_mm);
        return SurfacePoint{
            {radius * std::cos(angle), at.position.y, -radius * std::sin(angle)},
            {static_cast<float>(u), all_rows.v(at.length_mm / profile.length_mm(), atlas_size)}};
    };
    patch.length_u_mm = turn * 0.3 * made.height_mm;
    patch.length_v_mm = profile.length_mm();
    patch.min_u = 8;
    patch.min_v = 12;
    patch.pole_at_start = true;
    patch.pole_at_end = true;
    return as_mesh({patch}, triangles, painted(made.ground, made.vein, made.bands));
}

/// Flutes along a shaft that is plain at both ends.
Turned column() {
    return {.outline = {{0, 0, true},
                        {34, 0, true},
                        {36, 6},
                        {30, 12, true},
                        {33, 18},
                        {26, 24, true},
                        {25, 40},
                        {22, 150},
                        {21, 168, true},
                        {27, 174},
                        {32, 182, true},
                        {32, 190, true},
                        {0, 190}},
            .factor =
                [](double angle, double height) {
                    const double shaft = std::clamp(20.0 * (height - 0.15), 0.0, 1.0) *
                                         std::clamp(20.0 * (0.86 - height), 0.0, 1.0);
                    return 1.0 - 0.07 * shaft * std::pow(std::abs(std::sin(10.0 * angle)), 3.0);
                },
            .height_mm = 190.0,
            .ground = {0.86F, 0.84F, 0.78F},
            .vein = {0.60F, 0.58F, 0.55F},
            .bands = 3.0};
}

/// Lobes that wind around a hollow vase.
Turned winding_vase() {
    return {.outline = {{0, 0, true},
                        {30, 0, true},
                        {34, 6},
                        {22, 20},
                        {46, 70},
                        {52, 100},
                        {36, 140},
                        {24, 158},
                        {34, 176, true},
                        {30, 176, true},
                        {20, 157},
                        {30, 138},
                        {40, 100},
                        {20, 60},
                        {0, 56}},
            .factor =
                [](double angle, double height) {
                    const double lobes = std::sin(7.0 * angle + 5.0 * height) *
                                         std::sin(std::numbers::pi * std::clamp(height, 0.0, 1.0));
                    return 1.0 + 0.10 * lobes;
                },
            .height_mm = 176.0,
            .ground = {0.20F, 0.38F, 0.44F},
            .vein = {0.80F, 0.72F, 0.42F},
            .bands = 11.0};
}

/// A scalloped bowl on a foot.
Turned bowl() {
    return {.outline = {{0, 0, true},
                        {30, 0, true},
                        {32, 4},
                        {16, 14, true},
                        {14, 22},
                        {46, 44},
                        {72, 78},
                        {76, 96, true},
                        {72, 96, true},
                        {66, 78},
                        {42, 50},
                        {0, 34}},
            .factor =
                [](double angle, double height) {
                    const double rim = std::clamp(2.0 * (height - 0.3), 0.0, 1.0);
                    return 1.0 + 0.06 * rim * std::cos(14.0 * angle);
                },
            .height_mm = 96.0,
            .ground = {0.70F, 0.32F, 0.18F},
            .vein = {0.20F, 0.12F, 0.10F},
            .bands = 6.0};
}

/// A square block with mouldings.
Turned plinth() {
    return {.outline = {{0, 0, true},
                        {58, 0, true},
                        {58, 14, true},
                        {50, 20},
                        {48, 28, true},
                        {46, 30, true},
                        {46, 168, true},
                        {50, 172},
                        {54, 178, true},
                        {54, 190, true},
                        {0, 190}},
            .factor =
                [](double angle, double) {
                    const double side = std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
                    return std::min(1.0 / side, 1.36); // the corners are cut a little
                },
            .height_mm = 190.0,
            .ground = {0.58F, 0.57F, 0.54F},
            .vein = {0.44F, 0.43F, 0.42F},
            .bands = 2.0};
}

/// A slab with panels in shallow relief on its face (the +Z side), standing upright.
bake::SourceMesh slab(double wide_mm, double high_mm, double thick_mm, const glm::dvec2& panels,
                      double relief_mm, std::int64_t triangles, image::Image8 texture) {
    const auto uv = [](double u, double v) {
        return glm::vec2(static_cast<float>(0.002 + 0.996 * u), static_cast<float>(0.002 + 0.996 * v));
    };
    const auto groove = [panels, relief_mm](double u, double v) {
        const double across = std::abs(std::sin(std::numbers::pi * panels.x * u));
        const double along = std::abs(std::sin(std::numbers::pi * panels.y * v));
        return -relief_mm * std::exp(-60.0 * std::pow(std::min(across, along), 2.0));
    };
    Patch front;
    front.at = [=](double u, double v) {
        return SurfacePoint{{(u - 0.5) * wide_mm, v * high_mm, thick_mm + groove(u, v)}, uv(u, v)};
    };
    front.length_u_mm = wide_mm;
    front.length_v_mm = high_mm;
    front.min_u = 24;
    front.min_v = 24;
    Patch back = front;
    back.at = [=](double u, double v) {
        return SurfacePoint{{(0.5 - u) * wide_mm, v * high_mm, 0.0}, uv(u, v)};
    };
    back.length_u_mm = back.length_v_mm = 1.0;
    back.min_u = back.min_v = 2;
    return as_mesh({front, back}, triangles, std::move(texture));
}

/// The slab lies on its back.
bake::SourceMesh laid_down(bake::SourceMesh mesh) {
    for (glm::dvec3& position : mesh.positions) {
        position = {position.x, position.z, -position.y};
    }
    return mesh;
}

} // namespace

Result<std::vector<RoomPiece>> make_room_pieces(std::int64_t triangles) {
    std::vector<RoomPiece> pieces;
    for (const std::string_view name : artifacts::builtin_names()) {
        if (name == "amphora" || name == "nautilus-cup") {
            TRY(bake::SourceMesh mesh, artifacts::make_builtin(name, triangles));
            mesh.is_unlit = true;
            pieces.push_back({std::string(name), PieceUse::Artifact, std::move(mesh)});
        }
    }
    for (const GamePiece piece : {GamePiece::Pawn, GamePiece::Rook, GamePiece::Bishop, GamePiece::King}) {
        pieces.push_back(
            {std::string(name_of(piece)), PieceUse::Artifact, make_game_piece(piece, triangles)});
    }
    pieces.push_back({"column", PieceUse::Artifact, turned(column(), triangles)});
    pieces.push_back({"winding-vase", PieceUse::Artifact, turned(winding_vase(), triangles)});
    pieces.push_back({"bowl", PieceUse::Artifact, turned(bowl(), triangles)});
    const std::int64_t plain = std::max<std::int64_t>(1000, triangles / 10);
    pieces.push_back({"plinth", PieceUse::Plinth, turned(plinth(), plain)});
    pieces.push_back({"wall", PieceUse::Wall,
                      slab(6400.0, 2000.0, 60.0, {8.0, 2.0}, 15.0, plain,
                           painted({0.55F, 0.53F, 0.50F}, {0.47F, 0.45F, 0.43F}, 4.0))});
    pieces.push_back({"floor", PieceUse::Floor,
                      laid_down(slab(6400.0, 6400.0, 40.0, {16.0, 16.0}, 4.0, plain,
                                     painted({0.36F, 0.30F, 0.26F}, {0.25F, 0.21F, 0.19F}, 9.0)))});
    return pieces;
}

Result<void> bake_piece(const bench::RoomPiece& piece, const std::filesystem::path& file, int size) {
    bake::BakeOptions options;
    options.size = size;
    options.unlit = true;
    options.up = "y";
    options.table_picture = false;
    options.measuring = 0.2;
    TRY(pack::Pack pack, bake::bake(piece.mesh, options));
    pack.title = piece.name;
    pack.provenance.source_name = piece.name;
    pack.provenance.source_triangles = piece.mesh.triangles.size();
    TRY(const Bytes bytes, pack::write_pack(pack));
    return write_file(file, bytes);
}

} // namespace frustumscreen::bench
