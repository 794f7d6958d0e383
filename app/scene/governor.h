/// Picks how an artifact is drawn: the level, and the samples a pixel, that keep both the error tolerance and
/// the deadline.
///
/// First choice: of the rungs that are good enough (their level's error is within the tolerance, with the
/// samples that the artifact wants), the quickest, if it meets the deadline. Second: the finest level that
/// meets it, with as many samples as fit. Third: the quickest rung.
///
/// Tolerance  half a projector pixel as that pixel lands on the face (docs/conventions.md): the eye that sees the
///          most of a level's error sees it off by no more than that on average, its outline by no more than half of
///          that, and no part of it is off by more than two pixels. The worst eye and not a typical one, because a
///          visitor may stay where the level looks worst, and the limits that the bench holds are those of the worst
///          pose. The mean alone would hide a spout that is off by pixels, where a visitor looks; distances between
///          the surfaces hide what a slanting eye sees of them (error_estimate.h).
/// Levers   fewer samples come before a coarser level, because samples do not affect the tolerance. Measured
///          on six scans (RMSE in codes against the finest level at 16 samples, llvmpipe): past the tolerance
///          a coarser level cost 2 to 200 codes for each millisecond saved, half the samples 4 to 14: about
///          equal at best, and far cheaper where a level thins a blade or loses a part.
/// Steady   a rung is left for a quicker one when it takes more than 90 % of the deadline, and entered for
///          quality when it takes less than 70 %; a rung that proves too slow soon after it was entered is
///          tried again after twice the time; nothing changes within `dwell` of a change. So at most one
///          change a `dwell`, and a rung that never fits is tried O(log t) times.
/// Doubt    the times at the start may be wrong: a rung is drawn late, and said to be the quickest, while another
///          has neither more triangles nor more samples. Such a one is tried, the least first, after a patience
///          that doubles with each try in vain. So the slowest is not kept for good.
/// Source   Kim 2008, Eq. (1): the importance I = u P + v / |PA - PO| + w cos + x S of an object decides
///          whether it is drawn in images or in polygons. Here one object has many levels: u = 1, and P,
///          pixels for one texel, becomes pixels for one level's error, measured, not assumed; v, w, x = 0,
///          because one artifact is shown and its distance is in P. Francken 2007, section 2 and Fig. 4: the
///          tolerance is adapted while running for a stable frame rate. Here it is adapted in measured
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

namespace frustumscreen {

/// The least width of a pixel on the prop's faces, metres: where the prop is nearest to the projector. On a
/// tilted face a pixel is longer the other way.
[[nodiscard]] double pixel_on_prop_m(const PropShape& prop, const Pinhole& projector,
                                     const RigidTransform& projector_from_prop);

/// One way to draw an artifact.
struct Rung {
    std::uint32_t level = 0; ///< of Pack::levels; of a relief its texels (pack_relief.h)
    int samples = 1;         ///< a pixel
    bool enough = false;     ///< within the tolerance, with the samples that the artifact wants
    bool relief = false;     ///< a relief, cast on the processor
    bool on_gpu = false;     ///< the relief, but drawn by the GPU

    [[nodiscard]] bool shows_as(const Rung& other) const {
        return level == other.level && relief == other.relief && on_gpu == other.on_gpu;
    }
};

/// `worst`: of the level, as the eyes see it that see the most of its error.
[[nodiscard]] bool within_tolerance(const LevelError& error, const SeenError& worst, double mm_per_box,
                                    double tolerance_mm);

/// The rungs that a governor may pick, best first; nothing else must be loaded. The level that is good enough
/// with fewest triangles (the finest if none is), coarser ones that save at least a quarter of
/// the triangles each, and each of them with `samples`, half of it, ... 1 samples a pixel.
/// `enough`: of each level, whether it is. `relief`, one that is good enough, stands before the levels that are less exact, with
/// `samples` and with 1: cast, and where `also_on_gpu`, drawn by the GPU.
[[nodiscard]] std::vector<Rung> ladder(std::span<const LevelOutline> levels, const std::vector<bool>& enough,
                                       int samples, const std::optional<ReliefOutline>& relief = std::nullopt,
                                       bool also_on_gpu = false);

class Governor {
public:
    static constexpr double enter_share = 0.70; ///< of the deadline
    static constexpr double leave_share = 0.90;
    static constexpr Nanoseconds dwell = std::chrono::seconds(1);
    /// A rung is left when it was too slow for this long: by then a single slow frame is forgotten, and a
    /// lasting change is fully known.
    static constexpr Nanoseconds relief_delay = std::chrono::milliseconds(250);
    static constexpr Nanoseconds least_patience = std::chrono::seconds(2);
    static constexpr Nanoseconds most_patience = std::chrono::seconds(512);

    /// `times`: one for each rung, measured on this GPU. At least one rung.
    Governor(std::vector<Rung> rungs, const std::vector<RungTime>& times, double deadline_ms);

    [[nodiscard]] std::size_t index() const { return current_; }
    [[nodiscard]] const Rung& rung() const { return rungs_[current_]; }
    [[nodiscard]] double expected_ms() const { return model_.expected_ms(current_); }

    /// A frame of `rung()` took `ms`; afterwards `rung()` may be another.
    void observe(MonotonicTime now, const FrameWork& work, double ms);

    /// The artifact comes on: takes the rung that fits the GPU's load now. Nobody sees this change, so it
    /// does not wait.
    void enter(MonotonicTime now, double load);
    [[nodiscard]] double load() const { return model_.load(); }

    [[nodiscard]] std::uint64_t switches() const { return switches_; }
    [[nodiscard]] std::uint64_t ignored() const { return ignored_; } ///< values that are not times

private:
    enum class Change { None, Relief, Quality, Try };
    [[nodiscard]] Nanoseconds delay_of(Change change) const;
    [[nodiscard]] std::size_t wanted() const;
    [[nodiscard]] bool fits(std::size_t rung) const;
    [[nodiscard]] double cost(std::size_t rung) const;
    /// One that should be quicker than `current_`, whatever its time at the start was; none: `current_` has the least work.
    [[nodiscard]] std::optional<std::size_t> doubted() const;
    void change_to(std::size_t rung, MonotonicTime now);

    std::vector<Rung> rungs_;
    FrameTimeModel model_;
    double deadline_ms_;
    std::size_t current_ = 0;
    bool entered_for_quality_ = false;
    MonotonicTime changed_; ///< when `current_` was entered
    Change wanted_ = Change::None;
    MonotonicTime wanted_since_;
    Nanoseconds patience_ = least_patience;
    Nanoseconds try_patience_ = least_patience;
    std::size_t tried_ = 0;    ///< the rung that was doubted last
    double tried_at_ms_ = 0.0; ///< what the one before it took; 0: the try is judged
    std::uint64_t switches_ = 0;
    std::uint64_t ignored_ = 0;
};

} // namespace frustumscreen
