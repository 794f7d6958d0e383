// The exhibit's decisions about speech, as heard: in a WAV's samples, with prompts that resemble nothing else.
#include "app/show/speaker.h"
#include "app/show/test_tone.h"
#include "firmware_host/sound/mixer.h"
#include "firmware_host/sound/opus_reader.h"
#include "tests/folders.h"
#include "tests/render/counted_new.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace frustumscreen;
using namespace frustumscreen::show;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

Bytes fixture(const std::string& name) {
    return read_file(source_dir() + "/tests/sound/fixtures/" + name).value_or(Bytes());
}

residency::SharedRecording recording_of(const std::string& name) {
    return std::make_shared<const residency::PromptRecording>(
        residency::PromptRecording{name, fixture(name), {}, "en", name, {seconds(1), seconds(1)}});
}

/// A show with one word of advice and one description; the second artifact has none.
class SpeakingShow final : public PresentationShow {
public:
    render::DrawResult draw(MonotonicTime, const exhibit::Presentation&, std::span<const glm::dvec3>,
                            const render::RenderTarget&, render::Redraw) override {
        return {};
    }
    [[nodiscard]] ShowState state(const exhibit::Presentation&) const override { return {"", "", {}}; }
    [[nodiscard]] bool speaks() const override { return true; }
    [[nodiscard]] residency::SharedRecording recording(const exhibit::WordIndex& index) const override {
        EXPECT_LT(index.text, words);
        return word;
    }
    [[nodiscard]] residency::SharedRecording
    recording(const exhibit::DescriptionIndex& index) const override {
        return index.artifact == 0 ? description : nullptr;
    }
    std::size_t words = 2;
    residency::SharedRecording word = recording_of("tone.opus");
    residency::SharedRecording description = recording_of("speech.opus");
};

class Speaking : public ::testing::Test {
protected:
    void SetUp() override { speaker.begin(residency::PromptReader::Answer::Always); }
    void frame() {
        speaker.step(presentation, show);
        presentation.says.reset();
        presentation.falls_silent = false;
        std::vector<std::int16_t> block(sound::sample_rate_hz / 50);
        mixer.mix(block); // as WavSound: first the samples that are due, then the new request
        mixer.follow(speaker.request());
        heard.insert(heard.end(), block.begin(), block.end());
        speaker.hear(mixer.report(Nanoseconds(0)));
    }
    void frames(int count) {
        for (int k = 0; k < count; ++k) {
            frame();
        }
    }
    void tell() { presentation.tells = presentation.prepares = exhibit::DescriptionIndex{}; }
    void leave(bool at_pause) {
        presentation.tells.reset();
        presentation.leaves = at_pause;
    }
    [[nodiscard]] bool sounds() const {
        return std::any_of(heard.end() - sound::sample_rate_hz / 50, heard.end(),
                           [](std::int16_t s) { return s != 0; });
    }

    SpeakingShow show;
    Speaker speaker;
    sound::Mixer mixer;
    exhibit::Presentation presentation;
    std::vector<std::int16_t> heard;
};

} // namespace

TEST_F(Speaking, plays_the_whole_description_once) {
    const sound::Prompt truth = *sound::read_opus(fixture("speech.opus"));
    frame();
    tell();
    frame();
    EXPECT_EQ(speaker.narration(), (exhibit::SpeechProgress{exhibit::SpeechProgress::State::Coming, 0}));
    frames(3);
    EXPECT_EQ(speaker.narration().state, exhibit::SpeechProgress::State::Heard);
    while (speaker.narration().state == exhibit::SpeechProgress::State::Heard) {
        frame();
    }
    EXPECT_EQ(speaker.narration().state, exhibit::SpeechProgress::State::Over);
    const std::size_t begin = 2 * sound::sample_rate_hz / 50;
    for (std::size_t k = sound::Mixer::fade_samples; k + sound::Mixer::fade_samples < truth.samples.size();
         ++k) {
        ASSERT_EQ(heard[begin + k], truth.samples[k]) << k;
    }
    frames(200);
    EXPECT_FALSE(sounds()) << "it is said once";
}

TEST_F(Speaking, portions_advance_with_the_playback) {
    tell();
    frames(3);
    std::size_t portion = 0;
    while (speaker.narration().state == exhibit::SpeechProgress::State::Heard) {
        EXPECT_GE(speaker.narration().portion, portion);
        portion = speaker.narration().portion;
        frame();
    }
    EXPECT_EQ(portion, 1U);
}

