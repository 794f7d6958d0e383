// Narration, step by step, and with simulated visitors who press, play, rest and leave at random.
#include "app/exhibit/narration_sequencer.h"
#include "tests/render/counted_new.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace frustumscreen::exhibit {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using State = SpeechProgress::State;

const Tellable both{{seconds(4), seconds(4), seconds(2)}, {seconds(1), seconds(1)}};
const Tellable hotspots_alone{{}, {seconds(1)}};
const Tellable description_alone{{seconds(4)}, {}};

/// Steps in frames of 20 ms, with a voice that speaks the description: two seconds a portion, with a pause after
/// each.
class NarrationSequencerTest : public ::testing::Test {
protected:
    static constexpr Nanoseconds frame = milliseconds(20);

    Told step(NarrationInput input) {
        now += frame;
        rested = input.next || input.describe ? Nanoseconds(0) : rested + frame;
        input.tellable = tellable;
        input.subject = subject;
        input.rested = rested;
        input.narration = narration();
        told = narration_sequencer.step(now, input);
        speak();
        return told;
    }
    /// No presses; the visitor rests.
    Told rest(Nanoseconds time, const NarrationInput& input = {}) {
        for (Nanoseconds at{0}; at < time; at += frame) {
            step(input);
        }
        return told;
    }
    Told press() {
        NarrationInput input;
        input.next = true;
        return step(input);
    }
    Told ask() {
        NarrationInput input;
        input.describe = true;
        return step(input);
    }
    [[nodiscard]] SpeechProgress narration() const {
        if (!voice) {
            return {};
        }
        if (!spoken_since) {
            return {was_spoken ? State::Over : State::Silent, 0};
        }
        const Nanoseconds heard = now - *spoken_since;
        return heard < delay
                   ? SpeechProgress{State::Coming, 0}
                   : SpeechProgress{State::Heard, static_cast<std::size_t>((heard - delay) / seconds(2))};
    }
    void speak() {
        if (told.speaks && !spoken_since && !was_spoken) {
            spoken_since = now;
        }
        if (!told.speaks && !told.leaves) {
            spoken_since.reset();
            was_spoken = false;
        }
        if (spoken_since) {
            const Nanoseconds heard = now - *spoken_since - delay;
            const bool in_pause = heard % seconds(2) < milliseconds(300);
            const auto portions =
                static_cast<Nanoseconds::rep>(tellable->portions.size()) - (tellable->ends_unspoken ? 1 : 0);
            if (heard >= portions * seconds(2) || (told.leaves && has_pauses && in_pause)) {
                spoken_since.reset();
                was_spoken = true;
            }
        }
    }
    [[nodiscard]] bool nothing() const { return told == Told{}; }

    NarrationSequencer narration_sequencer;
    const Tellable* tellable = &both;
    DescriptionIndex subject;
    MonotonicTime now{seconds(100)};
    Nanoseconds rested{0};
    Told told;
    bool voice = true;
    bool has_pauses = true;
    Nanoseconds delay = milliseconds(60);
    std::optional<MonotonicTime> spoken_since;
    bool was_spoken = false;
};

TEST_F(NarrationSequencerTest, PressesStepThroughDescriptionAndHotspots) {
    for (int round = 0; round < 3; ++round) {
        EXPECT_TRUE(press().speaks);
        EXPECT_EQ(told.portion, 0U);
        EXPECT_EQ(press().hotspot, 0U);
        EXPECT_FALSE(told.speaks || told.leaves || told.portion);
        EXPECT_EQ(press().hotspot, 1U);
        press();
        EXPECT_TRUE(nothing());
    }
    tellable = &hotspots_alone;
    subject.artifact = 1;
    EXPECT_EQ(press().hotspot, 0U);
    press();
    EXPECT_TRUE(nothing());
    tellable = &description_alone;
    subject.artifact = 2;
    EXPECT_EQ(press().portion, 0U);
    press();
    EXPECT_TRUE(nothing());
    tellable = nullptr;
    subject.artifact = 3;
    press();
    EXPECT_TRUE(nothing());
}

