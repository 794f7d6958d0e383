/// The exhibit's torch against the paper's (torch_techniques.h): cost and error of its light, on one sweep over each scene.
///
/// Time     processor time of all threads for the plan and a full redraw, without read-back: for each frame the least of
///          some passes, which the techniques take in turn; then the median and the 99th percentile over the frames.
///          `paper_steered` is steered by its first pass; the others repeat those tolerances.
/// Error    the intensity's difference from torch_truth.h, in per cent of the full intensity, over the pixels that
///          the truth lights, in some frames. The 8 bits of a pixel's code alone cause up to 0.4 % at full light.
///
/// Threads  that of the set.
/// Errors   as TorchSet, draw_sweep and PaperTorch.
#pragma once

#include "app/bench/torch/torch_techniques.h"
#include "app/bench/torch/torch_truth.h"

#include <functional>
#include <string>
#include <vector>

namespace frustumscreen::bench {

struct TorchOptions {
    int frames = 80;
    int passes = 3;
    int errors = 6; ///< frames that are measured
    std::uint64_t seed = 1;
};

/// One technique in one scene.
struct TorchRow {
    std::string scene;
    TorchWay way;
    std::vector<double> frame_ms;
    std::vector<std::size_t> triangles; ///< of each frame, after splitting
    IntensityError error;

    [[nodiscard]] double ms_p50() const;
    [[nodiscard]] double ms_p99() const;
    /// The mean over the frames; 0 for a technique that has no edge length.
    [[nodiscard]] double tolerance_mm() const;
};
struct TorchResult {
    std::vector<TorchRow> rows;    ///< scene by scene, one sample a pixel
    std::vector<TorchRow> samples; ///< none, ours, ours_no_shadow at the pack's samples; times alone
};

using TorchProgress = std::function<void(const std::string& step, double done)>;

[[nodiscard]] Result<TorchResult> measure_torch(TorchSet& set, const TorchOptions& options,
                                                const TorchProgress& progress);

[[nodiscard]] std::string torch_csv(const TorchResult& result);
/// The cost of the light at one sample a pixel, and at the pack's own number of samples.
[[nodiscard]] std::string torch_samples_csv(const TorchResult& result);
/// Each frame's time, tolerance and triangles, for the plots.
[[nodiscard]] std::string torch_frames_csv(const TorchResult& result);
/// Triangles, and the light where there is shadow.
[[nodiscard]] std::string torch_details_csv(const TorchResult& result);
[[nodiscard]] std::string torch_table(const TorchResult& result);
/// "held" or "unmet": cost, error and steadiness.
[[nodiscard]] std::string torch_verdicts(const TorchResult& result);

} // namespace frustumscreen::bench
