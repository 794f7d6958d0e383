// Narration as the exhibit's decisions: buttons, rest, advice, captions and lamps.
#include "tests/exhibit/exhibits.h"
#include "tests/render/counted_new.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace frustumscreen::exhibit {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr glm::dvec2 short_text{0.2, 0.05};
const std::vector<std::vector<glm::dvec2>> portion_sizes{{{0.20, 0.03}}, {{0.18, 0.06}}, {{0.10, 0.02}}};

ExhibitPlace place() {
    ExhibitPlace place = sample::shipped_place();
    place.words = {{"en", {{"slide_left", {{0.1, 0.02}}}, {"slide_right", {{0.1, 0.02}}}}}};
    place.buttons = 5;
    return place;
}

/// Two artifacts in two languages; the second has nothing to tell.
Catalogue catalogue() {
    CatalogueEntry told{{"en", "de"}, {{short_text}, {short_text}}};
    told.tellables.assign(2, {{seconds(3), seconds(3), seconds(1)}, {seconds(1), seconds(1)}});
    told.descriptions.assign(2, {portion_sizes, largest_sizes(portion_sizes), false});
    told.descriptions[1].flush_right = true;
    const CatalogueEntry untold{{"en", "de"}, {{short_text}, {short_text}}};
    return {told, untold};
}

constexpr std::uint32_t choose_lamp = 1U << 3U;
constexpr std::uint32_t help_lamp = 1U << 4U;

class NarrationExhibit : public ::testing::Test {
protected:
    const Presentation& run(Nanoseconds length, std::vector<settings::Command> commands = {}) {
        const MonotonicTime end = now_ + length;
        while (now_ < end) {
            now_ += milliseconds(20);
            tracking::TrackedState tracked_state = sample::tracked_state(now_, lost_);
            tracked_state.head_known = head_;
            tracked_state.table_from_prop.translation.x = x_;
            const DescriptionIndex told = shown.tells.value_or(DescriptionIndex{});
            shown = exhibit_.step(now_, commands, tracked_state);
            commands.clear();
            // A voice that speaks the description, three seconds a portion, with a pause after each.
            if (shown.tells && (!spoken_since_ || told != *shown.tells)) {
                spoken_since_ = over_ ? spoken_since_ : now_;
            }
            if (!shown.tells && !shown.leaves) {
                spoken_since_.reset();
                over_ = false;
            }
            SpeechProgress narration;
            if (over_) {
                narration.state = SpeechProgress::State::Over;
            } else if (spoken_since_) {
                const Nanoseconds heard = now_ - *spoken_since_;
                narration = {SpeechProgress::State::Heard, static_cast<std::size_t>(heard / seconds(3))};
                over_ = heard >= seconds(9) || (shown.leaves && heard % seconds(3) < milliseconds(100));
                spoken_since_ = over_ ? std::nullopt : spoken_since_;
            }
            exhibit_.hear(spoken_since_.has_value(), narration);
            advised_ += shown.says ? 1 : 0;
            EXPECT_FALSE(shown.says && spoken_since_) << "two voices";
        }
        return shown;
    }
    [[nodiscard]] bool describes() const { return shown.caption && shown.caption->portion.has_value(); }

    void with(const Catalogue& catalogue, const ExhibitPlace& place) {
        exhibit_ = Exhibit(catalogue, place, "en", sample::start);
    }

    Exhibit exhibit_{catalogue(), place(), "en", sample::start};
    Presentation shown;
    MonotonicTime now_ = sample::start;
    double x_ = 0.0;
    bool head_ = true;
    std::optional<MonotonicTime> lost_;
    std::optional<MonotonicTime> spoken_since_;
    bool over_ = false;
    int advised_ = 0;
};

TEST_F(NarrationExhibit, ChooseStepsThroughDescriptionAndHotspots) {
    run(seconds(2));
    EXPECT_FALSE(describes());
    run(milliseconds(20), {settings::Command::Choose});
    ASSERT_EQ(shown.tells, (DescriptionIndex{0, 0})) << "speech begins at once";
    run(seconds(1));
    ASSERT_TRUE(describes());
    EXPECT_EQ(shown.caption->portion, 0U);
    EXPECT_EQ(shown.caption->brightness, 1.0);
    EXPECT_EQ(shown.caption->rectangle.size_m, portion_sizes[0][0]);
    const glm::dvec2 begin = shown.caption->rectangle.corners()[3];
    run(milliseconds(2500));
    EXPECT_EQ(shown.caption->portion, 1U);
    EXPECT_LT(glm::distance(shown.caption->rectangle.corners()[3], begin), 1e-12) << "it stands still";
    run(milliseconds(20), {settings::Command::Choose});
    EXPECT_FALSE(shown.tells || shown.leaves);
    EXPECT_EQ(shown.tells_of, 0U);
    run(seconds(1));
    EXPECT_TRUE(shown.caption && !describes());
    run(milliseconds(20), {settings::Command::Choose});
    EXPECT_EQ(shown.tells_of, 1U);
    run(milliseconds(20), {settings::Command::Choose});
    EXPECT_FALSE(shown.tells_of);
}

