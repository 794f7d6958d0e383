#include "app/relief/cut_cells.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace frustumscreen::relief {

namespace {

constexpr int parts = CellCrossings::parts;
constexpr int lines_along = CellCrossings::lines_along;
constexpr std::size_t lines_of_cell = std::size_t{lines_along} * lines_along;

/// The surface, followed along a cell's lines.
class Sheet {
public:
    Sheet(const GridCrossings& grid, const CellLines& lines, int column, int row,
          const CornerHeights& corners, CutMemory& memory)
        : crossings_(memory.crossings), front_(memory.front) {
        constexpr double beyond = 3.0; // texels above and below the corners: the surface may bend
        const auto [low, high] = std::minmax_element(corners.w.begin(), corners.w.end());
        const glm::dvec2 range(static_cast<double>(*low) - beyond, static_cast<double>(*high) + beyond);
        lines.cross(column, row, range, memory.crossings);
        front_.clear();
        for (int k = 0; k < 4; ++k) {
            if (corners.known[static_cast<std::size_t>(k)]) {
                begin_at((k & 1) * parts, (k >> 1) * parts, corners.w[static_cast<std::size_t>(k)]);
            }
        }
        for (const SheetEnd& end : grid.ends_in(column, row)) {
            if (std::abs(height_over(corners, end)) < end_reach) {
                begin_at_end({end.u - static_cast<float>(column), end.v - static_cast<float>(row)}, end);
            }
        }
        while (!front_.empty()) {
            const glm::ivec2 at = front_.back();
            front_.pop_back();
            for (const glm::ivec2 step :
                 {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
                follow(at, step);
            }
        }
    }

    [[nodiscard]] const std::optional<LineCrossing>& at(int i, int j) const {
        return found_[CellCrossings::line(i, j)];
    }
    /// Parts in which the surface ends.
    [[nodiscard]] std::uint64_t end_parts() const { return end_parts_; }

private:
    void take(int i, int j, const LineCrossing& crossing) {
        found_[CellCrossings::line(i, j)] = crossing;
        front_.emplace_back(i, j);
    }

    /// Starts at the lines around the part of the cell that contains the end.
    void begin_at_end(const glm::vec2& place, const SheetEnd& end) {
        const int column = std::clamp(static_cast<int>(place.x * parts), 0, parts - 1);
        const int row = std::clamp(static_cast<int>(place.y * parts), 0, parts - 1);
        end_parts_ |= std::uint64_t{1} << (parts * row + column);
        for (int k = 0; k < 4; ++k) {
            const int i = column + (k & 1);
            const int j = row + (k >> 1);
            const glm::vec2 away = glm::vec2(i, j) / static_cast<float>(parts) - place;
            begin_at(i, j, end.w + end.slope_u * away.x + end.slope_v * away.y, 0.1F);
        }
    }

    void begin_at(int i, int j, float w, float the_same = 0.01F) {
        for (const LineCrossing& crossing : crossings_.of(i, j)) {
            if (!at(i, j) && std::abs(crossing.w - w) < the_same) {
                take(i, j, crossing);
            }
        }
    }

    /// Links lines as in linked_cells.cpp, over an eighth of the distance.
    void follow(const glm::ivec2& from, const glm::ivec2& step) {
        const glm::ivec2 to = from + step;
        if (to.x < 0 || to.y < 0 || to.x > parts || to.y > parts || at(to.x, to.y)) {
            return;
        }
        constexpr float length = 1.0F / parts;
        const auto slope = [&](const LineCrossing& crossing) {
            return static_cast<float>(step.x) * crossing.slope_u +
                   static_cast<float>(step.y) * crossing.slope_v;
        };
        const LineCrossing& here = *at(from.x, from.y);
        const LineCrossing* best = nullptr;
        float least = 0.0F;
        for (const LineCrossing& there : crossings_.of(to.x, to.y)) {
            const float sum = slope(here) + slope(there);
            const float bend = std::abs(slope(here) - slope(there));
            const float miss = std::abs(there.w - here.w - 0.5F * length * sum);
            const float allowed = 0.05F + length * (0.55F * bend + 0.1F * std::abs(sum));
            if (miss < allowed && !is_crease(slope(here), slope(there)) &&
                (best == nullptr || miss < least)) {
                best = &there;
                least = miss;
            }
        }
        if (best != nullptr) {
            take(to.x, to.y, *best);
        }
    }

    const CellCrossings& crossings_;
    std::vector<glm::ivec2>& front_;
    std::array<std::optional<LineCrossing>, lines_of_cell> found_;
    std::uint64_t end_parts_ = 0;
};

glm::dvec4 corner_weights(int i, int j) {
    const double u = double(i) / parts;
    const double v = double(j) / parts;
    return {(1.0 - u) * (1.0 - v), u * (1.0 - v), (1.0 - u) * v, u * v};
}

/// Least squares over the sheet: guesses count as heights of small weight, known corners as heights of large
/// weight.
void fit_corners(const Sheet& sheet, CornerHeights& corners) {
    constexpr double guess_weight = 0.3;
    constexpr double known_weight = 1e6;
    glm::dmat4 normal(0.0);
    glm::dvec4 sum(0.0);
    for (int k = 0; k < 4; ++k) {
        const auto corner = static_cast<std::size_t>(k);
        const double weight = corners.known[corner] ? known_weight : guess_weight;
        normal[k][k] = weight;
        sum[k] = weight * static_cast<double>(corners.w[corner]);
    }
    for (int j = 0; j < lines_along; ++j) {
        for (int i = 0; i < lines_along; ++i) {
            if (const std::optional<LineCrossing>& crossing = sheet.at(i, j)) {
                const glm::dvec4 weights = corner_weights(i, j);
                normal += glm::outerProduct(weights, weights);
                sum += static_cast<double>(crossing->w) * weights;
            }
        }
    }
    const glm::dvec4 fitted = glm::inverse(normal) * sum;
    for (int k = 0; k < 4; ++k) {
        const auto corner = static_cast<std::size_t>(k);
        if (!corners.known[corner]) {
            corners.w[corner] = static_cast<float>(fitted[k]);
        }
    }
}

} // namespace

float height_over(const CornerHeights& corners, const SheetEnd& end) {
    const float u = end.u - std::floor(end.u);
    const float v = end.v - std::floor(end.v);
    return end.w -
           glm::mix(glm::mix(corners.w[0], corners.w[1], u), glm::mix(corners.w[2], corners.w[3], u), v);
}

std::uint64_t cut_cell(const GridCrossings& grid, const CellLines& lines, int column, int row,
                       CornerHeights& corners, CutMemory& memory) {
    const Sheet sheet(grid, lines, column, row, corners, memory);
    fit_corners(sheet, corners);
    std::uint64_t cover = sheet.end_parts();
    for (int j = 0; j < parts; ++j) {
        for (int i = 0; i < parts; ++i) {
            const bool is_met =
                sheet.at(i, j) || sheet.at(i + 1, j) || sheet.at(i, j + 1) || sheet.at(i + 1, j + 1);
            cover |= std::uint64_t{is_met} << (parts * j + i);
        }
    }
    return cover;
}

} // namespace frustumscreen::relief
