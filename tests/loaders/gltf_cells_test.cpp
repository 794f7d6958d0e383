// Nodes and animations of glTF files: the files are small and exact, so what must come out is written beside them.

#include "tests/loaders/gltf_files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace frustumscreen::testing {
namespace {

bake::SourceMesh mesh_of(const std::string& text) {
    return sound(load_text("model.gltf", text));
}
constexpr auto lost = bake::SourceNote::Kind::Lost;
constexpr auto guessed = bake::SourceNote::Kind::Guessed;

/// T * R * S, written out.
glm::dmat4 matrix_of(const world::LocalPose& pose) {
    const double x = pose.rotation.x;
    const double y = pose.rotation.y;
    const double z = pose.rotation.z;
    const double w = pose.rotation.w;
    const glm::dvec3 columns[3] = {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
                                   {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
                                   {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
    glm::dmat4 matrix(1.0);
    for (int k = 0; k < 3; ++k) {
        matrix[k] = glm::dvec4(columns[k] * pose.scale[k], 0.0);
    }
    matrix[3] = glm::dvec4(pose.translation, 1.0);
    return matrix;
}

glm::dmat4 file_from_node(const bake::SourceMesh& mesh, std::size_t node) {
    const bake::SourceNode& own = mesh.nodes[node];
    const glm::dmat4 parent_from_node = own.parent_from_base * matrix_of(own.rest);
    return own.parent ? file_from_node(mesh, *own.parent) * parent_from_node : parent_from_node;
}

/// Every triangle is the mesh's own one, moved by its node.
void expect_triangles_at_rest(const bake::SourceMesh& mesh, std::size_t from = 0) {
    ASSERT_EQ(mesh.triangle_nodes.size(), mesh.triangles.size());
    const glm::dvec3 corners[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (std::size_t t = from; t < mesh.triangles.size(); ++t) {
        const glm::dmat4 transform = file_from_node(mesh, mesh.triangle_nodes[t]);
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 expected(transform * glm::dvec4(corners[k], 1.0));
            EXPECT_LT(glm::length(mesh.positions[mesh.triangles[t][k]] - expected), 1e-9) << t;
        }
    }
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        EXPECT_TRUE(!mesh.nodes[n].parent || *mesh.nodes[n].parent < n);
    }
}

TEST(GltfCells, StillFileWithOnePartHasNoNodes) {
    for (const char* nodes : {R"({"mesh":0})", R"({"children":[1]},{"mesh":0,"translation":[1,2,3]})"}) {
        const bake::SourceMesh mesh = mesh_of(file_with(nodes));
        EXPECT_TRUE(mesh.nodes.empty() && mesh.triangle_nodes.empty() && mesh.animations.empty());
    }
}

TEST(GltfCells, FoldsStillAncestorsWithoutTriangles) {
    const bake::SourceMesh mesh = mesh_of(file_with(
        R"({"name":"table","scale":[2,2,2],"children":[1]},{"translation":[0,0,1],"children":[2,3]},)"
        R"({"name":"jar","mesh":0,"translation":[5,0,0],"children":[4]},{"mesh":0,"rotation":[0,0,2,0]},)"
        R"({"name":"jar","mesh":0,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,7,1]},{"name":"lamp"})"));
    ASSERT_EQ(mesh.nodes.size(), 3U);
    EXPECT_EQ(mesh.nodes[0].name, "jar");
    EXPECT_EQ(mesh.nodes[1].name, "node 3");
    EXPECT_EQ(mesh.nodes[2].name, "jar 2");
    EXPECT_FALSE(mesh.nodes[0].parent.has_value());
    EXPECT_EQ(mesh.nodes[2].parent, std::optional<std::size_t>(0));
    EXPECT_EQ(mesh.nodes[0].parent_from_base[3], glm::dvec4(0, 0, 2, 1)) << "scale times translation";
    EXPECT_EQ(mesh.nodes[0].rest.translation, glm::dvec3(5, 0, 0));
    EXPECT_EQ(mesh.nodes[1].rest.rotation, glm::dquat(0, 0, 0, 1)) << "made a unit one";
    EXPECT_EQ(mesh.nodes[2].parent_from_base[3], glm::dvec4(0, 0, 7, 1)) << "the matrix does not move";
    EXPECT_EQ(mesh.nodes[2].rest, world::LocalPose{});
    expect_triangles_at_rest(mesh);
}

TEST(GltfCells, RandomTreesKeepTheirTrianglePositions) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-2.0, 2.0);
    std::size_t compared = 0;
    for (int file = 0; file < 20; ++file) {
        constexpr int count = 40;
        std::vector<std::string> children(count);
        for (int k = 1; k < count; ++k) {
            std::string& of = children[static_cast<std::size_t>(random() % static_cast<unsigned>(k))];
            of += fmt::format("{}{}", of.empty() ? "" : ",", k);
        }
        std::string nodes;
        for (int k = 0; k < count; ++k) {
            nodes += fmt::format(
                R"({}{{"translation":[{},{},{}],"rotation":[{},{},{},{}],"scale":[{},1,0.5]{}{}}})",
                k == 0 ? "" : ",", number(random), number(random), number(random), number(random),
                number(random), number(random), number(random), number(random),
                random() % 2 == 0 ? R"(,"mesh":0)" : "",
                children[static_cast<std::size_t>(k)].empty()
                    ? ""
                    : fmt::format(R"(,"children":[{}])", children[static_cast<std::size_t>(k)]));
        }
        const bake::SourceMesh mesh = mesh_of(file_with(nodes));
        // A mirroring node swaps two corners of its triangle; bring them back.
        bake::SourceMesh unswapped = mesh;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            if (glm::determinant(glm::dmat3(file_from_node(mesh, mesh.triangle_nodes[t]))) < 0.0) {
                std::swap(unswapped.triangles[t][1], unswapped.triangles[t][2]);
            }
        }
        expect_triangles_at_rest(unswapped);
        compared += mesh.triangles.size();
    }
    EXPECT_GT(compared, 300U);
}

