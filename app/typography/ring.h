/// The ring around the prop that fills while the prop rests on a picture: a band beside the prop's shadow.
///
/// It follows the shadow's outline, which the prop covers at any turn, and fills clockwise from the side that is farthest from
/// the reader. A prop that stands over the edge of the projector's picture has only the part of it that can be seen.
///
/// Frames   table T, metres.
/// Threads  pure; any. Allocates nothing.
/// Errors   none: no shadow, no ring.
#pragma once

#include "app/typography/captions.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <span>

namespace frustumscreen {

inline constexpr double ring_gap_m = 0.003; ///< between the shadow and the band
inline constexpr double ring_width_m = 0.006;

struct RingPiece {
    /// Before and after the piece on the band's outer edge, then after and before it on the inner edge, as clockwise goes.
    std::array<glm::dvec2, 4> corners_m{};
    bool filled = false;
};

struct Ring {
    /// Of each edge one, and one more each where the ring begins and where it is filled up to.
    static constexpr std::size_t most = std::tuple_size_v<decltype(TablePolygon::points)> + 2;
    std::array<RingPiece, most> all{};
    std::size_t count = 0;
    [[nodiscard]] std::span<const RingPiece> pieces() const { return std::span(all).first(count); }
};

/// `full`: the share of its length that is filled, 0..1. `quarter_turns`: the reader's side. `room`: what the projector's picture
/// covers of the table, convex, counter-clockwise.
[[nodiscard]] Ring ring_around(const TablePolygon& shadow, double full, int quarter_turns,
                               std::span<const glm::dvec2> room);

/// A ring comes up and goes softly, as it fills and empties: a factor on linear light.
[[nodiscard]] double ring_brightness(double full);

} // namespace frustumscreen
