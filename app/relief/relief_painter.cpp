#include "app/relief/relief_painter.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace frustumscreen {

namespace {

/// Bands of `rows_of_band` rows, counted from the first that meets `lit`.
int bands_of(const PixelRectangle& lit) {
    return (lit.y + lit.height + rows_of_band - 1) / rows_of_band - lit.y / rows_of_band;
}

PixelRectangle band_of(const PixelRectangle& lit, int k) {
    return intersected(lit, {lit.x, (lit.y / rows_of_band + k) * rows_of_band, lit.width, rows_of_band});
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

ReliefPainter::ReliefPainter(int threads) : samples_(static_cast<std::size_t>(threads)), workers_(threads) {}

void ReliefPainter::list(const BlockRelief& relief, const CastView& view) {
    begin_list(items_, relief, view);
    workers_.share(static_cast<int>(items_.parts.size()),
                   [&](int k, int) { list_part(items_, relief, view, static_cast<std::size_t>(k)); });
    end_list(items_);
}

glm::u8vec4 ReliefPainter::code_at(const CastSamples& samples, std::size_t first,
                                   const BlockRelief& relief) const {
    const std::size_t count = samples.places().size();
    const std::uint32_t block = samples.block[first];
    if (count == 1) {
        return colour_at(relief, block, samples.place[first]);
    }
    glm::uvec2 low(std::numeric_limits<unsigned>::max());
    glm::uvec2 high(0);
    glm::uvec2 sum(0);
    std::size_t together = 0;
    for (std::size_t k = first; k < first + count; ++k) {
        const glm::uvec2 place(samples.place[k] & 0xFFFFU, samples.place[k] >> 16U);
        together += samples.nearness[k] > 0.0F && samples.block[k] == block ? 1 : 0;
        low = glm::min(low, place);
        high = glm::max(high, place);
        sum += place;
    }
    // Within a cell the codes are nearly even: their mean is the one in the middle.
    const glm::uvec2 spread = high - low;
    if (together == count && std::max(spread.x, spread.y) < CastSamples::places_per_cell) {
        const auto middle = sum / static_cast<unsigned>(count);
        return colour_at(relief, block, middle.x | middle.y << 16U);
    }
    glm::uvec3 light(0);
    bool met = false;
    for (std::size_t k = first; k < first + count; ++k) {
        if (samples.nearness[k] > 0.0F) {
            light += light_.light(colour_at(relief, samples.block[k], samples.place[k]));
            met = true;
        }
    }
    return met ? light_.mean(light, static_cast<unsigned>(count)) : glm::u8vec4(0);
}

void ReliefPainter::resolve(const CastSamples& samples, const BlockRelief& relief,
                            const PictureSpan<glm::u8vec4>& picture) const {
    const PixelRectangle& pixels = samples.pixels();
    const std::size_t count = samples.places().size();
    for (int y = pixels.y; y < pixels.y + pixels.height; ++y) {
        std::fill_n(&picture.at(pixels.x, y), pixels.width, glm::u8vec4(0));
        const CastSamples::Extent& extent = samples.extent(y);
        for (int x = extent.first; x < extent.end; ++x) {
            const float* const nearness = &samples.nearness[samples.at(x, y)];
            if (std::any_of(nearness, nearness + count, [](float met) { return met > 0.0F; })) {
                picture.at(x, y) = code_at(samples, samples.at(x, y), relief);
            }
        }
    }
}

PixelRectangle ReliefPainter::paint(const BlockRelief& relief, const CastView& view, int samples,
                                    const PictureSpan<glm::u8vec4>& picture) {
    assert(samples == 1 || samples == 2 || samples == 4 || samples == 8 || samples == 16);
    if (view.lit.empty()) {
        return {};
    }
    list(relief, view);
    for (CastSamples& each : samples_) { // which thread gets the widest band is chance
        each.make_room(view.lit.width, rows_of_band, samples);
    }
    workers_.share(bands_of(view.lit), [&](int k, int worker) {
        CastSamples& band = samples_[static_cast<std::size_t>(worker)];
        band.begin(band_of(view.lit, k), samples);
        cast(band, relief, view, items_);
        resolve(band, relief, picture);
    });
    return view.lit;
}

void ReliefPainter::hit_points(const BlockRelief& relief, const CastView& view,
                               const PictureSpan<glm::vec3>& points) {
    for (int y = 0; y < points.height; ++y) {
        std::fill_n(&points.at(0, y), points.width, glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    }
    const PixelRectangle& lit = view.lit;
    if (lit.empty()) {
        return;
    }
    list(relief, view);
    CastSamples& centres = samples_[0];
    centres.begin(lit, 1);
    cast(centres, relief, view, items_);
    for (int y = lit.y; y < lit.y + lit.height; ++y) {
        for (int x = lit.x; x < lit.x + lit.width; ++x) {
            const auto nearness = static_cast<double>(centres.nearness[centres.at(x, y)]);
            if (nearness > 0.0) {
                const glm::dvec3 pixel(x + 0.5, y + 0.5, 1.0);
                points.at(x, y) = glm::vec3(view.eye_box + face_at(view, pixel).direction * pixel / nearness);
            }
        }
    }
}

} // namespace frustumscreen
