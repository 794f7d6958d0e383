#include "assets_baked/bake/last_look.h"
#include "assets_baked/bake/winding.h"
#include "tests/bake/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace frustumscreen::bake {
namespace {

/// A flat square of `cells` x `cells` x 2 triangles, one unit wide, at `corner`.
void add_square(SourceMesh& mesh, int cells, const glm::dvec3& corner, double side = 1.0) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const auto row = static_cast<std::uint32_t>(cells + 1);
    for (int y = 0; y <= cells; ++y) {
        for (int x = 0; x <= cells; ++x) {
            mesh.positions.push_back(corner + side / cells * glm::dvec3(x, y, 0));
        }
    }
    for (std::uint32_t y = 0; y + 1 < row; ++y) {
        for (std::uint32_t x = 0; x + 1 < row; ++x) {
            const std::uint32_t a = first + y * row + x;
            mesh.triangles.push_back({a, a + 1, a + row});
            mesh.triangles.push_back({a + 1, a + row + 1, a + row});
        }
    }
    mesh.triangle_materials.resize(mesh.triangles.size(), 0);
    mesh.materials.resize(1);
}

bool guesses(const SourceMesh& mesh, std::string_view words, Lighting lighting = Lighting::Museum) {
    const std::vector<SourceNote> notes = last_look(mesh, find_scraps(mesh), lighting);
    return std::any_of(notes.begin(), notes.end(), [&](const SourceNote& note) {
        return note.kind == SourceNote::Kind::Guessed && note.text.find(words) != std::string::npos;
    });
}

TEST(LastLook, AScrapFarAwayIsFoundAndRemoved) {
    SourceMesh mesh;
    add_square(mesh, 40, {0, 0, 0}); // 3200 triangles
    mesh.positions.insert(mesh.positions.end(), {{9, 0, 0}, {9.01, 0, 0}, {9, 0.01, 0}});
    const auto last = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.triangles.push_back({last - 3, last - 2, last - 1});
    mesh.triangle_materials.push_back(0);
    const Scraps scraps = find_scraps(mesh);
    EXPECT_EQ(scraps.triangles, 1U);
    EXPECT_NEAR(scraps.size_with, 9.01, 1e-12);
    EXPECT_NEAR(scraps.size_without, 1.0, 1e-12);
    EXPECT_TRUE(guesses(mesh, "1 of its 3201 triangles"));
    remove_scraps(mesh, scraps);
    EXPECT_EQ(mesh.triangles.size(), 3200U);
    EXPECT_EQ(find_scraps(mesh).triangles, 0U);
}

TEST(LastLook, PartsOfTheArtifactAreNoScraps) {
    SourceMesh near;
    add_square(near, 40, {0, 0, 0});
    add_square(near, 1, {1.05, 0, 0}, 0.02); // beside it
    EXPECT_EQ(find_scraps(near).triangles, 0U);
    SourceMesh pair;
    add_square(pair, 40, {0, 0, 0});
    add_square(pair, 20, {9, 0, 0}); // far away, but a fifth of all triangles
    EXPECT_EQ(find_scraps(pair).triangles, 0U);
    SourceMesh soup; // each square is a part of its own
    for (int k = 0; k < 2000; ++k) {
        add_square(soup, 1, {std::fmod(k * 0.618, 1.0), k / 2000.0, 0}, 0.001);
    }
    EXPECT_EQ(find_scraps(soup).triangles, 0U);
}

TEST(LastLook, ReportsABlackArtifact) {
    SourceMesh mesh;
    add_square(mesh, 4, {0, 0, 0});
    EXPECT_FALSE(guesses(mesh, "black"));
    mesh.materials[0].base_colour = glm::vec4(0, 0, 0, 1);
    EXPECT_TRUE(guesses(mesh, "black"));
    mesh.materials[0].base_colour = glm::vec4(1.0F);
    mesh.textures.push_back(
        {std::make_shared<const image::Image8>(image::Image8(2, 2, glm::u8vec4(0, 0, 0, 255)))});
    mesh.materials[0].texture = 0;
    EXPECT_TRUE(guesses(mesh, "black"));
}

