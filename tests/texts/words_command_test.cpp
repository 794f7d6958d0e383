// `frustumscreen-bake --words`, from the command line.
#include "app/pack/words_file.h"
#include "assets_baked/texts/fonts.h"
#include "assets_baked/texts/words.h"
#include "tests/base/comes_true.h"
#include "tests/base/told.h"
#include "tests/folders.h"
#include "tests/programs/program_folder.h"
#include "tests/texts/wav_bytes.h"

#include <unistd.h>

#include <fstream>
#include <sstream>

using namespace frustumscreen;
using namespace frustumscreen::texts;
using namespace frustumscreen::testing;

namespace {

class WordsCommand : public programs::ProgramFolder {
protected:
    void SetUp() override {
        const Result<Fonts> fonts = Fonts::open();
        ASSERT_TRUE(fonts) << fonts.error().message;
        if (const Result<void> there = fonts->check("de"); !there) {
            GTEST_SKIP() << there.error().message;
        }
    }
    /// An ended process may remain as a zombie until its parent collects it.
    [[nodiscard]] static bool ends(int process) {
        return comes_true([process] {
            const std::string stat = text_of("/proc/" + std::to_string(process) + "/stat");
            return stat.empty() || stat.find(") Z ") != std::string::npos;
        });
    }
    [[nodiscard]] Result<pack::LanguageWords> baked(const std::string& language) const {
        const Result<Bytes> bytes = read_file(folder / "out.fswords");
        return bytes ? pack::read_words(*bytes, language) : tl::unexpected<Error>(bytes.error());
    }
};

} // namespace

TEST_F(WordsCommand, bakes_and_previews_the_built_in_words) {
    ASSERT_EQ(
        run("frustumscreen-bake --words --languages de,fr -o out.fswords --preview words.png --speech none"),
        0)
        << text("err.txt");
    const Result<pack::LanguageWords> german = baked("de");
    ASSERT_TRUE(german) << german.error().message;
    EXPECT_EQ(german->name, "Deutsch");
    EXPECT_NE(german->runs.find("advice.set_down"), nullptr);
    EXPECT_TRUE(baked("fr"));
    EXPECT_FALSE(baked("en"));
    EXPECT_EQ(text("words.png").substr(1, 3), "PNG");
    EXPECT_NE(text("err.txt").find("109 of 109 words in 'de' are silent"), std::string::npos);
}

TEST_F(WordsCommand, uses_the_museums_words_and_voice) {
    std::filesystem::create_directories(folder / "mine" / "nl");
    std::ofstream(folder / "mine" / "nl.toml")
        << "name = \"Nederlands\"\nattract_line = \"Verschuif het blok.\"\n";
    ASSERT_TRUE(write_file(folder / "mine" / "nl" / "attract_line.wav", wav16(sine(0.2, 1.2))));
    ASSERT_TRUE(write_file(folder / "tone.wav", wav16(sine(0.2, 0.4))));
    ASSERT_EQ(run("frustumscreen-bake --words mine --languages de,nl -o out.fswords --speech 'cat tone.wav'"),
              0)
        << text("err.txt");
    const Result<pack::LanguageWords> dutch = baked("nl");
    ASSERT_TRUE(dutch) << dutch.error().message;
    EXPECT_EQ(dutch->sounds.size(), dutch->words.size());
    const std::size_t recorded =
        dutch->sounds.at("attract_line").size(); // three times as long as the voice's tone
    EXPECT_EQ(std::ranges::count_if(dutch->sounds,
                                    [&](const auto& sound) { return 2 * sound.second.size() < recorded; }),
              std::ssize(dutch->sounds) - 1);
    EXPECT_NE(text("err.txt").find("the language 'nl' has no text for"), std::string::npos);
}

TEST_F(WordsCommand, strict_fails_on_a_missing_letter_and_writes_nothing) {
    std::filesystem::create_directories(folder / "mine");
    std::ofstream(folder / "mine" / "de.toml") << "attract_line = \"\xf0\x9f\x98\x80\"\n";
    EXPECT_EQ(run("frustumscreen-bake --words mine --languages de -o out.fswords --strict --speech none"), 1);
    EXPECT_NE(text("err.txt").find("(U+1F600) in a text of the language 'de' is in no Noto typeface"),
              std::string::npos)
        << text("err.txt");
    EXPECT_FALSE(std::filesystem::exists(folder / "out.fswords"));
}

TEST_F(WordsCommand, accepts_an_equals_sign_and_rejects_files_that_are_not_utf8) {
    std::filesystem::create_directories(folder / "mine");
    std::ofstream(folder / "mine" / "de.toml") << "# Latin-1\nattract_line = \"Hilfe f\xfcr dich\"\n";
    EXPECT_EQ(run("frustumscreen-bake --words=mine --languages de -o out.fswords --speech none"), 1);
    EXPECT_TRUE(test::tells(text("err.txt"), {"frustumscreen-bake: mine/de.toml:2: ", "[toml.not_utf8]\n"}));
}

