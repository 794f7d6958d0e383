#include "app/calibration/rest_fit.h"

#include "app/calibration/prior_residuals.h"

#include <ceres/jet.h>
#include <ceres/tiny_solver.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>

namespace frustumscreen::calibration {

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, rest_unknown_count>;
using PoseRows = Eigen::Matrix<double, Eigen::Dynamic, 6>;
using Jet = ceres::Jet<double, rest_unknown_count>;
/// The priors of any projector and the print's prior.
constexpr int rest_prior_count = prior_count + 1;

/// Places of the prop's bottom at which its height is a residual; three of them determine its tilt.
const std::array<Eigen::Vector3d, 3> bottom_places{
    {{0.05, 0.0, 0.0}, {-0.025, 0.0433, 0.0}, {-0.025, -0.0433, 0.0}}};

Eigen::Index row_count(const Rest& rest) {
    return static_cast<Eigen::Index>(2 * rest.points.size() + (rest.block_m ? bottom_places.size() : 0));
}

template <typename T> std::array<T, rest_unknown_count> no_changes(bool differentiated) {
    std::array<T, rest_unknown_count> change{};
    if constexpr (!std::is_same_v<T, double>) {
        for (int k = 0; differentiated && k < T::DIMENSION; ++k) {
            change[static_cast<std::size_t>(k)] = T(0.0, k);
        }
    }
    return change;
}

/// Residuals of a rest before whitening, in the order of its rows.
template <typename T>
Eigen::Matrix<T, Eigen::Dynamic, 1> raw_residuals(const ChangedRestModel<T>& model, const Rest& rest) {
    using Vector = Eigen::Matrix<T, 3, 1>;
    const Eigen::Matrix3d turn = eigen(rest.tracker_from_sensor.rotation);
    const Vector sensor = eigen(rest.tracker_from_sensor.translation).cast<T>();
    Eigen::Matrix<T, Eigen::Dynamic, 1> out(row_count(rest));
    Eigen::Index row = 0;
    for (const PropPoint& point : rest.points) {
        const Vector seen =
            model.touch.pixel_and_height(sensor + model.arm(turn, model.printed(point.prop_m)));
        out[row++] = seen.x() - point.pixel.x;
        out[row++] = seen.y() - point.pixel.y;
    }
    for (const Eigen::Vector3d& place : bottom_places) {
        if (rest.block_m) {
            out[row++] =
                model.touch.pixel_and_height(sensor + model.arm(turn, place.template cast<T>())).z() -
                model.touch.boards * *rest.block_m;
        }
    }
    return out;
}

/// Derivatives of these residuals by an error of the tracker's report: shift and turn, in units of its noise.
PoseRows pose_rows(const RestModel& model, const glm::dvec3& middle, const Rest& rest,
                   const RestNoise& noise) {
    using PoseJet = ceres::Jet<double, 6>;
    const auto none = no_changes<PoseJet>(false);
    const ChangedRestModel<PoseJet> now(model, middle, none.data());
    const Eigen::Matrix3d turn = eigen(rest.tracker_from_sensor.rotation);
    const auto moved = [&](const Eigen::Matrix<PoseJet, 3, 1>& prop_point) {
        const Eigen::Matrix<PoseJet, 3, 1> arm = now.arm(turn, prop_point);
        Eigen::Matrix<PoseJet, 3, 1> point = arm;
        for (int k = 0; k < 3; ++k) {
            point[k] += rest.tracker_from_sensor.translation[k];
            point[k].v[k] += noise.position_m;
            const Eigen::Vector3d by_turn =
                noise.rotation_rad *
                Eigen::Vector3d::Unit(k).cross(Eigen::Vector3d(arm[0].a, arm[1].a, arm[2].a));
            for (int j = 0; j < 3; ++j) {
                point[j].v[3 + k] += by_turn[j];
            }
        }
        return now.touch.pixel_and_height(point);
    };
    PoseRows rows(row_count(rest), 6);
    Eigen::Index row = 0;
    for (const PropPoint& point : rest.points) {
        const auto seen = moved(now.printed(point.prop_m));
        rows.row(row++) = seen[0].v.transpose();
        rows.row(row++) = seen[1].v.transpose();
    }
    for (const Eigen::Vector3d& place : bottom_places) {
        if (rest.block_m) {
            rows.row(row++) = moved(place.cast<PoseJet>())[2].v.transpose();
        }
    }
    return rows;
}

/// The variance of each residual of a rest, without the tracker's part.
Eigen::VectorXd own_variances(const Rest& rest, std::span<const double> weights, const RestNoise& noise) {
    Eigen::VectorXd variances = Eigen::VectorXd::Constant(row_count(rest), noise.block_m * noise.block_m);
    for (std::size_t k = 0; k < rest.points.size(); ++k) {
        variances.segment<2>(static_cast<Eigen::Index>(2 * k))
            .setConstant(noise.pixel * noise.pixel / weights[k]);
    }
    return variances;
}

/// All residuals at a changed model, as the solver's function type.
struct RestResiduals {
    using Scalar = double;
    enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = rest_unknown_count };

