#include "app/scene/inner_box.h"

#include "app/geometry/collineation.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

namespace frustumscreen::scene {

namespace {

constexpr int cells_along = 32;
constexpr int turns =
    6; ///< by 15 degrees: an artifact that a bake has turned to its best side may stand across the axes
using Triangle = std::array<glm::dvec3, 3>;

/// Equal positions get equal numbers.
std::vector<std::uint32_t> numbers_of(std::span<const glm::vec3> positions) {
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
        const glm::vec3& p = positions[a];
        const glm::vec3& q = positions[b];
        return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z;
    };
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), before);
    std::vector<std::uint32_t> numbers(positions.size());
    std::uint32_t number = 0;
    for (std::size_t k = 0; k < order.size(); ++k) {
        number += k > 0 && before(order[k - 1], order[k]) ? 1 : 0;
        numbers[order[k]] = number;
    }
    return numbers;
}

bool is_closed(const std::vector<std::uint32_t>& numbers, std::span<const std::uint32_t> indices) {
    struct Edge {
        std::uint64_t ends;
        int way;
    };
    std::vector<Edge> edges;
    for (std::size_t first = 0; first + 2 < indices.size(); first += 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint64_t a = numbers[indices[first + k]];
            const std::uint64_t b = numbers[indices[first + (k + 1) % 3]];
            if (a != b) {
                edges.push_back({std::min(a, b) << 32U | std::max(a, b), a < b ? 1 : -1});
            }
        }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.ends < b.ends; });
    for (std::size_t k = 0; k < edges.size();) {
        int sum = 0;
        const std::uint64_t ends = edges[k].ends;
        for (; k < edges.size() && edges[k].ends == ends; ++k) {
            sum += edges[k].way;
        }
        if (sum != 0) {
            return false;
        }
    }
    return !edges.empty();
}

/// Separating axes (Akenine-Moller 2001); a box that the triangle only touches counts as met.
bool meets(const Triangle& triangle, const glm::dvec3& middle, const glm::dvec3& half) {
    const Triangle at{triangle[0] - middle, triangle[1] - middle, triangle[2] - middle};
    const auto apart = [&](const glm::dvec3& axis) {
        const std::array<double, 3> along{glm::dot(at[0], axis), glm::dot(at[1], axis),
                                          glm::dot(at[2], axis)};
        const double reach = glm::dot(glm::abs(axis), half);
        return *std::min_element(along.begin(), along.end()) > reach ||
               *std::max_element(along.begin(), along.end()) < -reach;
    };
    const std::array<glm::dvec3, 3> edges{at[1] - at[0], at[2] - at[1], at[0] - at[2]};
    bool separate = apart(glm::cross(edges[0], edges[1]));
    for (int axis = 0; axis < 3 && !separate; ++axis) {
        glm::dvec3 unit(0.0);
        unit[axis] = 1.0;
        separate = apart(unit);
        for (std::size_t k = 0; k < 3 && !separate; ++k) {
            separate = apart(glm::cross(unit, edges[k]));
        }
    }
    return !separate;
}

class Grid {
public:
    Grid(const glm::dvec3& low, const glm::dvec3& high) : low_(low) {
        cell_ = (high - low) / static_cast<double>(cells_along);
        touched_.resize(columns());
        crossings_.resize(columns());
    }

    void add(const Triangle& triangle, const std::array<std::uint32_t, 3>& numbers) {
        glm::ivec3 first, last;
        for (int axis = 0; axis < 3; ++axis) {
            const auto [least, most] = std::minmax({triangle[0][axis], triangle[1][axis], triangle[2][axis]});
            constexpr double hair = 1e-6; // of a cell
            first[axis] = std::clamp(static_cast<int>(std::floor((least - low_[axis]) / cell_[axis] - hair)),
                                     0, count_[axis] - 1);
            last[axis] = std::clamp(static_cast<int>(std::floor((most - low_[axis]) / cell_[axis] + hair)), 0,
                                    count_[axis] - 1);
        }
        const glm::dvec3 half = 0.5 * (1.0 + 1e-6) * cell_;
        for (int x = first.x; x <= last.x; ++x) {
            for (int y = first.y; y <= last.y; ++y) {
                add_crossing(triangle, numbers, x, y);
                for (int z = first.z; z <= last.z; ++z) {
                    if (meets(triangle, middle({x, y, z}), half)) {
                        touched_[column(x, y)] |= std::uint32_t{1} << static_cast<unsigned>(z);
                    }
                }
            }
        }
    }

    [[nodiscard]] std::optional<geometry::Box> largest() const {
        const std::vector<std::uint32_t> solid = solid_columns();
        int most = 0;
        geometry::Box box;
        for (int x0 = 0; x0 < count_.x; ++x0) {
            std::array<std::uint32_t, cells_along> along{}; // cells that are solid from x0 to x1, by y
            along.fill(~std::uint32_t{0});
            for (int x1 = x0; x1 < count_.x; ++x1) {
                for (int y = 0; y < count_.y; ++y) {
                    along[static_cast<std::size_t>(y)] &= solid[column(x1, y)];
                }
                for (int y0 = 0; y0 < count_.y; ++y0) {
                    std::uint32_t common = ~std::uint32_t{0};
                    for (int y1 = y0; y1 < count_.y; ++y1) {
                        common &= along[static_cast<std::size_t>(y1)];
                        if (common == 0) {
                            break;
                        }
                        const auto [z, length] = longest_run(common);
                        const int cells = (x1 - x0 + 1) * (y1 - y0 + 1) * length;
                        if (cells > most) {
                            most = cells;
                            box = {low_ + cell_ * glm::dvec3(x0, y0, z),
                                   low_ + cell_ * glm::dvec3(x1 + 1, y1 + 1, z + length)};
                        }
                    }
                }
            }
        }
        return most > 0 ? std::optional(box) : std::nullopt;
    }

private:
    struct Crossing {
        double z = 0.0;
        int way = 0; ///< 1: the surface looks up
    };

