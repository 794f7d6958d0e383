#include "app/calibration/near_metal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen::calibration {

namespace {

constexpr int metal_unknowns = 4;
/// Metal that is nearer to a sensor disturbs that touch alone.
constexpr double nearest_m = 0.06;
constexpr double grid_m = 0.06;
constexpr double margin_m = 0.12;                                 ///< of the grid about the touches
constexpr std::array heights_m{-0.2, -0.1, -0.05, 0.0, 0.1, 0.2}; ///< of the grid above the table
constexpr int refits = 6;
constexpr double longest_step_m = 0.05; ///< of the metal's place, in one refit

struct Metal {
    glm::dvec3 place{0.0}; ///< in K
    double strength_m3 = 0.0;
};

/// The field at `at` of dipoles along the three axes at the origin, one per column.
Eigen::Matrix3d dipole(const Eigen::Vector3d& at) {
    const Eigen::Vector3d n = at.normalized();
    return (3.0 * n * n.transpose() - Eigen::Matrix3d::Identity()) / std::pow(at.norm(), 3.0);
}

bool far_enough(const glm::dvec3& metal, std::span<const Touch> touches) {
    return std::all_of(touches.begin(), touches.end(), [&](const Touch& touch) {
        return glm::distance(touch.tracker_from_sensor.translation, metal) > nearest_m;
    });
}

Touches without(const Metal& metal, std::span<const Touch> touches) {
    Touches undone(touches.begin(), touches.end());
    for (Touch& touch : undone) {
        const geometry::RigidTransform said = touch.tracker_from_sensor;
        for (int k = 0; k < 2; ++k) { // the bend at the true place, which is near the reported one
            const glm::dvec3 at = touch.tracker_from_sensor.translation;
            touch.tracker_from_sensor =
                rigid(-metal.strength_m3 * bend_by_metal(at, metal.place), said.translation) * said;
        }
    }
    return undone;
}

/// The move about the fit's middle that is this move about the sensor.
RigidMove about(const glm::dvec3& middle, const glm::dvec3& sensor, const RigidMove& move) {
    RigidMove out = move;
    const Eigen::Vector3d turn = move.head<3>();
    out.tail<3>() -= turn.cross(eigen(sensor) - eigen(middle));
    return out;
}

/// Columns by the strength, and by the place if `by_place`.
std::vector<ExtraColumns> columns_of(const Metal& metal, std::span<const Touch> touches,
                                     const FittedTouches& fitted, bool by_place) {
    constexpr double step_m = 1e-4;
    const ByRigidMove moves = by_move(fitted.fit.model, Moved::Tracker);
    std::vector<ExtraColumns> columns;
    for (std::size_t k = 0; k < touches.size(); ++k) {
        const glm::dvec3& sensor = touches[k].tracker_from_sensor.translation;
        const RigidMove bend = bend_by_metal(sensor, metal.place);
        Eigen::MatrixXd by(6, by_place ? metal_unknowns : 1);
        by.col(0) = about(fitted.fit.middle, sensor, bend);
        for (int axis = 0; by_place && axis < 3; ++axis) {
            glm::dvec3 beside = metal.place;
            beside[axis] += step_m;
            by.col(1 + axis) = metal.strength_m3 / step_m *
                               about(fitted.fit.middle, sensor, bend_by_metal(sensor, beside) - bend);
        }
        columns.emplace_back(
            -(fitted.whitened.rows[k] * moves * by)); // undone, a touch moves against the bend
    }
    return columns;
}

/// Half the size of the box of places along an axis.
double reach(std::span<const Touch> touches, const glm::dvec3& middle, const Eigen::Vector3d& axis) {
    double farthest = 0.0;
    for (const Touch& touch : touches) {
        farthest =
            std::fmax(farthest, std::abs(axis.dot(eigen(touch.tracker_from_sensor.translation - middle))));
    }
    return farthest + margin_m;
}

std::optional<Metal> best_on_grid(std::span<const Touch> touches, const FittedTouches& all) {
    const TouchModel& model = all.fit.model;
    const Eigen::Matrix<double, 3, 2> axes = table_axes(model.table_up);
    const glm::dvec3 middle = all.fit.middle;
    const glm::dvec3 on_table = middle - model.height(middle) * model.table_up;
    const int across = static_cast<int>(reach(touches, middle, axes.col(0)) / grid_m);
    const int along = static_cast<int>(reach(touches, middle, axes.col(1)) / grid_m);
    std::optional<Metal> best;
    double most = -1.0;
    for (const double height_m : heights_m) {
        for (int a = -across; a <= across; ++a) {
            for (int b = -along; b <= along; ++b) {
                Metal metal{.place = on_table + height_m * model.table_up +
                                     glm_vector(axes * Eigen::Vector2d(grid_m * a, grid_m * b))};
                if (!far_enough(metal.place, touches)) {
                    continue;
                }
                const Gain gain = gain_by(all, columns_of(metal, touches, all, false));
                if (gain.chi2 > most) {
                    most = gain.chi2;
                    metal.strength_m3 = gain.values[0];
                    best = metal;
                }
            }
        }
    }
    return best;
}

Disturbance described(const Metal& metal, std::span<const Touch> touches, const Fit& fit) {
    Disturbance found{.chi2 = fit.chi2,
                      .freedom = fit.freedom - metal_unknowns,
                      .unknowns = metal_unknowns,
                      .size_m = 0.0,
                      .touch = 0};
    for (std::size_t k = 0; k < touches.size(); ++k) {
        const RigidMove bend = bend_by_metal(touches[k].tracker_from_sensor.translation, metal.place);
        const double bend_m = std::abs(metal.strength_m3) * bend.tail<3>().norm();
        found.touch = bend_m > found.size_m ? k : found.touch;
        found.size_m = std::fmax(found.size_m, bend_m);
    }
    return found;
}

} // namespace

