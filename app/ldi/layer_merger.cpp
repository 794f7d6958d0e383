#include "app/ldi/layered_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::ldi {

namespace {

constexpr std::uint32_t no_node = std::numeric_limits<std::uint32_t>::max();
/// Neighbours in a picture that differ by more steps lie on two surfaces, or on one that is slanted by more than 80.5 degrees.
constexpr double max_picture_steps = 6.0;
/// A picture's pixel goes into the image's pixels whose middles it covers, up to this far from its own place.
constexpr double max_half_box_px = 1.5;

/// The step to a neighbour on the same surface, along x or y: the smaller of the two, 0 where there is none.
double slope_at(const DepthPicture& picture, double step_share, std::size_t pixel, std::size_t stride,
                bool has_before, bool has_after) {
    const double here = static_cast<double>(picture.nearness[pixel]);
    const double limit = max_picture_steps * step_share * here;
    double least = std::numeric_limits<double>::infinity();
    if (has_before && picture.nearness[pixel - stride] > 0.0F) {
        least = here - static_cast<double>(picture.nearness[pixel - stride]);
    }
    if (has_after && picture.nearness[pixel + stride] > 0.0F) {
        const double after = static_cast<double>(picture.nearness[pixel + stride]) - here;
        least = std::fabs(after) < std::fabs(least) ? after : least;
    }
    return std::fabs(least) <= limit ? least : 0.0;
}

/// The point of a picture's pixel, and the vectors on its surface's plane to the next pixels.
struct SurfacePoint {
    glm::dvec3 point, across, down;
};

SurfacePoint surface_at(const DepthPicture& picture, const PictureMap& map, int x, int y) {
    const std::size_t pixel = picture.at(x, y);
    const double nearness = static_cast<double>(picture.nearness[pixel]);
    const double across = slope_at(picture, map.step_share(), pixel, 1, x > 0, x + 1 < picture.camera.width);
    const double down =
        slope_at(picture, map.step_share(), pixel, static_cast<std::size_t>(picture.camera.width), y > 0,
                 y + 1 < picture.camera.height);
    const glm::dvec3 point = map.point(x + 0.5, y + 0.5, nearness);
    return {point, map.point(x + 1.5, y + 0.5, nearness + across) - point,
            map.point(x + 0.5, y + 1.5, nearness + down) - point};
}

/// Where the next pixels of the picture lie in the image, from the pixel's own place.
glm::dmat2 image_from_picture(const PictureMap& map, const SurfacePoint& surface,
                              const PictureMap::Place& place) {
    const glm::dvec3 across = map.homogeneous_from_eye(surface.across);
    const glm::dvec3 down = map.homogeneous_from_eye(surface.down);
    const glm::dvec2 at(place.x, place.y);
    return place.nearness * glm::dmat2(glm::dvec2(across) - at * across.z, glm::dvec2(down) - at * down.z);
}

/// Half the size of the box in the image that holds the picture's pixel.
glm::dvec2 half_box(const glm::dmat2& image_from_picture) {
    const glm::dvec2 size = glm::abs(image_from_picture[0]) + glm::abs(image_from_picture[1]);
    return glm::min(0.5 * size, glm::dvec2(max_half_box_px));
}

/// The slope of the surface in the image, at most `limit` long.
glm::dvec2 slope_in(const PictureMap& map, const SurfacePoint& surface, double limit) {
    const glm::dvec3 normal = glm::cross(surface.across, surface.down);
    const double through = glm::dot(normal, surface.point - map.eye());
    const glm::dvec2 slope(glm::dot(normal, map.per_column()), glm::dot(normal, map.per_row()));
    const double size = glm::length(slope);
    if (size > limit * std::fabs(through)) { // also for a surface seen edge-on, where `through` is 0
        return size > 0.0 && std::isfinite(size) ? std::copysign(limit, through) / size * slope
                                                 : glm::dvec2(0.0);
    }
    return through == 0.0 ? glm::dvec2(0.0) : slope / through;
}

/// The colours around a picture's pixel, and how far its surface reaches.
class ColoursAround {
public:
    ColoursAround(const DepthPicture& picture, double step_share, int x, int y,
                  const glm::dmat2& image_from_picture)
        : picture_(picture), x_(x), y_(y),
          limit_(max_picture_steps * step_share * static_cast<double>(picture.nearness[picture.at(x, y)])),
          is_edge_on_(std::fabs(glm::determinant(image_from_picture)) < min_area_px),
          picture_from_image_(is_edge_on_ ? glm::dmat2(0.0) : glm::inverse(image_from_picture)) {}