TEST_F(NarrationSequencerTest, RestStepsThroughEverythingOnce) {
    rest(NarrationSequencer::first_rest - milliseconds(100));
    EXPECT_TRUE(nothing());
    rest(milliseconds(200));
    EXPECT_EQ(told.portion, 0U);
    rest(milliseconds(2200));
    EXPECT_EQ(told.portion, 1U) << "it follows the speech";
    rest(seconds(2));
    EXPECT_EQ(told.portion, 2U);
    rest(seconds(2));
    EXPECT_EQ(told.portion, 2U) << "a breath";
    EXPECT_FALSE(told.speaks);
    rest(NarrationSequencer::breath);
    EXPECT_EQ(told.hotspot, 0U);
    rest(NarrationSequencer::min_hotspot);
    EXPECT_EQ(told.hotspot, 1U);
    rest(NarrationSequencer::min_hotspot);
    EXPECT_TRUE(nothing());
    rest(seconds(300));
    EXPECT_TRUE(nothing()) << "each thing once";
    subject.language = 1;
    rest(seconds(7));
    EXPECT_EQ(told.portion, 0U);
}

TEST_F(NarrationSequencerTest, ShowsTheUnspokenAttributionAfterTheSpeechOrAlone) {
    const Tellable attributed{{seconds(4), seconds(4), seconds(2)}, {}, true}; // two portions are spoken
    tellable = &attributed;
    press();
    rest(seconds(3));
    EXPECT_EQ(told.portion, 1U);
    EXPECT_TRUE(told.speaks);
    rest(seconds(2));
    EXPECT_EQ(told.portion, 2U) << "the voice has ended";
    EXPECT_FALSE(told.speaks);
    rest(attributed.portions[2] + NarrationSequencer::finds_text - seconds(1));
    EXPECT_EQ(told.portion, 2U);
    rest(seconds(1) + NarrationSequencer::breath);
    EXPECT_TRUE(nothing());

    const Tellable alone{{seconds(2)}, {}, true};
    tellable = &alone;
    subject.artifact = 1;
    voice = false;
    rest(milliseconds(100));
    ask();
    rest(seconds(1));
    EXPECT_EQ(told.portion, 0U);
    EXPECT_FALSE(told.speaks);
    rest(alone.portions[0] + NarrationSequencer::finds_text + NarrationSequencer::breath);
    EXPECT_TRUE(nothing());
}

TEST_F(NarrationSequencerTest, SilentTextAdvancesAtReadingPace) {
    voice = false;
    press();
    rest(milliseconds(100));
    EXPECT_FALSE(told.speaks);
    rest(both.portions[0] + NarrationSequencer::finds_text - milliseconds(300));
    EXPECT_EQ(told.portion, 0U);
    rest(milliseconds(400));
    EXPECT_EQ(told.portion, 1U);
    rest(both.portions[1] + NarrationSequencer::finds_text);
    EXPECT_EQ(told.portion, 2U);
}

TEST_F(NarrationSequencerTest, LateSpeechIsReplacedByReading) {
    delay = seconds(30);
    press();
    rest(milliseconds(900));
    EXPECT_TRUE(told.speaks);
    rest(milliseconds(200));
    EXPECT_FALSE(told.speaks);
    EXPECT_EQ(told.portion, 0U);
    rest(seconds(6));
    EXPECT_EQ(told.portion, 1U);
}

TEST_F(NarrationSequencerTest, AdviceWaitsForAPauseAndTheDescriptionRestarts) {
    press();
    rest(milliseconds(1000));
    NarrationInput advice;
    advice.gives_way = true;
    advice.whole = false;
    step(advice);
    EXPECT_TRUE(told.leaves);
    EXPECT_EQ(told.portion, 0U) << "what is heard is shown";
    advice.gives_way = false;
    rest(milliseconds(1100), advice);
    EXPECT_TRUE(nothing());
    rest(seconds(20), advice);
    EXPECT_TRUE(nothing()) << "who needs advice is not told by rest";
    rest(NarrationSequencer::first_rest + milliseconds(100));
    EXPECT_EQ(told.portion, 0U);
    rest(milliseconds(4500));
    advice.gives_way = true;
    step(advice);
    rest(seconds(2), advice);
    EXPECT_TRUE(nothing());
    rest(NarrationSequencer::first_rest + milliseconds(100));
    EXPECT_EQ(told.hotspot, 0U) << "more than half of it was heard";
}

