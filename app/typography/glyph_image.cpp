#include "app/typography/glyph_image.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace frustumscreen::typography {

namespace {

constexpr int samples = 4; ///< per pixel, along each axis
constexpr int max_side_px = 16384;
constexpr std::int64_t max_pixels = 1 << 24;

/// Area of a placed glyph's texels, in pixels from the top left of the setting's box.
struct GlyphArea {
    const pack::GlyphBox* box = nullptr;
    double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
};

struct Scale {
    double px_of_unit = 0.0;
    double px_of_texel = 0.0;
};

GlyphArea area_of(const pack::GlyphBox& box, const pack::PlacedGlyph& glyph, std::int32_t baseline,
                  const Scale& scale) {
    const double left = glyph.x * scale.px_of_unit + box.left * scale.px_of_texel;
    const double top = (baseline - glyph.up) * scale.px_of_unit - box.top * scale.px_of_texel;
    return {.box = &box,
            .left = left,
            .top = top,
            .right = left + box.width * scale.px_of_texel,
            .bottom = top + box.height * scale.px_of_texel};
}

/// The code at texel coordinates (texel centres at 0.5) of a box, clamped to its outermost texel centres.
double distance_code(const pack::DistanceAtlas& atlas, const pack::GlyphBox& box, double x, double y) {
    const double u = std::clamp(x - 0.5, 0.0, box.width - 1.0);
    const double v = std::clamp(y - 0.5, 0.0, box.height - 1.0);
    const int left = static_cast<int>(u);
    const int top = static_cast<int>(v);
    const int right = std::min(left + 1, box.width - 1);
    const int bottom = std::min(top + 1, box.height - 1);
    const double along = u - left;
    const double down = v - top;
    const auto code = [&](int column, int row) {
        return static_cast<double>(atlas.at(box.x + column, box.y + row));
    };
    const double upper = code(left, top) + (code(right, top) - code(left, top)) * along;
    const double lower = code(left, bottom) + (code(right, bottom) - code(left, bottom)) * along;
    return upper + (lower - upper) * down;
}

/// The samples of some rows of pixels.
struct SampleRows {
    int first_row = 0; ///< pixel row of the picture
    image::Image<std::uint8_t> samples;
};

/// `samples_of_code`: distance in samples for a change of one code.
void draw(const pack::DistanceAtlas& atlas, const GlyphArea& area, const GlyphImage& image,
          double px_of_texel, double samples_of_code, SampleRows& rows) {
    const double left = (area.left + image.left_px) * samples;
    const double top = (area.top + image.top_px - rows.first_row) * samples;
    const double texels_of_sample = 1.0 / (samples * px_of_texel);
    const int x_end =
        std::min(rows.samples.width, static_cast<int>(std::ceil((area.right + image.left_px) * samples)));
    const int y_end =
        std::min(rows.samples.height,
                 static_cast<int>(std::ceil((area.bottom + image.top_px - rows.first_row) * samples)));
    for (int y = std::max(0, static_cast<int>(top)); y < y_end; ++y) {
        for (int x = std::max(0, static_cast<int>(left)); x < x_end; ++x) {
            const double code = distance_code(atlas, *area.box, (x + 0.5 - left) * texels_of_sample,
                                              (y + 0.5 - top) * texels_of_sample);
            const double cover = std::clamp(0.5 + (code - pack::outline_code) * samples_of_code, 0.0, 1.0);
            std::uint8_t& sample = rows.samples.at(x, y);
            sample = std::max(sample, static_cast<std::uint8_t>(std::lround(255.0 * cover)));
        }
    }
}

void average_into(image::Image<std::uint8_t>& image, const SampleRows& rows) {
    for (int y = 0; y < rows.samples.height / samples; ++y) {
        for (int x = 0; x < image.width; ++x) {
            int sum = 0;
            for (int down = 0; down < samples; ++down) {
                const std::uint8_t* row = &rows.samples.at(x * samples, y * samples + down);
                sum = std::accumulate(row, row + samples, sum);
            }
            std::uint8_t& pixel = image.at(x, rows.first_row + y);
            const int mean = (sum + samples * samples / 2) / (samples * samples);
            pixel = std::max(pixel, static_cast<std::uint8_t>(mean));
        }
    }
}

/// The part of a glyph's area that its letter can cover: all except the spread around it.
GlyphArea ink_of(GlyphArea area, double spread_px) {
    area.left += spread_px;
    area.top += spread_px;
    area.right -= spread_px;
    area.bottom -= spread_px;
    return area;
}

/// The glyphs that are not blank, line by line.
struct Areas {
    std::vector<GlyphArea> areas;
    std::vector<std::size_t> line_ends;
};

Areas areas_of(const pack::GlyphRuns& runs, const pack::GlyphSetting& setting, const Scale& scale) {
    Areas all;
    std::size_t next = 0;
    for (const pack::GlyphLine& line : setting.lines) {
        for (std::size_t k = 0; k < line.glyphs; ++k, ++next) {
            const pack::PlacedGlyph& glyph = setting.glyphs[next];
            const pack::GlyphBox& box = runs.boxes[glyph.glyph];
            if (box.width > 0 && box.height > 0) {
                all.areas.push_back(area_of(box, glyph, line.baseline, scale));
            }
        }
        all.line_ends.push_back(all.areas.size());
    }
    return all;
}

Scale scale_of(const pack::GlyphRuns& runs, double em_px) {
    return {em_px / pack::em_units, em_px / runs.texels_per_em};
}

/// Extent of the setting's box and of all letters that extend beyond it.
GlyphExtent extent_of(const pack::GlyphSetting& setting, std::span<const GlyphArea> areas, const Scale& scale,
                      double spread_px) {
    double left = 0.0;
    double top = 0.0;
    double right = setting.width * scale.px_of_unit;
    double bottom = setting.height * scale.px_of_unit;
    for (const GlyphArea& area : areas) {
        const GlyphArea ink = ink_of(area, spread_px);
        left = std::min(left, ink.left);
        top = std::min(top, ink.top);
        right = std::max(right, ink.right);
        bottom = std::max(bottom, ink.bottom);
    }
    GlyphExtent extent;
    const double width = std::ceil(right) - std::floor(left);
    const double height = std::ceil(bottom) - std::floor(top);
    if (width <= max_side_px && height <= max_side_px && width * height <= static_cast<double>(max_pixels)) {
        extent = {.width_px = static_cast<int>(width),
                  .height_px = static_cast<int>(height),
                  .left_px = -static_cast<int>(std::floor(left)),
                  .top_px = -static_cast<int>(std::floor(top))};
    }
    return extent;
}

/// The rows of pixels that a line's glyphs cover.
SampleRows rows_of(std::span<const GlyphArea> line, const GlyphImage& image) {
    double top = image.coverage.height;
    double bottom = 0.0;
    for (const GlyphArea& area : line) {
        top = std::min(top, area.top + image.top_px);
        bottom = std::max(bottom, area.bottom + image.top_px);
    }
    const int first = std::max(0, static_cast<int>(std::floor(top)));
    const int end = std::min(image.coverage.height, static_cast<int>(std::ceil(bottom)));
    return {first,
            image::Image<std::uint8_t>(image.coverage.width * samples, std::max(0, end - first) * samples)};
}

} // namespace

