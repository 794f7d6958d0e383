#include "app/torch/splitting.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::torch {

namespace {

/// Halvings of one triangle, one after the other: an edge of 1 km becomes 15 um.
constexpr int max_depth = 52;

/// The triangle's least distance from the origin (Ericson, Real-Time Collision Detection, 5.1.5).
double min_distance(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const auto to_segment = [](const glm::dvec3& from, const glm::dvec3& to) {
        const glm::dvec3 along = to - from;
        const double square = glm::dot(along, along);
        const double share = square > 0.0 ? std::clamp(-glm::dot(from, along) / square, 0.0, 1.0) : 0.0;
        return glm::length(from + share * along);
    };
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double area = glm::length(normal);
    // The origin's foot lies inside if it is on the inner side of each edge.
    const auto inside = [&](const glm::dvec3& from, const glm::dvec3& to) {
        return glm::dot(glm::cross(to - from, -from), normal) >= 0.0;
    };
    if (area > 0.0 && inside(a, b) && inside(b, c) && inside(c, a)) {
        return std::abs(glm::dot(a, normal)) / area;
    }
    return std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
}

/// From the torch.
struct DistanceRange {
    double min_m = 0.0, max_m = 0.0;
};

/// The largest |x.u| / r and the least, squared, of points whose distances lie in this range.
struct Angles {
    double min = 0.0, max = 1.0;
};
Angles angles_of(double min_along, double max_along, const DistanceRange& distances) {
    const double greatest = max_along / distances.min_m;
    const double least = min_along / distances.max_m;
    return {std::min(1.0, least * least), std::min(1.0, greatest * greatest)};
}

/// |D| of the header, for distances beyond `full_m`.
double max_second_derivative(const Beam& beam, const DistanceRange& distances, const Angles& c2) {
    const double depth_m = beam.dark_m - beam.full_m;
    switch (beam.attenuation) {
    case Attenuation::InverseSquare: {
        const double square = distances.min_m * distances.min_m;
        return beam.full_m * beam.full_m *
               std::max(std::abs(8.0 * c2.min - 2.0), std::abs(8.0 * c2.max - 2.0)) / (square * square);
    }
    case Attenuation::Linear:
        return (1.0 - c2.min) / (distances.min_m * depth_m);
    case Attenuation::SmoothStep: {
        const double from = (distances.min_m - beam.full_m) / depth_m;
        const double to = (distances.max_m - beam.full_m) / depth_m;
        const auto slope = [depth_m](double t) { return 6.0 * t * (1.0 - t) / depth_m; }; // -I'
        const double steepest = slope(std::clamp(0.5, from, to)) / distances.min_m;
        const double flattest = std::min(slope(from), slope(to)) / distances.max_m;
        const auto bend = [depth_m](double t) { return (12.0 * t - 6.0) / (depth_m * depth_m); };
        const auto between = [](double c2_at, double along, double across) {
            return std::abs(c2_at * along + (1.0 - c2_at) * across);
        };
        return std::max({between(c2.min, bend(from), -steepest), between(c2.max, bend(from), -steepest),
                         between(c2.min, bend(to), -flattest), between(c2.max, bend(to), -flattest)});
    }
    case Attenuation::None:
        break;
    }
    return 0.0;
}

/// Distances from the torch at which the slope jumps, and by how much.
struct Jump {
    double distance_m = 0.0, slope = 0.0;
};
std::array<Jump, 2> jumps_of(const Beam& beam) {
    switch (beam.attenuation) {
    case Attenuation::InverseSquare:
        return {{{beam.full_m, 2.0 / beam.full_m}, {}}};
    case Attenuation::Linear: {
        const double slope = 1.0 / (beam.dark_m - beam.full_m);
        return {{{beam.full_m, slope}, {beam.dark_m, slope}}};
    }
    case Attenuation::SmoothStep:
    case Attenuation::None:
        break;
    }
    return {};
}

/// Where the attenuation is smooth and not constant; the range may be empty.
DistanceRange curved_distances(const Beam& beam, const DistanceRange& distances) {
    const bool ends = beam.attenuation == Attenuation::Linear || beam.attenuation == Attenuation::SmoothStep;
    return {std::max(distances.min_m, beam.full_m),
            ends ? std::min(distances.max_m, beam.dark_m) : distances.max_m};
}

} // namespace

TriangleSplitter::TriangleSplitter(const Beam& beam)
    : beam_(beam), per_half_extent_(1.0 / half_extent(beam)), reach_m_(reach_m(beam)) {}

MeshCorner TriangleSplitter::corner(const glm::dvec3& point_torch, const glm::dvec3& place) const {
    const double s = point_torch.x * per_half_extent_.x;
    const double t = point_torch.y * per_half_extent_.y;
    const double q = point_torch.z;
    const auto bit = [](bool outside, Outcode code) { return static_cast<unsigned>(outside ? code : 0); };
    const unsigned code = bit(s < -q, left_of) | bit(s > q, right_of) | bit(t < -q, above) |
                          bit(t > q, below) | bit(q <= 0.0, behind) | bit(q > reach_m_, beyond);
    return {.point_torch = point_torch,
            .place = place,
            .intensity = attenuation_at(beam_, glm::length(point_torch)),
            .outcode = static_cast<Outcode>(code)};
}

