/// The eyes of a patch in 16 cells, and for each cell the eyes at its corners. Hardly any point of a patch is seen by
/// an eye but by no corner of its cell.
///
/// Frames   window (triangle_world.h).
/// Units    metres.
/// Cells    four steps of polar angles by four of azimuths; in the centre two by eight. A cell reaches from `min_eye_share` to
///          `max_eye_share` of the hemisphere's radius.
/// Threads  values; any.
/// Errors   none: an eye a little outside of the cells is in the nearest one, any other one in all of them.
#pragma once

#include "app/ldi/hemisphere.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace frustumscreen::ldi {

/// An eye nearer to the window's middle than this share of the hemisphere's radius, or farther than this multiple of it, may see
/// what no camera of the hemisphere saw.
inline constexpr double min_eye_share = 0.7, max_eye_share = 1.5;

/// Bit k for cell k.
using CellMask = std::uint16_t;
inline constexpr CellMask all_cells = 0xFFFF;

class EyeCells {
public:
    struct Corner {
        glm::dvec3 eye{0.0};
        CellMask cells = 0; ///< that it is a corner of
    };

    /// Without a patch: every eye is in all cells.
    EyeCells() = default;
    EyeCells(const Hemisphere& hemisphere, std::size_t patch);

    /// The cell that the eye is in; all cells for an eye that lies in none.
    [[nodiscard]] CellMask cell_of(const glm::dvec3& eye) const;
    /// The corners of all cells, each once, near and far.
    [[nodiscard]] std::vector<Corner> corners() const;

private:
    [[nodiscard]] glm::dvec3 direction(int row, int column) const;
    [[nodiscard]] CellMask cells_around(int row, int column) const;

    double radius_m_ = 0.0;
    PatchDirections directions_;
    bool is_centre_ = false;
    int rows_ = 0, columns_ = 0;
};

} // namespace frustumscreen::ldi
