// If the visitor sees a face that is not lit, advise finds the one move that corrects it.
#include "app/guidance/advise.h"
#include "app/settings/settings.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Guidance) {
    // example
    const settings::ProjectorSettings projector; // its picture is 0.8 m wide on the table
    const guidance::FaceReader reader(
        {geometry::make_frustum({0.16, 0.09, 0.12}), projector.pinhole, projector.table_from_projector});
    guidance::GuidedState state;
    state.table_from_prop.translation = {0.36, 0.0, 0.0}; // 4 cm of the prop stand outside the picture
    state.eye_m = {0.0, -0.55, 0.50};
    EXPECT_FALSE(reader.valid(state));

    const std::optional<guidance::Advice> advice = guidance::advise(reader, state);
    ASSERT_TRUE(advice);
    EXPECT_EQ(advice->move.action, guidance::Action::Slide);
    EXPECT_LT(advice->move.by_m.x, -0.04); // to the left, by 4 cm and more
    EXPECT_TRUE(reader.valid(guidance::after(advice->move, reader.setup(), state)));
    // end
}

} // namespace
} // namespace frustumscreen::example
