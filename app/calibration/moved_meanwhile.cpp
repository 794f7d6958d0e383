#include "app/calibration/moved_meanwhile.h"

#include "app/calibration/rigid_move.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace frustumscreen::calibration {

namespace {

constexpr std::size_t fewest = 3; ///< touches before the move, and after it
constexpr int slide_unknowns = 3;
constexpr std::size_t refined = 3; ///< places of the move that are tried beyond the linear step
constexpr int refits = 4;          ///< each squares what is left of the linear step's error

/// A rigid move's six unknowns by those of a slide along the table: its turn and its shift.
Eigen::Matrix<double, 6, slide_unknowns> slides(const TouchModel& model) {
    Eigen::Matrix<double, 6, slide_unknowns> out = Eigen::Matrix<double, 6, slide_unknowns>::Zero();
    out.block<3, 1>(0, 0) = eigen(model.table_up);
    out.block<3, 2>(3, 1) = table_axes(model.table_up);
    return out;
}

Gain gain_by_slide(const FittedTouches& fitted, std::size_t first) {
    const TouchModel& model = fitted.fit.model;
    const Eigen::Matrix<double, unknown_count, slide_unknowns> by_slide =
        by_move(model, Moved::Tracker) * slides(model);
    std::vector<ExtraColumns> columns;
    for (std::size_t k = 0; k < fitted.whitened.rows.size(); ++k) {
        columns.emplace_back(k < first ? ExtraColumns::Zero(3, slide_unknowns)
                                       : ExtraColumns(fitted.whitened.rows[k] * by_slide));
    }
    return gain_by(fitted, columns);
}

/// The touches from `first` on, moved by the slide that makes them fit best.
void undo(Touches& touches, std::size_t first, const FittedTouches& fitted) {
    const RigidMove move = slides(fitted.fit.model) * gain_by_slide(fitted, first).values;
    const geometry::RigidTransform change = rigid(move, fitted.fit.middle);
    for (std::size_t k = first; k < touches.size(); ++k) {
        touches[k].tracker_from_sensor = change * touches[k].tracker_from_sensor;
    }
}

Disturbance moved_before(std::size_t first, std::span<const Touch> touches, const FitSetup& setup,
                         const FittedTouches& all) {
    Touches undone(touches.begin(), touches.end());
    FittedTouches now = all;
    for (int k = 0; k < refits; ++k) {
        undo(undone, first, now);
        now = fitted(undone, setup, now.fit.model);
    }
    Disturbance found{.chi2 = now.fit.chi2,
                      .freedom = now.fit.freedom - slide_unknowns,
                      .unknowns = slide_unknowns + 1,
                      .size_m = 0.0,
                      .touch = first};
    for (std::size_t k = first; k < touches.size(); ++k) {
        const double moved_m = glm::distance(now.fit.model.touched(touches[k].tracker_from_sensor),
                                             now.fit.model.touched(undone[k].tracker_from_sensor));
        found.size_m = std::fmax(found.size_m, moved_m);
    }
    return found;
}

} // namespace

std::optional<Disturbance> moved_meanwhile(std::span<const Touch> touches, const FitSetup& setup,
                                           const FittedTouches& all) {
    std::vector<std::pair<double, std::size_t>> gains; // each with its first touch
    for (std::size_t first = fewest; first + fewest <= touches.size(); ++first) {
        gains.emplace_back(gain_by_slide(all, first).chi2, first);
    }
    std::sort(gains.rbegin(), gains.rend());
    std::optional<Disturbance> best;
    for (std::size_t k = 0; k < std::min(refined, gains.size()); ++k) {
        const Disturbance found = moved_before(gains[k].second, touches, setup, all);
        best = !best || found.chi2 < best->chi2 ? found : *best;
    }
    return best;
}

} // namespace frustumscreen::calibration