TEST(GltfCells, SkinnedMeshGetsAStillRootOfItsOwn) {
    std::string bytes;
    for (int vertex = 0; vertex < 3; ++vertex) {
        bytes += bytes_of(std::vector<std::uint8_t>{0, 0, 0, 0});
    }
    const Numbers joints{bytes, 3, R"("type":"VEC4","componentType":5121)"};
    std::string text = file_with(
        R"({"name":"body","mesh":1,"skin":0,"translation":[9,9,9],"children":[2]},)"
        R"({"name":"hand","translation":[0,0,1],"children":[3]},{"mesh":0},{"name":"sword","mesh":0,"translation":[0,2,0]})",
        R"(,"skins":[{"joints":[1]}])" + animations(animation(1, "translation", "LINEAR", "wave") + "," +
                                                    animation(0, "translation", "LINEAR", "jump")),
        {times({0, 1}), vectors({0, 0, 1, 0, 0, 2}), joints,
         rotations({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0})});
    const std::string end = R"("POSITION":0}}]}])";
    text.replace(
        text.find(end), end.size(),
        R"("POSITION":0}}]},{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":3,"WEIGHTS_0":4}}]}])");
    const bake::SourceMesh mesh = mesh_of(text);
    ASSERT_EQ(mesh.triangles.size(), 3U);
    EXPECT_TRUE(notes(mesh, lost, "skin's joints (of: wave)"));
    ASSERT_EQ(mesh.animations.size(), 2U) << "both move a rigid part too";
    ASSERT_EQ(mesh.nodes.size(), 5U) << "body, its child, hand, sword, and the skin's root";
    std::size_t skin_triangles = 0;
    for (std::size_t t = 0; t < 3; ++t) {
        if (mesh.triangle_nodes[t] == 4) {
            ++skin_triangles;
            EXPECT_EQ(mesh.positions[mesh.triangles[t][0]], glm::dvec3(0, 0, 1)) << "as its joint has it";
        }
    }
    EXPECT_EQ(skin_triangles, 1U);
    EXPECT_EQ(mesh.nodes[4].name, "body 2");
    EXPECT_FALSE(mesh.nodes[4].parent.has_value());
    EXPECT_EQ(mesh.nodes[4].rest, world::LocalPose{});
    EXPECT_EQ(mesh.nodes[4].parent_from_base, glm::dmat4(1.0));
}