    [[nodiscard]] std::size_t columns() const {
        return static_cast<std::size_t>(count_.x) * static_cast<std::size_t>(count_.y);
    }
    [[nodiscard]] std::size_t column(int x, int y) const {
        return static_cast<std::size_t>(x) * static_cast<std::size_t>(count_.y) + static_cast<std::size_t>(y);
    }
    [[nodiscard]] glm::dvec3 middle(const glm::ivec3& cell) const {
        return low_ + cell_ * (glm::dvec3(cell) + 0.5);
    }

    /// Where the vertical line through the cells' middles meets the triangle. Triangles that share an edge agree on its side:
    /// it is computed from the end with the lower number.
    void add_crossing(const Triangle& triangle, const std::array<std::uint32_t, 3>& numbers, int x, int y) {
        const glm::dvec2 at(middle({x, y, 0}));
        std::array<int, 3> side{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            const bool turned = numbers[k] > numbers[next];
            const glm::dvec2 from(triangle[turned ? next : k]);
            const glm::dvec2 to(triangle[turned ? k : next]);
            const glm::dvec2 edge = to - from;
            const glm::dvec2 ray = at - from;
            const int left = edge.x * ray.y - edge.y * ray.x >= 0.0 ? 1 : -1;
            side[k] = turned ? -left : left;
        }
        if (side[0] != side[1] || side[1] != side[2]) {
            return;
        }
        const glm::dvec3 normal = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
        const double z =
            normal.z != 0.0
                ? triangle[0].z -
                      (normal.x * (at.x - triangle[0].x) + normal.y * (at.y - triangle[0].y)) / normal.z
                : triangle[0].z;
        crossings_[column(x, y)].push_back({z, side[0]});
    }

    [[nodiscard]] std::vector<std::uint32_t> solid_columns() const {
        std::vector<std::uint32_t> solid(columns());
        for (int x = 0; x < count_.x; ++x) {
            for (int y = 0; y < count_.y; ++y) {
                for (int z = 0; z < count_.z; ++z) {
                    const std::uint32_t bit = std::uint32_t{1} << static_cast<unsigned>(z);
                    int winding = 0;
                    for (const Crossing& crossing : crossings_[column(x, y)]) {
                        winding += crossing.z > middle({x, y, z}).z ? crossing.way : 0;
                    }
                    const bool inside = winding > 0 && (touched_[column(x, y)] & bit) == 0;
                    solid[column(x, y)] |= inside ? bit : 0U;
                }
            }
        }
        return solid;
    }

    struct Run {
        int first = 0, length = 0;
    };
    static Run longest_run(std::uint32_t bits) {
        Run longest;
        for (int at = 0; bits != 0;) {
            const int gap = std::countr_zero(bits);
            bits >>= static_cast<unsigned>(gap);
            const int length = std::countr_one(bits);
            at += gap;
            longest = length > longest.length ? Run{at, length} : longest;
            bits = length < 32 ? bits >> static_cast<unsigned>(length) : 0;
            at += length;
        }
        return longest;
    }

    glm::dvec3 low_;
    glm::dvec3 cell_{1.0};
    glm::ivec3 count_{cells_along};
    std::vector<std::uint32_t> touched_; ///< bit z of each column
    std::vector<std::vector<Crossing>> crossings_;
};

/// As inner_box, along the axes of a frame that is turned about z.
std::optional<geometry::Box> box_in(const std::vector<glm::dvec3>& positions,
                                    const std::vector<std::uint32_t>& numbers,
                                    std::span<const std::uint32_t> indices) {
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    for (const std::uint32_t index : indices) {
        low = glm::min(low, positions[index]);
        high = glm::max(high, positions[index]);
    }
    const glm::dvec3 extent = high - low;
    if (!(std::min({extent.x, extent.y, extent.z}) > 0.0) || !std::isfinite(glm::length(extent))) {
        return std::nullopt;
    }
    Grid grid(low, high);
    for (std::size_t first = 0; first + 2 < indices.size(); first += 3) {
        Triangle triangle;
        std::array<std::uint32_t, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            triangle[k] = positions[indices[first + k]];
            corners[k] = numbers[indices[first + k]];
        }
        grid.add(triangle, corners);
    }
    return grid.largest();
}

double volume_of(const geometry::Box& box) {
    const glm::dvec3 extent = box.high - box.low;
    return extent.x * extent.y * extent.z;
}

} // namespace

std::optional<BoxCorners> inner_box(std::span<const glm::vec3> positions,
                                    std::span<const std::uint32_t> indices) {
    const std::vector<std::uint32_t> numbers = numbers_of(positions);
    if (!is_closed(numbers, indices)) {
        return std::nullopt;
    }
    std::optional<BoxCorners> found;
    double most = 0.0;
    std::vector<glm::dvec3> turned(positions.size());
    for (int turn = 0; turn < turns; ++turn) {
        const double angle = 0.5 * std::numbers::pi * turn / turns;
        const glm::dmat3 to_turned(glm::angleAxis(angle, glm::dvec3(0.0, 0.0, 1.0)));
        std::transform(positions.begin(), positions.end(), turned.begin(),
                       [&](const glm::vec3& position) { return to_turned * glm::dvec3(position); });
        const std::optional<geometry::Box> box = box_in(turned, numbers, indices);
        if (box && volume_of(*box) > most) {
            most = volume_of(*box);
            found = corners_of(box->low, box->high, glm::dmat4(glm::transpose(to_turned)));
        }
    }
    return found;
}

} // namespace frustumscreen::scene
