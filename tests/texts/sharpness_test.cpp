// The kiosk's picture of a text, from distances, compared with FreeType's coverage of the same outlines.
#include "app/typography/glyph_image.h"
#include "assets_baked/texts/bake_words.h"
#include "assets_baked/texts/glyph_atlas.h"
#include "tests/base/write_figures.h"
#include "tests/texts/languages.h"

#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H

#include <cmath>
#include <cstdlib>
#include <map>

using namespace frustumscreen;
using namespace frustumscreen::texts;
using namespace frustumscreen::testing;

namespace {

constexpr int fine = 8; ///< the reference is drawn this much larger, then averaged

/// FreeType's coverage of a shaped setting, at the position and size of `like`.
class Reference {
public:
    Reference() { FT_Init_FreeType(&library_); }
    ~Reference() { FT_Done_FreeType(library_); }
    Reference(const Reference&) = delete;
    Reference& operator=(const Reference&) = delete;

    [[nodiscard]] image::Image<std::uint8_t> draw(const ShapedText& text, const ShapedSetting& setting,
                                                  double em_px, const typography::GlyphImage& like) {
        image::Image<std::uint8_t> large(like.coverage.width * fine, like.coverage.height * fine);
        std::size_t next = 0;
        for (const pack::GlyphLine& line : setting.lines) {
            for (std::size_t k = 0; k < line.glyphs; ++k, ++next) {
                const ShapedGlyph& glyph = setting.glyphs[next];
                const double scale = em_px * fine / pack::em_units;
                draw_glyph(text.faces[glyph.face], glyph.glyph, em_px * fine,
                           glyph.x * scale + like.left_px * fine,
                           (line.baseline - glyph.up) * scale + like.top_px * fine, large);
            }
        }
        return averaged(large, like);
    }

private:
    void draw_glyph(const FontFace& from, std::uint32_t glyph, double em_px, double x, double y,
                    image::Image<std::uint8_t>& into) {
        FT_Face& face = faces_[from];
        if (face == nullptr) {
            ASSERT_EQ(FT_New_Face(library_, from.file.c_str(), from.index, &face), 0);
        }
        FT_Set_Char_Size(face, 0, std::lround(em_px * 64.0), 72, 72);
        FT_Vector part{std::lround((x - std::floor(x)) * 64.0), -std::lround((y - std::floor(y)) * 64.0)};
        FT_Set_Transform(face, nullptr, &part);
        ASSERT_EQ(FT_Load_Glyph(face, glyph, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP | FT_LOAD_RENDER), 0);
        const FT_Bitmap& bitmap = face->glyph->bitmap;
        for (int row = 0; row < static_cast<int>(bitmap.rows); ++row) {
            for (int column = 0; column < static_cast<int>(bitmap.width); ++column) {
                const int u = static_cast<int>(std::floor(x)) + face->glyph->bitmap_left + column;
                const int v = static_cast<int>(std::floor(y)) - face->glyph->bitmap_top + row;
                const std::uint8_t cover = bitmap.buffer[row * bitmap.pitch + column];
                if (u >= 0 && v >= 0 && u < into.width && v < into.height) {
                    into.at(u, v) = std::max(into.at(u, v), cover);
                } else {
                    EXPECT_LT(cover, 255) << "a letter reaches over the picture's edge";
                }
            }
        }
    }
    static image::Image<std::uint8_t> averaged(const image::Image<std::uint8_t>& large,
                                               const typography::GlyphImage& like) {
        image::Image<std::uint8_t> image(like.coverage.width, like.coverage.height);
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                int sum = 0;
                for (int k = 0; k < fine * fine; ++k) {
                    sum += large.at(x * fine + k % fine, y * fine + k / fine);
                }
                image.at(x, y) = static_cast<std::uint8_t>(sum / (fine * fine));
            }
        }
        return image;
    }

    FT_Library library_ = nullptr;
    std::map<FontFace, FT_Face> faces_;
};

struct Difference {
    double rms = 0.0;       ///< of the coverage, 0..255, over the pixels where either picture has letters
    double worst = 0.0;     ///< of the coverage
    double sharpness = 0.0; ///< sum of the steps between neighbours, relative to the reference's
};

double steps(const image::Image<std::uint8_t>& image) {
    double sum = 0.0;
    for (int y = 1; y < image.height; ++y) {
        for (int x = 1; x < image.width; ++x) {
            sum += std::hypot(image.at(x, y) - image.at(x - 1, y), image.at(x, y) - image.at(x, y - 1));
        }
    }
    return sum;
}

