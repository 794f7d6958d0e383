#include "tests/loaders/loaders_testing.h"

#include <gtest/gtest.h>

#include <limits>

namespace frustumscreen::testing {
namespace {

std::string binary_stl(const std::vector<std::array<float, 9>>& facets,
                       std::string header = "made for a test") {
    header.resize(80, ' ');
    std::string file = header + bytes_of(std::vector{static_cast<std::uint32_t>(facets.size())});
    for (const std::array<float, 9>& facet : facets) {
        file += std::string(12, '\0');
        file += bytes_of(std::vector<float>(facet.begin(), facet.end()));
        file += std::string(2, '\0');
    }
    return file;
}

const std::array<float, 9> facet = {0, 0, 0, 2, 0, 0, 0, 3, 0};

constexpr std::string_view ascii = "solid a name with words\n"
                                   " facet normal 0 0 1\n  outer loop\n"
                                   "   vertex 0 0 0\n   vertex 2 0 0\n   vertex 0 3 0\n"
                                   "  endloop\n endfacet\nendsolid a name with words\n";

TEST(Stl, BinaryAndAsciiGiveTheSameTriangle) {
    for (const std::string& file : {binary_stl({facet}), std::string(ascii)}) {
        const Result<bake::SourceMesh> mesh = load_text("part.stl", file);
        ASSERT_TRUE(mesh.has_value()) << mesh.error().message;
        expect_sound(*mesh);
        EXPECT_EQ(mesh->triangles.size(), 1U);
        EXPECT_EQ(mesh->positions[1], glm::dvec3(2, 0, 0));
        EXPECT_EQ(mesh->default_up, 'z');
        EXPECT_NEAR(area_of(*mesh), 3.0, 1e-12);
    }
}

TEST(Stl, ABinaryFileMayBeginWithSolid) {
    const Result<bake::SourceMesh> mesh =
        load_text("part.stl", binary_stl({facet, facet}, "solid from some tool"));
    ASSERT_TRUE(mesh.has_value()) << mesh.error().message;
    EXPECT_EQ(mesh->triangles.size(), 2U);
}

TEST(Stl, DetectsTheFormatByContentNotByName) {
    EXPECT_TRUE(load_text("part.obj", binary_stl({facet})).has_value());
    EXPECT_TRUE(load_text("part.ply", std::string(ascii)).has_value());
}

/// Words of the notes on losses; empty: nothing is lost.
std::string losses_of(const Result<bake::SourceMesh>& mesh) {
    std::string losses;
    for (const bake::SourceNote& note : mesh ? mesh->notes : std::vector<bake::SourceNote>()) {
        losses += note.kind == bake::SourceNote::Kind::Lost ? note.text : std::string();
    }
    return losses;
}

TEST(Stl, ReportsColoursThatAreNotRead) {
    std::string file = binary_stl({facet, facet, facet});
    EXPECT_EQ(losses_of(load_text("part.stl", file)), "");
    file[84 + 2 * 50 - 1] = '\x80'; // of the second triangle
    EXPECT_NE(losses_of(load_text("part.stl", file)).find("beside 1 triangle"), std::string::npos);
    std::string text(ascii);
    EXPECT_EQ(losses_of(load_text("part.stl", text)), "");
    text.insert(text.find("endfacet"), "color 1 0 0\n ");
    const std::string losses = losses_of(load_text("part.stl", text));
    EXPECT_NE(losses.find("does not have: color"), std::string::npos) << losses;
}

TEST(Stl, UpperCaseWordsAndSeveralSolidsAreRead) {
    std::string text(ascii);
    for (char& c : text) {
        c = static_cast<char>(std::toupper(c));
    }
    const Result<bake::SourceMesh> mesh = load_text("part.stl", text + std::string(ascii));
    ASSERT_TRUE(mesh.has_value()) << mesh.error().message;
    EXPECT_EQ(mesh->triangles.size(), 2U);
}

TEST(Stl, ATruncatedFileIsRefused) {
    const std::string binary = binary_stl({facet, facet});
    EXPECT_NE(error_of(load_text("part.stl", binary.substr(0, 150))).find("[mesh.cut_short]"),
              std::string::npos);
    EXPECT_NE(error_of(load_text("part.stl", ascii.substr(0, 100))).find("[mesh.cut_short]"),
              std::string::npos);
    EXPECT_NE(error_of(load_text("part.stl", binary.substr(0, 20))).find("84"), std::string::npos);
}

TEST(Stl, RejectsAnInvalidPositionAndNamesItsPlace) {
    std::array<float, 9> bad = facet;
    bad[4] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NE(error_of(load_text("part.stl", binary_stl({facet, bad}))).find("vertex 4"), std::string::npos);
    std::string text(ascii);
    text.replace(text.find("2 0 0"), 1, "x");
    EXPECT_NE(error_of(load_text("part.stl", text)).find("line 5"), std::string::npos);
    text.replace(text.find(" x 0 0"), 2, " inf");
    EXPECT_NE(error_of(load_text("part.stl", text)).find("vertex 1"), std::string::npos);
}

TEST(Stl, NoTrianglesAreRefused) {
    EXPECT_NE(error_of(load_text("part.stl", binary_stl({}))).find("no triangles"), std::string::npos);
    EXPECT_NE(error_of(load_text("part.stl", "solid x\nendsolid x\n")).find("no triangles"),
              std::string::npos);
}

TEST(Stl, AFacetWithFourVerticesIsRefused) {
    std::string text(ascii);
    text.insert(text.find("   vertex"), "   vertex 1 1 1\n");
    EXPECT_NE(error_of(load_text("part.stl", text)).find("4 vertices"), std::string::npos);
}

} // namespace
} // namespace frustumscreen::testing