    std::span<const Rest> rests;
    const RestFitSetup& setup;
    const RestModel& base;
    glm::dvec3 middle;
    std::vector<Eigen::LLT<Eigen::MatrixXd>> covariances; ///< of each rest's residuals
    std::vector<Eigen::Matrix3d> standing;                ///< the sensors of rests on a block, in K
    int count = 0;

    [[nodiscard]] int NumResiduals() const { return count; } // NOLINT: the solver's name for it

    bool operator()(const double* change, double* out, double* jacobian) const {
        Eigen::Map<Eigen::VectorXd> residuals(out, count);
        if (jacobian == nullptr) {
            fill<double>(change, residuals, [](const auto&, Eigen::Index) {});
            return true;
        }
        std::array<Jet, rest_unknown_count> changed;
        for (int k = 0; k < rest_unknown_count; ++k) {
            changed[static_cast<std::size_t>(k)] = Jet(change[k], k);
        }
        Eigen::Map<Rows> rows(jacobian, count, static_cast<int>(rest_unknown_count));
        fill<Jet>(changed.data(), residuals,
                  [&](const Rows& block, Eigen::Index from) { rows.middleRows(from, block.rows()) = block; });
        return true;
    }

private:
    template <typename T, typename Put>
    void fill(const T* change, Eigen::Map<Eigen::VectorXd>& residuals, Put put) const {
        const ChangedRestModel<T> model(base, middle, change);
        Eigen::Index from = 0;
        for (std::size_t k = 0; k < rests.size(); ++k) {
            const auto raw = raw_residuals(model, rests[k]);
            from = put_block<T>(raw, &covariances[k], residuals, from, put);
        }
        Eigen::Matrix<T, Eigen::Dynamic, 1> rest(rest_prior_count + (setup.sensor_height_m ? 1 : 0));
        prior_residuals(setup.priors, base.touch, change, rest.data());
        rest[prior_count] = (change[print_log] + std::log(base.print)) / setup.priors.print;
        if (setup.sensor_height_m) {
            rest[rest_prior_count] = (sensor_height(model.touch, standing) - *setup.sensor_height_m) /
                                     setup.priors.sensor_height_m;
        }
        put_block<T>(rest, nullptr, residuals, from, put);
    }
    /// Whitens values and derivatives separately as dense matrices; a product of Jets takes ten times as
    /// long.
    template <typename T, typename Put>
    static Eigen::Index put_block(const Eigen::Matrix<T, Eigen::Dynamic, 1>& raw,
                                  const Eigen::LLT<Eigen::MatrixXd>* covariance,
                                  Eigen::Map<Eigen::VectorXd>& residuals, Eigen::Index from, Put put) {
        Eigen::VectorXd values(raw.size());
        Rows rows(std::is_same_v<T, double> ? 0 : raw.size(), static_cast<int>(rest_unknown_count));
        for (Eigen::Index k = 0; k < raw.size(); ++k) {
            if constexpr (std::is_same_v<T, double>) {
                values[k] = raw[k];
            } else {
                values[k] = raw[k].a;
                rows.row(k) = raw[k].v.transpose();
            }
        }
        if (covariance != nullptr) {
            covariance->matrixL().solveInPlace(values);
            if constexpr (!std::is_same_v<T, double>) {
                covariance->matrixL().solveInPlace(rows);
            }
        }
        residuals.segment(from, raw.size()) = values;
        put(rows, from);
        return from + raw.size();
    }
};

RestResiduals residuals_at(std::span<const Rest> rests, const RestWeights& weights, const RestFitSetup& setup,
                           const RestModel& model) {
    RestResiduals residuals{.rests = rests,
                            .setup = setup,
                            .base = model,
                            .middle = middle_of(rests),
                            .covariances = {},
                            .standing = {},
                            .count = 0};
    for (std::size_t k = 0; k < rests.size(); ++k) {
        const PoseRows by_pose = pose_rows(model, residuals.middle, rests[k], setup.noise);
        Eigen::MatrixXd covariance = by_pose * by_pose.transpose() / weights.rests[k];
        covariance.diagonal() += own_variances(rests[k], weights.points[k], setup.noise);
        residuals.covariances.emplace_back(covariance);
        residuals.count += static_cast<int>(row_count(rests[k]));
        if (rests[k].block_m) {
            residuals.standing.push_back(eigen(rests[k].tracker_from_sensor.rotation));
        }
    }
    residuals.count += rest_prior_count + (setup.sensor_height_m ? 1 : 0);
    return residuals;
}

