#include "app/calibration/choose_crosses.h"

#include "app/calibration/fit.h"
#include "app/calibration/reliability.h"
#include "app/calibration/zone.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cassert>
#include <limits>
#include <numbers>

namespace frustumscreen {

namespace {

/// What a touch at a cross would report, if the model were true.
Touch perfect_touch(const TouchModel& model, const Cross& cross) {
    const std::optional<glm::dvec3> place = model.lit(cross.pixel, cross.block_m);
    assert(place);
    const glm::dquat turn = glm::angleAxis(cross.yaw_rad, model.table_up);
    return {{turn, *place - turn * model.sensor_offset_m}, cross.pixel, cross.block_m};
}

std::vector<Cross> grid_of(const TouchModel& model, const CrossSetup& setup) {
    constexpr int columns = 8;
    constexpr int rows = 6;
    const Pinhole& p = model.pinhole;
    const double margin = setup.margin * p.width;
    std::vector<Cross> crosses;
    for (const double block : setup.blocks_m) {
        for (int k = 0; k < (columns + 1) * (rows + 1); ++k) {
            const glm::dvec2 pixel(margin + (p.width - 2.0 * margin) * (k % (columns + 1)) / columns,
                                   margin + (p.height - 2.0 * margin) * (k / (columns + 1)) / rows);
            for (int quarter = 0; quarter < 4; ++quarter) {
                crosses.push_back({pixel, block, 0.5 * std::numbers::pi * quarter});
            }
        }
    }
    return crosses;
}

/// What a wrong touch could hide counts beside what noise leaves: it is rarer, and larger.
constexpr double hidden_share = 0.05;
constexpr std::size_t starts = 4;

struct Design {
    std::vector<std::size_t> chosen; ///< of the grid
    Covariance information;
    double left = 0.0; ///< what it leaves
};

/// The mean variance over the zone that an information leaves.
double left_by(const Covariance& information, const Covariance& zone) {
    return information.llt().solve(zone).trace();
}

/// A start that is spread out, another one for each `turn`.
Design spread_out(std::span<const TouchRows> rows, const Covariance& known, int count, std::size_t turn) {
    Design design{{}, known};
    for (int k = 0; k < count; ++k) {
        design.chosen.push_back((static_cast<std::size_t>(k) * 7919 + turn * 389) % rows.size());
        design.information += rows[design.chosen.back()].transpose() * rows[design.chosen.back()];
    }
    return design;
}

/// What an information leaves with three rows more, for many choices of these: by Woodbury's identity, 18 x 18 numbers are inverted once
/// and not for each.
class LeftWith {
public:
    LeftWith(const Covariance& information, const Covariance& zone)
        : covariance_(information.llt().solve(Covariance::Identity())),
          spread_(covariance_ * zone * covariance_), left_((covariance_ * zone).trace()) {}
    [[nodiscard]] double rows(const TouchRows& rows) const {
        const Eigen::Matrix3d own = Eigen::Matrix3d::Identity() + rows * covariance_ * rows.transpose();
        return left_ - own.llt().solve(rows * spread_ * rows.transpose()).trace();
    }

private:
    Covariance covariance_;
    Covariance spread_;
    double left_;
};

/// Exchanges each cross for the best one, until none is better.
void exchange(Design& design, std::span<const TouchRows> rows, const Covariance& zone) {
    design.left = left_by(design.information, zone);
    for (bool better = true; better;) {
        better = false;
        for (std::size_t& mine : design.chosen) {
            const Covariance others = design.information - rows[mine].transpose() * rows[mine];
            const LeftWith left(others, zone);
            for (std::size_t other = 0; other < rows.size(); ++other) {
                const double now = left.rows(rows[other]);
                if (now < design.left * (1.0 - 1e-6)) {
                    design.left = now;
                    mine = other;
                    better = true;
                }
            }
            design.information = others + rows[mine].transpose() * rows[mine];
        }
    }
}

Covariance weighted(std::span<const ZonePlace> places, std::span<const double> weights) {
    Covariance zone = Covariance::Zero();
    for (std::size_t k = 0; k < places.size(); ++k) {
        zone += weights[k] * places[k].rows.transpose() * places[k].rows;
    }
    return zone;
}

/// The mean over the zone first; then places count the more, the worse they are off.
Design improved(Design design, std::span<const TouchRows> rows, std::span<const ZonePlace> places) {
    std::vector<double> weights(places.size(), 1.0);
    exchange(design, rows, weighted(places, weights));
    for (int round = 0; round < 2; ++round) {
        const Covariance covariance = design.information.llt().solve(Covariance::Identity());
        for (std::size_t k = 0; k < places.size(); ++k) {
            weights[k] = (places[k].rows * covariance * places[k].rows.transpose()).trace();
        }
        exchange(design, rows, weighted(places, weights));
    }
    const Covariance covariance = design.information.llt().solve(Covariance::Identity());
    const PictureUncertainty left = picture_uncertainty(places, covariance);
    std::vector<TouchRows> chosen;
    for (const std::size_t k : design.chosen) {
        chosen.push_back(rows[k]);
    }
    design.left = left.mean_m + left.worst_m + hidden_share * hidden_error_m(chosen, covariance, places);
    return design;
}

} // namespace

TouchModel rough_model(const Pinhole& pinhole, double above_m, double sensor_height_m) {
    TouchModel model;
    model.pinhole = pinhole;
    model.projector_from_tracker =
        RigidTransform{glm::dquat(0.0, 1.0, 0.0, 0.0), glm::dvec3(0.0, 0.0, above_m)}.inverse();
    model.sensor_offset_m = {0.0, 0.0, -sensor_height_m};
    return model;
}

std::vector<Cross> choose_crosses(const TouchModel& rough, const CrossSetup& setup) {
    const std::vector<Cross> grid = grid_of(rough, setup);
    Touches touches;
    for (const Cross& cross : grid) {
        touches.push_back(perfect_touch(rough, cross));
    }
    const FitSetup fit_setup{setup.noise, setup.priors, -glm::dot(rough.table_up, rough.sensor_offset_m), {}};
    const glm::dvec3 middle = middle_of(touches);
    const std::vector<TouchRows> rows = whitened_touches(touches, fit_setup, rough, middle).rows;
    const Fit all = information_of(touches, fit_setup, rough, middle);
    const std::vector<ZonePlace> places = zone_places(rough, middle, {setup.top_m, {1.0, 0.0, 0.0, 0.0}});
    std::optional<Design> best;
    for (std::size_t turn = 0; turn < starts; ++turn) {
        const Design design =
            improved(spread_out(rows, all.from_priors + all.from_height, setup.count, turn), rows, places);
        if (!best || design.left < best->left) {
            best = design;
        }
    }
    std::vector<Cross> crosses;
    for (const std::size_t k : best->chosen) {
        crosses.push_back(grid[k]);
    }
    std::stable_sort(crosses.begin(), crosses.end(),
                     [](const Cross& a, const Cross& b) { return a.block_m < b.block_m; });
    return crosses;
}

} // namespace frustumscreen
