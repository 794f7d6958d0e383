#include "app/relief/nearness_row.h"

#include "app/relief/lanes.h"
#include "app/relief/lens_lanes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace frustumscreen::relief {

namespace {

/// The samples of a pixel in pairs, the nearest to its centre first. The two of a pair lie on opposite sides of it
/// (rasterize_blocks.cpp, sample_place).
struct Order {
    std::array<std::size_t, RasterSamples::most> samples{};
    std::size_t count = 0;

    explicit Order(std::span<const glm::vec2> places) : count(places.size()) {
        std::array<std::size_t, RasterSamples::most / 2> first{};
        const std::size_t pairs = count / 2;
        std::iota(first.begin(), first.end(), std::size_t{0});
        std::sort(first.begin(), first.begin() + static_cast<std::ptrdiff_t>(pairs),
                  [&](std::size_t a, std::size_t b) {
                      return glm::distance(places[a], glm::vec2(0.5F)) <
                             glm::distance(places[b], glm::vec2(0.5F));
                  });
        for (std::size_t k = 0; k < pairs; ++k) {
            samples[2 * k] = first[k];
            samples[2 * k + 1] = count - 1 - first[k];
        }
    }
};

FRUSTUMSCREEN_INLINE Floats at_pixels(const glm::vec3& linear, const PixelLanes& at) {
    return linear.x * at.x + linear.y * at.y + linear.z;
}

/// The slant of the face that each pixel lights: the one whose nearest edge is farthest away.
FRUSTUMSCREEN_INLINE Floats slant_at(const NearnessView& view, const PixelLanes& at) {
    if (view.faces.size() == 1) {
        return at_pixels(view.faces[0].slant, at);
    }
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

/// The nearness of sample `k` of each of eight pixels.
FRUSTUMSCREEN_INLINE Floats nearness_at(const RasterSamples& samples, const NearnessView& view, int x, int y,
                                        std::size_t k) {
    const Floats met = load(&samples.nearness[samples.at(x, y, k)]);
    if (!any(met > 0.0F)) {
        return Floats{};
    }
    const glm::vec2& place = samples.places()[k];
    PixelLanes at{__builtin_convertvector(lane_numbers + x, Floats) + place.x,
                  all(static_cast<float>(y) + place.y)};
    at = view.lens.bends ? unbent(view.lens, at) : at;
    return met > 0.0F ? met / slant_at(view, at) : Floats{};
}

/// The nearness at the centre, from two samples on opposite sides of it: their mean if both lie on one surface, otherwise the
/// nearer one.
FRUSTUMSCREEN_INLINE Floats between(Floats a, Floats b) {
    constexpr float one_surface = 31.0F / 32.0F;
    const Floats near = most(a, b);
    const Floats far = least(a, b);
    return far > one_surface * near ? 0.5F * (near + far) : near;
}

FRUSTUMSCREEN_INLINE void find_nearness(const RasterSamples& samples, const NearnessView& view, int y,
                                        int first, std::span<float> nearness) {
    const Order order(samples.places());
    for (std::size_t begin = 0; begin < nearness.size(); begin += lanes) {
        const int x = first + static_cast<int>(begin);
        Floats shown{};
        for (std::size_t k = 0; k < order.count && any(shown <= 0.0F); k += 2) {
            const Floats one = nearness_at(samples, view, x, y, order.samples[k]);
            const Floats pair =
                order.count > 1 ? between(one, nearness_at(samples, view, x, y, order.samples[k + 1])) : one;
            shown = shown > 0.0F ? shown : pair;
        }
        std::memcpy(&nearness[begin], &shown,
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
