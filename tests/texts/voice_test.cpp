// Voices: external programs, good and bad ones, and where espeak-ng may speak.
#include "assets_baked/texts/speak_words.h"
#include "assets_baked/texts/voice.h"
#include "assets_baked/texts/words.h"
#include "tests/base/comes_true.h"
#include "tests/base/temporary_folder.h"
#include "tests/texts/wav_bytes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

using namespace frustumscreen;
using namespace frustumscreen::texts;
using namespace frustumscreen::testing;
using namespace std::chrono_literals;

namespace {

class Voices : public WithTemporaryFolder {
protected:
    void SetUp() override { ASSERT_TRUE(write_file(folder / "good.wav", wav16(sine(0.2, 0.5)))); }
    /// A program of these shell commands that runs in the test's folder.
    [[nodiscard]] std::string program(const std::string& commands) const {
        const std::filesystem::path file = folder / "voice.sh";
        std::ofstream(file) << "#!/bin/sh\ncd '" << folder.string() << "'\n" << commands << "\n";
        std::filesystem::permissions(file, std::filesystem::perms::owner_all);
        return file.string();
    }
    [[nodiscard]] std::string refusal(const std::string& commands, ProgramLimits limits = {}) const {
        const Result<Spoken> spoken = Voice(program(commands), limits).speak("A text.", "en");
        return spoken ? spoken->why_silent : spoken.error().message;
    }
};

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

bool has_espeak() {
    return std::system("command -v espeak-ng >/dev/null") == 0;
}

} // namespace

TEST_F(Voices, passes_text_and_language_and_reads_the_wav) {
    const Voice voice(program("cat >heard.txt; echo \"$1 $2\" >arguments.txt; cat good.wav") +
                      " --voice {language}");
    const Result<Spoken> spoken = voice.speak("Größe: 回", "de-CH");
    ASSERT_TRUE(spoken && spoken->speech) << (spoken ? spoken->why_silent : spoken.error().message);
    EXPECT_EQ(text("heard.txt"), "Größe: 回");
    EXPECT_EQ(text("arguments.txt"), "--voice de-CH\n");
    EXPECT_NEAR(spoken->speech->seconds, 0.5, 0.2);
}

TEST_F(Voices, a_program_need_not_read_its_text) {
    const Result<Spoken> spoken = Voice(program("cat good.wav")).speak(std::string(90000, 'a'), "en");
    EXPECT_TRUE(spoken && spoken->speech) << (spoken ? spoken->why_silent : spoken.error().message);
}

TEST_F(Voices, kills_a_program_that_hangs) {
    EXPECT_TRUE(contains(refusal("sleep 1000", {300ms, 1000}),
                         "voice.sh: takes longer than 0.3 s for one text; it was ended"));
    EXPECT_TRUE(contains(refusal("exec >&-; sleep 1000", {300ms, 1000}), "takes longer than 0.3 s"));
}

