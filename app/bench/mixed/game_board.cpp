#include "app/bench/mixed/game_board.h"

#include "assets_baked/artifacts/atlas.h"
#include "assets_baked/artifacts/profile.h"
#include "assets_baked/artifacts/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace frustumscreen::bench {

namespace {

using artifacts::AtlasStrip;
using artifacts::Patch;
using artifacts::Profile;
using artifacts::SurfacePoint;

constexpr double turn = 2.0 * std::numbers::pi;
constexpr int atlas_size = 1024;
constexpr AtlasStrip board_rows{0, 512}, light_rows{520, 240}, dark_rows{772, 240};

constexpr double square_mm = 30.0;
constexpr int squares = 6;
constexpr double border_mm = 14.0;
constexpr double half_mm = 0.5 * square_mm * squares + border_mm;
constexpr double thick_mm = 12.0;

/// One kind of piece: its outline, and ribs that run up its shaft.
struct Kind {
    std::string_view name;
    std::vector<artifacts::ProfileKnot> outline; ///< from the middle of the underside to the top
    double ribs = 0.0;                           ///< their number
    double rib_mm = 0.0;                         ///< their height
    double shaft_from_mm = 0.0, shaft_to_mm = 0.0;
};

std::array<Kind, 4> kinds() {
    return {{{"pawn",
              {{0, 0, true},
               {11, 0, true},
               {11.5, 3},
               {9, 6, true},
               {6, 10},
               {4.6, 18},
               {5, 22, true},
               {8, 23},
               {5, 25, true},
               {7.4, 29},
               {8, 32},
               {6.4, 37},
               {0, 39.5}},
              14.0,
              0.5,
              8.0,
              22.0},
             {"rook",
              {{0, 0, true},
               {12.5, 0, true},
               {13, 4},
               {10.5, 7, true},
               {8.6, 12},
               {7.4, 24},
               {7.8, 32, true},
               {10.5, 34},
               {10.5, 43, true},
               {7.2, 43, true},
               {7.0, 38, true},
               {0, 37.5}},
              10.0,
              0.8,
              9.0,
              32.0},
             {"bishop",
              {{0, 0, true},
               {12.5, 0, true},
               {13, 4},
               {10, 7.5, true},
               {6.6, 14},
               {5, 28},
               {5.6, 34, true},
               {9, 35.5},
               {5.6, 38, true},
               {8.4, 44},
               {7, 50},
               {2.4, 56, true},
               {3, 58.5},
               {0, 60.5}},
              18.0,
              0.5,
              10.0,
              34.0},
             {"king",
              {{0, 0, true},
               {13.5, 0, true},
               {14, 4.5},
               {11, 8.5, true},
               {7.6, 16},
               {5.8, 34},
               {6.4, 42, true},
               {10.4, 44},
               {6.8, 47, true},
               {8.4, 54},
               {10.2, 62, true},
               {8, 64},
               {3, 66.5, true},
               {4.4, 70.5},
               {0, 74}},
              12.0,
              0.7,
              12.0,
              42.0}}};
}

struct Place {
    std::size_t kind = 0;
    int column = 0, row = 0;
    bool is_dark = false;
};
constexpr std::array<Place, game_board_pieces> places{{{1, 0, 0, false},
                                                       {2, 1, 0, false},
                                                       {3, 3, 0, false},
                                                       {0, 0, 1, false},
                                                       {0, 2, 1, false},
                                                       {0, 4, 1, false},
                                                       {2, 3, 2, false},
                                                       {1, 5, 5, true},
                                                       {2, 4, 5, true},
                                                       {3, 2, 5, true},
                                                       {0, 1, 4, true},
                                                       {0, 3, 4, true},
                                                       {0, 5, 3, true},
                                                       {1, 0, 4, true}}};

double centre_mm(int square) {
    return (square + 0.5) * square_mm - 0.5 * square_mm * squares;
}

/// Smooth, 0 at both ends.
double swell(double at, double from, double to) {
    return at > from && at < to ? std::sin(std::numbers::pi * (at - from) / (to - from)) : 0.0;
}

Patch turned(const Kind& kind, const glm::dvec3& foot, const AtlasStrip& rows) {
    Patch patch;
    const Profile profile(kind.outline);
    patch.at = [kind, foot, rows, profile](double u, double v) {
        const Profile::Point at = profile.at_row(v);
        const double angle = u < 1.0 ? turn * u : 0.0;
        const double rib = kind.rib_mm * std::pow(std::abs(std::cos(0.5 * kind.ribs * angle)), 3.0) *
                           swell(at.position.y, kind.shaft_from_mm, kind.shaft_to_mm);
        const double radius = at.position.x + rib;
        return SurfacePoint{
            foot + glm::dvec3(radius * std::cos(angle), at.position.y, -radius * std::sin(angle)),
            {static_cast<float>(u), rows.v(at.length_mm / profile.length_mm(), atlas_size)}};
    };
    patch.length_u_mm = turn * 8.0;
    patch.length_v_mm = profile.length_mm();
    patch.min_u = 8;
    patch.min_v = 12;
    patch.pole_at_start = true;
    patch.pole_at_end = true;
    return patch;
}

glm::vec2 board_uv(double x, double z) {
    return {static_cast<float>(0.5 + 0.498 * x / half_mm),
            board_rows.v(0.5 + 0.498 * z / half_mm, atlas_size)};
}

/// The grooves between squares and the waves of the border; 0 at the board's edge.
double board_relief_mm(double x, double z) {
    const double out = std::max(std::abs(x), std::abs(z));
    const double inner = half_mm - border_mm;
    if (out > inner) {
        const double along = std::abs(x) > std::abs(z) ? z : x;
        return 1.4 * swell(out, inner, half_mm - 1.0) * (1.0 + 0.6 * std::sin(0.5 * along));
    }
    const auto to_line = [](double at) {
        const double in_squares = (at + 0.5 * square_mm * squares) / square_mm;
        return square_mm * std::abs(in_squares - std::round(in_squares));
    };
    const double nearest = std::min(to_line(x), to_line(z));
    return -0.7 * std::exp(-nearest * nearest / 1.2);
}

std::vector<Patch> board_patches() {
    Patch top;
    top.at = [](double u, double v) {
        const double x = (2.0 * u - 1.0) * half_mm;
        const double z = (1.0 - 2.0 * v) * half_mm;
        return SurfacePoint{{x, board_relief_mm(x, z), z}, board_uv(x, z)};
    };
    top.length_u_mm = top.length_v_mm = 2.0 * half_mm;
    Patch under = top;
    under.at = [](double u, double v) {
        const double x = (2.0 * u - 1.0) * half_mm;
        const double z = (2.0 * v - 1.0) * half_mm;
        return SurfacePoint{{x, -thick_mm, z}, board_uv(x, z)};
    };
    under.length_u_mm = under.length_v_mm = 8.0; // flat
    std::vector<Patch> patches{top, under};
    for (int side = 0; side < 4; ++side) {
        Patch wall;
        wall.at = [side](double u, double v) {
            const double along = (2.0 * u - 1.0) * half_mm;
            const std::array<glm::dvec2, 4> xz{
                {{along, half_mm}, {half_mm, -along}, {-along, -half_mm}, {-half_mm, along}}};
            const glm::dvec2 at = xz.at(static_cast<std::size_t>(side));
            return SurfacePoint{{at.x, thick_mm * (v - 1.0), at.y}, board_uv(at.x, at.y)};
        };
        wall.length_u_mm = 2.0 * half_mm;
        wall.length_v_mm = thick_mm;
        patches.push_back(wall);
    }
    return patches;
}

/// Turned stone: bands along the height, veins around it.
glm::vec3 stone(float u, float v, const glm::vec3& ground, const glm::vec3& vein) {
    const double angle = turn * u;
    const double wave = std::sin(9.0 * v * turn + 2.0 * std::sin(angle) + std::sin(3.0 * angle + 14.0 * v));
    const double share = 0.55 * std::pow(0.5 + 0.5 * wave, 6.0) + 0.12 * std::sin(40.0 * turn * v);
    return glm::mix(ground, vein, static_cast<float>(std::clamp(share, 0.0, 1.0)));
}

glm::vec3 board_colour(float u, float v) {
    const double x = (2.0 * u - 1.0) * half_mm;
    const double z = (2.0 * v - 1.0) * half_mm;
    const double grain = 0.06 * std::sin(1.9 * x + 2.0 * std::sin(0.11 * z)) + 0.04 * std::sin(0.7 * x);
    const double inner = half_mm - border_mm;
    glm::vec3 wood(0.45F, 0.26F, 0.13F);
    if (std::max(std::abs(x), std::abs(z)) < inner) {
        const auto column = static_cast<int>((x + inner) / square_mm);
        const auto row = static_cast<int>((z + inner) / square_mm);
        wood = (column + row) % 2 == 0 ? glm::vec3(0.30F, 0.17F, 0.09F) : glm::vec3(0.83F, 0.70F, 0.48F);
    }
    return glm::clamp(wood + static_cast<float>(grain), glm::vec3(0.0F), glm::vec3(1.0F));
}

image::Image8 paint() {
    image::Image8 texture(atlas_size, atlas_size, glm::u8vec4(90, 70, 50, 255));
    artifacts::paint_strip(board_rows, texture, board_colour);
    artifacts::paint_strip(light_rows, texture, [](float u, float v) {
        return stone(u, v, {0.90F, 0.85F, 0.74F}, {0.62F, 0.42F, 0.22F});
    });
    artifacts::paint_strip(dark_rows, texture, [](float u, float v) {
        return stone(u, v, {0.32F, 0.13F, 0.12F}, {0.75F, 0.50F, 0.32F});
    });
    return texture;
}

/// `part` becomes a node of its own, with its origin at `foot`.
void add_node(const bake::SourceMesh& part, std::string name, const glm::dvec3& foot,
              bake::SourceMesh& whole) {
    const auto first = static_cast<std::uint32_t>(whole.positions.size());
    const auto node = static_cast<std::uint32_t>(whole.nodes.size());
    whole.positions.insert(whole.positions.end(), part.positions.begin(), part.positions.end());
    whole.uvs.insert(whole.uvs.end(), part.uvs.begin(), part.uvs.end());
    for (const auto& [a, b, c] : part.triangles) {
        whole.triangles.push_back({first + a, first + b, first + c});
    }
    whole.triangle_materials.resize(whole.triangles.size(), 0);
    whole.triangle_nodes.resize(whole.triangles.size(), node);
    bake::SourceNode made;
    made.name = std::move(name);
    made.rest.translation = foot;
    whole.nodes.push_back(std::move(made));
}

} // namespace

