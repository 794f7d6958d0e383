/// Khronos' small conformance models, against independent arithmetic from the models' known content.
#include "tests/loaders/loaders_testing.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace frustumscreen::testing {
namespace {

bake::SourceMesh conformance_model(const std::string& name, const char* extension = ".gltf") {
    Result<bake::SourceMesh> mesh =
        bake::load_mesh(shared_data() / "models/conformance" / name / (name + extension));
    EXPECT_TRUE(mesh.has_value()) << (mesh ? "" : mesh.error().message);
    return mesh ? *std::move(mesh) : bake::SourceMesh{};
}

void expect_extent(const bake::SourceMesh& mesh, const glm::dvec3& low, const glm::dvec3& high,
                   double tolerance = 1e-6) {
    const Extent extent = extent_of(mesh);
    EXPECT_LT(glm::length(extent.low - low), tolerance)
        << extent.low.x << " " << extent.low.y << " " << extent.low.z;
    EXPECT_LT(glm::length(extent.high - high), tolerance)
        << extent.high.x << " " << extent.high.y << " " << extent.high.z;
}

bool has_position(const bake::SourceMesh& mesh, const glm::dvec3& position) {
    return std::find(mesh.positions.begin(), mesh.positions.end(), position) != mesh.positions.end();
}

TEST(GltfConformance, ASparseAccessorMovesThreeOfFourteenVertices) {
    FRUSTUMSCREEN_SKIP_WITHOUT_SHARED_DATA();
    const bake::SourceMesh mesh = conformance_model("SimpleSparseAccessor");
    EXPECT_EQ(mesh.positions.size(), 14U);
    for (const glm::dvec3& moved : {glm::dvec3(1, 2, 0), glm::dvec3(3, 3, 0), glm::dvec3(5, 4, 0)}) {
        EXPECT_TRUE(has_position(mesh, moved));
        EXPECT_FALSE(has_position(mesh, {moved.x, 1, 0})) << "where it was before";
    }
    for (const double x : {0.0, 2.0, 4.0, 6.0}) {
        EXPECT_TRUE(has_position(mesh, {x, 1, 0})) << "left where it was";
    }
    expect_extent(mesh, {0, 0, 0}, {6, 4, 0});
    // Six columns of width 1; the upper edge has the heights 1 2 1 3 1 4 1.
    EXPECT_NEAR(area_of(mesh), 1.5 + 1.5 + 2 + 2 + 2.5 + 2.5, 1e-12);
}

TEST(GltfConformance, AStripOfFourVerticesIsTwoTrianglesOfOneOrientation) {
    FRUSTUMSCREEN_SKIP_WITHOUT_SHARED_DATA();
    const bake::SourceMesh mesh = conformance_model("Mesh_PrimitiveMode_04");
    ASSERT_EQ(mesh.triangles.size(), 2U);
    EXPECT_NEAR(area_of(mesh), 1.0, 1e-12);
    std::vector<double> up;
    for (const auto& [a, b, c] : mesh.triangles) {
        up.push_back(
            glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]).z);
    }
    EXPECT_GT(up[0] * up[1], 0.0);
}

TEST(GltfConformance, AnInterleavedBoxIsAUnitCube) {
    FRUSTUMSCREEN_SKIP_WITHOUT_SHARED_DATA();
    const bake::SourceMesh mesh = conformance_model("BoxInterleaved", ".glb");
    expect_extent(mesh, glm::dvec3(-0.5), glm::dvec3(0.5));
    EXPECT_NEAR(area_of(mesh), 6.0, 1e-9);
    EXPECT_NEAR(volume_of(mesh), 1.0, 1e-9) << "counter-clockwise seen from outside";
}

TEST(GltfConformance, NestedNodesMultiply) {
    FRUSTUMSCREEN_SKIP_WITHOUT_SHARED_DATA();
    const bake::SourceMesh mesh = conformance_model("nested", ".glb");
    // Three cubes of side 2; each node scales and shifts its children (numbers from the file).
    const auto cube = [](const glm::dvec3& scale, const glm::dvec3& centre) {
        return std::pair(centre - scale, centre + scale);
    };
    const glm::dvec3 s1(0.26938149333000183, 0.28434106707572937, 0.26938149333000183);
    const glm::dvec3 t1(-0.897631824016571, 0.6829495429992676, 0);
    const glm::dvec3 s2(1, 3.5169029235839844, 1);
    const glm::dvec3 t2(3.332195520401001, -2.401867389678955, 0);
    const glm::dvec3 s3(0.6575802564620972, 0.6102062463760376, 0.6575802564620972);
    const glm::dvec3 t3(0, -1.7263891696929932, 0);
    Extent expected;
    double volume = 0.0;
    for (const auto& [low, high] :
         {cube(s1, t1), cube(s1 * s2, t1 + s1 * t2), cube(s1 * s2 * s3, t1 + s1 * (t2 + s2 * t3))}) {
        expected.low = glm::min(expected.low, low);
        expected.high = glm::max(expected.high, high);
        volume += (high.x - low.x) * (high.y - low.y) * (high.z - low.z);
    }
    expect_extent(mesh, expected.low, expected.high);
    EXPECT_NEAR(volume_of(mesh), volume, 1e-9);
}

