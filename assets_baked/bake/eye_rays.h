/// Rays from eyes all around the viewing zone, with which the bake measures what visitors see.
///
/// Frame    box.
/// Threads  const; any (cast uses all cores).
#pragma once

#include "app/image/image.h"
#include "assets_baked/bake/level.h"
#include "assets_baked/bake/visibility.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <limits>
#include <vector>

namespace frustumscreen::bake {

/// Directions towards the eyes, spread evenly over the zone, except for its edge, where visitors hardly stand: a spiral of
/// golden angles.
[[nodiscard]] std::vector<glm::dvec3> eyes_of(const ViewingZone& zone);

/// The distance of a ray without a hit.
inline constexpr float no_hit = std::numeric_limits<float>::infinity();

/// Rays from one eye on a square grid, through the rectangle around the box in its view.
class EyeRays {
public:
    /// The number of rays is about `rays`.
    EyeRays(const glm::dvec3& towards, const glm::dvec3& box_size, double rays);

    [[nodiscard]] const glm::ivec2& size() const { return size_; }
    /// The distance between neighbouring rays at the artifact.
    [[nodiscard]] double spacing_box() const;
    [[nodiscard]] glm::vec3 direction(int x, int y) const;
    /// The seen patch (pack::SeenEye) of a ray.
    [[nodiscard]] std::size_t patch(int x, int y) const;
    [[nodiscard]] const glm::vec3& eye() const { return eye_; }
    /// The distance along each ray to the surface.
    [[nodiscard]] image::Image<float> cast(const TraceSurface& trace) const;

private:
    glm::ivec2 size_{0};
    double step_ = 0.0;
    glm::vec3 eye_{0.0F}, first_{0.0F}, right_{0.0F}, up_{0.0F};
};

} // namespace frustumscreen::bake
