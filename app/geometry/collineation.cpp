#include "app/geometry/collineation.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace frustumscreen::geometry {

glm::dmat4 eye_onto_plane(const Plane& plane, const glm::dvec3& eye) {
    const glm::dvec3& n = plane.normal;
    const double e = plane.distance(eye);
    glm::dmat4 m(0.0);
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            m[column][row] = (row == column ? e : 0.0) - eye[row] * n[column];
        }
        m[column][3] = -n[column];
    }
    m[3] = glm::dvec4(plane.offset * eye, e + plane.offset);
    return m;
}

namespace {

/// The range of w over some points: w <= 0 is above the eye or behind the projector, where nothing is drawn.
struct Range {
    double least = std::numeric_limits<double>::infinity(), greatest = 0.0;
};
Range w_range(const glm::dmat4& clip, std::span<const glm::dvec3> points) {
    Range range;
    for (const glm::dvec3& point : points) {
        const double w = (clip * glm::dvec4(point, 1.0)).w;
        range = {std::fmin(range.least, w), std::fmax(range.greatest, w)};
    }
    return range;
}

} // namespace

std::optional<glm::dmat4> collineation(const Plane& plane, const glm::dvec3& eye,
                                       const glm::dmat4& projector_clip_from_frame, const Box& box) {
    const glm::dvec3 centre = (box.low + box.high) * 0.5;
    const double eye_height = plane.distance(eye);
    if (!(eye_height > min_sine * glm::distance(eye, centre))) {
        return std::nullopt;
    }
    glm::dmat4 clip = projector_clip_from_frame * eye_onto_plane(plane, eye);
    std::array<glm::dvec3, 8> corners{};
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
        corners[corner] = {(corner & 1U) != 0 ? box.high.x : box.low.x,
                           (corner & 2U) != 0 ? box.high.y : box.low.y,
                           (corner & 4U) != 0 ? box.high.z : box.low.z};
    }
    const auto [least, greatest] = w_range(clip, corners);
    if (!(greatest > 0.0) || !std::isfinite(greatest)) {
        return std::nullopt;
    }
    // z/w = a + b/w with z/w = -1 at `near` and +1 at `far`; the margins keep the box off the clip planes.
    const double margin = std::fmax(0.01 * (greatest - std::fmax(least, 0.0)), 1e-3 * greatest);
    const double far = greatest + margin;
    const double near = std::fmax(least - margin, far * 1e-3);
    const double b = 2.0 / (1.0 / far - 1.0 / near);
    const double a = 1.0 - b / far;
    for (int column = 0; column < 4; ++column) {
        clip[column][2] = a * clip[column][3];
    }
    clip[3][2] += b;
    return clip * (1.0 / greatest);
}

std::optional<glm::dmat4> collineation_behind(const Plane& plane, const glm::dvec3& eye,
                                              const glm::dmat4& projector_clip_from_frame,
                                              std::span<const glm::dvec3> corners) {
    glm::dvec3 centre(0.0);
    for (const glm::dvec3& corner : corners) {
        centre += corner / static_cast<double>(corners.size());
    }
    const double eye_height = plane.distance(eye);
    if (!(eye_height > min_sine * glm::distance(eye, centre))) {
        return std::nullopt;
    }
    glm::dmat4 clip = projector_clip_from_frame * eye_onto_plane(plane, eye);
    const auto [least, greatest] = w_range(clip, corners);
    if (!(least > 0.0) || !std::isfinite(greatest)) {
        return std::nullopt;
    }
    constexpr double below_far_end = 0.999;
    const double k = below_far_end * 2.0 * least / eye_height;
    const glm::dvec4 behind(-plane.normal, plane.offset);
    for (int column = 0; column < 4; ++column) {
        clip[column][2] = k * behind[column] - clip[column][3];
    }
    return clip * (1.0 / greatest);
}

} // namespace frustumscreen::geometry
