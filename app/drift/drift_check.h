/// Drift: whether the picture has moved since calibration, measured by drift marks that the projector shows
/// to a camera.
///
/// Learned  the first sets after a calibration that agree become the reference; each later set is compared
///          with it. A homography maps the camera's pixels to the table as in the reference, so a mark's
///          displacement is known in metres.
/// Camera   stands still above the table and need not be calibrated. If at least three tags are fixed on the
///          table around the picture, they show the camera's own movement, which is then removed. Without
///          them the movements of camera and projector cannot be told apart.
/// Told     a verdict changes once `agreeing` consecutive sets, over `min_time`, agree; a hand, a shadow or
///          a prop that hides some marks does not change it.
/// Units    metres on the table.
/// Time     a parameter: that of the sets.
/// Threads  one caller.
#pragma once

#include "app/drift/drift_reference.h"

#include <deque>

namespace frustumscreen::drift {

enum class DriftState : std::uint8_t {
    Learning, ///< there is no reference yet
    Looking,  ///< there is a reference, but too few sets for a verdict
    Well,     ///< the picture is where it was calibrated
    Moved,    ///< the picture has moved
    Blind     ///< too few marks are seen
};

/// Displacement of one set from the reference.
struct DriftMeasure {
    double off_m = 0.0;      ///< median length of the marks' displacements
    glm::dvec2 shift_m{0.0}; ///< median of each coordinate
    std::size_t marks = 0;   ///< seen in both
    bool anchored = false;   ///< the camera's own movement is removed
};
/// nullopt: too few marks.
[[nodiscard]] std::optional<DriftMeasure> measure_drift(const DriftReference& reference, const MarkSet& set);

struct DriftVerdict {
    DriftState state = DriftState::Learning;
    double off_m = 0.0; ///< median of the latest sets
    bool anchored = false;
    std::size_t marks = 0; ///< seen in the latest set
    std::size_t looks = 0; ///< sets since the start
};

class DriftCheck {
public:
    static constexpr double tolerance_m = 2e-3;
    static constexpr double well_again_m = 1.5e-3;
    static constexpr double agree_m = 1e-3;        ///< largest difference of sets that agree
    static constexpr std::size_t agreeing = 5;     ///< consecutive sets
    static constexpr std::size_t learned_from = 3; ///< agreeing sets that become the reference
    static constexpr double learn_agree_px = 1.0;
    static constexpr Nanoseconds min_time = std::chrono::minutes(3); ///< from the first of the agreeing
                                                                     ///< sets to the last
    static constexpr std::size_t min_marks = 4;

    /// `blank`: a reference with the places of the marks, without pixels.
    explicit DriftCheck(DriftReference blank) : reference_(std::move(blank)) {}
    /// Sets a stored reference, which must fit the calibration.
    void know(DriftReference reference);

    /// Returns whether the reference is new and must be stored.
    [[nodiscard]] bool take(const MarkSet& set);
    [[nodiscard]] const DriftVerdict& verdict() const { return verdict_; }
    [[nodiscard]] bool knows() const { return known_; }
    [[nodiscard]] const DriftReference& reference() const { return reference_; }

private:
    [[nodiscard]] bool learn(const MarkSet& set);
    void judge();

    struct Dated {
        MonotonicTime time;
        std::optional<DriftMeasure> measure;
    };
    DriftReference reference_;
    bool known_ = false;
    std::vector<MarkSet> first_; ///< the sets while learning
    std::deque<Dated> latest_;
    DriftVerdict verdict_;
};

} // namespace frustumscreen::drift
