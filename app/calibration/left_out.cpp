#include "app/calibration/left_out.h"

namespace frustumscreen {

namespace {

TouchResidual residual_of(const TouchModel& others, const Touch& touch) {
    const glm::dvec3 touched = others.touched(touch.tracker_from_sensor);
    const auto lit = others.lit(touch.pixel, touch.block_m);
    const auto pixel = others.pixel(touched);
    constexpr double nowhere = 1e3; // metres and pixels: no light comes there
    return {lit ? glm::distance(*lit, touched) : nowhere,
            pixel ? glm::distance(*pixel, touch.pixel) : nowhere};
}

} // namespace

std::vector<TouchResidual> left_out_residuals(std::span<const Touch> touches,
                                              std::span<const std::size_t> wrong, const FitSetup& setup,
                                              const TouchModel& model) {
    std::vector<TouchResidual> residuals;
    for (std::size_t k = 0; k < touches.size(); ++k) {
        std::vector<double> weights(touches.size(), 1.0);
        for (const std::size_t other : wrong) {
            weights[other] = 0.0;
        }
        weights[k] = 0.0;
        residuals.push_back(residual_of(fit_touches(touches, weights, setup, model).model, touches[k]));
    }
    return residuals;
}

std::vector<TouchResidual> left_out_residuals(std::span<const Touch> touches, const FitSetup& setup,
                                              const BentFit& all, double bend_m) {
    std::vector<TouchResidual> residuals;
    for (std::size_t k = 0; k < touches.size(); ++k) {
        std::vector<double> weights(touches.size(), 1.0);
        weights[k] = 0.0;
        FieldMap box = all.map;
        box.shift_m = {};
        const BentFit others = fit_bent(touches, weights, setup, all.fit.model, box, bend_m);
        residuals.push_back(residual_of(others.fit.model, taken_back(touches.subspan(k, 1), others.map)[0]));
    }
    return residuals;
}

} // namespace frustumscreen