TEST_F(Voices, kills_the_children_of_a_killed_program) {
    const std::string message = refusal("sleep 1000 & echo $! >child.txt; cat /dev/zero", {60'000ms, 1000});
    EXPECT_TRUE(contains(message, "writes more than")) << message;
    const std::string child = text("child.txt");
    ASSERT_FALSE(child.empty());
    // Killed at once; it may remain as a zombie until its parent collects it.
    const std::string state = "/proc/" + std::to_string(std::stoi(child)) + "/stat";
    const bool ends = comes_true([&] {
        std::ifstream stat(state);
        std::string words;
        std::getline(stat, words);
        return words.empty() || contains(words, ") Z ");
    });
    EXPECT_TRUE(ends) << "process " << child << " still runs";
}

TEST_F(Voices, kills_a_program_that_writes_too_much) {
    EXPECT_TRUE(contains(refusal("cat /dev/zero", {30000ms, 100000}),
                         "writes more than 100000 bytes for one text; it was ended"));
}

TEST_F(Voices, discards_endless_standard_error) {
    const std::string complaints = "echo 'no such voice' >&2; head -c 20000000 /dev/zero >&2; ";
    EXPECT_TRUE(contains(refusal(complaints + "stat -L -c %s /proc/self/fd/2 >size.txt; exit 3"),
                         "voice.sh: ends with status 3: no such voice"));
    EXPECT_LT(std::stol(text("size.txt")), 1000000);
    EXPECT_EQ(refusal(complaints + "cat good.wav"), "");
    EXPECT_TRUE(contains(refusal("exec >&-; cat /dev/zero >&2", {300ms, 1000}), "takes longer than 0.3 s"));
    EXPECT_TRUE(contains(refusal("exec >&-; head -c 20000000 /dev/zero >&2; exit 4"), "ends with status 4"));
}

TEST_F(Voices, rejects_unreadable_output_and_reports_silence) {
    EXPECT_TRUE(contains(refusal("echo hello"), "on 'A text.': this recording cannot be read"));
    EXPECT_TRUE(contains(refusal("true"), "on 'A text.': this recording cannot be read"));
    ASSERT_TRUE(write_file(folder / "silent.wav", wav16(std::vector<double>(9600, 0.0))));
    EXPECT_TRUE(contains(refusal("cat silent.wav"), "voice.sh finds nothing to speak in 'A text.'"));
    ASSERT_TRUE(write_file(folder / "empty.wav", wav({}, {})));
    EXPECT_TRUE(contains(refusal("cat empty.wav"), "voice.sh finds nothing to speak in 'A text.'"));
}

TEST_F(Voices, error_quotes_status_and_standard_error) {
    const std::string message = refusal("echo 'no such voice' >&2; exit 3");
    EXPECT_TRUE(contains(message, "voice.sh: ends with status 3: no such voice")) << message;
    EXPECT_TRUE(contains(refusal("kill -SEGV $$"), "ends with signal 11"));
    const Result<Spoken> missing = Voice("/nowhere/voice").speak("A text.", "en");
    ASSERT_FALSE(missing);
    EXPECT_EQ(
        missing.error().message,
        "/nowhere/voice: cannot be started: No such file or directory; install it, or name another program");
}

TEST_F(Voices, uses_recordings_without_a_voice_and_reports_silent_words) {
    std::filesystem::create_directories(folder / "de");
    std::filesystem::copy(folder / "good.wav", folder / "de" / "help.wav");
    std::vector<pack::LanguageWords> languages(1);
    languages[0].language = "de";
    languages[0].words = {{"help", "Hilfe", "de"}, {"name", "Deutsch", "de"}};
    const Result<std::vector<std::string>> silent = speak_words(languages, {folder, std::nullopt, {}});
    ASSERT_TRUE(silent) << silent.error().message;
    EXPECT_EQ(languages[0].sounds.size(), 1U);
    EXPECT_TRUE(languages[0].sounds.contains("help"));
    ASSERT_EQ(silent->size(), 1U);
    EXPECT_EQ(silent->front(),
              "1 of 2 words in 'de' are silent, but they are shown: there are no recordings and no voice");
}

TEST_F(Voices, stops_after_a_failure) {
    const Voice voice(program("echo word >>tried.txt; exit 1"));
    std::vector<pack::LanguageWords> languages(1);
    languages[0].language = "de";
    for (int k = 0; k < 500; ++k) {
        languages[0].words.push_back({"help", "Hilfe", "de"});
    }
    EXPECT_FALSE(speak_words(languages, {{}, voice, {}}));
    const std::string tried = text("tried.txt");
    EXPECT_LE(static_cast<unsigned>(std::count(tried.begin(), tried.end(), '\n')),
              2 * std::thread::hardware_concurrency() + 2);
}

TEST_F(Voices, names_an_unreadable_recording) {
    std::filesystem::create_directories(folder / "de");
    put("de/help.wav", "no sound");
    std::vector<pack::LanguageWords> languages(1);
    languages[0].language = "de";
    languages[0].words = {{"help", "Hilfe", "de"}};
    const Result<std::vector<std::string>> silent =
        speak_words(languages, {folder, Voice(program("cat good.wav")), {}});
    ASSERT_FALSE(silent);
    EXPECT_TRUE(contains(silent.error().message, "de/help.wav: this recording cannot be read"))
        << silent.error().message;
}

TEST(Espeak, speaks_only_languages_with_known_pronunciation) {
    if (!has_espeak()) {
        GTEST_SKIP() << "espeak-ng is not installed";
    }
    const Voice espeak;
    for (const std::string language : {"en", "de", "fr", "es", "it", "el", "hi", "zh", "ar", "he", "ja"}) {
        const Result<std::vector<CollectedWords>> words =
            collect_words({}, std::vector<std::string>{language});
        ASSERT_TRUE(words) << words.error().message;
        std::string all;
        for (const Word& word : words->front().words) {
            all += word.text + "\n";
        }
        const bool silent = language == "ar" || language == "he" || language == "ja";
        EXPECT_EQ(espeak.why_silent(all, language).has_value(), silent)
            << language << ": " << espeak.why_silent(all, language).value_or("");
    }
    EXPECT_TRUE(espeak.why_silent("שָׁלוֹם", "he")) << "it spells some of the points";
    EXPECT_TRUE(espeak.why_silent("text", "tlh-XX-none")) << "there is no such voice";
}

TEST(Espeak, speaks_readable_foreign_words_and_names_unreadable_ones) {
    if (!has_espeak()) {
        GTEST_SKIP() << "espeak-ng is not installed";
    }
    const Voice espeak;
    const std::vector<std::pair<std::string, std::string>> read{
        {"de", "Das Team hat den Würfel gefunden."},
        {"fr", "Le design de la coupe rappelle les vacances d’un week-end au bord de la mer."},
        {"el", "Το museum είναι εδώ και περιμένει τους επισκέπτες."},
        {"el", "Ὁ Ἀχιλλεύς."},
        {"hi", "यह museum बहुत पुराना है और नदी के किनारे है।"},
        {"zh", "这是museum。"},
        {"sr", "Музеј је овде, muzej."},
        {"en", "The α-helix, 5 µm, 2 × 3 Ω."},
        {"en", "Łódź, café, fac\u0327ade"}};
    for (const auto& [language, text] : read) {
        EXPECT_FALSE(espeak.why_silent(text, language)) << text << espeak.why_silent(text, language).value();
    }
    const std::vector<std::array<std::string, 3>> unread{{"en", "A cup called كأس from Cairo.", "كأس"},
                                                         {"en", "The μῆνιν of old", "μῆνιν"},
                                                         {"en", "Called Ἀχιλλεύς", "Ἀχιλλεύς"},
                                                         {"de", "Der Буква-Laut", "Буква"},
                                                         {"ja", "これは白い箱です。", "白"},
                                                         {"ko", "漢字 상자", "漢字"}};
    for (const auto& [language, text, word] : unread) {
        EXPECT_EQ(espeak.why_silent(text, language),
                  "espeak-ng cannot read '" + word + "' in the language '" + language +
                      "'; write it in that language's letters, or give a recording or another voice");
    }
    EXPECT_EQ(
        espeak.why_silent("design design", "hi"),
        "espeak-ng reads most of the text as another language than 'hi'; give a recording or another voice");
    EXPECT_EQ(espeak.why_silent("text", "fa"),
              "the language 'fa' is written without its vowels, which espeak-ng cannot guess");
}

TEST(Espeak, speaks_a_sentence) {
    if (!has_espeak()) {
        GTEST_SKIP() << "espeak-ng is not installed";
    }
    const Result<Spoken> spoken = Voice().speak("Well done! Now you see all of it.", "en");
    ASSERT_TRUE(spoken && spoken->speech) << (spoken ? spoken->why_silent : spoken.error().message);
    EXPECT_GT(spoken->speech->seconds, 1.0);
    EXPECT_LT(spoken->speech->seconds, 5.0);
    EXPECT_LE(spoken->speech->loudness.true_peak_db, -2.0);
    EXPECT_LT(spoken->speech->opus.size(), 40000U);
}
