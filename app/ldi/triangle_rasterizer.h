/// Draws triangles into depth pictures, on the processor, with a z-buffer.
///
/// Frames   the world's, which the picture's camera shares.
/// Errors   none: what is not finite is not drawn; an eye that is not before its window leaves the picture as it is.
/// Threads  each rasterizer one at a time. It keeps memory between calls: a second `draw` of no more positions and pixels
///          allocates nothing.
/// Method   corners are rounded to 1/1024 of a pixel, then each edge function is exact in 64 bits: triangles with a common
///          edge neither overlap nor leave a gap. A nearer surface wins, the first of equal ones. Colours are found
///          afterwards, for each pixel that is seen, where its ray meets its triangle, so they are correct in perspective.
///          Nearer to the eye than a millionth of the rectangle nothing is drawn. A triangle that reaches more than 8000
///          pixels beyond the picture, or behind the eye, is cut.
#pragma once

#include "app/ldi/depth_picture.h"
#include "app/ldi/triangle_world.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace frustumscreen::ldi {

class TriangleRasterizer {
public:
    /// Adds to what the picture holds, by depth: also to one that was splatted (layered_depth.h). `DepthPicture::begin` comes
    /// first.
    void draw(const TriangleWorld& world, DepthPicture& picture);

    /// The same in parts, without colours: places all corners, then each call draws `count` triangles from `first` on. World
    /// and picture stay as they are until the last part is drawn.
    void begin_depths(const TriangleWorld& world, const DepthPicture& picture);
    void draw_depths(const TriangleWorld& world, DepthPicture& picture, std::size_t first, std::size_t count);
    /// Gives the pixels that the parts since `begin_depths` have drawn their colours.
    void colour_depths(const TriangleWorld& world, DepthPicture& picture) const;
    /// The memory that it keeps.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    /// A position in the picture.
    struct Corner {
        float x = 0.0F, y = 0.0F, nearness = 0.0F;
    };
    /// The first column and row whose pixels' middles are not left of a corner and not above it, within the picture. A
    /// triangle whose corners share column or row covers no pixel, and most triangles of a large world do.
    struct Cell {
        std::uint16_t column = 0, row = 0;
    };
    struct Target;

    void place_corners(const TriangleWorld& world, const PictureMap& map, const PictureCamera& camera);
    void draw_triangle(const Target& target, const Corner& a, const Corner& b, const Corner& c,
                       std::uint32_t triangle);
    void draw_cut(const Target& target, std::uint32_t triangle);
    void draw_triangles(const Target& target, std::size_t first, std::size_t end);
    void find_colours(const Target& target) const;

    std::vector<Corner> corners_;
    std::vector<Cell> cells_;         ///< of the corners
    std::vector<std::uint32_t> seen_; ///< triangle of each pixel, or `none`
};

} // namespace frustumscreen::ldi
