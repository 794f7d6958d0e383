/// The zone by the picture's size: the present lens and prop at several throw ratios.
///
/// Frames   table T, metres.
/// Threads  pure; any.
#pragma once

#include "app/settings/settings.h"

#include <glm/glm.hpp>

#include <span>
#include <string>
#include <vector>

namespace frustumscreen::bench {

struct ThrowZone {
    double throw_ratio = 0.0;
    glm::dvec2 picture_m{0.0};   ///< width and depth, as far from the lens as the table's middle
    glm::dvec2 zone_m{0.0};      ///< as SetUpFigures::zone_m
    double pixels = 0.0;         ///< on the artifact, as SetUpFigures::pixels
    double pixels_a_metre = 0.0; ///< on the table, along the picture's rows
};

[[nodiscard]] std::vector<ThrowZone> zones_by_throw(const settings::Settings& settings,
                                                    std::span<const double> throw_ratios);
[[nodiscard]] std::string zones_csv(std::span<const ThrowZone> zones);
/// The same as a text table.
[[nodiscard]] std::string zones_table(std::span<const ThrowZone> zones);

} // namespace frustumscreen::bench
