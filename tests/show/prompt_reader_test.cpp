// Recordings read on a thread of its own: which arrive, which are kept, which are silent, without waiting.
#include "app/pack/pack_file.h"
#include "app/pack/pack_texts.h"
#include "app/residency/prompt_reader.h"
#include "firmware_host/sound/opus_reader.h"
#include "tests/base/comes_true.h"
#include "tests/folders.h"
#include "tests/pack/samples.h"

#include <gtest/gtest.h>

#include <filesystem>

using namespace frustumscreen;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

Bytes fixture(const std::string& name) {
    return read_file(source_dir() + "/tests/sound/fixtures/" + name).value_or(Bytes());
}

residency::SharedRecording in_memory(const std::string& name, Bytes opus) {
    return std::make_shared<const residency::PromptRecording>(
        residency::PromptRecording{name, std::move(opus), {}, "en", "word", {seconds(2), seconds(1)}});
}

/// Polls until there is an answer; the tests' own time limit ends an endless wait.
residency::SharedReading wait_for(residency::PromptReader& reader,
                                  const residency::SharedRecording& recording) {
    residency::SharedReading reading = reader.find(recording);
    while (!reading) {
        std::this_thread::sleep_for(milliseconds(1));
        reading = reader.find(recording);
    }
    return reading;
}

class PromptReading : public ::testing::Test {
protected:
    void SetUp() override {
        pack::Pack pack = samples::pack();
        pack::put_sounds(
            pack, std::vector<pack::SpokenLanguage>{{"en", {{"description", fixture("speech.opus")}}},
                                                    {"de", {{"description", samples::some_bytes("OggS")}}}});
        ASSERT_TRUE(write_file(file, samples::bytes_of(pack)));
    }
    void TearDown() override { std::filesystem::remove(file); }
    [[nodiscard]] residency::SharedRecording in_pack(const std::string& language) const {
        return std::make_shared<const residency::PromptRecording>(residency::PromptRecording{
            "the description in '" + language + "'", {}, file, language, "description", {seconds(1)}});
    }
    const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "prompt_reading.fspack";
};

} // namespace

TEST_F(PromptReading, reads_the_same_samples_as_the_decoder) {
    residency::PromptReader reader;
    const residency::SharedRecording english = in_pack("en");
    EXPECT_EQ(reader.find(english), nullptr) << "nobody wants it";
    reader.want(residency::SpokenUse::Description, english);
    const residency::SharedReading reading = wait_for(reader, english);
    ASSERT_TRUE(reading->prompt);
    EXPECT_EQ(reading->prompt->samples, sound::read_opus(fixture("speech.opus"))->samples);
    EXPECT_FALSE(reading->prompt->marks.empty());
    EXPECT_EQ(reading->portions, std::vector{Nanoseconds(0)});
}

TEST_F(PromptReading, logs_each_unreadable_recording_once_and_stays_silent) {
    const residency::SharedRecording bad = in_pack("de");
    const residency::SharedRecording missing = in_pack("fr");
    const residency::SharedRecording damaged = in_memory("damaged", Bytes(100, std::byte(7)));
    auto gone_file = std::make_shared<residency::PromptRecording>(*in_pack("en"));
    gone_file->name = "gone";
    gone_file->pack = file.string() + ".gone";
    const residency::SharedRecording gone = gone_file;
    ::testing::internal::CaptureStderr();
    {
        residency::PromptReader reader;
        for (int round = 0; round < 2; ++round) {
            for (const residency::SharedRecording& recording : {bad, missing, damaged, gone}) {
                reader.want(residency::SpokenUse::Description, recording);
                EXPECT_EQ(wait_for(reader, recording)->prompt, nullptr);
            }
        }
        const residency::SharedRecording good = in_pack("en");
        reader.want(residency::SpokenUse::Description, good);
        EXPECT_TRUE(wait_for(reader, good)->prompt) << "and it goes on";
    }
    const std::string said = ::testing::internal::GetCapturedStderr();
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 4) << said;
    for (const residency::SharedRecording& recording : {bad, missing, damaged, gone}) {
        EXPECT_NE(said.find(recording->name + " is silent: "), std::string::npos) << said;
    }
}

TEST_F(PromptReading, frees_a_description_that_is_no_longer_wanted) {
    residency::PromptReader reader;
    const residency::SharedRecording english = in_pack("en");
    reader.want(residency::SpokenUse::Description, english);
    const std::weak_ptr<const sound::Prompt> prompt = wait_for(reader, english)->prompt;
    EXPECT_FALSE(prompt.expired());
    reader.want(residency::SpokenUse::Description, nullptr);
    while (!prompt.expired()) {
        std::this_thread::sleep_for(milliseconds(1));
    }
    EXPECT_EQ(reader.find(english), nullptr);
}

TEST_F(PromptReading, keeps_the_most_recently_wanted_words) {
    residency::PromptReader reader;
    std::vector<residency::SharedRecording> words;
    for (std::size_t k = 0; k <= residency::PromptReader::words_kept; ++k) {
        words.push_back(in_memory("word " + std::to_string(k), fixture("tone.opus")));
        reader.want(residency::SpokenUse::Word, words.back());
        wait_for(reader, words.back());
        if (k > 0) { // the first is requested repeatedly
            reader.want(residency::SpokenUse::Word, words.front());
            wait_for(reader, words.front());
        }
    }
    EXPECT_NE(reader.find(words[0]), nullptr);
    EXPECT_EQ(reader.find(words[1]), nullptr);
    for (std::size_t k = 2; k < words.size(); ++k) {
        EXPECT_NE(reader.find(words[k]), nullptr) << k;
    }
}

TEST_F(PromptReading, reads_the_word_and_only_the_newest_description) {
    residency::PromptReader reader;
    std::vector<residency::SharedRecording> wanted;
    for (int k = 0; k < 50; ++k) {
        wanted.push_back(in_memory("description " + std::to_string(k), fixture("speech.opus")));
        reader.want(residency::SpokenUse::Description, wanted.back());
    }
    const residency::SharedRecording word = in_memory("word", fixture("tone.opus"));
    reader.want(residency::SpokenUse::Word, word);
    wait_for(reader, word);
    wait_for(reader, wanted.back());
    for (std::size_t k = 0; k + 1 < wanted.size(); ++k) {
        EXPECT_EQ(reader.find(wanted[k]), nullptr);
    }
    EXPECT_NE(reader.find(word), nullptr);
}

TEST_F(PromptReading, find_waits_for_the_reading_in_always_mode) {
    residency::PromptReader reader(residency::PromptReader::Answer::Always);
    const residency::SharedRecording english = in_pack("en");
    EXPECT_EQ(reader.find(english), nullptr);
    reader.want(residency::SpokenUse::Description, english);
    ASSERT_NE(reader.find(english), nullptr);
    EXPECT_TRUE(reader.find(english)->prompt);
}

TEST_F(PromptReading, destructor_ends_the_thread_during_a_read) {
    const auto threads = [] { // as the kernel lists them
        return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
    };
    const auto before = threads();
    for (int k = 0; k < 20; ++k) {
        residency::PromptReader reader;
        reader.want(residency::SpokenUse::Description, in_pack("en"));
        reader.want(residency::SpokenUse::Word, in_memory("word", fixture("tone.opus")));
    }
    // The kernel drops a thread from its list just after it was waited for.
    EXPECT_TRUE(comes_true([&] { return threads() == before; })) << threads();
}
