/// Finds which points of a patch eyes see, cell by cell of the patch's eyes (eye_cells.h), in small steps: a picture for each corner of
/// a cell. Points that none of them shows are dropped; the others are sorted, so that a block of eight is seen from the same cells.
///
/// Frames   window (triangle_world.h).
/// Cost     a picture has twice the window's pixels along a side.
/// Threads  one at a time.
/// Errors   none.
#pragma once

#include "app/ldi/patch_layers.h"
#include "app/ldi/point_patch.h"

#include <cstdint>
#include <vector>

namespace frustumscreen::ldi {

class SeenPoints {
public:
    SeenPoints(PointPatch patch, const Hemisphere& hemisphere, std::size_t number, const CameraView& view);

    /// Draws one picture. False when all are drawn.
    bool step();
    /// Returns the patch's points that eyes see. Call it once, last.
    [[nodiscard]] PointPatch take();
    [[nodiscard]] std::uint64_t bytes() const {
        return patch_.bytes() + splatter_.bytes() + colours_.capacity() * sizeof colours_[0] +
               cells_.capacity() * sizeof cells_[0];
    }

private:
    PointPatch patch_; ///< its colours are the points' numbers
    std::vector<std::uint32_t> colours_;
    std::vector<CellMask> cells_; ///< of each point
    std::vector<EyeCells::Corner> corners_;
    std::size_t next_ = 0;
    PictureCamera window_;
    PointSplatter splatter_;
};

} // namespace frustumscreen::ldi