GlyphExtent glyph_extent(const pack::GlyphRuns& runs, const pack::GlyphSetting& setting, double em_px) {
    const Scale scale = scale_of(runs, em_px);
    return extent_of(setting, areas_of(runs, setting, scale).areas, scale,
                     runs.spread_texels * scale.px_of_texel);
}

GlyphImage glyph_image(const pack::GlyphRuns& runs, const pack::DistanceAtlas& atlas,
                       const pack::GlyphSetting& setting, double em_px) {
    const Scale scale = scale_of(runs, em_px);
    const auto [areas, line_ends] = areas_of(runs, setting, scale);
    const GlyphExtent extent = extent_of(setting, areas, scale, runs.spread_texels * scale.px_of_texel);
    GlyphImage image{{}, extent.left_px, extent.top_px};
    if (extent.width_px == 0 || extent.height_px == 0) {
        return image;
    }
    image.coverage = image::Image<std::uint8_t>(extent.width_px, extent.height_px);
    const double samples_of_code = scale.px_of_texel * samples * runs.spread_texels / pack::outline_code;
    std::size_t begin = 0;
    for (const std::size_t end : line_ends) {
        const std::span<const GlyphArea> line = std::span(areas).subspan(begin, end - begin);
        begin = end;
        SampleRows rows = rows_of(line, image);
        for (const GlyphArea& area : line) {
            draw(atlas, area, image, scale.px_of_texel, samples_of_code, rows);
        }
        average_into(image.coverage, rows);
    }
    return image;
}

} // namespace frustumscreen::typography
