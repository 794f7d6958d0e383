/// Guidance as a picture on the table: a sign beside the prop that needs no words and moves calmly.
///
/// An arrow glides in the direction in which the prop should go; an arc turns beside it; a leaning prop stands up.
/// The sign lies outside the prop's shadow and inside the projector's picture. Without space it is not shown.
///
/// Frames   table T, metres; pictures have row 0 at the top, coverage 255 = white, linear light.
/// Time     a closed form of the time since the advice began.
/// Threads  pure; any. Placing allocates nothing.
#pragma once

#include "app/guidance/guide.h"
#include "app/image/image.h"
#include "app/typography/captions.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace frustumscreen::exhibit {

enum class Sign : std::uint8_t { Arrow, Turn, Stand, Raise, Lower };
inline constexpr std::size_t sign_count = 5;

/// Draws a sign. Arrow: points to the right. Turn: an arc below its centre, whose head is at its right end:
/// counter-clockwise.
[[nodiscard]] image::Image<std::uint8_t> sign_picture(Sign sign, double texels_per_m);

struct PlacedSign {
    Sign sign = Sign::Arrow;
    std::array<glm::dvec2, 4> corners_m{}; ///< the picture's: top left, top right, bottom right, bottom left
    double brightness = 0.0;               ///< 0..1, linear light

    [[nodiscard]] bool operator==(const PlacedSign&) const = default;
};

/// `shadow`: hidden_by_prop from the lens. `area`: the part of the table that the projector's picture covers, convex,
/// counter-clockwise. `quarter_turns`: the reader's side.
[[nodiscard]] std::optional<PlacedSign> place_sign(const guidance::Guidance& guidance, MonotonicTime now,
                                                   const typography::TablePolygon& shadow,
                                                   std::span<const glm::dvec2> area, int quarter_turns);

} // namespace frustumscreen::exhibit