TEST_F(Speaking, stops_a_description_at_once_or_at_its_next_pause) {
    tell();
    frames(10);
    EXPECT_TRUE(sounds());
    leave(false);
    frames(3);
    EXPECT_FALSE(sounds());
    EXPECT_EQ(speaker.narration().state, exhibit::SpeechProgress::State::Over);

    tell();
    frames(10);
    leave(true);
    frame();
    EXPECT_EQ(speaker.narration().state, exhibit::SpeechProgress::State::Heard)
        << "not in the middle of a word";
    frames(200);
    EXPECT_EQ(speaker.narration().state, exhibit::SpeechProgress::State::Over);

    tell();
    frames(10);
    leave(true);
    frame();
    leave(false); // no pause came in time
    frames(3);
    EXPECT_EQ(speaker.narration().state, exhibit::SpeechProgress::State::Over);
}

TEST_F(Speaking, requested_advice_replaces_the_description) {
    presentation.prepares_word = exhibit::WordIndex{};
    tell();
    frames(20);
    leave(false);
    presentation.says = exhibit::WordIndex{};
    frames(5);
    const sound::Prompt truth = *sound::read_opus(fixture("tone.opus"));
    EXPECT_TRUE(speaker.speaks());
    EXPECT_NE(speaker.narration().state, exhibit::SpeechProgress::State::Heard);
    frames(100);
    const std::size_t from =
        heard.size() - std::min<std::size_t>(heard.size(), 105 * sound::sample_rate_hz / 50);
    const auto at = std::search(heard.begin() + static_cast<std::ptrdiff_t>(from), heard.end(),
                                truth.samples.begin() + 1000, truth.samples.begin() + 3000);
    EXPECT_NE(at, heard.end()) << "the advice is not there";
}

TEST_F(Speaking, silencing_the_advice_does_not_stop_the_description) {
    tell();
    frames(20);
    presentation.falls_silent = true;
    frames(10);
    EXPECT_EQ(speaker.narration().state, exhibit::SpeechProgress::State::Heard)
        << "silence for advice is none for the description";
}

TEST_F(Speaking, reports_silent_without_a_usable_recording) {
    presentation.tells = presentation.prepares = exhibit::DescriptionIndex{1, 0};
    frames(2);
    EXPECT_EQ(speaker.narration().state, exhibit::SpeechProgress::State::Silent);
    show.description = std::make_shared<const residency::PromptRecording>(
        residency::PromptRecording{"bad", Bytes(9), {}, "", "", {}});
    ::testing::internal::CaptureStderr();
    tell();
    frames(2);
    EXPECT_EQ(speaker.narration().state, exhibit::SpeechProgress::State::Silent);
    EXPECT_NE(::testing::internal::GetCapturedStderr().find("bad is silent: "), std::string::npos);
}

TEST_F(Speaking, a_step_allocates_nothing) {
    presentation.prepares = exhibit::DescriptionIndex{};
    presentation.prepares_word = exhibit::WordIndex{};
    presentation.says = exhibit::WordIndex{};
    frames(2);
    tell();
    frames(2); // both recordings are decoded
    if (!synthetic::allocations_are_counted) {
        GTEST_SKIP() << "a sanitizer allocates by itself";
    }
    const long before = synthetic::allocations_so_far();
    for (int k = 0; k < 300; ++k) {
        k % 100 < 50 ? tell() : leave(k % 3 == 0);
        presentation.says = k % 40 == 0 ? std::optional(exhibit::WordIndex{}) : std::nullopt;
        speaker.step(presentation, show);
        mixer.follow(speaker.request());
        speaker.hear(mixer.report(Nanoseconds(0)));
    }
    EXPECT_EQ(synthetic::allocations_so_far(), before);
}

TEST_F(Speaking, an_announcement_waits_for_silence_and_uses_its_gain) {
    const residency::SharedRecording loud = recording_of("tone.opus");
    residency::PromptRecording soft_one = *loud;
    soft_one.gain_db = -12.0;
    const residency::SharedRecording soft = std::make_shared<const residency::PromptRecording>(soft_one);
    tell();
    frames(10);
    while (speaker.narration().state == exhibit::SpeechProgress::State::Heard) {
        EXPECT_FALSE(speaker.step(presentation, show, loud));
        frame();
    }
    const auto loudest_of = [&](const residency::SharedRecording& recording) {
        const std::size_t from = heard.size();
        int steps = 0;
        while (!speaker.step(presentation, show, recording) && steps < 100) {
            frame();
            ++steps;
        }
        EXPECT_LT(steps, 100);
        frames(150);
        EXPECT_FALSE(sounds());
        return *std::max_element(heard.begin() + static_cast<std::ptrdiff_t>(from), heard.end());
    };
    const double of_loud = loudest_of(loud);
    EXPECT_GT(of_loud, 1000.0);
    EXPECT_NEAR(loudest_of(soft), of_loud * std::pow(10.0, -12.0 / 20.0), 0.01 * of_loud);
}

