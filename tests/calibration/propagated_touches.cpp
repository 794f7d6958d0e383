#include "tests/calibration/propagated_touches.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace frustumscreen::calibration {

namespace {

constexpr int unknowns =
    22; ///< three more than are determined: the table's frame may rotate and shift in its plane
constexpr int boards = 21; ///< relative excess of the boards' true height
using Unknowns = Eigen::Matrix<double, unknowns, 1>;
using Squares = Eigen::Matrix<double, unknowns, unknowns>;
constexpr double difference = 1e-6;

glm::dquat turn(double x, double y, double z) {
    return glm::normalize(glm::dquat(1.0, 0.5 * x, 0.5 * y, 0.5 * z));
}

/// The truth, changed by shares of the focal lengths and of the picture's width, radians and metres.
CalibratedTable changed_truth(const CalibratedTable& truth, const Unknowns& by) {
    CalibratedTable table = truth;
    geometry::Pinhole& p = table.pinhole;
    p.fx *= 1.0 + by[0];
    p.fy *= 1.0 + by[1];
    p.cx += by[2] * p.width;
    p.cy += by[3] * p.width;
    p.lens.k1 += by[4];
    p.lens.k2 += by[5];
    table.table_from_projector.rotation = truth.table_from_projector.rotation * turn(by[6], by[7], by[8]);
    table.table_from_projector.translation += glm::dvec3(by[9], by[10], by[11]);
    table.table_from_tracker.rotation = turn(by[12], by[13], by[14]) * truth.table_from_tracker.rotation;
    table.table_from_tracker.translation += glm::dvec3(by[15], by[16], by[17]);
    table.sensor_offset_m += glm::dvec3(by[18], by[19], by[20]);
    return table;
}

/// The pixel and height of a touch that a table predicts from the tracker's report.
Eigen::Vector3d predicted(const CalibratedTable& table, const geometry::RigidTransform& tracker_from_sensor) {
    const glm::dvec3 place = table.table_from_tracker.point(tracker_from_sensor.point(table.sensor_offset_m));
    const glm::dvec2 pixel = simulators::calibrated_pixel(table, place);
    return {pixel.x, pixel.y, place.z};
}

Eigen::Matrix3d covariance_of(const CalibratedTable& truth, const Touch& touch, const TouchNoise& noise) {
    const Eigen::Vector3d here = predicted(truth, touch.tracker_from_sensor);
    Eigen::Matrix3d covariance =
        Eigen::Vector3d(noise.pixel, noise.pixel, noise.block_m).cwiseAbs2().asDiagonal();
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 step(0.0);
        step[axis] = difference;
        geometry::RigidTransform moved = touch.tracker_from_sensor;
        moved.translation += step;
        geometry::RigidTransform turned = touch.tracker_from_sensor;
        turned.rotation = turn(step.x, step.y, step.z) * turned.rotation;
        const Eigen::Vector3d by_move = (predicted(truth, moved) - here) * (noise.position_m / difference);
        const Eigen::Vector3d by_turn = (predicted(truth, turned) - here) * (noise.rotation_rad / difference);
        covariance += by_move * by_move.transpose() + by_turn * by_turn.transpose();
    }
    return covariance;
}

double height_of_sensor(const CalibratedTable& table, const std::vector<Touch>& touches) {
    double sum = 0.0;
    for (const Touch& touch : touches) {
        const geometry::RigidTransform& pose = touch.tracker_from_sensor;
        sum -= (table.table_from_tracker.rotation * (pose.rotation * table.sensor_offset_m)).z;
    }
    return sum / static_cast<double>(touches.size());
}

/// A row for each prior, divided by its standard deviation; `off`: the prior's mean less the truth, divided
/// likewise.
struct PriorRows {
    Eigen::Matrix<double, 7, unknowns> rows = Eigen::Matrix<double, 7, unknowns>::Zero();
    Eigen::Matrix<double, 7, 1> off = Eigen::Matrix<double, 7, 1>::Zero();
};
PriorRows prior_rows(const simulators::SimulatedTable& table, const Priors& priors) {
    const geometry::Pinhole& p = table.truth.pinhole;
    PriorRows known;
    known.rows(0, 0) = 1.0 / priors.aspect;
    known.rows(0, 1) = -1.0 / priors.aspect;
    known.off[0] = -std::log(p.fx / p.fy) / priors.aspect;
    known.rows(1, 2) = 1.0 / priors.centre_u;
    known.off[1] = (0.5 * p.width - p.cx) / p.width / priors.centre_u;
    known.rows(2, 3) = 1.0 / priors.centre_v;
    known.off[2] = (0.5 * p.height - p.cy) / p.width / priors.centre_v;
    known.rows(3, 4) = 1.0 / priors.k1;
    known.off[3] = -p.lens.k1 / priors.k1;
    known.rows(4, 5) = 1.0 / priors.k2;
    known.off[4] = -p.lens.k2 / priors.k2;
    known.rows(5, boards) = 1.0 / priors.boards;
    return known; // the last row belongs to the sensor's height
}