TEST_F(WordsCommand, notes_an_unused_recording_and_fails_if_strict) {
    for (const char* file : {"de/advice.lift.wav", "de/attract_line.wav", "fr/attract_line.wav"}) {
        std::filesystem::create_directories((folder / "mine" / file).parent_path());
        ASSERT_TRUE(write_file(folder / "mine" / file, wav16(sine(0.2, 0.4))));
    }
    const std::string command = "frustumscreen-bake --words mine --languages de -o out.fswords --speech none";
    ASSERT_EQ(run(command), 0) << text("err.txt");
    EXPECT_NE(text("err.txt").find("mine/de/advice.lift.wav: this recording is not used: no text has this "
                                   "name; the nearest name of a text is de/advice.lower.wav"),
              std::string::npos)
        << text("err.txt");
    EXPECT_EQ(text("err.txt").find("fr/attract_line.wav"), std::string::npos)
        << "French was left out on purpose";
    EXPECT_EQ(run(command + " --strict"), 1);
}

TEST_F(WordsCommand, does_not_overwrite_other_files_or_its_input) {
    std::filesystem::create_directories(folder / "mine" / "de");
    put("notes.txt", "what the curator wrote down");
    put("mine/de.toml", "attract_line = \"Hilfe\"");
    ASSERT_TRUE(write_file(folder / "mine" / "de" / "attract_line.wav", wav16(sine(0.2, 0.4))));
    const std::string command = "frustumscreen-bake --words mine --languages de --speech none ";
    const auto refused = [&](const std::string& more, const std::string& file, const std::string& words) {
        const std::string before = text(file);
        EXPECT_EQ(run(command + more), 1) << more;
        EXPECT_EQ(text(file), before) << more;
        EXPECT_NE(text("err.txt").find(words), std::string::npos) << text("err.txt");
    };
    refused("-o notes.txt", "notes.txt", "notes.txt: this file exists and is not a file of words");
    refused("-o mine/de.toml", "mine/de.toml", "mine/de.toml: this file exists and is not a file of words");
    refused("-o mine/de.toml --force", "mine/de.toml", "would replace the input mine/de.toml");
    refused("-o mine/de/attract_line.wav --force", "mine/de/attract_line.wav",
            "would replace the input mine/de/attract_line.wav");
    refused("-o out.fswords --preview notes.txt", "notes.txt", "this file exists and is not a PNG picture");
    refused("-o new --preview ./new", "new", "[words.same_name]");
    for (int time = 0; time < 2; ++time) {
        EXPECT_EQ(run(command + "-o out.fswords --preview words.png"), 0) << text("err.txt");
    }
    EXPECT_EQ(run(command + "-o notes.txt --force"), 0) << text("err.txt");
}

TEST_F(WordsCommand, bakes_the_languages_of_the_folder) {
    for (const std::string& language : builtin_word_languages()) {
        if (const Result<void> there = Fonts::open()->check(language); !there) {
            GTEST_SKIP() << there.error().message;
        }
    }
    std::filesystem::create_directories(folder / "mine");
    std::ofstream(folder / "mine" / "pt.toml") << "name = \"Português\"\n";
    std::ofstream(folder / "mine" / "german.toml") << "name = \"Deutsch\"\n";
    ASSERT_EQ(run("frustumscreen-bake --words mine -o out.fswords --speech none"), 0) << text("err.txt");
    EXPECT_TRUE(baked("pt"));
    EXPECT_TRUE(baked("de"));
    EXPECT_NE(
        text("err.txt").find("mine/german.toml: this file is not used; name it after its language, such as "
                             "de.toml"),
        std::string::npos)
        << text("err.txt");
}

TEST_F(WordsCommand, voice_processes_end_with_the_command) {
    put("voice.sh", "sleep 1000 & echo $$ $! >>voices.txt; wait");
    for (const char* signal : {"TERM", "KILL"}) {
        std::filesystem::remove(folder / "voices.txt");
        const std::string commands = fmt::format(
            "'{}'/frustumscreen-bake --words --languages de -o out.fswords --speech 'sh "
            "voice.sh' "
            "2>err.txt & baker=$!; until test -s voices.txt; do kill -0 $baker || exit 5; sleep 0.02; done; "
            "kill -{} $baker; wait $baker 2>wait.txt; true",
            bin_dir(), signal);
        ASSERT_EQ(shell(commands), 0) << text("err.txt");
        std::istringstream voices(text("voices.txt"));
        for (int process = 0; voices >> process;) {
            EXPECT_TRUE(ends(process)) << signal << ": process " << process << " still runs";
        }
    }
}

TEST_F(WordsCommand, reports_errors_with_their_place) {
    EXPECT_EQ(run("frustumscreen-bake --words nowhere -o out.fswords"), 1);
    EXPECT_TRUE(test::tells(text("err.txt"), {"frustumscreen-bake: nowhere: ", "[words.no_folder]\n"}));
    EXPECT_EQ(run("frustumscreen-bake --words --languages de -o out.fswords --speech 'sh -c false'"), 1);
    EXPECT_NE(text("err.txt").find("sh: ends with status 1"), std::string::npos) << text("err.txt");
    EXPECT_FALSE(std::filesystem::exists(folder / "out.fswords"));
    EXPECT_EQ(run("frustumscreen-bake --words --languages ../de -o out.fswords"), 1);
    EXPECT_NE(text("err.txt").find("--languages: '../de' is not a language"), std::string::npos)
        << text("err.txt");
    EXPECT_EQ(run("frustumscreen-bake --words --languages de,DE -o out.fswords"), 1);
    EXPECT_NE(text("err.txt").find("'DE' is named twice"), std::string::npos) << text("err.txt");
    EXPECT_EQ(run("frustumscreen-bake --words --languages de"), 2);
}
