// A text of any script is shaped into numbered glyphs, in lines, for each width.
#include "assets_baked/texts/shape.h"

#include <gtest/gtest.h>

namespace frustumscreen {
namespace {

TEST(RoomExample, Texts) {
    // example
    const Shaper shaper = Shaper::open().value();
    const std::int32_t wide = 20 * em_units, narrow = 5 * em_units;
    const ShapedText text = shaper.shape({"Amphora signed Exekias", "en", {wide, narrow}}).value();
    EXPECT_EQ(text.direction, TextDirection::LeftToRight);
    ASSERT_EQ(text.settings.size(), 2U);
    EXPECT_EQ(text.settings[0].lines.size(), 1U);
    EXPECT_EQ(text.settings[1].lines.size(), 3U); // a word a line

    EXPECT_EQ(direction_of("he"), TextDirection::RightToLeft);
    // end
}

} // namespace
} // namespace frustumscreen