TEST(GltfConformance, TextureTransformTestMatchesItsMarkers) {
    FRUSTUMSCREEN_SKIP_WITHOUT_SHARED_DATA();
    const bake::SourceMesh mesh = conformance_model("TextureTransformTest");
    // The model has a marker where the arrow's tip must appear. Untransformed, the tip is at the "not
    // supported" marker, at (0.2778, -0.2778) on a quad from -0.5 to 0.5 whose UVs are (x + 0.5, 0.5 - y);
    // the transform must map the "correct" marker's place to that texel.
    const double tip = 0.5 + 0.2778174593052023;
    struct Quad {
        std::size_t first_triangle;
        double middle_x;
        glm::dvec2 marker; ///< relative to the quad's middle
    };
    // Triangles come in pairs per node, roots first.
    for (const Quad& quad : {Quad{6, -1.1, {-0.07904822439840126, -0.5162674857624154}},
                             Quad{8, 0.0, {0.018544972870134853, -0.018544972870134853}}}) {
        const auto& [a, b, c] = mesh.triangles[quad.first_triangle];
        // Affine map from position to UV, from one triangle.
        const glm::dvec2 middle(quad.middle_x, -0.55);
        const glm::dvec2 pa = glm::dvec2(mesh.positions[a]) - middle;
        const glm::dmat2 edges(glm::dvec2(mesh.positions[b]) - middle - pa,
                               glm::dvec2(mesh.positions[c]) - middle - pa);
        const glm::dmat2 uv_edges(glm::dvec2(mesh.uvs[b] - mesh.uvs[a]),
                                  glm::dvec2(mesh.uvs[c] - mesh.uvs[a]));
        const glm::dvec2 uv = glm::dvec2(mesh.uvs[a]) + uv_edges * (glm::inverse(edges) * (quad.marker - pa));
        EXPECT_NEAR(uv.x, tip, 1e-3);
        EXPECT_NEAR(uv.y, tip, 1e-3);
    }
}

TEST(GltfConformance, ASkinAtRestShiftsByItsBindPose) {
    FRUSTUMSCREEN_SKIP_WITHOUT_SHARED_DATA();
    // Both joints are at (0, 1, 0) and were bound at (0.5, 1, 0): everything moves by -0.5 along x.
    expect_extent(conformance_model("SimpleSkin"), {-0.5, 0, 0}, {0.5, 2, 0});
}

TEST(GltfConformance, AMorphedCubeWithoutWeightsIsACubeOfSideTwo) {
    FRUSTUMSCREEN_SKIP_WITHOUT_SHARED_DATA();
    const bake::SourceMesh mesh = conformance_model("AnimatedMorphCube");
    expect_extent(mesh, glm::dvec3(-1.0), glm::dvec3(1.0), 3e-6);
    EXPECT_NEAR(volume_of(mesh), 8.0, 1e-4);
}

TEST(GltfConformance, UnindexedTrianglesOfTheBuildingStandUpright) {
    FRUSTUMSCREEN_SKIP_WITHOUT_SHARED_DATA();
    const bake::SourceMesh mesh = conformance_model("no_indices_3storybuilding", ".glb");
    // The root node rotates z up into y up.
    expect_extent(mesh, {-23.207141876220703, 0, 0}, {32.87300109863281, 9, 63.36140823364258}, 1e-5);
    EXPECT_GT(volume_of(mesh), 0.0);
}

TEST(GltfConformance, VertexColoursReachTheMesh) {
    FRUSTUMSCREEN_SKIP_WITHOUT_SHARED_DATA();
    const bake::SourceMesh mesh = conformance_model("VertexColorTest");
    ASSERT_EQ(mesh.colours.size(), mesh.positions.size());
    const auto coloured = std::count_if(mesh.colours.begin(), mesh.colours.end(),
                                        [](const glm::vec4& colour) { return colour != glm::vec4(1.0F); });
    EXPECT_GT(coloured, 10);
    EXPECT_LE(coloured, 48) << "the labels have no colours of their own";
}

TEST(GltfConformance, AFoxInItsBindPoseStandsOnFourLegs) {
    FRUSTUMSCREEN_SKIP_WITHOUT_SHARED_DATA();
    const Result<bake::SourceMesh> mesh = bake::load_mesh(shared_data() / "models/fox_animated/Fox.glb");
    ASSERT_TRUE(mesh.has_value());
    const Extent extent = extent_of(*mesh);
    EXPECT_NEAR(extent.low.y, 0.0, 2.0);
    EXPECT_GT(extent.high.z - extent.low.z, 2.0 * (extent.high.x - extent.low.x)) << "long, not wide";
}

} // namespace
} // namespace frustumscreen::testing
