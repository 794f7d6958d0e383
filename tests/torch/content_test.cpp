// A stage at a time: where its picture has scrolled, turned and pulsed to.

#include "app/torch/content.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <vector>

namespace frustumscreen::torch {
namespace {

constexpr std::array sources{Source::Plain, Source::Picture, Source::Film,  Source::Layer,
                             Source::Ring,  Source::Grid,    Source::Ruler, Source::Lens};

glm::dvec2 in_stage(const StageAt& at, const glm::dvec2& content) {
    return at.stage_from_content * glm::vec3(glm::vec2(content), 1.0F);
}

TEST(Content, AStaticStageKeepsTheContent) {
    for (const Source source : sources) {
        for (const double seconds : {0.0, 0.3, 1e6}) {
            const StageAt at = stage_at({.source = source, .opacity = 0.75}, 0.6, seconds);
            for (const glm::dvec2& place : {glm::dvec2(0.0), glm::dvec2(1.0, 0.0), glm::dvec2(0.25, 0.75)}) {
                EXPECT_LT(glm::distance(in_stage(at, place), place), 1e-7);
            }
            EXPECT_EQ(at.opacity, 0.75F);
        }
    }
}

/// A picture that scrolls by a positive share goes to the right and down.
TEST(Content, ScrollsToTheRightAndDown) {
    const Stage stage{.source = Source::Ring, .scroll_per_s = {0.25, 0.125}};
    const StageAt at = stage_at(stage, 0.5, 2.0);
    EXPECT_LT(glm::distance(in_stage(at, {0.75, 0.5}), glm::dvec2(0.25, 0.25)), 1e-7);
}

/// Seen from the torch, whose content has +Y down: what was above the middle is to the right of it after a quarter.
TEST(Content, TurnsClockwiseWithRightAngles) {
    const Stage stage{.source = Source::Picture, .turn_rad_per_s = std::numbers::pi / 4.0};
    const double height_per_width = 0.5;
    const StageAt at = stage_at(stage, height_per_width, 2.0);
    // A quarter of the width to the right of the middle is half of the height.
    EXPECT_LT(glm::distance(in_stage(at, {0.75, 0.5}), glm::dvec2(0.5, 0.0)), 1e-6);
    EXPECT_LT(glm::distance(in_stage(at, {0.5, 1.0}), glm::dvec2(0.75, 0.5)), 1e-6);
    EXPECT_LT(glm::distance(in_stage(at, {0.5, 0.5}), glm::dvec2(0.5, 0.5)), 1e-7);
    for (const double seconds : {0.1, 0.7, 3.3}) { // lengths in units of the width stay
        const StageAt turned = stage_at(stage, height_per_width, seconds);
        const glm::dvec2 shape(1.0, height_per_width);
        const glm::dvec2 across = (in_stage(turned, {1.0, 0.5}) - in_stage(turned, {0.0, 0.5})) * shape;
        const glm::dvec2 down = (in_stage(turned, {0.5, 1.0}) - in_stage(turned, {0.5, 0.0})) * shape;
        EXPECT_NEAR(glm::length(across), 1.0, 1e-6);
        EXPECT_NEAR(glm::length(down), height_per_width, 1e-6);
        EXPECT_NEAR(glm::dot(across, down), 0.0, 1e-6);
    }
}

TEST(Content, PulsesBetweenItsOpacityAndItsDepth) {
    const Stage stage{.source = Source::Plain, .opacity = 0.8, .pulse_hz = 0.5, .pulse_depth = 0.25};
    EXPECT_FLOAT_EQ(stage_at(stage, 1.0, 0.0).opacity, 0.8F);
    EXPECT_FLOAT_EQ(stage_at(stage, 1.0, 0.5).opacity, 0.7F);
    EXPECT_FLOAT_EQ(stage_at(stage, 1.0, 1.0).opacity, 0.6F);
    EXPECT_FLOAT_EQ(stage_at(stage, 1.0, 2.0).opacity, 0.8F);
    const Stage whole{.source = Source::Plain, .pulse_hz = 1.0, .pulse_depth = 1.0};
    EXPECT_NEAR(stage_at(whole, 1.0, 0.5).opacity, 0.0F, 1e-7);
}

/// How far two places of a stage that repeats are apart.
double apart(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& period) {
    const glm::dvec2 difference = (a - b) / period;
    return glm::length((difference - glm::round(difference)) * period);
}

/// A visitor's day: no frame jumps, and no digit is lost.
TEST(Content, MovesWithoutJumpsForHours) {
    const double step_s = 1e-3;
    for (const Source source : {Source::Picture, Source::Film, Source::Grid}) {
        const Stage stage{.source = source,
                          .size = 0.3,
                          .scroll_per_s = {0.37, -0.21},
                          .turn_rad_per_s = 0.4,
                          .pulse_hz = 0.9,
                          .pulse_depth = 1.0};
        const double shape = 0.6;
        const glm::dvec2 period =
            source == Source::Grid ? glm::dvec2(stage.size, stage.size / shape) : glm::dvec2(1.0);
        const double speed = glm::length(stage.scroll_per_s) + stage.turn_rad_per_s / shape;
        for (const double begin : {0.0, 3600.0, 10.0 * 3600.0, 1e6}) {
            for (int k = 0; k < 5000; ++k) {
                const double now = begin + k * step_s;
                const StageAt before = stage_at(stage, shape, now);
                const StageAt after = stage_at(stage, shape, now + step_s);
                for (const glm::dvec2& place : {glm::dvec2(0.5), glm::dvec2(0.1, 0.9)}) {
                    ASSERT_LT(apart(in_stage(before, place), in_stage(after, place), period),
                              1.01 * speed * step_s + 1e-6)
                        << source_names[static_cast<std::size_t>(source)] << " at " << now;
                }
                ASSERT_LT(std::fabs(before.opacity - after.opacity),
                          std::numbers::pi * stage.pulse_hz * step_s + 1e-6);
            }
        }
    }
}

/// After whole periods of the scroll, the turn and the pulse a stage is as it began, hours later too.
TEST(Content, RepeatsAfterWholePeriods) {
    const Stage stage{.source = Source::Picture,
                      .scroll_per_s = {0.25, 0.5},
                      .turn_rad_per_s = 2.0 * std::numbers::pi / 8.0,
                      .pulse_hz = 0.125,
                      .pulse_depth = 0.5};
    const StageAt began = stage_at(stage, 0.75, 1.0);
    for (const double periods : {1.0, 450.0, 4500.0, 1e5}) { // up to nine days
        const StageAt later = stage_at(stage, 0.75, 1.0 + 8.0 * periods);
        EXPECT_LT(glm::distance(in_stage(later, {0.2, 0.3}), in_stage(began, {0.2, 0.3})), 1e-6) << periods;
        EXPECT_NEAR(later.opacity, began.opacity, 1e-6);
    }
}

TEST(Content, WhiteIsOneStageOfPlainLight) {
    const Content content = white();
    EXPECT_EQ(content.name, white_name);
    ASSERT_EQ(content.stages.size(), 1U);
    EXPECT_EQ(content.stages.front(), Stage{});
    EXPECT_EQ(content.blend, Blend::Light);
    EXPECT_FALSE(content.shape);
}

TEST(Content, NamesMatchTheirEnumerators) {
    EXPECT_EQ(source_names.size(), std::set(source_names.begin(), source_names.end()).size());
    EXPECT_EQ(source_names[static_cast<std::size_t>(Source::Lens)], "lens");
    EXPECT_EQ(mix_names[static_cast<std::size_t>(Mix::Add)], "add");
    EXPECT_EQ(blend_names[static_cast<std::size_t>(Blend::Over)], "over");
    EXPECT_EQ(shape_names[static_cast<std::size_t>(Shape::Rectangle)], "rectangle");
    EXPECT_EQ(attenuation_names[static_cast<std::size_t>(Attenuation::None)], "none");
}

} // namespace
} // namespace frustumscreen::torch