MeshCorner TriangleSplitter::middle(const MeshCorner& a, const MeshCorner& b) const {
    return corner(0.5 * (a.point_torch + b.point_torch), 0.5 * (a.place + b.place));
}

TriangleSplitter::Bound TriangleSplitter::bound_of(const MeshTriangle& triangle) const {
    const glm::dvec3& a = triangle[0].point_torch;
    const glm::dvec3& b = triangle[1].point_torch;
    const glm::dvec3& c = triangle[2].point_torch;
    const DistanceRange distances{min_distance(a, b, c),
                                  std::max({glm::length(a), glm::length(b), glm::length(c)})};
    const DistanceRange curved = curved_distances(beam_, distances);
    const std::array<Jump, 2> jumps = jumps_of(beam_);
    Bound bound;
    double largest = 0.0;
    bool has_jump = false;
    for (std::size_t edge = 0; edge < 3; ++edge) {
        const glm::dvec3 vector = triangle[(edge + 1) % 3].point_torch - triangle[edge].point_torch;
        const double length = glm::length(vector);
        if (!(length > 0.0)) {
            continue;
        }
        const glm::dvec3 unit = vector / length;
        const glm::dvec3 along(glm::dot(a, unit), glm::dot(b, unit), glm::dot(c, unit));
        const double low = std::min({along.x, along.y, along.z});
        const double high = std::max({along.x, along.y, along.z});
        const double max_along = std::max(std::abs(low), std::abs(high));
        const double min_along = low * high < 0.0 ? 0.0 : std::min(std::abs(low), std::abs(high));
        double part = 0.0;
        if (curved.min_m < curved.max_m) {
            part = length * length / 8.0 *
                   max_second_derivative(beam_, curved, angles_of(min_along, max_along, curved));
        }
        for (const Jump& jump : jumps) {
            if (jump.slope > 0.0 && distances.min_m < jump.distance_m && jump.distance_m < distances.max_m) {
                part += 2.0 * jump.slope * std::min(1.0, max_along / jump.distance_m) * length / 4.0;
                has_jump = true;
            }
        }
        if (part > largest) {
            largest = part;
            bound.edge = edge;
        }
    }
    bound.error = (has_jump ? 25.0 / 16.0 : 4.0 / 3.0) * largest;
    return bound;
}

double TriangleSplitter::max_error(const MeshTriangle& triangle) const {
    return bound_of(triangle).error;
}

void TriangleSplitter::split(const MeshTriangle& triangle, const Splitting& splitting,
                             std::vector<LitCorner>& lit) const {
    split(triangle, splitting, max_depth, lit);
}

void TriangleSplitter::split(const MeshTriangle& triangle, const Splitting& splitting, int depth,
                             std::vector<LitCorner>& lit) const {
    const auto& [a, b, c] = triangle;
    if ((a.outcode & b.outcode & c.outcode) != 0) {
        return;
    }
    std::size_t edge = 0;
    bool is_enough = false;
    if (splitting.by == Splitting::By::Bound) {
        const Bound bound = bound_of(triangle);
        edge = bound.edge;
        is_enough = bound.error <= splitting.tolerance;
    } else {
        const auto square = [](const MeshCorner& from, const MeshCorner& to) {
            const glm::dvec3 vector = to.point_torch - from.point_torch;
            return glm::dot(vector, vector);
        };
        const std::array squares{square(a, b), square(b, c), square(c, a)};
        edge = static_cast<std::size_t>(std::max_element(squares.begin(), squares.end()) - squares.begin());
        is_enough = squares.at(edge) <= splitting.tolerance * splitting.tolerance;
    }
    if (is_enough || depth == 0 || lit.size() / 3 + 1 >= splitting.max_triangles) {
        for (const MeshCorner& each : triangle) {
            lit.push_back({glm::vec3(each.place), static_cast<float>(each.intensity)});
        }
        return;
    }
    const MeshCorner& from = triangle.at(edge);
    const MeshCorner& to = triangle.at((edge + 1) % 3);
    const MeshCorner& opposite = triangle.at((edge + 2) % 3);
    const MeshCorner half = middle(from, to);
    split({from, half, opposite}, splitting, depth - 1, lit);
    split({half, to, opposite}, splitting, depth - 1, lit);
}

double ToleranceControl::next(double ms) {
    if (ms > 0.0 && std::isfinite(ms)) {
        constexpr double max_step = 2.0;
        const double step = std::clamp(std::sqrt(ms / frame_ms_), 1.0 / max_step, max_step);
        tolerance_ = std::clamp(step * tolerance_, range_.min, range_.max);
    }
    return tolerance_;
}

} // namespace frustumscreen::torch