TEST(LastLook, ReportsCoordinatesTooLargeForTheirSize) {
    SourceMesh far;
    add_square(far, 4, {4194304.0, 0, 0}, 2.0); // the step of 32 bits is 0.5 there
    EXPECT_TRUE(guesses(far, "grid"));
    SourceMesh exact;
    add_square(exact, 3, {4194304.0, 0, 0}); // thirds, which need 64 bits
    EXPECT_FALSE(guesses(exact, "grid"));
    SourceMesh near;
    add_square(near, 4, {1.0, 0, 0});
    EXPECT_FALSE(guesses(near, "grid"));
}

/// A sphere of 128 x 64 quads.
SourceMesh sphere() {
    SourceMesh mesh = test::empty_mesh();
    test::add_sphere(mesh, {0, 0, 0}, 0.5, 64);
    return mesh;
}

void turn_over(SourceMesh& mesh, std::size_t triangle) {
    std::swap(mesh.triangles[triangle][1], mesh.triangles[triangle][2]);
}

TEST(LastLook, MeasuresTheInsideOutShare) {
    SourceMesh half = sphere();
    EXPECT_EQ(inside_out_share(half), 0.0);
    for (std::size_t t = 0; t < half.triangles.size(); ++t) {
        const auto& [a, b, c] = half.triangles[t];
        if (half.positions[a].z + half.positions[b].z + half.positions[c].z < 0.0) {
            turn_over(half, t);
        }
    }
    EXPECT_NEAR(inside_out_share(half), 0.5, 1e-6) << "the lower half";
    EXPECT_TRUE(guesses(half, "about 50 % of its surface is turned inside out"));
    SourceMesh third = sphere();
    for (std::size_t t = 0; t < third.triangles.size(); t += 3) {
        turn_over(third, t);
    }
    EXPECT_NEAR(inside_out_share(third), 1.0 / 3.0, 0.01) << "every third triangle";
    SourceMesh seams = half; // each triangle has corners of its own, as in STL
    seams.positions.clear();
    for (auto& triangle : seams.triangles) {
        for (std::uint32_t& vertex : triangle) {
            seams.positions.push_back(half.positions[vertex]);
            vertex = static_cast<std::uint32_t>(seams.positions.size() - 1);
        }
    }
    EXPECT_NEAR(inside_out_share(seams), 0.5, 1e-6);
}

TEST(LastLook, WholePartsAndTwoSidedSheetsAreNotInsideOut) {
    SourceMesh all = sphere();
    for (std::size_t t = 0; t < all.triangles.size(); ++t) {
        turn_over(all, t);
    }
    test::add_sphere(all, {2, 0, 0}, 0.5, 64); // beside it, the other way round
    EXPECT_EQ(inside_out_share(all), 0.0);
    SourceMesh sheet;
    add_square(sheet, 10, {0, 0, 0});
    SourceMesh twice = sheet;
    twice.triangles.insert(twice.triangles.end(), sheet.triangles.begin(), sheet.triangles.end());
    EXPECT_EQ(inside_out_share(twice), 0.0) << "each triangle twice";
    for (std::size_t t = sheet.triangles.size(); t < twice.triangles.size(); ++t) {
        turn_over(twice, t);
    }
    EXPECT_EQ(inside_out_share(twice), 0.0) << "front and back";
    SourceMesh strip; // a Moebius strip has one side; its triangles agree everywhere but at one place
    constexpr int steps = 100;
    for (int k = 0; k < steps; ++k) {
        const double around = 2.0 * std::numbers::pi * k / steps;
        const glm::dvec3 out(std::cos(around), std::sin(around), 0.0);
        const glm::dvec3 across = std::cos(around / 2.0) * out + glm::dvec3(0, 0, std::sin(around / 2.0));
        strip.positions.push_back(out + 0.2 * across);
        strip.positions.push_back(out - 0.2 * across);
    }
    const auto last = static_cast<std::uint32_t>(strip.positions.size());
    for (std::uint32_t v = 0; v < last; v += 2) {
        const bool meets = v + 2 == last; // upside down
        const std::uint32_t c = meets ? 1 : v + 2;
        const std::uint32_t d = meets ? 0 : v + 3;
        strip.triangles.push_back({v, v + 1, c});
        strip.triangles.push_back({v + 1, d, c});
    }
    EXPECT_LT(inside_out_share(strip), 0.02);
}

