// Shaping, compared with HarfBuzz alone and with the rules of the scripts.
#include "app/pack/glyph_runs.h"
#include "assets_baked/texts/glyph_atlas.h"
#include "tests/texts/languages.h"

#include <hb.h>

#include <algorithm>

using namespace frustumscreen;
using namespace frustumscreen::texts;
using namespace frustumscreen::testing;

namespace {

struct HbGlyph {
    std::uint32_t glyph = 0;
    double x_em = 0.0;
};

/// Shapes one run of one script with HarfBuzz alone.
std::vector<HbGlyph> by_harfbuzz(const FontFace& from, const std::string& text, const char* language) {
    hb_blob_t* blob = hb_blob_create_from_file(from.file.c_str());
    hb_face_t* face = hb_face_create(blob, static_cast<unsigned>(from.index));
    hb_font_t* font = hb_font_create(face);
    hb_buffer_t* buffer = hb_buffer_create();
    hb_buffer_add_utf8(buffer, text.c_str(), -1, 0, -1);
    hb_buffer_guess_segment_properties(buffer);
    hb_buffer_set_language(buffer, hb_language_from_string(language, -1));
    hb_shape(font, buffer, nullptr, 0);
    unsigned count = 0;
    const hb_glyph_info_t* infos = hb_buffer_get_glyph_infos(buffer, &count);
    const hb_glyph_position_t* positions = hb_buffer_get_glyph_positions(buffer, &count);
    const double em = hb_face_get_upem(face);
    std::vector<HbGlyph> glyphs;
    double pen = 0.0;
    for (unsigned k = 0; k < count; ++k) {
        glyphs.push_back({infos[k].codepoint, (pen + positions[k].x_offset) / em});
        pen += positions[k].x_advance;
    }
    hb_buffer_destroy(buffer);
    hb_font_destroy(font);
    hb_face_destroy(face);
    hb_blob_destroy(blob);
    return glyphs;
}

} // namespace

TEST_F(Shaping, glyphs_match_harfbuzz_in_each_script) {
    const std::array<Sample, 9> words{{{"en", "affine"},
                                       {"de", "Fläche"},
                                       {"el", "Ἀθήνησιν"},
                                       {"ar", "المجسّم"},
                                       {"he", "השולחן"},
                                       {"hi", "क्षत्रिय"},
                                       {"th", "โต๊ะนี้"},
                                       {"ja", "壺を回す"},
                                       {"zh", "图片里"}}};
    for (const Sample& word : words) {
        if (!has(word.language)) {
            continue;
        }
        const Result<ShapedText> shaped = shape(word.language, word.text);
        ASSERT_TRUE(shaped) << shaped.error().message;
        ASSERT_EQ(shaped->faces.size(), 1U) << word.language;
        std::vector<HbGlyph> expected = by_harfbuzz(shaped->faces[0], word.text, word.language);
        const std::vector<ShapedGlyph>& found = shaped->settings[0].glyphs;
        ASSERT_EQ(found.size(), expected.size()) << word.language;
        for (std::size_t k = 0; k < found.size(); ++k) {
            EXPECT_EQ(found[k].glyph, expected[k].glyph) << word.language << " glyph " << k;
            EXPECT_NEAR(found[k].x / static_cast<double>(pack::em_units), expected[k].x_em, 0.002)
                << word.language << " glyph " << k;
        }
    }
}

