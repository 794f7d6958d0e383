/// Compares the hit points drawn by the renderer with those of a ray cast.
#pragma once

#include "app/image/image.h"
#include "firmware_host/display/egl_context.h"
#include "tests/render/reference_cast.h"

#include <GLES3/gl31.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace frustumscreen::synthetic {

struct Comparison {
    std::size_t both = 0;
    std::size_t mismatched = 0; ///< hit in only one of the two
    std::size_t unexcused = 0;  ///< of these, far from any outline
    /// Over pixels hit in both whose neighbourhood is smooth: the distance between the two points, minus the
    /// true point's movement within a step of the rasterizer's grid.
    double worst_mm = 0.0;
};

/// The length of such a step, in pixels: a GPU snaps each vertex, with its attributes, to the nearest point
/// of that grid (NVIDIA's does; OpenGL ES 3.1, 2.5.9 and 13.2). Mesa's llvmpipe snaps only outlines, so it
/// gets no tolerance here.
inline double grid_step_px() {
    GLint bits = 4;
    glGetIntegerv(GL_SUBPIXEL_BITS, &bits);
    return display::draws_on_processor(display::gl_driver_name()) ? 0.0 : std::ldexp(1.0, -bits);
}

/// How far the true point moves when the pixel's centre moves by `step_px`: the maximum over eight
/// directions.
template <typename Cast>
double moves_mm(const Cast& cast, const TestTable& table, const glm::dvec2& centre,
                const ReferenceCast::Hit& truth, double step_px) {
    double most = 0.0;
    for (int k = 0; k < 8; ++k) {
        const double angle = k * std::numbers::pi / 4.0;
        const ReferenceCast::Hit near =
            cast.through_pixel(table, centre + step_px * glm::dvec2(std::cos(angle), std::sin(angle)));
        if (near.found) {
            most = std::max(most, 1e3 * glm::distance(near.point, truth.point));
        }
    }
    return most;
}

/// A pixel is excused if rays close to it disagree too: the rasterizer rounds to 1/256 pixel.
template <typename Cast>
bool grazes(const Cast& cast, const TestTable& table, const glm::dvec2& centre,
            const ReferenceCast::Hit& truth) {
    constexpr double hair = 1.0 / 64.0;
    for (int k = 0; k < 8; ++k) {
        const double angle = k * std::numbers::pi / 4.0;
        const ReferenceCast::Hit near =
            cast.through_pixel(table, centre + hair * glm::dvec2(std::cos(angle), std::sin(angle)));
        if (near.found != truth.found || (truth.found && glm::distance(near.point, truth.point) > 2e-3)) {
            return true;
        }
    }
    return false;
}

template <typename Cast>
Comparison compare(const TestTable& table, const Cast& cast, const image::ImageFloat& drawn) {
    Comparison result;
    for (int y = 0; y < drawn.height; ++y) {
        for (int x = 0; x < drawn.width; ++x) {
            const glm::dvec2 centre(x + 0.5, y + 0.5);
            const ReferenceCast::Hit truth = cast.through_pixel(table, centre);
            const glm::vec3& point = drawn.at(x, y);
            const bool hit = !std::isnan(point.x);
            if (hit != truth.found) {
                ++result.mismatched;
                result.unexcused += grazes(cast, table, centre, truth) ? 0U : 1U;
            } else if (hit) {
                ++result.both;
                double mm = 1e3 * glm::distance(glm::dvec3(point), truth.point);
                if (mm > result.worst_mm && !grazes(cast, table, centre, truth)) {
                    mm -= moves_mm(cast, table, centre, truth, grid_step_px());
                    result.worst_mm = std::max(result.worst_mm, mm);
                }
            }
        }
    }
    return result;
}

} // namespace frustumscreen::synthetic
