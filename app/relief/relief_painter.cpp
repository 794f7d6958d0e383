#include "app/relief/relief_painter.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace frustumscreen {

namespace {

/// The view's lit part, widened to whole tiles and cut to the picture.
PixelRectangle tiles_around(const PixelRectangle& lit, int width, int height) {
    if (lit.empty()) {
        return {};
    }
    const int x = lit.x / tile_width * tile_width;
    const int y = lit.y / tile_height * tile_height;
    const int right = (lit.x + lit.width + tile_width - 1) / tile_width * tile_width;
    const int bottom = (lit.y + lit.height + tile_height - 1) / tile_height * tile_height;
    return intersected({x, y, right - x, bottom - y}, {0, 0, width, height});
}

/// The face that a pixel lights: the one whose nearest edge is farthest away.
const CastFace& face_at(const CastView& view, const glm::dvec3& pixel) {
    const auto depth = [&pixel](const CastFace& face) {
        double least = std::numeric_limits<double>::infinity();
        for (const glm::dvec3& edge : face.edges) {
            least = std::min(least, glm::dot(edge, pixel));
        }
        return least;
    };
    return *std::max_element(view.faces.begin(), view.faces.end(),
                             [&](const CastFace& a, const CastFace& b) { return depth(a) < depth(b); });
}

} // namespace

ReliefPainter::ReliefPainter(int threads) : workers_(threads) {}

void ReliefPainter::cast_picture(const BlockRelief& relief, const CastView& view, int width, int height) {
    if (cast_.columns != (width + tile_width - 1) / tile_width ||
        cast_.rows != (height + tile_height - 1) / tile_height) {
        cast_.resize(width, height);
    }
    begin_list(items_, relief, view);
    workers_.share(static_cast<int>(items_.parts.size()),
                   [&](int k) { list_part(items_, relief, view, static_cast<std::size_t>(k)); });
    end_list(items_);
    first_row_ = view.lit.y / tile_height;
    end_row_ = std::min((view.lit.y + view.lit.height + tile_height - 1) / tile_height, cast_.rows);
}

int ReliefPainter::bands() const {
    return (end_row_ + rows_of_band - 1) / rows_of_band - first_row_ / rows_of_band;
}

TileBand ReliefPainter::band(int k) const {
    const int first = (first_row_ / rows_of_band + k) * rows_of_band;
    return {std::max(first, first_row_), std::min(first + rows_of_band, end_row_)};
}

void ReliefPainter::shade(const BlockRelief& relief, const TileBand& band) {
    const PixelRectangle& lit = codes_.lit();
    const int bottom = std::min(band.end * tile_height, lit.y + lit.height);
    for (int y = band.first * tile_height; y < bottom; ++y) {
        glm::u8vec4* const row = codes_.row(y);
        LitCodes::Extent& extent = codes_.extent(y);
        for (int x = 0; x < lit.width; ++x) {
            const std::size_t at = cast_.at(lit.x + x, y);
            if (cast_.t[at] < std::numeric_limits<float>::infinity()) {
                row[x] = colour_at(relief, cast_.block[at], cast_.place[at]);
                extent = {std::min(extent.first, x), x + 1};
            }
        }
    }
}

void ReliefPainter::copy(const TileBand& band, const PictureSpan<glm::u8vec4>& picture) {
    const PixelRectangle& lit = codes_.lit();
    const int bottom = std::min(band.end * tile_height, lit.y + lit.height);
    for (int y = band.first * tile_height; y < bottom; ++y) {
        std::copy_n(codes_.row(y), lit.width, &picture.at(lit.x, y));
    }
}

PixelRectangle ReliefPainter::paint(const BlockRelief& relief, const CastView& view, int samples,
                                    const PictureSpan<glm::u8vec4>& picture) {
    assert(samples == 1 || samples == 2 || samples == 4 || samples == 8 || samples == 16);
    const PixelRectangle lit = tiles_around(view.lit, picture.width, picture.height);
    if (lit.empty()) {
        return {};
    }
    cast_picture(relief, view, picture.width, picture.height);
    codes_.begin(lit);
    workers_.share(bands(), [&](int k) {
        cast(cast_, relief, view, items_, band(k));
        shade(relief, band(k));
    });
    fine_.resize(std::max(fine_.size(), static_cast<std::size_t>(bands())));
    workers_.share(bands(), [&](int k) {
        copy(band(k), picture);
        if (samples > 1) {
            FineBand& fine = fine_[static_cast<std::size_t>(k)];
            fine.gather(codes_, band(k), samples);
            cast(fine.rays(), relief, view, items_);
            fine.resolve(relief, light_, samples, picture);
        }
    });
    return lit;
}

void ReliefPainter::hit_points(const BlockRelief& relief, const CastView& view,
                               const PictureSpan<glm::vec3>& points) {
    for (int y = 0; y < points.height; ++y) {
        std::fill_n(&points.at(0, y), points.width, glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    }
    const PixelRectangle lit = tiles_around(view.lit, points.width, points.height);
    if (lit.empty()) {
        return;
    }
    cast_picture(relief, view, points.width, points.height);
    cast(cast_, relief, view, items_, {first_row_, end_row_});
    for (int y = lit.y; y < lit.y + lit.height; ++y) {
        for (int x = lit.x; x < lit.x + lit.width; ++x) {
            const std::size_t at = cast_.at(x, y);
            if (std::isfinite(cast_.t[at])) {
                const glm::dvec3 pixel(x + 0.5, y + 0.5, 1.0);
                points.at(x, y) = glm::vec3(view.eye_box + static_cast<double>(cast_.t[at]) *
                                                               (face_at(view, pixel).direction * pixel));
            }
        }
    }
}

} // namespace frustumscreen
