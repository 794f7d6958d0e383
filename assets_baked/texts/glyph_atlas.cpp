#include "assets_baked/texts/glyph_atlas.h"

#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_MODULE_H

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

namespace frustumscreen {

namespace {

struct CloseLibrary {
    void operator()(FT_Library library) const { FT_Done_FreeType(library); }
};
struct CloseFace {
    void operator()(FT_Face face) const { FT_Done_Face(face); }
};

/// A glyph's own picture of distances, and its box without a place in the atlas.
struct DrawnGlyph {
    GlyphBox box;
    DistanceAtlas distances;
};

class GlyphPainter {
public:
    static Result<GlyphPainter> open(const GlyphAtlasOptions& options) {
        GlyphPainter painter;
        FT_Library library = nullptr;
        if (FT_Init_FreeType(&library) != 0) {
            return fail(ErrorKind::Internal, "typefaces: FreeType cannot start");
        }
        painter.library_.reset(library);
        painter.texels_per_em_ = options.texels_per_em;
        FT_Int spread = options.spread_texels;
        FT_Bool overlaps =
            1; // letters are drawn of strokes that lie over each other, in Devanagari above all
        if (FT_Property_Set(library, "sdf", "spread", &spread) != 0 ||
            FT_Property_Set(library, "sdf", "overlaps", &overlaps) != 0) {
            return fail(ErrorKind::Internal,
                        "typefaces: this FreeType draws no distances; 2.11 or newer does");
        }
        return painter;
    }

    Result<DrawnGlyph> draw(const FontFace& from, std::uint32_t glyph) {
        const FT_Face face = face_of(from);
        if (face == nullptr || FT_Load_Glyph(face, glyph, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP) != 0) {
            return bad_input(
                fmt::format("{}: glyph {} of this typeface cannot be read; install its package again",
                            from.file.string(), glyph));
        }
        DrawnGlyph drawn;
        if (face->glyph->outline.n_contours == 0) {
            return drawn;
        }
        if (FT_Render_Glyph(face->glyph, FT_RENDER_MODE_SDF) != 0) {
            return bad_input(
                fmt::format("{}: glyph {} of this typeface cannot be drawn", from.file.string(), glyph));
        }
        const FT_Bitmap& bitmap = face->glyph->bitmap;
        drawn.distances = DistanceAtlas(static_cast<int>(bitmap.width), static_cast<int>(bitmap.rows));
        for (unsigned row = 0; row < bitmap.rows; ++row) {
            std::copy_n(bitmap.buffer + static_cast<std::ptrdiff_t>(row) * bitmap.pitch, bitmap.width,
                        drawn.distances.texels.begin() +
                            static_cast<std::ptrdiff_t>(row) * drawn.distances.width);
        }
        drawn.box.width = static_cast<std::uint16_t>(bitmap.width);
        drawn.box.height = static_cast<std::uint16_t>(bitmap.rows);
        drawn.box.left = static_cast<std::int16_t>(face->glyph->bitmap_left);
        drawn.box.top = static_cast<std::int16_t>(face->glyph->bitmap_top);
        return drawn;
    }

private:
    FT_Face face_of(const FontFace& from) {
        const auto known = faces_.find(from);
        if (known != faces_.end()) {
            return known->second.get();
        }
        FT_Face face = nullptr;
        if (FT_New_Face(library_.get(), from.file.c_str(), from.index, &face) != 0 ||
            FT_Set_Char_Size(face, 0, texels_per_em_ * 64, 72, 72) != 0) {
            return nullptr;
        }
        return faces_.emplace(from, face).first->second.get();
    }

