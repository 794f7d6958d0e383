/// Measures cost and error of frozen windows by every technique of window_technique.h, as the multi-LDI report's Fig. 8 does.
///
/// Time     processor time of all threads. A frame draws the scene in the prop, then one to four windows, and waits
///          after each; the time of a frame with n windows ends when window n is drawn. A frame's time is the least
///          of several passes, which the techniques take in turn; results are the median and the 99th percentile over
///          the frames. Every eye moves in every frame, and everything is redrawn.
/// Error    a window's picture against rays (docs/conventions.md), the mean over the pictures of some frames; in the
///          table of patches, over eyes drawn in each patch of the hemisphere.
/// Threads  the caller's; each set makes a display's context of its own current there.
/// Errors   as WindowSet and the techniques.
#pragma once

#include "app/bench/ldi/window_set.h"
#include "app/bench/ldi/window_technique.h"
#include "app/bench/measures/measure.h"

#include <functional>
#include <string>
#include <vector>

namespace frustumscreen::bench {

struct LdiOptions {
    std::vector<std::size_t> triangles{126'790, 264'247, 630'799}; ///< the report's
    int pixels = 256;                                              ///< along a window's side; the report's
    int frames = 12;
    int passes = 3;
    int errors = 8;                         ///< frames that are measured, each through one of the windows
    std::vector<int> resolutions{128, 256}; ///< of the errors by patch, in the largest scene
    bool coarse = false;                    ///< patches as reliefs with coarser texels too
    int eyes_in_patch = 1;
    std::uint64_t seed = 1;
};

struct LdiError {
    double silhouette_pct = 0.0, error_mm = 0.0, rmse = 0.0;
    int pictures = 0;
    void add(const PictureError& error);
    [[nodiscard]] LdiError mean() const;
};

struct LdiRow {
    std::size_t triangles = 0;
    std::string technique;
    /// The times of each frame, with 0 windows to `max_windows`.
    std::array<std::vector<double>, max_windows + 1> frame_ms;
    LdiError error;                 ///< of a window
    double mb = 0.0, make_ms = 0.0; ///< of one window

    [[nodiscard]] double ms_p50(std::size_t windows) const;
    [[nodiscard]] double ms_p99(std::size_t windows) const;
    /// Cost of one more window: a quarter of the cost of four, in the median.
    [[nodiscard]] double window_ms() const;
};
struct LdiPatchRow {
    std::size_t triangles = 0;
    std::string technique;
    int pixels = 0;
    std::size_t patch = 0;
    LdiError error;
};
/// A picture of a window by one technique, or of the scene alone.
struct LdiPicture {
    std::string name; ///< of the technique, or "alone"
    image::Image8 picture;
};
struct LdiResult {
    std::vector<LdiRow> rows;          ///< scene by scene
    std::vector<LdiPicture> pictures;  ///< of the largest scene
    std::vector<LdiPatchRow> by_patch; ///< of the largest scene
};

using LdiProgress = std::function<void(const std::string& step, double done)>;

[[nodiscard]] Result<LdiResult> measure_ldi(const settings::Settings& settings, const LdiOptions& options,
                                            const LdiProgress& progress);
/// Every technique, geometry first. `coarse`: patches as reliefs with texels of two and four pixels too.
[[nodiscard]] Result<std::vector<std::unique_ptr<WindowTechnique>>> window_techniques(WindowSet& set,
                                                                                      bool coarse);

[[nodiscard]] std::string ldi_csv(const LdiResult& result);
[[nodiscard]] std::string ldi_error_csv(const LdiResult& result);
[[nodiscard]] std::string ldi_table(const LdiResult& result);
/// "held" or "unmet".
[[nodiscard]] std::string ldi_verdicts(const LdiResult& result);

} // namespace frustumscreen::bench
