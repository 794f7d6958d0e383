/// Touches of simulated tables, as a technician makes them on the chosen crosses.
#pragma once

#include "app/calibration/calibrate_touch.h"
#include "tests/simulators/table/simulated_table.h"

#include <cmath>
#include <map>
#include <tuple>

namespace frustumscreen::calibration {

/// Crosses for pictures of one shape and approximate throw, the only data of a projector that a data sheet
/// gives. Choosing takes half a second, so a process chooses each once.
class ChosenCrosses {
public:
    const std::vector<Cross>& of(const simulators::SimulatedTable& table, int count) {
        geometry::Pinhole pinhole = table.truth.pinhole;
        const double throw_ratio = pinhole.fx / pinhole.width < 1.5 ? 1.1 : 1.9;
        const auto key = std::tuple(pinhole.width * 10 / pinhole.height, throw_ratio, count);
        static std::map<std::tuple<int, double, int>, std::vector<Cross>> chosen;
        std::vector<Cross>& crosses = chosen[key];
        if (crosses.empty()) {
            pinhole = {1920, 19200 / std::get<0>(key), 1920 * throw_ratio, 1920 * throw_ratio,
                       960,  9600.0 / std::get<0>(key)};
            CrossSetup setup;
            setup.count = count;
            crosses = choose_crosses(rough_model(pinhole, 0.9 * throw_ratio, 0.06), setup);
        }
        scaled_ = crosses;
        for (Cross& cross : scaled_) {
            cross.pixel *= glm::dvec2(table.truth.pinhole.width / 1920.0,
                                      table.truth.pinhole.height / (19200.0 / std::get<0>(key)));
        }
        return scaled_;
    }

private:
    std::vector<Cross> scaled_;
};

inline Touches touches_of(const simulators::SimulatedTable& table, const std::vector<Cross>& crosses,
                          const TouchNoise& noise, simulators::SeededNumbers& numbers) {
    Touches touches;
    for (const Cross& cross : crosses) {
        touches.push_back(simulators::simulated_touch(table, {cross, 0.0}, noise, numbers));
    }
    return touches;
}

inline TouchSetup setup_for(const simulators::SimulatedTable& table) {
    TouchSetup setup;
    setup.width = table.truth.pinhole.width;
    setup.height = table.truth.pinhole.height;
    setup.sensor_height_m = table.sensor_height_m;
    return setup;
}

inline constexpr TouchNoise no_noise{0.0, 0.0, 0.0, 0.0};

} // namespace frustumscreen::calibration