TEST_F(Speaking, forget_drops_a_word_that_waits_to_be_read) {
    Speaker waiting;
    waiting.begin(residency::PromptReader::Answer::WhenReady);
    presentation.prepares_word = presentation.says = exhibit::WordIndex{0, 1};
    waiting.step(presentation, show);
    presentation = {};
    show.words = 1;
    waiting.forget();
    waiting.step(presentation, show); // the show fails the test for an unknown recording
}

TEST_F(Speaking, forget_ends_the_description_of_the_old_set) {
    tell();
    frames(10);
    ASSERT_TRUE(sounds());
    speaker.forget();
    tell(); // the new set's description, with the same index
    show.description = recording_of("tone.opus");
    const sound::Prompt truth = *sound::read_opus(fixture("tone.opus"));
    frames(20);
    EXPECT_NE(
        std::search(heard.begin(), heard.end(), truth.samples.begin() + 1000, truth.samples.begin() + 3000),
        heard.end());
}

TEST_F(Speaking, the_staff_picture_stops_the_description) {
    tell();
    frames(10);
    presentation.staff = true;
    frames(3);
    EXPECT_FALSE(sounds());
}

/// Each requested tone begins at once, also while the previous one is heard; leaving the picture ends it.
TEST_F(Speaking, plays_each_requested_staff_tone_until_the_staff_leave) {
    presentation.staff = true;
    frames(3);
    EXPECT_FALSE(sounds());
    presentation.staff_tones = 1;
    const sound::SharedPrompt tone = test_tone();
    // The end of its first note and the beginning of its second, 0.4 s after its start; a note repeats itself.
    const std::vector<std::int16_t> part(tone->samples.begin() + 18200, tone->samples.begin() + 20200);
    const auto heard_times = [&] {
        std::size_t times = 0;
        for (auto at = heard.begin();
             (at = std::search(at, heard.end(), part.begin(), part.end())) != heard.end(); ++at) {
            ++times;
        }
        return times;
    };
    frames(25);
    EXPECT_TRUE(sounds());
    EXPECT_EQ(heard_times(), 1U);
    presentation.staff_tones = 2;
    frames(25);
    EXPECT_EQ(heard_times(), 2U) << "it waits for the end of the one before, after 1.2 s";
    frames(100);
    EXPECT_EQ(heard_times(), 2U);
    EXPECT_FALSE(sounds());
    presentation.staff_tones = 3;
    frames(5);
    presentation.staff = false;
    frames(5);
    EXPECT_FALSE(sounds());
    EXPECT_EQ(heard_times(), 2U);
    presentation.staff = true; // the picture returns, and earlier requests are not played again
    frames(10);
    EXPECT_FALSE(sounds());
}

/// ITU-R BS.1770: a sine of 1 kHz with an amplitude of -20 dBFS has -23 LUFS.
TEST(TestTone, has_the_loudness_of_speech_and_no_clicks) {
    const sound::SharedPrompt tone = test_tone();
    double squares = 0.0;
    int most = 0, largest_step = 0;
    for (std::size_t k = 0; k < tone->samples.size(); ++k) {
        squares += static_cast<double>(tone->samples[k]) * tone->samples[k];
        most = std::max(most, std::abs(int{tone->samples[k]}));
        largest_step = k > 0 ? std::max(largest_step, std::abs(tone->samples[k] - tone->samples[k - 1])) : 0;
    }
    EXPECT_EQ(most, 3277);
    EXPECT_NEAR(10.0 * std::log10(squares / static_cast<double>(tone->samples.size()) / (32768.0 * 32768.0)),
                -23.0, 0.5);
    EXPECT_EQ(tone->samples.front(), 0);
    EXPECT_EQ(tone->samples.back(), 0);
    EXPECT_LT(largest_step, 900) << "a click; 2 kHz goes by 858 at most";
    EXPECT_EQ(tone->samples.size(), sound::sample_rate_hz * 12U / 10U);
}
