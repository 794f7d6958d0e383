/// Contact of flat things on the table: which way a thing must slide to be clear of another.
///
/// Frames   table T, metres; convex polygons, counter-clockwise.
/// Threads  pure; any.
/// Method   separating axes (Gottschalk, Lin, Manocha 1996): the normals of both polygons.
#pragma once

#include <glm/glm.hpp>

#include <optional>
#include <span>

namespace frustumscreen::exhibit {

/// The shortest slide of `thing` after which it is `gap_m` from `other` along some normal of their edges; none: it is
/// clear already.
[[nodiscard]] std::optional<glm::dvec2> slide_clear(std::span<const glm::dvec2> thing,
                                                    std::span<const glm::dvec2> other, double gap_m);

/// True if the point lies in the polygon, at least `border_m` from its edges.
[[nodiscard]] bool lies_in(const glm::dvec2& point, std::span<const glm::dvec2> polygon,
                           double border_m = 0.0);

} // namespace frustumscreen::exhibit
