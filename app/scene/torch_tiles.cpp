#include "app/scene/torch_tiles.h"

#include "app/geometry/cut_polygon.h"
#include "app/scene/face_view.h"

#include <glm/gtc/matrix_inverse.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace frustumscreen::scene {

namespace {

/// A beam is widened by this, for numbers of 32 bits.
constexpr double margin_m = 1e-6;

/// The largest factor of a length in a pose's frame.
double scale_of(const glm::dmat4& frame) {
    double scale = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        scale = std::max(scale, glm::length(glm::dvec3(frame[axis])));
    }
    return scale;
}

/// The number of parts along an edge of a level's box; each is about a centimetre long.
glm::ivec3 parts_of_box(const glm::dvec3& size_m) {
    constexpr double part_m = 0.01;
    constexpr double max_parts = 12.0;
    return glm::ivec3(glm::clamp(glm::ceil(size_m / part_m), glm::dvec3(1.0), glm::dvec3(max_parts)));
}

/// Those around the small parts of the level's box that meet the beam.
PixelRectangle light_box(const LitDraw& lit, LitTiles& tiles) {
    const BeamPlanes planes(lit.beam, lit.torch_from_prop);
    const geometry::Box box = lit.level.placed_box();
    const double scale = scale_of(lit.level.prop_from_placed);
    const glm::ivec3 parts = parts_of_box(scale * (box.high - box.low));
    const glm::dvec3 size = (box.high - box.low) / glm::dvec3(parts);
    const double radius = 0.5 * scale * glm::length(size);
    PixelRectangle bounds;
    for (int k = 0; k < parts.x * parts.y * parts.z; ++k) {
        const glm::ivec3 place(k % parts.x, k / parts.x % parts.y, k / parts.x / parts.y);
        const glm::dvec3 low = box.low + size * glm::dvec3(place);
        const glm::dvec3 middle(lit.level.prop_from_placed * glm::dvec4(low + 0.5 * size, 1.0));
        if (!planes.may_light(middle, radius)) {
            continue;
        }
        std::array<glm::dvec4, 8> corners{};
        for (unsigned corner = 0; corner < corners.size(); ++corner) {
            const glm::dvec3 share(corner & 1U, corner >> 1U & 1U, corner >> 2U & 1U);
            corners[corner] = lit.draw.clip_from_placed * glm::dvec4(low + size * share, 1.0);
        }
        const PixelRectangle part = intersected(lit.draw.bounds, pixels_around(corners, lit.pinhole));
        tiles.light(part);
        bounds = united(bounds, part);
    }
    return bounds;
}

