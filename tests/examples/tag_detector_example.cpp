// The detector finds printed tags in a grey picture, and their corners in pixels.
#include "firmware_host/tags/tag_detector.h"
#include "firmware_host/tags/tag_picture.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, TagDetector) {
    // example
    constexpr std::size_t module_px = 12, side_px = module_px * tags::tag_modules;
    const tags::TagModules printed = tags::tag_modules_of(7);
    std::vector<std::uint8_t> luma(side_px * side_px);
    for (std::size_t k = 0; k < luma.size(); ++k) {
        luma[k] = printed[k / side_px / module_px][k % side_px / module_px] ? 255 : 0;
    }
    tags::TagDetector detector;
    std::vector<tags::FoundTag> found;
    detector.find(luma, side_px, side_px, found);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].id, 7);
    EXPECT_NEAR(found[0].corners_px[0].x, 12.0, 0.5); // behind a white margin of one module
    // end
}

} // namespace
} // namespace frustumscreen::example