    std::unique_ptr<FT_LibraryRec_, CloseLibrary> library_; ///< outlives the faces
    std::map<FontFace, std::unique_ptr<FT_FaceRec_, CloseFace>> faces_;
    int texels_per_em_ = 0;
};

/// Gives every glyph a place: shelves, the tallest glyphs first.
void place(std::vector<DrawnGlyph>& glyphs, GlyphRuns& runs) {
    std::int64_t area = 0;
    int widest = 0;
    for (const DrawnGlyph& glyph : glyphs) {
        area += std::int64_t{glyph.box.width} * glyph.box.height;
        widest = std::max<int>(widest, glyph.box.width);
    }
    const int width =
        std::max(widest, static_cast<int>(std::ceil(std::sqrt(1.05 * static_cast<double>(area)))));
    std::vector<std::size_t> order(glyphs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return glyphs[a].box.height > glyphs[b].box.height;
    });
    int x = 0;
    int y = 0;
    int shelf = 0;
    for (const std::size_t k : order) {
        GlyphBox& box = glyphs[k].box;
        if (x + box.width > width) {
            x = 0;
            y += shelf;
            shelf = 0;
        }
        box.x = static_cast<std::uint16_t>(x);
        box.y = static_cast<std::uint16_t>(y);
        x += box.width;
        shelf = std::max<int>(shelf, box.height);
    }
    runs.atlas_width = static_cast<std::uint16_t>(area == 0 ? 0 : width);
    runs.atlas_height = static_cast<std::uint16_t>(y + shelf);
}

DistanceAtlas paint(const std::vector<DrawnGlyph>& glyphs, const GlyphRuns& runs) {
    DistanceAtlas atlas(runs.atlas_width, runs.atlas_height);
    for (const DrawnGlyph& glyph : glyphs) {
        for (int row = 0; row < glyph.box.height; ++row) {
            std::copy_n(&glyph.distances.at(0, row), glyph.box.width,
                        &atlas.at(glyph.box.x, glyph.box.y + row));
        }
    }
    return atlas;
}

} // namespace

std::uint16_t GlyphAtlasBuilder::number_of(const FontFace& face, std::uint32_t glyph) {
    const auto [found, added] = numbers_.try_emplace({face, glyph}, glyphs_.size());
    if (added) {
        glyphs_.emplace_back(face, glyph);
    }
    return static_cast<std::uint16_t>(found->second);
}

void GlyphAtlasBuilder::add(const std::string& key, const ShapedText& text) {
    GlyphText& added = texts_.emplace_back();
    added.key = key;
    added.direction = text.direction;
    for (const ShapedSetting& from : text.settings) {
        GlyphSetting& setting = added.settings.emplace_back();
        setting.limit = from.limit;
        setting.width = from.width;
        setting.height = from.height;
        setting.lines = from.lines;
        for (const ShapedGlyph& glyph : from.glyphs) {
            setting.glyphs.push_back({number_of(text.faces[glyph.face], glyph.glyph), glyph.up, glyph.x});
        }
    }
}

Result<GlyphSheet> GlyphAtlasBuilder::finish() {
    using namespace glyph_limits;
    const auto too_many = [&] {
        return bad_input(fmt::format(
            "the texts of one language need {} different letters; that is more than an atlas of {} "
            "texels holds: shorten them",
            glyphs_.size(), most_atlas_texels));
    };
    Result<GlyphPainter> painter = GlyphPainter::open(options_);
    if (!painter) {
        return tl::unexpected<Error>(painter.error());
    }
    if (glyphs_.size() > most_boxes || texts_.size() > most_texts) {
        return too_many();
    }
    std::vector<DrawnGlyph> drawn;
    std::int64_t texels = 0;
    for (const auto& [face, glyph] : glyphs_) {
        Result<DrawnGlyph> one = painter->draw(face, glyph);
        if (!one) {
            return tl::unexpected<Error>(one.error());
        }
        texels += static_cast<std::int64_t>(one->distances.texels.size());
        if (texels > most_atlas_texels / 2) {
            return too_many();
        }
        drawn.push_back(*std::move(one));
    }
    GlyphSheet sheet;
    sheet.runs.texels_per_em = static_cast<std::uint16_t>(options_.texels_per_em);
    sheet.runs.spread_texels = static_cast<std::uint16_t>(options_.spread_texels);
    place(drawn, sheet.runs);
    sheet.atlas = paint(drawn, sheet.runs);
    for (const DrawnGlyph& glyph : drawn) {
        sheet.runs.boxes.push_back(glyph.box);
    }
    sheet.runs.texts = std::move(texts_);
    return sheet;
}

} // namespace frustumscreen