TEST(GltfCells, AllInstancesOfANodeAreOneCell) {
    const bake::SourceMesh mesh = mesh_of(file_with(
        R"({"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":1}}}},{"mesh":0})",
        "", {vectors({0, 0, 0, 0, 0, 5})}));
    EXPECT_EQ(mesh.nodes.size(), 2U);
    EXPECT_EQ(mesh.triangle_nodes, (std::vector<std::uint32_t>{0, 0, 1}));
}

TEST(GltfCells, JoinsTheDeepestPartsOfAFileWithTooMany) {
    // 100 shelves in a row, each with a jar and in it a spoon: 300 parts. The last spoon moves.
    std::string nodes;
    std::string roots;
    for (int k = 0; k < 100; ++k) {
        const int shelf = 3 * k;
        nodes += fmt::format(R"({}{{"mesh":0,"translation":[{},0,0],"scale":[2,1,1],"children":[{}]}},)",
                             k == 0 ? "" : ",", k, shelf + 1);
        nodes += fmt::format(R"({{"mesh":0,"translation":[0,1,0],"rotation":[0,0,1,1],"children":[{}]}},)",
                             shelf + 2);
        nodes += R"({"mesh":0,"translation":[0,0,1]})";
    }
    const std::string text = file_with(nodes, animations(animation(299, "translation")),
                                       {times({0, 1}), vectors({0, 0, 0, 1, 0, 0})});
    const bake::SourceMesh mesh = mesh_of(text);
    ASSERT_EQ(mesh.nodes.size(), world::max_cells);
    EXPECT_EQ(mesh.triangles.size(), 300U);
    EXPECT_TRUE(notes(mesh, guessed, "it has 300 parts, 256 are allowed: 44"));
    ASSERT_EQ(mesh.animations.size(), 1U);
    EXPECT_EQ(mesh.nodes[mesh.animations[0].channels[0].cell].name, "node 299");
    std::vector<std::size_t> count(mesh.nodes.size(), 0);
    for (const std::uint32_t node : mesh.triangle_nodes) {
        ++count[node];
    }
    EXPECT_EQ(std::count(count.begin(), count.end(), 2U), 44) << "44 jars took their spoons in";
    EXPECT_EQ(std::count(count.begin(), count.end(), 1U), 212);
    // The remaining chain has every part's own frame still.
    const glm::dmat4 spoon = file_from_node(mesh, mesh.animations[0].channels[0].cell);
    EXPECT_LT(glm::length(glm::dvec3(spoon[3]) - glm::dvec3(99, 1, 1)), 1e-12);
}

TEST(GltfCells, JoinsExcessRootsToTheFirstStillRoot) {
    std::string nodes = R"({"name":"lid","mesh":0,"children":[1]},{"mesh":0,"translation":[0,0,4]})";
    for (int k = 2; k < 600; ++k) {
        nodes += fmt::format(R"(,{{"mesh":0,"translation":[{},0,0]}})", k);
    }
    const std::vector<Numbers> numbers{times({0, 1}), vectors({0, 0, 0, 1, 0, 0})};
    const bake::SourceMesh mesh = mesh_of(file_with(nodes, animations(animation(0, "translation")), numbers));
    ASSERT_EQ(mesh.nodes.size(), world::max_cells);
    EXPECT_EQ(mesh.nodes[0].name, "lid");
    EXPECT_EQ(mesh.triangle_nodes[0], 0U);
    std::size_t joined = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        joined += mesh.nodes[mesh.triangle_nodes[t]].name == "node 2" ? 1 : 0;
    }
    EXPECT_EQ(joined, 600 - world::max_cells)
        << "one child of the lid joined the lid, the rest the first root";
    std::string channels;
    for (int k = 0; k < 300; ++k) {
        channels += fmt::format(R"({}{{"sampler":0,"target":{{"node":{},"path":"translation"}}}})",
                                k == 0 ? "" : ",", k);
    }
    const bake::SourceMesh still = mesh_of(file_with(
        nodes,
        animations(fmt::format(R"({{"samplers":[{{"input":1,"output":2}}],"channels":[{}]}})", channels)),
        numbers));
    EXPECT_TRUE(notes(still, lost, "more than 256 of its parts move"));
    EXPECT_TRUE(still.animations.empty());
    EXPECT_EQ(still.triangles.size(), 600U);
}

} // namespace
} // namespace frustumscreen::testing
