/// A patch of a multi-LDI as a block relief: what the eyes of the patch see of a world through its window, drawn as an artifact's
/// relief is drawn.
///
/// Frames   window (triangle_world.h); box (app/relief/block_relief.h), with the axes of the patch's image plane.
/// Units    metres.
/// Errors   none: a world that no eye of the patch sees makes an empty relief.
/// Threads  one at a time; the result depends on the input alone, not on how the work was divided.
/// Method   grids parallel to the patch's image plane and, for what is steep to it, across it, as the bake's for the
///          directions of a prop's faces. A crossing of their lines is kept if it faces an eye of the patch, lies in
///          what its window shows, and is seen by one of its cameras or lies where no camera looks. docs/ldi.md: a
///          patch as a relief.
/// Source   layered depth images (Shade 1998); patches of the multi-LDI report.
#pragma once

#include "app/ldi/camera_views.h"
#include "app/ldi/grid_band.h"
#include "app/ldi/hemisphere.h"
#include "app/ldi/patch_grids.h"
#include "app/ldi/patch_view.h"
#include "app/ldi/triangle_world.h"
#include "app/relief/block_relief.h"
#include "app/relief/linked_blocks.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace frustumscreen::ldi {

struct PatchRelief {
    relief::BlockRelief relief; ///< without blocks: nothing is seen
    glm::dmat4 window_from_box{1.0};
    glm::dvec3 box_size{1.0};
    double texel_m = 0.0; ///< at most as asked for, unless the memory did not suffice
    double error_texels =
        0.0; ///< root mean square of the surface's distance from the relief along the lines, in units of PatchLimits::texel_m

    [[nodiscard]] bool empty() const { return relief.blocks.empty(); }
};

struct PatchLimits {
    glm::dvec2 half_extent_m{0.1}; ///< of the window, above 0
    double texel_m = 0.001;        ///< wanted: of a pixel that lights the window
    /// Memory for one patch: its blocks, and the data that is kept while it is made. If it does not suffice, texels become larger.
    /// 20 bytes for each triangle that faces the patch, and 200 for each triangle of a row of blocks, come on top.
    std::uint64_t max_bytes = std::uint64_t{64} << 20U;
    /// A patch with a larger `PatchRelief::error_texels` is made again with finer texels, once, if the memory allows it.
    double max_error_texels = 0.5;
};

/// Makes a patch in small steps.
class PatchBuild {
public:
    /// All must outlive it. `patch`: of `hemisphere`.
    PatchBuild(const TriangleWorld& world, const Hemisphere& hemisphere, CameraViews& views,
               std::size_t patch, const PatchLimits& limits);

    /// Does a piece of work: about `triangles` triangles, or a row of blocks. False once the patch is made.
    bool step(std::size_t triangles);
    /// Call once `step` has returned false.
    [[nodiscard]] PatchRelief take() { return std::move(made_); }
    /// Bytes of main memory, without the camera views.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    enum class Stage { Cameras, Facing, Counting, Sorting, Bands, Done };

    void find_facing(std::size_t triangles);
    void begin_grids(double texel_m);
    /// Calls visit(band) for each band that it reaches into, of all directions.
    template <typename Visit> void for_each_band(const FacingTriangle& facing, const Visit& visit) const;
    void count(std::size_t triangles);
    void sort(std::size_t triangles);
    void make_band();
    void append_direction(std::size_t direction);
    /// Begins again with texels for which the memory suffices.
    void coarsen(double done_share);
    void finish();
    [[nodiscard]] std::uint64_t grown_bytes() const;

    const TriangleWorld& world_;
    const Hemisphere& hemisphere_;
    CameraViews& views_;
    std::size_t patch_;
    PatchLimits limits_;
    PatchView view_;
    Stage stage_ = Stage::Cameras;
    std::size_t next_ = 0; ///< of what the stage goes through

    std::vector<FacingTriangle> facing_;
    glm::dvec3 low_, high_; ///< around them, patch frame
    std::optional<PatchGrids> grids_;
    std::array<std::size_t, grid_directions + 1> first_band_{}; ///< of each direction, among all bands
    std::vector<std::uint32_t> first_of_band_; ///< start of each band in `of_bands_`, and the end
    std::vector<std::uint32_t> of_bands_;      ///< indices into `facing_`
    GridBand band_;
    relief::DirectionBlocks blocks_;
    Roughness roughness_;
    bool is_refined_ = false;
    double texel_m_ = 0.0;
    PatchRelief made_;
};

/// The views of all cameras, in pictures with a pixel a texel.
[[nodiscard]] CameraViews camera_views_for(const TriangleWorld& world, const Hemisphere& hemisphere,
                                           const PatchLimits& limits);

/// Makes a patch at once.
[[nodiscard]] PatchRelief make_patch_relief(const TriangleWorld& world, const Hemisphere& hemisphere,
                                            std::size_t patch, const PatchLimits& limits);

} // namespace frustumscreen::ldi