Difference compare(const image::Image<std::uint8_t>& image, const image::Image<std::uint8_t>& reference) {
    Difference difference;
    double squares = 0.0;
    int count = 0;
    for (std::size_t k = 0; k < image.texels.size(); ++k) {
        if (image.texels[k] > 0 || reference.texels[k] > 0) {
            const double apart = std::abs(image.texels[k] - reference.texels[k]);
            squares += apart * apart;
            difference.worst = std::max(difference.worst, apart);
            ++count;
        }
    }
    difference.rms = std::sqrt(squares / std::max(count, 1));
    difference.sharpness = steps(image) / std::max(steps(reference), 1.0);
    return difference;
}

class Sharpness : public Shaping {
protected:
    [[nodiscard]] Difference measure(const Sample& sample, const GlyphAtlasOptions& options, double em_px) {
        const Result<ShapedText> text = shape(sample.language, sample.text);
        EXPECT_TRUE(text) << text.error().message;
        GlyphAtlasBuilder builder(options);
        builder.add("text", *text);
        const Result<GlyphSheet> sheet = builder.finish();
        EXPECT_TRUE(sheet) << sheet.error().message;
        const typography::GlyphImage image =
            typography::glyph_image(sheet->runs, sheet->atlas, sheet->runs.texts[0].settings[0], em_px);
        return compare(image.coverage, reference.draw(*text, text->settings[0], em_px, image));
    }

    Reference reference;
};

} // namespace

TEST_F(Sharpness, letters_match_freetype_coverage) {
    for (const Sample& sample : samples) {
        if (!has(sample.language)) {
            continue;
        }
        for (const double em_px : {20.0, 60.0}) {
            const Difference difference = measure(sample, {}, em_px);
            EXPECT_LT(difference.rms, em_px < 30 ? 5.0 : 12.0) << sample.language << " at " << em_px;
            EXPECT_GT(difference.sharpness, 0.96) << sample.language << " at " << em_px;
            EXPECT_LT(difference.sharpness, 1.04) << sample.language << " at " << em_px;
        }
    }
}

// Writes the table `texts` of docs/measurements.md: `ctest -C long -R texts_figures`, with FRUSTUMSCREEN_FIGURES
// (docs/bench.md).
TEST_F(Sharpness, DISABLED_figures) {
    std::string csv = "language,texels_per_em,spread_texels,atlas_bytes,rms_at_20_px,worst_at_20_px,"
                      "sharpness_at_20_px,rms_at_60_px,worst_at_60_px,sharpness_at_60_px\n";
    for (const Sample& sample : samples) {
        for (const int texels : {24, 32, 40, 48, 64}) {
            for (const int spread : {2, 4}) {
                const Result<ShapedText> text = shape(sample.language, sample.text);
                GlyphAtlasBuilder builder({texels, spread});
                builder.add("text", *text);
                const Result<GlyphSheet> sheet = builder.finish();
                csv += fmt::format("{},{},{},{}", sample.language, texels, spread,
                                   pack::encode_distance_atlas(sheet->atlas).size());
                for (const double em_px : {20.0, 60.0}) {
                    const Difference difference = measure(sample, {texels, spread}, em_px);
                    csv += fmt::format(",{:.3f},{:.0f},{:.4f}", difference.rms, difference.worst,
                                       difference.sharpness);
                }
                csv += "\n";
            }
        }
    }
    fmt::print("{}", csv);
    write_figures("texts.csv", csv);
}

TEST_F(Sharpness, DISABLED_atlas_bytes_against_picture_bytes_figures) {
    for (const std::string& language : builtin_word_languages()) {
        const Result<std::vector<CollectedWords>> collected =
            collect_words({}, std::vector<std::string>{language});
        const Result<BakedWords> baked = bake_words(*collected, *shaper);
        const pack::LanguageWords& words = baked->languages[0];
        const Result<Bytes> file = pack::write_words(baked->languages);
        fmt::print("{}: {} letters, atlas {} B, file {} B; pictures", language, words.runs.boxes.size(),
                   pack::encode_distance_atlas(words.atlas).size(), file->size());
        for (const double em_px : {20.0, 60.0}) {
            std::size_t bytes = 0;
            for (const pack::GlyphText& text : words.runs.texts) {
                for (const pack::GlyphSetting& setting : text.settings) {
                    bytes += pack::encode_distance_atlas(
                                 typography::glyph_image(words.runs, words.atlas, setting, em_px).coverage)
                                 .size();
                }
            }
            fmt::print(" at {:.0f} px {} B", em_px, bytes);
        }
        fmt::print("\n");
    }
}
