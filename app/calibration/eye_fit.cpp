#include "app/calibration/eye_fit.h"

#include "app/calibration/calibrate_touch.h"
#include "app/calibration/dense_solvers.h"
#include "app/calibration/unknowns.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace frustumscreen::calibration {

namespace {

/// Left eye, then right.
using Both = Eigen::Matrix<double, 6, 1>;
using BothCovariance = Eigen::Matrix<double, 6, 6>;
/// Errors that all sightings share: the cross along the table (2), the tip (3).
using Shared = Eigen::Matrix<double, 5, 1>;

/// 99.9 % quantile of chi squared for a sighting's two residuals.
constexpr double sight_chi2_limit = 13.8;
/// Largest mean of the squared whitened residuals that chance explains.
constexpr double max_scatter2 = 4.0;
/// If an eye's lines meet at smaller angles than this, root mean square, its distance is undetermined.
constexpr double min_spread_rad = 0.12;
constexpr double nearest_pupils_m = 45e-3, farthest_pupils_m = 80e-3;
constexpr double good_m = 0.7e-3, usable_m = 1.5e-3;
constexpr double good_hidden_m = 4e-3, usable_hidden_m = 8e-3;

/// A sighting's line in the sensor's frame.
struct Line {
    Eigen::Index first = 0;     ///< index of its eye's unknowns
    Eigen::Vector3d tip, along; ///< `along`: from the cross to the eye
    double from_cross = 0.0;    ///< distance from the cross to the tip
    Eigen::Matrix<double, 2, 3> across;
    Eigen::Matrix3d sensor_from_table;
};

Line line_of(const EyeSight& sight) {
    Line line;
    line.first = sight.eye == OpenEye::Left ? 0 : 3;
    line.sensor_from_table = eigen(glm::conjugate(glm::normalize(sight.table_from_sensor.rotation)));
    const Eigen::Vector3d way = eigen(sight.tip_m - sight.cross_m);
    line.from_cross = way.norm();
    line.along = line.sensor_from_table * way / line.from_cross;
    line.tip = line.sensor_from_table * eigen(sight.tip_m - sight.table_from_sensor.translation);
    line.across.row(0) = line.along.unitOrthogonal().transpose();
    line.across.row(1) = line.along.cross(line.across.row(0).transpose()).transpose();
    return line;
}

/// A line's two equations, rows * eyes = goal, each divided by its standard deviation.
struct Rows {
    Eigen::Matrix<double, 2, 6> rows = Eigen::Matrix<double, 2, 6>::Zero();
    Eigen::Vector2d goal;
    Eigen::Matrix<double, 2, 5> by_shared; ///< derivatives of the goal by the shared errors
};

/// At an eye at distance D from the tip, the tip's error is magnified by 1 + D / b and the cross's by D / b;
/// b is the distance from cross to tip.
Rows rows_at(const Line& line, const Eigen::Vector3d& eye, const SightNoise& noise) {
    const double times = std::fmax(0.0, (eye - line.tip).dot(line.along)) / line.from_cross;
    const double turned = noise.head_rad * eye.norm();
    const double own = std::hypot(noise.aim_m * (1.0 + times), noise.head_m, turned);
    Rows rows;
    rows.rows.block<2, 3>(0, line.first) = line.across / own;
    rows.goal = line.across * line.tip / own;
    rows.by_shared.leftCols<2>() =
        -noise.cross_m * times / own * line.across * line.sensor_from_table.leftCols<2>();
    rows.by_shared.rightCols<3>() = noise.tip_m * (1.0 + times) / own * line.across * line.sensor_from_table;
    return rows;
}

struct Solution {
    Both eyes = Both::Zero();
    BothCovariance by_noise, covariance; ///< `covariance` includes the shared errors
    std::vector<Rows> rows;
};

/// Fits both eyes to the sightings that are `used`.
Solution solved(std::span<const Line> lines, const std::vector<bool>& used, const SightNoise& noise) {
    Solution solution;
    constexpr int rounds = 5;
    for (int round = 0; round < rounds; ++round) {
        BothCovariance information = BothCovariance::Identity() * 1e-6; // a weak prior
        Both right = Both::Zero();
        Eigen::Matrix<double, 6, 5> shared = Eigen::Matrix<double, 6, 5>::Zero();
        solution.rows.clear();
        for (std::size_t k = 0; k < lines.size(); ++k) {
            const Eigen::Vector3d eye = solution.eyes.segment<3>(lines[k].first);
            const Rows& rows = solution.rows.emplace_back(rows_at(lines[k], eye, noise));
            if (used[k]) {
                information += rows.rows.transpose() * rows.rows;
                right += rows.rows.transpose() * rows.goal;
                shared += rows.rows.transpose() * rows.by_shared;
            }
        }
        solution.by_noise = inverse_of(information);
        solution.eyes = solution.by_noise * right;
        const Eigen::Matrix<double, 6, 5> moves = solution.by_noise * shared;
        solution.covariance = solution.by_noise + moves * moves.transpose();
    }
    return solution;
}

/// Covariance of a sighting's residuals: the noise less the sighting's own part in the fit, plus the shared
/// errors, which appear where the head turns.
Eigen::Matrix2d left_of(const Rows& rows, const Solution& solution) {
    return Eigen::Matrix2d::Identity() - rows.rows * solution.by_noise * rows.rows.transpose() +
           rows.by_shared * rows.by_shared.transpose();
}

double chi2_of(const Rows& rows, const Solution& solution) {
    const Eigen::Vector2d residual = rows.rows * solution.eyes - rows.goal;
    return residual.dot(left_of(rows, solution).ldlt().solve(residual));
}

/// Chi squared of the used sightings over its degrees of freedom.
double scatter2_of(const Solution& solution, const std::vector<bool>& used) {
    double chi2 = 0.0;
    double freedom = -6.0;
    for (std::size_t k = 0; k < used.size(); ++k) {
        if (used[k]) {
            chi2 += (solution.rows[k].rows * solution.eyes - solution.rows[k].goal).squaredNorm();
            freedom += 2.0;
        }
    }
    return chi2 / freedom;
}

bool agree(const Solution& solution, const std::vector<bool>& used) {
    for (std::size_t k = 0; k < used.size(); ++k) {
        if (used[k] && chi2_of(solution.rows[k], solution) > sight_chi2_limit) {
            return false;
        }
    }
    return scatter2_of(solution, used) < max_scatter2;
}

bool are_enough(std::span<const Line> lines, const std::vector<bool>& used) {
    std::array<std::size_t, 2> count{};
    for (std::size_t k = 0; k < lines.size(); ++k) {
        count[lines[k].first == 0 ? 0 : 1] += used[k] ? 1 : 0;
    }
    return std::min(count[0], count[1]) >= min_sights;
}

/// True if the shared errors, cross and tip, are larger than chance allows in 99.9 % of cases: then the
/// picture is not where the calibration says. Turned heads reveal this, because the lines then do not meet.
bool is_shared_off(const Solution& solution, const std::vector<bool>& used) {
    Eigen::Matrix<double, 6, 5> mixed = Eigen::Matrix<double, 6, 5>::Zero();
    Eigen::Matrix<double, 5, 5> information =
        Eigen::Matrix<double, 5, 5>::Zero(); // on the shared errors, with the eyes marginalised
    Shared pull = Shared::Zero();
    for (std::size_t k = 0; k < used.size(); ++k) {
        if (used[k]) {
            const Rows& rows = solution.rows[k];
            mixed += rows.rows.transpose() * rows.by_shared;
            information += rows.by_shared.transpose() * rows.by_shared;
            pull += rows.by_shared.transpose() * (rows.rows * solution.eyes - rows.goal);
        }
    }
    information -= mixed.transpose() * solution.by_noise * mixed;
    // The pull is information * shared + noise, whose covariance is the information; `shared` has unit
    // variance. Axes without information are skipped.
    const SymmetricAxes axes = axes_of(information);
    constexpr double limit = 20.5; // 99.9 % quantile of chi squared, five degrees of freedom
    double chi2 = 0.0;
    for (Eigen::Index k = 0; k < 5; ++k) {
        const double t = axes.values[k];
        chi2 += t > 1e-3 ? std::pow(axes.vectors.col(k).dot(pull), 2.0) / (t + t * t) : 0.0;
    }
    return chi2 > limit;
}

/// Leaves out the fewest sightings, one or two, without which all others agree; of several sets, the one with
/// the least scatter. Nothing if no such set exists.
std::optional<std::vector<bool>> agreeing(std::span<const Line> lines, const SightNoise& noise) {
    const std::vector<bool> all(lines.size(), true);
    if (agree(solved(lines, all, noise), all)) {
        return all;
    }
    std::optional<std::vector<bool>> best;
    double least = 0.0;
    const auto consider = [&](std::size_t a, std::size_t b) {
        std::vector<bool> used = all;
        used[a] = used[b] = false;
        if (!are_enough(lines, used)) {
            return;
        }
        const Solution solution = solved(lines, used, noise);
        if (const double scatter2 = scatter2_of(solution, used);
            agree(solution, used) && (!best || scatter2 < least)) {
            least = scatter2;
            best = used;
        }
    };
    for (std::size_t a = 0; a < lines.size(); ++a) {
        consider(a, a);
    }
    for (std::size_t a = 0; a < lines.size() && !best; ++a) {
        for (std::size_t b = a + 1; b < lines.size(); ++b) {
            consider(a, b);
        }
    }
    return best;
}

/// Spread of an eye's line directions in the sensor's frame: root mean square angle about the worse of the
/// two axes across their mean.
double spread_rad(std::span<const Line> lines, Eigen::Index first) {
    Eigen::Matrix3d parallel = Eigen::Matrix3d::Zero();
    double count = 0.0;
    for (const Line& line : lines) {
        if (line.first == first) {
            parallel += line.along * line.along.transpose();
            count += 1.0;
        }
    }
    const SymmetricAxes axes = axes_of(parallel / count);
    return std::sqrt(std::fmax(0.0, 1.0 - axes.values[2]));
}

/// The reason why the sightings determine nothing; nothing if they may determine the eyes.
std::optional<VerdictReason> refusal_of(std::span<const EyeSight> sights, std::span<const Line> lines) {
    for (std::size_t k = 0; k < lines.size(); ++k) {
        if (!(lines[k].from_cross > 0.02) || sights[k].tip_m.z < sights[k].cross_m.z) {
            return VerdictReason{
                "sightings.cross_too_near",
                fmt::format(
                    "sighting {}: the cross is less than 2 cm from the place that covers it, or above it",
                    k + 1)};
        }
    }
    const auto of_left = static_cast<std::size_t>(
        std::count_if(lines.begin(), lines.end(), [](const Line& line) { return line.first == 0; }));
    const std::size_t of_right = lines.size() - of_left;
    if (std::min(of_left, of_right) < min_sights) {
        return VerdictReason{
            "sightings.too_few",
            fmt::format(
                "there are {} sightings with the left eye and {} with the right one; {} with each are needed",
                of_left, of_right, min_sights)};
    }
    for (const Eigen::Index first : {0, 3}) {
        if (spread_rad(lines, first) < min_spread_rad) {
            return VerdictReason{"sightings.head_alike",
                                 fmt::format("the head was held nearly alike in all sightings with the {} "
                                             "eye, which does not tell how "
                                             "far in front of the sensor it is: between them turn the head, "
                                             "and move the chin up and down",
                                             first == 0 ? "left" : "right")};
        }
    }
    return std::nullopt;
}

/// The linear map from both eyes to their mean.
Eigen::Matrix<double, 3, 6> middle_rows() {
    Eigen::Matrix<double, 3, 6> rows;
    rows << 0.5 * Eigen::Matrix3d::Identity(), 0.5 * Eigen::Matrix3d::Identity();
    return rows;
}

/// Picture error that an eye's covariance causes: its part across the lines of sight, scaled by their
/// distance.
double on_picture_m(const Eigen::Matrix3d& spread, std::span<const Line> lines, const Eigen::Vector3d& eye,
                    double deep_m) {
    double sum = 0.0;
    for (const Line& line : lines) {
        const double share = deep_m / std::fmax(0.05, (eye - line.tip).norm());
        sum += share * share * (line.across * spread * line.across.transpose()).trace();
    }
    return std::sqrt(sum / static_cast<double>(lines.size()));
}

FittedEyes eyes_of(const Solution& solution, std::span<const Line> lines, const std::vector<bool>& used,
                   double deep_m) {
    const Eigen::Matrix<double, 3, 6> to_middle = middle_rows();
    const Eigen::Vector3d middle = to_middle * solution.eyes;
    FittedEyes eyes;
    eyes.left_m = glm_vector(solution.eyes.head<3>());
    eyes.right_m = glm_vector(solution.eyes.tail<3>());
    eyes.middle_m = glm_vector(middle);
    eyes.covariance =
        std::fmax(1.0, scatter2_of(solution, used)) * to_middle * solution.covariance * to_middle.transpose();
    eyes.picture_m = on_picture_m(eyes.covariance, lines, middle, deep_m);
    for (std::size_t k = 0; k < lines.size(); ++k) {
        if (used[k]) { // the largest unnoticed error, in its worst direction (Baarda 1968)
            const Rows& rows = solution.rows[k];
            const Eigen::Matrix<double, 3, 2> moves = to_middle * solution.by_noise * rows.rows.transpose();
            const Eigen::Matrix3d hidden =
                sight_chi2_limit * moves * left_of(rows, solution).inverse() * moves.transpose();
            eyes.hidden_m = std::fmax(eyes.hidden_m, on_picture_m(hidden, lines, middle, deep_m));
        }
    }
    return eyes;
}

void judge(EyeFit& fit) {
    const FittedEyes& eyes = *fit.eyes;
    const std::string expected =
        fmt::format("the eye's place puts about {:.1f} mm on the picture", 1e3 * eyes.picture_m);
    const double pupils_m = glm::distance(eyes.left_m, eyes.right_m);
    if (pupils_m < nearest_pupils_m || pupils_m > farthest_pupils_m) {
        fit.eyes.reset();
        fit.reason = {
            "sightings.pupils",
            fmt::format(
                "the two eyes would be {:.0f} mm apart; allowed is {:.0f} to {:.0f} mm: was the other eye "
                "shut in some sightings, or did the sensor slip on the head?",
                1e3 * pupils_m, 1e3 * nearest_pupils_m, 1e3 * farthest_pupils_m)};
    } else if (!fit.repeat.empty()) {
        fit.verdict = Verdict::Repeat;
        fit.reason = misfits("sighting", "sightings", row_names(fit.repeat));
    } else if (eyes.picture_m <= good_m && eyes.hidden_m <= good_hidden_m) {
        fit.verdict = Verdict::Good;
        fit.reason = {"sightings.good", expected};
    } else if (eyes.picture_m <= usable_m && eyes.hidden_m <= usable_hidden_m) {
        fit.verdict = Verdict::Usable;
        fit.reason = {"sightings.usable", expected + "; with more sightings it would be good"};
    } else {
        fit.verdict = Verdict::Repeat;
        fit.reason = {
            "sightings.unchecked",
            expected +
                "; a wrong sighting may go unnoticed: make more of them, with the head turned further"};
    }
}

} // namespace

