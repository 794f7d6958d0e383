#include "app/calibration/zone.h"

#include <ceres/jet.h>

#include <Eigen/LU>
#include <array>
#include <numbers>

namespace frustumscreen::calibration {

namespace {

LightRows light_rows(const TouchModel& model, const glm::dvec3& middle, const glm::dquat& turn,
                     const glm::dvec3& place) {
    using Jet = ceres::Jet<double, unknown_count>;
    std::array<Jet, unknown_count> change;
    for (int k = 0; k < unknown_count; ++k) {
        change[static_cast<std::size_t>(k)] = Jet(0.0, k);
    }
    const ChangedModel<Jet> by_unknown(model, middle, change.data());
    const Touch touch{{turn, place - turn * model.sensor_offset_m}, {}, 0.0};
    const Eigen::Matrix<Jet, 3, 1> seen = by_unknown.pixel_and_height(by_unknown.touched(touch));

    using Flat = ceres::Jet<double, 2>;
    const std::array<Flat, unknown_count> none{};
    const ChangedModel<Flat> by_place(model, middle, none.data());
    const Eigen::Matrix<double, 3, 2> axes = table_axes(model.table_up);
    Eigen::Matrix<Flat, 3, 1> point = eigen(place).cast<Flat>();
    point += axes.col(0).cast<Flat>() * Flat(0.0, 0) + axes.col(1).cast<Flat>() * Flat(0.0, 1);
    const Eigen::Matrix<Flat, 3, 1> beside = by_place.pixel_and_height(point);
    Eigen::Matrix2d pixel_by_place;
    pixel_by_place << beside[0].v.transpose(), beside[1].v.transpose();
    LightRows pixel_by_unknown;
    pixel_by_unknown << seen[0].v.transpose(), seen[1].v.transpose();
    return pixel_by_place.inverse() * pixel_by_unknown;
}

} // namespace

std::vector<ZonePlace> zone_places(const TouchModel& model, const glm::dvec3& middle,
                                   const ZoneSetup& setup) {
    constexpr int columns = zone_columns - 1;
    constexpr int rows = zone_rows - 1;
    std::vector<ZonePlace> places;
    for (const double height : {0.0, 0.5 * setup.top_m, setup.top_m}) {
        for (int k = 0; k < (columns + 1) * (rows + 1); ++k) {
            const glm::ivec2 node(k % (columns + 1), k / (columns + 1));
            const glm::dvec2 pixel(model.pinhole.width * node.x / double(columns),
                                   model.pinhole.height * node.y / double(rows));
            const std::optional<glm::dvec3> place = model.lit(pixel, height);
            for (int quarter = 0; place && quarter < 4; ++quarter) {
                const glm::dquat turn =
                    glm::angleAxis(0.5 * std::numbers::pi * quarter, model.table_up) * setup.upright;
                places.push_back({pixel, height, light_rows(model, middle, turn, *place)});
            }
        }
    }
    return places;
}

PictureUncertainty picture_uncertainty(std::span<const ZonePlace> places, const Covariance& covariance) {
    PictureUncertainty uncertainty;
    for (const ZonePlace& place : places) {
        const double rms =
            std::sqrt(std::fmax(0.0, (place.rows * covariance * place.rows.transpose()).trace()));
        uncertainty.mean_m += rms / static_cast<double>(places.size());
        uncertainty.worst_m = std::fmax(uncertainty.worst_m, rms);
        uncertainty.each_m.push_back(rms);
    }
    return uncertainty;
}

std::vector<PlaceUncertainty> by_place(std::span<const ZonePlace> places, std::span<const double> each_m) {
    std::vector<PlaceUncertainty> zone;
    constexpr double turns = 4.0;
    for (std::size_t k = 0; k < places.size(); ++k) {
        if (zone.empty() || zone.back().pixel != places[k].pixel ||
            zone.back().height_m != places[k].height_m) {
            zone.push_back({places[k].pixel, places[k].height_m});
        }
        zone.back().rms_m += each_m[k] * each_m[k] / turns;
    }
    for (PlaceUncertainty& place : zone) {
        place.rms_m = std::sqrt(place.rms_m);
    }
    return zone;
}

} // namespace frustumscreen::calibration
