/// The table during a calibration by touch: projector, tracker, two buttons and a voice, and the procedure that goes on with them.
///
/// Errors   the display stops. What tracker and buttons say of themselves goes to standard error, as does what the table says.
/// Threads  the main one, with the display's context current.
#pragma once

#include "app/calibration/touch_procedure.h"
#include "app/exhibit/text_image.h"
#include "app/pack/words_file.h"
#include "app/programs/calibrate/table_voice.h"
#include "app/render/picture_upload.h"
#include "app/settings/settings.h"
#include "app/show/inputs.h"
#include "firmware_host/display/display.h"
#include "firmware_host/service/service_manager.h"
#include "firmware_host/service/stop_signals.h"

#include <functional>
#include <memory>
#include <optional>

namespace frustumscreen {

class TouchTable {
public:
    /// The tracker reports in its own frame.
    TouchTable(const Settings& settings, Inputs inputs, std::unique_ptr<Display> display,
               Typesetter typesetter);

    /// What comes of the touches, in stage Solve.
    using Judge = std::function<TouchJudgement(const Touches& touches)>;
    /// Until it has ended, whichever way; nothing: it was told to stop.
    [[nodiscard]] Result<std::optional<TouchStage>> run(TouchProcedure& procedure, const Judge& judge);
    /// Leaves the last words to be read.
    void stay(const TouchProcedure& procedure);

private:
    void poll(TouchProcedure& procedure, MonotonicTime now);
    [[nodiscard]] Result<void> show(const TouchProcedure& procedure, MonotonicTime now);

    /// What the picture depends on.
    struct Shown {
        TouchTask task = TouchTask::Anew;
        TouchStage stage = TouchStage::Lay;
        TouchWord word = TouchWord::None;
        std::size_t at = 0;
        [[nodiscard]] bool operator==(const Shown&) const = default;
    };

    StopSignals stop_;
    ServiceManager manager_;
    std::optional<MonotonicTime> fed_;
    Inputs inputs_;
    std::unique_ptr<Display> display_;
    Typesetter typesetter_;
    PictureUpload upload_;
    std::optional<LanguageWords> house_; ///< none: it is silent, and in English alone
    std::optional<TableVoice> voice_;
    double prop_px_;
    Image8 picture_;
    std::optional<Shown> shown_;
    int uploads_left_ = 0;
    std::vector<PoseSample> samples_;
    std::vector<PanelEvent> events_;
    Sentence tracker_state_, panel_state_;
};

} // namespace frustumscreen