TEST_F(NarrationSequencerTest, CutsOffSpeechWithoutPauses) {
    has_pauses = false;
    press();
    rest(milliseconds(500));
    NarrationInput advice;
    advice.gives_way = true;
    rest(NarrationSequencer::longest_leaving - milliseconds(100), advice);
    EXPECT_TRUE(told.leaves);
    rest(milliseconds(200), advice);
    EXPECT_TRUE(nothing());
}

TEST_F(NarrationSequencerTest, EndsOnAnotherArtifactLanguageOrStaffMode) {
    for (int way = 0; way < 3; ++way) {
        ask();
        EXPECT_TRUE(told.speaks);
        rest(seconds(1));
        NarrationInput input;
        subject.artifact += way == 0 ? 1 : 0;
        subject.language += way == 1 ? 1 : 0;
        input.stops = way == 2;
        step(input);
        EXPECT_TRUE(nothing()) << way;
        rest(seconds(1));
    }
}

TEST_F(NarrationSequencerTest, PressDuringAFadeWaitsForItsEnd) {
    NarrationInput fading;
    fading.shown = false;
    fading.next = true;
    step(fading);
    EXPECT_TRUE(nothing());
    fading.next = false;
    rest(milliseconds(500), fading);
    EXPECT_TRUE(nothing());
    rest(NarrationSequencerTest::frame);
    EXPECT_EQ(told.portion, 0U);
}

TEST_F(NarrationSequencerTest, HelpStartsTheDescriptionOnlyOnce) {
    press();
    press();
    EXPECT_EQ(told.hotspot, 0U);
    ask();
    EXPECT_EQ(told.portion, 0U);
    rest(milliseconds(2500));
    ask();
    EXPECT_EQ(told.portion, 1U);
    EXPECT_TRUE(told.speaks);
}

/// The state of earlier speech does not affect the one that begins.
TEST(NarrationSequencer, RestartsFromTheFirstPortion) {
    for (const SpeechProgress& before : {SpeechProgress{State::Over, 0}, {State::Heard, 2}}) {
        NarrationSequencer narration_sequencer;
        MonotonicTime now{seconds(100)};
        NarrationInput input;
        input.tellable = &both;
        const auto step = [&](const SpeechProgress& narration, bool describe, bool gives_way = false) {
            now += milliseconds(20);
            input.narration = narration;
            input.describe = describe;
            input.gives_way = gives_way;
            return narration_sequencer.step(now, input);
        };
        EXPECT_TRUE(step({}, true).speaks);
        step({State::Heard, 2}, false);
        step(before, false, before.state == State::Heard);
        const Told again = step(before, true);
        EXPECT_TRUE(again.speaks);
        EXPECT_EQ(again.portion, 0U);
    }
}

TEST_F(NarrationSequencerTest, ReadsALongDescriptionToItsEnd) {
    const Tellable longest{std::vector<Nanoseconds>(32, seconds(11)), {}};
    tellable = &longest;
    voice = false;
    press();
    rest(32 * (seconds(11) + NarrationSequencer::finds_text) - seconds(1));
    EXPECT_EQ(told.portion, 31U);
    rest(seconds(4));
    EXPECT_TRUE(nothing());
}

TEST_F(NarrationSequencerTest, SkipsHotspotsWhileTheArtifactIsNotInTheProp) {
    NarrationInput input;
    input.in_prop = false;
    input.next = true;
    tellable = &hotspots_alone;
    step(input);
    EXPECT_TRUE(nothing());
    tellable = &both;
    subject.artifact = 1;
    EXPECT_TRUE(step(input).speaks);
    step(input);
    EXPECT_TRUE(nothing());
}

