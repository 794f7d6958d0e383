#include "app/exhibit/languages.h"
#include "app/exhibit/selection.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace frustumscreen::exhibit {
namespace {

using std::chrono::milliseconds;

const MonotonicTime start{std::chrono::seconds(100)};

Selection three_artifacts() {
    return Selection(3, {"en", "de", "fr"}, "en", start);
}

TEST(Selection, BeginsDarkAndBrightensWithinTheFadeTime) {
    const Selection selection = three_artifacts();
    EXPECT_DOUBLE_EQ(selection.at(start).brightness, 0.0);
    EXPECT_NEAR(selection.at(start + fade_time / 2).brightness, 0.5, 1e-12);
    EXPECT_DOUBLE_EQ(selection.at(start + fade_time).brightness, 1.0);
    EXPECT_FALSE(selection.at(start + fade_time).changing);
}

TEST(Selection, ThePictureChangesOnlyInTheDark) {
    Selection selection = three_artifacts();
    const MonotonicTime press = start + std::chrono::seconds(5);
    selection.take(settings::Command::NextArtifact, press);
    std::size_t before = 0;
    for (int ms = 0; ms <= 500; ++ms) {
        const Shown shown = selection.at(press + milliseconds(ms));
        if (shown.artifact != before) {
            EXPECT_LT(shown.brightness, 0.01);
            before = shown.artifact;
        }
    }
    EXPECT_EQ(before, 1U);
    EXPECT_DOUBLE_EQ(selection.at(press + 2 * fade_time).brightness, 1.0);
}

TEST(Selection, ArtifactsWrapAroundInBothDirections) {
    Selection selection = three_artifacts();
    MonotonicTime now = start + std::chrono::seconds(1);
    const auto after = [&](settings::Command command) {
        selection.take(command, now);
        now += std::chrono::seconds(1);
        return selection.at(now).artifact;
    };
    EXPECT_EQ(after(settings::Command::NextArtifact), 1U);
    EXPECT_EQ(after(settings::Command::NextArtifact), 2U);
    EXPECT_EQ(after(settings::Command::NextArtifact), 0U);
    EXPECT_EQ(after(settings::Command::PreviousArtifact), 2U);
}

TEST(Selection, PressesDuringAFadeNeverMakeTheBrightnessJump) {
    constexpr std::array commands{settings::Command::NextArtifact, settings::Command::NextLanguage,
                                  settings::Command::PreviousArtifact};
    std::mt19937 random(3);
    for (int run = 0; run < 200; ++run) {
        Selection selection = three_artifacts();
        const MonotonicTime press = start + std::chrono::seconds(5);
        Shown before = selection.at(press);
        for (int ms = 0; ms <= 5000; ++ms) {
            const MonotonicTime now = press + milliseconds(ms);
            if (ms < 3000 && random() % static_cast<unsigned>(20 + run) == 0) {
                selection.take(commands.at(random() % commands.size()), now);
            }
            const Shown shown = selection.at(now);
            // A cubic ease over 250 ms moves by at most 1.5 / 250 in a millisecond.
            ASSERT_NEAR(shown.brightness, before.brightness, 0.0061) << run << " " << ms;
            ASSERT_NEAR(shown.caption_brightness, before.caption_brightness, 0.0061) << run << " " << ms;
            ASSERT_LE(shown.caption_brightness, shown.brightness);
            if (shown.artifact != before.artifact) {
                ASSERT_LT(shown.brightness, 0.01);
            }
            if (shown.language != before.language) {
                ASSERT_LT(shown.caption_brightness, 0.01);
            }
            before = shown;
        }
        EXPECT_DOUBLE_EQ(before.brightness, 1.0);
        EXPECT_DOUBLE_EQ(before.caption_brightness, 1.0);
        EXPECT_EQ(before.language, selection.language());
        EXPECT_FALSE(before.changing);
    }
}

/// The picture dims within a few frames, or is about to change anyway; it ends where all the presses lead.
TEST(Selection, PressShowsAtOnceAndLaterOnesAreQueued) {
    Selection selection = three_artifacts();
    const MonotonicTime press = start + std::chrono::seconds(5);
    selection.take(settings::Command::NextArtifact, press);
    EXPECT_LT(selection.at(press + milliseconds(50)).brightness, 0.9);
    const MonotonicTime next = press + milliseconds(300); // the other one fades in
    selection.take(settings::Command::NextArtifact, next);
    EXPECT_GT(selection.at(next + milliseconds(50)).brightness, selection.at(next).brightness)
        << "no turning round";
    EXPECT_TRUE(selection.at(next).changing);
    EXPECT_EQ(selection.at(press + 2 * fade_time).artifact, 1U);
    EXPECT_DOUBLE_EQ(selection.at(press + 2 * fade_time).brightness, 1.0);
    EXPECT_EQ(selection.at(press + 4 * fade_time).artifact, 2U);
    EXPECT_DOUBLE_EQ(selection.at(press + 4 * fade_time).brightness, 1.0);
}

TEST(Selection, UndoneQueuedCommandChangesNothing) {
    Selection selection = three_artifacts();
    const MonotonicTime press = start + std::chrono::seconds(5);
    selection.take(settings::Command::NextArtifact, press);
    const MonotonicTime next = press + milliseconds(300);
    selection.take(settings::Command::NextArtifact, next);
    selection.undo(settings::Command::NextArtifact, next + milliseconds(100));
    for (int ms = 100; ms < 1000; ++ms) {
        EXPECT_EQ(selection.at(next + milliseconds(ms)).artifact, 1U);
        EXPECT_GT(selection.at(next + milliseconds(ms)).brightness, 0.2) << ms;
    }
}

TEST(Selection, LanguageChangeFadesOnlyTheCaption) {
    Selection selection = three_artifacts();
    const MonotonicTime press = start + std::chrono::seconds(5);
    selection.take(settings::Command::NextLanguage, press);
    double darkest = 1.0;
    for (int ms = 0; ms < 500; ++ms) {
        const Shown shown = selection.at(press + milliseconds(ms));
        EXPECT_EQ(shown.brightness, 1.0);
        EXPECT_EQ(shown.language, ms < 250 ? "en" : "de");
        darkest = std::fmin(darkest, shown.caption_brightness);
    }
    EXPECT_LT(darkest, 1e-4);
    EXPECT_EQ(selection.at(press + milliseconds(500)).caption_brightness, 1.0);
}

TEST(Selection, BrightnessIsIndependentOfTheFrameRate) {
    Selection often = three_artifacts();
    Selection seldom = three_artifacts();
    const MonotonicTime press = start + std::chrono::seconds(2);
    often.take(settings::Command::NextArtifact, press);
    seldom.take(settings::Command::NextArtifact, press);
    for (int ms = 0; ms < 317; ++ms) {
        (void)often.at(press + milliseconds(ms));
    }
    EXPECT_EQ(often.at(press + milliseconds(317)).brightness,
              seldom.at(press + milliseconds(317)).brightness);
}

TEST(Selection, LanguageButtonCyclesThroughTheLanguages) {
    Selection selection = three_artifacts();
    selection.take(settings::Command::NextLanguage, start);
    EXPECT_EQ(selection.language(), "de");
    selection.take(settings::Command::NextLanguage, start);
    selection.take(settings::Command::NextLanguage, start);
    EXPECT_EQ(selection.language(), "en");
    Selection elsewhere(1, {"en", "de"}, "nl", start);
    elsewhere.take(settings::Command::NextLanguage, start);
    EXPECT_EQ(elsewhere.language(), "en");
}

TEST(Selection, UndoRestoresArtifactAndLanguage) {
    const MonotonicTime later = start + std::chrono::seconds(3);
    for (const settings::Command command :
         {settings::Command::NextArtifact, settings::Command::PreviousArtifact,
          settings::Command::NextLanguage}) {
        for (const std::string language : {"en", "fr", "nl"}) { // "nl": no caption in this language
            Selection selection(3, {"en", "de", "fr"}, language, start);
            selection.take(command, start + std::chrono::seconds(1));
            const Shown changed = selection.at(later);
            EXPECT_TRUE(changed.artifact != 0 || selection.language() != language);
            selection.undo(command, later);
            EXPECT_EQ(selection.at(later).brightness, changed.brightness) << "a jump";
            EXPECT_EQ(selection.at(later + 2 * fade_time).artifact, 0U);
            EXPECT_EQ(selection.language(), language);
        }
    }
}

TEST(Selection, RejectsCommandsWithFewerThanTwoArtifacts) {
    Selection none(0, {}, "en", start);
    none.take(settings::Command::NextArtifact, start);
    none.take(settings::Command::NextLanguage, start);
    EXPECT_EQ(none.at(start + std::chrono::seconds(1)).brightness, 0.0);
    Selection one(1, {"en"}, "en", start);
    for (const settings::Command command :
         {settings::Command::NextArtifact, settings::Command::PreviousArtifact,
          settings::Command::NextLanguage}) {
        EXPECT_FALSE(none.accepts(command));
        EXPECT_FALSE(one.accepts(command));
        EXPECT_TRUE(three_artifacts().accepts(command));
    }
    one.take(settings::Command::NextArtifact, start + std::chrono::seconds(1));
    EXPECT_EQ(one.at(start + milliseconds(1100)).brightness, 1.0);
}

TEST(Selection, CaptionUsesTheNearestLanguage) {
    const std::vector<std::string> tags{"fr", "de-CH", "en-GB", "de"};
    EXPECT_EQ(caption_for("de", tags), 3U);
    EXPECT_EQ(caption_for("de-AT", tags), 1U);
    EXPECT_EQ(caption_for("en", tags), 2U);
    EXPECT_EQ(caption_for("ja", tags), 2U);
    EXPECT_EQ(caption_for("ja", std::vector<std::string>{"fr", "it"}), 0U);
    EXPECT_TRUE(has_language(tags, "de-AT"));
    EXPECT_FALSE(has_language(tags, "ja"));
}

} // namespace
} // namespace frustumscreen::exhibit
