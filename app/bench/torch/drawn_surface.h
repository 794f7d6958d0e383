/// The surface that a scene of `frustumscreen-bench torch` draws, for rays: its levels' triangles, and its reliefs as they are
/// rasterized.
///
/// A shadow is therefore compared with the drawn surfaces that cast and receive it. Other commands measure how far
/// these surfaces are from the source.
///
/// Frames   prop. Set-up in 64-bit; Embree (float, robust) only finds the hit.
/// Threads  const; any.
/// Errors   none.
#pragma once

#include "app/geometry/collineation.h"
#include "app/scene/frame_plan.h"

#include <glm/glm.hpp>

#include <memory>
#include <span>
#include <vector>

namespace frustumscreen::bench {

class DrawnSurface {
public:
    /// `parts`: their levels must outlive the surface.
    explicit DrawnSurface(std::span<const scene::Part> parts);
    ~DrawnSurface();
    DrawnSurface(DrawnSurface&&) noexcept;
    DrawnSurface& operator=(DrawnSurface&&) = delete;

    struct Hit {
        bool hit = false;
        double distance_m = 0.0;
        glm::dvec3 point_m{0.0};
        glm::dvec3 normal{0.0}; ///< unit, outward
    };
    /// First hit of origin + t direction, t > 0. Triangles stop a ray from both sides, reliefs from their front
    /// alone, as they are drawn.
    [[nodiscard]] Hit first_hit(const glm::dvec3& origin, const glm::dvec3& direction) const;

private:
    struct Solid;
    std::vector<std::unique_ptr<const Solid>> solids_;
};

} // namespace frustumscreen::bench
