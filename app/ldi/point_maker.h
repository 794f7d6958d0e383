/// Makes the patches of a frozen window as points, in small steps: first the patch that is looked at, then the others by their
/// angle from there.
///
/// Frames   window (triangle_world.h).
/// Units    metres, pixels.
/// Threads  one at a time. A finished patch is immutable; any thread.
/// Memory   the world; two numbers a pixel for each camera that patches still need; the finished patches, up to `max_bytes`.
/// Errors   none: beyond `max_bytes` the patches that are left are not made.
#pragma once

#include "app/ldi/patch_layers.h"
#include "app/ldi/patch_order.h"
#include "app/ldi/point_patch.h"
#include "app/ldi/seen_points.h"
#include "app/ldi/triangle_rasterizer.h"
#include "app/ldi/triangle_world.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace frustumscreen::ldi {

class PointMaker {
public:
    /// The worlds stand together behind the window. `first_number`: PointPatch::number of patch 0; the others' follow.
    PointMaker(std::vector<TriangleWorld> worlds, const Hemisphere& hemisphere, const CameraView& view,
               std::uint64_t max_bytes, std::uint64_t first_number = 1);
    PointMaker(const PointMaker&) = delete;
    PointMaker& operator=(const PointMaker&) = delete;

    /// Puts the patch of this eye first. If it is not made yet, another one that is being made is given up; its cameras' pictures
    /// stay.
    void look_from(const glm::dvec3& eye);
    /// Does a piece of work: about `triangles` triangles, or one picture. False once all patches are made, or the
    /// memory is used up.
    bool step(std::size_t triangles = 20'000);

    /// Null before it is made.
    [[nodiscard]] std::shared_ptr<const PointPatch> patch(std::size_t number) const {
        return patches_[number];
    }
    [[nodiscard]] std::size_t made_count() const;
    /// Memory of all that it holds, with patches that are still in use elsewhere and without the worlds.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    [[nodiscard]] std::array<bool, patch_count> made() const;
    /// Draws a part of a picture that the patch needs; false: it has them all.
    bool draw_part(std::size_t triangles);
    void begin_picture(std::size_t camera);
    void end_world();
    void begin_merging();
    void finish();

    std::vector<TriangleWorld> worlds_;
    PatchOrder order_;
    CameraView view_;
    std::uint64_t max_bytes_, first_number_;
    TriangleRasterizer rasterizer_;
    std::array<std::unique_ptr<DepthPicture>, camera_count>
        pictures_;                              ///< null: not drawn, or not needed any more
    std::unique_ptr<DepthPicture> drawing_;     ///< the picture that is being drawn
    std::size_t camera_ = 0;                    ///< its camera
    std::size_t world_ = 0, next_triangle_ = 0; ///< of it
    std::optional<std::size_t> building_;       ///< the patch that is being made
    std::optional<LayerMerger> merger_;
    std::optional<SeenPoints> seen_; ///< after merging
    std::size_t merged_ = 0;         ///< pictures
    std::array<std::shared_ptr<const PointPatch>, patch_count> patches_;
    bool is_full_ = false;
};

} // namespace frustumscreen::ldi
