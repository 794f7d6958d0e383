#include "app/relief/relief_painter.h"

#include "app/relief/resolve_row.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace frustumscreen::relief {

namespace {

/// The painted area is returned in strips, which enclose less of the surroundings than one rectangle would.
constexpr int strips_of_band = 4;
constexpr int rows_of_strip = rows_of_band / strips_of_band;

/// Number of bands of `rows_of_band` rows, counted from the first that meets `lit`.
int bands_of(const PixelRectangle& lit) {
    return (lit.y + lit.height + rows_of_band - 1) / rows_of_band - lit.y / rows_of_band;
}

PixelRectangle band_of(const PixelRectangle& lit, int k) {
    return intersected(lit, {.x = lit.x,
                             .y = (lit.y / rows_of_band + k) * rows_of_band,
                             .width = lit.width,
                             .height = rows_of_band});
}

/// The pixel of the ideal pinhole, as (x, y, 1), that the lens maps to the centre of a projector pixel.
glm::dvec3 ideal_pixel(const geometry::Pinhole& projector, int x, int y) {
    const glm::dvec3 ray = projector.ray({x + 0.5, y + 0.5});
    return {projector.fx * ray.x + projector.cx, projector.fy * ray.y + projector.cy, 1.0};
}

/// The face that an ideal pixel lights: the one whose nearest edge is farthest away.
const RasterFace& face_at(const RasterView& view, const glm::dvec3& pixel) {
    const auto depth = [&pixel](const RasterFace& face) {
        double least = std::numeric_limits<double>::infinity();
        for (const glm::dvec3& edge : face.edges) {
            least = std::min(least, glm::dot(edge, pixel));
        }
        return least;
    };
    return *std::max_element(view.faces.begin(), view.faces.end(),
                             [&](const RasterFace& a, const RasterFace& b) { return depth(a) < depth(b); });
}

} // namespace

ReliefPainter::ReliefPainter(int threads) : samples_(static_cast<std::size_t>(threads)), workers_(threads) {}

void ReliefPainter::list(const BlockRelief& relief, const RasterView& view) {
    begin_list(items_, relief, view);
    workers_.share(static_cast<int>(items_.parts.size()),
                   [&](int k, int) { list_part(items_, relief, view, static_cast<std::size_t>(k)); });
    end_list(items_);
}

PixelRectangle ReliefPainter::lit_part(const RasterSamples& samples, int top, int bottom) {
    const PixelRectangle& pixels = samples.pixels();
    PixelRectangle part;
    for (int y = std::max(top, pixels.y); y < std::min(bottom, pixels.y + pixels.height); ++y) {
        const RasterSamples::Extent& extent = samples.extent(y);
        part = united(part, {.x = extent.first, .y = y, .width = extent.end - extent.first, .height = 1});
    }
    return part;
}

void ReliefPainter::resolve(const RasterSamples& samples, const BlockRelief& relief,
                            const PixelRectangle& part, const PictureSpan<glm::u8vec4>& picture,
                            const RowLight* light) const {
    for (int y = part.y; y < part.y + part.height; ++y) {
        glm::u8vec4* const row = &picture.at(0, y);
        std::fill_n(row + part.x, part.width, glm::u8vec4(0));
        const RasterSamples::Extent& extent = samples.extent(y);
        if (extent.first >= extent.end) {
            continue;
        }
        const std::span<glm::u8vec4> codes(row + extent.first, row + extent.end);
        resolve_row(samples, relief, light_, y, extent.first, codes);
        if (light != nullptr) {
            light->light(y, extent.first, codes);
        }
    }
}

std::span<const PixelRectangle> ReliefPainter::paint(const BlockRelief& relief, const RasterView& view,
                                                     int samples, const PictureSpan<glm::u8vec4>& picture,
                                                     const RowLight* light) {
    assert(samples == 1 || samples == 2 || samples == 4 || samples == 8 || samples == 16);
    painted_.clear();
    if (view.lit.empty()) {
        return {};
    }
    list(relief, view);
    for (RasterSamples& each : samples_) { // any thread may get the widest band
        each.make_space(view.lit.width, rows_of_band, samples);
    }
    const int bands = bands_of(view.lit);
    painted_.resize(static_cast<std::size_t>(bands) * strips_of_band);
    workers_.share(bands, [&](int k, int worker) {
        RasterSamples& band = samples_[static_cast<std::size_t>(worker)];
        const PixelRectangle rows = band_of(view.lit, k);
        band.begin(rows, samples);
        rasterize(band, relief, view, items_);
        for (int strip = 0; strip < strips_of_band; ++strip) {
            const int top = (rows.y / rows_of_band * strips_of_band + strip) * rows_of_strip;
            const PixelRectangle part = lit_part(band, top, top + rows_of_strip);
            painted_[static_cast<std::size_t>(k) * strips_of_band + static_cast<std::size_t>(strip)] = part;
            resolve(band, relief, part, picture, light);
        }
    });
    std::erase_if(painted_, [](const PixelRectangle& part) { return part.empty(); });
    return painted_;
}

void ReliefPainter::hit_points(const BlockRelief& relief, const RasterView& view,
                               const PictureSpan<glm::vec3>& points) {
    for (int y = 0; y < points.height; ++y) {
        std::fill_n(&points.at(0, y), points.width, glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    }
    const PixelRectangle& lit = view.lit;
    if (lit.empty()) {
        return;
    }
    list(relief, view);
    RasterSamples& centres = samples_[0];
    centres.begin(lit, 1);
    rasterize(centres, relief, view, items_);
    for (int y = lit.y; y < lit.y + lit.height; ++y) {
        for (int x = lit.x; x < lit.x + lit.width; ++x) {
            const auto nearness = static_cast<double>(centres.nearness[centres.at(x, y)]);
            if (nearness > 0.0) {
                const glm::dvec3 pixel = ideal_pixel(view.projector, x, y);
                points.at(x, y) = glm::vec3(view.eye_box + face_at(view, pixel).direction * pixel / nearness);
            }
        }
    }
}

} // namespace frustumscreen::relief