RestModel solved(const RestResiduals& residuals, int max_steps) {
    ceres::TinySolver<RestResiduals> solver;
    solver.options.max_num_iterations = max_steps;
    solver.options.function_tolerance = 1e-9;
    solver.options.gradient_tolerance = 1e-9;
    RestChanges change = RestChanges::Zero();
    solver.Solve(residuals, &change);
    return changed(residuals.base, residuals.middle, change);
}

FittedRest fitted_rest(const RestResiduals& residuals, const RestWeights& weights, std::size_t k,
                       const Eigen::VectorXd& whitened, const Rows& rows) {
    const Rest& rest = residuals.rests[k];
    const Eigen::LLT<Eigen::MatrixXd>& covariance = residuals.covariances[k];
    const PoseRows by_pose = pose_rows(residuals.base, residuals.middle, rest, residuals.setup.noise);
    FittedRest fitted{.residuals = whitened,
                      .by_unknown = rows,
                      .by_pose = covariance.matrixL().solve(by_pose),
                      .pose = {},
                      .points = {}};
    const Eigen::VectorXd raw_by_covariance = covariance.matrixU().solve(whitened);
    fitted.pose = by_pose.transpose() * raw_by_covariance / weights.rests[k];
    const Eigen::VectorXd own =
        own_variances(rest, weights.points[k], residuals.setup.noise).cwiseProduct(raw_by_covariance);
    for (std::size_t j = 0; j < rest.points.size(); ++j) {
        const auto row = static_cast<Eigen::Index>(2 * j);
        fitted.points.emplace_back(own[row], own[row + 1]);
    }
    return fitted;
}

/// The result of a fit.
RestFit measured(const RestResiduals& residuals, const RestWeights& weights) {
    Eigen::VectorXd all(residuals.count);
    Rows rows(residuals.count, static_cast<int>(rest_unknown_count));
    const auto none = no_changes<double>(false);
    residuals(none.data(), all.data(), rows.data());
    RestFit fit;
    fit.model = residuals.base;
    fit.middle = residuals.middle;
    fit.chi2 = all.squaredNorm();
    fit.freedom = residuals.count - rest_unknown_count;
    Eigen::Index from = 0;
    for (std::size_t k = 0; k < residuals.rests.size(); ++k) {
        const Eigen::Index count = row_count(residuals.rests[k]);
        fit.rests.push_back(
            fitted_rest(residuals, weights, k, all.segment(from, count), rows.middleRows(from, count)));
        fit.freedom -= weights.rests[k] > no_weight ? 0 : 6;
        for (const double weight : weights.points[k]) {
            fit.freedom -= weight > no_weight ? 0 : 2;
        }
        from += count;
    }
    fit.from_rests = rows.topRows(from).transpose() * rows.topRows(from);
    fit.from_priors =
        rows.middleRows(from, rest_prior_count).transpose() * rows.middleRows(from, rest_prior_count);
    const auto height = rows.bottomRows(residuals.count - from - rest_prior_count);
    fit.from_height = height.transpose() * height;
    return fit;
}

} // namespace

RestWeights equal_weights(std::span<const Rest> rests) {
    RestWeights weights;
    weights.rests.assign(rests.size(), 1.0);
    for (const Rest& rest : rests) {
        weights.points.emplace_back(rest.points.size(), 1.0);
    }
    return weights;
}

glm::dvec3 middle_of(std::span<const Rest> rests) {
    glm::dvec3 sum(0.0);
    for (const Rest& rest : rests) {
        sum += rest.tracker_from_sensor.translation;
    }
    return sum / static_cast<double>(rests.size());
}

RestFit fit_rests(std::span<const Rest> rests, const RestWeights& weights, const RestFitSetup& setup,
                  const RestModel& start, std::span<const int> rounds) {
    RestModel model = start;
    for (const int steps : rounds) {
        model = solved(residuals_at(rests, weights, setup, model), steps);
    }
    return measured(residuals_at(rests, weights, setup, model), weights);
}

} // namespace frustumscreen::calibration
