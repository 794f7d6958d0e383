/// A layered depth image: a picture whose pixels hold every surface point that some camera sees on their ray. Depth pictures
/// are merged into it, and it is splatted for any eye.
///
/// Frames   window (triangle_world.h), or any rigid one that the pictures share.
/// Units    metres; nearness as in depth_picture.h, of the image's own camera.
/// Colour   8-bit sRGB.
/// Errors   none: an image without a pixel, or an eye on the window's plane or behind it, draws nothing.
/// Threads  values; any. A merger is used by one thread at a time. `splat` allocates nothing.
/// Source   Shade, Gortler, He & Szeliski 1998; McMillan 1995 for the order; the multi-LDI report, 5.4 and 5.5. As in the
///          report, each depth pixel has its own splat size. Differs: a depth pixel keeps the slope of its surface, so its
///          depth is right at the pixel's middle and the splat size is exact for a plane.
#pragma once

#include "app/ldi/depth_picture.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen::ldi {

/// One surface point.
struct DepthPixel {
    float nearness = 0.0F; ///< at the pixel's middle; above 0
    glm::vec2 slope{0.0F}; ///< of the nearness along the surface, a pixel to the right and a pixel down
    glm::u8vec4 colour{0};
};
static_assert(sizeof(DepthPixel) == 16);

struct LayeredDepth {
    PictureCamera camera;
    std::vector<std::uint32_t> firsts; ///< of each pixel its first in `pixels`, and the end of the last one's
    std::vector<DepthPixel> pixels;    ///< pixel by pixel, row by row; in each, the farthest first

    [[nodiscard]] std::span<const DepthPixel> at(int x, int y) const {
        const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width) +
                                  static_cast<std::size_t>(x);
        return std::span(pixels).subspan(firsts[pixel], firsts[pixel + 1] - firsts[pixel]);
    }
    [[nodiscard]] std::uint64_t bytes() const {
        return firsts.size() * sizeof(std::uint32_t) + pixels.size() * sizeof(DepthPixel);
    }
};

/// A step is the size of an image's pixel at a point's distance. Two points of a pixel whose depths at its middle differ by no
/// more than this are one.
inline constexpr double default_tolerance_steps = 0.5;
/// Largest slope of a depth pixel, in steps a pixel: 63 degrees. A pixel of the image holds a row of points of a steeper surface;
/// each point is drawn for its own part of the surface alone. A smaller limit leaves gaps between them, a larger one frays
/// silhouettes (of 1, 1.5, 2 and 3 this has the least error, in colour and depth).
inline constexpr double max_slope_steps = 2.0;

/// Merges depth pictures. Where two see one surface point, the first one's stays.
class LayerMerger {
public:
    explicit LayerMerger(const PictureCamera& camera, double tolerance_steps = default_tolerance_steps);
    /// Leaves out points that lie outside of the camera's picture.
    void add(const DepthPicture& picture);
    [[nodiscard]] LayeredDepth take() const;
    [[nodiscard]] std::uint64_t bytes() const {
        return heads_.capacity() * sizeof(std::uint32_t) + nodes_.capacity() * sizeof(Node);
    }

private:
    struct Node {
        DepthPixel pixel;
        std::uint32_t next = 0;
    };
    /// `colour`: of the surface at a place in pixels beside `place`.
    template <typename Colour>
    void add_box(const PictureMap::Place& place, const glm::dvec2& half, DepthPixel added,
                 const Colour& colour);
    template <typename Colour> void insert(std::size_t pixel, DepthPixel added, const Colour& colour);

    PictureCamera camera_;
    PictureMap map_;
    double tolerance_steps_;
    std::vector<std::uint32_t> heads_; ///< of each pixel the farthest node, or `no_node`
    std::vector<Node> nodes_;
};

/// A plane and the size of pixels on it, four of which meet in its middle. `right` and `up` are unit and at right angles.
struct PixelGrid {
    glm::dvec3 middle{0.0}, right{1.0, 0.0, 0.0}, up{0.0, 1.0, 0.0};
    double pitch_m = 0.0;            ///< above 0
    int max_side = max_picture_side; ///< pixels, around the middle
};
/// The camera with this eye whose pixels are the grid's, and which holds all points of the pictures that lie before the eye, as far
/// as `max_side` lets it. Without a point it has no pixels.
[[nodiscard]] PictureCamera camera_around(std::span<const DepthPicture* const> pictures,
                                          const glm::dvec3& eye, const PixelGrid& grid);

/// Largest side of a splat, in pixels. An eye that comes close sees gaps, but its picture does not take seconds.
inline constexpr double max_splat_px = 16.0;

/// Draws the image into a picture for its camera, over what the picture holds, without a depth test: from far to near, in
/// McMillan's order. `DepthPicture::begin` comes first.
void splat(const LayeredDepth& layers, DepthPicture& picture);
/// The same with a depth test: several images into one picture.
void splat_by_depth(const LayeredDepth& layers, DepthPicture& picture);

} // namespace frustumscreen::ldi
