// The torches' light that a window keeps: each place of the window's world has the light of its place in the prop.

#include "app/show/window_light.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <random>

namespace frustumscreen::show {
namespace {

scene::PlacedTorch torch_at(const glm::dvec3& place, const glm::dquat& turn) {
    torch::Beam beam;
    beam.attenuation = torch::Attenuation::SmoothStep;
    beam.full_m = 0.1;
    beam.dark_m = 0.9;
    return scene::placed(torch::white(), beam, {turn, place}, 0.0);
}
constexpr glm::dquat downwards{0.0, 1.0, 0.0, 0.0};

TEST(KeptLight, LightsEachPointInTheWindowAsInTheProp) {
    const geometry::RigidTransform table_from_prop{glm::angleAxis(0.7, glm::dvec3(0.0, 0.0, 1.0)),
                                                   {0.03, -0.02, 0.0}};
    const scene::PinnedView view = scene::pin_view({.table_from_prop = table_from_prop,
                                                    .prop_middle = {0.0, 0.0, 0.05},
                                                    .eye_m = {0.1, -0.5, 0.6},
                                                    .world = {.middle = {0.0, 0.0, 0.05}, .radius = 0.08},
                                                    .place = {.middle_m = {0.2, 0.1}, .yaw_rad = 0.5}})
                                       .value();
    const std::array torches{torch_at({0.02, 0.03, 0.5}, downwards)};
    WindowLight light;
    light.keep({.torches = torches, .table_from_prop = table_from_prop, .house_light = 0.4});
    ASSERT_TRUE(light.is_lit());
    EXPECT_EQ(light.house_light(), 0.4);
    geometry::RigidTransform pushed = view.table_from_window; // by the prop
    pushed.translation += glm::dvec3(0.05, -0.03, 0.0);
    const scene::PlacedTorch in_window = light.behind(view, pushed).front();
    std::mt19937 random(1);
    std::uniform_real_distribution<double> u(-0.1, 0.1);
    int lit = 0;
    for (int k = 0; k < 1000; ++k) {
        const glm::dvec3 in_prop(u(random), u(random), 0.05 + u(random));
        const glm::dvec3 behind = pushed.point(glm::dvec3(view.window_from_prop * glm::dvec4(in_prop, 1.0)));
        const double expected = torch::intensity_at(
            torches[0].beam, torches[0].table_from_torch.inverse().point(table_from_prop.point(in_prop)));
        EXPECT_NEAR(torch::intensity_at(in_window.beam, in_window.table_from_torch.inverse().point(behind)),
                    expected, 1e-9);
        lit += expected > 0.0 ? 1 : 0;
    }
    EXPECT_GT(lit, 200);
    EXPECT_LT(lit, 900);
    EXPECT_NEAR(in_window.scale, view.scale, 1e-12);
}

TEST(KeptLight, DropsTorchesThatAreOffOrMissTheWorld) {
    std::array torches{torch_at({0.0, 0.0, 0.5}, downwards), torch_at({0.6, 0.0, 0.5}, downwards),
                       torch_at({0.0, 0.0, 0.5}, glm::dquat(1.0, 0.0, 0.0, 0.0)),
                       torch_at({0.0, 0.0, 0.5}, downwards)};
    torches[3].brightness = 0.0F;
    WindowLight light;
    light.keep({.torches = torches, .table_from_prop = {}});
    light.leave_out_beside({.middle = {0.0, 0.0, 0.05}, .radius = 0.08});
    const scene::PinnedView view{.surface = {}, .table_from_window = {}};
    EXPECT_EQ(light.behind(view, {}).size(), 1U);
    EXPECT_EQ(light.house_light(), 1.0) << "without a house's light given";
}

TEST(KeptLight, FadesOutTexturesWhenTheirArtifactLeaves) {
    std::array torches{torch_at({0.0, 0.0, 0.5}, downwards), torch_at({0.0, 0.0, 0.5}, downwards),
                       torch_at({0.0, 0.0, 0.5}, downwards)};
    torches[0].picture = scene::TextureId{7};
    torches[1].stages[0].source = torch::Source::Layer;
    const scene::PinnedView view{.surface = {}, .table_from_window = {}};
    MonotonicTime now;
    constexpr auto frame = std::chrono::milliseconds(20);
    WindowLight light;
    light.keep({.torches = torches, .table_from_prop = {}, .house_light = 0.4});
    EXPECT_FALSE(light.fade_textures(now, true));
    EXPECT_FALSE(light.fades());
    EXPECT_TRUE(light.shows_textures());
    double before = 1.0;
    int frames = 0;
    for (bool left_out = false; !left_out; ++frames) {
        ASSERT_LT(frames, 30) << "half a second";
        left_out = light.fade_textures(now += frame, false);
        const auto behind = light.behind(view, {});
        ASSERT_EQ(behind.size(), left_out ? 1U : 3U);
        EXPECT_EQ(behind.back().brightness, 1.0F) << "plain light stays";
        const double share = left_out ? 0.0 : double{behind.front().brightness};
        EXPECT_LT(share, before);
        EXPECT_LT(before - share, 0.05) << "a flash";
        before = share;
    }
    EXPECT_GE(frames, 24);
    EXPECT_FALSE(light.shows_textures());
    EXPECT_TRUE(light.is_lit());
    EXPECT_FALSE(light.fade_textures(now += frame, false)) << "nothing is left to leave out";
    EXPECT_EQ(light.house_light(), 0.4) << "plain light is left";
    light.put_out();
    EXPECT_FALSE(light.is_lit());
    EXPECT_EQ(light.house_light(), 1.0);
}

TEST(KeptLight, FadesTheHouseLightWhenTheArtifactLeavesOrReturns) {
    std::array torches{torch_at({0.0, 0.0, 0.5}, downwards)};
    torches[0].picture = scene::TextureId{7};
    MonotonicTime now;
    constexpr auto frame = std::chrono::milliseconds(20);
    WindowLight light;
    light.keep({.torches = torches, .table_from_prop = {}, .house_light = 0.4});
    static_cast<void>(light.fade_textures(now, true));
    double house = light.house_light();
    EXPECT_EQ(house, 0.4);
    const auto goes_to = [&](bool is_on_show, int frames) {
        for (int k = 0; k < frames; ++k) {
            static_cast<void>(light.fade_textures(now += frame, is_on_show));
            EXPECT_LT(std::fabs(light.house_light() - house), 0.03) << "a flash";
            house = light.house_light();
        }
    };
    goes_to(false, 12);
    EXPECT_GT(house, 0.6);
    goes_to(true, 20);
    EXPECT_EQ(house, 0.4) << "the artifact is back";
    EXPECT_FALSE(light.fades());
    goes_to(false, 30);
    EXPECT_EQ(house, 1.0);
    EXPECT_FALSE(light.is_lit());
}

} // namespace
} // namespace frustumscreen::show
