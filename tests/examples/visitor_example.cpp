// A head is found in the foreground, and its position follows from its apparent width.
#include "app/settings/looking_at.h"
#include "app/visitor/head_fit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace frustumscreen::example {
namespace {

std::vector<std::uint8_t> head_and_shoulders() {
    std::vector<std::uint8_t> foreground;
    for (int k = 0; k < 320 * 180; ++k) {
        const double x = k % 320 + 0.5 - 160.0, y = static_cast<int>(k / 320) + 0.5 - 80.0;
        const bool is_head = x * x / (15.0 * 15.0) + y * y / (19.5 * 19.5) < 1.0;
        foreground.push_back(is_head || (y > 12.0 && std::abs(x) < 40.0) ? 255 : 0);
    }
    return foreground;
}

TEST(RoomExample, Visitor) {
    // example
    const geometry::Pinhole camera{320, 180, 147.0, 147.0, 160.0, 90.0};
    const geometry::RigidTransform table_from_camera =
        *settings::looking_at({0.0, 0.28, 0.12}, {0.0, -0.60, 0.44}, 0.0);
    const std::vector<std::uint8_t> foreground = head_and_shoulders(); // a head 30 pixels wide
    const std::vector<visitor::HeadOutline> outlines =
        visitor::find_head_outlines(foreground, camera.width, camera.height);
    ASSERT_EQ(outlines.size(), 1U);
    const std::optional<visitor::FittedHead> head =
        visitor::fit_head(outlines[0], camera, table_from_camera, visitor::HeadZone{});
    ASSERT_TRUE(head);
    EXPECT_NEAR(head->width_px, 30.0, 1.5);
    EXPECT_NEAR(glm::distance(head->pixel, glm::dvec2(160.0, 80.0)), 0.0, 1.5);
    const double away_m = glm::distance(head->middle_m, table_from_camera.translation);
    EXPECT_NEAR(away_m, 147.0 * 0.172 / 30.0, 0.08); // a usual head is 0.172 m wide
    // end
}

} // namespace
} // namespace frustumscreen::example
