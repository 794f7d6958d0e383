// An artifact's texts in all languages: which are typeset, their widths, and the notes about those that
// cannot be.
#include "app/typography/caption_image.h"
#include "app/typography/captions.h"
#include "assets_baked/texts/set_artifact.h"
#include "tests/texts/languages.h"

#include <algorithm>
#include <array>

using namespace frustumscreen;
using namespace frustumscreen::texts;
using namespace frustumscreen::testing;

namespace {

constexpr double usual_em_m = 0.010;

/// Like the kiosk's captions at two type sizes, in the units of set_artifact.
CaptionLimits limits_for_captions() {
    CaptionLimits limits;
    for (const double width_m : typography::caption_widths_m) {
        for (const double em_m : {typography::min_caption_em_m, usual_em_m}) {
            limits.text.push_back(static_cast<std::int32_t>(pack::em_units * width_m / em_m));
            limits.title.push_back(
                static_cast<std::int32_t>(pack::em_units * width_m / em_m / typography::caption_title_em));
        }
    }
    limits.title_em = typography::caption_title_em;
    limits.max_height = 25 * pack::em_units;
    return limits;
}

class SetArtifactTexts : public Shaping {
protected:
    [[nodiscard]] SetArtifact set(const std::vector<pack::PackCaption>& captions,
                                  const std::vector<std::vector<pack::PackLabel>>& labels = {},
                                  const std::vector<std::vector<pack::PackLabel>>& titles = {}) const {
        return set_artifact(captions, {"CC-BY-4.0", "Ann", {}}, {labels, titles, {}, {}},
                            limits_for_captions(), *shaper);
    }
};

std::vector<std::string> keys_of(const pack::SetLanguage& language) {
    std::vector<std::string> keys;
    for (const pack::GlyphText& text : language.runs.texts) {
        keys.push_back(text.key);
    }
    return keys;
}

bool has_note(const SetArtifact& set, std::string_view words) {
    return std::any_of(set.notes.begin(), set.notes.end(),
                       [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

} // namespace

TEST_F(SetArtifactTexts, sets_all_texts_of_each_language) {
    if (!has("de")) {
        return;
    }
    const pack::PackCaption german{"de",   "Krug", "Ein Krug.", "um 1600",
                                   "Köln", "",     "Schenkung", "Er ist hoch."};
    const pack::PackCaption english{"en", "Jug", ""};
    const SetArtifact made = set({german, english}, {{{"en", "Handle"}}, {{"de", "Fuß"}, {"en", "Foot"}}});
    EXPECT_TRUE(made.notes.empty()) << made.notes.front();
    ASSERT_EQ(made.languages.size(), 2U);
    EXPECT_EQ(keys_of(made.languages[0]),
              (std::vector<std::string>{"title", "text", "attribution", "description.0", "label.1"}));
    EXPECT_EQ(keys_of(made.languages[1]),
              (std::vector<std::string>{"title", "attribution", "label.0", "label.1"}));
    const auto lines = [](const pack::SetLanguage& language) {
        return language.runs.find("attribution")->settings.front().lines.size();
    };
    EXPECT_EQ(lines(made.languages[0]), 3U) << "Köln and um 1600, the gift, who made the scan";
    EXPECT_EQ(lines(made.languages[1]), 1U);
    EXPECT_EQ(made.languages[0].runs.find("title")->settings.size(), 1U) << "one line is one setting";
}

TEST_F(SetArtifactTexts, sets_behaviour_titles_in_every_language) {
    std::vector<pack::PackCaption> captions;
    std::vector<pack::PackLabel> titles;
    for (const Sample& sample : samples) {
        if (has(sample.language)) {
            captions.push_back({sample.language, "1", ""});
            titles.push_back({sample.language, sample.text});
        }
    }
    const SetArtifact made = set(captions, {}, {{}, titles, {{"tlh", "1"}}});
    EXPECT_TRUE(made.notes.empty()) << made.notes.front();
    ASSERT_EQ(made.languages.size(), captions.size());
    for (std::size_t k = 0; k < captions.size(); ++k) {
        const std::string& language = captions[k].language;
        const pack::GlyphRuns& runs = made.languages[k].runs;
        EXPECT_EQ(keys_of(made.languages[k]),
                  (std::vector<std::string>{"title", "attribution", "behaviour.1"}))
            << language;
        const pack::GlyphText* const title = runs.find("behaviour.1");
        ASSERT_NE(title, nullptr) << language;
        const bool leftwards = language == "ar" || language == "he";
        EXPECT_EQ(title->direction,
                  leftwards ? pack::TextDirection::RightToLeft : pack::TextDirection::LeftToRight)
            << language;
        const Result<ShapedText> alone = shape(language, titles[k].text, 35);
        ASSERT_TRUE(alone);
        std::size_t glyphs = 0;
        for (const pack::GlyphSetting& setting : title->settings) {
            glyphs = std::max(glyphs, setting.glyphs.size());
        }
        EXPECT_EQ(glyphs, alone->settings.front().glyphs.size()) << language;
    }
}

TEST_F(SetArtifactTexts, captions_fill_the_kiosks_widths) {
    for (const Sample& sample : samples) {
        if (!has(sample.language)) {
            continue;
        }
        std::string text = sample.text;
        for (int k = 0; k < 2; ++k) {
            text += std::string(" ") + sample.text;
        }
        const SetArtifact made = set({{sample.language, sample.text, text}});
        ASSERT_EQ(made.languages.size(), 1U);
        const pack::SetLanguage& language = made.languages.front();
        for (const double em_m : {typography::min_caption_em_m, usual_em_m}) {
            double last_height_m = 0.0;
            for (const double width_m : {0.30, 0.16}) { // words may be wider than 0.075 m
                constexpr double texels_per_m = 2000.0;
                const typography::CaptionImage image = typography::make_caption(
                    language.runs, language.atlas,
                    std::array{
                        typography::GlyphPart{typography::CaptionRole::Title, language.runs.find("title")},
                        typography::GlyphPart{typography::CaptionRole::Text, language.runs.find("text")}},
                    em_m, width_m, texels_per_m);
                EXPECT_LE(image.size_m.x, width_m + 0.1 * em_m) << sample.language;
                EXPECT_GE(image.size_m.x, 0.75 * width_m) << sample.language << ": room is left unused";
                EXPECT_GT(image.size_m.y, last_height_m) << sample.language;
                last_height_m = image.size_m.y;
            }
        }
    }
}

TEST_F(SetArtifactTexts, notes_unsettable_texts_and_sets_the_rest) {
    if (!has("de")) {
        return;
    }
    std::string long_text;
    for (int k = 0; k < 1500; ++k) {
        long_text += "Wort ";
    }
    pack::PackCaption caption{"de", "Krug \xf0\x9f\x98\x80", "Kurz."};
    caption.description = long_text;
    const SetArtifact made = set({caption});
    ASSERT_EQ(made.languages.size(), 1U);
    EXPECT_EQ(keys_of(made.languages.front()), (std::vector<std::string>{"title", "text", "attribution"}));
    EXPECT_TRUE(has_note(made, "texts in 'de': title: the letter")) << made.notes.front();
    EXPECT_TRUE(has_note(made, "texts in 'de': description: it is as long as 45 captions and is not told; "
                               "allowed are 32: shorten it to about 5333 letters"));
    EXPECT_EQ(made.notes.size(), 2U);
}

TEST_F(SetArtifactTexts, notes_a_caption_too_high_for_a_table) {
    if (!has("en")) {
        return;
    }
    const auto of_words = [](int count) {
        std::string text;
        for (int k = 0; k < count; ++k) {
            text += "word ";
        }
        return text;
    };
    // Lines of 35 times the type size hold 14 words of 2.5, a table holds 17 such lines below a title.
    EXPECT_TRUE(set({{"en", "Jug", of_words(150)}}).notes.empty());
    const SetArtifact high = set({{"en", "Jug", of_words(400)}});
    ASSERT_EQ(high.notes.size(), 1U);
    EXPECT_NE(high.notes.front().find("does not fit on a table"), std::string::npos) << high.notes.front();
    ASSERT_EQ(high.languages.size(), 1U) << "it is set all the same";
    const pack::GlyphText* text = high.languages.front().runs.find("text");
    ASSERT_NE(text, nullptr);
    EXPECT_LT(text->settings.size(), 6U) << "but not for 0.075 m, where it would be three metres high";
}
