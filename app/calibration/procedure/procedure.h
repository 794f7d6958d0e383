/// The common part of the calibration procedures, by touch, by a camera and by eye, for one person with two buttons.
///
/// Begin    The table shows what is needed, or why the calibration cannot be done. Next begins, Back leaves.
///          After `to_begin` without a press the procedure ends by itself, so that the exhibit returns if a
///          person forgot the table or got here by chance.
/// Way      A way is a table of stages and their step functions. In a stage without a row a step changes nothing.
/// End      In stage Solve the caller computes the calibration and passes the verdict to `judge`. Each way defines
///          what the buttons do then.
/// Time     a parameter; the devices' own rates, whatever they are.
/// Threads  one caller.
#pragma once

#include "app/geometry/transform.h"
#include "firmware_host/base/time.h"
#include "firmware_host/camera/camera.h"

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace frustumscreen::calibration {

enum class CalibrationStage {
    Begin,     ///< the beginning; Back from the first point leads here too
    Delay,     ///< by a camera: its delay is measured
    Rest,      ///< by eye: the prop's rest is taken
    Shut,      ///< by eye: the person shuts one eye
    Place,     ///< prop or board is put at the next point, or a corner brought over its cross
    HoldStill, ///< a rest of the prop, or stillness of the head, is taken
    Capture,   ///< by a camera: the stripes are shown
    Solve,     ///< all points are taken: call `judge`
    Judged,    ///< the verdict is shown
    Done,      ///< the calibration is kept; from here on it has ended
    GoesOn,    ///< another way follows in its place
    Left       ///< it ends without a calibration
};

/// The input of one step: reports, presses and frames. Each way uses a part of it.
struct CalibrationInput {
    MonotonicTime now{};
    std::optional<geometry::RigidTransform> prop = std::nullopt; ///< a new report of its sensor, if any
    bool next = false;                                           ///< a button was pressed
    bool back = false;
    std::optional<geometry::RigidTransform> head = std::nullopt; ///< as of the prop
    const camera::CameraFrame* frame = nullptr;                  ///< a new frame
    camera::CameraState camera = camera::CameraState::Running;
    /// The time since which the picture with that number is lit.
    struct Lit {
        std::uint64_t number = 0;
        MonotonicTime since{};
    };
    std::optional<Lit> lit = std::nullopt;
};

template <typename Word, typename Judgement> class Procedure {
public:
    using Stage = CalibrationStage;
    using Input = CalibrationInput;
    static constexpr Nanoseconds timeout =
        std::chrono::seconds(2); ///< for the tracker's reports, and for a camera to start
    static constexpr Nanoseconds to_begin = std::chrono::minutes(1); ///< without a press
    static constexpr Nanoseconds to_go_on = std::chrono::minutes(10);

    /// Takes the result of the points, in stage Solve.
    void judge(Judgement judgement) {
        assert(stage_ == Stage::Solve);
        judged_ = std::move(judgement);
        go_to(Stage::Judged);
    }
    [[nodiscard]] Stage stage() const { return stage_; }
    [[nodiscard]] bool has_ended() const { return stage_ >= Stage::Done; }
    /// The remark that is shown below the instruction.
    [[nodiscard]] Word word() const { return word_; }
    [[nodiscard]] const std::string& problem() const { return problem_; }
    [[nodiscard]] const std::optional<Judgement>& judged() const { return judged_; }

protected:
    /// `problem`: a clause on why the calibration cannot be done; empty: it can.
    explicit Procedure(std::string problem) : problem_(std::move(problem)) {}

    template <typename Way> struct Row {
        Stage stage;
        void (Way::*step)(const Input&);
    };
    template <typename Way, std::size_t count>
    static void step_in_stage(Way& way, const Row<Way> (&rows)[count], const Input& input) {
        for (const Row<Way>& row : rows) {
            if (row.stage == way.stage_) {
                return (way.*row.step)(input);
            }
        }
    }
    void leave_if_alone(const Input& input) {
        latest_press_ = latest_press_ && !input.next && !input.back ? *latest_press_ : input.now;
        const Nanoseconds patient = stage_ == Stage::Begin ? to_begin : to_go_on;
        if (input.now - *latest_press_ > patient && stage_ != Stage::Done && stage_ != Stage::GoesOn) {
            stage_ = Stage::Left;
        }
    }
    void go_to(Stage stage, Word word = Word::None) {
        stage_ = stage;
        word_ = word;
    }

    Stage stage_ = Stage::Begin;
    Word word_ = Word::None;
    std::string problem_;
    std::optional<MonotonicTime>
        latest_press_; ///< initially the first step; a way may set it on other actions
    std::optional<Judgement> judged_;
};

} // namespace frustumscreen::calibration
