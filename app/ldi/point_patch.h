/// A patch's depth pixels as points that are warped eight at a time: the quickest picture of a frozen window.
///
/// A point covers the box that holds the image of its depth pixel, as in `splat` (layered_depth.h), and each pixel of the
/// picture shows the nearest of its points.
///
/// Frames   window (triangle_world.h).
/// Units    metres; nearness as in depth_picture.h.
/// Colour   8-bit sRGB.
/// Numbers  32 bits: a place is off by less than 1/1000 pixel in pictures of up to 1024 pixels, and slopes are rounded to
///          1/8192 step (layered_depth.h).
/// Errors   none: an eye on the window's plane or behind it sees nothing.
/// Pixels   of the picture's camera, or of any collineation of the world: then nearness is per unit of its third component.
/// Threads  values; any. A splatter is used by one thread at a time. It allocates only for a larger picture than any before.
/// Source   layered_depth.h; a depth test by the larger of two 64-bit words.
#pragma once

#include "app/ldi/eye_cells.h"
#include "app/ldi/layered_depth.h"
#include "app/relief/instructions.h"

#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen::ldi {

inline constexpr std::size_t block_points = 8;

/// A structure of arrays; empty points pad it to a multiple of eight, and eight after one another are a block.
struct PointPatch {
    PictureCamera camera;
    std::vector<std::uint32_t> places;  ///< column in the lower half, row in the upper
    std::vector<float> nearness;        ///< at the pixel's middle; 0: an empty point
    std::vector<std::uint32_t> slopes;  ///< two signed halves: a pixel to the right, a pixel down
    std::vector<std::uint32_t> colours; ///< red in the lowest byte
    EyeCells cells;
    std::vector<CellMask> seen; ///< of each block, the cells of the eyes that see it; none: all eyes may
    std::uint64_t number = 0;   ///< the maker's; a picture's hash takes it in place of the points

    [[nodiscard]] std::uint64_t bytes() const {
        return places.size() *
                   (sizeof places[0] + sizeof nearness[0] + sizeof slopes[0] + sizeof colours[0]) +
               seen.size() * sizeof seen[0];
    }
};
[[nodiscard]] PointPatch point_patch(const LayeredDepth& layers);

class PointSplatter {
public:
    /// Draws the patch into a picture for its camera, in place of what the picture holds.
    void draw(const PointPatch& patch, DepthPicture& picture,
              relief::Instructions instructions = relief::best_instructions());

    /// Draws it for a camera, and returns a word for each pixel, row by row, valid until the next call: nearness above, colour below;
    /// 0: empty.
    [[nodiscard]] std::span<const std::uint64_t>
    draw(const PointPatch& patch, const PictureCamera& camera,
         relief::Instructions instructions = relief::best_instructions());

    /// Draws it through a collineation: `pixel_from_window` times (point, 1) is (x w, y w, w), w above 0 before the eye, and 0 at
    /// the eye's place and beside it. Words as above. `width`, `height`: up to `max_picture_side`.
    [[nodiscard]] std::span<const std::uint64_t>
    draw(const PointPatch& patch, const glm::mat<4, 3, double>& pixel_from_window, int width, int height,
         relief::Instructions instructions = relief::best_instructions());

    [[nodiscard]] std::uint64_t bytes() const { return nearest_.capacity() * sizeof nearest_[0]; }

private:
    std::vector<std::uint64_t> nearest_; ///< of each pixel: nearness above, colour below
};

/// The colours of a picture's words, red in the lowest byte. Both spans have the same length.
void colours_of(std::span<const std::uint64_t> words, std::span<glm::u8vec4> colours);

} // namespace frustumscreen::ldi
