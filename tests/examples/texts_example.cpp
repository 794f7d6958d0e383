// A text of any script is shaped into numbered glyphs, in lines, for each width.
#include "assets_baked/texts/shape.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Texts) {
    // example
    const texts::Shaper shaper = texts::Shaper::open().value();
    const std::int32_t wide = 20 * pack::em_units, narrow = 5 * pack::em_units;
    const texts::ShapedText text = shaper.shape({"Amphora signed Exekias", "en", {wide, narrow}}).value();
    EXPECT_EQ(text.direction, pack::TextDirection::LeftToRight);
    ASSERT_EQ(text.settings.size(), 2U);
    EXPECT_EQ(text.settings[0].lines.size(), 1U);
    EXPECT_EQ(text.settings[1].lines.size(), 3U); // a word a line

    EXPECT_EQ(texts::direction_of("he"), pack::TextDirection::RightToLeft);
    // end
}

} // namespace
} // namespace frustumscreen::example
