#include "app/calibration/field_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace frustumscreen {

namespace {

constexpr auto map_count = static_cast<Eigen::Index>(3 * FieldMap::term_count);
using MapMatrix = Eigen::Matrix<double, map_count, map_count>;
using MapVector = Eigen::Matrix<double, map_count, 1>;
using MapRows = Eigen::Matrix<double, Eigen::Dynamic, map_count>;

MapVector numbers_of(const FieldMap& map) {
    MapVector numbers;
    for (std::size_t k = 0; k < FieldMap::term_count; ++k) {
        numbers.segment<3>(static_cast<Eigen::Index>(3 * k)) = eigen(map.shift_m[k]);
    }
    return numbers;
}

void set_numbers(FieldMap& map, const MapVector& numbers) {
    for (std::size_t k = 0; k < FieldMap::term_count; ++k) {
        map.shift_m[k] = glm_vector(numbers.segment<3>(static_cast<Eigen::Index>(3 * k)));
    }
}

/// How `rows` (what they are of, by the model's unknowns) change with the map's numbers. A shift of the sensor does what one of the touched
/// place in it does, but for the sensor's rotation.
template <typename Rows>
MapRows by_map(const Rows& rows, const RigidTransform& tracker_from_sensor, const FieldMap& map) {
    const Eigen::Matrix3d sensor_from_box =
        eigen(tracker_from_sensor.rotation).transpose() * eigen(map.box_from_tracker.rotation).transpose();
    const Eigen::Matrix<double, Eigen::Dynamic, 3> by_shift =
        rows.template middleCols<3>(offset_x) * sensor_from_box;
    const FieldMap::Terms terms = map.terms(tracker_from_sensor.translation);
    MapRows out(rows.rows(), map_count);
    for (std::size_t k = 0; k < terms.size(); ++k) {
        out.template middleCols<3>(static_cast<Eigen::Index>(3 * k)) = terms[k] * by_shift;
    }
    return out;
}

/// The normal equations of the map's numbers beside the model's, from touches alone.
struct MapEquations {
    MapMatrix own = MapMatrix::Zero();
    Eigen::Matrix<double, unknown_count, map_count> mixed =
        Eigen::Matrix<double, unknown_count, map_count>::Zero();
    MapVector gradient = MapVector::Zero();
};

MapEquations equations_of(std::span<const Touch> reported, std::span<const double> weights,
                          const WhitenedTouches& whitened, const FieldMap& map) {
    MapEquations sum;
    for (std::size_t k = 0; k < reported.size(); ++k) {
        if (weights.empty() || weights[k] > 0.0) {
            const MapRows rows = by_map(whitened.rows[k], reported[k].tracker_from_sensor, map);
            sum.own += rows.transpose() * rows;
            sum.mixed += whitened.rows[k].transpose() * rows;
            sum.gradient += rows.transpose() * whitened.residuals[k];
        }
    }
    return sum;
}

Eigen::MatrixXd joint_covariance(const Fit& fit, const MapEquations& map, double bend_m) {
    Eigen::MatrixXd information(unknown_count + map_count, unknown_count + map_count);
    information.topLeftCorner<unknown_count, unknown_count>() = fit.information();
    information.topRightCorner<unknown_count, map_count>() = map.mixed;
    information.bottomLeftCorner<map_count, unknown_count>() = map.mixed.transpose();
    information.bottomRightCorner<map_count, map_count>() =
        map.own + MapMatrix::Identity() / (bend_m * bend_m);
    return information.ldlt().solve(Eigen::MatrixXd::Identity(information.rows(), information.cols()));
}

} // namespace

