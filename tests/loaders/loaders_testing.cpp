#include "tests/loaders/loaders_testing.h"

#include "assets_baked/bake/loaders/load_bytes.h"
#include "tests/base/told.h"
#include "tests/folders.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <sstream>

namespace frustumscreen::testing {

Result<bake::SourceMesh> load_text(const std::string& name, std::string_view text) {
    return bake::load_mesh_bytes(as_bytes(text), std::filesystem::path("nowhere") / name);
}

std::string error_of(const Result<bake::SourceMesh>& mesh) {
    EXPECT_FALSE(mesh.has_value()) << "a load succeeded that must fail";
    return mesh ? std::string() : test::told(mesh.error());
}

std::string base64(std::string_view bytes) {
    static constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            bits = bits << 8U | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += i + k > bytes.size() ? '=' : digits[(bits >> (18U - 6U * k)) & 63U];
        }
    }
    return text;
}

std::string gltf_text(std::string_view bytes, std::string_view members) {
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{},"uri":"data:application/octet-stream;base64,{}"}}],{}}})",
        bytes.size(), base64(bytes), members);
}

std::string glb_bytes(std::string json, std::string binary) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    const auto word = [](std::size_t value) {
        return bytes_of(std::vector{static_cast<std::uint32_t>(value)});
    };
    std::string glb = "glTF" + word(2) + word(12 + 8 + json.size() + 8 + binary.size());
    glb += word(json.size()) + "JSON" + json;
    glb += word(binary.size()) + std::string("BIN\0", 4) + binary;
    return glb;
}

Extent extent_of(const bake::SourceMesh& mesh) {
    Extent extent;
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t i : triangle) {
            extent.low = glm::min(extent.low, mesh.positions[i]);
            extent.high = glm::max(extent.high, mesh.positions[i]);
        }
    }
    return extent;
}

double area_of(const bake::SourceMesh& mesh) {
    double area = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        area += 0.5 * glm::length(glm::cross(mesh.positions[b] - mesh.positions[a],
                                             mesh.positions[c] - mesh.positions[a]));
    }
    return area;
}

double volume_of(const bake::SourceMesh& mesh) {
    double volume = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        volume += glm::dot(mesh.positions[a], glm::cross(mesh.positions[b], mesh.positions[c])) / 6.0;
    }
    return volume;
}

void expect_sound(const bake::SourceMesh& mesh) {
    ASSERT_FALSE(mesh.triangles.empty());
    ASSERT_EQ(mesh.triangles.size(), mesh.triangle_materials.size());
    ASSERT_FALSE(mesh.materials.empty());
    ASSERT_TRUE(mesh.uvs.empty() || mesh.uvs.size() == mesh.positions.size());
    ASSERT_TRUE(mesh.colours.empty() || mesh.colours.size() == mesh.positions.size());
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t i : triangle) {
            ASSERT_LT(i, mesh.positions.size());
        }
    }
    for (const glm::dvec3& p : mesh.positions) {
        ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    }
    for (const glm::vec2& uv : mesh.uvs) {
        ASSERT_TRUE(std::isfinite(uv.x) && std::isfinite(uv.y));
    }
    for (const std::uint32_t material : mesh.triangle_materials) {
        ASSERT_LT(material, mesh.materials.size());
    }
    ASSERT_TRUE(mesh.nodes.empty() ? mesh.triangle_nodes.empty() && mesh.animations.empty()
                                   : mesh.triangle_nodes.size() == mesh.triangles.size());
    ASSERT_LE(mesh.nodes.size(), world::max_cells);
    for (const std::uint32_t node : mesh.triangle_nodes) {
        ASSERT_LT(node, mesh.nodes.size());
    }
    for (const bake::SourceAnimation& animation : mesh.animations) {
        for (const world::Channel& channel : animation.channels) {
            ASSERT_LT(channel.cell, mesh.nodes.size());
            ASSERT_FALSE(channel.curve.times_s.empty());
        }
    }
    for (const bake::SourceMaterial& material : mesh.materials) {
        ASSERT_LT(material.texture, static_cast<int>(mesh.textures.size()));
        ASSERT_TRUE(material.texture < 0 ||
                    mesh.textures[static_cast<std::size_t>(material.texture)].image != nullptr);
    }
}

bake::SourceMesh sound(const Result<bake::SourceMesh>& mesh) {
    EXPECT_TRUE(mesh.has_value()) << (mesh ? "" : mesh.error().message);
    if (!mesh) {
        return {};
    }
    expect_sound(*mesh);
    return *mesh;
}

bool notes(const bake::SourceMesh& mesh, bake::SourceNote::Kind kind, std::string_view words) {
    return std::any_of(mesh.notes.begin(), mesh.notes.end(), [&](const bake::SourceNote& note) {
        return note.kind == kind && note.text.find(words) != std::string::npos;
    });
}

std::filesystem::path shared_data() {
    return std::filesystem::path(shared_dir()) / "data";
}

bool has_shared_data() {
    return std::filesystem::exists(shared_data() / "INDEX.tsv");
}

std::vector<IndexRow> shared_index() {
    std::vector<IndexRow> rows;
    std::ifstream stream(shared_data() / "INDEX.tsv");
    std::string line;
    std::getline(stream, line); // the column names
    while (std::getline(stream, line)) {
        std::vector<std::string> cells;
        std::istringstream split(line);
        for (std::string cell; std::getline(split, cell, '\t');) {
            cells.push_back(cell);
        }
        cells.resize(10);
        rows.push_back({cells[0], cells[1], cells[2], cells[9]});
    }
    return rows;
}

} // namespace frustumscreen::testing
