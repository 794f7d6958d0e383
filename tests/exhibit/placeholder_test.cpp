// The picture in the prop's place while the chosen artifact is not ready.

#include "tests/exhibit/exhibits.h"
#include "tests/exhibit/flash_counter.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace frustumscreen::exhibit {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

using sample::start;
constexpr Nanoseconds frame = std::chrono::nanoseconds(1'000'000'000 / 120);

typography::TableRectangle square(const glm::dvec2& centre_m, double side_m) {
    return {centre_m, glm::dvec2(side_m), 0};
}

/// Artifact 1 is shown; 4 is chosen and not ready.
Placeholder::Input leaving_for_4(double brightness) {
    Placeholder::Input input;
    input.shown = {1, brightness, "en", brightness, true, true};
    input.chosen = 4;
    input.chosen_ready = false;
    input.to = square({-0.1, 0.0}, 0.16);
    return input;
}

TEST(Placeholder, GrowsFromItsTablePlaceToTheProp) {
    Placeholder placeholder;
    Placeholder::Input input = leaving_for_4(1.0);
    input.from = square({0.3, 0.1}, 0.06);
    EXPECT_FALSE(placeholder.step(start, input).picture) << "it begins dark";
    double side_m = 0.06;
    for (MonotonicTime now = start + frame; now < start + Placeholder::growing; now += frame) {
        if (now < start + fade_time) {
            input.shown.brightness = 1.0 - to_seconds(now - start) / to_seconds(fade_time);
        } else {
            input.shown = {4, to_seconds(now - start) / to_seconds(fade_time) - 1.0, "en", 0.0, true, false};
            input.shown_ready = false;
        }
        const auto shown = placeholder.step(now, input).picture;
        ASSERT_TRUE(shown);
        EXPECT_EQ(shown->artifact, 4U);
        EXPECT_GE(shown->rectangle.size_m.x, side_m);
        EXPECT_NEAR(shown->brightness, input.shown_ready ? 1.0 - input.shown.brightness : 1.0, 1e-12);
        side_m = shown->rectangle.size_m.x;
        // On the straight line between the two places, at the share by which it has grown.
        const double share = (side_m - 0.06) / 0.10;
        EXPECT_NEAR(shown->rectangle.centre_m.x, 0.3 - 0.4 * share, 1e-12);
    }
    const auto there = placeholder.step(start + Placeholder::growing, input).picture;
    EXPECT_EQ(there->rectangle.corners(), input.to.corners());
}

TEST(Placeholder, GrowsFromNothingWithoutATablePicture) {
    Placeholder placeholder;
    static_cast<void>(placeholder.step(start, leaving_for_4(1.0)));
    const auto first = placeholder.step(start + milliseconds(8), leaving_for_4(0.9)).picture;
    EXPECT_LT(first->rectangle.size_m.x, 0.002);
    EXPECT_EQ(first->rectangle.centre_m, glm::dvec2(-0.1, 0.0));
}

TEST(ExhibitThatLoads, ShowsReadyArtifactsWithoutAPlaceholder) {
    Exhibit exhibit = sample::exhibit(3, {"en"});
    exhibit.note(std::vector{ArtifactState::Ready, ArtifactState::Ready, ArtifactState::Away});
    MonotonicTime now = start;
    static_cast<void>(exhibit.step(now, {}, sample::tracked_state(now)));
    const std::array<settings::Command, 1> next{settings::Command::NextArtifact};
    now += seconds(1);
    static_cast<void>(exhibit.step(now, next, sample::tracked_state(now)));
    for (; now < start + milliseconds(1500); now += frame) {
        EXPECT_FALSE(exhibit.step(now, {}, sample::tracked_state(now)).placeholder);
    }
    const Presentation there = exhibit.step(now, {}, sample::tracked_state(now));
    EXPECT_EQ(there.artifact, 1U);
    EXPECT_EQ(there.brightness, 1.0);
}

TEST(ExhibitThatLoads, ShowsAPlaceholderUntilTheArtifactIsReady) {
    Exhibit exhibit = sample::exhibit(3, {"en"});
    std::vector<ArtifactState> states{ArtifactState::Ready, ArtifactState::Away, ArtifactState::Away};
    exhibit.note(states);
    MonotonicTime now = start;
    static_cast<void>(exhibit.step(now, {}, sample::tracked_state(now)));
    now += seconds(1);
    const std::array<settings::Command, 1> next{settings::Command::NextArtifact};
    const Presentation pressed = exhibit.step(now, next, sample::tracked_state(now));
    ASSERT_EQ(pressed.wanted.artifacts().size(), 3U);
    EXPECT_EQ(pressed.wanted.artifacts()[0], 1U);
    EXPECT_EQ(pressed.wanted.artifacts()[1], 2U);
    EXPECT_EQ(pressed.wanted.artifacts()[2], 0U);
    const MonotonicTime press = now;
    for (; now < press + seconds(2); now += frame) {
        const Presentation shown = exhibit.step(now, {}, sample::tracked_state(now));
        if (now > press) {
            ASSERT_TRUE(shown.placeholder) << "at once, and as long as it takes";
            EXPECT_EQ(shown.placeholder->artifact, 1U);
        }
        EXPECT_TRUE(shown.artifact == 0 || shown.brightness == 0.0);
    }
    EXPECT_FALSE(exhibit.step(now, {}, sample::tracked_state(now)).settled);
    states[1] = ArtifactState::Ready;
    exhibit.note(states);
    const MonotonicTime comes = now;
    for (; now < comes + fade_time; now += frame) {
        const Presentation shown = exhibit.step(now, {}, sample::tracked_state(now));
        const double picture = shown.placeholder ? shown.placeholder->brightness : 0.0;
        EXPECT_NEAR(shown.brightness + picture, 1.0, 0.1) << "the two fade into each other";
    }
    now += 2 * frame;
    const Presentation there = exhibit.step(now, {}, sample::tracked_state(now));
    EXPECT_EQ(there.artifact, 1U);
    EXPECT_EQ(there.brightness, 1.0);
    EXPECT_FALSE(there.placeholder);
    EXPECT_TRUE(there.settled || there.caption);
}

TEST(ExhibitThatLoads, NeverShowsUnusableArtifacts) {
    Exhibit exhibit = sample::exhibit(4, {"en"});
    exhibit.note(std::vector{ArtifactState::Ready, ArtifactState::Unusable, ArtifactState::Ready,
                             ArtifactState::Unusable});
    std::mt19937 random(1);
    MonotonicTime now = start;
    std::array<int, 4> shows{};
    for (int k = 0; k < 4000; ++k, now += frame) {
        std::vector<settings::Command> commands;
        if (random() % 20 == 0) {
            commands.push_back(random() % 2 == 0 ? settings::Command::NextArtifact
                                                 : settings::Command::PreviousArtifact);
        }
        const Presentation shown = exhibit.step(now, commands, sample::tracked_state(now));
        EXPECT_EQ(shown.artifact % 2, 0U);
        shows.at(shown.artifact) += shown.brightness > 0.5 ? 1 : 0;
        for (const std::size_t wanted : shown.wanted.artifacts()) {
            EXPECT_EQ(wanted % 2, 0U);
        }
    }
    EXPECT_GT(shows[0], 100);
    EXPECT_GT(shows[2], 100) << "the presses show the other one";
}

TEST(ExhibitThatLoads, SkipsAChosenArtifactThatBecomesUnusable) {
    Exhibit exhibit = sample::exhibit(3, {"en"});
    std::vector<ArtifactState> states{ArtifactState::Ready, ArtifactState::Away, ArtifactState::Ready};
    exhibit.note(states);
    const std::array<settings::Command, 1> next{settings::Command::NextArtifact};
    MonotonicTime now = start + seconds(1);
    static_cast<void>(exhibit.step(now, next, sample::tracked_state(now)));
    now += seconds(1);
    static_cast<void>(exhibit.step(now, {}, sample::tracked_state(now)));
    states[1] = ArtifactState::Unusable;
    exhibit.note(states);
    for (int k = 0; k < 240; ++k, now += frame) {
        static_cast<void>(exhibit.step(now, {}, sample::tracked_state(now)));
    }
    const Presentation shown = exhibit.step(now, {}, sample::tracked_state(now));
    EXPECT_EQ(shown.artifact, 2U);
    EXPECT_EQ(shown.brightness, 1.0);
    EXPECT_FALSE(shown.placeholder);
    // And with no other artifact left:
    states[2] = ArtifactState::Unusable;
    exhibit.note(states);
    for (int k = 0; k < 240; ++k, now += frame) {
        static_cast<void>(exhibit.step(now, {}, sample::tracked_state(now)));
    }
    const Presentation last = exhibit.step(now, {}, sample::tracked_state(now));
    EXPECT_EQ(last.artifact, 0U);
    EXPECT_EQ(last.lamps & 3U, 0U);
}

/// The artifact and the picture in its place light the same part of the table; both are fully white, or one is dark.
TEST(ExhibitThatLoads, FlashesAtMostThreeTimesPerSecond) {
    int most = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
        std::mt19937 random(seed);
        Exhibit exhibit = sample::exhibit(6, {"en", "de"});
        std::vector<ArtifactState> states(6, ArtifactState::Away);
        states[0] = ArtifactState::Ready;
        const double artifact_light = seed % 3 == 0 ? 0.2 : 1.0;
        const double picture_light = seed % 3 == 1 ? 0.2 : 1.0;
        std::vector<Luminance> samples;
        MonotonicTime now = start;
        std::size_t shown_now = 0;
        for (; now < start + seconds(20); now += frame) {
            for (std::size_t k = 0; k < states.size(); ++k) { // artifacts come and go
                if (random() % 60 == 0) {
                    states[k] = states[k] == ArtifactState::Ready && k != shown_now ? ArtifactState::Away
                                                                                    : ArtifactState::Ready;
                }
            }
            exhibit.note(states);
            std::vector<settings::Command> commands;
            if (random() % (seed % 2 == 0 ? 4 : 25) == 0) {
                constexpr std::array all{settings::Command::NextArtifact,
                                         settings::Command::PreviousArtifact};
                commands.push_back(all[random() % 2]);
            }
            const Presentation shown = exhibit.step(now, commands, sample::tracked_state(now));
            shown_now = shown.artifact;
            const double picture = shown.placeholder ? shown.placeholder->brightness : 0.0;
            samples.push_back(
                {now, std::min(1.0, artifact_light * shown.brightness + picture_light * picture)});
        }
        EXPECT_LE(max_flashes_per_second(samples), 3) << seed;
        most = std::max(most, max_flashes_per_second(samples));
    }
    EXPECT_GE(most, 1) << "nothing was seen of the presses";
}

} // namespace
} // namespace frustumscreen::exhibit
