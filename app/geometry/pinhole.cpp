#include "app/geometry/pinhole.h"

#include <cmath>

namespace frustumscreen::geometry {

std::optional<glm::dvec2> Pinhole::pixel(const glm::dvec3& point) const {
    if (!(point.z > 0.0)) {
        return std::nullopt;
    }
    if (lens.is_plain()) {
        return glm::dvec2(fx * point.x / point.z + cx, fy * point.y / point.z + cy);
    }
    const std::optional<glm::dvec2> bent = lens.distort({point.x / point.z, point.y / point.z});
    return bent ? std::optional(glm::dvec2(fx * bent->x + cx, fy * bent->y + cy)) : std::nullopt;
}

glm::dvec3 Pinhole::ray(const glm::dvec2& pixel) const {
    const glm::dvec2 bent((pixel.x - cx) / fx, (pixel.y - cy) / fy);
    return {lens.is_plain() ? bent : lens.undistort(bent).value_or(bent), 1.0};
}

Pinhole Pinhole::ideal() const {
    Pinhole same = *this;
    same.lens = {};
    return same;
}

double Pinhole::farthest_r2() const {
    double r2 = 0.0;
    for (const glm::dvec2& corner :
         {glm::dvec2(0, 0), glm::dvec2(width, 0), glm::dvec2(width, height), glm::dvec2(0, height)}) {
        const glm::dvec2 direction(ray(corner));
        r2 = std::fmax(r2, glm::dot(direction, direction));
    }
    return r2;
}

void Pinhole::bend_around(glm::dvec2& low, glm::dvec2& high) const {
    if (lens.is_plain() || !(low.x <= high.x && low.y <= high.y)) {
        return;
    }
    const glm::dvec2 centre(cx, cy);
    const glm::dvec2 focal(fx, fy);
    low = (low - centre) / focal;
    high = (high - centre) / focal;
    const glm::dvec2 far = glm::max(glm::abs(low), glm::abs(high));
    const auto [below, most] = lens.factors_within(glm::dot(far, far));
    const double least = std::fmax(below, 0.0); // a negative factor is never drawn
    low = glm::min(low * least, low * most) * focal + centre;
    high = glm::max(high * least, high * most) * focal + centre;
}

Pinhole Pinhole::scaled_to(int new_width, int new_height) const {
    const double sx = static_cast<double>(new_width) / width;
    const double sy = static_cast<double>(new_height) / height;
    return {.width = new_width,
            .height = new_height,
            .fx = fx * sx,
            .fy = fy * sy,
            .cx = cx * sx,
            .cy = cy * sy,
            .lens = lens};
}

glm::dmat4 Pinhole::clip_from_point() const {
    // clip.x / clip.w = 2 u / width - 1, with w = Z.
    glm::dmat4 clip(0.0);
    clip[0][0] = 2.0 * fx / width;
    clip[2][0] = 2.0 * cx / width - 1.0;
    clip[1][1] = 2.0 * fy / height;
    clip[2][1] = 2.0 * cy / height - 1.0;
    clip[2][3] = 1.0;
    return clip;
}

} // namespace frustumscreen::geometry
