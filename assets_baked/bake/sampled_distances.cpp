#include "assets_baked/bake/sampled_distances.h"

#include "assets_baked/bake/cell_numbers.h"
#include "assets_baked/bake/nearest_on_triangle.h"
#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

namespace frustumscreen::bake {

namespace {

constexpr float unknown = std::numeric_limits<float>::infinity();

using Corners = std::array<glm::vec3, 3>;

float squared_distance(const glm::vec3& point, const Corners& corners) {
    const auto& [a, b, c] = corners;
    const glm::vec2 w = nearest_on_triangle(point, a, b, c);
    const glm::vec3 away = a + (b - a) * w.x + (c - a) * w.y - point;
    return glm::dot(away, away);
}

/// Points in a grid whose cells are as long as the reach. A cell lists the points of its 27 neighbours too, so a triangle
/// meets all points within reach in the cells that its bounding box touches.
class PointGrid {
public:
    PointGrid(std::span<const glm::dvec3> points, double reach) : reach_(reach) {
        low_ = high_ = points.front();
        for (const glm::dvec3& p : points) {
            low_ = glm::min(low_, p);
            high_ = glm::max(high_, p);
        }
        for (const glm::dvec3& p : points) {
            local_.push_back(local(p));
        }
        list_points();
    }

    /// Squared distances in reaches; larger ones than 1 may be too large.
    void lower(std::vector<float>& squared, const std::array<glm::dvec3, 3>& triangle) const {
        const Corners corners{local(triangle[0]), local(triangle[1]), local(triangle[2])};
        const glm::i64vec3 low = cell_of(glm::min(glm::min(corners[0], corners[1]), corners[2]));
        const glm::i64vec3 high = cell_of(glm::max(glm::max(corners[0], corners[1]), corners[2]));
        constexpr std::int64_t many = 64; // cells: a large triangle meets all points
        const glm::i64vec3 count = high - low + std::int64_t{1};
        if (count.x > many || count.y > many || count.z > many || count.x * count.y * count.z > many) {
            for (std::size_t k = 0; k < local_.size(); ++k) {
                squared[k] = std::fmin(squared[k], squared_distance(local_[k], corners));
            }
            return;
        }
        for (glm::i64vec3 cell = low; cell.z <= high.z; ++cell.z) {
            for (cell.y = low.y; cell.y <= high.y; ++cell.y) {
                for (cell.x = low.x; cell.x <= high.x; ++cell.x) {
                    lower_in(squared, corners, cell);
                }
            }
        }
    }

private:
    /// In reaches, from 1.5 on.
    [[nodiscard]] glm::vec3 local(const glm::dvec3& p) const { return {(p - low_) / reach_ + 1.5}; }
    /// The grid's cells are 1 and more; 0 and the highest hold everything beyond.
    [[nodiscard]] static glm::i64vec3 cell_of(const glm::vec3& at) {
        return glm::i64vec3(glm::clamp(at, 0.0F, static_cast<float>(max_cells_along - 128)));
    }

    void list_points() {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs; // number of a cell, point
        for (std::uint32_t k = 0; k < local_.size(); ++k) {
            const glm::i64vec3 own = cell_of(local_[k]);
            for (int n = 0; n < 27; ++n) {
                const glm::i64vec3 cell = own + glm::i64vec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
                pairs.emplace_back(cells_.number_of(key_of(cell)).number, k);
            }
        }
        std::sort(pairs.begin(), pairs.end());
        first_.assign(cells_.size() + 1, 0);
        for (const auto& [cell, point] : pairs) {
            ++first_[cell + 1];
            points_.push_back(point);
        }
        for (std::size_t k = 1; k < first_.size(); ++k) {
            first_[k] += first_[k - 1];
        }
    }

