// The example prop files in config/ are what their comments say.
#include "app/solid/prop_file.h"
#include "firmware_host/base/file.h"
#include "tests/folders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

namespace frustumscreen::solid {
namespace {

struct Expected {
    std::size_t faces, corners;
    double volume_mm3, width_mm;
};

/// The files have six decimals.
Solid expect_prop(const std::string& name, const Expected& expected) {
    const Result<Bytes> bytes = read_file(std::filesystem::path(source_dir()) / "config" / (name + ".obj"));
    EXPECT_TRUE(bytes.has_value()) << name;
    const std::string_view text = as_text(*bytes);
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 60) << name;
    const Result<PropFile> file = parse_prop_file(text, LengthUnit::Millimetre);
    EXPECT_TRUE(file.has_value()) << name << (file ? "" : file.error().message);
    const Solid solid = file.value_or(PropFile{}).solid;
    EXPECT_EQ(file->notes, std::vector<std::string>{}) << name;
    EXPECT_EQ(solid.faces.size(), expected.faces) << name;
    EXPECT_EQ(solid.corners.size(), expected.corners) << name;
    EXPECT_NEAR(volume_of(solid) * 1e9, expected.volume_mm3, 1e-7 * expected.volume_mm3) << name;
    EXPECT_NEAR(min_width(solid).width_m * 1e3, expected.width_mm, 1e-5) << name;
    EXPECT_TRUE(check_stand(solid).has_value()) << name;
    EXPECT_EQ(narrowness(solid), std::nullopt) << name;
    for (const SolidFace& face : solid.faces) {
        EXPECT_NE(face.name.front(), 'F') << "each face has a name of its own";
    }
    return solid;
}

TEST(ExampleProps, CubeMatchesItsDimensions) {
    const Solid solid = expect_prop("prop_cube", {6, 8, 120.0 * 120.0 * 120.0, 120.0});
    for (const SolidFace& face : solid.faces) {
        glm::dvec3 along(0.0);
        along[face.name[1] - 'X'] = face.name[0] == '+' ? 1.0 : -1.0;
        EXPECT_NEAR(glm::dot(along, face.plane.normal), 1.0, 1e-15) << face.name;
    }
}

TEST(ExampleProps, HexagonMatchesItsDimensions) {
    const double area = std::sqrt(3.0) / 2.0 * 120.0 * 120.0; // of a hexagon 120 from flat to flat
    expect_prop("prop_hexagon", {8, 12, area * 130.0, 120.0});
}

TEST(ExampleProps, TetrahedronMatchesItsDimensions) {
    const double edge = 150.0;
    expect_prop("prop_tetrahedron",
                {4, 4, edge * edge * edge / (6.0 * std::sqrt(2.0)), edge / std::sqrt(2.0)});
}

TEST(ExampleProps, GemMatchesItsDimensions) {
    const auto hexagon = [](double radius) { return 1.5 * std::sqrt(3.0) * radius * radius; };
    const auto frustum = [&](double below, double above, double height) {
        return height / 3.0 * (hexagon(below) + hexagon(above) + std::sqrt(hexagon(below) * hexagon(above)));
    };
    // Between its top and its bottom it is narrowest.
    const Solid solid = expect_prop("prop_gem", {14, 18, frustum(80, 70, 50) + frustum(70, 40, 40), 90.0});
    for (const SolidFace& face : solid.faces) {
        EXPECT_EQ(face.plane.normal.z > 0.1, face.name != "bottom") << face.name << " is lit from above";
    }
}

} // namespace
} // namespace frustumscreen::solid
