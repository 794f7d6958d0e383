// The file of the exhibit's own words.
#include "app/pack/container/zip_archive.h"
#include "app/pack/words_file.h"
#include "tests/pack/zip_dates.h"

#include <gtest/gtest.h>

using namespace frustumscreen;
using namespace frustumscreen::texts;

namespace {

/// A language with a single word of one letter.
pack::LanguageWords words_in(const std::string& language, const std::string& name) {
    pack::LanguageWords words;
    words.language = language;
    words.name = name;
    words.words = {{"help", "Text", language}};
    words.runs.texels_per_em = 8;
    words.runs.spread_texels = 2;
    words.runs.atlas_width = 6;
    words.runs.atlas_height = 5;
    words.runs.boxes = {{0, 0, 6, 5, -1, 4}};
    words.runs.texts = {
        {"help", pack::TextDirection::LeftToRight, {{9216, 1024, 1400, {{1100, 1}}, {{0, 0, 12}}}}}};
    words.atlas = pack::DistanceAtlas(6, 5, static_cast<std::uint8_t>(name.size()));
    words.sounds.emplace("help", Bytes(100, std::byte{7}));
    return words;
}

Bytes file_of_two() {
    const Result<Bytes> file = pack::write_words(
        std::vector<pack::LanguageWords>{words_in("de", "Deutsch"), words_in("fr", "Français")});
    EXPECT_TRUE(file);
    return file.value_or(Bytes());
}

} // namespace

TEST(WordsFile, round_trip_of_a_language) {
    const Bytes file = file_of_two();
    const Result<pack::LanguageWords> back = pack::read_words(file, "fr");
    ASSERT_TRUE(back) << back.error().message;
    const pack::LanguageWords expected = words_in("fr", "Français");
    EXPECT_EQ(back->name, expected.name);
    EXPECT_EQ(back->words, expected.words);
    EXPECT_TRUE(back->runs == expected.runs);
    EXPECT_EQ(back->atlas.texels, expected.atlas.texels);
    EXPECT_EQ(back->sounds, expected.sounds);
}

TEST(WordsFile, equal_words_give_equal_bytes_with_fixed_dates) {
    const Bytes file = file_of_two();
    EXPECT_EQ(file, file_of_two());
    const std::vector<std::uint32_t> dates = samples::zip_dates(file);
    ASSERT_FALSE(dates.empty());
    for (const std::uint32_t date : dates) {
        EXPECT_EQ(date, samples::earliest_zip_date);
    }
}

TEST(WordsFile, lists_languages_in_file_order) {
    const Result<std::vector<pack::WordsLanguage>> list = pack::list_words(file_of_two());
    ASSERT_TRUE(list) << list.error().message;
    ASSERT_EQ(list->size(), 2U);
    EXPECT_EQ((*list)[0].language, "de");
    EXPECT_EQ((*list)[1].name, "Français");
    EXPECT_EQ((*list)[1].words, 1U);
    EXPECT_EQ((*list)[1].sounds, 1U);
}

TEST(WordsFile, names_a_missing_language) {
    const Result<pack::LanguageWords> back = pack::read_words(file_of_two(), "nl");
    ASSERT_FALSE(back);
    EXPECT_EQ(back.error().message, "there are no words in the language 'nl'; bake them with --languages");
}

TEST(WordsFile, changed_byte_is_rejected_or_harmless) {
    const Bytes good = file_of_two();
    const Result<pack::LanguageWords> expected = pack::read_words(good, "de");
    ASSERT_TRUE(expected);
    std::size_t refused = 0;
    for (std::size_t k = 0; k < good.size(); ++k) {
        Bytes bad = good;
        bad[k] ^= std::byte{0x10};
        const Result<pack::LanguageWords> back = pack::read_words(bad, "de");
        refused += back ? 0 : 1;
        if (back) {
            EXPECT_TRUE(back->runs == expected->runs && back->atlas.texels == expected->atlas.texels) << k;
            EXPECT_EQ(back->sounds, expected->sounds) << k;
        }
    }
    EXPECT_GT(refused, good.size() / 3);
}

TEST(WordsFile, a_file_cut_anywhere_is_refused) {
    const Bytes good = file_of_two();
    for (std::size_t bytes = 0; bytes < good.size(); ++bytes) {
        EXPECT_FALSE(pack::read_words(std::span(good).first(bytes), "de")) << bytes;
    }
}

TEST(WordsFile, rejects_another_format) {
    pack::ZipWriter zip;
    zip.add("manifest.json", as_bytes(R"({"format":"FrustumScreen pack","version":2})"),
            pack::Packing::Stored);
    const Result<Bytes> file = zip.finish();
    ASSERT_TRUE(file);
    const Result<std::vector<pack::WordsLanguage>> list = pack::list_words(*file);
    ASSERT_FALSE(list);
    EXPECT_EQ(list.error().id, "words.not_words");
}