bake::SourceMesh make_game_board(std::int64_t triangles) {
    constexpr std::int64_t min_triangles = 1000;
    const std::int64_t of_each = std::max(min_triangles, triangles / (std::int64_t{game_board_pieces} + 2));
    const std::int64_t of_board = std::max(min_triangles, 2 * of_each);
    image::Image8 texture = paint();
    bake::SourceMesh whole;
    add_node(artifacts::make_mesh(board_patches(), of_board, image::Image8(1, 1)), "board", glm::dvec3(0.0),
             whole);
    const std::array<Kind, 4> all = kinds();
    for (std::size_t k = 0; k < places.size(); ++k) {
        const Place& place = places[k];
        const glm::dvec3 foot(centre_mm(place.column), 0.4,
                              -centre_mm(place.row)); // clear of the board's relief
        const Patch patch = turned(all.at(place.kind), foot, place.is_dark ? dark_rows : light_rows);
        add_node(artifacts::make_mesh({patch}, of_each, image::Image8(1, 1)),
                 std::string(all.at(place.kind).name) + " " + std::to_string(k + 1), foot, whole);
    }
    whole.textures.push_back(
        {std::make_shared<const image::Image8>(std::move(texture)), bake::Wrap::Repeat, bake::Wrap::Clamp});
    whole.materials.push_back({.texture = 0});
    whole.is_unlit = true;
    return whole;
}

std::string_view name_of(GamePiece piece) {
    static const std::array<Kind, 4> all = kinds();
    return all.at(static_cast<std::size_t>(piece)).name;
}

bake::SourceMesh make_game_piece(GamePiece piece, std::int64_t triangles) {
    const Patch patch = turned(kinds().at(static_cast<std::size_t>(piece)), glm::dvec3(0.0), light_rows);
    bake::SourceMesh mesh = artifacts::make_mesh({patch}, std::max<std::int64_t>(1000, triangles), paint());
    mesh.is_unlit = true;
    return mesh;
}

} // namespace frustumscreen::bench
