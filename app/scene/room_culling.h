/// Which objects of a room the picture of a flat screen can show: those in the eye's pyramid through the screen that no
/// solid before them hides.
///
/// Hidden   a grid of tiles holds, for each tile that a solid box covers wholly, how near the box is at the least anywhere in
///          it. An object is hidden if each tile that its box meets holds something nearer than all of the object. Solids are
///          joined by tiles only: two that cover one tile together hide nothing there.
/// Safe     an object that any pixel would show is never left out: an object counts as `slack_px` larger than it is, and a
///          solid as smaller by that. So what is drawn may be off by as much.
/// Frames   table T; metres. Depth is along the screen's normal, from the eye.
/// Threads  values; one caller. Allocates nothing after the constructor.
/// Source   hierarchical occlusion: Zhang et al. 1997, "Visibility culling using hierarchical occlusion maps", with boxes as
///          occluders and one level of tiles.
#pragma once

#include "app/scene/flat_screen.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace frustumscreen::scene {

/// The corners of a parallelepiped: bit 0 of the index tells the two ends of its first edge apart, bit 1 those of its
/// second, bit 2 those of its third.
using BoxCorners = std::array<glm::dvec3, 8>;

class RoomCulling {
public:
    static constexpr int tile_px = 16;
    static constexpr double slack_px = 2.0;

    explicit RoomCulling(const FlatScreen& screen);

    /// Forgets all solids. An eye that is not before the screen sees nothing.
    void begin(const glm::dvec3& eye_m);

    /// False if the ball lies outside the eye's pyramid.
    [[nodiscard]] bool in_view(const glm::dvec3& centre_m, double radius_m) const;
    /// False if the box lies outside one side of the eye's pyramid.
    [[nodiscard]] bool in_view(const BoxCorners& box_m) const;

    /// The box is wholly inside a solid that is drawn and closed, and the eye outside that solid.
    void add_solid(const BoxCorners& box_m);
    /// True if solids hide all of the box.
    [[nodiscard]] bool is_hidden(const BoxCorners& box_m) const;

private:
    /// Pixels; `z` is the depth.
    [[nodiscard]] glm::dvec3 from_eye(const glm::dvec3& point_m) const;
    /// A range of tiles, the last ones excluded.
    struct TileRange {
        int left = 0, right = 0, top = 0, bottom = 0;
    };
    struct Seen {
        TileRange tiles;
        double nearness = 0.0; ///< the largest 1 / depth; infinite if a corner is not before the eye
    };
    [[nodiscard]] Seen seen(const BoxCorners& box_m) const;

    glm::dvec3 corner_m_; ///< top left
    glm::dvec3 right_{1.0, 0.0, 0.0}, down_{0.0, 0.0, 1.0}, into_{0.0, 1.0, 0.0};
    glm::dvec2 pixels_per_m_{1.0};
    glm::dvec2 size_px_{1.0};
    int columns_ = 0, rows_ = 0;
    glm::dvec3 eye_m_{0.0};
    double before_m_ = 0.0;     ///< from the eye to the screen
    glm::dvec2 middle_px_{0.0}; ///< of what is straight before the eye
    glm::dvec2 focal_px_{1.0};
    std::array<glm::dvec3, 4> sides_{}; ///< inward normals of the pyramid's sides, unit
    std::vector<double> nearness_;      ///< of each tile, row by row; 0: nothing covers it
};

/// The corners of a box in its own frame, moved by an affine transform.
[[nodiscard]] BoxCorners corners_of(const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& to_from);

} // namespace frustumscreen::scene
