#include "app/programs/calibrate/table_devices.h"

#include "app/programs/devices/wiring.h"
#include "app/scene/device_plan.h"
#include "app/show/default_words.h"
#include "firmware_host/base/standard_error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace frustumscreen::programs {

namespace {

constexpr const char* program = "frustumscreen-calibrate";
constexpr int back_button = 0;
constexpr int next_button = 1;
constexpr Nanoseconds between_feeds = std::chrono::seconds(1);
constexpr int max_buffers = 4; // of a display: each buffer gets the picture once
/// While nothing changes. Each presentation copies the whole picture, and tells whether the display still works.
constexpr Nanoseconds between_repeats = std::chrono::milliseconds(500);

/// The house's words. Without them a calibration goes on in English.
std::optional<pack::LanguageWords> load_default_words(const settings::Settings& settings) {
    if (settings.exhibit.words.empty()) {
        return std::nullopt;
    }
    Result<pack::LanguageWords> words = show::read_default_words(settings, "calibration.begin");
    if (!words) {
        say_line(program, words.error().message);
        return std::nullopt;
    }
    return *std::move(words);
}

std::optional<TableVoice> voice_of(const settings::Settings& settings,
                                   const std::optional<pack::LanguageWords>& words) {
    if (!words || settings.sound.kind == settings::SoundKind::None) {
        return std::nullopt;
    }
    return TableVoice(*words, make_sound(settings.sound), settings.sound.gain_db);
}

} // namespace

Result<std::unique_ptr<TableDevices>>
TableDevices::open(const CalibrateRequest& request, settings::Settings settings, std::string_view instead) {
    TRY_VOID(check_own_pixels(settings, request.config));
    settings.tracker.registration = {}; // reports in the device's own frame
    settings.camera = {};
    const scene::DevicePlan plan = scene::plan_devices(settings, false, false);
    if (plan.tracker == settings::TrackerKind::None || !plan.panel) {
        return fail(ErrorKind::BadConfiguration, "calibrate.no_devices",
                    "{}: a calibration on the table needs a tracker and two buttons; set "
                    "tracker.kind and panel.kind{}",
                    request.config.string(), instead);
    }
    TRY(std::unique_ptr<display::Display> display, make_display(settings, request.headless));
    TRY(typography::Typesetter typesetter, typography::Typesetter::open());
    const MonotonicTime begun = monotonic_now();
    TRY(show::Inputs inputs, make_inputs(settings, plan, std::nullopt, begun));
    return std::make_unique<TableDevices>(settings, request.headless, begun, std::move(inputs),
                                          std::move(display), std::move(typesetter));
}

TableDevices::TableDevices(const settings::Settings& settings, bool headless, MonotonicTime begun,
                           show::Inputs inputs, std::unique_ptr<display::Display> display,
                           typography::Typesetter typesetter)
    : headless_(headless), now_(begun), inputs_(std::move(inputs)), display_(std::move(display)),
      typesetter_(std::move(typesetter)), upload_(display_->width(), display_->height()),
      own_words_(load_default_words(settings)), voice_(voice_of(settings, own_words_)) {}

MonotonicTime TableDevices::now() {
    if (!is_simulated_) {
        now_ = monotonic_now() + ahead_;
    }
    return now_;
}

void TableDevices::simulate_time(bool simulated) {
    if (is_simulated_ && !simulated) {
        ahead_ = now_ - monotonic_now();
    }
    is_simulated_ = simulated;
}

calibration::CalibrationInput TableDevices::hear(MonotonicTime now) {
    calibration::CalibrationInput heard;
    heard.now = now;
    samples_.clear();
    static_cast<void>(inputs_.tracker->poll(now, samples_)); // its state names the fault
    for (const tracker::PoseSample& sample : samples_) {
        std::optional<geometry::RigidTransform>* const of =
            sample.station == tracker::prop_station   ? &heard.prop
            : sample.station == tracker::head_station ? &heard.head
                                                      : nullptr;
        if (of != nullptr && sample.ok) {
            *of = geometry::RigidTransform{sample.rotation, sample.position_m};
        }
    }
    has_seen_head_ |= heard.head.has_value();
    events_.clear();
    static_cast<void>(inputs_.panel->poll(now, events_));
    for (const panel::PanelEvent& event : events_) {
        heard.next |= event.kind == panel::PressKind::Press && event.button == next_button;
        heard.back |= event.kind == panel::PressKind::Press && event.button == back_button;
    }
    tell(inputs_.tracker->state(), "tracker", tracker_state_);
    tell(inputs_.panel->state(), "panel", panel_state_);
    return heard;
}

void TableDevices::show(image::Image8 picture) {
    picture_ = std::move(picture);
    uploads_left_ = max_buffers;
}

void TableDevices::say(const std::vector<std::string>& words, std::string_view key) {
    say_line(program, fmt::format("{}", fmt::join(words, " ")));
    if (voice_) {
        voice_->say(key);
    }
}

void TableDevices::tell(std::string_view state, std::string_view device, Sentence& told) {
    if (const Sentence now(state); now != told) {
        told = now;
        say_line(program, fmt::format("{}: {}", device, state));
    }
}

Result<MonotonicTime> TableDevices::present(MonotonicTime now) {
    if (voice_) {
        voice_->poll(now);
    }
    const bool changed = uploads_left_ > 0 || display_->buffer_age() == 0;
    if (!changed && presented_ && now - presented_->at < between_repeats) {
        return presented_->lit;
    }
    if (changed) {
        uploads_left_ = std::max(uploads_left_ - 1, 0);
        upload_.show(picture_, display_->framebuffer());
    }
    TRY(const MonotonicTime lit, display_->present(now));
    presented_ = Presented{now, lit};
    if (!fed_) {
        manager_.ready();
    }
    if (!fed_ || now - *fed_ >= between_feeds) {
        manager_.feed_watchdog();
        fed_ = now;
    }
    return lit;
}

} // namespace frustumscreen::programs
