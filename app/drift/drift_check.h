/// Whether the picture still lies where it was calibrated, by where a camera sees marks of light that the projector shows.
///
/// Learned   The first sets after a calibration that agree become the reference; each later one is held against it: a homography takes
///           the camera's pixels to the table as the reference had it, so that a mark's way is known in metres.
/// Camera    stands still above the table, and need not be calibrated. Where tags lie on the table for good (three at least, around the picture),
///           they tell how the camera itself moved, and that is taken out. Without them nobody can tell whether camera or projector did.
/// Told      once `agreeing` sets in a row, over `least_time`, say the same: a hand, a shadow or a prop that hides some marks does not.
/// Units     metres on the table.
/// Time      a parameter: that of the sets.
/// Threads   one caller.
#pragma once

#include "app/drift/drift_reference.h"

#include <deque>

namespace frustumscreen {

enum class DriftState : std::uint8_t {
    Learning, ///< there is no reference yet
    Looking,  ///< there is one, and too few sets to say more
    Well,     ///< the picture is where it was calibrated
    Moved,    ///< it is not
    Blind     ///< too few marks are seen
};

/// How one set lies beside the reference.
struct DriftMeasure {
    double off_m = 0.0;      ///< median of the marks' ways
    glm::dvec2 shift_m{0.0}; ///< median of each coordinate
    std::size_t marks = 0;   ///< that were seen in both
    bool anchored = false;   ///< the camera's own way is taken out
};
/// Nothing: too few marks.
[[nodiscard]] std::optional<DriftMeasure> measure_drift(const DriftReference& reference, const MarkSet& set);

struct DriftVerdict {
    DriftState state = DriftState::Learning;
    double off_m = 0.0; ///< of the latest sets, their median
    bool anchored = false;
    std::size_t marks = 0; ///< seen in the latest set
    std::size_t looks = 0; ///< sets since the start
};

class DriftCheck {
public:
    static constexpr double tolerance_m = 2e-3;
    static constexpr double well_again_m = 1.5e-3;
    static constexpr double agree_m = 1e-3;        ///< sets that say the same
    static constexpr std::size_t agreeing = 5;     ///< sets in a row
    static constexpr std::size_t learned_from = 3; ///< sets that agree become the reference
    static constexpr double learn_agree_px = 1.0;
    static constexpr Nanoseconds least_time = std::chrono::minutes(3); ///< from the first of them to the last
    static constexpr std::size_t least_marks = 4;

    /// `blank`: calibration, frames and marks without places.
    explicit DriftCheck(DriftReference blank) : reference_(std::move(blank)) {}
    /// A reference that was stored; it fits the calibration.
    void know(DriftReference reference);

    /// Returns whether the reference is new, and to be stored.
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
    std::vector<MarkSet> first_; ///< while it learns
    std::deque<Dated> latest_;
    DriftVerdict verdict_;
};

} // namespace frustumscreen
