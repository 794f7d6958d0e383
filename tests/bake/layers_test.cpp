// The layers of a torch: what a pack shows in place of its texture and of its reliefs' colours is held against the layer's
// own colour, a function of the place in the file, at points of the surface.
#include "app/pack/pack_relief.h"
#include "app/pack/pack_torches.h"
#include "app/relief/block_relief.h"
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/world_cells.h"
#include "tests/bake/shapes.h"

#include <glm/gtc/matrix_inverse.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace frustumscreen::bake {

namespace {

constexpr double radius = 2.0;

/// Texture coordinates of a place on the sphere: seen along y.
glm::dvec2 uv_at(const glm::dvec3& place) {
    return 0.5 + 0.45 * glm::dvec2(place.x, place.z) / radius;
}

/// sRGB codes and alpha.
using Codes = std::function<glm::dvec4(const glm::dvec2& uv)>;

glm::dvec4 coloured(const glm::dvec2& uv) {
    return {40.0 + 180.0 * uv.x, 230.0 - 150.0 * uv.y, 60.0 + 90.0 * (uv.x + uv.y), 255.0};
}
glm::dvec4 partly(const glm::dvec2& uv) {
    glm::dvec4 codes = coloured({uv.y, uv.x});
    codes.w = 255.0 * std::clamp(uv.x * 1.5 - 0.25, 0.0, 1.0);
    return codes;
}

SourceLayer layer_of(const Codes& codes, const char* name, bool lit) {
    constexpr int size = 256;
    auto picture = std::make_shared<image::Image8>(size, size);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            picture->at(x, y) = glm::u8vec4(codes({(x + 0.5) / size, (y + 0.5) / size}) + 0.5);
        }
    }
    SourceLayer layer;
    layer.name = name;
    layer.lit = lit;
    layer.looks = {{glm::vec4(1.0F), 0}};
    layer.textures = {{picture, Wrap::Clamp, Wrap::Clamp}};
    return layer;
}

/// White, so that its own texture is the light.
SourceMesh sphere() {
    SourceMesh mesh = test::empty_mesh();
    test::add_sphere(mesh, {1, 2, 3}, radius, 24);
    for (const glm::dvec3& place : mesh.positions) {
        mesh.uvs.emplace_back(uv_at(place - glm::dvec3(1, 2, 3)));
    }
    return mesh;
}

BakeOptions quick() {
    BakeOptions options;
    options.size = 96;
    options.measuring = 0.05;
    options.up = "z";
    options.turn_deg = 20.0;
    options.table_picture = false;
    return options;
}

glm::dvec4 sampled(const image::Image8& picture, const glm::dvec2& uv) {
    const glm::dvec2 at = uv * glm::dvec2(picture.width, picture.height) - 0.5;
    const glm::ivec2 first(glm::floor(at));
    const glm::dvec2 f = at - glm::dvec2(first);
    const auto texel = [&](int x, int y) {
        return glm::dvec4(
            picture.at(std::clamp(x, 0, picture.width - 1), std::clamp(y, 0, picture.height - 1)));
    };
    return glm::mix(glm::mix(texel(first.x, first.y), texel(first.x + 1, first.y), f.x),
                    glm::mix(texel(first.x, first.y + 1), texel(first.x + 1, first.y + 1), f.x), f.y);
}

glm::dvec4 linear(const glm::dvec4& codes) {
    return {image::linear_from_srgb(codes.x / 255.0), image::linear_from_srgb(codes.y / 255.0),
            image::linear_from_srgb(codes.z / 255.0), codes.w};
}

struct Difference {
    double mean = 0.0, max = 0.0; ///< codes, alpha included
    std::size_t points = 0;

    void add(const glm::dvec4& found, const glm::dvec4& expected) {
        glm::dvec4 apart = glm::abs(found - expected);
        if (expected.w < 32.0) {
            apart = {0.0, 0.0, 0.0, apart.w}; // hardly anything of the colour is seen
        }
        const double worst = std::max({apart.x, apart.y, apart.z, apart.w});
        mean = (mean * static_cast<double>(points) + worst) / static_cast<double>(points + 1);
        max = std::max(max, worst);
        ++points;
    }
};