/// The volume that the triangles enclose; negative if they are inside out.
double volume_of(const SourceMesh& mesh) {
    double volume = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        volume += glm::dot(mesh.positions[a], glm::cross(mesh.positions[b], mesh.positions[c])) / 6.0;
    }
    return volume;
}

TEST(LastLook, ClosedPartsAreTurnedOutward) {
    SourceMesh sound = sphere();
    test::add_box(sound, {2, 2, 2}, {3, 3, 3}); // 12 triangles
    const std::vector<std::array<std::uint32_t, 3>> truth = sound.triangles;
    EXPECT_EQ(turn_outward(sound), 0U);
    EXPECT_EQ(sound.triangles, truth);
    SourceMesh box = sound;
    for (std::size_t t = truth.size() - 12; t < truth.size(); ++t) {
        turn_over(box, t);
    }
    EXPECT_EQ(turn_outward(box), 12U);
    EXPECT_NEAR(volume_of(box), volume_of(sound), 1e-12);
    SourceMesh mixed =
        sound; // both parts, with triangles of both kinds; more than half of them are inside out
    std::mt19937 random(5);
    for (std::size_t t = 0; t < truth.size(); ++t) {
        if (random() % 5 < 3) {
            turn_over(mixed, t);
        }
    }
    EXPECT_LT(volume_of(mixed), 0.0);
    EXPECT_GT(turn_outward(mixed), truth.size() / 2);
    EXPECT_NEAR(volume_of(mixed), volume_of(sound), 1e-12);
    EXPECT_EQ(inside_out_share(mixed), 0.0);
    EXPECT_EQ(turn_outward(mixed), 0U);
}

TEST(LastLook, OpenAndHollowSurfacesAreNotTurned) {
    SourceMesh open;
    add_square(open, 10, {0, 0, 0});
    turn_over(open, 7);
    const auto square = open.triangles;
    EXPECT_EQ(turn_outward(open), 0U) << "a sheet is open";
    EXPECT_EQ(open.triangles, square);
    SourceMesh bowl = sphere(); // one triangle is missing
    for (std::size_t t = 0; t < bowl.triangles.size(); ++t) {
        turn_over(bowl, t);
    }
    bowl.triangles.erase(bowl.triangles.begin() + 1000);
    EXPECT_EQ(turn_outward(bowl), 0U);
    SourceMesh hollow; // the wall of a hollow looks inward
    hollow.materials.resize(1);
    test::add_box(hollow, {-2, -2, -2}, {2, 2, 2});
    test::add_box(hollow, {-1, -1, -1}, {1, 1, 1});
    for (std::size_t t = 12; t < 24; ++t) {
        turn_over(hollow, t);
    }
    EXPECT_EQ(turn_outward(hollow), 0U);
    turn_over(hollow, 13);
    EXPECT_EQ(turn_outward(hollow), 1U);
    EXPECT_NEAR(volume_of(hollow), 64.0 - 8.0, 1e-12);
}

