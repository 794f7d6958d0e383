/// Runs a way through a calibration on the table: shows, speaks and listens until it ends, then keeps the
/// result.
///
/// Time     the devices'. It sleeps between two rounds. Without a screen it does not sleep until a camera sends
///          its first frame: time is simulated, so that the result does not depend on the machine's speed.
/// Errors   the display stops; points cannot be written; a calibration cannot be kept, which the table shows
///          too.
/// Threads  the main one, with the display's context current.
#pragma once

#include "app/programs/calibrate/calibration_way.h"
#include "app/programs/calibrate/table_devices.h"
#include "app/programs/calibrate/table_pictures.h"

#include <functional>
#include <optional>
#include <thread>

namespace frustumscreen::programs {

template <typename Way> class ProcedureTable {
public:
    /// Functions and settings that differ between kinds of ways.
    struct Callbacks {
        std::function<void(Way&)> solve; ///< in stage Solve: computes the verdict
        /// A step with the input; a camera adds its frames.
        std::function<void(Way&, calibration::CalibrationInput&)> step =
            [](Way& way, calibration::CalibrationInput& heard) { way.step(heard); };
        std::function<Result<void>(const Way&)> write; ///< saves the points, also of an unfinished way
        std::function<Result<void>(const Way&)> keep;  ///< in stage Done
        std::function<Way(std::string)> why_not;       ///< a way that only shows a problem
        Nanoseconds between_rounds = std::chrono::milliseconds(20);
    };
    /// `devices` must outlive it.
    ProcedureTable(TableDevices& devices, const settings::Settings& settings, Callbacks callbacks)
        : devices_(devices), callbacks_(std::move(callbacks)) {
        devices_.simulate_time(devices.is_headless());
        const double focal_px = settings.projector.pinhole.fx;
        above_m_ = settings.projector.table_from_projector.translation.z;
        prop_px_ = settings.prop.base_m * focal_px / above_m_;
        board_px_ = calibration::Board::size_m.x * focal_px / above_m_;
    }

    /// Runs the way to its end and keeps the result. Nothing if it ended without one.
    [[nodiscard]] Result<std::optional<WayEnd>> measure(Way& way) {
        const Result<bool> ended = run(way);
        TRY_VOID(callbacks_.write(way));
        TRY_VOID(ended);
        if (!*ended) {
            return std::nullopt;
        }
        if (way.stage() == calibration::CalibrationStage::GoesOn) {
            return WayEnd::GoesOn;
        }
        const bool is_done = way.stage() == calibration::CalibrationStage::Done;
        if (const Result<void> kept = is_done ? callbacks_.keep(way) : Result<void>(); !kept) {
            Way told = callbacks_.why_not(kept.error().message);
            static_cast<void>(run(told)); // a technician at the table does not read standard error
            return tl::unexpected(kept.error());
        }
        stay(way);
        return is_done ? std::optional(WayEnd::Kept) : std::nullopt;
    }

private:
    /// False if it was told to stop.
    [[nodiscard]] Result<bool> run(Way& way) {
        while (!devices_.told_to_stop()) {
            const MonotonicTime now = devices_.now();
            TRY_VOID(show(way, now));
            if (way.has_ended()) {
                return true;
            }
            if (way.stage() == calibration::CalibrationStage::Solve) {
                callbacks_.solve(way);
            }
            calibration::CalibrationInput heard = devices_.hear(now);
            heard.lit = lit_;
            callbacks_.step(way, heard);
            wait();
        }
        return false;
    }
    /// Leaves the last words on the table for some time.
    void stay(const Way& way) {
        const MonotonicTime end = devices_.now() + TableDevices::last_words;
        while (!devices_.told_to_stop() && devices_.now() < end && show(way, devices_.now())) {
            wait();
        }
    }
    void wait() {
        if (devices_.is_time_simulated()) {
            devices_.advance(callbacks_.between_rounds);
        } else {
            std::this_thread::sleep_for(callbacks_.between_rounds);
        }
    }
    [[nodiscard]] Result<void> show(const Way& way, MonotonicTime now) {
        if (TableWords words = table_words(way); words != words_) {
            if (!words.lines.empty()) {
                devices_.say(words.lines, words.key);
            }
            words_ = std::move(words);
            devices_.show(table_picture(way, {.width = devices_.width(),
                                              .height = devices_.height(),
                                              .prop_px = prop_px_,
                                              .above_m = above_m_,
                                              .board_px = board_px_,
                                              .typesetter = devices_.typesetter(),
                                              .own_words = devices_.own_words()}));
        }
        TRY(const MonotonicTime lit, devices_.present(now));
        if (!lit_ || lit_->number != words_.of) {
            lit_ = calibration::CalibrationInput::Lit{words_.of, lit};
        }
        return {};
    }

    TableDevices& devices_;
    Callbacks callbacks_;
    double above_m_, prop_px_, board_px_; ///< height of the projector; approximate widths on the table
    TableWords words_;                    ///< the shown words
    std::optional<calibration::CalibrationInput::Lit> lit_;
};

} // namespace frustumscreen::programs
