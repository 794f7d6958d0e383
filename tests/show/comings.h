/// A show of packs in a folder, stepped as in the run loop.
#pragma once

#include "app/render/read_back.h"
#include "app/scene/device_plan.h"
#include "app/show/artifact_show.h"
#include "firmware_host/display/surfaceless_display.h"
#include "tests/show/shown_packs.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <thread>
#include <vector>

namespace frustumscreen::synthetic {

class ArtifactShowTest : public ::testing::Test {
protected:
    ArtifactShowTest() {
        settings.projector.pinhole = settings.projector.pinhole.scaled_to(320, 200);
        settings.exhibit.captions = false;
    }
    void start(std::size_t packs, bool waits) {
        options.packs = std::vector(files.files().begin(), files.files().begin() + static_cast<long>(packs));
        options.waits = waits;
        devices.other_packs = true;
        auto made = show::ArtifactShow::create(settings, devices, options, {display->framebuffer(), 0});
        ASSERT_TRUE(made) << made.error().message;
        show = *std::move(made);
        exhibit.emplace(show::make_exhibit(settings, *show, now));
    }
    exhibit::Presentation step(std::span<const settings::Command> commands = {}) {
        now += std::chrono::milliseconds(20);
        tracking::TrackedState tracked_state;
        tracked_state.prop_known = true;
        tracked_state.eye_m = settings.eye.default_m;
        exhibit->note(show->artifacts());
        exhibit::Presentation presentation = exhibit->step(now, commands, tracked_state);
        static_cast<void>(show->draw(now, presentation, std::span(&tracked_state.eye_m, 1),
                                     {display->framebuffer(), 0}, render::Redraw::Everything));
        return presentation;
    }
    /// Steps until the artifact is ready; may loop forever.
    void await(std::size_t artifact) {
        while (show->artifacts()[artifact] == exhibit::ArtifactState::Away) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            step();
        }
    }
    void rest() {
        for (int k = 0; k < 100; ++k) {
            step();
        }
    }
    /// The blue of the brightest texel, which identifies the artifact; nothing if the picture is dark.
    std::optional<int> shown_blue() {
        const image::Image8 picture = render::read_colour(display->framebuffer(), 320, 200);
        std::optional<int> blue;
        int most = 60;
        for (const glm::u8vec4& texel : picture.texels) {
            if (texel.r > most) {
                most = texel.r;
                blue = texel.b;
            }
        }
        return blue;
    }

    ShownPacks files{5};
    settings::Settings settings = settings::steep_table();
    show::ArtifactShowOptions options;
    scene::DevicePlan devices;
    std::unique_ptr<display::SurfacelessDisplay> display =
        display::SurfacelessDisplay::create(320, 200).value();
    std::unique_ptr<show::ArtifactShow> show;
    std::optional<exhibit::Exhibit> exhibit;
    MonotonicTime now{std::chrono::seconds(100)};
    const std::array<settings::Command, 1> next{settings::Command::NextArtifact};
};

} // namespace frustumscreen::synthetic
