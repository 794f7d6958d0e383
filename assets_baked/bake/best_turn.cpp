#include "assets_baked/bake/best_turn.h"

#include "assets_baked/bake/box_frame.h"
#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <vector>

namespace frustumscreen::bake {

namespace {

constexpr int full_turn_deg = 360;
constexpr int quarter_turn_deg = 90;

/// The vertices that triangles use, upright, with the lowest corner of their bounding box at the origin.
std::vector<glm::dvec3> upright_points(const SourceMesh& mesh, const BoxFrame& frame) {
    std::vector<bool> used(mesh.positions.size(), false);
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle) {
            used[vertex] = true;
        }
    }
    std::vector<glm::dvec3> points;
    for (std::size_t k = 0; k < used.size(); ++k) {
        if (used[k]) {
            points.push_back((frame.turned_from_file * mesh.positions[k] - frame.low) /
                             frame.file_units_per_box);
        }
    }
    return points;
}

/// Slopes of the prop's planes: of their normals, and 0 for the bounding box.
std::vector<double> slopes_of(const geometry::PropShape& prop) {
    std::set<double> slopes{0.0};
    for (const geometry::Plane& plane : prop.bounds) {
        const double across = std::hypot(plane.normal.x, plane.normal.y);
        if (across > 1e-9) {
            slopes.insert(plane.normal.z / across);
        }
    }
    return {slopes.begin(), slopes.end()};
}

/// The points that are outermost in any direction that a plane can have after a turn by whole degrees, and
/// the highest and lowest.
std::vector<glm::dvec3> outermost(std::span<const glm::dvec3> points, const std::vector<double>& slopes) {
    std::vector<glm::dvec3> found;
    const auto keep_outermost = [&](const glm::dvec3& direction) {
        found.push_back(*std::max_element(points.begin(), points.end(), [&](const auto& a, const auto& b) {
            return glm::dot(a, direction) < glm::dot(b, direction);
        }));
    };
    for (int degree = 0; degree < full_turn_deg; ++degree) {
        const glm::dvec3 across = turn_rotation(degree)[0];
        for (const double slope : slopes) {
            keep_outermost({across.x, across.y, slope});
        }
    }
    keep_outermost({0, 0, 1});
    keep_outermost({0, 0, -1});
    return found;
}

/// `outermost` for many points: block by block, then among the blocks' results.
std::vector<glm::dvec3> outermost_of_many(const std::vector<glm::dvec3>& points,
                                          const std::vector<double>& slopes) {
    constexpr std::size_t block = 32'768;
    std::vector<std::vector<glm::dvec3>> of_block((points.size() + block - 1) / block);
    parallel_for(points.size(), block, [&](std::size_t begin, std::size_t end) {
        of_block[begin / block] = outermost(std::span(points).subspan(begin, end - begin), slopes);
    });
    std::vector<glm::dvec3> all;
    for (const std::vector<glm::dvec3>& each : of_block) {
        all.insert(all.end(), each.begin(), each.end());
    }
    return outermost(all, slopes);
}

/// The largest scale inside the prop after a turn, placed as in box_frame.h.
double scale_after(int turn_deg, std::vector<glm::dvec3> points, double lift_box,
                   const geometry::PropShape& prop) {
    const glm::dmat3 turn = turn_rotation(turn_deg);
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    for (glm::dvec3& p : points) {
        p = turn * p;
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::dvec3 foot((low.x + high.x) / 2.0, (low.y + high.y) / 2.0, low.z - lift_box);
    for (glm::dvec3& p : points) {
        p -= foot;
    }
    return geometry::largest_scale_inside(prop, points);
}

/// Pixels that the artifact covers, seen from the front.
class Silhouette {
public:
    void add(const std::array<glm::dvec2, 3>& corners) {
        const glm::dvec2 low = glm::floor(glm::min(glm::min(corners[0], corners[1]), corners[2]));
        const glm::dvec2 high = glm::floor(glm::max(glm::max(corners[0], corners[1]), corners[2]));
        if (high.x - low.x <= 1.0 && high.y - low.y <= 1.0) {
            for (const glm::dvec2& corner : corners) {
                mark(static_cast<int>(corner.x), static_cast<int>(corner.y));
            }
            return;
        }
        for (int y = std::max(0, static_cast<int>(low.y)); y <= std::min(side - 1, static_cast<int>(high.y));
             ++y) {
            for (int x = std::max(0, static_cast<int>(low.x));
                 x <= std::min(side - 1, static_cast<int>(high.x)); ++x) {
                if (holds(corners, {x + 0.5, y + 0.5})) {
                    mark(x, y);
                }
            }
        }
    }
    [[nodiscard]] std::ptrdiff_t pixels() const { return std::count(covered_.begin(), covered_.end(), true); }

    static constexpr int side = 160;

private:
    static double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
        return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    }
    static bool holds(const std::array<glm::dvec2, 3>& c, const glm::dvec2& p) {
        const double a = turn(c[0], c[1], p);
        const double b = turn(c[1], c[2], p);
        const double d = turn(c[2], c[0], p);
        return (a >= 0.0 && b >= 0.0 && d >= 0.0) || (a <= 0.0 && b <= 0.0 && d <= 0.0);
    }
    void mark(int x, int y) {
        if (x >= 0 && y >= 0 && x < side && y < side) {
            covered_[static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x)] = true;
        }
    }

    std::vector<bool> covered_ = std::vector<bool>(std::size_t{side} * side, false);
};

