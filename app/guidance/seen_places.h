/// The places of a prop's face through which an eye sees an artifact, and whether a part of the face holds any of them.
///
/// The artifact is given by the corners of its convex hull, the part of the face is a convex polygon. A place is seen through
/// where the ray from the eye through it meets the hull: the question is whether two cones with their apex in the eye meet. They
/// do not where a plane through the eye lies between them, and then there is one that goes through a corner of the polygon
/// and touches the hull: so all such planes are tried, and the answer is exact.
///
/// Frame    one for all, the prop's for instance.
/// Cost     mostly one pass over the hull, as far as the first corner that is seen; else two for each corner of the polygon.
/// Threads  pure; any. Allocates nothing.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <span>

namespace frustumscreen {

/// A part of a face: the face clipped by a few planes. Its corners are in order; fewer than 3 are nothing.
class FacePart {
public:
    FacePart() = default;
    explicit FacePart(std::span<const glm::dvec3> corners) {
        for (const glm::dvec3& corner : corners) {
            add(corner);
        }
    }
    /// The points with dot(inward, point) >= offset.
    [[nodiscard]] FacePart clipped(const glm::dvec3& inward, double offset) const;
    [[nodiscard]] bool empty() const { return count_ < 3; }
    [[nodiscard]] std::span<const glm::dvec3> corners() const { return std::span(corners_).first(count_); }

private:
    void add(const glm::dvec3& corner) {
        if (count_ < corners_.size()) {
            corners_.at(count_++) = corner;
        }
    }
    std::array<glm::dvec3, 16> corners_{};
    std::size_t count_ = 0;
};

/// Whether the eye sees any of the hull through the part. The eye is before the face and outside the hull.
[[nodiscard]] bool sees_through(const glm::dvec3& eye, const FacePart& part,
                                std::span<const glm::dvec3> hull);

/// The hull in the picture of a pinhole at the eye that looks along `forward` (unit); its plane is one away.
class SeenOutline {
public:
    static constexpr std::size_t max_corners = 1024; ///< of the hull; of more nothing is seen

    SeenOutline(const glm::dvec3& eye, const glm::dvec3& forward, std::span<const glm::dvec3> hull);
    /// The area in that picture of what is seen through a part of a face.
    [[nodiscard]] double area_through(const FacePart& part) const;

private:
    glm::dvec3 eye_;
    glm::dvec3 forward_;
    std::array<glm::dvec2, 2 * max_corners> outline_; ///< convex, counter-clockwise; as many as `count_`
    std::size_t count_ = 0;
};

} // namespace frustumscreen