/// Derivatives of the picture's offsets by differences, a column for each unknown.
Eigen::MatrixXd picture_by_unknown(const simulators::SimulatedTable& table, double top_m) {
    const auto places =
        static_cast<Eigen::Index>(simulators::registration_offsets(table, table.truth, top_m).size());
    Eigen::MatrixXd rows(3 * places, unknowns);
    for (int k = 0; k < unknowns; ++k) {
        const std::vector<glm::dvec3> offsets = simulators::registration_offsets(
            table, changed_truth(table.truth, difference * Unknowns::Unit(k)), top_m);
        for (Eigen::Index place = 0; place < places; ++place) {
            const glm::dvec3& offset = offsets[static_cast<std::size_t>(place)];
            rows.block<3, 1>(3 * place, k) = Eigen::Vector3d(offset.x, offset.y, offset.z) / difference;
        }
    }
    return rows;
}

} // namespace

PropagatedTouches propagated_touches(const simulators::SimulatedTable& table,
                                     const std::vector<Touch>& touches, const TouchNoise& noise,
                                     const Priors& priors, double top_m) {
    Eigen::MatrixXd by_unknown(3 * static_cast<Eigen::Index>(touches.size()), unknowns); // whitened
    PriorRows known = prior_rows(table, priors);
    std::vector<Eigen::Matrix3d> whitening;
    for (const Touch& touch : touches) {
        const Eigen::LLT<Eigen::Matrix3d> factor(covariance_of(table.truth, touch, noise));
        whitening.emplace_back(factor.matrixL().solve(Eigen::Matrix3d::Identity()));
    }
    for (int k = 0; k < unknowns; ++k) {
        const CalibratedTable changed = changed_truth(table.truth, difference * Unknowns::Unit(k));
        for (std::size_t touch = 0; touch < touches.size(); ++touch) {
            const geometry::RigidTransform& pose = touches[touch].tracker_from_sensor;
            const double raised = k == boards ? touches[touch].block_m : 0.0;
            by_unknown.block<3, 1>(3 * static_cast<Eigen::Index>(touch), k) =
                whitening[touch] * ((predicted(changed, pose) - predicted(table.truth, pose)) / difference -
                                    raised * Eigen::Vector3d::UnitZ());
        }
        known.rows(6, k) = (height_of_sensor(changed, touches) - table.sensor_height_m) / difference /
                           priors.sensor_height_m;
    }
    const Squares loose =
        1e-3 * Squares::Identity(); // for the table's frame only, on which no picture depends
    const Squares information =
        by_unknown.transpose() * by_unknown + known.rows.transpose() * known.rows + loose;
    const Eigen::LLT<Squares> solver(information);
    const Eigen::MatrixXd picture = picture_by_unknown(table, top_m);
    return {picture * solver.solve(by_unknown.transpose()),
            picture * solver.solve(known.rows.transpose() * known.off), std::move(whitening)};
}

Eigen::VectorXd offsets_by(const PropagatedTouches& propagated, const simulators::SimulatedTable& table,
                           const std::vector<Touch>& touches) {
    Eigen::VectorXd noise(propagated.by_noise.cols());
    for (std::size_t k = 0; k < touches.size(); ++k) {
        const Touch& touch = touches[k];
        noise.segment<3>(3 * static_cast<Eigen::Index>(k)) =
            propagated.whitening[k] * (Eigen::Vector3d(touch.pixel.x, touch.pixel.y, touch.block_m) -
                                       predicted(table.truth, touch.tracker_from_sensor));
    }
    return propagated.by_noise * noise + propagated.bias;
}

SquareError square_error(const PropagatedTouches& propagated) {
    const double places = static_cast<double>(propagated.bias.size()) / 3.0;
    const Eigen::MatrixXd squares = propagated.by_noise.transpose() * propagated.by_noise / places;
    const Eigen::VectorXd pull = propagated.by_noise.transpose() * propagated.bias / places;
    return {squares.trace() + propagated.bias.squaredNorm() / places,
            2.0 * squares.squaredNorm() + 4.0 * pull.squaredNorm()};
}

std::vector<double> worst_places(const PropagatedTouches& propagated, int draws,
                                 simulators::SeededNumbers& numbers) {
    Eigen::MatrixXd noise(propagated.by_noise.cols(), draws);
    for (Eigen::Index column = 0; column < noise.cols(); ++column) {
        for (Eigen::Index row = 0; row < noise.rows(); ++row) {
            noise(row, column) = numbers.normal();
        }
    }
    const Eigen::MatrixXd offsets = (propagated.by_noise * noise).colwise() + propagated.bias;
    std::vector<double> worst;
    for (Eigen::Index draw = 0; draw < offsets.cols(); ++draw) {
        double worst2 = 0.0;
        for (Eigen::Index place = 0; place < offsets.rows(); place += 3) {
            worst2 = std::fmax(worst2, offsets.block<3, 1>(place, draw).squaredNorm());
        }
        worst.push_back(std::sqrt(worst2));
    }
    std::sort(worst.begin(), worst.end());
    return worst;
}

} // namespace frustumscreen::calibration
