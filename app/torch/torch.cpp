#include "app/torch/torch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::torch {

glm::dvec2 half_extent(const Beam& beam) {
    const double across = std::tan(0.5 * beam.opening_rad);
    return {across, across * beam.height_per_width};
}

double attenuation_at(const Beam& beam, double distance_m) {
    if (distance_m <= beam.full_m || beam.attenuation == Attenuation::None) {
        return 1.0;
    }
    const double share = std::min(1.0, (distance_m - beam.full_m) / (beam.dark_m - beam.full_m));
    switch (beam.attenuation) {
    case Attenuation::InverseSquare:
        return beam.full_m * beam.full_m / (distance_m * distance_m);
    case Attenuation::Linear:
        return 1.0 - share;
    case Attenuation::SmoothStep:
        return 1.0 - share * share * (3.0 - 2.0 * share);
    case Attenuation::None:
        break;
    }
    return 1.0;
}

double reach_m(const Beam& beam) {
    switch (beam.attenuation) {
    case Attenuation::InverseSquare:
        return beam.full_m / std::sqrt(min_intensity);
    case Attenuation::Linear:
        return beam.dark_m - min_intensity * (beam.dark_m - beam.full_m);
    case Attenuation::SmoothStep: {
        // The root of t^2 (3 - 2 t) = 1 - min_intensity: t = 1/2 - sin(asin(1 - 2 y) / 3).
        const double share = 0.5 - std::sin(std::asin(1.0 - 2.0 * (1.0 - min_intensity)) / 3.0);
        return beam.full_m + share * (beam.dark_m - beam.full_m);
    }
    case Attenuation::None:
        break;
    }
    return std::numeric_limits<double>::infinity();
}

std::optional<glm::dvec2> place_in_content(const Beam& beam, const glm::dvec3& point_torch) {
    if (!(point_torch.z > 0.0) || !(glm::length(point_torch) <= reach_m(beam))) {
        return std::nullopt;
    }
    const glm::dvec2 place = glm::dvec2(point_torch) / (point_torch.z * half_extent(beam)); // -1..1
    const bool lit = beam.shape == Shape::Round ? glm::dot(place, place) <= 1.0
                                                : std::abs(place.x) <= 1.0 && std::abs(place.y) <= 1.0;
    return lit ? std::optional(0.5 * place + 0.5) : std::nullopt;
}

double intensity_at(const Beam& beam, const glm::dvec3& point_torch) {
    return place_in_content(beam, point_torch) ? attenuation_at(beam, glm::length(point_torch)) : 0.0;
}

} // namespace frustumscreen::torch
