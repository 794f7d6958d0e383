/// Checks a pack's error figures. A kiosk chooses levels by them: figures that are too small show a coarse
/// artifact, figures that are too large a slow one. Each level is measured again against the source, with the
/// bake's method.
///
/// Units    millimetres on the configured prop.
/// Limits   a figure may be off by a quarter of its value plus `slack_box`, because the sample points on the
///          source differ from those of the bake.
/// Threads  uses all cores; deterministic.
#pragma once

#include "app/bench/measures/verdicts.h"
#include "app/pack/pack.h"
#include "assets_baked/bake/source_mesh.h"
#include "firmware_host/base/result.h"

#include <vector>

namespace frustumscreen::bench {

struct LevelFigures {
    std::uint32_t level = 0;
    pack::LevelError said, measured; ///< box units
};
[[nodiscard]] std::vector<LevelFigures> measure_figures(const pack::Pack& pack, const bake::SourceMesh& mesh);

inline constexpr double slack_box = 5e-5; ///< a few micrometres on a prop
inline constexpr double slack_share = 0.25;
/// Mean and 95th percentile of each level.
[[nodiscard]] std::vector<LimitVerdict> judge(const std::vector<LevelFigures>& figures, double mm_per_box);
/// An error that names the first false figure.
[[nodiscard]] Result<void> require_true(std::span<const LimitVerdict> figures, const std::string& pack);

} // namespace frustumscreen::bench