/// Calls at(place in the file, uv of the pack's texture) at the middle of each triangle of a level.
void for_each_middle(const pack::Pack& pack, const pack::PackLevel& level, const auto& at) {
    const glm::dmat4 file_from_box = glm::inverse(pack.box_from_file);
    for (std::size_t k = 0; k < level.indices.size(); k += 3) {
        glm::dvec3 place(0.0);
        glm::dvec2 uv(0.0);
        for (std::size_t c = 0; c < 3; ++c) {
            const pack::PackVertex& vertex = level.vertices[level.indices[k + c]];
            const glm::dvec3 share =
                glm::dvec3(vertex.position[0], vertex.position[1], vertex.position[2]) / 65535.0;
            place += (share * pack.box_size - glm::dvec3(0.5, 0.5, 0.0) * pack.box_size) / 3.0;
            uv += glm::dvec2(vertex.uv[0], vertex.uv[1]) / 65535.0 / 3.0;
        }
        at(glm::dvec3(file_from_box * glm::dvec4(place, 1.0)), uv);
    }
}

/// Calls at(place in the file, number of the colour) at the corners of each whole cell.
void for_each_corner(const pack::Pack& pack, const relief::BlockRelief& relief, const auto& at) {
    const glm::dmat4 file_from_box = glm::inverse(pack.box_from_file);
    for (std::size_t g = 0; g < relief.grids.size(); ++g) {
        for (std::size_t b = relief.first_block[g]; b < relief.first_block[g + 1]; ++b) {
            const std::uint64_t whole = relief.blocks[b].mask & ~relief.blocks[b].cut;
            for (std::size_t cell = 0; cell < 64; ++cell) {
                if ((whole >> cell & 1U) != 0) {
                    const glm::dvec3 place = relief::corner_in_box(relief, relief.grids[g], b, cell, 0);
                    at(glm::dvec3(file_from_box * glm::dvec4(place, 1.0)),
                       81 * b + 9 * (cell / 8) + cell % 8);
                }
            }
        }
    }
}

glm::dvec2 uv_in_file(const glm::dvec3& place) {
    return uv_at(place - glm::dvec3(1, 2, 3));
}

} // namespace

TEST(Layers, show_their_own_colour_on_every_level_and_relief) {
    SourceMesh mesh = sphere();
    mesh.layers = {layer_of(coloured, "all", false), layer_of(partly, "partly", false)};
    const Result<pack::Pack> pack = bake(mesh, quick());
    ASSERT_TRUE(pack) << pack.error().message;
    ASSERT_TRUE(pack::check_torches(*pack));
    const pack::PackTorches torches = pack::torches_of(*pack).value();
    ASSERT_EQ(torches.layers.size(), 2U);
    const std::vector<pack::ReliefOutline> reliefs = pack::reliefs_of(*pack).value();
    ASSERT_FALSE(reliefs.empty());
    for (const auto& [number, codes] : {std::pair<std::size_t, Codes>(0, coloured), {1, partly}}) {
        const image::Image8 texture = pack::layer_texture_of(*pack, torches.layers[number], 0).value();
        for (const pack::PackLevel& level : pack->levels) {
            Difference difference;
            for_each_middle(*pack, level, [&](const glm::dvec3& place, const glm::dvec2& uv) {
                difference.add(sampled(texture, uv), codes(uv_in_file(place)));
            });
            EXPECT_GT(difference.points, 50U);
            EXPECT_LT(difference.mean, 2.0);
            EXPECT_LT(difference.max, 16.0); // a quarter of a texel off the coarsest level's middle
        }
        for (std::size_t r = 0; r < reliefs.size(); ++r) {
            const relief::BlockRelief relief = pack::relief_of(*pack, reliefs[r]).value();
            const std::vector<glm::u8vec4> colours =
                pack::layer_colours_of(*pack, torches.layers[number], r, relief.colours.size()).value();
            Difference difference;
            for_each_corner(*pack, relief, [&](const glm::dvec3& place, std::size_t colour) {
                difference.add(glm::dvec4(colours[colour]), codes(uv_in_file(place)));
            });
            EXPECT_GT(difference.points, 500U);
            EXPECT_LT(difference.mean, 2.5);
        }
    }
}

