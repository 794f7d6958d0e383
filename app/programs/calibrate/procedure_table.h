/// A way through a calibration on the table: what it shows and says, what is heard, one after the other until it has ended; then it is kept.
///
/// Time     the devices'. Between two rounds it is waited; without a screen nobody looks on, and that time is passed over.
/// Errors   the display stops; points cannot be written; a calibration cannot be kept, which the table tells too.
/// Threads  the main one, with the display's context current.
#pragma once

#include "app/programs/calibrate/calibration_way.h"
#include "app/programs/calibrate/table_devices.h"
#include "app/programs/calibrate/table_pictures.h"

#include <functional>
#include <optional>
#include <thread>

namespace frustumscreen {

template <typename Way> class ProcedureTable {
public:
    /// What one kind of way does in its own manner.
    struct Manner {
        std::function<void(Way&)> solve; ///< in stage Solve: judges it
        /// With what is heard; by a camera with what that sees too.
        std::function<void(Way&, CalibrationInput&)> step = [](Way& way, CalibrationInput& heard) {
            way.step(heard);
        };
        std::function<Result<void>(const Way&)> write; ///< nothing that was measured is lost
        std::function<Result<void>(const Way&)> keep;  ///< in stage Done
        std::function<Way(std::string)> why_not;       ///< one that only tells a problem
        Nanoseconds between_rounds = std::chrono::milliseconds(20);
        bool with_camera = false; ///< its frames come in the system's time, of which nothing is passed over
    };
    /// `devices` outlive it.
    ProcedureTable(TableDevices& devices, const Settings& settings, Manner manner)
        : devices_(devices), manner_(std::move(manner)) {
        const double focal_px = settings.projector.pinhole.fx;
        above_m_ = settings.projector.table_from_projector.translation.z;
        prop_px_ = settings.prop.base_m * focal_px / above_m_;
        board_px_ = Board::size_m.x * focal_px / above_m_;
    }

    /// From the first word on the table to what is kept. Nothing: it ended without.
    [[nodiscard]] Result<std::optional<WayEnd>> measure(Way& way) {
        const Result<bool> ended = run(way);
        TRY_VOID(manner_.write(way));
        TRY_VOID(ended);
        if (!*ended) {
            return std::nullopt;
        }
        if (way.stage() == CalibrationStage::GoesOn) {
            return WayEnd::GoesOn;
        }
        const bool is_done = way.stage() == CalibrationStage::Done;
        if (const Result<void> kept = is_done ? manner_.keep(way) : Result<void>(); !kept) {
            Way told = manner_.why_not(kept.error().message);
            static_cast<void>(run(told)); // whoever stands at the table reads no standard error
            return tl::unexpected(kept.error());
        }
        stay(way);
        return is_done ? std::optional(WayEnd::Kept) : std::nullopt;
    }

private:
    /// False: it was told to stop.
    [[nodiscard]] Result<bool> run(Way& way) {
        while (!devices_.told_to_stop()) {
            const MonotonicTime now = devices_.now();
            TRY_VOID(show(way, now));
            if (way.has_ended()) {
                return true;
            }
            if (way.stage() == CalibrationStage::Solve) {
                manner_.solve(way);
            }
            CalibrationInput heard = devices_.hear(now);
            heard.lit = lit_;
            manner_.step(way, heard);
            wait();
        }
        return false;
    }
    /// Leaves the last words to be read.
    void stay(const Way& way) {
        const MonotonicTime end = devices_.now() + TableDevices::last_words;
        while (!devices_.told_to_stop() && devices_.now() < end && show(way, devices_.now())) {
            wait();
        }
    }
    void wait() {
        if (devices_.is_headless() && !manner_.with_camera) {
            devices_.pass_over(manner_.between_rounds);
        } else {
            std::this_thread::sleep_for(manner_.between_rounds);
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
                                              .house = devices_.house()}));
        }
        TRY(const MonotonicTime lit, devices_.present(now));
        if (!lit_ || lit_->number != words_.of) {
            lit_ = CalibrationInput::Lit{words_.of, lit};
        }
        return {};
    }

    TableDevices& devices_;
    Manner manner_;
    double above_m_, prop_px_, board_px_; ///< of the projector; on the table, about
    TableWords words_;                    ///< that are shown
    std::optional<CalibrationInput::Lit> lit_;
};

} // namespace frustumscreen
