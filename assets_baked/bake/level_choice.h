/// Which levels a pack keeps, and with which of them it begins.
///
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"
#include "app/pack/pack_outline.h"
#include "assets_baked/bake/level_bakery.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace frustumscreen::bake {

/// 0.3 mm on an artifact of 0.1 m, the most that a visitor accepts.
inline constexpr float worst_mean_box = 3e-3F;
/// Indices of the levels on the Pareto front of error against cost (triangles; below about 1500 a frame's
/// cost does not depend on them), cheapest first: each has a smaller mean error than the one before, and no
/// clearly larger 95th percentile or colour error. Levels that stray further than `worst_mean` are left out, except for the
/// most exact one.
[[nodiscard]] std::vector<std::size_t> measured_front(const std::vector<pack::LevelOutline>& levels,
                                                      float worst_mean = worst_mean_box);

/// Keeps the surfaces on the front, from fine to coarse.
void keep_front(std::vector<Surface>& surfaces, float worst_mean);

/// Moves the levels on the front, and their texture, into the pack.
void keep(pack::Pack& pack, TexturedLevels meshes, float worst_mean);

/// The first level that is good enough, starting at the finest one of at most 30,000 triangles. The start is
/// never the last level, which is for close views and is drawn with more samples.
[[nodiscard]] std::uint32_t choose_default(const pack::Pack& pack, const pack::SeenErrors& seen,
                                           double mm_per_box);

} // namespace frustumscreen::bake