TEST_F(NarrationSequencerTest, StaysSilentWithoutAVisitorAndRestartsForTheNext) {
    NarrationInput nobody;
    nobody.there = false;
    rest(seconds(60), nobody);
    EXPECT_TRUE(nothing());
    rest(seconds(60));
    EXPECT_TRUE(nothing()) << "it was all told";
    rest(NarrationSequencer::forgets + frame, nobody);
    rested = Nanoseconds(0);
    rest(NarrationSequencer::first_rest + milliseconds(100));
    EXPECT_EQ(told.portion, 0U);
}

TEST_F(NarrationSequencerTest, HotspotTimesOutDuringPlay) {
    press();
    press();
    for (Nanoseconds at{0}; at < NarrationSequencer::longest_hotspot - milliseconds(100); at += frame) {
        rested = Nanoseconds(0);
        EXPECT_EQ(step({}).hotspot, 0U);
    }
    for (int k = 0; k < 20; ++k) {
        rested = Nanoseconds(0);
        step({});
    }
    EXPECT_TRUE(nothing());
}

/// For any behaviour of visitors: one thing at a time, no voice without its caption, portions in order, and an end.
TEST_F(NarrationSequencerTest, InvariantsHoldForRandomVisitors) {
    std::mt19937 random(5);
    const std::array tellables{&both, &hotspots_alone, &description_alone};
    const auto one_in = [&](unsigned n) { return random() % n == 0; };
    NarrationInput input;
    int portions = 0;
    int hotspots = 0;
    MonotonicTime changed = now;
    for (int k = 0; k < 400'000; ++k) {
        if (one_in(2000)) {
            subject = {random() % 3, random() % 2};
            tellable = tellables.at(subject.artifact);
            voice = !one_in(3);
            has_pauses = !one_in(4);
            delay = milliseconds(random() % (one_in(3) ? 3000 : 60));
        }
        input.next = one_in(700);
        input.describe = one_in(1500);
        input.stops = one_in(5000);
        input.shown = one_in(300) ? !input.shown : input.shown || one_in(20);
        input.whole = one_in(400) ? !input.whole : input.whole;
        input.there = one_in(1500) ? !input.there : input.there;
        input.gives_way = !input.whole && one_in(200);
        rested = one_in(300) ? Nanoseconds(0) : rested;
        const Told before = told;
        step(input);
        ASSERT_FALSE(told.portion && told.hotspot);
        ASSERT_TRUE(!(told.speaks || told.leaves) || told.portion) << "a voice without its caption";
        ASSERT_FALSE(told.speaks && told.leaves);
        ASSERT_TRUE(!told.portion || *told.portion < tellable->portions.size());
        ASSERT_TRUE(!told.hotspot || *told.hotspot < tellable->hotspots.size());
        if (told.portion && before.portion && *told.portion != *before.portion && told.portion != 0U) {
            ASSERT_EQ(*told.portion, *before.portion + 1);
        }
        portions += told.portion && !before.portion ? 1 : 0;
        hotspots += told.hotspot && told.hotspot != before.hotspot ? 1 : 0;
        changed = told != before || nothing() ? now : changed;
        ASSERT_LE(now - changed, NarrationSequencer::longest_hotspot + seconds(1)) << "a dead end";
    }
    EXPECT_GT(portions, 100);
    EXPECT_GT(hotspots, 100);
}

TEST_F(NarrationSequencerTest, AllocatesNothing) {
    if (!synthetic::allocations_are_counted) {
        GTEST_SKIP() << "a sanitizer allocates by itself";
    }
    const long before = synthetic::allocations_so_far();
    press();
    rest(seconds(60));
    press();
    press();
    EXPECT_EQ(synthetic::allocations_so_far(), before);
}

} // namespace
} // namespace frustumscreen::exhibit
