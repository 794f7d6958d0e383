// Captions lie on the table, never on the prop.

#include "tests/render/rig.h"

namespace frustumscreen::synthetic {
namespace {

class Captions : public ::testing::TestWithParam<int> {};

TEST_P(Captions, AppearAtTheirPlaceAndNeverOnTheProp) {
    Rig rig(320, 200, GetParam());
    TestTable table(320, 200, false);
    // Left half white, right half empty; 0.2 m wide from the prop's middle to the right.
    image::Image<std::uint8_t> coverage(64, 32);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            coverage.at(x, y) = 255;
        }
    }
    const scene::TextureId caption = rig.renderer->store().upload(coverage).value();
    scene::PlanView view = table.view();
    view.caption = scene::TablePicture{{glm::dvec3(0.0, 0.03, 0.0), glm::dvec3(0.2, 0.03, 0.0),
                                        glm::dvec3(0.2, -0.03, 0.0), glm::dvec3(0.0, -0.03, 0.0)},
                                       1.0,
                                       caption};
    scene::plan_frame(table.prop, rig.level, view, rig.plan);
    ASSERT_GE(rig.plan.faces.size(), 2U);
    rig.renderer->draw(rig.plan, {rig.display->framebuffer(), 0}, render::Redraw::Everything);
    const image::Image8 both = rig.picture();
    scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
    rig.renderer->draw(rig.plan, {rig.display->framebuffer(), 0}, render::Redraw::Everything);
    const image::Image8 alone = rig.picture();

    const glm::dvec3 projector(0.0, 0.0, 0.9);
    int white = 0;
    for (int y = 0; y < 200; ++y) {
        for (int x = 0; x < 320; ++x) {
            const glm::dvec2 pixel(x + 0.5, y + 0.5);
            const glm::dvec3 ray = table.table_from_projector.direction(table.projector.ray(pixel));
            const glm::dvec3 on_table = projector - ray * (0.9 / ray.z);
            geometry::PropHit hit;
            if (geometry::intersect(table.prop, projector, ray, hit)) {
                ASSERT_EQ(both.at(x, y), alone.at(x, y)) << x << ' ' << y;
            } else if (on_table.x > 0.0 && on_table.x < 0.095 && std::abs(on_table.y) < 0.028) {
                ASSERT_EQ(both.at(x, y), glm::u8vec4(255)) << x << ' ' << y;
                ++white;
            } else if (on_table.x < -0.01 || on_table.x > 0.11 || std::abs(on_table.y) > 0.035) {
                ASSERT_EQ(both.at(x, y), glm::u8vec4(0, 0, 0, 255)) << x << ' ' << y;
            }
        }
    }
    EXPECT_GT(white, 40);
}

INSTANTIATE_TEST_SUITE_P(Samples, Captions, ::testing::Values(1, 4));

} // namespace
} // namespace frustumscreen::synthetic
