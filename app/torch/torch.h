/// A torch: a light in a world that throws a content. Its beam is a frustum or a cone.
///
/// Frames   torch: +Z is the direction of the light, +X to the content's right, +Y down in the content, as a projector's;
///          the origin is where the light comes from. World: any frame in which the torch is placed, such as the table.
///          Content: (0, 0) top left, (1, 1) bottom right.
/// Units    metres, radians. Intensity: 0..1, linear light; 1 is full.
/// Threads  pure; any.
/// Source   Francken, Huysmans & Bekaert 2007: projective texture with attenuation by the distance from the light.
#pragma once

#include "app/geometry/transform.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace frustumscreen::torch {

/// Torches at once: the one in the hand, a lamp that a camera sees, and two that were left on.
inline constexpr std::size_t max_torches = 4;

/// How intensity falls with the distance d from the torch. Up to `full_m` all are 1.
enum class Attenuation : std::uint8_t {
    InverseSquare, ///< (full_m / d)^2
    Linear,        ///< straight down to 0 at `dark_m`
    SmoothStep,    ///< 1 - t^2 (3 - 2 t), where t goes from 0 at `full_m` to 1 at `dark_m`
    None,          ///< 1 everywhere
};
inline constexpr std::array<std::string_view, 4> attenuation_names{"inverse_square", "linear", "smooth_step",
                                                                   "none"};
/// The shape of the beam's cross-section. Round: the ellipse in the rectangle.
enum class Shape : std::uint8_t { Round, Rectangle };
inline constexpr std::array<std::string_view, 2> shape_names{"round", "rectangle"};

/// Intensity below which nobody sees the light on a lit surface: one hundredth of it, the eye's threshold of contrast
/// for shapes of some degrees (Weber's law; Blackwell 1946). It bounds the beam's length.
inline constexpr double min_intensity = 0.01;

struct Beam {
    double opening_rad = 0.5235987755982988; ///< across the content's width: above 0, below pi. 30 degrees
    double height_per_width = 1.0;           ///< of the content
    Shape shape = Shape::Round;
    Attenuation attenuation = Attenuation::InverseSquare;
    double full_m = 0.3; ///< above 0
    double dark_m = 1.5; ///< above `full_m`; for Linear and SmoothStep

    [[nodiscard]] bool operator==(const Beam&) const = default;
};

/// The tangents of half the opening, across and down.
[[nodiscard]] glm::dvec2 half_extent(const Beam& beam);
/// By the distance alone, also beyond the beam's reach.
[[nodiscard]] double attenuation_at(const Beam& beam, double distance_m);
/// Distance at which the intensity is `min_intensity`; infinite without attenuation.
[[nodiscard]] double reach_m(const Beam& beam);
/// Where in the content a point of the torch's frame is lit; nullopt outside the beam or beyond its reach.
[[nodiscard]] std::optional<glm::dvec2> place_in_content(const Beam& beam, const glm::dvec3& point_torch);
/// Intensity at a point of the torch's frame where nothing casts a shadow; 0 outside the beam.
[[nodiscard]] double intensity_at(const Beam& beam, const glm::dvec3& point_torch);

} // namespace frustumscreen::torch
