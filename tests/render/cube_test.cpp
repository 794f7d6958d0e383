// A cube in the hand: six faces, lifted, in any orientation.

#include "tests/render/comparison.h"
#include "tests/render/rig.h"

#include <set>

namespace frustumscreen::synthetic {
namespace {

constexpr double edge_m = 0.12;

struct CubeRig : Rig {
    TestTable table{256, 160};

    CubeRig() : Rig(256, 160) {
        table.prop = prop = geometry::make_cube(edge_m);
        level.metres_per_box = metres_per_box(pack, prop);
        plan = scene::make_plan(prop, level);
    }
};

TEST(Cube, EveryFaceShowsWhatARayCastShows) {
    CubeRig rig;
    TestTable& table = rig.table;
    const ReferenceCast cast(rig.pack, rig.level.metres_per_box);
    std::mt19937 random(11);
    std::set<std::string_view> shown;
    for (int pose = 0; pose < 24; ++pose) {
        table.hold(random);
        scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
        for (const scene::FacePlan& face : rig.plan.faces) {
            shown.insert(table.prop.faces[static_cast<std::size_t>(face.face)].name);
        }
        const Comparison c = compare(table, cast, rig.places());
        EXPECT_LT(c.worst_mm, 0.02) << pose;
        EXPECT_EQ(c.unexcused, 0U) << pose << ": of " << c.mismatched << " mismatched";
    }
    EXPECT_EQ(shown, (std::set<std::string_view>{"+X", "-X", "+Y", "-Y", "+Z", "-Z"}));
}

TEST(Cube, ShowsTheArtifactFromBelowWhenUpsideDown) {
    CubeRig rig;
    TestTable& table = rig.table;
    table.table_from_prop = {glm::dquat(0.0, 1.0, 0.0, 0.0), {0.0, 0.0, edge_m}};
    table.eye_m = {0.0, 0.0, 0.7};
    scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
    ASSERT_EQ(rig.plan.faces.size(), 1U);
    EXPECT_EQ(table.prop.faces[static_cast<std::size_t>(rig.plan.faces[0].face)].name, "-Z");
    const Comparison c = compare(table, ReferenceCast(rig.pack, rig.level.metres_per_box), rig.places());
    EXPECT_GT(c.both, 600U);
    EXPECT_EQ(c.unexcused, 0U);
}

} // namespace
} // namespace frustumscreen::synthetic
