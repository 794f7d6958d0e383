// Several parts in one prop: the nearest is visible.

#include "tests/render/comparison.h"
#include "tests/render/counted_new.h"
#include "tests/render/rig.h"

namespace frustumscreen::synthetic {
namespace {

/// Two artifacts of different sizes, one inside the other.
struct NestedRig : Rig {
    pack::Pack inner_pack = rings(16, 8);
    scene::PlacedLevel inner;

    NestedRig() : Rig(256, 160) {
        inner = scene::placed(inner_pack, 0, 0.7 * level.metres_per_box,
                              renderer->store().upload(inner_pack, 0).value());
        plan = scene::make_plan(prop, level.triangles->indices.size() + inner.triangles->indices.size(), 2);
    }
    [[nodiscard]] std::array<scene::Part, 2> parts() const {
        return {scene::Part{level, {}}, scene::Part{inner, {}}};
    }
};

/// The first hit of either artifact.
struct NestedCast {
    ReferenceCast outer, inner;

    [[nodiscard]] ReferenceCast::Hit through_pixel(const TestTable& table, const glm::dvec2& pixel) const {
        const glm::dvec3 eye = table.table_from_prop.inverse().point(table.eye_m);
        const ReferenceCast::Hit a = outer.through_pixel(table, pixel);
        const ReferenceCast::Hit b = inner.through_pixel(table, pixel);
        const bool first = a.found && (!b.found || glm::distance(a.point, eye) < glm::distance(b.point, eye));
        return first ? a : b;
    }
};

TEST(Parts, PlacesMatchARayCastOfAllParts) {
    NestedRig rig;
    const NestedCast cast{{rig.pack, rig.level.metres_per_box}, {rig.inner_pack, rig.inner.metres_per_box}};
    TestTable table(256, 160);
    std::mt19937 random(7);
    for (int pose = 0; pose < 5; ++pose) {
        table.shuffle(random);
        scene::plan_frame(table.prop, rig.parts(), table.view(), rig.plan);
        const Comparison c = compare(table, cast, rig.places());
        EXPECT_GT(c.both, 600U) << pose;
        EXPECT_LT(c.worst_mm, 0.02) << pose;
        EXPECT_EQ(c.unexcused, 0U) << pose << ": of " << c.mismatched << " mismatched";
    }
}

TEST(Parts, OrderDoesNotChangeThePicture) {
    NestedRig rig;
    TestTable table(256, 160);
    std::mt19937 random(22);
    for (int pose = 0; pose < 5; ++pose) {
        table.shuffle(random);
        scene::plan_frame(table.prop, rig.parts(), table.view(scene::LightCompensation{}), rig.plan);
        rig.draw(render::Redraw::Everything);
        const image::Image8 picture = rig.picture();
        const std::array<scene::Part, 2> turned{rig.parts()[1], rig.parts()[0]};
        scene::plan_frame(table.prop, turned, table.view(scene::LightCompensation{}), rig.plan);
        rig.draw(render::Redraw::Everything);
        EXPECT_EQ(rig.picture().texels, picture.texels) << pose;
    }
}

TEST(Parts, TwoHalvesGiveThePictureOfTheWhole) {
    Rig rig(320, 200, 4);
    TestTable table(320, 200);
    scene::plan_frame(table.prop, rig.level, table.view(scene::LightCompensation{}), rig.plan);
    rig.draw();
    const image::Image8 whole = rig.picture();
    std::array<scene::Part, 2> halves{scene::Part{rig.level, {}}, scene::Part{rig.level, {}}};
    for (std::size_t half = 0; half < halves.size(); ++half) {
        pack::PackLevel level = rig.pack.levels[0];
        const auto middle = level.clusters.begin() + static_cast<std::ptrdiff_t>(level.clusters.size() / 2);
        level.clusters = half == 0 ? std::vector(level.clusters.begin(), middle)
                                   : std::vector(middle, level.clusters.end());
        halves[half].level.triangles =
            std::make_shared<scene::LevelTriangles>(scene::triangles_of(level, rig.pack.box_size));
    }
    rig.plan = scene::make_plan(rig.prop, 2 * rig.pack.levels[0].indices.size(), 2);
    scene::plan_frame(table.prop, halves, table.view(scene::LightCompensation{}), rig.plan);
    EXPECT_GT(rig.plan.draws.size(), rig.plan.faces.size());
    EXPECT_TRUE(rig.draw(render::Redraw::Everything).drawn);
    EXPECT_EQ(rig.picture().texels, whole.texels);
}

TEST(Parts, AllocateNothingWithACaption) {
    if (!allocations_are_counted) {
        GTEST_SKIP() << "allocations are not counted under a sanitizer";
    }
    NestedRig rig;
    const scene::TextureId caption =
        rig.renderer->store().upload(image::Image<std::uint8_t>(64, 32, 255)).value();
    TestTable table(256, 160);
    std::mt19937 random(5);
    long counted = 0;
    for (int k = 0; k < 60; ++k) {
        table.shuffle(random);
        scene::PlanView view = table.view(scene::LightCompensation{});
        view.caption = scene::TablePicture{{glm::dvec3(-0.2, 0.13, 0.0), glm::dvec3(-0.1, 0.13, 0.0),
                                            glm::dvec3(-0.1, 0.09, 0.0), glm::dvec3(-0.2, 0.09, 0.0)},
                                           1.0,
                                           caption};
        const std::array<scene::Part, 2> parts = rig.parts();
        const long before = allocations_so_far();
        scene::plan_frame(rig.prop, parts, view, rig.plan);
        counted += allocations_so_far() - before;
        const long before_draw = allocations_so_far();
        rig.draw();
        counted += k < 20 ? 0 : allocations_so_far() - before_draw; // llvmpipe compiles in its first frames
    }
    EXPECT_EQ(counted, 0);
}

} // namespace
} // namespace frustumscreen::synthetic
