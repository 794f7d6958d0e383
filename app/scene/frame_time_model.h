/// How long a frame takes on this GPU, for each way (a rung) in which an artifact can be drawn.
///
/// Each rung is measured at the start, at one pose. From there a frame's time is
///   ms(rung) = start_ms(rung) * (fixed + triangles' share * their number + samples' share * their number)
///              * own(rung) * load
/// with the numbers relative to those at the start: on the shipped set-up triangles and pixels explain half
/// of the spread that poses make (17 -> 8 % of the mean, four scans on llvmpipe). `load` is common: a GPU
/// that is throttled or shared is slow for every rung, also for those that are not being drawn. Right after a
/// change of rung an unexpected time changes only the new rung's `own`: its proportion was measured wrong. If
/// in fact the load changed at that moment, the mistake wears off: `own` of the rung that is drawn flows into
/// `load` within some `forgetting_s`, and the proportions return to those of the start. Both are kept as
/// logarithms and follow log(measured / expected) by
///   x += (1 - exp(-dt / time_constant)) * log(measured / expected),
/// the exact solution over a frame: stable for every dt, and split frames give what one frame gives. A single
/// outlier counts by its logarithm: at 60 Hz one frame of ten times the usual time moves the estimate by a
/// fifth, and that is forgotten in some tenths of a second.
///
/// Units    milliseconds of wall time.
/// Time     a parameter; time that goes back changes nothing. At most `most_dt_s` counts for one frame: after
///          an hour of rest the next frame's time must not decide alone.
/// Threads  values; one caller. `observe` allocates nothing.
/// Errors   none: a value that is not a time (NaN, infinite, zero, negative, above `longest_ms`) is refused,
///          and `observe` returns false.
#pragma once

#include "firmware_host/base/time.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace frustumscreen {

/// What one frame draws of the artifact.
struct FrameWork {
    double triangles = 0.0; ///< of a relief its blocks
    double pixels = 0.0;    ///< of the rectangle that the artifact can light
};

/// A rung as measured at the start.
struct RungTime {
    int samples = 1; ///< a pixel
    FrameWork work;
    double ms = 0.0; ///< median of some frames; not a time = never measured: infinite until it is observed
    bool relief = false; ///< this and `on_gpu`: as Rung
    bool on_gpu = false;
};

/// What frames cost on this GPU, from the rungs measured on one artifact; good for another one whose frames' work
/// is known and whose times are not.
struct RungCost {
    double fixed_ms = 0.0;
    double ms_per_triangle = 0.0;
    double ms_per_sample = 0.0; ///< of a pixel
    [[nodiscard]] double ms(const FrameWork& work, int samples) const;
};
/// Meshes, reliefs that are cast and reliefs that the GPU draws are drawn in different ways and cost apart.
struct FrameCost {
    RungCost mesh, cast, on_gpu;
    [[nodiscard]] const RungCost& of(const RungTime& rung) const {
        return rung.on_gpu ? on_gpu : rung.relief ? cast : mesh;
    }
    /// Of a rung's work and samples.
    [[nodiscard]] double ms(const RungTime& rung) const;
};
/// Least squares, each rung weighed by 1 / ms^2; no term is negative. Rungs that are no times are left out; without any
/// all terms are 0, which is no time either.
[[nodiscard]] FrameCost cost_of(const std::vector<RungTime>& rungs);

class FrameTimeModel {
public:
    static constexpr double time_constant_s = 0.2;
    static constexpr double most_dt_s = 0.1;
    static constexpr double longest_ms = 10e3; ///< a longer time is a fault, not a frame time
    static constexpr double learning_s = 0.5;  ///< of frames after a change of rung, which change `own`
    static constexpr double forgetting_s = 10.0;

    explicit FrameTimeModel(const std::vector<RungTime>& rungs);

    /// Takes the time of a frame drawn at `rung`. Returns false if `ms` is not a time; then nothing changes.
    bool observe(std::size_t rung, const FrameWork& work, double ms, MonotonicTime now);

    /// The time of the next frames, if their work is that of the latest ones.
    [[nodiscard]] double expected_ms(std::size_t rung) const;

    /// As it was measured at the start.
    [[nodiscard]] const RungTime& start(std::size_t rung) const { return rungs_[rung].start; }

    /// Common to all artifacts of one GPU: pass it on when another is shown.
    [[nodiscard]] double load() const;
    void set_load(double load);

    [[nodiscard]] static bool is_time(double ms);

private:
    struct Rung {
        RungTime start;
        double triangle_share = 0.0; ///< of `start.ms`
        double sample_share = 0.0;
        double log_own = 0.0;
    };
    void fit_shares();
    [[nodiscard]] double relative_work(const Rung& rung, double triangles, double pixels) const;

    std::vector<Rung> rungs_;
    double log_load_ = 0.0;
    double triangles_ = 1.0; ///< of the latest frames, smoothed; relative to the start
    double pixels_ = 1.0;
    std::optional<std::size_t> last_rung_;
    MonotonicTime last_time_;
    double learned_s_ = 0.0; ///< of frames since the last change of rung
};

} // namespace frustumscreen
