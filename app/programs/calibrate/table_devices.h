/// The devices of a table during a calibration: projector, tracker, two buttons and a voice.
///
/// Errors   `open`: the settings have stereo, no tracker or no buttons, or a device or a typeface is missing.
///          `present`: the display stops. The state messages of tracker and buttons go to standard error, as
///          do the words on the table.
/// Threads  the main one, with the display's context current.
#pragma once

#include "app/calibration/procedure/procedure.h"
#include "app/image/image.h"
#include "app/pack/words_file.h"
#include "app/programs/calibrate/calibrate_request.h"
#include "app/programs/calibrate/table_voice.h"
#include "app/render/picture_upload.h"
#include "app/settings/settings.h"
#include "app/show/inputs.h"
#include "app/typography/text_image.h"
#include "firmware_host/display/display.h"
#include "firmware_host/service/service_manager.h"
#include "firmware_host/service/stop_signals.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::programs {

class TableDevices {
public:
    static constexpr Nanoseconds last_words = std::chrono::seconds(3); ///< time for reading the last words

    /// Opens the settings' devices except the camera; the tracker reports in its own frame. `instead`: the
    /// end of a sentence, what else the technician may do if the settings have no tracker or no buttons.
    [[nodiscard]] static Result<std::unique_ptr<TableDevices>>
    open(const CalibrateRequest& request, settings::Settings settings, std::string_view instead);
    /// `begun`: the time at which the inputs begin.
    TableDevices(const settings::Settings& settings, bool headless, MonotonicTime begun, show::Inputs inputs,
                 std::unique_ptr<display::Display> display, typography::Typesetter typesetter);

    [[nodiscard]] bool is_headless() const { return headless_; }
    /// The system's time plus the time that simulations were ahead of it; while time is simulated, it passes
    /// only by `advance`. It never goes back.
    [[nodiscard]] MonotonicTime now();
    void simulate_time(bool simulated);
    [[nodiscard]] bool is_time_simulated() const { return is_simulated_; }
    /// In the devices' time; needs time that is not simulated.
    [[nodiscard]] MonotonicTime from_system_time(MonotonicTime time) const { return time + ahead_; }
    void advance(Nanoseconds time) { now_ += time; }

    /// The input since the last call: the latest reports, and presses.
    [[nodiscard]] calibration::CalibrationInput hear(MonotonicTime now);
    /// True once the tracker has reported a head's sensor.
    [[nodiscard]] bool has_seen_head() const { return has_seen_head_; }
    /// Sets the picture that is presented from now on.
    void show(image::Image8 picture);
    /// Logs the words of the picture and speaks them; `key`: of the spoken text.
    void say(const std::vector<std::string>& words, std::string_view key);
    /// Reports a device's state, if it differs from `told`.
    static void tell(std::string_view state, std::string_view device, Sentence& told);
    /// Presents the picture if it is new or was last presented half a second ago; returns the time of the last presentation
    /// by the display's clock. Also runs the voice and the service manager's watchdog.
    [[nodiscard]] Result<MonotonicTime> present(MonotonicTime now);

    [[nodiscard]] bool told_to_stop() const { return stop_.received(); }
    [[nodiscard]] int width() const { return display_->width(); }
    [[nodiscard]] int height() const { return display_->height(); }
    [[nodiscard]] const typography::Typesetter& typesetter() const { return typesetter_; }
    /// None: silent, and in English only.
    [[nodiscard]] const pack::LanguageWords* own_words() const { return own_words_ ? &*own_words_ : nullptr; }

private:
    bool headless_;
    bool is_simulated_ = false;
    MonotonicTime now_;
    Nanoseconds ahead_{0}; ///< of the system's time
    service::StopSignals stop_;
    service::ServiceManager manager_;
    std::optional<MonotonicTime> fed_;
    show::Inputs inputs_;
    std::unique_ptr<display::Display> display_;
    typography::Typesetter typesetter_;
    render::PictureUpload upload_;
    std::optional<pack::LanguageWords> own_words_;
    std::optional<TableVoice> voice_;
    image::Image8 picture_;
    int uploads_left_ = 0;
    struct Presented {
        MonotonicTime at;
        MonotonicTime lit;
    };
    std::optional<Presented> presented_;
    std::vector<tracker::PoseSample> samples_;
    std::vector<panel::PanelEvent> events_;
    bool has_seen_head_ = false;
    Sentence tracker_state_, panel_state_;
};

} // namespace frustumscreen::programs
