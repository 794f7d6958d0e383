// Animations of glTF files: the files are small and exact, so what must come out is written beside them.

#include "tests/loaders/gltf_files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace frustumscreen::testing {
namespace {

bake::SourceMesh mesh_of(const std::string& text) {
    return sound(load_text("model.gltf", text));
}
constexpr auto lost = bake::SourceNote::Kind::Lost;

TEST(GltfMovements, AnAnimationKeepsItsKeys) {
    const std::string nodes = R"({"name":"hinge","translation":[0,0,3],"children":[1]},{"mesh":0})";
    const auto curve_of = [&](const char* path, const char* interpolation, const Numbers& values) {
        const bake::SourceMesh mesh = mesh_of(
            file_with(nodes, animations(animation(0, path, interpolation)), {times({0.5F, 2.0F}), values}));
        EXPECT_EQ(mesh.nodes.size(), 2U);
        EXPECT_EQ(mesh.animations.size(), 1U);
        EXPECT_TRUE(mesh.notes.empty());
        if (mesh.animations.size() != 1 || mesh.animations[0].channels.size() != 1) {
            ADD_FAILURE() << "one channel is expected";
            return world::Curve{};
        }
        EXPECT_EQ(mesh.animations[0].name, "turn");
        EXPECT_EQ(mesh.nodes[mesh.animations[0].channels[0].cell].name, "hinge");
        EXPECT_EQ(mesh.positions[0].z, 3.0) << "at rest as the node is, not as the first key";
        EXPECT_EQ(mesh.animations[0].channels[0].curve.times_s, (std::vector<float>{0.5F, 2.0F}));
        return mesh.animations[0].channels[0].curve;
    };
    const world::Curve step = curve_of("translation", "STEP", vectors({1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(step.interpolation, world::Interpolation::Step);
    EXPECT_EQ(step.values, (std::vector<glm::vec4>{{1, 2, 3, 0}, {4, 5, 6, 0}}));
    const world::Curve linear = curve_of("rotation", "LINEAR", rotations({0, 0, 0, 1, 0, 3, 0, 4}));
    EXPECT_EQ(linear.interpolation, world::Interpolation::Linear);
    EXPECT_EQ(linear.values, (std::vector<glm::vec4>{{0, 0, 0, 1}, {0, 0.6F, 0, 0.8F}})) << "unit";
    const world::Curve cubic =
        curve_of("scale", "CUBICSPLINE", vectors({9, 9, 9, 1, 1, 1, 8, 8, 8, 7, 7, 7, 2, 2, 2, 6, 6, 6}));
    EXPECT_EQ(cubic.interpolation, world::Interpolation::CubicSpline);
    ASSERT_EQ(cubic.values.size(), 6U);
    EXPECT_EQ(cubic.values[0], glm::vec4(9, 9, 9, 0)) << "the tangent that comes in";
    EXPECT_EQ(cubic.values[4], glm::vec4(2, 2, 2, 0));
    const world::Curve spun =
        curve_of("rotation", "CUBICSPLINE",
                 rotations({0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(spun.values[1], glm::vec4(0, 0, 0, 1)) << "tangents of length zero are allowed";
    const world::Curve codes = curve_of("rotation", "LINEAR",
                                        {bytes_of(std::vector<std::int16_t>{0, 0, 0, 32767, 0, 0, -32767, 0}),
                                         2, R"("type":"VEC4","componentType":5122,"normalized":true)"});
    EXPECT_EQ(codes.values, (std::vector<glm::vec4>{{0, 0, 0, 1}, {0, 0, -1, 0}}));
}

TEST(GltfMovements, AnimationsOfOneNodeGetUniqueNames) {
    const std::string one = animation(0, "rotation", "LINEAR", "open");
    const std::string unnamed =
        R"({"samplers":[{"input":1,"output":2}],"channels":[{"sampler":0,"target":{"node":0,"path":"rotation"}}]})";
    const bake::SourceMesh mesh =
        mesh_of(file_with(R"({"mesh":0})", animations(fmt::format("{0},{0},{1}", one, unnamed)),
                          {times({0, 1}), rotations({0, 0, 0, 1, 0, 1, 0, 0})}));
    ASSERT_EQ(mesh.animations.size(), 3U);
    EXPECT_EQ(mesh.animations[0].name, "open");
    EXPECT_EQ(mesh.animations[1].name, "open 2");
    EXPECT_EQ(mesh.animations[2].name, "animation 2");
    EXPECT_EQ(mesh.nodes.size(), 1U) << "one part, but it moves";
    EXPECT_EQ(mesh.triangle_nodes, (std::vector<std::uint32_t>{0}));
}

TEST(GltfMovements, ReportsDroppedAnimationsByName) {
    const std::vector<Numbers> numbers{times({0, 1}), vectors({0, 0, 0, 1, 0, 0})};
    const auto told = [&](const std::string& nodes, const std::string& channel, std::string_view words) {
        const bake::SourceMesh mesh = mesh_of(file_with(
            nodes,
            animations(fmt::format(
                R"({{"name":"walk","samplers":[{{"input":1,"output":2}}],"channels":[{{"sampler":0,"target":{{{}}}}}]}})",
                channel)),
            numbers));
        EXPECT_TRUE(mesh.animations.empty() && mesh.nodes.empty());
        EXPECT_TRUE(notes(mesh, lost, words)) << words;
        EXPECT_TRUE(notes(mesh, lost, "walk"));
    };
    told(R"({"mesh":0})", R"("node":0,"path":"weights")", "morph weights");
    told(R"({"mesh":0})", R"("path":"translation")", "without a node");
    told(R"({"mesh":0})", R"("node":0,"path":"pointer")", "something else");
    told(R"({"mesh":0},{"name":"camera"})", R"("node":1,"path":"translation")", "without triangles");
}

TEST(GltfMovements, ReportsAnimationsBeyondTheLimits) {
    std::string many;
    for (std::size_t k = 0; k <= world::max_behaviours; ++k) {
        many += (k == 0 ? "" : ",") + animation(0, "translation", "LINEAR", "again");
    }
    const std::vector<Numbers> numbers{times({0, 1}), vectors({0, 0, 0, 1, 0, 0})};
    const bake::SourceMesh mesh = mesh_of(file_with(R"({"mesh":0})", animations(many), numbers));
    EXPECT_EQ(mesh.animations.size(), world::max_behaviours);
    EXPECT_TRUE(notes(mesh, lost, "whole animations (again 33)"));
    const bake::SourceMesh slow = mesh_of(file_with(R"({"mesh":0})", animations(animation(0, "translation")),
                                                    {times({0, 3601}), vectors({0, 0, 0, 1, 0, 0})}));
    EXPECT_TRUE(slow.animations.empty());
    EXPECT_TRUE(notes(slow, lost, "whole animations (turn)"));
    // Accessors without data may claim any number of keys; they are not read.
    std::string claimed = file_with(R"({"mesh":0})", animations(animation(0, "translation")));
    const std::size_t end = claimed.find("],\"meshes\"");
    claimed.insert(end, R"(,{"type":"SCALAR","componentType":5126,"count":4294967296},)"
                        R"({"type":"VEC3","componentType":5126,"count":4294967296})");
    EXPECT_TRUE(notes(mesh_of(claimed), lost, "whole animations (turn)"));
}

TEST(GltfMovements, RefusalsNameThePlace) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    struct Case {
        std::string text;
        const char* expected;
    };
    const std::string node = R"({"mesh":0})";
    const std::string moves = animations(animation(0, "translation"));
    const std::string turns = animations(animation(0, "rotation"));
    const Numbers line = vectors({0, 0, 0, 1, 0, 0});
    const auto channel = [&](std::string_view samplers, std::string_view channels) {
        return file_with(
            node, animations(fmt::format(R"({{"samplers":[{}],"channels":[{}]}})", samplers, channels)),
            {times({0, 1}), line});
    };
    constexpr std::string_view sampler = R"({"input":1,"output":2})";
    constexpr std::string_view target = R"({"sampler":0,"target":{"node":0,"path":"translation"}})";
    for (const Case& each : std::vector<Case>{
             {file_with(node, moves, {times({0, nan}), line}),
              "accessors[1]: element 1 is not a finite number"},
             {file_with(node, moves, {times({0, 1}), vectors({0, 0, 0, infinity, 0, 0})}),
              "accessors[2]: element 1 is not a finite number"},
             {file_with(node, moves, {times({1, 0}), line}),
              "animations[0].samplers[0].input: key 1 is at 0 s, after one at 1 s; times must rise"},
             {file_with(node, moves, {times({1, 1}), line}), "times must rise"},
             {file_with(node, moves, {times({-1, 1}), line}),
              "animations[0].samplers[0].input: key 0 is at -1 s"},
             {file_with(node, moves, {times({0, 1}), vectors({0, 0, 0})}),
              "animations[0].samplers[0].output: 1 values for 2 times; 1 for each"},
             {file_with(node, animations(animation(0, "scale", "CUBICSPLINE")), {times({0, 1}), line}),
              "2 values for 2 times; 3 for each"},
             {file_with(node, turns, {times({0, 1}), rotations({0, 0, 0, 1, 0, 0, 0, 0})}),
              "animations[0].samplers[0].output: element 1 is not a rotation: its length is zero"},
             {file_with(node, turns, {times({0, 1}), line}), "does not have the form of rotations"},
             {file_with(node, moves, {line, line}), "does not have the form of times"},
             {file_with(node, animations(animation(0, "scale", "BEZIER")), {times({0, 1}), line}),
              "animations[0].samplers[0].interpolation: \"BEZIER\" is not known"},
             {file_with(node, animations(animation(7, "scale")), {times({0, 1}), line}),
              "animations[0].channels[0].target.node: 7 is out of range"},
             {channel("", target), "animations[0].channels[0].sampler: 0 is out of range"},
             {channel(R"({"input":1,"output":9})", target),
              "animations[0].samplers[0].output: 9 is out of range"},
             {channel(sampler, fmt::format("{0},{0}", target)),
              "animations[0].channels[1]: moves the same part of nodes[0] as animations[0].channels[0]"},
             {file_with(R"({"mesh":0,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]})", moves,
                        {times({0, 1}), line}),
              "animations[0].channels[0]: moves nodes[0], which has a matrix"},
             {file_with(R"({"mesh":0,"children":[1]},{"children":[1]})", moves, {times({0, 1}), line}),
              "one parent is allowed"},
         }) {
        SCOPED_TRACE(each.expected);
        const std::string error = error_of(load_text("model.gltf", each.text));
        EXPECT_NE(error.find(each.expected), std::string::npos) << error;
    }
    std::string nodes = R"({"mesh":0})";
    for (std::size_t k = 0; k < 1'000'000; ++k) {
        nodes += ",{}";
    }
    EXPECT_NE(error_of(load_text("model.gltf", file_with(nodes))).find("[mesh.gltf_too_many_nodes]"),
              std::string::npos);
}

TEST(GltfMovements, TheInterpolationTestMovesNineCubes) {
    FRUSTUMSCREEN_SKIP_WITHOUT_SHARED_DATA();
    const bake::SourceMesh mesh =
        sound(bake::load_mesh(shared_data() / "models/interpolation_test/InterpolationTest.gltf"));
    ASSERT_EQ(mesh.animations.size(), 9U);
    EXPECT_EQ(mesh.animations[0].name, "Step Scale");
    EXPECT_EQ(mesh.nodes.size(), 10U) << "nine cubes and the plane with words";
    for (std::size_t k = 0; k < 9; ++k) {
        ASSERT_EQ(mesh.animations[k].channels.size(), 1U);
        const world::Curve& curve = mesh.animations[k].channels[0].curve;
        const bool is_spline = curve.interpolation == world::Interpolation::CubicSpline;
        EXPECT_EQ(curve.values.size(), curve.times_s.size() * (is_spline ? 3 : 1));
        EXPECT_EQ(std::count(mesh.triangle_nodes.begin(), mesh.triangle_nodes.end(),
                             mesh.animations[k].channels[0].cell),
                  12)
            << "a cube";
    }
    EXPECT_FALSE(notes(mesh, lost, "movements"));
}

TEST(GltfMovements, ReportsTheFoxsSkinAnimationsAndCountsNodes) {
    FRUSTUMSCREEN_SKIP_WITHOUT_SHARED_DATA();
    const bake::SourceMesh fox = sound(bake::load_mesh(shared_data() / "models/fox_animated/Fox.glb"));
    EXPECT_TRUE(fox.nodes.empty() && fox.animations.empty());
    EXPECT_TRUE(notes(fox, lost, "skin's joints (of: Survey, Walk, Run)"));
    const bake::SourceMesh board =
        sound(bake::load_mesh(shared_data() / "models/chess_board/chess-board.glb"));
    EXPECT_EQ(board.nodes.size(), 8U) << "eight of its ten nodes have a mesh";
    const bake::SourceMesh helmet =
        sound(bake::load_mesh(shared_data() / "models/flight_helmet/FlightHelmet.gltf"));
    EXPECT_EQ(helmet.nodes.size(), 6U);
}

} // namespace
} // namespace frustumscreen::testing
