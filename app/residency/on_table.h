/// Collects the pictures that lie on the table in one frame, in the order of drawing, and converts rectangles
/// of the table to pictures.
///
/// Frames   table T, metres.
/// Threads  values; one caller. Allocates nothing; pictures beyond `max_on_table` are left out.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/transform.h"
#include "app/scene/frame_plan.h"
#include "app/typography/captions.h"

#include <array>
#include <cstddef>
#include <span>

namespace frustumscreen::residency {

class OnTable {
public:
    void clear() { count_ = 0; }
    /// Dark pictures are skipped.
    void add(const scene::TablePicture& picture);
    [[nodiscard]] std::span<const scene::TablePicture> pictures() const {
        return std::span(pictures_).first(count_);
    }

private:
    std::array<scene::TablePicture, scene::max_on_table> pictures_{};
    std::size_t count_ = 0;
};

/// Moves a rectangle by less than a pixel so that its top left corner falls on a corner of the projector's
/// pixels: letters set pixel for pixel stay crisp.
[[nodiscard]] typography::TableRectangle on_pixels(typography::TableRectangle rectangle,
                                                   const geometry::Pinhole& projector,
                                                   const geometry::RigidTransform& table_from_projector);

/// A picture's corners, for a reader of the rectangle.
[[nodiscard]] std::array<glm::dvec3, 4> picture_corners(const typography::TableRectangle& rectangle);
/// As above, for corners already in a picture's order.
[[nodiscard]] std::array<glm::dvec3, 4> flat_corners(const std::array<glm::dvec2, 4>& corners_m);

} // namespace frustumscreen::residency