TEST_F(NarrationExhibit, RightToLeftCaptionStaysFlushRight) {
    run(seconds(2), {settings::Command::NextLanguage});
    run(seconds(1), {settings::Command::Help});
    ASSERT_TRUE(describes());
    EXPECT_EQ(shown.tells, (DescriptionIndex{0, 1}));
    const glm::dvec2 begin = shown.caption->rectangle.corners()[2];
    run(seconds(6));
    ASSERT_EQ(shown.caption->portion, 2U);
    EXPECT_LT(glm::distance(shown.caption->rectangle.corners()[2], begin), 1e-12);
}

TEST_F(NarrationExhibit, NarratesWhileThePropRestsAndNotDuringPlay) {
    x_ = 0.01;
    run(seconds(1));
    for (int k = 0; k < 20; ++k) {
        x_ = k % 2 == 0 ? 0.02 : 0.0;
        run(seconds(1));
        EXPECT_FALSE(shown.tells);
    }
    run(NarrationSequencer::first_rest);
    EXPECT_TRUE(shown.tells);
    EXPECT_EQ(shown.prepares, shown.tells);
}

TEST_F(NarrationExhibit, EndsOnAnotherArtifactAndUpdatesLamps) {
    run(seconds(1), {settings::Command::Help});
    EXPECT_TRUE(shown.tells);
    EXPECT_EQ(shown.lamps & (choose_lamp | help_lamp), choose_lamp | help_lamp);
    run(milliseconds(20), {settings::Command::NextArtifact});
    EXPECT_FALSE(shown.tells || shown.leaves);
    run(seconds(2), {settings::Command::Choose});
    EXPECT_FALSE(shown.tells || shown.prepares || shown.tells_of);
    EXPECT_FALSE(describes());
    EXPECT_EQ(shown.lamps & (choose_lamp | help_lamp), 0U);
}

TEST_F(NarrationExhibit, DescriptionYieldsToAdviceAtAPause) {
    run(seconds(2), {settings::Command::Choose});
    x_ = 0.3;
    bool left_in_words = false;
    for (int k = 0; k < 300 && !shown.advice; ++k) {
        run(milliseconds(20));
        left_in_words = left_in_words || shown.leaves;
        if (shown.tells || shown.leaves) {
            // The caption itself fades while the prop covers it at first.
            EXPECT_TRUE(describes() || k < 40) << "a voice without its caption";
            EXPECT_FALSE(shown.advice);
        }
    }
    EXPECT_TRUE(left_in_words);
    EXPECT_TRUE(shown.advice);
    EXPECT_TRUE(shown.prepares_word);
    EXPECT_EQ(advised_, 0);
    run(seconds(5));
    EXPECT_EQ(advised_, 1);
}

TEST_F(NarrationExhibit, HelpGivesAvailableAdviceAtOnce) {
    run(seconds(2));
    x_ = 0.3;
    run(milliseconds(100)); // too early for a sign
    EXPECT_FALSE(shown.sign);
    run(milliseconds(120), {settings::Command::Help});
    EXPECT_TRUE(shown.sign);
    EXPECT_EQ(advised_, 1);
    run(milliseconds(500));
    EXPECT_TRUE(shown.advice);
    EXPECT_FALSE(shown.tells);
    EXPECT_NE(shown.lamps & help_lamp, 0U);
    EXPECT_EQ(advised_, 1) << "it is said once";
}

TEST_F(NarrationExhibit, HelpReplacesADescriptionByAdvice) {
    run(seconds(2), {settings::Command::Help});
    EXPECT_TRUE(shown.tells);
    x_ = 0.3;
    run(milliseconds(100));
    run(milliseconds(120), {settings::Command::Help});
    EXPECT_FALSE(shown.tells || shown.leaves);
    run(milliseconds(40)); // the advice shows its words first
    EXPECT_TRUE(shown.advice);
    EXPECT_EQ(advised_, 1);
}

TEST_F(NarrationExhibit, EndsASecondAfterThePropOrHeadIsLost) {
    run(seconds(2), {settings::Command::Choose});
    lost_ = now_;
    run(milliseconds(900));
    EXPECT_TRUE(shown.tells) << "trackers drop out";
    run(milliseconds(200));
    EXPECT_FALSE(shown.tells);
    lost_.reset();
    run(seconds(3));
    run(seconds(2), {settings::Command::Choose});
    EXPECT_TRUE(shown.tells);
    head_ = false;
    run(milliseconds(900));
    EXPECT_TRUE(shown.tells);
    run(milliseconds(300));
    EXPECT_FALSE(shown.tells);
}

