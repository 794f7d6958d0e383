/// The places of a prop's face through which an eye sees an artifact, and a test whether a part of the face contains
/// one.
///
/// The artifact is given by the corners of its convex hull; the part of the face is a convex polygon. The artifact is
/// seen through a place if the ray from the eye through it meets the hull. The test is whether two cones with their
/// apex in the eye meet. They do not if a plane through the eye separates them; then there is also a separating plane
/// that passes through a corner of the polygon and touches the hull. All these planes are tried, so the answer is
/// exact.
///
/// Frame    any, the same for all arguments.
/// Cost     mostly one pass over the hull, up to the first corner that is seen; otherwise two for each corner of the
///          polygon.
/// Threads  pure; any. Allocates nothing.
#pragma once

#include "app/geometry/per_corner.h"
#include "app/geometry/prop_shape.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <span>

namespace frustumscreen::guidance {

/// A part of a face: the face clipped by several planes. Its corners are in order; fewer than 3 make it empty.
class FacePart {
public:
    /// Each of the picture's four edges adds a corner at most; one is spare, for rounding.
    static constexpr std::size_t max_corners = geometry::max_face_corners + 5;

    FacePart() = default;
    explicit FacePart(std::span<const glm::dvec3> corners) {
        for (const glm::dvec3& corner : corners) {
            add(corner);
        }
    }
    /// The part with dot(inward, point) >= offset.
    [[nodiscard]] FacePart clipped(const glm::dvec3& inward, double offset) const;
    [[nodiscard]] bool empty() const { return count_ < 3; }
    [[nodiscard]] std::span<const glm::dvec3> corners() const { return std::span(corners_).first(count_); }

private:
    void add(const glm::dvec3& corner) {
        if (count_ < corners_.size()) {
            corners_[count_++] = corner;
        }
    }
    std::array<glm::dvec3, max_corners> corners_{};
    std::size_t count_ = 0;
};

/// True if the eye sees any of the hull through the part. The eye must be in front of the face and outside the hull.
[[nodiscard]] bool sees_through(const glm::dvec3& eye, const FacePart& part,
                                std::span<const glm::dvec3> hull);

/// The hull in the picture of a pinhole at the eye that looks along `forward` (unit); the picture plane is at
/// distance 1.
class SeenOutline {
public:
    static constexpr std::size_t max_corners = 1024; ///< of the hull; a larger hull counts as invisible

    SeenOutline(const glm::dvec3& eye, const glm::dvec3& forward, std::span<const glm::dvec3> hull);
    /// Area in that picture of what is seen through a part of a face.
    [[nodiscard]] double area_through(const FacePart& part) const;
    /// The artifact as it is seen through a face.
    struct Through {
        double share = 0.0;      ///< of all that the eye sees of it, by area in that picture
        double farthest_m = 0.0; ///< from a point to the farthest place of the face through which it is seen
    };
    [[nodiscard]] Through through(const geometry::PropFace& face, const glm::dvec3& point) const;

private:
    /// Calls `use` with the picture's plane, and there the corners of what is seen through the part.
    template <typename Use> void clip_to(const FacePart& part, const Use& use) const;

    glm::dvec3 eye_;
    glm::dvec3 forward_;
    std::array<glm::dvec2, 2 * max_corners> outline_; ///< convex, counter-clockwise; `count_` points
    std::size_t count_ = 0;
};

} // namespace frustumscreen::guidance
