#include "app/relief/relief_painter.h"

#include "app/relief/rasterize_nearness.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>

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

float nearest_of(const BlockItems& items) {
    float nearest = 0.0F;
    for (const BlockItem& item : items.sorted) {
        nearest = std::max(nearest, item.nearest);
    }
    return nearest;
}

} // namespace

PixelRectangle depth_part(const PixelRectangle& painted, std::span<const PixelRectangle> parts) {
    PixelRectangle around;
    for (const PixelRectangle& part : parts) {
        around = united(around, intersected(painted, part));
    }
    return around.empty()
               ? around
               : PixelRectangle{
                     .x = around.x, .y = painted.y, .width = around.width, .height = painted.height};
}

ReliefPainter::ReliefPainter(int threads) : samples_(static_cast<std::size_t>(threads)), workers_(threads) {}

void ReliefPainter::list(std::span<const SeenRelief> reliefs) {
    count_ = reliefs.size();
    listed_.resize(std::max(listed_.size(), count_));
    pages_.clear();
    layer_pages_.clear();
    for (std::size_t k = 0; k < count_; ++k) {
        Listed& listed = listed_[k];
        listed.seen = reliefs[k];
        listed.share = {pages_.add(*reliefs[k].relief, reliefs[k].light), reliefs[k].dither};
        layer_pages_.add(*reliefs[k].relief, glm::vec3(1.0F), reliefs[k].layer);
        begin_list(listed.items, *reliefs[k].relief, *reliefs[k].view, reliefs[k].facing);
    }
    list_blocks_of_all();
    order_.resize(count_);
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    if (count_ > 1) { // the nearest first, so that they hide blocks of the others
        for (std::size_t k = 0; k < count_; ++k) {
            listed_[k].nearest = nearest_of(listed_[k].items);
        }
        std::sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
            return listed_[a].nearest != listed_[b].nearest ? listed_[a].nearest > listed_[b].nearest : a < b;
        });
    }
}