/// The triangles of a mesh in a beam.
class LitTriangles {
public:
    LitTriangles(const LitDraw& lit, LitTiles& tiles)
        : lit_(lit), level_(*lit.level.triangles), tiles_(tiles), prop_from_box_(lit.level.prop_from_box()),
          planes_(lit.beam, lit.torch_from_prop * prop_from_box_), scale_(scale_of(prop_from_box_)) {
        const glm::dmat4 box_from_prop = glm::affineInverse(prop_from_box_);
        const glm::dvec4 torch = glm::affineInverse(lit.torch_from_prop)[3];
        eye_ = glm::vec3(box_from_prop * glm::dvec4(lit.eye_in_prop, 1.0));
        torch_ = glm::vec3(box_from_prop * torch);
        const auto slack = [](const glm::vec3& from) {
            return edge_on_box + 4.0F * std::numeric_limits<float>::epsilon() * (1.0F + glm::length(from));
        };
        eye_slack_ = slack(eye_);
        torch_slack_ = slack(torch_);
        clip_from_box_ = lit.draw.clip_from_placed;
        for (int axis = 0; axis < 3; ++axis) {
            clip_from_box_[axis] *= lit.level.metres_per_box;
        }
    }
    PixelRectangle light() {
        for (const pack::PackCluster& cluster : level_.clusters) {
            light_cluster(cluster);
        }
        return bounds_;
    }

private:
    void light_cluster(const pack::PackCluster& cluster) {
        const double radius_m = scale_ * static_cast<double>(cluster.radius) + margin_m;
        const glm::dvec4 centre(glm::dvec3(cluster.centre), 1.0);
        crossed_count_ = 0;
        for (const glm::dvec4& plane : planes_.planes()) {
            const double inside_m = glm::dot(plane, centre);
            if (inside_m < -radius_m) {
                return;
            }
            if (inside_m < radius_m) {
                crossed_[crossed_count_++] = plane + glm::dvec4(0.0, 0.0, 0.0, margin_m);
            }
        }
        const PixelRectangle box = intersected(
            lit_.draw.bounds,
            pixels_of(level_.extents[static_cast<std::size_t>(&cluster - level_.clusters.data())]));
        if (box.empty()) {
            return;
        }
        const std::size_t end = (cluster.first_index + cluster.index_count) / 3;
        const bool whole = is_small(box, cluster);
        for (std::size_t t = cluster.first_index / 3; t < end; ++t) {
            if (!in_front(t, eye_, eye_slack_) || !in_front(t, torch_, torch_slack_)) {
                continue;
            }
            if (whole) {
                add(box);
                return;
            }
            light_triangle(t);
        }
    }
    /// True if looking at each triangle would cost more than it saves.
    [[nodiscard]] bool is_small(const PixelRectangle& box, const pack::PackCluster& cluster) const {
        constexpr std::int64_t pixels_per_triangle = 100;
        constexpr std::int64_t some_tiles = std::int64_t{32} * 32;
        const std::int64_t pixels = std::int64_t{box.width} * box.height;
        return pixels <= some_tiles ||
               (crossed_count_ == 0 && pixels <= pixels_per_triangle * std::int64_t{cluster.index_count / 3});
    }
    [[nodiscard]] PixelRectangle pixels_of(const LevelTriangles::Extent& extent) const {
        std::array<glm::dvec4, 8> corners{};
        const glm::dvec3 low(extent.low);
        const glm::dvec3 high(extent.high);
        for (unsigned k = 0; k < corners.size(); ++k) {
            corners[k] =
                clip_from_box_ * glm::dvec4((k & 1U) != 0 ? high.x : low.x, (k & 2U) != 0 ? high.y : low.y,
                                            (k & 4U) != 0 ? high.z : low.z, 1.0);
        }
        return pixels_around(corners, lit_.pinhole);
    }
    /// Also a triangle within rounding of edge-on.
    [[nodiscard]] bool in_front(std::size_t t, const glm::vec3& from, float slack) const {
        return level_.normal_x[t] * from.x + level_.normal_y[t] * from.y + level_.normal_z[t] * from.z -
                   level_.distance[t] >=
               -slack;
    }
    void light_triangle(std::size_t t) {
        std::array<glm::dvec3, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = glm::dvec3(level_.positions[level_.indices[3 * t + k]]);
        }
        geometry::CutPolygon<3 + BeamPlanes::max_count> polygon(corners);
        for (std::size_t k = 0; k < crossed_count_; ++k) {
            const glm::dvec4& plane = crossed_[k];
            polygon.cut([&](const glm::dvec3& place) { return glm::dot(plane, glm::dvec4(place, 1.0)); });
        }
        const std::span<const glm::dvec3> places = polygon.corners();
        if (!places.empty()) {
            light_polygon(places);
        }
    }
    void light_polygon(std::span<const glm::dvec3> places) {
        std::array<glm::dvec2, 3 + BeamPlanes::max_count> pixels{};
        const glm::dvec2 half(0.5 * lit_.pinhole.width, 0.5 * lit_.pinhole.height);
        glm::dvec2 low(std::numeric_limits<double>::infinity());
        glm::dvec2 high(-std::numeric_limits<double>::infinity());
        for (std::size_t k = 0; k < places.size(); ++k) {
            const glm::dvec4 clip = clip_from_box_ * glm::dvec4(places[k], 1.0);
            if (!(clip.w > 0.0)) {
                add(lit_.draw.bounds);
                return;
            }
            pixels[k] = half * (glm::dvec2(clip) / clip.w + 1.0);
            low = glm::min(low, pixels[k]);
            high = glm::max(high, pixels[k]);
        }
        if (high.x - low.x <= band_px || high.y - low.y <= band_px) {
            light_rectangle(low, high);
        } else {
            light_bands(std::span(pixels).first(places.size()), low.y, high.y);
        }
    }
    /// Band by band, from row to row of tiles: a slanting polygon fills little of the rectangle around it.
    void light_bands(std::span<const glm::dvec2> pixels, double low_y, double high_y) {
        low_y = std::max(low_y, double{-band_px});
        high_y = std::min(high_y, lit_.pinhole.height + double{band_px});
        for (double top = band_px * std::floor(low_y / band_px); top < high_y; top += band_px) {
            const double bottom = top + band_px;
            glm::dvec2 low(std::numeric_limits<double>::infinity(), std::max(top, low_y));
            glm::dvec2 high(-std::numeric_limits<double>::infinity(), std::min(bottom, high_y));
            const auto reach = [&](double x) {
                low.x = std::min(low.x, x);
                high.x = std::max(high.x, x);
            };
            for (std::size_t k = 0; k < pixels.size(); ++k) {
                const glm::dvec2& from = pixels[k];
                const glm::dvec2& to = pixels[(k + 1) % pixels.size()];
                if (from.y >= top && from.y <= bottom) {
                    reach(from.x);
                }
                for (const double y : {top, bottom}) {
                    if ((from.y < y) != (to.y < y)) {
                        reach(from.x + (y - from.y) / (to.y - from.y) * (to.x - from.x));
                    }
                }
            }
            if (low.x <= high.x) {
                light_rectangle(low, high);
            }
        }
    }
    /// In the pixels of the ideal pinhole. A lens bends a triangle's corners, not its edges.
    void light_rectangle(glm::dvec2 low, glm::dvec2 high) {
        if (!lit_.pinhole.lens.is_plain()) {
            constexpr double sagitta_px = 8.0;
            lit_.pinhole.bend_around(low, high);
            low -= sagitta_px;
            high += sagitta_px;
        }
        const glm::dvec2 size(lit_.pinhole.width, lit_.pinhole.height);
        constexpr double rounding_px = 1.0 / 64.0; // of the rasterizer's corners
        low = glm::clamp(glm::floor(low - rounding_px), glm::dvec2(0.0), size);
        high = glm::clamp(glm::ceil(high + rounding_px), glm::dvec2(0.0), size);
        add({.x = static_cast<int>(low.x),
             .y = static_cast<int>(low.y),
             .width = static_cast<int>(high.x - low.x),
             .height = static_cast<int>(high.y - low.y)});
    }
    void add(const PixelRectangle& rectangle) {
        const PixelRectangle part = intersected(lit_.draw.bounds, rectangle);
        tiles_.light(part);
        bounds_ = united(bounds_, part);
    }

    static constexpr double band_px = 16.0;
    const LitDraw& lit_;
    const LevelTriangles& level_;
    LitTiles& tiles_;
    glm::dmat4 prop_from_box_;
    BeamPlanes planes_; ///< box frame
    double scale_;      ///< metres per box unit
    glm::dmat4 clip_from_box_{1.0};
    glm::vec3 eye_{0.0F}, torch_{0.0F}; ///< box frame
    float eye_slack_ = 0.0F, torch_slack_ = 0.0F;
    std::array<glm::dvec4, BeamPlanes::max_count>
        crossed_{}; ///< the planes that the cluster crosses, widened
    std::size_t crossed_count_ = 0;
    PixelRectangle bounds_;
};

} // namespace

