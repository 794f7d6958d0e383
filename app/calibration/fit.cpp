#include "app/calibration/fit.h"

#include "app/calibration/prior_residuals.h"

#include <ceres/tiny_solver.h>
#include <ceres/tiny_solver_autodiff_function.h>

#include <Eigen/Cholesky>
#include <array>
#include <cassert>
#include <cmath>

namespace frustumscreen::calibration {

namespace {

using Jet = ceres::Jet<double, unknown_count>;

/// Residuals of touches at a changed model; each touch's three are whitened jointly.
struct Residuals {
    std::span<const Touch> touches;
    const FitSetup& setup;
    const TouchModel& base;
    glm::dvec3 middle;
    std::vector<Eigen::Matrix3d> whitening; ///< of each touch, times the square root of its weight

    [[nodiscard]] int count() const {
        return 3 * static_cast<int>(touches.size()) + prior_count + (setup.sensor_height_m ? 1 : 0);
    }
    [[nodiscard]] int NumResiduals() const { return count(); } // NOLINT: the solver's name for it
    [[nodiscard]] bool is_upright(std::size_t k) const { return setup.upright.empty() || setup.upright[k]; }

    template <typename T> Eigen::Matrix<T, 3, 1> raw(const ChangedModel<T>& model, const Touch& touch) const {
        return model.pixel_and_height(model.touched(touch)) -
               Eigen::Matrix<T, 3, 1>(T(touch.pixel.x), T(touch.pixel.y), model.boards * touch.block_m);
    }
    /// The sensor's mean height above the touched place in upright touches, less the given height.
    template <typename T> T height_off(const ChangedModel<T>& model) const {
        std::vector<Eigen::Matrix3d> upright;
        for (std::size_t k = 0; k < touches.size(); ++k) {
            if (is_upright(k)) {
                upright.push_back(eigen(touches[k].tracker_from_sensor.rotation));
            }
        }
        return sensor_height(model, std::span<const Eigen::Matrix3d>(upright)) - *setup.sensor_height_m;
    }
    template <typename T> bool operator()(const T* change, T* out) const {
        const ChangedModel<T> model(base, middle, change);
        for (std::size_t k = 0; k < touches.size(); ++k) {
            Eigen::Map<Eigen::Matrix<T, 3, 1>>(out + 3 * k) = whitening[k].cast<T>() * raw(model, touches[k]);
        }
        T* const rest = out + 3 * touches.size();
        prior_residuals(setup.priors, base, change, rest);
        if (setup.sensor_height_m) {
            rest[prior_count] = height_off(model) / setup.priors.sensor_height_m;
        }
        return true;
    }
};

/// The inverse square root of the covariance of a touch's residuals. The tracker's noise correlates them.
Eigen::Matrix3d whitening_of(const TouchModel& model, const glm::dvec3& middle, const Touch& touch,
                             const TouchNoise& noise) {
    using PointJet = ceres::Jet<double, 3>;
    const std::array<PointJet, unknown_count> none{};
    const ChangedModel<PointJet> changed(model, middle, none.data());
    const Eigen::Matrix3d turn = eigen(touch.tracker_from_sensor.rotation);
    const Eigen::Vector3d arm = turn * eigen(model.sensor_offset_m);
    Eigen::Matrix<PointJet, 3, 1> point;
    for (int k = 0; k < 3; ++k) {
        point[k] = PointJet(arm[k] + touch.tracker_from_sensor.translation[k], k);
    }
    const Eigen::Matrix<PointJet, 3, 1> seen = changed.pixel_and_height(point);
    Eigen::Matrix3d by_point;
    for (int k = 0; k < 3; ++k) {
        by_point.row(k) = seen[k].v.transpose();
    }
    Eigen::Matrix3d cross;
    cross << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
    const Eigen::Matrix3d of_point =
        noise.position_m * noise.position_m * Eigen::Matrix3d::Identity() +
        noise.rotation_rad * noise.rotation_rad * (cross * cross.transpose()).eval();
    Eigen::Matrix3d covariance = by_point * of_point * by_point.transpose();
    covariance.diagonal() +=
        Eigen::Vector3d(noise.pixel * noise.pixel, noise.pixel * noise.pixel, noise.block_m * noise.block_m);
    const Eigen::LLT<Eigen::Matrix3d> factor(covariance);
    return factor.matrixL().solve(Eigen::Matrix3d::Identity());
}

void whiten(Residuals& residuals, std::span<const double> weights) {
    residuals.whitening.resize(residuals.touches.size());
    for (std::size_t k = 0; k < residuals.touches.size(); ++k) {
        residuals.whitening[k] =
            std::sqrt(weights.empty() ? 1.0 : weights[k]) *
            whitening_of(residuals.base, residuals.middle, residuals.touches[k], residuals.setup.noise);
    }
}

TouchModel solved(const Residuals& residuals, int max_steps) {
    using Function = ceres::TinySolverAutoDiffFunction<Residuals, Eigen::Dynamic, unknown_count>;
    ceres::TinySolver<Function> solver;
    solver.options.max_num_iterations = max_steps;
    solver.options.function_tolerance = 1e-9;
    solver.options.gradient_tolerance = 1e-9;
    Changes change = Changes::Zero();
    solver.Solve(Function(residuals), &change);
    return changed(residuals.base, residuals.middle, change);
}

void add_information(Covariance& to, const Jet& residual) {
    to += residual.v * residual.v.transpose();
}

/// Residuals with their derivatives, in the order of Residuals.
std::vector<Jet> differentiated(const Residuals& residuals) {
    std::array<Jet, unknown_count> change;
    for (int k = 0; k < unknown_count; ++k) {
        change[static_cast<std::size_t>(k)] = Jet(0.0, k);
    }
    std::vector<Jet> out(static_cast<std::size_t>(residuals.count()));
    residuals(change.data(), out.data());
    return out;
}

/// The result of a fit: residuals and information, touch by touch.
Fit measured(const Residuals& residuals, std::span<const double> weights) {
    Fit fit;
    fit.model = residuals.base;
    fit.middle = residuals.middle;
    fit.from_touches = fit.from_height = fit.from_priors = Covariance::Zero();
    const std::vector<Jet> out = differentiated(residuals);
    const std::size_t touches = residuals.touches.size();
    std::size_t used = 0;
    for (std::size_t k = 0; k < touches; ++k) {
        double chi2 = 0.0;
        for (std::size_t j = 3 * k; j < 3 * k + 3; ++j) {
            chi2 += out[j].a * out[j].a;
            add_information(fit.from_touches, out[j]);
        }
        fit.chi2 += chi2;
        fit.touch_chi2.push_back(chi2);
        used += weights.empty() || weights[k] > 0.0 ? 1 : 0;
    }
    for (std::size_t j = 3 * touches; j < out.size(); ++j) {
        fit.chi2 += out[j].a * out[j].a;
        add_information(j < 3 * touches + prior_count ? fit.from_priors : fit.from_height, out[j]);
    }
    fit.freedom = static_cast<int>(3 * used + out.size() - 3 * touches) - unknown_count;
    return fit;
}

/// Each round whitens at the current model, then takes at most the given number of steps.
Fit fit_in(std::span<const int> rounds, std::span<const Touch> touches, std::span<const double> weights,
           const FitSetup& setup, const TouchModel& start) {
    assert(!touches.empty());
    TouchModel model = start;
    Residuals residuals{
        .touches = touches, .setup = setup, .base = model, .middle = middle_of(touches), .whitening = {}};
    for (const int steps : rounds) {
        whiten(residuals, weights);
        model = solved(residuals, steps);
    }
    whiten(residuals, weights);
    return measured(residuals, weights);
}

} // namespace

Fit information_of(std::span<const Touch> touches, const FitSetup& setup, const TouchModel& model,
                   const glm::dvec3& middle) {
    Residuals residuals{.touches = touches, .setup = setup, .base = model, .middle = middle, .whitening = {}};
    whiten(residuals, {});
    return measured(residuals, {});
}

WhitenedTouches whitened_touches(std::span<const Touch> touches, const FitSetup& setup,
                                 const TouchModel& model, const glm::dvec3& middle) {
    Residuals residuals{.touches = touches, .setup = setup, .base = model, .middle = middle, .whitening = {}};
    whiten(residuals, {});
    const std::vector<Jet> out = differentiated(residuals);
    WhitenedTouches whitened{std::vector<Eigen::Vector3d>(touches.size()),
                             std::vector<TouchRows>(touches.size())};
    for (std::size_t k = 0; k < 3 * touches.size(); ++k) {
        const auto row = static_cast<Eigen::Index>(k % 3);
        whitened.residuals[k / 3][row] = out[k].a;
        whitened.rows[k / 3].row(row) = out[k].v.transpose();
    }
    return whitened;
}

glm::dvec3 middle_of(std::span<const Touch> touches) {
    glm::dvec3 sum(0.0);
    for (const Touch& touch : touches) {
        sum += touch.tracker_from_sensor.translation;
    }
    return sum / static_cast<double>(touches.size());
}

Fit fit_touches(std::span<const Touch> touches, std::span<const double> weights, const FitSetup& setup,
                const TouchModel& start) {
    constexpr std::array steps{60, 20, 20, 20};
    return fit_in(steps, touches, weights, setup, start);
}

Fit fit_roughly(std::span<const Touch> touches, const FitSetup& setup, const TouchModel& start) {
    constexpr std::array steps{40};
    return fit_in(steps, touches, {}, setup, start);
}

Fit fit_robustly(std::span<const Touch> touches, const FitSetup& setup, const TouchModel& start) {
    std::vector<double> weights(touches.size(), 1.0);
    Fit fit = fit_touches(touches, weights, setup, start);
    // Cauchy weights, wide at first, so that an inaccurate start does not decide which touches count.
    for (const double width : {20.0, 10.0, 5.0, 3.0, 3.0, 3.0}) {
        std::vector<double> next(touches.size());
        for (std::size_t k = 0; k < touches.size(); ++k) {
            const double own = weights[k] > 0.0 ? fit.touch_chi2[k] / weights[k] : 0.0;
            next[k] = 1.0 / (1.0 + own / (3.0 * width * width));
        }
        weights = next;
        fit = fit_touches(touches, weights, setup, fit.model);
    }
    return fit;
}

} // namespace frustumscreen::calibration
