/// Predicts the time of a frame on this GPU for each quality level of an artifact.
///
/// Each quality level is measured at the start, at one pose. From there a frame's time is
///   ms(quality level) = start_ms(quality level) * (fixed + triangles' share * their number + samples' share * their number)
///              * own(quality level) * load
/// with the numbers relative to those at the start: on the shipped set-up triangles and pixels explain half
/// of the variation between poses (17 -> 8 % of the mean, four scans on llvmpipe). `load` is common to all
/// levels: a GPU that is throttled or shared is slow for every quality level, also for those that are not
/// being drawn. Right after a change of level an unexpected time changes only the new level's `own`: its
/// proportion was measured wrong. If in fact the load changed at that moment, the mistake wears off: `own` of
/// the level that is drawn flows into `load` within about `forgetting_s`, and the proportions return to those
/// of the start. Both are kept as logarithms and follow log(measured / expected) by
///   x += (1 - exp(-dt / time_constant)) * log(measured / expected),
/// the exact solution over a frame: it is stable for every dt, and the result does not depend on how an
/// interval is split into frames. A single outlier counts by its logarithm: at 60 Hz one frame of ten times
/// the usual time moves the estimate by a fifth, and the effect decays within some tenths of a second.
///
/// Units    milliseconds of wall time.
/// Time     a parameter; time that goes back changes nothing. At most `max_dt_s` counts for one frame, so
///          that the first frame after a long pause does not decide alone.
/// Threads  values; one caller. `observe` allocates nothing.
/// Errors   none: a value that is not a time (NaN, infinite, zero, negative, above `longest_ms`) is refused,
///          and `observe` returns false.
#pragma once

#include "firmware_host/base/time.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace frustumscreen::scene {

/// The work of one frame for the artifact.
struct FrameWork {
    double triangles = 0.0; ///< for a relief, its blocks
    double pixels = 0.0;    ///< of the rectangle that the artifact can light
};

/// A quality level as measured at the start.
struct QualityLevelTime {
    int samples = 1; ///< a pixel
    FrameWork work;
    double ms = 0.0;     ///< median of some frames; not a time if never measured: infinite until the first
                         ///< observation
    bool relief = false; ///< `relief`, `on_gpu`: as in QualityLevel
    bool on_gpu = false;
};

/// Cost of frames on this GPU, fitted to the quality levels measured on one artifact. It predicts the times
/// of another artifact whose work per frame is known.
struct QualityLevelCost {
    double fixed_ms = 0.0;
    double ms_per_triangle = 0.0;
    double ms_per_sample = 0.0; ///< per sample of a pixel
    [[nodiscard]] double ms(const FrameWork& work, int samples) const;
};
/// Meshes, reliefs rasterized on the processor and reliefs drawn by the GPU are drawn in different ways, with
/// separate costs.
struct FrameCost {
    QualityLevelCost mesh, raster, on_gpu;
    [[nodiscard]] const QualityLevelCost& of(const QualityLevelTime& quality_level) const {
        return quality_level.on_gpu ? on_gpu : quality_level.relief ? raster : mesh;
    }
    /// For the level's work and samples.
    [[nodiscard]] double ms(const QualityLevelTime& quality_level) const;
};
/// Least squares, each level weighted by 1 / ms^2; no term is negative. Levels without a valid time are
/// skipped; if none is valid, all terms are 0, which is not a valid time either.
[[nodiscard]] FrameCost cost_of(const std::vector<QualityLevelTime>& quality_levels);

class FrameTimeModel {
public:
    static constexpr double time_constant_s = 0.2;
    static constexpr double max_dt_s = 0.1;
    static constexpr double longest_ms = 10e3; ///< a longer time is a fault, not a frame time
    static constexpr double learning_s = 0.5;  ///< length of frames after a change of level that adjust `own`
    static constexpr double forgetting_s = 10.0;

    explicit FrameTimeModel(const std::vector<QualityLevelTime>& quality_levels);

    /// Takes the time of a frame drawn at `quality_level`. Returns false if `ms` is not a time; then nothing changes.
    bool observe(std::size_t quality_level, const FrameWork& work, double ms, MonotonicTime now);

    /// The time of the next frames, if their work is that of the latest ones.
    [[nodiscard]] double expected_ms(std::size_t quality_level) const;

    /// The level as measured at the start.
    [[nodiscard]] const QualityLevelTime& start(std::size_t quality_level) const {
        return quality_levels_[quality_level].start;
    }

    /// Common to all artifacts of one GPU: pass it on when another artifact is shown.
    [[nodiscard]] double load() const;
    void set_load(double load);

    [[nodiscard]] static bool is_time(double ms);

private:
    struct QualityLevel {
        QualityLevelTime start;
        double triangle_share = 0.0; ///< share of `start.ms`
        double sample_share = 0.0;
        double log_own = 0.0;
    };
    void fit_shares();
    [[nodiscard]] double relative_work(const QualityLevel& quality_level, double triangles,
                                       double pixels) const;

    std::vector<QualityLevel> quality_levels_;
    double log_load_ = 0.0;
    double triangles_ = 1.0; ///< of the latest frames, smoothed; relative to the start
    double pixels_ = 1.0;
    std::optional<std::size_t> last_quality_level_;
    MonotonicTime last_time_;
    double learned_s_ = 0.0; ///< time of frames since the last change of level
};

} // namespace frustumscreen::scene