TEST(Layers, are_lit_like_the_artifact_only_if_marked_lit) {
    SourceMesh mesh = sphere();
    mesh.layers = {layer_of(coloured, "lit", true), layer_of(coloured, "plain", false)};
    BakeOptions options = quick();
    options.relief = false;
    const pack::Pack pack = bake(mesh, options).value();
    const pack::PackTorches torches = pack::torches_of(pack).value();
    const image::Image8 lit = pack::layer_texture_of(pack, torches.layers[0], 0).value();
    const image::Image8 plain = pack::layer_texture_of(pack, torches.layers[1], 0).value();
    double worst = 0.0;
    double darkest = 1.0;
    for_each_middle(pack, pack.levels.back(), [&](const glm::dvec3& /*place*/, const glm::dvec2& uv) {
        const glm::dvec4 light = linear(sampled(pack.textures[0], uv)); // of a white surface
        const glm::dvec3 apart =
            glm::dvec3(linear(sampled(lit, uv))) - glm::dvec3(linear(sampled(plain, uv))) * glm::dvec3(light);
        worst = std::max({worst, std::abs(apart.x), std::abs(apart.y), std::abs(apart.z)});
        darkest = std::min(darkest, light.x);
    });
    EXPECT_LT(worst, 0.02);
    EXPECT_LT(darkest, 0.8) << "the light tells nothing if it is the same everywhere";
}

TEST(Layers, change_nothing_else_of_the_pack) {
    const SourceMesh plain = sphere();
    SourceMesh layered = sphere();
    layered.layers = {layer_of(partly, "partly", true)};
    const pack::Pack before = bake(plain, quick()).value();
    const pack::Pack after = bake(layered, quick()).value();
    EXPECT_EQ(before.textures[0].texels, after.textures[0].texels);
    ASSERT_EQ(before.levels.size(), after.levels.size());
    for (std::size_t k = 0; k < before.levels.size(); ++k) {
        EXPECT_EQ(before.levels[k].indices, after.levels[k].indices);
        EXPECT_EQ(before.levels[k].error, after.levels[k].error);
    }
    for (const auto& [name, bytes] : before.section_parts) {
        EXPECT_EQ(after.section_parts.at(name), bytes) << name;
    }
    EXPECT_TRUE(pack::torches_of(before).value().empty());
    EXPECT_EQ(before.sections.size() + 1, after.sections.size());
}

TEST(Layers, are_in_the_pack_of_each_cell) {
    SourceMesh mesh = sphere();
    mesh.triangle_nodes.assign(mesh.triangles.size(), 0);
    mesh.nodes = {{.name = "ball", .parent = {}, .parent_from_base = glm::dmat4(1.0), .rest = {}}};
    mesh.layers = {layer_of(coloured, "all", false)};
    BakeOptions options = quick();
    options.torches.contents.push_back({{.name = "x-ray", .stages = {{.source = torch::Source::Layer}}}, {}});
    const BoxFrame frame = make_box_frame(mesh, {options.up, options.turn_deg, options.lift}).value();
    const WorldCells cells = bake_cells(mesh, frame, options);
    ASSERT_EQ(cells.geometry.size(), 1U);
    const pack::PackTorches torches = pack::torches_of(cells.geometry[0]).value();
    EXPECT_TRUE(torches.contents.empty());
    ASSERT_EQ(torches.layers.size(), 1U);
    EXPECT_TRUE(pack::check_torches(cells.geometry[0]));
    EXPECT_EQ(torches.layers[0].name, "all");
}

} // namespace frustumscreen::bake
