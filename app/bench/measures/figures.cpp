#include "app/bench/measures/figures.h"

#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/level.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace frustumscreen::bench {

namespace {

/// Source points farther than this from the finest level are not visible to visitors.
constexpr float seen_reach_box = 5e-4F;

bool agree(float said, float measured) {
    const double s = static_cast<double>(said);
    const double m = static_cast<double>(measured);
    return std::abs(s - m) <= slack_share * std::max(s, m) + slack_box; // false for NaN
}

} // namespace

std::vector<LevelFigures> measure_figures(const pack::Pack& pack, const bake::SourceMesh& mesh) {
    const std::vector<glm::dvec3> points = bake::in_box(mesh, pack.box_from_file);
    const bake::SourceScene source(mesh, points);
    const bake::SourceSamples samples =
        bake::sample_source(source, bake::surface_of(pack.levels.back(), pack.box_size), seen_reach_box);
    std::vector<LevelFigures> figures;
    for (std::uint32_t k = 0; k < pack.levels.size(); ++k) {
        const pack::PackLevel& level = pack.levels[k];
        figures.push_back(
            {k, level.error,
             bake::measure(level, pack.textures[level.texture], pack.box_size, source, samples, false)});
    }
    return figures;
}

std::vector<LimitVerdict> judge(const std::vector<LevelFigures>& figures, double mm_per_box) {
    std::vector<LimitVerdict> verdicts;
    for (const LevelFigures& each : figures) {
        const auto mm = [mm_per_box](float box) { return mm_per_box * static_cast<double>(box); };
        verdicts.push_back({.what = fmt::format("level {}: the pack says {:.4f} mm mean, {:.4f} mm p95",
                                                each.level, mm(each.said.mean_box), mm(each.said.p95_box)),
                            .found = fmt::format("measured {:.4f} mm mean, {:.4f} mm p95",
                                                 mm(each.measured.mean_box), mm(each.measured.p95_box)),
                            .held = agree(each.said.mean_box, each.measured.mean_box) &&
                                    agree(each.said.p95_box, each.measured.p95_box)});
    }
    return verdicts;
}

Result<void> require_true(std::span<const LimitVerdict> figures, const std::string& pack) {
    const auto false_one = std::find_if(figures.begin(), figures.end(),
                                        [](const LimitVerdict& verdict) { return !verdict.held; });
    if (false_one == figures.end()) {
        return {};
    }
    return bad_input("bench.false_figures",
                     "{}: its own error figures are false, so the exhibit would choose its levels "
                     "wrongly; {}, {}; bake it again",
                     pack, false_one->what, false_one->found);
}

} // namespace frustumscreen::bench
