/// The profile of a turned body: a smooth curve in the (radius, height) half-plane.
///
/// Frame    millimetres. The body is to the left of the curve's direction, its normal points to the right.
///          Curves run upwards on the outside and downwards on the inside.
/// Threads  immutable; any.
/// Method   centripetal Catmull-Rom spline between corners, as a dense polyline with arc lengths.
#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace frustumscreen::artifacts {

struct ProfileKnot {
    double radius = 0.0;
    double height = 0.0;
    bool corner = false; ///< the curve may bend sharply here
};

class Profile {
public:
    explicit Profile(const std::vector<ProfileKnot>& knots);

    struct Point {
        glm::dvec2 position{0.0}; ///< radius, height
        glm::dvec2 normal{1.0, 0.0};
        double length_mm = 0.0; ///< along the curve from its start
    };
    [[nodiscard]] double length_mm() const { return points_.back().length_mm; }
    [[nodiscard]] Point at_length(double length_mm) const;
    /// The point at `row`, 0..1 along the curve; rows are denser where it bends.
    [[nodiscard]] Point at_row(double row) const;
    /// The length at which a rising curve first reaches `height`.
    [[nodiscard]] double length_at_height(double height) const;

private:
    [[nodiscard]] Point between(std::size_t index, double fraction) const;
    std::vector<Point> points_;
    std::vector<double> rows_; ///< 0..1, one per point
};

} // namespace frustumscreen::artifacts
