/// The attenuation of a torch's light at the corners of triangles, which are split until linear interpolation is good
/// enough: Francken 2007. The exhibit itself has the attenuation at each pixel; `frustumscreen-bench torch` compares them.
///
/// Culling  each corner has an outcode (Cohen-Sutherland): a bit for each half space of the beam's frustum, by the signs
///          of (s, t, q) = (x / half width, y / half height, z), that it lies outside of. A triangle whose corners share
///          a bit is left out, and so is each half of a split one.
/// Length   the paper's heuristic: the longest edge is halved until none is longer than the tolerance. Whether an edge
///          is halved depends on that edge alone, so both of its triangles halve it at the same points: no T-junctions.
/// Bound    the curvature heuristic: the edge of the largest bound is halved until the triangle's bound is below a
///          tolerance of intensity. Let f(x) = I(|x|), u the unit direction of an edge of length L, r = |x| and
///          c = x.u / r. Its second derivative along u is D = I''(r) c^2 + (I'(r) / r) (1 - c^2):
///              InverseSquare   D = full^2 (8 c^2 - 2) / r^4
///              Linear          D = -(1 - c^2) / (r (dark - full))
///              SmoothStep      D with I' = -6 t (1 - t) / (dark - full), I'' = (12 t - 6) / (dark - full)^2
///          On a line of that direction inside the triangle, linear interpolation errs by at most B = L^2 / 8 max |D|,
///          the maximum over the triangle's own distances and angles. Where the slope jumps by J, at `full_m` and
///          `dark_m`, it errs by J |c| L / 4 more, and a line meets that sphere twice: K. A point of weight w for one
///          corner lies on a line parallel to the opposite edge, (1 - w) L long, between points of the two other edges
///          of weights w and 1 - w, so it errs by at most (1 - w)^2 B + (1 - w) K + 4 w (1 - w) (B + K) with the largest
///          B and K of the three: 4/3 B, and 25/16 (B + K) where there are jumps. It bounds the attenuation alone: at
///          the beam's edge and reach the light ends at once. Two triangles may halve a common edge differently; their
///          intensities there differ by twice the tolerance at most, and their places by rounding alone.
///
/// Frames   torch: torch.h. A corner's `place` is in any frame that an affine transform takes the torch's to.
/// Units    metres; intensity 0..1.
/// Threads  pure; any. `split` allocates only as its list grows.
/// Errors   none: a full list takes triangles unsplit.
/// Source   Francken, Huysmans & Bekaert 2007, section 2; the bound is ours, which its section 5 asks for.
#pragma once

#include "app/torch/torch.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace frustumscreen::torch {

/// The half spaces that a point lies outside of; 0: it lies in the frustum.
using Outcode = std::uint8_t;
inline constexpr Outcode left_of = 1, right_of = 2, above = 4, below = 8, behind = 16, beyond = 32;

struct MeshCorner {
    glm::dvec3 point_torch{0.0};
    glm::dvec3 place{0.0};
    double intensity = 0.0; ///< by distance alone
    Outcode outcode = 0;
};
using MeshTriangle = std::array<MeshCorner, 3>;

/// For the renderer, which interpolates the intensity.
struct LitCorner {
    glm::vec3 place{0.0F};
    float intensity = 0.0F;
};

struct Splitting {
    enum class By : std::uint8_t { Length, Bound };
    By by = By::Length;
    double tolerance = 0.005;                                            ///< metres, or intensity
    std::size_t max_triangles = std::numeric_limits<std::size_t>::max(); ///< of the list
};

class TriangleSplitter {
public:
    explicit TriangleSplitter(const Beam& beam);

    [[nodiscard]] MeshCorner corner(const glm::dvec3& point_torch, const glm::dvec3& place) const;
    /// Bound of the error of interpolating the attenuation over the triangle.
    [[nodiscard]] double max_error(const MeshTriangle& triangle) const;
    /// Appends three corners for each part that may be lit, turned as the triangle is.
    void split(const MeshTriangle& triangle, const Splitting& splitting, std::vector<LitCorner>& lit) const;

private:
    struct Bound {
        double error = 0.0;
        std::size_t edge = 0; ///< of the largest part; it begins at this corner
    };
    [[nodiscard]] MeshCorner middle(const MeshCorner& a, const MeshCorner& b) const;
    [[nodiscard]] Bound bound_of(const MeshTriangle& triangle) const;
    void split(const MeshTriangle& triangle, const Splitting& splitting, int depth,
               std::vector<LitCorner>& lit) const;

    Beam beam_;
    glm::dvec2 per_half_extent_;
    double reach_m_;
};

/// Steers a tolerance so that frames take a given time: the paper's, 'striving for a stable frame rate and a maximal
/// projection quality every frame'. The number of triangles is proportional to 1 / tolerance^2.
class ToleranceControl {
public:
    struct Range {
        double min = 0.0005, max = 0.1;
    };
    ToleranceControl(double frame_ms, double tolerance, const Range& range)
        : frame_ms_(frame_ms), tolerance_(tolerance), range_(range) {}

    [[nodiscard]] double tolerance() const { return tolerance_; }
    /// The latest frame took `ms`; returns the next frame's tolerance. A time that is not above 0 changes nothing.
    double next(double ms);

private:
    double frame_ms_, tolerance_;
    Range range_;
};

} // namespace frustumscreen::torch
