// The exhibit's own words: complete in every built-in language, and read with messages that name the line.
#include "assets_baked/texts/bake_words.h"
#include "assets_baked/texts/builtin_words.h"
#include "assets_baked/texts/words.h"
#include "firmware_host/base/file.h"
#include "tests/base/temporary_folder.h"
#include "tests/base/told.h"
#include "tests/texts/languages.h"

using namespace frustumscreen;
using namespace frustumscreen::texts;
using frustumscreen::testing::Shaping;

namespace {

std::string refusal(std::string_view toml) {
    const Result<WrittenWords> words = parse_words(toml, "words/xx.toml");
    return words ? std::string() : test::told(words.error());
}

class WordsFolder : public WithTemporaryFolder {
protected:
    [[nodiscard]] Result<std::vector<CollectedWords>>
    collect(const std::vector<std::string>& languages) const {
        return collect_words(folder, languages);
    }
};

const Word& word_of(const CollectedWords& words, std::string_view key) {
    return *std::find_if(words.words.begin(), words.words.end(),
                         [&](const Word& word) { return word.key == key; });
}

} // namespace

TEST(BuiltinWords, has_eleven_languages) {
    EXPECT_EQ(builtin_word_languages(),
              (std::vector<std::string>{"ar", "de", "el", "en", "es", "fr", "he", "hi", "it", "ja", "zh"}));
}

TEST(BuiltinWords, every_language_is_complete) {
    for (const BuiltinWords& file : builtin_words()) {
        const Result<WrittenWords> words = parse_words(file.toml, std::string(file.language) + ".toml");
        ASSERT_TRUE(words) << words.error().message;
        const auto collected = collect_words({}, std::vector<std::string>{std::string(file.language)});
        ASSERT_TRUE(collected) << collected.error().message; // complete in the museum's language
        EXPECT_EQ(words->size(), collected->front().words.size()) << file.language;
        EXPECT_TRUE(collected->front().notes.empty()) << file.language;
    }
}

TEST(BuiltinWords, no_two_words_of_a_language_are_equal) {
    for (const BuiltinWords& file : builtin_words()) {
        const Result<WrittenWords> words = parse_words(file.toml, std::string(file.language) + ".toml");
        ASSERT_TRUE(words) << words.error().message;
        std::map<std::string, std::string> key_of;
        for (const auto& [key, text] : *words) {
            const auto [other, first] = key_of.emplace(text, key);
            EXPECT_TRUE(first) << file.language << ": " << key << " and " << other->second << " are both '"
                               << text << "'";
        }
    }
}

TEST(ParseWords, messages_name_file_line_and_key) {
    EXPECT_TRUE(
        test::tells(refusal("name = \"X\"\n[advice]\nslide_lefft = \"a\"\n"),
                    {"words/xx.toml:3: ", "'advice.slide_lefft'", "advice.slide_left ", "[words.no_word]"}));
    EXPECT_TRUE(test::tells(refusal("name = \"X\"\nattract_line = 3\n"),
                            {"words/xx.toml:2: attract_line", "[words.no_text]"}));
    EXPECT_TRUE(test::tells(refusal("attract_line = \"\"\n"),
                            {"words/xx.toml:1: attract_line has 0 bytes", "1 to 1000", "[words.word_size]"}));
    EXPECT_TRUE(
        test::tells(refusal("attract_line = \"a\\tb\"\n"),
                    {"words/xx.toml:1: attract_line: line 1, letter 2: U+0009", "[words.word_text]"}));
    EXPECT_NE(refusal("attract_line = \"a\nname").find("words/xx.toml:1: is not TOML"), std::string::npos);
    EXPECT_NE(refusal(std::string(2U << 20, '#')), "");
    EXPECT_NE(refusal(std::string(9000, '.')), "");
}

TEST_F(WordsFolder, museum_lines_replace_built_in_lines) {
    put("de.toml", "attract_line = \"Kommen Sie näher.\"\n");
    const auto collected = collect({"en", "de"});
    ASSERT_TRUE(collected) << collected.error().message;
    EXPECT_EQ(word_of((*collected)[1], "attract_line").text, "Kommen Sie näher.");
    EXPECT_EQ(word_of((*collected)[1], "name").text, "Deutsch");
    EXPECT_TRUE((*collected)[1].notes.empty());
}

TEST_F(WordsFolder, missing_lines_fall_back_to_the_first_language_with_a_note) {
    put("nl.toml", "name = \"Nederlands\"\nattract_line = \"Verschuif het blok.\"\n");
    const auto collected = collect({"de", "nl"});
    ASSERT_TRUE(collected) << collected.error().message;
    const Word& word = word_of((*collected)[1], "advice.set_down");
    EXPECT_EQ(word.text, "Bitte stellen Sie den Block auf den Tisch.");
    EXPECT_EQ(word.language, "de");
    EXPECT_EQ(word_of((*collected)[1], "attract_line").language, "nl");
    EXPECT_EQ((*collected)[1].words.size(), (*collected)[0].words.size());
    ASSERT_EQ((*collected)[1].notes.size(), 1U);
    EXPECT_EQ(
        (*collected)[1].notes[0],
        "the language 'nl' has no text for room_line, advice.slide_left, advice.slide_left_a_little, "
        "advice.slide_right, advice.slide_right_a_little and 102 more; there the exhibit speaks 'de': write "
        "them into nl.toml");
}

TEST_F(WordsFolder, reads_obsolete_lines_with_a_note) {
    put("de.toml", "help = \"Hilfe\"\n[advice]\nlower = \"Tiefer.\"\n[fault]\nrepairing = \"Gleich.\"\n");
    const auto collected = collect({"de"});
    ASSERT_TRUE(collected) << collected.error().message;
    EXPECT_EQ(word_of((*collected)[0], "advice.lower").text, "Tiefer.");
    EXPECT_EQ((*collected)[0].words.size(),
              collect_words({}, std::vector<std::string>{"de"})->front().words.size());
    EXPECT_EQ(
        (*collected)[0].notes,
        std::vector<std::string>{"the language 'de' has a text for help, fault.repairing, which is no longer "
                                 "shown: delete it from de.toml"});
}

TEST_F(WordsFolder, a_language_without_words_is_refused) {
    const auto collected = collect({"en", "nl"});
    ASSERT_FALSE(collected);
    EXPECT_NE(collected.error().message.find("there are no words in 'nl'; write nl.toml"), std::string::npos);
    const auto house = collect({"nl", "en"});
    ASSERT_FALSE(house);
    EXPECT_NE(house.error().message.find("the house's language 'nl' has no text for name"),
              std::string::npos);
}

TEST_F(Shaping, every_built_in_word_fits_every_caption_width) {
    for (const std::string& language : builtin_word_languages()) {
        if (!has(language)) {
            continue;
        }
        const Result<std::vector<CollectedWords>> collected =
            collect_words({}, std::vector<std::string>{language});
        ASSERT_TRUE(collected) << collected.error().message;
        const Result<BakedWords> baked = bake_words(*collected, *shaper);
        ASSERT_TRUE(baked) << baked.error().message;
        EXPECT_TRUE(baked->notes.empty()) << baked->notes[0];
        for (const pack::GlyphText& text : baked->languages[0].runs.texts) {
            EXPECT_EQ(text.settings.size(), caption_widths_em.size()) << language << ": " << text.key;
        }
    }
}
