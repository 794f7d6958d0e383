/// Chooses the quality level (mesh level or relief, and samples a pixel) that keeps both the error tolerance
/// and the deadline.
///
/// First choice: of the quality levels that are good enough (error within the tolerance, with the samples
/// that the artifact asks for), the quickest, if it meets the deadline. Second: the finest level that meets
/// it, with as many samples as fit. Third: the quickest level.
///
/// Tolerance  half a projector pixel as that pixel lands on the face (docs/conventions.md). For the eye that
///            sees the most of a level's error, the surface is off by at most that on average and its outline
///            by at most half of that; no part is off by more than two pixels. The worst eye counts instead
///            of a typical one, because a visitor may stay where the level looks worst, and because the
///            limits of the bench are for the worst pose. The mean alone would hide a spout that is off by
///            pixels, where a visitor looks; distances between the surfaces hide what a slanting eye sees of
///            them (error_estimate.h).
/// Levers   fewer samples come before a coarser level, because samples do not affect the tolerance. Measured
///          on six scans (RMSE in codes against the finest level at 16 samples, llvmpipe): past the tolerance
///          a coarser level cost 2 to 200 codes for each millisecond saved, half the samples 4 to 14: about
///          equal at best, and far cheaper where a level thins a blade or loses a part.
/// Steady   hysteresis: a level is left when it takes more than 90 % of the deadline, and entered for
///          quality when it takes less than 70 %. A level that proves too slow soon after it was entered is
///          tried again after twice the time. Nothing changes within `dwell` of a change. So there is at most
///          one change per `dwell`, and a level that never fits is tried O(log t) times.
/// Doubt    the times at the start may be wrong: the current level counts as the quickest, and misses the
///          deadline. Levels with no more triangles and no more samples are then tried, least work first,
///          with exponential backoff: the wait doubles with each failed try. So a slow level is not kept
///          forever.
/// Source   Kim 2008, Eq. (1): the importance I = u P + v / |PA - PO| + w cos + x S of an object decides
///          whether it is drawn in images or in polygons. Here one object has many levels: u = 1, and P,
///          pixels for one texel, becomes pixels for one level's error, measured instead of assumed; v, w, x
///          = 0, because one artifact is shown and P includes its distance. Francken 2007, section 2 and Fig.
///          4: the tolerance is adapted at run time for a stable frame rate. Here it is adapted in measured
///          steps, with a model of each step's time, so that a step is known to fit before it is taken.
///
/// Units    millimetres on the configured prop; milliseconds.
/// Time     `now` is a parameter and may stand still or go back.
/// Threads  values; one caller. `observe` allocates nothing.
/// Errors   none: values that are not times are counted and ignored.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/prop_shape.h"
#include "app/geometry/transform.h"
#include "app/pack/pack_outline.h"
#include "app/pack/pack_relief.h"
#include "app/pack/seen_errors.h"
#include "app/scene/frame_time_model.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::scene {

/// The smallest width of a pixel on the prop's faces, metres: where the prop is nearest to the projector. On
/// a tilted face a pixel is longer in the other direction.
[[nodiscard]] double pixel_on_prop_m(const geometry::PropShape& prop, const geometry::Pinhole& projector,
                                     const geometry::RigidTransform& projector_from_prop);

/// One quality level: one way to draw an artifact.
struct QualityLevel {
    std::uint32_t level = 0; ///< index into Pack::levels; for a relief, its texels (pack_relief.h)
    int samples = 1;         ///< a pixel
    bool enough = false;     ///< within the tolerance, with the samples that the artifact asks for
    bool relief = false;     ///< a relief; rasterized on the processor unless `on_gpu`
    bool on_gpu = false;     ///< the GPU draws the relief

    [[nodiscard]] bool shows_as(const QualityLevel& other) const {
        return level == other.level && relief == other.relief && on_gpu == other.on_gpu;
    }
};

