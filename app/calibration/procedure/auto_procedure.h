/// Guides one technician through a calibration by a camera: what the projector shows, what is said, and which
/// rests of the board are taken.
///
/// Begin    Also reports what is wrong with the camera. Back goes on to the crosses if they follow.
/// Delay    The projector alternates light and dark to measure the camera's delay. If the camera does not see
///          the light, Back goes on to the crosses too.
/// Rests    The technician is told where to put the board next, and how. Once the tracker's reports are at
///          rest at a new place, the stripes are shown without a press. A rest that moved or was shadowed is
///          repeated automatically.
/// Buttons  Between rests Back drops the last one, and Next ends early, from `enough` rests on. While stripes
///          are shown Back ends them.
/// End      Next keeps the calibration, or repeats what does not fit; Back goes on with more rests.
/// Frames   tracker K, as the device reports; pixels of the projector.
/// Threads  one caller. A step may take some tenths of a second: it looks for tags and decodes.
#pragma once

#include "app/calibration/calibrate_auto.h"
#include "app/calibration/procedure/board_view.h"
#include "app/calibration/procedure/capture_delay.h"
#include "app/calibration/procedure/procedure.h"
#include "app/calibration/procedure/rest_request.h"
#include "app/calibration/procedure/still_reports.h"
#include "app/calibration/procedure/stripe_capture.h"

#include <tl/expected.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::calibration {

/// The remark beside the instruction.
enum class AutoPrompt {
    None,
    NoLight,     ///< the camera does not see the projector's light
    CameraFault, ///< the camera's state names it
    NoFrames,    ///< no frame, or frames of another size
    NotSeen,     ///< the tracker does not see the prop
    FewTags,     ///< too few are whole and lit
    TurnIt,      ///< the first flat rests must be turned against each other
    NotFlat,     ///< the first rests were not all flat
    LeansLittle, ///< the prop is neither flat nor leans enough
    WrongHeight, ///< the prop is flat, but neither on the table nor on the block
    Moved,       ///< the prop moved while the stripes were shown
    Disturbed,   ///< something passed through the light
    TooBright,
    Taken,
    Dropped, ///< the last rest
    TooFew   ///< too few rests to end here
};

struct AutoPlan {
    int rests = 16;
    double board_m = 0.003; ///< the board's thickness
    double block_m = 0.12;  ///< the block's height, if one is needed
    StripeSetup stripes;
    int frames = 2;              ///< of each striped picture
    bool crosses_follow = false; ///< Back goes on to the crosses instead of leaving
};
/// Stripes whose period suits the picture's width: a camera pixel covers more pixels of a finer picture.
[[nodiscard]] StripeSetup stripes_for(int width, int height);

class AutoProcedure : public Procedure<AutoPrompt, AutoCalibration> {
public:
    static constexpr Nanoseconds rest = std::chrono::milliseconds(1500);
    static constexpr Nanoseconds pause = std::chrono::seconds(3); ///< before useless stripes are shown again
    static constexpr std::size_t enough = 12;                     ///< rests
    static constexpr int min_tags = 3;
    static constexpr double same_place_m = 0.02;
    static constexpr double same_place_rad = 0.15;
    static constexpr double turned_rad = 0.35;
    static constexpr double flat_rad = 0.035;
    static constexpr double leaning_rad = 0.14;
    static constexpr double height_m = 8e-3; ///< tolerance of the height on the table or block

    AutoProcedure(Board board, const AutoPlan& plan, std::string problem = {});

    void step(const Input& input);

    /// The shown pattern; nothing: words. Each change of it increases `number`.
    [[nodiscard]] const std::optional<Pattern>& shown() const { return shown_; }
    [[nodiscard]] std::uint64_t number() const { return number_; }

    [[nodiscard]] camera::CameraState camera() const { return camera_; }
    [[nodiscard]] const AutoPlan& plan() const { return plan_; }
    [[nodiscard]] const Board& board() const { return board_; }
    [[nodiscard]] Rests rests() const;
    [[nodiscard]] std::size_t taken() const { return taken_.size(); }
    /// Number of rests wanted in all.
    [[nodiscard]] std::size_t wanted() const { return wanted_; }
    /// Number of rests from which on Next ends early.
    [[nodiscard]] std::size_t least() const { return std::min(enough, wanted_); }
    /// Number of tags that were whole and lit in the latest capture.
    [[nodiscard]] int tags() const { return tags_; }
    [[nodiscard]] RestRequest request() const {
        return next_request(taken_, {plan_.stripes.width, plan_.stripes.height});
    }
    [[nodiscard]] std::optional<Nanoseconds> delay() const { return delay_; }

private:
    [[nodiscard]] std::optional<Pattern> to_show() const;
    [[nodiscard]] std::optional<MonotonicTime> lit(const Input& input) const;
    void begin(const Input& input);
    void measure_delay(const Input& input);
    void place(const Input& input);
    void drop_last();
    [[nodiscard]] bool watch(const Input& input);
    [[nodiscard]] bool is_at_rest(const Input& input);
    [[nodiscard]] tl::expected<Posture, AutoPrompt> posture_of(const geometry::RigidTransform& report) const;
    [[nodiscard]] std::vector<tags::FoundTag> tags_in(const camera::CameraFrame& frame);
    void begin_capture(MonotonicTime now);
    void capture(const Input& input);
    void end_capture(MonotonicTime now, AutoPrompt word);
    void look_at_captures(MonotonicTime now);
    void take(MonotonicTime now, const BoardView& view);
    void after_judgement(const Input& input);
    void go_on();
    [[nodiscard]] std::vector<geometry::RigidTransform> flat_ones() const;

    Board board_;
    AutoPlan plan_;
    std::size_t wanted_;
    tags::TagDetector detector_;
    camera::CameraState camera_ = camera::CameraState::Running;
    std::optional<Pattern> shown_;
    std::uint64_t number_ = 0;
    std::optional<MonotonicTime>
        camera_well_; ///< latest time at which the camera was usable, or not yet needed
    std::optional<CaptureDelay> light_;
    std::optional<Nanoseconds> delay_;
    StillReports still_{3};
    std::optional<MonotonicTime> seen_; ///< the tracker's latest report
    std::optional<geometry::RigidTransform>
        done_with_;                           ///< the prop must leave this place before the next rest
    std::optional<MonotonicTime> not_before_; ///< after useless stripes
    std::vector<tags::FoundTag> found_;       ///< all tags that the detector finds
    std::vector<tags::FoundTag> before_;      ///< the board's tags in the first picture of the stripes
    int tags_ = 0;
    std::optional<StripeCapture> stripes_;
    std::vector<TakenRest> taken_;
    int last_name_ = 0;
};

} // namespace frustumscreen::calibration
