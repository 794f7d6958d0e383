/// One chart while it grows: the plane that its triangles are projected on, and the surface that each texel
/// shows.
///
/// Frames   in: box. In its plane, one unit is a texel.
/// Threads  one caller.
#pragma once

#include "app/image/image.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>

namespace frustumscreen::bake {

using TriangleCorners = std::array<glm::vec3, 3>;

class Chart {
public:
    /// `direction`: unit, pointing out of the surface.
    Chart(const glm::vec3& direction, float texel_box);

    [[nodiscard]] glm::vec2 project(const glm::vec3& p) const {
        return {glm::dot(p, axis_u_), glm::dot(p, axis_v_)};
    }
    /// Takes the triangle if the cosine between its normal and the chart's direction is at least
    /// `min_facing`, it overlaps no other triangle of its mesh, and it is within `stray_box` of other
    /// meshes' surfaces at its position. Returns true if it was taken.
    [[nodiscard]] bool take(const TriangleCorners& corners, std::uint32_t mesh, float stray_box,
                            float min_facing);

private:
    struct Texel {
        float height = 0.0F;    ///< of the surface along the direction
        std::uint32_t mesh = 0; ///< that was here last, from 1; 0: none
    };

    void reach(const glm::ivec2& low, const glm::ivec2& high);

    glm::vec3 axis_u_, axis_v_, direction_;
    glm::ivec2 origin_{0}; ///< of `texels_`
    image::Image<Texel> texels_;
};

} // namespace frustumscreen::bake