    void lower_in(std::vector<float>& squared, const Corners& corners, const glm::i64vec3& cell) const {
        const std::uint32_t number = cells_.find(key_of(cell));
        if (number == CellNumbers::none) {
            return;
        }
        for (std::uint32_t k = first_[number]; k < first_[number + 1]; ++k) {
            const std::uint32_t point = points_[k];
            squared[point] = std::fmin(squared[point], squared_distance(local_[point], corners));
        }
    }

    double reach_;
    glm::dvec3 low_{0.0}, high_{0.0};
    std::vector<glm::vec3> local_;
    CellNumbers cells_;
    std::vector<std::uint32_t> first_;  ///< of a cell's points, in `points_`
    std::vector<std::uint32_t> points_; ///< by cell
};

/// Distances that are at most `reach`; `unknown` or a larger one for the others.
std::vector<float> distances_within(const SurfaceView& surface, std::span<const glm::dvec3> points,
                                    double reach) {
    const PointGrid grid(points, reach);
    std::vector<float> squared(points.size(), unknown);
    std::mutex mutex;
    constexpr std::size_t block = std::size_t{1} << 18U;
    parallel_for(surface.triangles.size(), block, [&](std::size_t begin, std::size_t end) {
        std::vector<float> own(points.size(), unknown);
        for (std::size_t t = begin; t < end; ++t) {
            const auto& [a, b, c] = surface.triangles[t];
            grid.lower(own, {surface.positions[a], surface.positions[b], surface.positions[c]});
        }
        const std::lock_guard lock(mutex);
        std::transform(own.begin(), own.end(), squared.begin(), squared.begin(),
                       [](float a, float b) { return std::min(a, b); });
    });
    for (float& each : squared) {
        each = std::sqrt(each);
    }
    return squared;
}

double area_of(const SurfaceView& surface, std::size_t triangle) {
    const auto& [a, b, c] = surface.triangles[triangle];
    const glm::dvec3& p = surface.positions[a];
    return glm::length(glm::cross(surface.positions[b] - p, surface.positions[c] - p));
}

} // namespace

std::vector<glm::dvec3> points_on(const SurfaceView& surface, std::size_t count) {
    double all = 0.0;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        all += area_of(surface, t);
    }
    std::vector<glm::dvec3> points;
    if (!(all > 0.0)) {
        return points;
    }
    const double step = all / static_cast<double>(count);
    double passed = 0.0;
    for (std::size_t t = 0; t < surface.triangles.size() && points.size() < count; ++t) {
        passed += area_of(surface, t);
        while (points.size() < count && (static_cast<double>(points.size()) + 0.5) * step < passed) {
            const auto k = static_cast<double>(points.size());
            const double root = std::sqrt(std::fmod(0.5 + k * 0.7548776662466927, 1.0)); // R2 sequence
            const double side = std::fmod(0.5 + k * 0.5698402909980532, 1.0);
            const auto& [a, b, c] = surface.triangles[t];
            points.push_back(surface.positions[a] * (1.0 - root) +
                             surface.positions[b] * (root * (1.0 - side)) +
                             surface.positions[c] * (root * side));
        }
    }
    return points;
}

std::vector<double> distances_to(const SurfaceView& surface, std::span<const glm::dvec3> points,
                                 double usual) {
    constexpr double growth = 8.0;
    std::vector<double> distances(points.size());
    std::vector<std::size_t> left(points.size());
    for (std::size_t k = 0; k < left.size(); ++k) {
        left[k] = k;
    }
    for (double reach = usual; !left.empty(); reach *= growth) {
        std::vector<glm::dvec3> asked;
        asked.reserve(left.size());
        for (const std::size_t k : left) {
            asked.push_back(points[k]);
        }
        const std::vector<float> found = distances_within(surface, asked, reach);
        std::vector<std::size_t> farther;
        for (std::size_t k = 0; k < left.size(); ++k) {
            distances[left[k]] = static_cast<double>(found[k]) * reach;
            if (!(found[k] <= 1.0F)) {
                farther.push_back(left[k]);
            }
        }
        left = std::move(farther);
    }
    return distances;
}

} // namespace frustumscreen::bake
