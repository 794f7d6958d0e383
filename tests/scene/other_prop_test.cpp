// Packs for a frustum in other props: refused where a lit face would show what their bake removed, which rays find, and told
// with their error otherwise.

#include "app/scene/other_prop.h"
#include "app/scene/scene_plan.h"
#include "tests/settings/steep_table.h"
#include "tests/solid/example_props.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

namespace frustumscreen::scene {
namespace {

/// Its only level errs by 1 % of its box, 0.5 mm on a prop that makes the box 50 mm wide.
pack::PackOutline pack_for(const std::string& kind) {
    pack::PackOutline pack;
    pack.levels.push_back({.error = {0.01F, 0.02F, 0.03F, 0.0F}, .triangles = 100});
    pack.description.extremes = {{0.0, 0.0, 1.0}, {0.2, 0.2, 0.0}};
    pack.description.prop_kind = kind;
    return pack;
}

settings::Settings settings_with(const settings::PropSettings& prop) {
    settings::Settings settings = settings::steep_table();
    settings.prop = prop;
    return settings;
}

settings::PropSettings solid_settings(geometry::PropShape shape, settings::PropZone zone) {
    settings::PropSettings prop;
    prop.kind = settings::PropKind::Solid;
    prop.zone = zone;
    prop.shape = std::make_shared<const geometry::PropShape>(std::move(shape));
    return prop;
}

Result<ScenePlan> plan_of(const settings::Settings& settings, const pack::PackOutline& pack) {
    SceneRequest request;
    request.visibility = visibility_of(settings);
    return plan_scene(settings, pack, request);
}

geometry::PropShape with_one_face(geometry::PropShape shape, const std::string& name) {
    std::erase_if(shape.faces, [&](const geometry::PropFace& face) { return face.name != name; });
    return shape;
}

/// Whether an eye below the level of the prop's bottom looks into it through a lit face: rays that go up from there.
bool seen_from_below(const geometry::PropShape& shape) {
    std::mt19937 random(71);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    int through = 0;
    for (int k = 0; k < 4000; ++k) {
        const double azimuth = 3.14159 * unit(random);
        const glm::dvec3 eye(0.5 * std::cos(azimuth), 0.5 * std::sin(azimuth), -0.3 + 0.25 * unit(random));
        const glm::dvec3 at = shape.middle + 0.03 * glm::dvec3(unit(random), unit(random), unit(random));
        for (const geometry::PropFace& face : shape.faces) {
            through += face.plane.distance(eye) > 0.0 && face.plane.distance(at) < 0.0 ? 1 : 0;
        }
    }
    return through > 0;
}

TEST(OtherProp, APackForAFrustumIsRefusedWhereAFaceInTheHandIsSeenFromBelow) {
    int refused = 0;
    int shown = 0;
    for (const char* const name : {"cube", "hexagon", "tetrahedron", "gem"}) {
        const geometry::PropShape whole = solid::example_prop(name);
        std::vector<geometry::PropShape> shapes{whole};
        for (const geometry::PropFace& face : whole.faces) {
            shapes.push_back(with_one_face(whole, face.name));
        }
        for (const geometry::PropShape& shape : shapes) {
            const settings::Settings held = settings_with(solid_settings(shape, settings::PropZone::Hand));
            EXPECT_TRUE(plan_of(held, pack_for("cube"))) << name;
            const Result<ScenePlan> plan = plan_of(held, pack_for("frustum"));
            const std::string face = shape.faces.front().name;
            EXPECT_EQ(plan.has_value(), !seen_from_below(shape)) << name << ' ' << face;
            ++(plan ? shown : refused);
            if (!plan) {
                EXPECT_EQ(plan.error().id, "scene.pack_lacks_sides");
                EXPECT_NE(plan.error().message.find(face), std::string::npos) << plan.error().message;
            }
            const settings::Settings standing =
                settings_with(solid_settings(shape, settings::PropZone::Table));
            EXPECT_TRUE(plan_of(standing, pack_for("frustum"))) << name << ' ' << face;
        }
    }
    EXPECT_EQ(shown, 3); // the top alone, of three of them
    EXPECT_EQ(refused, 4 + 5 + 7 + 4 + 13);
}

TEST(OtherProp, AFrustumInTheHandNeedsAPackFromAllAround) {
    settings::PropSettings frustum;
    EXPECT_TRUE(plan_of(settings_with(frustum), pack_for("frustum")));
    EXPECT_TRUE(plan_of(settings_with(frustum), pack_for("cube")));
    frustum.zone = settings::PropZone::Hand;
    EXPECT_FALSE(plan_of(settings_with(frustum), pack_for("frustum")));
    EXPECT_TRUE(plan_of(settings_with(frustum), pack_for("cube")));
}

TEST(OtherProp, NotesTheErrorOfAPackForAnotherProp) {
    const auto note = [](const settings::PropSettings& prop, const std::string& kind) {
        const pack::PackOutline pack = pack_for(kind);
        const Result<ScenePlan> plan = plan_of(settings_with(prop), pack);
        return note_other_prop("a.fspack", prop, pack, plan.value()).value_or("");
    };
    settings::PropSettings cube = settings::cube_settings(0.12);
    EXPECT_EQ(note(cube, "cube"), "");
    EXPECT_EQ(note({}, "frustum"), "");
    EXPECT_EQ(note({}, "cube"), "") << "it has all sides";
    cube.zone = settings::PropZone::Table;
    // As high as the cube: the box is 120 mm, the error 1 % of it.
    EXPECT_NE(note(cube, "frustum").find("a.fspack: it was baked for a frustum"), std::string::npos);
    EXPECT_NE(note(cube, "frustum").find(" 1.20 mm"), std::string::npos) << note(cube, "frustum");
    const geometry::PropShape top = with_one_face(solid::example_prop("cube"), "+Z");
    EXPECT_NE(note(solid_settings(top, settings::PropZone::Hand), "frustum").find(" 1.20 mm"),
              std::string::npos);
    EXPECT_EQ(note(solid_settings(top, settings::PropZone::Table), "frustum"), "") << "any pack serves it";
}

} // namespace
} // namespace frustumscreen::scene
