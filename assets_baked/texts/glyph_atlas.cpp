#include "assets_baked/texts/glyph_atlas.h"

#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

namespace frustumscreen::texts {

namespace {

struct CloseLibrary {
    void operator()(FT_Library library) const { FT_Done_FreeType(library); }
};
struct CloseFace {
    void operator()(FT_Face face) const { FT_Done_Face(face); }
};

/// A glyph's own picture of distances, and its box without a position in the atlas.
struct DrawnGlyph {
    pack::GlyphBox box;
    pack::DistanceAtlas distances;
};

/// Letters are rendered larger than stored by this factor.
constexpr int oversampling = 8;

int floor_div(int a, int b) {
    return a >= 0 ? a / b : -((-a + b - 1) / b);
}

/// A letter as pixels inside or outside; everything around it is outside.
class LetterMask {
public:
    explicit LetterMask(const FT_GlyphSlotRec_& slot)
        : left_(slot.bitmap_left), top_(slot.bitmap_top),
          inside_(static_cast<int>(slot.bitmap.width), static_cast<int>(slot.bitmap.rows)) {
        for (int y = 0; y < inside_.height; ++y) {
            for (int x = 0; x < inside_.width; ++x) {
                inside_.at(x, y) =
                    slot.bitmap.buffer[static_cast<std::ptrdiff_t>(y) * slot.bitmap.pitch + x] >= 128 ? 1 : 0;
            }
        }
    }
    [[nodiscard]] int left() const { return left_; }
    [[nodiscard]] int top() const { return top_; }
    [[nodiscard]] int right() const { return left_ + inside_.width; }
    [[nodiscard]] int bottom() const { return top_ - inside_.height; }
    /// x to the right and y down, from the mask's top left.
    [[nodiscard]] bool inside(int x, int y) const {
        return x >= 0 && y >= 0 && x < inside_.width && y < inside_.height && inside_.at(x, y) != 0;
    }

private:
    int left_ = 0, top_ = 0;
    image::Image<std::uint8_t> inside_;
};

/// Signed distances from the centres of pixels to the letter's edge, up to a reach. First along columns, then
/// across them (Rosenfeld and Pfaltz, Sequential Operations in Digital Picture Processing, 1966; exact for
/// squared distances).
class EdgeDistances {
public:
    EdgeDistances(const LetterMask& mask, int reach) : mask_(mask), reach_(reach) {
        first_ = -reach;
        width_ = mask.right() - mask.left() + 2 * reach;
        height_ = mask.top() - mask.bottom() + 2 * reach;
        along_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
        for (int x = 0; x < width_; ++x) {
            scan(x, 0, 1);
            scan(x, height_ - 1, -1);
        }
    }
    /// Positive inside; x and y as in the mask, up to `reach` outside it.
    [[nodiscard]] double at(int x, int y) const {
        const bool inside = mask_.inside(x, y);
        int nearest = reach_ * reach_;
        for (int across = -reach_; across <= reach_; ++across) {
            const int column = x + across - first_;
            if (column < 0 || column >= width_) {
                nearest = inside ? std::min(nearest, across * across) : nearest;
                continue;
            }
            // The nearest pixel of the other kind in that column: possibly the direct neighbour.
            const int down = mask_.inside(x + across, y) != inside ? 0 : along(column, y - first_);
            nearest = std::min(nearest, across * across + down * down);
        }
        const double distance =
            std::sqrt(static_cast<double>(nearest)) - 0.5; // the edge lies between two pixels
        return inside ? distance : -distance;
    }

private:
    [[nodiscard]] int along(int column, int row) const {
        return along_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                      static_cast<std::size_t>(column)];
    }
    /// Distance along the column to a pixel of the other kind, in one direction.
    void scan(int column, int row, int step) {
        int far = reach_;
        bool before = false;
        for (bool begun = false; row >= 0 && row < height_; row += step, begun = true) {
            const bool inside = mask_.inside(column + first_, row + first_);
            far = begun && inside != before ? 1 : std::min(reach_, far + 1);
            before = inside;
            int& cell = along_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                               static_cast<std::size_t>(column)];
            cell = cell == 0 ? far : std::min(cell, far);
        }
    }

    const LetterMask& mask_;
    int reach_ = 0, first_ = 0, width_ = 0, height_ = 0;
    std::vector<int> along_;
};

std::uint8_t code_of(double distance_texels, int spread_texels) {
    const double code = pack::outline_code + distance_texels / spread_texels * pack::outline_code;
    return static_cast<std::uint8_t>(std::lround(std::clamp(code, 0.0, 255.0)));
}

