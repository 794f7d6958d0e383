// The status of a torch.
#include "app/show/torch_show.h"

#include <gtest/gtest.h>

namespace frustumscreen::show {
namespace {

using tracking::TorchPresence;

std::array<tracking::TrackedTorch, 2> torches(TorchPresence at_tracker, TorchPresence of_camera) {
    std::array<tracking::TrackedTorch, 2> both;
    both[0].presence = at_tracker;
    both[1].presence = of_camera;
    return both;
}

exhibit::PresentedLight light(std::size_t colour, bool left = false) {
    exhibit::PresentedLight of;
    of.brightness = 0.5;
    of.colour = colour;
    of.left = left;
    return of;
}

TEST(TorchReport, ReportsWhyNoTorchIsLit) {
    const auto none = torches(TorchPresence::Lost, TorchPresence::Lost);
    EXPECT_EQ(torch_report({}, none).state, "lost");
    EXPECT_EQ(torch_report({}, none).by, "");
    const auto lies = torches(TorchPresence::Lost, TorchPresence::Lies);
    EXPECT_EQ(torch_report({}, lies).state, "laid_down");
    EXPECT_EQ(torch_report({}, lies).by, "tag");
    const auto in_hand = torches(TorchPresence::InHand, TorchPresence::Lies);
    EXPECT_EQ(torch_report({}, in_hand).state, "dark"); // asleep, or its light only comes
    EXPECT_EQ(torch_report({}, in_hand).by, "tracker");
}

TEST(TorchReport, ReportsTheContentAndAimOfTheHeldTorch) {
    const auto both = torches(TorchPresence::InHand, TorchPresence::InHand);
    ShownTorch shown{.held = 1, .aim = exhibit::TorchAim::Lights, .lit = true, .content = "x-ray"};
    const status::TorchReport lit = torch_report(shown, both);
    EXPECT_EQ(lit.by, "tag");
    EXPECT_EQ(lit.state, "lit");
    EXPECT_EQ(lit.content, "x-ray");
    shown.lit = false;
    EXPECT_EQ(torch_report(shown, both).state, "dark");
    shown.aim = exhibit::TorchAim::Past;
    EXPECT_EQ(torch_report(shown, both).state, "past");
    shown.aim = exhibit::TorchAim::TooFar;
    EXPECT_EQ(torch_report(shown, both).state, "too_far");
}

TEST(TorchReport, NamesPlainLightWhite) {
    exhibit::Presentation presentation;
    presentation.torches.held = 0;
    presentation.torches.aim = exhibit::TorchAim::Lights;
    EXPECT_FALSE(shown_torch(presentation, nullptr).lit);
    presentation.torches.add(light(1)); // another torch
    presentation.torches.add(light(0, true));
    EXPECT_FALSE(shown_torch(presentation, nullptr).lit);
    presentation.torches.add(light(0));
    EXPECT_TRUE(shown_torch(presentation, nullptr).lit);
    EXPECT_EQ(shown_torch(presentation, nullptr).content, "white");
}

} // namespace
} // namespace frustumscreen::show
