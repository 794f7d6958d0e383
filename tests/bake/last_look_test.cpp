#include "assets_baked/bake/last_look.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace frustumscreen {
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

bool guesses(const SourceMesh& mesh, std::string_view words) {
    const std::vector<SourceNote> notes = last_look(mesh, find_scraps(mesh));
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

TEST(LastLook, AnArtifactThatIsBlackIsTold) {
    SourceMesh mesh;
    add_square(mesh, 4, {0, 0, 0});
    EXPECT_FALSE(guesses(mesh, "black"));
    mesh.materials[0].base_colour = glm::vec4(0, 0, 0, 1);
    EXPECT_TRUE(guesses(mesh, "black"));
    mesh.materials[0].base_colour = glm::vec4(1.0F);
    mesh.textures.push_back({std::make_shared<const Image8>(Image8(2, 2, glm::u8vec4(0, 0, 0, 255)))});
    mesh.materials[0].texture = 0;
    EXPECT_TRUE(guesses(mesh, "black"));
}

TEST(LastLook, CoordinatesThatAreTooLargeForTheirSizeAreTold) {
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

} // namespace
} // namespace frustumscreen
