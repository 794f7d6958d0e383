/// The ring around the prop that fills while the prop rests on a picture: a band along the prop's shadow.
///
/// It follows the shadow's outline, which covers the prop at any orientation, and fills clockwise from the
/// side that is farthest from the reader. If the prop stands across the edge of the projector's picture, only
/// the visible part of the ring is used.
///
/// Frames   table T, metres.
/// Threads  pure; any. Allocates nothing.
/// Errors   none: without a shadow there is no ring.
#pragma once

#include "app/typography/captions.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <span>

namespace frustumscreen::typography {

inline constexpr double ring_gap_m = 0.003; ///< between the shadow and the band
inline constexpr double ring_width_m = 0.006;

struct RingPiece {
    /// Start and end of the piece on the band's outer edge, then end and start on the inner edge, clockwise.
    std::array<glm::dvec2, 4> corners_m{};
    bool filled = false;
};

struct Ring {
    /// One for each edge, and one more each for the ring's start and for its filled end.
    static constexpr std::size_t most = std::tuple_size_v<decltype(TablePolygon::points)> + 2;
    std::array<RingPiece, most> all{};
    std::size_t count = 0;
    [[nodiscard]] std::span<const RingPiece> pieces() const { return std::span(all).first(count); }
};

/// `full`: the share of its length that is filled, 0..1. `quarter_turns`: the reader's side. `area`: the part
/// of the table that the projector's picture covers, convex, counter-clockwise.
[[nodiscard]] Ring ring_around(const TablePolygon& shadow, double full, int quarter_turns,
                               std::span<const glm::dvec2> area);

/// Factor of linear light that fades the ring in as it fills, and out as it empties.
[[nodiscard]] double ring_brightness(double full);

} // namespace frustumscreen::typography