TEST_F(Shaping, right_to_left_lines_begin_at_the_right) {
    for (const char* language : {"ar", "he"}) {
        if (!has(language)) {
            continue;
        }
        const std::string text =
            language == std::string("ar") ? "من فضلك، ضع المجسّم على الطاولة." : "נא להניח את הגוף על השולחן.";
        const Result<ShapedText> shaped = shape(language, text, 8);
        ASSERT_TRUE(shaped) << shaped.error().message;
        EXPECT_EQ(shaped->direction, pack::TextDirection::RightToLeft);
        const ShapedSetting& setting = shaped->settings[0];
        ASSERT_GE(setting.lines.size(), 2U);
        // The full stop ends the last line: it is that line's leftmost glyph, and the line ends to the left
        // of the others' ends.
        std::size_t last_line = 0;
        for (std::size_t k = 0; k + 1 < setting.lines.size(); ++k) {
            last_line += setting.lines[k].glyphs;
        }
        const auto end = setting.glyphs.end();
        const auto begin = setting.glyphs.begin() + static_cast<std::ptrdiff_t>(last_line);
        const auto rightmost = std::max_element(begin, end, [](auto& a, auto& b) { return a.x < b.x; });
        EXPECT_GT(rightmost->x, setting.width * 3 / 4) << language;
    }
}

TEST_F(Shaping, latin_letters_in_hebrew_keep_left_to_right_order) {
    if (!has("he")) {
        return;
    }
    const Result<ShapedText> shaped = shape("he", "א USB ב");
    const Result<ShapedText> latin = shape("en", "USB");
    ASSERT_TRUE(shaped && latin);
    std::vector<std::uint32_t> found;
    for (const ShapedGlyph& glyph : shaped->settings[0].glyphs) {
        if (shaped->faces[glyph.face] == latin->faces[0]) {
            found.push_back(glyph.glyph);
        }
    }
    std::vector<std::uint32_t> expected;
    for (const ShapedGlyph& glyph : latin->settings[0].glyphs) {
        expected.push_back(glyph.glyph);
    }
    EXPECT_NE(std::search(found.begin(), found.end(), expected.begin(), expected.end()), found.end());
}

TEST_F(Shaping, thai_and_chinese_break_without_spaces) {
    for (const char* language : {"th", "zh"}) {
        if (!has(language)) {
            continue;
        }
        const char* text = language == std::string("th") ? "เลื่อนบล็อกสีขาวบนโต๊ะแล้วมองเข้าไปข้างใน"
                                                         : "请在桌面上移动和转动白色方块，您会看到展品。";
        const Result<ShapedText> shaped = shape(language, text, 9);
        ASSERT_TRUE(shaped) << shaped.error().message;
        EXPECT_TRUE(shaped->notes.empty()) << shaped->notes[0];
        EXPECT_GE(shaped->settings[0].lines.size(), 2U) << language;
        EXPECT_LE(shaped->settings[0].width, 9 * pack::em_units) << language;
    }
}

TEST_F(Shaping, a_japanese_line_does_not_begin_with_a_full_stop) {
    if (!has("ja")) {
        return;
    }
    // Ten letters and a full stop, each an em wide, at ten ems: the stop moves to the next line with one
    // letter.
    const Result<ShapedText> shaped = shape("ja", "白白白白白白白白白白。", 10);
    ASSERT_TRUE(shaped) << shaped.error().message;
    ASSERT_EQ(shaped->settings[0].lines.size(), 2U);
    EXPECT_EQ(shaped->settings[0].lines[1].glyphs, 2U);
}

TEST_F(Shaping, han_glyphs_depend_on_the_language) {
    if (!has("ja") || !has("zh")) {
        return;
    }
    const Result<ShapedText> japanese = shape("ja", "直");
    const Result<ShapedText> chinese = shape("zh", "直");
    ASSERT_TRUE(japanese && chinese);
    const bool same = japanese->faces[0] == chinese->faces[0] &&
                      japanese->settings[0].glyphs[0].glyph == chinese->settings[0].glyphs[0].glyph;
    EXPECT_FALSE(same);
}

TEST_F(Shaping, every_width_has_lines_that_fit_it) {
    const Result<ShapedText> shaped =
        shaper->shape({"Slide and turn the white block on the table.",
                       "en",
                       {6 * pack::em_units, 30 * pack::em_units, 12 * pack::em_units},
                       false});
    ASSERT_TRUE(shaped) << shaped.error().message;
    ASSERT_EQ(shaped->settings.size(), 3U);
    std::size_t lines = 0;
    for (const ShapedSetting& setting : shaped->settings) {
        EXPECT_LE(setting.width, setting.limit);
        EXPECT_GT(setting.lines.size(), lines);
        lines = setting.lines.size();
    }
}