void ReliefPainter::list_blocks_of_all() {
    std::size_t parts = 0;
    for (std::size_t k = 0; k < count_; ++k) {
        parts += listed_[k].items.parts.size();
    }
    workers_.share(static_cast<int>(parts), [&](int k, int) {
        auto part = static_cast<std::size_t>(k);
        std::size_t of = 0;
        for (; part >= listed_[of].items.parts.size(); ++of) {
            part -= listed_[of].items.parts.size();
        }
        Listed& listed = listed_[of];
        list_part(listed.items, *listed.seen.relief, *listed.seen.view, part);
    });
    workers_.share(static_cast<int>(count_),
                   [&](int k, int) { end_list(listed_[static_cast<std::size_t>(k)].items); });
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

void ReliefPainter::resolve_columns(const RasterSamples& samples, int y, const RasterSamples::Extent& columns,
                                    Outline outline, const Picture& picture) const {
    if (columns.first >= columns.end) {
        return;
    }
    glm::u8vec4* const row = &picture.codes.at(0, y);
    const std::span<glm::u8vec4> codes(row + columns.first, row + columns.end);
    resolve_row(samples, pages_, light_, y, columns.first, codes, outline);
    if (picture.light != nullptr) {
        picture.light->light(y, columns.first, codes);
    }
}

void ReliefPainter::resolve(const RasterSamples& samples, const PixelRectangle& part,
                            const Picture& picture) const {
    const DepthPicture& depth = picture.depth;
    const PixelRectangle deep = depth_part(part, depth.parts);
    const PixelRectangle overlaid = depth_part(part, depth.overlaid);
    for (int y = overlaid.y; !overlaid.empty() && y < overlaid.y + overlaid.height; ++y) {
        const auto width = static_cast<std::size_t>(overlaid.width);
        nearness_row(samples, nearness_, y, overlaid.x, {&depth.nearness.at(overlaid.x, y), width});
        if (depth.layer.first != nullptr) {
            resolve_row(samples, layer_pages_, light_, y, overlaid.x, {&depth.layer.at(overlaid.x, y), width},
                        Outline::Coverage);
        }
    }
    for (int y = part.y; y < part.y + part.height; ++y) {
        std::fill_n(&picture.codes.at(part.x, y), part.width, glm::u8vec4(0));
        const RasterSamples::Extent& extent = samples.extent(y);
        if (deep.empty()) {
            resolve_columns(samples, y, extent, Outline::OverBlack, picture);
            continue;
        }
        const int left = std::clamp(deep.x, extent.first, std::max(extent.first, extent.end));
        const int right = std::clamp(deep.x + deep.width, left, std::max(left, extent.end));
        resolve_columns(samples, y, {extent.first, left}, Outline::OverBlack, picture);
        resolve_columns(samples, y, {left, right}, Outline::Coverage, picture);
        resolve_columns(samples, y, {right, extent.end}, Outline::OverBlack, picture);
        const std::span<float> nearness(&picture.depth.nearness.at(deep.x, y),
                                        static_cast<std::size_t>(deep.width));
        nearness_row(samples, nearness_, y, deep.x, nearness);
    }
}

std::span<const PixelRectangle> ReliefPainter::paint(std::span<const SeenRelief> reliefs, int samples,
                                                     const PictureSpan<glm::u8vec4>& picture,
                                                     const RowLight* light, const DepthPicture& depth) {
    assert(samples == 1 || samples == 2 || samples == 4 || samples == 8 || samples == 16);
    painted_.clear();
    PixelRectangle lit;
    for (const SeenRelief& seen : reliefs) {
        lit = united(lit, seen.view->lit);
    }
    if (lit.empty()) {
        return {};
    }
    list(reliefs);
    if (!depth.parts.empty() || !depth.overlaid.empty()) {
        nearness_.begin(*reliefs[0].view);
        for (const SeenRelief& seen : reliefs.subspan(1)) {
            nearness_.add(*seen.view);
        }
    }
    for (RasterSamples& each : samples_) { // any thread may get the widest band
        each.make_space(lit.width, rows_of_band, samples);
    }
    const int bands = bands_of(lit);
    painted_.resize(static_cast<std::size_t>(bands) * strips_of_band);
    workers_.share(bands, [&](int k, int worker) {
        RasterSamples& band = samples_[static_cast<std::size_t>(worker)];
        const PixelRectangle rows = band_of(lit, k);
        band.begin(rows, samples);
        for (const std::size_t of : order_) {
            const Listed& listed = listed_[of];
            rasterize(band, *listed.seen.relief, *listed.seen.view, listed.items, listed.share);
        }
        for (int strip = 0; strip < strips_of_band; ++strip) {
            const int top = (rows.y / rows_of_band * strips_of_band + strip) * rows_of_strip;
            const PixelRectangle part = lit_part(band, top, top + rows_of_strip);
            painted_[static_cast<std::size_t>(k) * strips_of_band + static_cast<std::size_t>(strip)] = part;
            resolve(band, part, {picture, light, depth});
        }
    });
    std::erase_if(painted_, [](const PixelRectangle& part) { return part.empty(); });
    return painted_;
}

void ReliefPainter::paint_nearness(std::span<const SeenRelief> reliefs, const TileMask& asked,
                                   const PictureSpan<float>& nearness) {
    const PixelRectangle part = asked.bounds();
    const auto seen = std::find_if(reliefs.begin(), reliefs.end(),
                                   [](const SeenRelief& each) { return !each.view->faces.empty(); });
    if (part.empty() || seen == reliefs.end()) {
        return;
    }
    list(reliefs);
    const glm::vec3 slant(seen->view->faces[0].slant);
    workers_.share(bands_of(part), [&](int k, int) {
        const int band = part.y / rows_of_band + k;
        for (std::size_t of : order_) {
            const Listed& listed = listed_[of];
            rasterize_nearness(nearness, asked, band, *listed.seen.relief, *listed.seen.view, listed.items);
        }
        divide_by_slant(nearness, asked, band, slant);
    });
}

void ReliefPainter::hit_points(const SeenRelief& seen, const PictureSpan<glm::vec3>& points) {
    for (int y = 0; y < points.height; ++y) {
        std::fill_n(&points.at(0, y), points.width, glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    }
    const RasterView& view = *seen.view;
    const PixelRectangle& lit = view.lit;
    if (lit.empty()) {
        return;
    }
    list(std::span(&seen, 1));
    RasterSamples& centres = samples_[0];
    centres.begin(lit, 1);
    rasterize(centres, *seen.relief, view, listed_[0].items, listed_[0].share);
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
