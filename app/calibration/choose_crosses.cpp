#include "app/calibration/choose_crosses.h"

#include "app/calibration/fit.h"
#include "app/calibration/reliability.h"
#include "app/calibration/rigid_move.h"
#include "app/calibration/zone.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace frustumscreen::calibration {

namespace {

/// A noise-free touch at a cross, by the model.
Touch perfect_touch(const TouchModel& model, const Cross& cross) {
    const std::optional<glm::dvec3> place = model.lit(cross.pixel, cross.block_m);
    assert(place);
    const glm::dquat turn = glm::angleAxis(cross.yaw_rad, model.table_up);
    return {{turn, *place - turn * model.sensor_offset_m}, cross.pixel, cross.block_m};
}

/// A rectangle of the picture.
struct PixelRange {
    glm::dvec2 from;
    glm::dvec2 to;
};

/// The range of crosses at a height: within the picture's margin, and within reach. For a rotated picture, a
/// rectangle that is surely within reach.
PixelRange range_at(const TouchModel& model, const CrossSetup& setup, double height_m) {
    constexpr double min_range = 0.1; // widths
    const geometry::Pinhole& p = model.pinhole;
    const glm::dvec2 margin(setup.margin * p.width);
    PixelRange range{margin, glm::dvec2(p.width, p.height) - margin};
    if (!setup.reach_m) {
        return range;
    }
    std::array<double, 4> u{};
    std::array<double, 4> v{};
    for (std::size_t k = 0; k < 4; ++k) {
        const glm::dvec2 sign(k % 2 == 0 ? -1.0 : 1.0, k / 2 == 0 ? -1.0 : 1.0);
        const glm::dvec2 place = sign * glm::max(*setup.reach_m, glm::dvec2(0.0));
        const std::optional<glm::dvec2> corner = model.pixel(glm::dvec3(place, height_m));
        u[k] = corner ? corner->x : 0.5 * p.width;
        v[k] = corner ? corner->y : 0.5 * p.height;
    }
    std::sort(u.begin(), u.end());
    std::sort(v.begin(), v.end());
    const glm::dvec2 middle(0.25 * (u[0] + u[1] + u[2] + u[3]), 0.25 * (v[0] + v[1] + v[2] + v[3]));
    const glm::dvec2 half =
        glm::max(glm::min(glm::dvec2(u[2], v[2]) - middle, middle - glm::dvec2(u[1], v[1])),
                 glm::dvec2(0.5 * min_range * p.width));
    return {glm::max(range.from, middle - half), glm::min(range.to, middle + half)};
}

std::vector<Cross> grid_of(const TouchModel& model, const CrossSetup& setup) {
    constexpr int columns = 8;
    constexpr int rows = 6;
    std::vector<Cross> crosses;
    // Over the whole picture, no intermediate height is chosen from eight touches on, but these heights lead
    // the exchange to better designs. Within reach they gain nothing, and a technician would need boards of
    // more heights.
    const int steps = setup.reach_m ? 1 : 3;
    for (int step = 0; step <= steps; ++step) {
        const double block = step * setup.block_m / steps;
        const PixelRange range = range_at(model, setup, block);
        for (int k = 0; k < (columns + 1) * (rows + 1); ++k) {
            const glm::ivec2 node(k % (columns + 1), k / (columns + 1));
            const glm::dvec2 share = glm::dvec2(node) / glm::dvec2(columns, rows);
            const glm::dvec2 pixel = range.from + (range.to - range.from) * share;
            for (int quarter = 0; quarter < 4; ++quarter) {
                crosses.push_back({pixel, block, 0.5 * std::numbers::pi * quarter});
            }
        }
    }
    return crosses;
}

/// Candidate crosses, the information of each, and the places where the picture must be accurate.
struct Choice {
    std::vector<Cross> grid;
    std::vector<TouchRows> rows; ///< of each cross
    std::vector<ZonePlace> places;
    Covariance known; ///< information without touches
    double hidden_share =
        0.0; ///< weight of the unnoticed error beside the noise: a wrong touch is rarer, and larger
    std::size_t starts = 1;
};

struct Design {
    std::vector<std::size_t> chosen; ///< indices into the grid
    std::size_t fixed = 0;           ///< the first ones, which are kept
    Covariance information;
    double left = 0.0; ///< objective that remains
};

/// The mean variance over the zone for an information matrix.
double left_by(const Covariance& information, const Covariance& zone) {
    return information.llt().solve(zone).trace();
}

/// A start whose crosses are spread out, different for each `turn`.
Design spread_out(const Choice& choice, std::span<const std::size_t> fixed, int count, std::size_t turn) {
    Design design{.chosen = {fixed.begin(), fixed.end()}, .fixed = fixed.size(), .information = choice.known};
    for (int k = 0; k < count; ++k) {
        design.chosen.push_back((static_cast<std::size_t>(k) * 7919 + turn * 389) % choice.rows.size());
    }
    for (const std::size_t cross : design.chosen) {
        design.information += choice.rows[cross].transpose() * choice.rows[cross];
    }
    return design;
}

/// The mean variance for an information matrix plus three rows, for many candidates of these rows: by
/// Woodbury's identity, a 19 x 19 matrix is inverted once, not for each candidate.
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

/// Exchanges each cross for the best one until no exchange improves the design.
void exchange(Design& design, std::span<const TouchRows> rows, const Covariance& zone) {
    design.left = left_by(design.information, zone);
    for (bool better = true; better;) {
        better = false;
        for (std::size_t k = design.fixed; k < design.chosen.size(); ++k) {
            std::size_t& mine = design.chosen[k];
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

/// Minimises the mean over the zone first, then a mean that weights places by their variance.
Design improved(Design design, const Choice& choice) {
    std::vector<double> weights(choice.places.size(), 1.0);
    exchange(design, choice.rows, weighted(choice.places, weights));
    for (int round = 0; round < 2; ++round) {
        const Covariance covariance = design.information.llt().solve(Covariance::Identity());
        for (std::size_t k = 0; k < choice.places.size(); ++k) {
            const LightRows& rows = choice.places[k].rows;
            weights[k] = (rows * covariance * rows.transpose()).trace();
        }
        exchange(design, choice.rows, weighted(choice.places, weights));
    }
    const Covariance covariance = design.information.llt().solve(Covariance::Identity());
    const PictureUncertainty left = picture_uncertainty(choice.places, covariance);
    std::vector<TouchRows> chosen;
    for (const std::size_t k : design.chosen) {
        chosen.push_back(choice.rows[k]);
    }
    design.left =
        left.mean_m + left.worst_m + choice.hidden_share * hidden_error_m(chosen, covariance, choice.places);
    return design;
}

/// The `fixed` crosses and the best `count` in addition to them.
std::vector<std::size_t> best_of(const Choice& choice, std::span<const std::size_t> fixed, int count) {
    std::optional<Design> best;
    for (std::size_t turn = 0; turn < choice.starts; ++turn) {
        Design design = improved(spread_out(choice, fixed, count, turn), choice);
        if (!best || design.left < best->left) {
            best = std::move(design);
        }
    }
    return best->chosen;
}

/// The information of the grid's crosses at a model.
Choice choice_of(const TouchModel& rough, const CrossSetup& setup, const TouchNoise& noise) {
    Choice choice;
    choice.grid = grid_of(rough, setup);
    Touches touches;
    for (const Cross& cross : choice.grid) {
        touches.push_back(perfect_touch(rough, cross));
    }
    const FitSetup fit_setup{.noise = noise,
                             .priors = setup.priors,
                             .sensor_height_m = -glm::dot(rough.table_up, rough.sensor_offset_m),
                             .upright = {}};
    const glm::dvec3 middle = middle_of(touches);
    choice.rows = whitened_touches(touches, fit_setup, rough, middle).rows;
    const Fit all = information_of(touches, fit_setup, rough, middle);
    choice.known = all.from_priors + all.from_height;
    choice.places = zone_places(rough, middle, {setup.top_m, {1.0, 0.0, 0.0, 0.0}});
    return choice;
}

/// Crosses of the grid, from low to high.
std::vector<Cross> crosses_of(const Choice& choice, std::span<const std::size_t> chosen) {
    std::vector<Cross> crosses;
    for (const std::size_t k : chosen) {
        crosses.push_back(choice.grid[k]);
    }
    std::stable_sort(crosses.begin(), crosses.end(),
                     [](const Cross& a, const Cross& b) { return a.block_m < b.block_m; });
    return crosses;
}

/// The best `count` crosses, and after them the best `more` to add.
std::vector<Cross> first_and_more(const Choice& choice, int count, int more) {
    const std::vector<std::size_t> first = best_of(choice, {}, count);
    std::vector<Cross> crosses = crosses_of(choice, first);
    if (more > 0) {
        const std::vector<std::size_t> all = best_of(choice, first, more);
        const std::vector<Cross> others = crosses_of(choice, std::span(all).subspan(first.size()));
        crosses.insert(crosses.end(), others.begin(), others.end());
    }
    return crosses;
}

} // namespace

glm::dvec2 reach_of(const glm::dvec2& table_m, double prop_base_m) {
    return 0.5 * table_m - glm::dvec2(0.5 * prop_base_m + stand_margin_m);
}

double overhang_m(const TouchModel& rough, std::span<const Cross> crosses, const glm::dvec2& reach_m) {
    constexpr double rounding_m = 1e-6;
    double max_m = 0.0;
    for (const Cross& cross : crosses) {
        if (const std::optional<glm::dvec3> place = rough.lit(cross.pixel, cross.block_m)) {
            const glm::dvec2 over = glm::abs(glm::dvec2(*place)) - reach_m;
            max_m = std::fmax(max_m, std::fmax(over.x, over.y));
        }
    }
    return max_m > rounding_m ? max_m : 0.0;
}

TouchModel rough_model(const geometry::Pinhole& pinhole, double above_m, double sensor_height_m) {
    TouchModel model;
    model.pinhole = pinhole;
    model.projector_from_tracker =
        geometry::RigidTransform{glm::dquat(0.0, 1.0, 0.0, 0.0), glm::dvec3(0.0, 0.0, above_m)}.inverse();
    model.sensor_offset_m = {0.0, 0.0, -sensor_height_m};
    return model;
}

std::vector<Cross> choose_crosses(const TouchModel& rough, const CrossSetup& setup, int more) {
    Choice choice = choice_of(rough, setup, setup.noise);
    choice.hidden_share = 0.05;
    choice.starts = 4;
    return first_and_more(choice, setup.count, more);
}

/// Assumes that the projector moved, the harder case: heights then carry no information. All else is fixed as
/// tightly as the arithmetic allows.
std::vector<Cross> choose_touch_up_crosses(const TouchModel& kept, const CrossSetup& setup, int more) {
    TouchNoise noise = setup.noise;
    noise.position_m = std::hypot(noise.position_m, kept_error_m);
    Choice choice = choice_of(kept, setup, noise);
    constexpr double sure = 1e-5; // radians, metres, shares
    const ByRigidMove moves = by_move(kept, Moved::Projector);
    const RigidMove variances = usual_move_weights().cwiseInverse();
    const Covariance open =
        Covariance::Identity() * (sure * sure) + moves * variances.asDiagonal() * moves.transpose();
    choice.known = open.llt().solve(Covariance::Identity());
    choice.hidden_share = 0.5;
    choice.starts = 8;
    return first_and_more(choice, setup.count, more);
}

} // namespace frustumscreen::calibration
