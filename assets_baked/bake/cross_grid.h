/// Finds where the lines of a direction's grid cross a surface (app/relief/grid_crossings.h), by rays.
///
/// Frames   box; the direction's grid (app/relief/block_relief.h).
/// Threads  uses every core; the result does not depend on their number.
#pragma once

#include "app/relief/grid_crossings.h"
#include "assets_baked/bake/block_relief.h"

#include <optional>

namespace frustumscreen::bake {

/// The lines of a grid's cells, followed through the surface by rays.
class SceneLines : public relief::CellLines {
public:
    /// `input` and `grid` must outlive it.
    SceneLines(const BlockInput& input, const relief::ReliefGrid& grid) : input_(input), grid_(grid) {}
    void cross(int column, int row, const glm::dvec2& range, relief::CellCrossings& found) const override;

private:
    const BlockInput& input_;
    const relief::ReliefGrid& grid_;
};

/// The crossing that the direction gets from a hit anywhere on the surface: height, slopes, owner, colour;
/// nullopt if the surface is too flat to the direction's lines or faces away. The hit's triangle, position
/// in it, point and normal are used.
[[nodiscard]] std::optional<relief::Crossing>
crossing_from(const BlockInput& input, const relief::ReliefGrid& grid, const SurfaceHit& hit);

[[nodiscard]] relief::GridCrossings cross_grid(const BlockInput& input, pack::ReliefDirection direction);

} // namespace frustumscreen::bake