    /// Bilinear, beside the pixel's own place, in the image's pixels. Pixels of other surfaces do not count.
    [[nodiscard]] glm::u8vec4 at(const glm::dvec2& beside) const {
        const glm::dvec2 off = picture_from_image_ * beside;
        const glm::vec2 share(glm::min(glm::abs(off), 1.0));
        const int across = off.x < 0.0 ? -1 : 1;
        const int down = off.y < 0.0 ? -1 : 1;
        const glm::vec4 colour =
            glm::mix(glm::mix(colour_of(0, 0), colour_of(across, 0), share.x),
                     glm::mix(colour_of(0, down), colour_of(across, down), share.x), share.y);
        return glm::u8vec4(colour + 0.5F);
    }

    /// False if the place, in the image's pixels, lies beyond the pixel, on the side of a neighbour that is empty or shows a surface
    /// behind: there the surface ends.
    [[nodiscard]] bool reaches(const glm::dvec2& beside) const {
        const glm::dvec2 off = picture_from_image_ * beside;
        return (std::fabs(off.x) <= 0.5 || !ends_at(off.x < 0.0 ? -1 : 1, 0)) &&
               (std::fabs(off.y) <= 0.5 || !ends_at(0, off.y < 0.0 ? -1 : 1));
    }

private:
    [[nodiscard]] bool ends_at(int across, int down) const {
        const int x = x_ + across;
        const int y = y_ + down;
        const bool is_within = x >= 0 && y >= 0 && x < picture_.camera.width && y < picture_.camera.height;
        return is_within && static_cast<double>(picture_.nearness[picture_.at(x_, y_)] -
                                                picture_.nearness[picture_.at(x, y)]) > limit_;
    }

    /// A surface that the picture sees edge-on keeps its own colour.
    static constexpr double min_area_px = 0.05;

    /// The pixel's own where the other one shows another surface.
    [[nodiscard]] glm::vec4 colour_of(int across, int down) const {
        const int x = x_ + across;
        const int y = y_ + down;
        const std::size_t own = picture_.at(x_, y_);
        if (x < 0 || y < 0 || x >= picture_.camera.width || y >= picture_.camera.height) {
            return picture_.colours[own];
        }
        const std::size_t other = picture_.at(x, y);
        const auto apart = static_cast<double>(std::fabs(picture_.nearness[other] - picture_.nearness[own]));
        return picture_.colours[apart <= limit_ ? other : own];
    }

    const DepthPicture& picture_;
    int x_, y_;
    double limit_; ///< of nearness, between neighbours on one surface
    bool is_edge_on_;
    glm::dmat2 picture_from_image_;
};

} // namespace

LayerMerger::LayerMerger(const PictureCamera& camera, double tolerance_steps)
    : camera_(camera), map_(camera), tolerance_steps_(tolerance_steps),
      heads_(camera.pixel_count(), no_node) {}

template <typename Colour>
void LayerMerger::insert(std::size_t pixel, DepthPixel added, const Colour& colour) {
    std::uint32_t before = no_node;
    std::uint32_t after = heads_[pixel];
    for (std::uint32_t node = heads_[pixel]; node != no_node; node = nodes_[node].next) {
        const DepthPixel& other = nodes_[node].pixel;
        const auto apart = static_cast<double>(std::fabs(other.nearness - added.nearness));
        if (apart <= tolerance_steps_ * map_.step_share() *
                         static_cast<double>(std::max(other.nearness, added.nearness))) {
            return;
        }
        if (other.nearness < added.nearness) {
            before = node;
            after = nodes_[node].next;
        }
    }
    added.colour = colour();
    const auto number = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({added, after});
    (before == no_node ? heads_[pixel] : nodes_[before].next) = number;
}

