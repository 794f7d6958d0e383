#include "app/render/nearness_tiles.h"

#include "app/scene/torch_tiles.h"

#include <algorithm>
#include <array>
#include <limits>

namespace frustumscreen::render {

namespace {

struct Range {
    float least = std::numeric_limits<float>::infinity(), greatest = 0.0F;
};

/// The nearnesses of the hits in a rectangle.
Range range_of(const PixelRectangle& tile, const relief::PictureSpan<const float>& nearness) {
    Range range;
    for (int y = tile.y; y < tile.y + tile.height; ++y) {
        const float* const row = &nearness.at(tile.x, y);
        float least = range.least;
        float greatest = range.greatest;
        for (int x = 0; x < tile.width; ++x) {
            const float hit = row[x] > 0.0F ? row[x] : std::numeric_limits<float>::infinity();
            least = hit < least ? hit : least;
            greatest = row[x] > greatest ? row[x] : greatest;
        }
        range = {least, greatest};
    }
    return range;
}

/// The convex hull of a tile's places, torch's frame, with a pixel around the tile.
class TilePlaces {
public:
    TilePlaces(const scene::FramePlan& plan, const scene::TorchFace& face)
        : pinhole_(plan.projector), torch_from_projector_(plan.torches[face.torch].torch_from_projector),
          eye_(plan.torches[face.torch].eye),
          inverse_depth_(plan.faces[static_cast<std::size_t>(face.face)].light.inverse_depth) {}

    [[nodiscard]] std::array<glm::dvec3, 8> of(const PixelRectangle& tile, const Range& range) const {
        std::array<glm::dvec3, 8> places{};
        for (std::size_t k = 0; k < 4; ++k) {
            const double x = (k & 1U) != 0 ? tile.x + tile.width + 1 : tile.x - 1;
            const double y = (k & 2U) != 0 ? tile.y + tile.height + 1 : tile.y - 1;
            const glm::dvec3 ray = pinhole_.ray({x, y});
            const glm::dvec3 on_face(torch_from_projector_ *
                                     glm::dvec4(ray / glm::dot(inverse_depth_, ray), 1.0));
            places[2 * k] = eye_ + (on_face - eye_) / static_cast<double>(range.greatest);
            places[2 * k + 1] = eye_ + (on_face - eye_) / static_cast<double>(range.least);
        }
        return places;
    }

private:
    const geometry::Pinhole& pinhole_;
    glm::dmat4 torch_from_projector_;
    glm::dvec3 eye_, inverse_depth_;
};

bool meet(const scene::BeamPlanes& beam, const std::array<glm::dvec3, 8>& hull) {
    constexpr double margin_m = 1e-5;
    return std::all_of(beam.planes().begin(), beam.planes().end(), [&](const glm::dvec4& plane) {
        return std::any_of(hull.begin(), hull.end(), [&](const glm::dvec3& place) {
            return glm::dot(plane, glm::dvec4(place, 1.0)) >= -margin_m;
        });
    });
}

constexpr int torch_px = scene::torch_picture_px;
constexpr PixelRectangle whole{.x = 0, .y = 0, .width = torch_px, .height = torch_px};

/// Around places in the torch's own picture, with the pixels beside them.
PixelRectangle seen_around(const std::array<glm::dvec3, 8>& places, const glm::dvec2& per_half_extent) {
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high(-std::numeric_limits<double>::infinity());
    for (const glm::dvec3& place : places) {
        if (!(place.z > 0.0)) {
            return whole;
        }
        const glm::dvec2 at = glm::dvec2(place) / place.z * per_half_extent;
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    constexpr double half = 0.5 * torch_px;
    const glm::dvec2 first = glm::clamp(glm::floor(half * (low + 1.0)) - 2.0, 0.0, double{torch_px});
    const glm::dvec2 end = glm::clamp(glm::ceil(half * (high + 1.0)) + 2.0, 0.0, double{torch_px});
    return {.x = static_cast<int>(first.x),
            .y = static_cast<int>(first.y),
            .width = static_cast<int>(end.x - first.x),
            .height = static_cast<int>(end.y - first.y)};
}

} // namespace

PixelRectangle light_tiles(const scene::FramePlan& plan, const scene::TorchFace& face,
                           const PixelRectangle& part, const relief::PictureSpan<const float>& nearness,
                           scene::LitTiles& tiles) {
    constexpr int tile_px = 16;
    const scene::BeamPlanes beam(plan.torches[face.torch].torch.beam, glm::dmat4(1.0));
    const TilePlaces places_of(plan, face);
    const glm::dvec2 per_half_extent(plan.torches[face.torch].per_half_extent);
    PixelRectangle seen;
    const int right = part.x + part.width;
    const int bottom = part.y + part.height;
    for (int top = part.y / tile_px * tile_px; top < bottom; top += tile_px) {
        for (int left = part.x / tile_px * tile_px; left < right; left += tile_px) {
            const PixelRectangle tile =
                intersected(part, {.x = left, .y = top, .width = tile_px, .height = tile_px});
            const Range range = range_of(tile, nearness);
            if (!(range.greatest > 0.0F)) {
                continue;
            }
            const std::array<glm::dvec3, 8> places = places_of.of(tile, range);
            if (meet(beam, places)) {
                tiles.light(tile);
                seen = united(seen, seen_around(places, per_half_extent));
            }
        }
    }
    return seen;
}

} // namespace frustumscreen::render