/// A square with texture coordinates and a picture.
SourceMesh painted(const image::Image8& picture) {
    SourceMesh mesh;
    add_square(mesh, 4, {0, 0, 0});
    for (const glm::dvec3& position : mesh.positions) {
        mesh.uvs.emplace_back(position);
    }
    mesh.textures.push_back({std::make_shared<const image::Image8>(picture)});
    mesh.materials[0].texture = 0;
    return mesh;
}

TEST(LastLook, ReportsASingleColour) {
    image::Image8 picture(4, 4, glm::u8vec4(200, 120, 60, 255));
    EXPECT_TRUE(guesses(painted(picture),
                        "all of its colours are one, red 200, green 120, blue 60, though it has a picture"));
    picture.at(2, 1).g = 123;
    EXPECT_FALSE(guesses(painted(picture), "one"));
    SourceMesh no_uvs = painted(picture);
    std::fill(no_uvs.uvs.begin(), no_uvs.uvs.end(), glm::vec2(0.5F));
    EXPECT_TRUE(guesses(no_uvs, "shows one point of its picture"));
    SourceMesh vertices;
    add_square(vertices, 4, {0, 0, 0});
    EXPECT_FALSE(guesses(vertices, "one")) << "no colours at all, as in STL";
    vertices.colours.assign(vertices.positions.size(), glm::vec4(0.5F));
    EXPECT_TRUE(guesses(vertices, "though it has colours at its vertices"));
    vertices.colours[3].r = 0.6F;
    EXPECT_FALSE(guesses(vertices, "one"));
    vertices.colours[3] = glm::vec4(0.5F);
    vertices.materials.push_back({glm::vec4(0.5F, 1.0F, 1.0F, 1.0F)});
    EXPECT_TRUE(guesses(vertices, "all of its colours are one")) << "no triangle has the other material";
    vertices.triangle_materials[5] = 1;
    EXPECT_FALSE(guesses(vertices, "one"));
}

TEST(LastLook, ReportsLightOnEmissiveMaterials) {
    image::Image8 picture(4, 4, glm::u8vec4(200, 120, 60, 255));
    picture.at(0, 0) = glm::u8vec4(9, 9, 9, 255);
    SourceMesh mesh = painted(picture);
    mesh.materials.push_back(mesh.materials[0]);
    mesh.materials[1].has_own_light = true;
    EXPECT_FALSE(guesses(mesh, "--unlit")) << "no triangle has that material";
    for (std::size_t t = 0; t < 8; ++t) {
        mesh.triangle_materials[t] = 1;
    }
    EXPECT_TRUE(guesses(mesh, "the colours of 8 of its 32 triangles are light in the file"));
    EXPECT_FALSE(guesses(mesh, "--unlit", Lighting::None));
}

TEST(LastLook, ReportsRoundedCoordinates) {
    const auto rounded = [](double step, double size = 1.0) {
        SourceMesh mesh = sphere();
        for (glm::dvec3& position : mesh.positions) {
            position = glm::dvec3(glm::vec3(step * glm::round(size * position / step)));
        }
        return mesh;
    };
    EXPECT_TRUE(guesses(rounded(0.01), "its points are rounded to 0.01, which is 0.01 of its size"));
    EXPECT_TRUE(guesses(rounded(1.0, 150.0), "its points are rounded to 1"));
    EXPECT_FALSE(guesses(rounded(1e-4), "rounded"));
    EXPECT_FALSE(guesses(sphere(), "rounded"));
    SourceMesh blocks; // along the axes
    add_square(blocks, 40, {0, 0, 0}, 40.0);
    EXPECT_FALSE(guesses(blocks, "rounded"));
    SourceMesh few; // a body of few, large faces
    few.positions = {{0, 0, 0}, {100, 0, 0}, {0, 100, 0}, {0, 0, 100}};
    few.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    few.triangle_materials.assign(4, 0);
    few.materials.resize(1);
    EXPECT_FALSE(guesses(few, "rounded"));
}

} // namespace
} // namespace frustumscreen::bake
