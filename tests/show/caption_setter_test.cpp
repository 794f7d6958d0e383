// Captions from glyph runs if the pack has them, otherwise in the kiosk's typeface.
#include "app/residency/caption_setter.h"
#include "tests/show/square_letters.h"

#include <gtest/gtest.h>

using namespace frustumscreen;
using namespace frustumscreen::show;

namespace {

constexpr double em_m = 0.010;
constexpr double texels_per_m = 2000.0;

/// A letter that is a filled square as large as the type size, on one line.
pack::GlyphText letter(const std::string& key) {
    return {key,
            pack::TextDirection::LeftToRight,
            {{4 * pack::em_units, pack::em_units, pack::em_units, {{pack::em_units, 1}}, {{0, 0, 0}}}}};
}

std::vector<typography::CaptionImage> images_of(const std::vector<pack::SetLanguage>& set,
                                                const pack::PackCaption& caption) {
    residency::CaptionSetter setter({em_m, texels_per_m});
    Result<std::vector<typography::CaptionImage>> images = setter.set(residency::caption_text(caption), set);
    EXPECT_TRUE(images) << images.error().message;
    return images ? *std::move(images)
                  : std::vector<typography::CaptionImage>(typography::caption_widths_m.size());
}

} // namespace

TEST(CaptionSetter, takes_the_glyph_runs_of_the_captions_language) {
    const std::vector set{synthetic::set_in_squares("ar", {letter("title"), letter("text")}),
                          synthetic::set_in_squares("hi", {letter("title")})};
    for (const typography::CaptionImage& image : images_of(set, {"ar", "T", "t"})) {
        EXPECT_NEAR(image.size_m.x, typography::caption_title_em * em_m, 2.0 / texels_per_m);
        EXPECT_EQ(image.coverage.at(image.coverage.width / 2, 5), 255) << "the title is a bright square";
    }
    const typography::CaptionImage title = images_of(set, {"hi", "T", ""}).front();
    EXPECT_NEAR(title.size_m.y, typography::caption_title_em * em_m, 2.0 / texels_per_m);
}

TEST(CaptionSetter, falls_back_to_the_typeface_for_incompletely_set_captions) {
    const pack::PackCaption caption{"hi", "Title", "A text of several words."};
    const std::vector<typography::CaptionImage> plain = images_of({}, caption);
    const std::vector<typography::CaptionImage> other =
        images_of({synthetic::set_in_squares("ar", {letter("title"), letter("text")})}, caption);
    const std::vector<typography::CaptionImage> half =
        images_of({synthetic::set_in_squares("hi", {letter("title")})}, caption);
    ASSERT_EQ(plain.size(), typography::caption_widths_m.size());
    for (std::size_t k = 0; k < plain.size(); ++k) {
        EXPECT_GT(plain[k].coverage.width, 1);
        EXPECT_EQ(plain[k].coverage.texels, other[k].coverage.texels);
        EXPECT_EQ(plain[k].coverage.texels, half[k].coverage.texels);
    }
}

TEST(CaptionSetter, measures_the_size_that_it_draws) {
    std::vector<pack::SetLanguage> set{synthetic::set_in_squares("ar", {letter("title"), letter("text")})};
    residency::CaptionSetter setter({em_m, texels_per_m});
    const auto titled = [](const std::string& language, const std::string& title, const std::string& text) {
        return residency::caption_text({language, title, text});
    };
    for (const residency::TableText& text :
         {titled("ar", "T", "t"), titled("hi", "Title", "A text of several words that is broken"),
          titled("hi", "", "A text"),
          residency::TableText{"ar", {{typography::CaptionRole::Text, "text", "t"}}}, titled("el", "", ""),
          residency::TableText{"hi",
                               {{typography::CaptionRole::Text, "text", "A text"},
                                {typography::CaptionRole::Small, "attribution", "A potter"}}}}) {
        const std::vector<typography::CaptionImage> drawn = setter.set(text, set).value();
        std::vector<pack::SetLanguage> without_atlas = set;
        without_atlas.front().atlas = {};
        const std::vector<glm::dvec2> sizes = setter.sizes_m(text, without_atlas).value();
        ASSERT_EQ(sizes.size(), drawn.size());
        for (std::size_t k = 0; k < sizes.size(); ++k) {
            EXPECT_EQ(sizes[k], drawn[k].size_m) << text.language << text.pieces.size();
            EXPECT_EQ(glm::round(sizes[k] * texels_per_m),
                      glm::dvec2(drawn[k].coverage.width, drawn[k].coverage.height));
        }
    }
}

TEST(CaptionSetter, takes_the_attribution_as_one_text_else_line_by_line) {
    pack::PackCaption caption{"ar", "T", "t"};
    caption.maker = "m";
    caption.credit = "c";
    const pack::ScanRights rights{"CC-BY-4.0", "Ann", {}};
    const auto keys = [&](const std::vector<pack::SetLanguage>& set) {
        std::vector<std::string> found;
        for (const residency::TextPiece& piece :
             residency::attribution_pieces(caption, rights, set, typography::CaptionRole::Small)) {
            found.push_back(piece.key);
        }
        return found;
    };
    EXPECT_EQ(
        keys({synthetic::set_in_squares("ar", {letter("title"), letter("attribution"), letter("maker")})}),
        std::vector<std::string>{"attribution"});
    EXPECT_EQ(keys({synthetic::set_in_squares("ar", {letter("title"), letter("credit"), letter("maker")})}),
              (std::vector<std::string>{"maker", "credit"}));
    EXPECT_EQ(keys({synthetic::set_in_squares("ar", {letter("title")})}), std::vector<std::string>{})
        << "nothing is set in it";
    EXPECT_EQ(keys({}), std::vector<std::string>{"attribution"}) << "in the kiosk's own typeface";
    caption.maker = caption.credit = "";
    EXPECT_TRUE(residency::attribution_pieces(caption, {}, {}, typography::CaptionRole::Small).empty());
}
