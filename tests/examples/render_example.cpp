// The renderer draws a frame plan into a display's framebuffer. Here a caption lies on the table.
#include "app/render/read_back.h"
#include "app/render/renderer.h"
#include "app/settings/settings.h"
#include "firmware_host/display/surfaceless_display.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace frustumscreen {
namespace {

constexpr std::array<glm::dvec3, 4> caption_corners{glm::dvec3(0.10, 0.05, 0.0), glm::dvec3(0.20, 0.05, 0.0),
                                                    glm::dvec3(0.20, 0.0, 0.0), glm::dvec3(0.10, 0.0, 0.0)};

TEST(RoomExample, Render) {
    // example
    const auto display = SurfacelessDisplay::create(320, 200).value();
    Renderer renderer = Renderer::create(320, 200, {1, {{ShaderKey::Pass::TablePicture}}}).value();
    const ProjectorSettings projector;
    const glm::dvec3 eye_m(0.0, -0.55, 0.50);
    PlanView view{projector.pinhole.scaled_to(320, 200), projector.table_from_projector, {}, {&eye_m, 1}};
    view.table_from_prop.translation = {-0.2, 0.0, 0.0}; // dark: it shows no artifact
    view.caption = TablePicture{caption_corners};        // 0.10 m x 0.05 m of the table
    view.caption->texture = renderer.store().upload(Image<std::uint8_t>(16, 16, 255)).value(); // white
    const PropShape prop = make_frustum({});
    FramePlan plan = make_plan(prop, PlacedLevel{});
    plan_frame(prop, PlacedLevel{}, view, plan);
    renderer.draw(plan, {display->framebuffer(), display->buffer_age()});
    ASSERT_TRUE(display->present(MonotonicTime{}));
    const Image8 picture = read_colour(display->framebuffer(), 320, 200);
    EXPECT_EQ(std::count(picture.texels.begin(), picture.texels.end(), glm::u8vec4(255)),
              40 * 20); // 2.5 mm each
    // end
}

} // namespace
} // namespace frustumscreen
