/// The procedure of a calibration by touch on the table.
///
/// Errors   the display stops.
/// Threads  the main one, with the display's context current.
#pragma once

#include "app/calibration/touch_procedure.h"
#include "app/programs/calibrate/table_devices.h"

#include <functional>
#include <optional>

namespace frustumscreen {

class TouchTable {
public:
    /// `devices` outlive it.
    TouchTable(const Settings& settings, TableDevices& devices);

    /// What comes of the touches, in stage Solve.
    using Judge = std::function<TouchJudgement(const Touches& touches)>;
    /// Until it has ended, whichever way; nothing: it was told to stop.
    [[nodiscard]] Result<std::optional<CalibrationStage>> run(TouchProcedure& procedure, const Judge& judge);
    /// Leaves the last words to be read.
    void stay(const TouchProcedure& procedure);

private:
    [[nodiscard]] Result<void> show(const TouchProcedure& procedure, MonotonicTime now);

    /// What the picture depends on.
    struct Shown {
        TouchTask task = TouchTask::Anew;
        CalibrationStage stage = CalibrationStage::Place;
        TouchWord word = TouchWord::None;
        std::size_t at = 0;
        [[nodiscard]] bool operator==(const Shown&) const = default;
    };

    TableDevices& devices_;
    double prop_px_;
    std::optional<Shown> shown_;
};

} // namespace frustumscreen