TEST_F(Shaping, bold_uses_the_bold_typeface) {
    const Result<ShapedText> plain = shape("en", "Amphora");
    const Result<ShapedText> bold = shape("en", "Amphora", 200, true);
    ASSERT_TRUE(plain && bold);
    EXPECT_NE(plain->faces[0], bold->faces[0]);
    EXPECT_NE(bold->faces[0].file.string().find("Bold"), std::string::npos);
}

TEST_F(Shaping, names_a_letter_missing_from_all_typefaces) {
    const Result<ShapedText> shaped = shape("en", "one \xf0\x9f\x98\x80 two \xef\xbf\xbe");
    ASSERT_TRUE(shaped) << shaped.error().message;
    ASSERT_FALSE(shaped->notes.empty());
    const bool named = std::any_of(shaped->notes.begin(), shaped->notes.end(), [](const std::string& note) {
        return note.find("(U+1F600) in a text of the language 'en' is in no Noto typeface") !=
               std::string::npos;
    });
    EXPECT_TRUE(named) << shaped->notes[0];
}

TEST_F(Shaping, breaks_and_notes_a_word_wider_than_all_widths) {
    const Result<ShapedText> shaped = shaper->shape(
        {"Donaudampfschifffahrtsgesellschaft", "de", {9 * pack::em_units, 5 * pack::em_units}, false});
    ASSERT_TRUE(shaped) << shaped.error().message;
    ASSERT_EQ(shaped->notes.size(), 1U);
    EXPECT_NE(shaped->notes[0].find("a word is wider than 9.0 times the type size"), std::string::npos)
        << shaped->notes[0];
    ASSERT_EQ(shaped->settings.size(), 1U) << "the narrower width is left out";
    EXPECT_LE(shaped->settings[0].width, 9 * pack::em_units);
    EXPECT_GE(shaped->settings[0].lines.size(), 2U);
}

TEST_F(Shaping, bad_texts_and_widths_are_refused) {
    EXPECT_FALSE(shape("en", "\xff"));
    EXPECT_FALSE(shape("en", "text", 0));
    EXPECT_FALSE(shaper->shape({"text", "en", {}, false}));
    const Result<ShapedText> endless = shape("en", std::string(99999, 'a'));
    ASSERT_FALSE(endless);
    EXPECT_EQ(endless.error().message, "the text has 99999 letters; allowed are 5000: shorten it");
    const Result<ShapedText> high = shape("en", std::string(5000, 'm'), 6);
    ASSERT_FALSE(high);
    EXPECT_NE(high.error().message.find("letters at a width of 6 times the type size"), std::string::npos)
        << high.error().message;
}

TEST_F(Shaping, glyph_runs_of_all_scripts_round_trip) {
    GlyphAtlasBuilder builder;
    for (const Sample& sample : samples) {
        if (has(sample.language)) {
            const Result<ShapedText> shaped = shape(sample.language, sample.text, 12);
            ASSERT_TRUE(shaped) << shaped.error().message;
            builder.add(sample.language, *shaped);
        }
    }
    const Result<GlyphSheet> sheet = builder.finish();
    ASSERT_TRUE(sheet) << sheet.error().message;
    const Result<pack::GlyphRuns> back = pack::decode_glyph_runs(pack::encode_glyph_runs(sheet->runs));
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_TRUE(*back == sheet->runs);
    const Result<pack::DistanceAtlas> atlas =
        pack::decode_distance_atlas(pack::encode_distance_atlas(sheet->atlas), *back);
    ASSERT_TRUE(atlas) << atlas.error().message;
    EXPECT_EQ(atlas->texels, sheet->atlas.texels);
}
