/// Repeating ornaments of Greek pottery.
///
/// Units    mm unless noted; x runs around the vessel, y up; `edge` is the width of a texel.
/// Threads  pure; any.
#pragma once

#include "assets_baked/artifacts/ink.h"

namespace frustumscreen::artifacts {

/// Square-cornered key pattern that repeats every `unit` in x; y in 0..height.
void paint_meander(Ink& ink, glm::vec2 p, float unit, float height, float edge);
/// Rays standing on y = 0.
void paint_rays(Ink& ink, glm::vec2 p, float unit, float height, float edge);
/// Tongues hanging from y = height, alternating black and red.
void paint_tongues(Ink& ink, glm::vec2 p, float unit, float height, float edge);
/// Alternating palmettes and lotus flowers on a chain, as on the necks of amphorae.
void paint_lotus_chain(Ink& ink, glm::vec2 p, float unit, float height, float edge);
/// Buds on crossing arcs.
void paint_bud_chain(Ink& ink, glm::vec2 p, float unit, float height, float edge);
/// A fan of leaves, root at the origin, upright, `height` high; any units.
void paint_palmette(Ink& ink, glm::vec2 p, float height, float edge);
/// A horizontal line.
void paint_line(Ink& ink, float y, float at, float width, Pigment pigment, float edge);

/// Distance to a spiral around the origin that ends at radius `outer` on its lower side; any units.
[[nodiscard]] float spiral(glm::vec2 p, float outer, float turns);

} // namespace frustumscreen::artifacts