/// The distances at the centres of the atlas's texels, whose grid begins at the pen.
DrawnGlyph sampled(const LetterMask& mask, int spread_texels) {
    const int reach = (spread_texels + 1) * oversampling;
    const EdgeDistances edge(mask, reach);
    const int left = floor_div(mask.left(), oversampling) - spread_texels;
    const int right = -floor_div(-mask.right(), oversampling) + spread_texels;
    const int top = -floor_div(-mask.top(), oversampling) + spread_texels;
    const int bottom = floor_div(mask.bottom(), oversampling) - spread_texels;
    DrawnGlyph drawn;
    drawn.distances = pack::DistanceAtlas(right - left, top - bottom);
    for (int row = 0; row < drawn.distances.height; ++row) {
        for (int column = 0; column < drawn.distances.width; ++column) {
            // The centre of a texel is a corner of four pixels.
            const int x = (left + column) * oversampling + oversampling / 2 - mask.left();
            const int y = mask.top() - (top - row) * oversampling + oversampling / 2;
            const double sum = edge.at(x - 1, y - 1) + edge.at(x, y - 1) + edge.at(x - 1, y) + edge.at(x, y);
            drawn.distances.at(column, row) = code_of(sum / 4.0 / oversampling, spread_texels);
        }
    }
    drawn.box.width = static_cast<std::uint16_t>(drawn.distances.width);
    drawn.box.height = static_cast<std::uint16_t>(drawn.distances.height);
    drawn.box.left = static_cast<std::int16_t>(left);
    drawn.box.top = static_cast<std::int16_t>(top);
    return drawn;
}

class GlyphPainter {
public:
    static Result<GlyphPainter> open(const GlyphAtlasOptions& options) {
        GlyphPainter painter;
        FT_Library library = nullptr;
        if (FT_Init_FreeType(&library) != 0) {
            return fail(ErrorKind::Internal, "typeface.freetype", "typefaces: FreeType cannot start");
        }
        painter.library_.reset(library);
        painter.texels_per_em_ = options.texels_per_em;
        painter.spread_texels_ = options.spread_texels;
        return painter;
    }

    Result<DrawnGlyph> draw(const FontFace& from, std::uint32_t glyph) {
        const FT_Face face = face_of(from);
        if (face == nullptr || FT_Load_Glyph(face, glyph, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP) != 0) {
            return bad_input("typeface.glyph_unreadable",
                             "{}: glyph {} of this typeface cannot be read; install its package again",
                             from.file.string(), glyph);
        }
        if (face->glyph->outline.n_contours == 0) {
            return DrawnGlyph();
        }
        // FreeType 2.12 can render distances itself, but the result is wrong where a letter's strokes overlap
        // or lie inside each other, or it takes a hundred times as long.
        if (FT_Render_Glyph(face->glyph, FT_RENDER_MODE_NORMAL) != 0) {
            return bad_input("typeface.glyph_not_drawn", "{}: glyph {} of this typeface cannot be drawn",
                             from.file.string(), glyph);
        }
        return sampled(LetterMask(*face->glyph), spread_texels_);
    }

private:
    FT_Face face_of(const FontFace& from) {
        const auto known = faces_.find(from);
        if (known != faces_.end()) {
            return known->second.get();
        }
        FT_Face face = nullptr;
        if (FT_New_Face(library_.get(), from.file.c_str(), from.index, &face) != 0 ||
            FT_Set_Char_Size(face, 0, texels_per_em_ * oversampling * 64, 72, 72) != 0) {
            return nullptr;
        }
        return faces_.emplace(from, face).first->second.get();
    }

    std::unique_ptr<FT_LibraryRec_, CloseLibrary> library_; ///< outlives the faces
    std::map<FontFace, std::unique_ptr<FT_FaceRec_, CloseFace>> faces_;
    int texels_per_em_ = 0;
    int spread_texels_ = 0;
};

/// Packs the glyphs: shelves, the tallest glyphs first.
void place(std::vector<DrawnGlyph>& glyphs, pack::GlyphRuns& runs) {
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
        pack::GlyphBox& box = glyphs[k].box;
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

pack::DistanceAtlas paint(const std::vector<DrawnGlyph>& glyphs, const pack::GlyphRuns& runs) {
    pack::DistanceAtlas atlas(runs.atlas_width, runs.atlas_height);
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
    pack::GlyphText& added = texts_.emplace_back();
    added.key = key;
    added.direction = text.direction;
    for (const ShapedSetting& from : text.settings) {
        pack::GlyphSetting& setting = added.settings.emplace_back();
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
    using namespace pack::glyph_limits;
    const auto too_many = [&] {
        return bad_input(
            "text.too_many_letters",
            "the texts of one language need {} different letters; that is more than an atlas of {} "
            "texels holds: shorten them",
            glyphs_.size(), max_atlas_texels);
    };
    TRY(GlyphPainter painter, GlyphPainter::open(options_));
    if (glyphs_.size() > max_boxes || texts_.size() > max_texts) {
        return too_many();
    }
    std::vector<DrawnGlyph> drawn;
    std::int64_t texels = 0;
    for (const auto& [face, glyph] : glyphs_) {
        TRY(DrawnGlyph one, painter.draw(face, glyph));
        texels += static_cast<std::int64_t>(one.distances.texels.size());
        if (texels > max_atlas_texels / 2) {
            return too_many();
        }
        drawn.push_back(std::move(one));
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

} // namespace frustumscreen::texts
