// The plan of a scene lists what it needs before anything is read. Here it needs one of three mesh levels.
#include "app/scene/scene_plan.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Scene) {
    // example
    const settings::Settings settings; // the exhibit as shipped
    pack::PackOutline pack;
    pack.levels.resize(3); // coarse to fine
    pack.description.extremes = {{-0.5, -0.5, 0.0}, {0.5, 0.5, 1.0}};
    scene::SceneRequest request;
    request.technique = "level1";
    request.live = false; // no governor
    request.visibility = scene::visibility_of(settings);
    const scene::ScenePlan plan = scene::plan_scene(settings, pack, request).value();
    EXPECT_EQ(plan.levels, std::vector<std::uint32_t>{1}); // the other two are not read
    EXPECT_EQ(plan.faces, 0b11111U);                       // a visitor can see all five faces of the prop
    // end
}

} // namespace
} // namespace frustumscreen::example
