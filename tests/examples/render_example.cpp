// The renderer draws a frame plan into a display's framebuffer. Here a caption lies on the table.
#include "app/render/read_back.h"
#include "app/render/renderer.h"
#include "app/settings/settings.h"
#include "firmware_host/display/surfaceless_display.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace frustumscreen::example {
namespace {

constexpr std::array<glm::dvec3, 4> caption_corners{glm::dvec3(0.10, 0.05, 0.0), glm::dvec3(0.20, 0.05, 0.0),
                                                    glm::dvec3(0.20, 0.0, 0.0), glm::dvec3(0.10, 0.0, 0.0)};

TEST(RoomExample, Render) {
    // example
    const auto display = display::SurfacelessDisplay::create(320, 200).value();
    render::Renderer renderer =
        render::Renderer::create(320, 200, {1, {{scene::ShaderKey::Pass::TablePicture}}}).value();
    const settings::ProjectorSettings projector;
    const glm::dvec3 eye_m(0.0, -0.55, 0.50);
    scene::PlanView view{
        projector.pinhole.scaled_to(320, 200), projector.table_from_projector, {}, {&eye_m, 1}};
    view.table_from_prop.translation = {-0.2, 0.0, 0.0}; // dark: it shows no artifact
    view.caption = scene::TablePicture{caption_corners}; // 0.10 m x 0.05 m of the table
    view.caption->texture = renderer.store().upload(image::Image<std::uint8_t>(16, 16, 255)).value(); // white
    const geometry::PropShape prop = geometry::make_frustum({});
    scene::FramePlan plan = scene::make_plan(prop, scene::PlacedLevel{});
    scene::plan_frame(prop, scene::PlacedLevel{}, view, plan);
    renderer.draw(plan, {display->framebuffer(), display->buffer_age()});
    ASSERT_TRUE(display->present(MonotonicTime{}));
    const image::Image8 picture = render::read_colour(display->framebuffer(), 320, 200);
    EXPECT_EQ(std::count(picture.texels.begin(), picture.texels.end(), glm::u8vec4(255)),
              40 * 20); // 2.5 mm each
    // end
}

} // namespace
} // namespace frustumscreen::example
