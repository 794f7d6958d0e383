/// The pixels that a torch may light: of a mesh those of its triangles that both the torch and the eye see from the front and that
/// meet the beam; of what has no triangles those of small parts of its box.
///
/// Conservative: every pixel of a surface in the beam is in the tiles, but for surfaces turned away from the torch, which it does
/// not light.
///
/// Frames   as frame_plan.h; planes: in the frame that they were made for.
/// Threads  pure; any. Allocates nothing.
#pragma once

#include "app/scene/frame_plan.h"

#include <array>
#include <cstddef>
#include <span>

namespace frustumscreen::scene {

/// The half spaces a.X + d >= 0 of a beam: before the torch, across the axis at its reach, the four sides of its rectangle, and for
/// a round one four more, around the ellipse. `a` is a unit vector in the torch's frame, so a.X + d is in metres.
class BeamPlanes {
public:
    static constexpr std::size_t max_count = 10;

    BeamPlanes(const torch::Beam& beam, const glm::dmat4& torch_from_frame);
    [[nodiscard]] std::span<const glm::dvec4> planes() const { return std::span(planes_).first(count_); }
    /// False only if no point of the sphere is lit; `radius_m` in metres.
    [[nodiscard]] bool may_light(const glm::dvec3& centre, double radius_m) const;

private:
    std::array<glm::dvec4, max_count> planes_{};
    std::size_t count_ = 0;
};

/// A level seen through a face of the prop.
struct LitDraw {
    const PlacedLevel& level;
    const Draw& draw;
    const torch::Beam& beam;
    glm::dmat4 torch_from_prop{1.0};
    glm::dvec3 eye_in_prop{0.0};
    const geometry::Pinhole& pinhole;
};
/// Adds the draw's pixels that the beam may light to `tiles`, and returns the rectangle around them.
PixelRectangle light_tiles(const LitDraw& lit, LitTiles& tiles);

} // namespace frustumscreen::scene
