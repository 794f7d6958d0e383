/// One row of blocks of a patch's grid, from triangles.
///
/// Frames   the direction's grid (patch_grids.h), texels; rows count from the band's first one.
/// Threads  one at a time; the result depends on the input alone.
/// Memory   kept from band to band.
/// Method   the lines that cross each triangle (grid_triangle.h), then the code that the bake uses (app/relief/linked_blocks.h).
///          It runs twice: first to know which cells the surface does not fill, then, with the lines through those cells, to
///          make the blocks.
#pragma once

#include "app/ldi/camera_views.h"
#include "app/ldi/grid_triangle.h"
#include "app/ldi/patch_grids.h"
#include "app/relief/linked_blocks.h"

#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen::ldi {

inline constexpr int band_rows = relief::block_cells; ///< cells
inline constexpr std::uint32_t lines_of_cell =
    relief::CellCrossings::lines_along * relief::CellCrossings::lines_along;

/// Inputs that all bands of a direction share.
struct BandScene {
    const TriangleWorld& world;
    const PatchView& view;
    const CameraViews& views;
    std::span<const std::size_t> cameras; ///< of the patch, all drawn
    const PatchGrid& grid;
    std::size_t direction = 0;
    double texel_m = 0.0;
    std::uint64_t max_bytes = 0; ///< for the lines through the band's cut cells
};

/// How far a surface lies from the relief, at lines in the middles of some whole cells.
struct Roughness {
    double squares = 0.0; ///< texels along the lines
    std::uint64_t lines = 0;
};

class GridBand {
public:
    /// Appends the band's blocks. `triangles`: those of `facing` that reach into the band, in order. False if that would take
    /// more memory than allowed.
    [[nodiscard]] bool make(const BandScene& scene, int band, std::span<const FacingTriangle> facing,
                            std::span<const std::uint32_t> triangles, relief::DirectionBlocks& into,
                            Roughness& roughness);
    [[nodiscard]] std::uint64_t bytes() const;
    /// The part that finer texels make larger.
    [[nodiscard]] std::uint64_t grown_bytes() const;

private:
    struct Placed {
        GridTriangle shape;
        std::uint32_t triangle = 0;
        bool own = false;
    };
    struct Found {
        std::uint32_t line = 0;
        std::uint32_t placed = 0; ///< its triangle
        relief::Crossing crossing;
    };
    /// A crossing of a line through a cut cell.
    struct FineFound {
        std::uint32_t line = 0; ///< 81 times the cell's slot, and the line's number in it
        relief::LineCrossing crossing;
    };
    /// A whole cell whose middle is compared with the surface.
    struct Compared {
        std::uint32_t slot = 0;
        float w = 0.0F; ///< of the relief there
    };
    class CellRecorder;
    class FineLines;

    void place(const BandScene& scene, int band, std::span<const FacingTriangle> facing,
               std::span<const std::uint32_t> triangles);
    void cross(const BandScene& scene, int band);
    void cross_run(const BandScene& scene, std::uint32_t placed, int row, int left, int right);
    void sort();
    /// Leaves only crossings that the direction draws, and those that may continue them.
    void drop_hidden();
    void set_colours(const BandScene& scene);
    void find_cut_cells();
    void cross_cut_cells(const BandScene& scene);
    void cross_cell(const BandScene& scene, const Placed& placed, int column, int row);
    void sort_cut_cells();
    void compare(Roughness& roughness) const;
    void link(int band, relief::DirectionBlocks& into);
    [[nodiscard]] std::size_t cell_at(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(lines_.columns) +
               static_cast<std::size_t>(column);
    }
    /// `range`: of heights that the cell asks for.
    std::uint32_t take_slot(int column, int row, const glm::vec2& range);

    glm::dmat4 window_from_band_{1.0};
    std::vector<Placed> placed_;
    std::vector<Found> found_;
    std::vector<std::uint32_t> order_;
    relief::GridCrossings lines_;
    std::vector<std::uint32_t> placed_of_; ///< of each crossing of `lines_`
    std::vector<bool> kept_;               ///< the same
    std::vector<std::uint32_t> slots_;     ///< of each cell, or `no_slot`
    std::vector<glm::vec2> slot_ranges_; ///< lowest and highest of the heights that each slot's cell asks for
    std::vector<FineFound> fine_found_;
    std::vector<std::uint32_t> fine_first_; ///< of each line of each slot, and the end
    std::vector<relief::LineCrossing> fine_;
    std::vector<Compared> compared_;
};

} // namespace frustumscreen::ldi
