#include "app/settings/config_json.h"
#include "app/settings/missing_files.h"
#include "firmware_host/base/json.h"
#include "tests/base/temporary_folder.h"
#include "tests/settings/settings_text.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace frustumscreen::settings {
namespace {

/// The settings of a file in config/ with an example of a prop file.
std::string with_example(const std::string& prop, const std::string& more = {}) {
    return "[prop]\nkind = \"solid\"\nfile = \"" + source_dir() + "/config/" + prop + "\"\n" + more;
}

/// The same with the file's text inside the settings.
std::string with_text(const std::string& prop, const std::string& more = {}) {
    return "[prop]\nkind = \"solid\"\nshape = '''\n" +
           frustumscreen::text_of(source_dir() + "/config/" + prop) + "'''\n" + more;
}

std::vector<std::string> lit_faces(const Settings& settings) {
    std::vector<std::string> names;
    for (const geometry::PropFace& face : make_prop(settings.prop).faces) {
        names.push_back(face.name);
    }
    return names;
}

TEST(SolidProp, HasTheShapeOfItsFile) {
    const Settings settings = parsed(with_example("prop_tetrahedron.obj"));
    const geometry::PropShape prop = make_prop(settings.prop);
    ASSERT_EQ(prop.faces.size(), 4U);
    EXPECT_EQ(prop.corners.size(), 4U);
    const double edge_m = 0.150; // as the file's first line says
    for (const geometry::PropFace& face : prop.faces) {
        ASSERT_EQ(face.corners.size(), 3U) << face.name;
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_NEAR(glm::distance(face.corners[k], face.corners[face.corners.next(k)]), edge_m, 1e-8);
        }
    }
    EXPECT_NEAR(settings.prop.height_m, edge_m * std::sqrt(2.0 / 3.0), 1e-8);
    EXPECT_EQ(settings.prop.zone, PropZone::Hand);
    EXPECT_EQ(make_prop(parsed(with_text("prop_tetrahedron.obj")).prop).corners, prop.corners);
}

TEST(SolidProp, IsLitOnAllFacesButTheOneOnWhichItStands) {
    EXPECT_EQ(lit_faces(parsed(with_example("prop_hexagon.obj"))).size(), 8U);
    const Settings standing = parsed(with_example("prop_hexagon.obj", "zone = \"table\"\n"));
    const std::vector<std::string> seven{"side1", "side2", "side3", "side4", "side5", "side6", "top"};
    EXPECT_EQ(lit_faces(standing), seven);
    EXPECT_EQ(make_prop(standing.prop).bounds.size(), 8U);
}

TEST(SolidProp, IsLitOnTheFacesThatAreNamed) {
    const Settings settings =
        parsed(with_example("prop_hexagon.obj", "zone = \"table\"\nlit_faces = [\"top\", \"side2\"]\n"));
    const geometry::PropShape prop = make_prop(settings.prop);
    const std::vector<std::string> two{"side2", "top"};
    EXPECT_EQ(lit_faces(settings), two);
    ASSERT_EQ(prop.bounds.size(), 8U);
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_EQ(prop.bounds[k].normal, prop.faces[k].plane.normal);
    }
    // The dark faces bound it still: a ray from the side meets one of them, and no lit one.
    geometry::PropHit hit;
    EXPECT_TRUE(geometry::enter(prop, {0.0, -1.0, 0.05}, {0.0, 1.0, 0.0}, hit));
    EXPECT_NEAR(hit.t, 1.0 - 0.060, 1e-6);
    EXPECT_FALSE(geometry::intersect(prop, {0.0, -1.0, 0.05}, {0.0, 1.0, 0.0}, hit));
}

TEST(SolidProp, WarnsOfNormalsAndOfATooSmallWidth) {
    const std::string slab = "v -100 -100 0\nv 100 -100 0\nv 100 100 0\nv -100 100 0\n"
                             "v -100 -100 50\nv 100 -100 50\nv 100 100 50\nv -100 100 50\nvn 0 0 1\n"
                             "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    const Settings settings = parsed("[prop]\nkind = \"solid\"\nshape = '''\n" + slab + "'''\n");
    const std::vector<std::string> told = missing_files(settings);
    ASSERT_EQ(told.size(), 2U);
    EXPECT_TRUE(test::tells(told[0], {"prop.shape: ", "vn"}));
    EXPECT_TRUE(test::tells(told[1], {"prop.shape: ", "its least width is 50", "63", "make it wider"}));
    EXPECT_TRUE(missing_files(parsed(with_example("prop_hexagon.obj"))).empty());
}

TEST(SolidProp, ReportsFacesOfAnyNumberOfCorners) {
    const auto checked = parse_settings(with_example("prop_gem.obj"), "set/kiosk.toml");
    ASSERT_TRUE(checked) << checked.error().message;
    const nlohmann::json prop = nlohmann::json::parse(config_json(*checked)).at("prop");
    EXPECT_EQ(prop.at("kind"), "solid");
    ASSERT_EQ(prop.at("faces").size(), 14U);
    std::size_t corners = 0;
    for (const nlohmann::json& face : prop.at("faces")) {
        EXPECT_GE(face.at("corners").size(), 3U);
        corners += face.at("corners").size();
    }
    // Euler: corners - edges + faces = 2, and each edge is counted from both of its faces.
    EXPECT_EQ(make_prop((*checked)->prop).corners.size(), 2U + corners / 2U - 14U);
}

TEST(SolidProp, RefusalsNameTheLineAndTheCause) {
    const TemporaryFolder folder;
    const std::string open = folder.write("open.obj", "v 0 0 0\nv 90 0 0\nv 0 90 0\nv 0 0 90\nf 1 2 3\n");
    const std::string named = "[prop]\nkind = \"solid\"\nfile = \"";
    const auto tells = [](const std::string& text, const std::vector<std::string>& words) {
        for (const std::string& word : words) {
            EXPECT_NE(refusal(text).find(word), std::string::npos) << word << " is not in: " << refusal(text);
        }
    };
    tells(named + open + "\"\n", {"set/kiosk.toml:3: prop.file: " + open + ": ", "[prop_file."});
    tells(named + "nowhere.obj\"\n", {"set/kiosk.toml:3: prop.file: set/nowhere.obj: "});
    tells("[prop]\nkind = \"solid\"\nshape = 'v 1 2'\n", {":3: prop.shape: ", "[prop_file."});
    tells("[prop]\nkind = \"solid\"\n", {":2: prop.kind is \"solid\"; it needs prop.file"});
    tells(with_example("prop_gem.obj", "base_m = 0.3\n"),
          {":4: prop.base_m is the size of a frustum or a cube"});
    tells(with_example("prop_gem.obj", "shape = \"v\"\n"), {":4: prop.shape stands beside prop.file"});
    tells(with_example("prop_hexagon.obj", "lit_faces = [\"top\", \"lid\"]\n"),
          {":4: prop.lit_faces names \"lid\"; the shape has the faces side1, side2"});
    tells("[prop]\nlit_faces = [\"top\"]\n", {":2: prop.lit_faces is of a solid; set prop.kind"});
    tells(with_example("prop_hexagon.obj", "unit = \"m\"\n"), {"set/kiosk.toml:3: prop.file: ", "2000 mm"});
}

} // namespace
} // namespace frustumscreen::settings
