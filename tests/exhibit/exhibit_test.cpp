#include "app/exhibit/exhibit.h"

#include <gtest/gtest.h>

#include <cmath>

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
    EXPECT_NEAR(exhibit.at(start + milliseconds(100)).brightness, 0.5, 1e-12);
    EXPECT_DOUBLE_EQ(exhibit.at(start + milliseconds(200)).brightness, 1.0);
    EXPECT_FALSE(exhibit.at(start + milliseconds(200)).changing);
}

TEST(Exhibit, ThePictureChangesOnlyInTheDark) {
    Exhibit exhibit = three_artifacts();
    const MonotonicTime press = start + std::chrono::seconds(5);
    exhibit.wish(Wish::NextArtifact, press);
    std::size_t before = 0;
    for (int ms = 0; ms <= 400; ++ms) {
        const Shown shown = exhibit.at(press + milliseconds(ms));
        if (shown.artifact != before) {
            EXPECT_LT(shown.brightness, 0.01);
            before = shown.artifact;
        }
    }
    EXPECT_EQ(before, 1U);
    EXPECT_DOUBLE_EQ(exhibit.at(press + milliseconds(400)).brightness, 1.0);
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
    for (int first = 0; first <= 400; first += 7) {
        Exhibit exhibit = three_artifacts();
        const MonotonicTime press = start + std::chrono::seconds(5);
        double before = 1.0;
        std::size_t shown_before = 0;
        for (int ms = 0; ms <= 1200; ++ms) {
            const MonotonicTime now = press + milliseconds(ms);
            if (ms == 0 || ms == first || ms == 2 * first) {
                exhibit.wish(Wish::NextArtifact, now);
            }
            const Shown shown = exhibit.at(now);
            // A cubic ease over 200 ms moves by at most 1.5 / 200 each millisecond.
            EXPECT_LE(std::abs(shown.brightness - before), 0.0076) << first << " " << ms;
            if (shown.artifact != shown_before) {
                EXPECT_LT(shown.brightness, 0.01);
            }
            before = shown.brightness;
            shown_before = shown.artifact;
        }
        EXPECT_DOUBLE_EQ(before, 1.0);
    }
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
