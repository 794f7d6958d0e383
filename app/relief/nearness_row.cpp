#include "app/relief/nearness_row.h"

#include "app/relief/lanes.h"
#include "app/relief/lens_lanes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace frustumscreen::relief {

namespace {

/// The samples of a pixel, the nearest to its centre first.
struct Order {
    std::array<std::size_t, RasterSamples::most> samples{};
    std::size_t count = 0;

    explicit Order(std::span<const glm::vec2> places) : count(places.size()) {
        const auto off = [&](std::size_t k) { return glm::distance(places[k], glm::vec2(0.5F)); };
        std::iota(samples.begin(), samples.end(), std::size_t{0});
        std::sort(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(count),
                  [&](std::size_t a, std::size_t b) { return off(a) < off(b); });
    }
};

/// The hits of eight pixels, with their places in the picture.
struct Hits {
    Floats nearness{};
    PixelLanes at{};
};

FRUSTUMSCREEN_INLINE Hits hits_at(const RasterSamples& samples, const Order& order, int x, int y) {
    Hits hits;
    const Floats left = __builtin_convertvector(lane_numbers + x, Floats);
    for (std::size_t k = 0; k < order.count; ++k) {
        const Floats met = load(&samples.nearness[samples.at(x, y, order.samples[k])]);
        const Ints taken = (met > 0.0F) & (hits.nearness <= 0.0F);
        const glm::vec2& place = samples.places()[order.samples[k]];
        hits.nearness = taken ? met : hits.nearness;
        hits.at.x = taken ? left + place.x : hits.at.x;
        hits.at.y = taken ? all(static_cast<float>(y) + place.y) : hits.at.y;
    }
    return hits;
}

FRUSTUMSCREEN_INLINE Floats at_pixels(const glm::vec3& linear, const PixelLanes& at) {
    return linear.x * at.x + linear.y * at.y + linear.z;
}

/// The slant of the face that each pixel lights: the one whose nearest edge is farthest away.
FRUSTUMSCREEN_INLINE Floats slant_at(const NearnessView& view, const PixelLanes& at) {
    Floats slant = all(1.0F);
    Floats deepest = all(-std::numeric_limits<float>::infinity());
    for (const NearnessFace& face : view.faces) {
        Floats inside = all(std::numeric_limits<float>::infinity());
        for (const glm::vec3& edge : face.edges) {
            inside = least(inside, at_pixels(edge, at));
        }
        for (const glm::vec3& edge : face.more_edges) {
            inside = least(inside, at_pixels(edge, at));
        }
        slant = inside > deepest ? at_pixels(face.slant, at) : slant;
        deepest = most(deepest, inside);
    }
    return slant;
}

FRUSTUMSCREEN_INLINE void find_nearness(const RasterSamples& samples, const NearnessView& view, int y,
                                        int first, std::span<float> nearness) {
    const Order order(samples.places());
    for (std::size_t begin = 0; begin < nearness.size(); begin += lanes) {
        const Hits hits = hits_at(samples, order, first + static_cast<int>(begin), y);
        const PixelLanes at = view.lens.bends ? unbent(view.lens, hits.at) : hits.at;
        const Floats even = hits.nearness > 0.0F ? hits.nearness / slant_at(view, at) : Floats{};
        std::memcpy(&nearness[begin], &even,
                    sizeof(float) * std::min<std::size_t>(lanes, nearness.size() - begin));
    }
}

} // namespace

void NearnessView::begin(const RasterView& view) {
    lens = PixelLens(view.projector);
    faces.clear();
    add(view);
}

void NearnessView::add(const RasterView& view) {
    for (const RasterFace& seen : view.faces) {
        if (std::any_of(faces.begin(), faces.end(),
                        [&](const NearnessFace& known) { return known.face == seen.face; })) {
            continue;
        }
        NearnessFace& added = faces.emplace_back();
        added.face = seen.face;
        added.edges = first_edges(seen);
        for (const glm::dvec3& edge : relief::more_edges(seen)) {
            added.more_edges.push_back(glm::vec3(edge));
        }
        added.slant = glm::vec3(seen.slant);
    }
}

void nearness_row(const RasterSamples& samples, const NearnessView& view, int y, int first,
                  std::span<float> nearness, Instructions instructions) {
    run_with<find_nearness>(instructions, samples, view, y, first, nearness);
}

} // namespace frustumscreen::relief
