#include "app/simulation/visitor_screen.h"

#include "app/simulation/sampled_light.h"

#include <cmath>
#include <numbers>

namespace frustumscreen::simulation {

namespace {

/// The lit area's frame: x to the right, y down, both 0..1 within it.
struct Panel {
    explicit Panel(const VisitorScreen& screen)
        : corner_m(screen.corners_m[0]), across_m(screen.corners_m[1] - screen.corners_m[0]),
          down_m(screen.corners_m[3] - screen.corners_m[0]),
          normal(glm::normalize(glm::cross(down_m, across_m))) {}
    [[nodiscard]] glm::dvec3 place(const glm::dvec2& at) const {
        return corner_m + at.x * across_m + at.y * down_m;
    }

    glm::dvec3 corner_m, across_m, down_m;
    glm::dvec3 normal; ///< out of its front
};

constexpr glm::ivec2 light_parts(8, 5);

} // namespace

std::optional<ScreenHit> meet(const VisitorScreen& screen, const glm::dvec3& origin,
                              const glm::dvec3& direction) {
    const Panel panel(screen);
    const double toward = glm::dot(panel.normal, direction);
    const double t = glm::dot(panel.normal, panel.corner_m - origin) / toward;
    if (!(t > 0.0) || toward == 0.0) {
        return std::nullopt;
    }
    const glm::dvec3 from_corner = origin + t * direction - panel.corner_m;
    const glm::dvec2 size(glm::length(panel.across_m), glm::length(panel.down_m));
    const glm::dvec2 at(glm::dot(from_corner, panel.across_m) / size.x,
                        glm::dot(from_corner, panel.down_m) / size.y);
    const auto within = [&](double rim_m) {
        return glm::all(glm::greaterThanEqual(at, glm::dvec2(-rim_m))) &&
               glm::all(glm::lessThan(at, size + rim_m));
    };
    if (!within(screen.rim_m)) {
        return std::nullopt;
    }
    const bool front = toward < 0.0;
    return ScreenHit{.t = t,
                     .normal = front ? panel.normal : -panel.normal,
                     .shines = front && within(0.0),
                     .pixel = at / size * glm::dvec2(screen.picture.width, screen.picture.height)};
}

ScreenLight::ScreenLight(const VisitorScreen& screen) {
    const Panel panel(screen);
    normal_ = panel.normal;
    part_m2_ = glm::length(panel.across_m) * glm::length(panel.down_m) / (light_parts.x * light_parts.y);
    constexpr int samples = 6; // along each side of a part
    for (int k = 0; k < light_parts.x * light_parts.y; ++k) {
        const glm::dvec2 corner(k % light_parts.x, k / light_parts.x);
        glm::dvec3 sum(0.0);
        for (int s = 0; s < samples * samples; ++s) {
            const glm::dvec2 inside(s % samples + 0.5, s / samples + 0.5);
            const glm::dvec2 at = (corner + inside / double{samples}) / glm::dvec2(light_parts);
            sum +=
                linear_at(screen.picture, at * glm::dvec2(screen.picture.width, screen.picture.height), true);
        }
        parts_.push_back({.middle_m = panel.place((corner + 0.5) / glm::dvec2(light_parts)),
                          .light = screen.white * sum / double{samples * samples}});
    }
}

glm::dvec3 ScreenLight::on(const glm::dvec3& point_m, const glm::dvec3& normal) const {
    glm::dvec3 sum(0.0);
    for (const Part& part : parts_) {
        const glm::dvec3 away = part.middle_m - point_m;
        const double d2 = glm::dot(away, away) + part_m2_; // near the screen a part is no point
        const double leaves = -glm::dot(normal_, away);
        const double arrives = glm::dot(normal, away);
        if (leaves > 0.0 && arrives > 0.0) {
            sum += part.light * (leaves * arrives * part_m2_ / (std::numbers::pi * d2 * d2));
        }
    }
    return sum;
}

} // namespace frustumscreen::simulation