EyeFit fit_eyes(std::span<const EyeSight> sights, double deep_m, const SightNoise& noise) {
    EyeFit fit;
    std::vector<Line> lines;
    std::transform(sights.begin(), sights.end(), std::back_inserter(lines), line_of);
    if (std::optional<VerdictReason> refusal = refusal_of(sights, lines)) {
        fit.reason = *std::move(refusal);
        return fit;
    }
    const std::optional<std::vector<bool>> used = agreeing(lines, noise);
    if (!used) {
        fit.reason = {"sightings.contradict",
                      "the sightings contradict each other, and one or two wrong ones do not explain it: did "
                      "the sensor slip on the head, was the prop moved, or was the wrong eye shut?"};
        return fit;
    }
    const Solution solution = solved(lines, *used, noise);
    if (is_shared_off(solution, *used)) {
        fit.reason = {"sightings.crosses_off",
                      "all sightings together say that the crosses or the prop's place lie beside where the "
                      "calibration has them: put the "
                      "picture right first (table --touch-up), and let the prop lie"};
        return fit;
    }
    double count = 0.0;
    for (std::size_t k = 0; k < lines.size(); ++k) {
        std::vector<bool> others = *used;
        others[k] = false;
        const Eigen::Vector3d eye = solved(lines, others, noise).eyes.segment<3>(lines[k].first);
        const double residual_m = (lines[k].across * (eye - lines[k].tip)).norm();
        fit.residuals_m.push_back(residual_m);
        if ((*used)[k]) {
            fit.mean_residual_m += residual_m;
            fit.worst_residual_m = std::fmax(fit.worst_residual_m, residual_m);
            count += 1.0;
        } else {
            fit.repeat.push_back(k);
        }
    }
    fit.mean_residual_m /= count;
    fit.eyes = eyes_of(solution, lines, *used, deep_m);
    judge(fit);
    return fit;
}

} // namespace frustumscreen::calibration