std::ptrdiff_t seen_pixels(int turn_deg, const SourceMesh& mesh, const BoxFrame& frame) {
    // The picture is as wide as the artifact after any turn, and as high: only ratios of areas are compared.
    const double tiny = 1e-9 * frame.file_units_per_box;
    const glm::dvec2 pixels_per_unit =
        (Silhouette::side - 1.0) /
        glm::max(glm::dvec2(std::hypot(frame.extent.x, frame.extent.y), frame.extent.z), glm::dvec2(tiny));
    const glm::dmat3 turned = turn_rotation(turn_deg) * frame.turned_from_file;
    const glm::dvec3 middle_in_turned =
        turn_rotation(turn_deg) * (frame.low + frame.extent * glm::dvec3(0.5, 0.5, 0.5));
    Silhouette silhouette;
    for (const auto& triangle : mesh.triangles) {
        std::array<glm::dvec2, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 p = turned * mesh.positions[triangle[k]] - middle_in_turned;
            corners[k] = glm::dvec2(p.x, p.z) * pixels_per_unit + 0.5 * Silhouette::side;
        }
        silhouette.add(corners);
    }
    return silhouette.pixels();
}

/// -44 to 45: 0 or 45 degrees if the artifact is then as large, otherwise the turn at which it is largest.
int turn_of_largest_size(const std::vector<glm::dvec3>& points, double lift_box,
                         const geometry::PropShape& prop) {
    constexpr double as_large = 0.995;
    std::array<double, quarter_turn_deg> scales{};
    for (int turn = 0; turn < quarter_turn_deg; ++turn) {
        scales[static_cast<std::size_t>(turn)] = scale_after(turn, points, lift_box, prop);
    }
    const auto* const largest = std::max_element(scales.begin(), scales.end());
    for (const int turn : {0, quarter_turn_deg / 2}) {
        if (scales[static_cast<std::size_t>(turn)] >= as_large * *largest) {
            return turn;
        }
    }
    const auto turn = static_cast<int>(largest - scales.begin());
    return turn <= quarter_turn_deg / 2 ? turn : turn - quarter_turn_deg;
}

} // namespace

double best_turn_deg(const SourceMesh& mesh, std::string_view up, double lift,
                     const geometry::PropShape& prop) {
    const Result<BoxFrame> frame = make_box_frame(mesh, {std::string(up), 0.0, lift});
    if (!frame) {
        return 0.0;
    }
    const std::vector<glm::dvec3> points = outermost_of_many(upright_points(mesh, *frame), slopes_of(prop));
    const int turn = turn_of_largest_size(points, frame->lift_box, prop);
    // A side covers as much from behind as from the front, so two suffice.
    constexpr double clearly_more = 1.1;
    const auto front = static_cast<double>(seen_pixels(turn, mesh, *frame));
    const auto beside = static_cast<double>(seen_pixels(turn + quarter_turn_deg, mesh, *frame));
    return beside > clearly_more * front ? turn + quarter_turn_deg : turn;
}

} // namespace frustumscreen::bake
