// A torch is a beam and a content. Here: plain light through a beam of 90 degrees. Its intensity falls with the square of
// the distance, and the beam ends where the eye no longer sees it.
#include "app/torch/content.h"
#include "app/torch/torch.h"

#include <gtest/gtest.h>

#include <numbers>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Torch) {
    // example
    const torch::Beam beam{.opening_rad = std::numbers::pi / 2.0, .full_m = 0.5};
    EXPECT_DOUBLE_EQ(torch::intensity_at(beam, {0.0, 0.0, 1.0}), 0.25); // twice as far: a quarter
    EXPECT_DOUBLE_EQ(torch::reach_m(beam), 5.0);                        // ten times as far: a hundredth
    EXPECT_FALSE(torch::place_in_content(beam, {1.1, 0.0, 1.0}));       // beside the beam
    EXPECT_DOUBLE_EQ(torch::place_in_content(beam, {0.5, 0.0, 1.0})->x, 0.75);

    torch::Content content = torch::white();
    content.stages.front().pulse_hz = 1.0;
    content.stages.front().pulse_depth = 0.5;
    EXPECT_FLOAT_EQ(torch::stage_at(content.stages.front(), 1.0, 0.5).opacity, 0.5F);
    // end
}

} // namespace
} // namespace frustumscreen::example