// The tracker takes the squared field's trace for the distance, its first eigenvector for the direction, and what is left
// for the turn. `share` is the metal's field: each is changed to first order.
RigidMove bend_by_metal(const glm::dvec3& sensor, const glm::dvec3& metal) {
    const Eigen::Vector3d at = eigen(sensor);
    const double r = at.norm();
    const Eigen::Vector3d n = at / r;
    const Eigen::Matrix3d field = dipole(at);
    const Eigen::Matrix3d inverse = r * r * r * (1.5 * n * n.transpose() - Eigen::Matrix3d::Identity());
    const Eigen::Matrix3d share = dipole(at - eigen(metal)) * dipole(eigen(metal));
    const Eigen::Matrix3d square = field * share + (field * share).transpose();
    const double longer = -std::pow(r, 7.0) * square.trace() / 36.0;
    const Eigen::Vector3d along = square * n;
    const Eigen::Vector3d aside = std::pow(r, 6.0) / 3.0 * (along - n.dot(along) * n);
    RigidMove bend;
    bend.tail<3>() = longer * n + r * aside;
    // The field changes by `bend` where the tracker believes to be; the share that this does not explain is a turn.
    const Eigen::Matrix3d moved =
        (3.0 * (aside * n.transpose() + n * aside.transpose())) / std::pow(r, 3.0) - 3.0 * longer / r * field;
    const Eigen::Matrix3d left = (share - moved) * inverse;
    bend.head<3>() =
        -0.5 * Eigen::Vector3d(left(2, 1) - left(1, 2), left(0, 2) - left(2, 0), left(1, 0) - left(0, 1));
    return bend;
}

std::optional<Disturbance> near_metal(std::span<const Touch> touches, const FitSetup& setup,
                                      const FittedTouches& all) {
    std::optional<Metal> metal = best_on_grid(touches, all);
    if (!metal) {
        return std::nullopt;
    }
    std::optional<Disturbance> best;
    TouchModel start = all.fit.model;
    for (int k = 0; k < refits; ++k) {
        const Touches undone = without(*metal, touches);
        const FittedTouches now = fitted(undone, setup, start);
        start = now.fit.model;
        if (!best || now.fit.chi2 < best->chi2) {
            best = described(*metal, touches, now.fit);
        }
        const Gain gain = gain_by(now, columns_of(*metal, undone, now, true));
        Eigen::Vector3d step = gain.values.tail<3>();
        step *= std::fmin(1.0, longest_step_m / std::fmax(longest_step_m, step.norm()));
        metal->strength_m3 += gain.values[0];
        metal->place += glm_vector(step);
        if (!far_enough(metal->place, touches)) {
            break;
        }
    }
    return best;
}

} // namespace frustumscreen::calibration