FieldMap box_around(std::span<const Touch> touches, const TouchModel& model) {
    const glm::dvec3& up = model.table_up;
    const glm::dvec3 rows = glm::conjugate(model.projector_from_tracker.rotation) * glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 x = glm::normalize(rows - glm::dot(rows, up) * up);
    const glm::dmat3 tracker_from_box(x, glm::cross(up, x), up);
    const glm::dquat box_from_tracker = glm::conjugate(glm::normalize(glm::quat_cast(tracker_from_box)));
    glm::dvec3 low(1e9);
    glm::dvec3 high(-1e9);
    for (const Touch& touch : touches) {
        const glm::dvec3 at = box_from_tracker * touch.tracker_from_sensor.translation;
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    constexpr double least_half_m =
        0.02; // all at one height: the map must not tell more of it than the noise
    FieldMap box;
    box.box_from_tracker = {box_from_tracker, -0.5 * (low + high)};
    box.half_m = glm::max(0.5 * (high - low), glm::dvec3(least_half_m));
    return box;
}

bool is_spread(std::span<const Touch> touches, const FieldMap& box) {
    std::array<bool, 9> touched{};
    for (const Touch& touch : touches) {
        const FieldMap::Terms at = box.terms(touch.tracker_from_sensor.translation);
        const auto third = [](double share) { return std::min(2, static_cast<int>(1.5 * (share + 1.0))); };
        touched[static_cast<std::size_t>(3 * third(at[2]) + third(at[1]))] = true;
    }
    return std::all_of(touched.begin(), touched.end(), [](bool is) { return is; });
}

Touches taken_back(std::span<const Touch> touches, const FieldMap& map) {
    Touches out(touches.begin(), touches.end());
    for (Touch& touch : out) {
        touch.tracker_from_sensor.translation = map.place(touch.tracker_from_sensor.translation);
    }
    return out;
}

std::optional<double> likely_bend_m(std::span<const Touch> touches, const FitSetup& setup, const Fit& without,
                                    const FieldMap& box) {
    const MapEquations map =
        equations_of(touches, {}, whitened_touches(touches, setup, without.model, without.middle), box);
    std::optional<double> likely;
    double most = 0.0; // logarithm of the marginal likelihood, beside that of no map
    for (const double bend_m : {0.25e-3, 0.5e-3, 1e-3, 2e-3, 4e-3, 8e-3, 16e-3, 32e-3}) {
        const MapMatrix scaled = MapMatrix::Identity() + bend_m * bend_m * map.own;
        const Eigen::LLT<MapMatrix> factor(scaled);
        const MapVector gradient = bend_m * map.gradient;
        const double fits_better = 0.5 * gradient.dot(factor.solve(gradient));
        const double volume = factor.matrixLLT().diagonal().array().log().sum();
        if (fits_better - volume > most) {
            most = fits_better - volume;
            likely = bend_m;
        }
    }
    return likely;
}

BentFit fit_bent(std::span<const Touch> touches, std::span<const double> weights, const FitSetup& setup,
                 const TouchModel& start, const FieldMap& box, double bend_m) {
    constexpr int rounds = 2;
    BentFit bent{box, {}, {}, {}, {}};
    TouchModel model = start;
    const double prior = 1.0 / (bend_m * bend_m);
    for (int round = 0;; ++round) {
        const Touches straight = taken_back(touches, bent.map);
        bent.fit = fit_touches(straight, weights, setup, model);
        model = bent.fit.model;
        WhitenedTouches whitened = whitened_touches(straight, setup, model, bent.fit.middle);
        const MapEquations map = equations_of(touches, weights, whitened, bent.map);
        const MapVector numbers = numbers_of(bent.map);
        if (round == rounds) {
            bent.chi2 = bent.fit.chi2 + prior * numbers.squaredNorm();
            bent.covariance = joint_covariance(bent.fit, map, bend_m);
            for (std::size_t k = 0; k < touches.size(); ++k) {
                bent.rows.emplace_back(3, unknown_count + map_count);
                bent.rows.back() << whitened.rows[k],
                    by_map(whitened.rows[k], touches[k].tracker_from_sensor, bent.map);
            }
            bent.residuals = std::move(whitened.residuals);
            return bent;
        }
        const MapMatrix left = map.own + prior * MapMatrix::Identity();
        set_numbers(bent.map, numbers - left.llt().solve(map.gradient + prior * numbers));
    }
}

std::vector<Eigen::Matrix2Xd> light_rows_with(const FieldMap& map, std::span<const ZonePlace> places) {
    std::vector<Eigen::Matrix2Xd> rows;
    for (const ZonePlace& place : places) {
        rows.emplace_back(2, unknown_count + map_count);
        rows.back() << place.rows, by_map(place.rows, place.tracker_from_sensor, map);
    }
    return rows;
}

} // namespace frustumscreen
