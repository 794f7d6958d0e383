#include "app/bench/torch/torch_wall.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen::bench {

namespace {

using torch::Attenuation;
using torch::Splitting;

torch::Beam wall_beam(Attenuation attenuation) {
    return {.opening_rad = 1.9,
            .height_per_width = 1.0,
            .shape = torch::Shape::Round,
            .attenuation = attenuation,
            .full_m = 0.28,
            .dark_m = 1.2};
}

/// 0.3 m before the wall, turned by a fifth of a radian about the upright, so that the light does not fall evenly.
glm::dvec3 torch_from_wall(const glm::dvec3& wall) {
    const double turn = 0.2;
    return {std::cos(turn) * wall.x, -wall.y, 0.3 + std::sin(turn) * wall.x};
}

std::vector<torch::LitCorner> split_wall(const torch::Beam& beam, const Splitting& splitting) {
    const torch::TriangleSplitter splitter(beam);
    const auto corner = [&](double x, double y) {
        const glm::dvec3 wall(x, y, 0.0);
        return splitter.corner(torch_from_wall(wall), wall);
    };
    const std::array corners{corner(-0.9, -0.7), corner(0.7, -0.7), corner(0.7, 0.5), corner(-0.9, 0.5)};
    std::vector<torch::LitCorner> lit;
    splitter.split({corners[0], corners[1], corners[2]}, splitting, lit);
    splitter.split({corners[0], corners[2], corners[3]}, splitting, lit);
    return lit;
}

WallRow measure(Attenuation attenuation, const Splitting& splitting) {
    const torch::Beam beam = wall_beam(attenuation);
    const std::vector<torch::LitCorner> lit = split_wall(beam, splitting);
    WallRow row{.attenuation = attenuation, .splitting = splitting, .triangles = lit.size() / 3};
    double squares = 0.0;
    double weights = 0.0;
    for (std::size_t k = 0; k < lit.size(); k += 3) {
        const glm::dvec3 a(lit[k].place);
        const glm::dvec3 b(lit[k + 1].place);
        const glm::dvec3 c(lit[k + 2].place);
        const double area = glm::length(glm::cross(b - a, c - a));
        const int steps = std::clamp(static_cast<int>(std::sqrt(area) / 0.004), 6, 200);
        const double weight = area / (static_cast<double>(steps) * steps);
        for (int i = 0; i < steps; ++i) {
            for (int j = 0; i + j < steps; ++j) {
                const double u = (i + 1.0 / 3.0) / steps;
                const double v = (j + 1.0 / 3.0) / steps;
                const double true_one =
                    torch::intensity_at(beam, torch_from_wall(a + u * (b - a) + v * (c - a)));
                if (true_one == 0.0) {
                    continue;
                }
                const double drawn = (1.0 - u - v) * static_cast<double>(lit[k].intensity) +
                                     u * static_cast<double>(lit[k + 1].intensity) +
                                     v * static_cast<double>(lit[k + 2].intensity);
                squares += weight * (drawn - true_one) * (drawn - true_one);
                weights += weight;
                row.max = std::max(row.max, 100.0 * std::abs(drawn - true_one));
            }
        }
    }
    row.rmse = weights > 0.0 ? 100.0 * std::sqrt(squares / weights) : 0.0;
    return row;
}

} // namespace

std::vector<WallRow> measure_wall() {
    std::vector<WallRow> rows;
    for (const Attenuation attenuation :
         {Attenuation::InverseSquare, Attenuation::Linear, Attenuation::SmoothStep}) {
        for (double length_m = 0.8; length_m > 0.02; length_m *= 0.5) {
            rows.push_back(measure(attenuation, {Splitting::By::Length, length_m}));
        }
        for (double bound = 0.64; bound > 0.002; bound *= 0.5) {
            rows.push_back(measure(attenuation, {Splitting::By::Bound, bound}));
        }
    }
    return rows;
}

std::string torch_wall_csv(const std::vector<WallRow>& rows) {
    std::string csv =
        "attenuation,heuristic,tolerance_mm,tolerance_pct,triangles,intensity_rmse,intensity_max\n";
    for (const WallRow& row : rows) {
        const bool by_length = row.splitting.by == Splitting::By::Length;
        csv +=
            fmt::format("{},{},{:.4g},{:.4g},{},{:.4f},{:.4f}\n",
                        torch::attenuation_names.at(static_cast<std::size_t>(row.attenuation)),
                        by_length ? "length" : "curvature", by_length ? 1e3 * row.splitting.tolerance : 0.0,
                        by_length ? 0.0 : 100.0 * row.splitting.tolerance, row.triangles, row.rmse, row.max);
    }
    return csv;
}

std::string torch_triangles_csv() {
    std::string csv = "heuristic,tolerance,triangle,x_m,y_m,intensity,s,t,q\n";
    const torch::Beam beam = wall_beam(Attenuation::InverseSquare);
    for (const Splitting& splitting :
         {Splitting{Splitting::By::Length, 0.1}, Splitting{Splitting::By::Length, 0.25},
          Splitting{Splitting::By::Length, 0.9}, Splitting{Splitting::By::Bound, 0.04}}) {
        const bool by_length = splitting.by == Splitting::By::Length;
        const std::vector<torch::LitCorner> lit = split_wall(beam, splitting);
        for (std::size_t k = 0; k < lit.size(); ++k) {
            const glm::dvec3 place(lit[k].place);
            const glm::dvec3 point = torch_from_wall(place);
            const glm::dvec2 st = glm::dvec2(point) / torch::half_extent(beam);
            csv += fmt::format("{},{:.4g},{},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f}\n",
                               by_length ? "length" : "curvature",
                               by_length ? 1e3 * splitting.tolerance : 100.0 * splitting.tolerance, k / 3,
                               place.x, place.y, static_cast<double>(lit[k].intensity), st.x, st.y, point.z);
        }
    }
    return csv;
}

} // namespace frustumscreen::bench
