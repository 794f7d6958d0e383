/// Guides one technician with two buttons through a calibration by touch, or a touch-up: which cross the
/// projector shows, what is said, and which of the tracker's reports become touches.
///
/// Steps    The cross is shown; the prop is laid on it; Next is pressed; one second of rest is taken, and
///          begins again if the prop moves; the next cross follows.
/// End      Next keeps the result; Back repeats the touch with the largest residual; touches to repeat come
///          again by themselves. If the touches are too few, to check each other or for the picture's
///          uncertainty, two more crosses come at a time.
/// Touch-up Back at the beginning, and Next after a refusal, lead to the whole calibration; Back after a
///          refusal repeats all touches.
/// Frames   tracker K, as the device reports.
/// Threads  pure; any.
#pragma once

#include "app/calibration/calibrate_touch.h"
#include "app/calibration/choose_crosses.h"
#include "app/calibration/procedure/procedure.h"
#include "app/calibration/procedure/still_reports.h"

#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::calibration {

enum class TouchTask {
    Anew,   ///< projector, tracker and sensor
    TouchUp ///< only what moved since the kept calibration
};

/// The result of the touches that the procedure depends on.
struct TouchJudgement {
    Verdict verdict = Verdict::Refused;
    std::vector<std::string> told;        ///< the result, in a technician's words
    std::vector<std::size_t> repeat;      ///< touches to do again, counted from 0
    std::vector<TouchResidual> residuals; ///< of each touch; empty if unknown
    bool nothing_moved = false;           ///< a touch-up without anything to keep
};

/// The remark beside the cross.
enum class TouchPrompt {
    None,
    Moved,     ///< the prop moved: the second begins again
    NotSeen,   ///< the tracker does not see the prop
    SamePlace, ///< the prop still lies where the previous touch was
    Taken      ///< the touch is taken
};

class TouchProcedure : public Procedure<TouchPrompt, TouchJudgement> {
public:
    static constexpr Nanoseconds rest = std::chrono::seconds(1);
    static constexpr double same_place_m = 5e-3;
    static constexpr double same_place_rad = 0.2;
    static constexpr std::size_t min_reports = 5;  ///< in the second of rest
    static constexpr std::size_t more_at_once = 2; ///< crosses that come where the touches are too few

    /// `crosses`: at least one, in the order in which they come.
    explicit TouchProcedure(std::vector<Cross> crosses, std::string problem = {})
        : Procedure(std::move(problem)), crosses_(std::move(crosses)), asked_(crosses_.size()),
          touches_(crosses_.size()) {}
    /// A procedure with the first `asked` crosses; the others follow while the verdict asks for more touches.
    TouchProcedure(TouchTask task, std::vector<Cross> crosses, std::size_t asked, std::string problem = {})
        : Procedure(std::move(problem)), task_(task), crosses_(std::move(crosses)), asked_(asked),
          touches_(crosses_.size()) {}

    void step(const Input& input);

    [[nodiscard]] TouchTask task() const { return task_; }
    /// Index of the shown cross, from 0; in the stages Place and HoldStill.
    [[nodiscard]] std::size_t at() const { return at_; }
    [[nodiscard]] const Cross& cross() const { return crosses_[at_]; }
    [[nodiscard]] const std::vector<Cross>& crosses() const { return crosses_; }
    /// Number of crosses to touch.
    [[nodiscard]] std::size_t count() const { return asked_; }
    /// True if Next asks for more crosses, after the verdict.
    [[nodiscard]] bool asks_for_more() const;
    [[nodiscard]] bool is_taken(std::size_t cross) const { return touches_[cross].has_value(); }
    /// All touches, in stage Solve and after it.
    [[nodiscard]] Touches touches() const;

private:
    void begin(const Input& input);
    void lay(const Input& input);
    void hold_still(const Input& input);
    void take();
    [[nodiscard]] bool lies_where_another_lay(const geometry::RigidTransform& pose) const;
    void after_judgement(const Input& input);
    void go_to_next_open();
    void touch_worst_again();

    TouchTask task_ = TouchTask::Anew;
    std::vector<Cross> crosses_;
    std::size_t asked_;
    std::vector<std::optional<Touch>> touches_; ///< one for each cross
    std::size_t at_ = 0;
    StillReports still_{1}; ///< of the rest so far
    MonotonicTime rest_began_{};
    MonotonicTime seen_{};
};

} // namespace frustumscreen::calibration
