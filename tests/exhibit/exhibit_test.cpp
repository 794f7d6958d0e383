#include "app/exhibit/exhibit.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace frustumscreen {
namespace {

using std::chrono::milliseconds;

const MonotonicTime start{std::chrono::seconds(100)};

Exhibit three_artifacts() {
    return Exhibit(3, {"en", "de", "fr"}, "en", start);
}

TEST(Exhibit, BeginsDarkAndBrightensWithinTheFadeTime) {
    const Exhibit exhibit = three_artifacts();
    EXPECT_DOUBLE_EQ(exhibit.at(start).brightness, 0.0);
    EXPECT_NEAR(exhibit.at(start + fade_time / 2).brightness, 0.5, 1e-12);
    EXPECT_DOUBLE_EQ(exhibit.at(start + fade_time).brightness, 1.0);
    EXPECT_FALSE(exhibit.at(start + fade_time).changing);
}

TEST(Exhibit, ThePictureChangesOnlyInTheDark) {
    Exhibit exhibit = three_artifacts();
    const MonotonicTime press = start + std::chrono::seconds(5);
    exhibit.wish(Wish::NextArtifact, press);
    std::size_t before = 0;
    for (int ms = 0; ms <= 500; ++ms) {
        const Shown shown = exhibit.at(press + milliseconds(ms));
        if (shown.artifact != before) {
            EXPECT_LT(shown.brightness, 0.01);
            before = shown.artifact;
        }
    }
    EXPECT_EQ(before, 1U);
    EXPECT_DOUBLE_EQ(exhibit.at(press + 2 * fade_time).brightness, 1.0);
}

TEST(Exhibit, ArtifactsFollowInACircleBothWays) {
    Exhibit exhibit = three_artifacts();
    MonotonicTime now = start + std::chrono::seconds(1);
    const auto after = [&](Wish wish) {
        exhibit.wish(wish, now);
        now += std::chrono::seconds(1);
        return exhibit.at(now).artifact;
    };
    EXPECT_EQ(after(Wish::NextArtifact), 1U);
    EXPECT_EQ(after(Wish::NextArtifact), 2U);
    EXPECT_EQ(after(Wish::NextArtifact), 0U);
    EXPECT_EQ(after(Wish::PreviousArtifact), 2U);
}

TEST(Exhibit, PressesDuringAFadeNeverMakeTheBrightnessJump) {
    constexpr std::array wishes{Wish::NextArtifact, Wish::NextLanguage, Wish::PreviousArtifact};
    std::mt19937 random(3);
    for (int run = 0; run < 200; ++run) {
        Exhibit exhibit = three_artifacts();
        const MonotonicTime press = start + std::chrono::seconds(5);
        Shown before = exhibit.at(press);
        for (int ms = 0; ms <= 5000; ++ms) {
            const MonotonicTime now = press + milliseconds(ms);
            if (ms < 3000 && random() % static_cast<unsigned>(20 + run) == 0) {
                exhibit.wish(wishes.at(random() % wishes.size()), now);
            }
            const Shown shown = exhibit.at(now);
            // A cubic ease over 250 ms moves by at most 1.5 / 250 each millisecond.
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
        EXPECT_EQ(before.language, exhibit.language());
        EXPECT_FALSE(before.changing);
    }
}

/// The picture dims within a few frames, or it is about to change anyway, and it ends where all the presses
/// lead.
TEST(Exhibit, APressShowsAtOnceAndNoneIsForgotten) {
    Exhibit exhibit = three_artifacts();
    const MonotonicTime press = start + std::chrono::seconds(5);
    exhibit.wish(Wish::NextArtifact, press);
    EXPECT_LT(exhibit.at(press + milliseconds(50)).brightness, 0.9);
    const MonotonicTime next = press + milliseconds(300); // the other one fades in
    exhibit.wish(Wish::NextArtifact, next);
    EXPECT_GT(exhibit.at(next + milliseconds(50)).brightness, exhibit.at(next).brightness)
        << "no turning round";
    EXPECT_TRUE(exhibit.at(next).changing);
    EXPECT_EQ(exhibit.at(press + 2 * fade_time).artifact, 1U);
    EXPECT_DOUBLE_EQ(exhibit.at(press + 2 * fade_time).brightness, 1.0);
    EXPECT_EQ(exhibit.at(press + 4 * fade_time).artifact, 2U);
    EXPECT_DOUBLE_EQ(exhibit.at(press + 4 * fade_time).brightness, 1.0);
}

TEST(Exhibit, AWishThatWaitsAndIsTakenBackChangesNothing) {
    Exhibit exhibit = three_artifacts();
    const MonotonicTime press = start + std::chrono::seconds(5);
    exhibit.wish(Wish::NextArtifact, press);
    const MonotonicTime next = press + milliseconds(300);
    exhibit.wish(Wish::NextArtifact, next);
    exhibit.take_back(Wish::NextArtifact, next + milliseconds(100));
    for (int ms = 100; ms < 1000; ++ms) {
        EXPECT_EQ(exhibit.at(next + milliseconds(ms)).artifact, 1U);
        EXPECT_GT(exhibit.at(next + milliseconds(ms)).brightness, 0.2) << ms;
    }
}

TEST(Exhibit, ALanguageChangesTheCaptionInTheDarkAndLeavesTheArtifactBright) {
    Exhibit exhibit = three_artifacts();
    const MonotonicTime press = start + std::chrono::seconds(5);
    exhibit.wish(Wish::NextLanguage, press);
    double darkest = 1.0;
    for (int ms = 0; ms < 500; ++ms) {
        const Shown shown = exhibit.at(press + milliseconds(ms));
        EXPECT_EQ(shown.brightness, 1.0);
        EXPECT_EQ(shown.language, ms < 250 ? "en" : "de");
        darkest = std::fmin(darkest, shown.caption_brightness);
    }
    EXPECT_LT(darkest, 1e-4);
    EXPECT_EQ(exhibit.at(press + milliseconds(500)).caption_brightness, 1.0);
}

TEST(Exhibit, ALateFrameShowsWhatAnEarlyOneWouldHave) {
    Exhibit often = three_artifacts();
    Exhibit seldom = three_artifacts();
    const MonotonicTime press = start + std::chrono::seconds(2);
    often.wish(Wish::NextArtifact, press);
    seldom.wish(Wish::NextArtifact, press);
    for (int ms = 0; ms < 317; ++ms) {
        (void)often.at(press + milliseconds(ms));
    }
    EXPECT_EQ(often.at(press + milliseconds(317)).brightness,
              seldom.at(press + milliseconds(317)).brightness);
}

TEST(Exhibit, TheLanguageButtonGoesThroughTheLanguages) {
    Exhibit exhibit = three_artifacts();
    exhibit.wish(Wish::NextLanguage, start);
    EXPECT_EQ(exhibit.language(), "de");
    exhibit.wish(Wish::NextLanguage, start);
    exhibit.wish(Wish::NextLanguage, start);
    EXPECT_EQ(exhibit.language(), "en");
    Exhibit elsewhere(1, {"en", "de"}, "nl", start);
    elsewhere.wish(Wish::NextLanguage, start);
    EXPECT_EQ(elsewhere.language(), "en");
}

TEST(Exhibit, AWishThatIsTakenBackLeavesWhatWasThere) {
    const MonotonicTime later = start + std::chrono::seconds(3);
    for (const Wish wish : {Wish::NextArtifact, Wish::PreviousArtifact, Wish::NextLanguage}) {
        for (const std::string language : {"en", "fr", "nl"}) { // "nl": no caption has it
            Exhibit exhibit(3, {"en", "de", "fr"}, language, start);
            exhibit.wish(wish, start + std::chrono::seconds(1));
            const Shown wished = exhibit.at(later);
            EXPECT_TRUE(wished.artifact != 0 || exhibit.language() != language);
            exhibit.take_back(wish, later);
            EXPECT_EQ(exhibit.at(later).brightness, wished.brightness) << "a jump";
            EXPECT_EQ(exhibit.at(later + 2 * fade_time).artifact, 0U);
            EXPECT_EQ(exhibit.language(), language);
        }
    }
}

TEST(Exhibit, WithoutArtifactsNothingIsShownAndWithOneNothingChanges) {
    Exhibit none(0, {}, "en", start);
    none.wish(Wish::NextArtifact, start);
    none.wish(Wish::NextLanguage, start);
    EXPECT_EQ(none.at(start + std::chrono::seconds(1)).brightness, 0.0);
    Exhibit one(1, {"en"}, "en", start);
    for (const Wish wish : {Wish::NextArtifact, Wish::PreviousArtifact, Wish::NextLanguage}) {
        EXPECT_FALSE(none.heeds(wish));
        EXPECT_FALSE(one.heeds(wish));
        EXPECT_TRUE(three_artifacts().heeds(wish));
    }
    one.wish(Wish::NextArtifact, start + std::chrono::seconds(1));
    EXPECT_EQ(one.at(start + milliseconds(1100)).brightness, 1.0);
}

TEST(Exhibit, TheCaptionIsInTheLanguageAskedForOrTheNearestThereIs) {
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
} // namespace frustumscreen
