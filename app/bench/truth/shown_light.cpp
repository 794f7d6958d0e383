#include "app/bench/truth/shown_light.h"

#include "app/settings/light_range.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen {

namespace {

/// How many pixels a real lens has there for one of the ideal one's; by differences of its rays.
double pixel_density(const Pinhole& pinhole, const glm::dvec2& pixel) {
    constexpr double step_px = 0.01;
    const glm::dvec2 right(step_px, 0.0);
    const glm::dvec2 down(0.0, step_px);
    const glm::dvec3 u = pinhole.ray(pixel + right) - pinhole.ray(pixel - right);
    const glm::dvec3 v = pinhole.ray(pixel + down) - pinhole.ray(pixel - down);
    const double ideal_px = pinhole.fx * pinhole.fy * (u.x * v.y - u.y * v.x);
    return 4.0 * step_px * step_px / ideal_px;
}

} // namespace

double shown_gain(const ShownLight& light, const PropShape& prop, const glm::dvec3& projector_m,
                  const Pinhole& pinhole, const LitPlace& place) {
    const auto face = static_cast<std::size_t>(place.face);
    const double received = received_light(prop.faces[face].plane, place.point_m, projector_m);
    const double full = light.reference / (received * pixel_density(pinhole, place.pixel));
    return light.exposure * light.most[face] * std::min(1.0, full);
}

} // namespace frustumscreen