/// `worst`: the level's error for the eyes that see the most of it (worst_of).
[[nodiscard]] bool within_tolerance(const pack::LevelError& error, const pack::SeenError& worst,
                                    double mm_per_box, double tolerance_mm);

/// The quality levels for a governor, best first; nothing else must be loaded. They are the mesh level that
/// is good enough with the fewest triangles (the finest if none is), and coarser ones that each save at least
/// a quarter of the triangles, each with `samples`, half of it, ... 1 samples a pixel. `enough`: for each
/// mesh level, whether it is good enough. `relief`, which must be good enough, comes before the less exact
/// mesh levels, with `samples` and with 1: rasterized on the processor and, if `also_on_gpu`, drawn by the
/// GPU.
[[nodiscard]] std::vector<QualityLevel>
ladder(std::span<const pack::LevelOutline> levels, const std::vector<bool>& enough, int samples,
       const std::optional<pack::ReliefOutline>& relief = std::nullopt, bool also_on_gpu = false);

/// The tolerance for which a level is just enough, by the same rule; box units.
[[nodiscard]] double judged_error(const pack::LevelError& error, const pack::SeenError& worst);

class Governor {
public:
    static constexpr double enter_share = 0.70; ///< share of the deadline
    static constexpr double leave_share = 0.90;
    static constexpr Nanoseconds dwell = std::chrono::seconds(1);
    /// A level is left when it was too slow for this long: by then the effect of a single slow frame has
    /// decayed, and a lasting change is fully known.
    static constexpr Nanoseconds leave_delay = std::chrono::milliseconds(250);
    static constexpr Nanoseconds min_backoff = std::chrono::seconds(2);
    static constexpr Nanoseconds max_backoff = std::chrono::seconds(512);

    /// `times`: one for each level, measured on this GPU. At least one level is required.
    Governor(std::vector<QualityLevel> quality_levels, const std::vector<QualityLevelTime>& times,
             double deadline_ms);

    [[nodiscard]] std::size_t index() const { return current_; }
    [[nodiscard]] const QualityLevel& quality_level() const { return quality_levels_[current_]; }
    [[nodiscard]] double expected_ms() const { return model_.expected_ms(current_); }

    /// Call after a frame of `quality_level()`, which took `ms`; afterwards `quality_level()` may be another.
    void observe(MonotonicTime now, const FrameWork& work, double ms);

    /// Call when the artifact comes on show: chooses the level for the GPU's present load. The change is invisible,
    /// so it does not wait.
    void enter(MonotonicTime now, double load);
    [[nodiscard]] double load() const { return model_.load(); }

    [[nodiscard]] std::uint64_t switches() const { return switches_; }
    [[nodiscard]] std::uint64_t ignored() const { return ignored_; } ///< values that are not times

private:
    enum class Change { None, Leave, Quality, Try };
    [[nodiscard]] Nanoseconds delay_of(Change change) const;
    [[nodiscard]] std::size_t wanted() const;
    [[nodiscard]] bool fits(std::size_t quality_level) const;
    [[nodiscard]] double cost(std::size_t quality_level) const;
    /// A level that should be quicker than `current_`, whatever its time at the start; nullopt: `current_`
    /// has the least work.
    [[nodiscard]] std::optional<std::size_t> doubted() const;
    void change_to(std::size_t quality_level, MonotonicTime now);

    std::vector<QualityLevel> quality_levels_;
    FrameTimeModel model_;
    double deadline_ms_;
    std::size_t current_ = 0;
    bool entered_for_quality_ = false;
    MonotonicTime changed_; ///< when `current_` was entered
    Change wanted_ = Change::None;
    MonotonicTime wanted_since_;
    Nanoseconds backoff_ = min_backoff;
    Nanoseconds try_backoff_ = min_backoff;
    std::size_t tried_ = 0;    ///< the level that was tried last because of doubt
    double tried_at_ms_ = 0.0; ///< expected time of the level before it; 0: the try has been judged
    std::uint64_t switches_ = 0;
    std::uint64_t ignored_ = 0;
};

} // namespace frustumscreen::scene