BeamPlanes::BeamPlanes(const torch::Beam& beam, const glm::dmat4& torch_from_frame) {
    const glm::dvec2 extent = torch::half_extent(beam);
    const double reach = std::min(torch::reach_m(beam), 1e6);
    const glm::dmat4 transposed = glm::transpose(torch_from_frame);
    const auto add = [&](const glm::dvec3& direction, double distance) {
        planes_[count_++] = transposed * glm::dvec4(glm::normalize(direction), distance);
    };
    add({0.0, 0.0, 1.0}, 0.0);
    add({0.0, 0.0, -1.0}, reach);
    for (const double sign : {-1.0, 1.0}) {
        add({sign, 0.0, extent.x}, 0.0);
        add({0.0, sign, extent.y}, 0.0);
    }
    if (beam.shape == torch::Shape::Round) { // an octagon around the ellipse
        for (const glm::dvec2& sign :
             {glm::dvec2(1, 1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(-1, -1)}) {
            add({sign.x * extent.y, sign.y * extent.x, std::sqrt(2.0) * extent.x * extent.y}, 0.0);
        }
    }
}

bool BeamPlanes::may_light(const glm::dvec3& centre, double radius_m) const {
    return std::all_of(planes().begin(), planes().end(), [&](const glm::dvec4& plane) {
        return glm::dot(plane, glm::dvec4(centre, 1.0)) >= -radius_m;
    });
}

PixelRectangle light_tiles(const LitDraw& lit, LitTiles& tiles) {
    return lit.level.triangles ? LitTriangles(lit, tiles).light() : light_box(lit, tiles);
}

} // namespace frustumscreen::scene