TEST_F(NarrationExhibit, NarratesOnlyInTheDescribeState) {
    ExhibitPlace hasty = place();
    hasty.rest = seconds(10);
    with(catalogue(), hasty);
    run(seconds(1), {settings::Command::NextLanguage});
    int told = 0;
    for (int k = 0; k < 100; ++k) {
        run(seconds(1));
        EXPECT_TRUE(!shown.tells || shown.state == State::Describe);
        told += shown.tells ? 1 : 0;
    }
    EXPECT_GT(told, 5) << "it tells for nine seconds";
    EXPECT_EQ(shown.state, State::Attract);
}

TEST_F(NarrationExhibit, StopsWhenTheCaptionDoesNotFit) {
    Catalogue catalogue_of_long_texts = catalogue();
    const std::vector<std::vector<glm::dvec2>> too_large(3, {{2.0, 1.0}});
    catalogue_of_long_texts[0].descriptions[0] = {too_large, largest_sizes(too_large), false};
    with(catalogue_of_long_texts, place());
    run(seconds(1), {settings::Command::Help});
    EXPECT_TRUE(shown.tells) << "the short text fades out";
    run(seconds(3));
    EXPECT_FALSE(shown.tells || describes());
    EXPECT_TRUE(shown.caption) << "the short text is back";
}

TEST_F(NarrationExhibit, EndsInStaffMode) {
    run(seconds(2), {settings::Command::Choose});
    ASSERT_TRUE(shown.tells);
    run(milliseconds(20), {settings::Command::StaffMode});
    EXPECT_FALSE(shown.tells || shown.leaves);
}

/// While the prop rests on a picture, Choose takes that picture and tells nothing.
TEST(NarrationTable, ChooseSelectsThePictureUnderTheRing) {
    ExhibitPlace where = place();
    where.prop = geometry::make_frustum({0.10, 0.06, 0.05});
    where.guidance.reset();
    where.table_pictures = true;
    Catalogue three = catalogue();
    three.push_back(three[0]);
    Exhibit exhibit(three, where, "en", sample::start);
    MonotonicTime now = sample::start;
    tracking::TrackedState tracked_state = sample::tracked_state(now);
    const auto run = [&](Nanoseconds length, std::vector<settings::Command> commands = {}) {
        Presentation shown;
        for (const MonotonicTime end = now + length; now < end; commands.clear()) {
            now += milliseconds(20);
            shown = exhibit.step(now, commands, tracked_state);
        }
        return shown;
    };
    Presentation shown = run(seconds(1));
    ASSERT_NE(shown.table, nullptr);
    const auto pictures = shown.table->pictures();
    const auto last = std::find_if(pictures.begin(), pictures.end(),
                                   [](const PlacedPicture& picture) { return picture.artifact == 2U; });
    ASSERT_NE(last, pictures.end());
    tracked_state.table_from_prop.translation = glm::dvec3(last->place.picture.centre_m, 0.0);
    shown = run(Dwell::settles + milliseconds(200));
    ASSERT_TRUE(shown.table->ring);
    EXPECT_NE(shown.lamps & choose_lamp, 0U);
    shown = run(milliseconds(20), {settings::Command::Choose});
    EXPECT_FALSE(shown.tells);
    shown = run(seconds(1));
    EXPECT_EQ(shown.artifact, 2U);
    EXPECT_FALSE(shown.tells);
    shown = run(milliseconds(20), {settings::Command::Choose});
    EXPECT_TRUE(shown.tells) << "there is no ring any more";
}

TEST_F(NarrationExhibit, AStepAllocatesNothing) {
    run(seconds(1));
    if (!synthetic::allocations_are_counted) {
        GTEST_SKIP() << "a sanitizer allocates by itself";
    }
    std::mt19937 random(8);
    const long before = synthetic::allocations_so_far();
    for (int k = 0; k < 6000; ++k) {
        now_ += milliseconds(20);
        tracking::TrackedState tracked_state = sample::tracked_state(now_);
        tracked_state.table_from_prop.translation.x = k / 1000 % 2 == 0 ? 0.0 : 0.3;
        const std::array command{settings::button_commands.at(random() % 5)};
        shown = exhibit_.step(now_, std::span(command).first(random() % 150 == 0 ? 1 : 0), tracked_state);
        exhibit_.hear(shown.tells.has_value(), {SpeechProgress::State::Heard, random() % 3});
    }
    EXPECT_EQ(synthetic::allocations_so_far(), before);
}

} // namespace
} // namespace frustumscreen::exhibit
