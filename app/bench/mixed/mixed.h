/// Ours against the paper's way to choose what each cell of an artifact is drawn as (mixed_techniques.h), on one walk at several
/// budgets of processor time.
///
/// Time     processor time of all threads for choice, plan and a full redraw, without read-back: for each frame the least of
///          some passes over the walk; then the median and the 99th percentile over its frames.
/// Budgets  a frame's processor time, in equal ratios from the cost of every cell at its finest level down to the
///          cost of every cell drawn in its cheapest way, on this machine. Each technique is steered by a number of
///          its own: the paper's by polygons a second, ours by the time that its model predicts. For each budget the
///          bench tries several of these numbers and takes the largest whose 99th percentile stays within the budget;
///          if none does, the fastest.
/// Model    fitted to frames of another walk, in which all cells are drawn alike. So are the paper's weights.
/// Error    as measure.h, of every Nth frame against the ray cast; popping as popping.h, of every frame, against 16 rays.
///
/// Threads  the caller's, which holds a context of its own during the call.
/// Errors   as CellSet and draw_walk.
#pragma once

#include "app/bench/measures/measure.h"
#include "app/bench/measures/time_left.h"
#include "app/bench/mixed/paper_choice.h"
#include "app/settings/settings.h"
#include "assets_baked/bake/source_mesh.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace frustumscreen::bench {

struct MixedOptions {
    int frames = 90;
    int passes = 3;
    int error_every = 6; ///< frames
    int budgets = 5;
    int steps = 9; ///< of each technique's own budget
    int samples = 0;
    std::uint64_t seed = 1;
};

/// One technique at one budget.
struct MixedRow {
    std::string technique; ///< "ours", "paper"
    double budget_us = 0.0;
    std::vector<double> frame_ms;  ///< one for each frame
    std::vector<double> pop_codes; ///< one for each frame but the first
    double error_mm_mean = 0.0;
    double silhouette_percent = 0.0;
    std::size_t switches = 0;

    [[nodiscard]] double ms_p50() const;
    [[nodiscard]] double ms_p99() const;
    [[nodiscard]] double max_pop_codes() const;
};
struct MixedResult {
    std::size_t cells = 0;
    PaperWeights weights;
    std::vector<MixedRow> rows; ///< by budget, the largest first; ours, then the paper's
};

/// `mesh`: what the pack was baked from.
[[nodiscard]] Result<MixedResult>
measure_mixed(const settings::Settings& settings, const std::filesystem::path& pack,
              const std::shared_ptr<const bake::SourceMesh>& mesh, const MixedOptions& options,
              const std::function<void(const std::string& step, double done)>& progress);

[[nodiscard]] std::string mixed_csv(const MixedResult& result);
/// Each frame's time and popping, for the plots.
[[nodiscard]] std::string mixed_frames_csv(const MixedResult& result);
[[nodiscard]] std::string mixed_table(const MixedResult& result);
/// "held" or "unmet": at which budgets ours is better in error and in popping.
[[nodiscard]] std::string mixed_verdicts(const MixedResult& result);

} // namespace frustumscreen::bench