template <typename Colour>
void LayerMerger::add_box(const PictureMap::Place& place, const glm::dvec2& half, DepthPixel added,
                          const Colour& colour) {
    if (!(std::fabs(place.x) < 2.0 * max_picture_side && std::fabs(place.y) < 2.0 * max_picture_side)) {
        return;
    }
    const auto column = static_cast<int>(std::floor(place.x));
    const auto row = static_cast<int>(std::floor(place.y));
    for (int y = std::max(0, row - 1); y <= std::min(row + 1, camera_.height - 1); ++y) {
        for (int x = std::max(0, column - 1); x <= std::min(column + 1, camera_.width - 1); ++x) {
            const glm::dvec2 to_middle(x + 0.5 - place.x, y + 0.5 - place.y);
            const bool covered = std::fabs(to_middle.x) <= half.x && std::fabs(to_middle.y) <= half.y;
            added.nearness =
                static_cast<float>(place.nearness + glm::dot(glm::dvec2(added.slope), to_middle));
            if (((covered && colour.reaches(to_middle)) || (x == column && y == row)) &&
                added.nearness > 0.0F && std::isfinite(added.nearness)) {
                insert(static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width) +
                           static_cast<std::size_t>(x),
                       added, [&] { return colour.at(to_middle); });
            }
        }
    }
}

void LayerMerger::add(const DepthPicture& picture) {
    const PictureMap from(picture.camera);
    if (!map_.usable() || !from.usable()) {
        return;
    }
    for (int y = 0; y < picture.camera.height; ++y) {
        for (int x = 0; x < picture.camera.width; ++x) {
            const std::size_t pixel = picture.at(x, y);
            if (!(picture.nearness[pixel] > 0.0F)) {
                continue;
            }
            const SurfacePoint surface = surface_at(picture, from, x, y);
            if (const auto place = map_.project(surface.point)) {
                const glm::dvec2 slope =
                    slope_in(map_, surface, max_slope_steps * map_.step_share() * place->nearness);
                const glm::dmat2 to_image = image_from_picture(map_, surface, *place);
                const ColoursAround colours(picture, from.step_share(), x, y, to_image);
                add_box(*place, half_box(to_image), {0.0F, glm::vec2(slope), picture.colours[pixel]},
                        colours);
            }
        }
    }
}

LayeredDepth LayerMerger::take() const {
    LayeredDepth layers;
    layers.camera = camera_;
    layers.firsts.reserve(heads_.size() + 1);
    layers.pixels.reserve(nodes_.size());
    for (const std::uint32_t head : heads_) {
        layers.firsts.push_back(static_cast<std::uint32_t>(layers.pixels.size()));
        for (std::uint32_t node = head; node != no_node; node = nodes_[node].next) {
            layers.pixels.push_back(nodes_[node].pixel);
        }
    }
    layers.firsts.push_back(static_cast<std::uint32_t>(layers.pixels.size()));
    return layers;
}

PictureCamera camera_around(std::span<const DepthPicture* const> pictures, const glm::dvec3& eye,
                            const PixelGrid& grid) {
    // One pixel, whose upper left corner is the grid's middle; all others go on from it.
    PictureCamera unit{eye,
                       grid.middle + 0.5 * grid.pitch_m * (grid.right - grid.up),
                       0.5 * grid.pitch_m * grid.right,
                       0.5 * grid.pitch_m * grid.up,
                       1,
                       1};
    const PictureMap map(unit);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    glm::dvec2 low(infinity);
    glm::dvec2 high(-infinity);
    for (const DepthPicture* picture : pictures) {
        const PictureMap from(picture->camera);
        for (int y = 0; from.usable() && map.usable() && y < picture->camera.height; ++y) {
            for (int x = 0; x < picture->camera.width; ++x) {
                const auto nearness = static_cast<double>(picture->nearness[picture->at(x, y)]);
                if (nearness > 0.0) {
                    if (const auto place = map.project(from.point(x + 0.5, y + 0.5, nearness))) {
                        low = glm::min(low, glm::dvec2(place->x, place->y));
                        high = glm::max(high, glm::dvec2(place->x, place->y));
                    }
                }
            }
        }
    }
    if (!(low.x <= high.x)) {
        unit.width = 0;
        unit.height = 0;
        return unit;
    }
    const double side = std::clamp(grid.max_side, 1, max_picture_side);
    low = glm::max(glm::floor(low), glm::dvec2(-std::floor(0.5 * side)));
    high = glm::max(low + 1.0, glm::min(glm::floor(high) + 1.0, low + side));
    const glm::dvec2 middle = 0.5 * (low + high); // from the grid's middle, to the right and down
    const glm::dvec2 size = high - low;
    return {eye,
            grid.middle + grid.pitch_m * (middle.x * grid.right - middle.y * grid.up),
            0.5 * grid.pitch_m * size.x * grid.right,
            0.5 * grid.pitch_m * size.y * grid.up,
            static_cast<int>(size.x),
            static_cast<int>(size.y)};
}

} // namespace frustumscreen::ldi
