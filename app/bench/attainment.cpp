#include "app/bench/attainment.h"

#include <algorithm>
#include <limits>

namespace frustumscreen {

std::vector<glm::dvec2> pareto_front(std::span<const glm::dvec2> points) {
    std::vector<glm::dvec2> sorted(points.begin(), points.end());
    std::stable_sort(sorted.begin(), sorted.end(), [](const glm::dvec2& a, const glm::dvec2& b) {
        return a.x < b.x || (a.x == b.x && a.y < b.y);
    });
    std::vector<glm::dvec2> front;
    for (const glm::dvec2& point : sorted) {
        if (front.empty() || point.y < front.back().y) {
            front.push_back(point);
        }
    }
    return front;
}

std::vector<glm::dvec2> median_attainment(std::span<const std::vector<glm::dvec2>> artifacts) {
    std::vector<double> costs;
    for (const std::vector<glm::dvec2>& points : artifacts) {
        for (const glm::dvec2& point : points) {
            costs.push_back(point.x);
        }
    }
    std::sort(costs.begin(), costs.end());
    std::vector<glm::dvec2> median;
    for (const double cost : costs) {
        std::vector<double> reached;
        for (const std::vector<glm::dvec2>& points : artifacts) {
            double least = std::numeric_limits<double>::infinity();
            for (const glm::dvec2& point : points) {
                least = point.x <= cost ? std::min(least, point.y) : least;
            }
            reached.push_back(least);
        }
        std::sort(reached.begin(), reached.end());
        const double half = reached[(reached.size() - 1) / 2];
        if (half < std::numeric_limits<double>::infinity() && (median.empty() || half < median.back().y)) {
            median.emplace_back(cost, half);
        }
    }
    return median;
}

} // namespace frustumscreen
