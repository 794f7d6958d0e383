#include "app/bench/mixed/paper_choice.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace frustumscreen::bench {

namespace {

double error_mm(std::span<const PaperCell> cells, std::span<const std::uint8_t> polygons) {
    double sum = 0.0;
    for (std::size_t k = 0; k < cells.size(); ++k) {
        sum += polygons[k] != 0 ? cells[k].polygon_error_mm : cells[k].relief_error_mm;
    }
    return sum;
}

double error_mm(std::span<const std::vector<PaperCell>> frames, std::span<const double> budgets,
                const PaperWeights& weights) {
    double sum = 0.0;
    for (const double budget : budgets) {
        PaperChoice choice(weights, budget);
        for (const std::vector<PaperCell>& cells : frames) {
            sum += error_mm(cells, choice.choose(cells));
        }
    }
    return sum;
}

} // namespace

double importance(const PaperCell& cell, const PaperWeights& weights) {
    return weights.u * cell.texel_px + weights.v / cell.away_m + weights.w * cell.cosine +
           weights.x * cell.area_share;
}

std::span<const std::uint8_t> PaperChoice::choose(std::span<const PaperCell> cells) {
    order_.resize(cells.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    importance_.resize(cells.size());
    for (std::size_t k = 0; k < cells.size(); ++k) {
        importance_[k] = importance(cells[k], weights_);
    }
    std::sort(order_.begin(), order_.end(), [this](std::size_t a, std::size_t b) {
        return importance_[a] != importance_[b] ? importance_[a] > importance_[b] : a < b;
    });
    before_.swap(polygons_);
    polygons_.assign(cells.size(), 0);
    double left = polygons_a_frame_;
    for (const std::size_t k : order_) {
        const auto needed = static_cast<double>(cells[k].polygons);
        if (cells[k].texel_px > 1.0 && needed <= left) {
            polygons_[k] = 1;
            left -= needed;
        }
    }
    if (before_.size() == polygons_.size()) {
        for (std::size_t k = 0; k < polygons_.size(); ++k) {
            switches_ += polygons_[k] != before_[k] ? 1 : 0;
        }
    }
    return polygons_;
}

PaperWeights find_weights(std::span<const std::vector<PaperCell>> frames, std::span<const double> budgets) {
    constexpr std::array tried{0.0, 0.25, 0.5, 1.0};
    PaperWeights best;
    double best_mm = std::numeric_limits<double>::infinity();
    for (const double u : tried) {
        for (const double v : tried) {
            for (const double w : tried) {
                for (const double x : tried) {
                    if (u + v + w + x == 0.0) {
                        continue; // no order at all
                    }
                    const PaperWeights weights{u, v, w, x};
                    const double mm = error_mm(frames, budgets, weights);
                    if (mm < best_mm) {
                        best = weights;
                        best_mm = mm;
                    }
                }
            }
        }
    }
    return best;
}

} // namespace frustumscreen::bench
