// Files that are given back while they are read, and tables that take the place of maps.
#include "assets_baked/bake/loaders/load_bytes.h"
#include "assets_baked/bake/loaders/model_file.h"
#include "assets_baked/bake/loaders/vertex_numbers.h"
#include "tests/loaders/loaders_testing.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <random>

namespace frustumscreen::testing {
namespace {

constexpr std::size_t mib = std::size_t{1} << 20U;

TEST(LargeFiles, ReleasesPassedBytesAndKeepsTheOthers) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.write("model.bin", std::string(40 * mib, 'x'));
    Result<bake::ModelFile> file = bake::ModelFile::read(path);
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_EQ(file->bytes().size(), 40 * mib);
    file->passed(15 * mib);
    EXPECT_EQ(file->bytes()[0], std::byte{'x'});
    file->passed(33 * mib);
    EXPECT_EQ(file->bytes()[0], std::byte{0});
    EXPECT_EQ(file->bytes()[32 * mib - 1], std::byte{0});
    EXPECT_EQ(file->bytes()[32 * mib], std::byte{'x'});
    file->passed(40 * mib);
    EXPECT_EQ(file->bytes().back(), std::byte{'x'});
}

TEST(LargeFiles, ReadsAnEmptyFileAndRejectsAMissingOne) {
    const TemporaryFolder folder;
    const Result<bake::ModelFile> empty = bake::ModelFile::read(folder.write("empty.obj", ""));
    ASSERT_TRUE(empty);
    EXPECT_TRUE(empty->bytes().empty());
    EXPECT_FALSE(bake::ModelFile::read(folder.path() / "nowhere.obj"));
}

TEST(LargeFiles, RejectsAFileBeyondTheSizeLimit) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.write("model.obj", "v 0 0 0\n");
    std::filesystem::resize_file(path, bake::max_model_bytes + 1); // without blocks on the disk
    const Result<bake::ModelFile> file = bake::ModelFile::read(path);
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().id, "file.too_long");
}

constexpr std::uint32_t side = 520; ///< squares along each edge: the files have more than 16 MiB

std::vector<std::array<std::uint32_t, 3>> sheet_triangles() {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t j = 0; j < side; ++j) {
        for (std::uint32_t i = 0; i < side; ++i) {
            const std::uint32_t a = j * (side + 1) + i;
            const std::uint32_t c = a + side + 2;
            triangles.push_back({a, a + 1, c});
            triangles.push_back({a, c, c - 1});
        }
    }
    return triangles;
}

std::vector<glm::vec3> sheet_points() {
    std::vector<glm::vec3> points;
    for (std::uint32_t j = 0; j <= side; ++j) {
        for (std::uint32_t i = 0; i <= side; ++i) {
            points.emplace_back(i, j, (7 * i + 3 * j) % 5);
        }
    }
    return points;
}

std::string sheet_obj() {
    std::string text;
    for (const glm::vec3& p : sheet_points()) {
        text += fmt::format("v {:.6f} {:.6f} {:.6f}\n", p.x, p.y, p.z);
    }
    for (const auto& [a, b, c] : sheet_triangles()) {
        text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
    }
    return text;
}

std::string sheet_ply() {
    const std::vector<glm::vec3> points = sheet_points();
    const auto triangles = sheet_triangles();
    std::string text =
        fmt::format("ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
                    "property float z\nelement face {}\nproperty list uchar int vertex_indices\n"
                    "end_header\n",
                    points.size(), triangles.size());
    for (const glm::vec3& p : points) {
        text += fmt::format("{:.6f} {:.6f} {:.6f}\n", p.x, p.y, p.z);
    }
    for (const auto& [a, b, c] : triangles) {
        text += fmt::format("3 {} {} {}\n", a, b, c);
    }
    return text;
}

std::string sheet_stl() {
    const std::vector<glm::vec3> points = sheet_points();
    const auto triangles = sheet_triangles();
    std::string file(80, ' ');
    file += bytes_of(std::vector{static_cast<std::uint32_t>(triangles.size())});
    for (const auto& triangle : triangles) {
        std::string facet(50, '\0');
        for (std::size_t k = 0; k < 3; ++k) {
            std::memcpy(facet.data() + 12 + 12 * k, &points[triangle[k]], 12);
        }
        file += facet;
    }
    return file;
}

TEST(LargeFiles, ReleasingBytesWhileReadingGivesTheSameMesh) {
    const TemporaryFolder folder;
    for (const auto& [name, text] :
         {std::pair("sheet.obj", sheet_obj()), {"sheet.ply", sheet_ply()}, {"sheet.stl", sheet_stl()}}) {
        SCOPED_TRACE(name);
        ASSERT_GT(text.size(), 16 * mib);
        double last = 0.0;
        bake::LoadOptions options;
        options.progress = [&](double done) {
            EXPECT_GE(done, last);
            last = done;
        };
        const Result<bake::SourceMesh> read = bake::load_mesh(folder.write(name, text), options);
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_GT(last, 0.8);
        EXPECT_LE(last, 1.0);
        const Result<bake::SourceMesh> truth = load_text(name, text);
        ASSERT_TRUE(truth) << truth.error().message;
        EXPECT_EQ(read->positions, truth->positions);
        EXPECT_EQ(read->triangles, truth->triangles);
        EXPECT_EQ(read->triangles.size(), sheet_triangles().size());
        EXPECT_EQ(read->positions.size(), sheet_points().size());
    }
}

TEST(LargeFiles, VertexNumbersMatchAMap) {
    bake::VertexNumbers numbers;
    std::map<bake::VertexNumbers::Key, std::uint32_t> truth;
    std::minstd_rand random(1);
    for (int k = 0; k < 20'000; ++k) {
        const bake::VertexNumbers::Key key{
            static_cast<std::uint32_t>(random() % 40), static_cast<std::uint32_t>(random() % 20),
            random() % 2 == 0 ? 0xFFFFFFFFU : static_cast<std::uint32_t>(random() % 9)};
        const auto [number, is_new] = truth.try_emplace(key, static_cast<std::uint32_t>(truth.size()));
        const bake::VertexNumbers::Found found = numbers.number_of(key);
        ASSERT_EQ(found.number, number->second);
        ASSERT_EQ(found.is_new, is_new);
        ASSERT_EQ(numbers.find(key), number->second);
    }
    EXPECT_EQ(numbers.size(), truth.size());
    EXPECT_GT(numbers.size(), 5000U);
    EXPECT_EQ(numbers.find({40, 0, 0}), bake::VertexNumbers::none);
}

TEST(LargeFiles, ReadsPolygonsOfMixedSizes) {
    const Result<bake::SourceMesh> mesh =
        load_text("mixed.ply", "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
                               "property float z\nelement face 4\nproperty list uchar int vertex_indices\n"
                               "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 2 0\n"
                               "3 0 1 2\n4 0 1 2 3\n3 0 2 3\n5 0 1 2 4 3\n");
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh->triangles.size(), 1U + 2U + 1U + 3U);
    expect_sound(*mesh);
}

} // namespace
} // namespace frustumscreen::testing
