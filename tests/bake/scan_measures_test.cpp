// The findings of a check before a bake: points and extents by hand, the estimate against bakes.
#include "app/pack/pack_file.h"
#include "assets_baked/bake/scan_measures.h"
#include "tests/bake/shapes.h"

#include <gtest/gtest.h>

namespace frustumscreen::bake {
namespace {

TEST(ScanMeasures, CountDifferentPointsAndMeasureAlongTheFilesAxes) {
    SourceMesh mesh = test::empty_mesh();
    test::add_box(mesh, {10, 20, 30}, {11, 22, 35});
    mesh.positions.insert(mesh.positions.end(), {{10, 20, 30}, {11, 22, 35}, {11, 20, 35}, {1000, 0, 0}});
    test::add_triangle(mesh, 8, 9, 10); // corners of the box again; the last point is unused
    BakeOptions options;
    options.up = "x";
    options.turn_deg = 30.0;
    const Result<ScanMeasures> measures = measure_scan(mesh, options);
    ASSERT_TRUE(measures) << measures.error().message;
    EXPECT_EQ(measures->points, 8U);
    EXPECT_EQ(measures->extents, glm::dvec3(1, 2, 5));
}

TEST(ScanMeasures, RefuseWhatABakeRefuses) {
    SourceMesh point = test::empty_mesh();
    point.positions = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
    test::add_triangle(point, 0, 1, 2);
    SourceMesh line = test::empty_mesh();
    line.positions = {{0, 0, 0}, {1, 0, 0}};
    test::add_triangle(line, 0, 1, 1);
    for (const SourceMesh* mesh : {&point, &line}) {
        const Result<ScanMeasures> measures = measure_scan(*mesh, {});
        const Result<pack::Pack> pack = bake(*mesh, {});
        ASSERT_FALSE(measures);
        ASSERT_FALSE(pack);
        EXPECT_EQ(measures.error().id, pack.error().id.view());
    }
}

TEST(ScanMeasures, GuessTheUnitFromFormatAndSize) {
    EXPECT_EQ(guessed_unit("GLB", 0.3), "m");
    EXPECT_EQ(guessed_unit("glTF", 15.0), "m") << "a ship";
    EXPECT_EQ(guessed_unit("GLB", 330.0), "mm") << "glTF means metres, and no object has 330";
    EXPECT_EQ(guessed_unit("OBJ", 1.2), "m");
    EXPECT_EQ(guessed_unit("PLY", 15.0), "cm");
    EXPECT_EQ(guessed_unit("STL", 150.0), "mm");
    EXPECT_EQ(guessed_unit("STL", 8000.0), "mm");
    EXPECT_EQ(guessed_unit("OBJ", 1e6), "");
    EXPECT_EQ(guessed_unit("OBJ", 1e-5), "");
}

TEST(ScanMeasures, EstimatesAreWithinAFactorOfTheBake) {
    SourceMesh mesh = test::empty_mesh();
    test::add_sphere(mesh, {0, 0, 0}, 1.0, 48);
    std::mt19937 random(7);
    for (const glm::dvec3& place : std::vector(mesh.positions)) { // a worn surface, and colours
        (void)place;
        mesh.colours.emplace_back(static_cast<float>(random() % 256) / 255.0F, 0.5F, 0.4F, 1.0F);
    }
    for (const bool relief : {false, true}) {
        BakeOptions options;
        options.size = 96;
        options.measuring = 0.1;
        options.relief = relief;
        const Result<ScanMeasures> measures = measure_scan(mesh, options);
        Result<pack::Pack> pack = bake(mesh, options);
        ASSERT_TRUE(measures && pack);
        pack->id = "sphere";
        pack->title = "Sphere";
        pack->languages = {"en"};
        pack->captions = {{"en", "Sphere", ""}};
        const Result<Bytes> bytes = pack::write_pack(*pack);
        ASSERT_TRUE(bytes) << bytes.error().message;
        const double ratio =
            static_cast<double>(measures->estimated_bytes) / static_cast<double>(bytes->size());
        EXPECT_GT(ratio, 0.4) << bytes->size();
        EXPECT_LT(ratio, 2.5) << bytes->size();
        const double shown = static_cast<double>(pack->levels[pack->default_level].indices.size() / 3);
        EXPECT_GT(static_cast<double>(measures->estimated_triangles), shown / 2.5);
        EXPECT_LT(static_cast<double>(measures->estimated_triangles), shown * 2.5);
    }
}

} // namespace
} // namespace frustumscreen::bake
