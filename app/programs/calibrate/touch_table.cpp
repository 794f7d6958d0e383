#include "app/programs/calibrate/touch_table.h"

#include "app/programs/calibrate/touch_picture.h"
#include "app/programs/devices/wiring.h"
#include "app/show/house_words.h"
#include "firmware_host/base/standard_error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <thread>
#include <utility>

namespace frustumscreen {

namespace {

constexpr int back_button = 0;
constexpr int next_button = 1;
constexpr Nanoseconds between_frames = std::chrono::milliseconds(20);
constexpr Nanoseconds between_feeds = std::chrono::seconds(1);
constexpr Nanoseconds last_words = std::chrono::seconds(3);
constexpr int most_buffers = 4; // of a display: each gets the picture once

/// A calibration goes on without them, in English.
std::optional<LanguageWords> house_words(const Settings& settings) {
    if (settings.exhibit.words.empty()) {
        return std::nullopt;
    }
    Result<LanguageWords> words = read_house_words(settings, "calibration.lay");
    if (!words) {
        say_line("frustumscreen-calibrate", words.error().message);
        return std::nullopt;
    }
    return *std::move(words);
}

std::optional<TableVoice> voice_of(const Settings& settings, const std::optional<LanguageWords>& words) {
    if (!words || settings.sound.kind == SoundKind::None) {
        return std::nullopt;
    }
    return TableVoice(*words, make_sound(settings.sound), settings.sound.gain_db);
}

void tell(std::string_view state, std::string_view device, Sentence& told) {
    if (const Sentence now(state); now != told) {
        told = now;
        say_line("frustumscreen-calibrate", fmt::format("{}: {}", device, state));
    }
}

bool has_ended(TouchStage stage) {
    return stage == TouchStage::Done || stage == TouchStage::Anew || stage == TouchStage::Left;
}

} // namespace

TouchTable::TouchTable(const Settings& settings, Inputs inputs, std::unique_ptr<Display> display,
                       Typesetter typesetter)
    : inputs_(std::move(inputs)), display_(std::move(display)), typesetter_(std::move(typesetter)),
      upload_(display_->width(), display_->height()), house_(house_words(settings)),
      voice_(voice_of(settings, house_)), prop_px_(settings.prop.base_m * settings.projector.pinhole.fx /
                                                   settings.projector.table_from_projector.translation.z) {}

Result<std::optional<TouchStage>> TouchTable::run(TouchProcedure& procedure, const Judge& judge) {
    while (!stop_.received()) {
        const MonotonicTime now = monotonic_now();
        if (Result<void> shown = show(procedure, now); !shown) {
            return tl::unexpected<Error>(shown.error());
        }
        if (has_ended(procedure.stage())) {
            return std::optional(procedure.stage());
        }
        if (procedure.stage() == TouchStage::Solve) {
            procedure.judge(judge(procedure.touches()));
        }
        poll(procedure, now);
        std::this_thread::sleep_for(between_frames);
    }
    return std::optional<TouchStage>();
}

void TouchTable::stay(const TouchProcedure& procedure) {
    const MonotonicTime end = monotonic_now() + last_words;
    while (!stop_.received() && monotonic_now() < end && show(procedure, monotonic_now())) {
        std::this_thread::sleep_for(between_frames);
    }
}

void TouchTable::poll(TouchProcedure& procedure, MonotonicTime now) {
    TouchProcedure::Input input{now, std::nullopt, false, false};
    samples_.clear();
    static_cast<void>(inputs_.tracker->poll(now, samples_)); // its state says what is wrong
    for (const PoseSample& sample : samples_) {
        if (sample.station == prop_station && sample.ok) {
            input.report = RigidTransform{sample.rotation, sample.position_m};
        }
    }
    events_.clear();
    static_cast<void>(inputs_.panel->poll(now, events_));
    for (const PanelEvent& event : events_) {
        input.next |= event.kind == PressKind::Press && event.button == next_button;
        input.back |= event.kind == PressKind::Press && event.button == back_button;
    }
    procedure.step(input);
    tell(inputs_.tracker->state(), "tracker", tracker_state_);
    tell(inputs_.panel->state(), "panel", panel_state_);
}

Result<void> TouchTable::show(const TouchProcedure& procedure, MonotonicTime now) {
    const Shown next{procedure.task(), procedure.stage(), procedure.word(), procedure.at()};
    if (next != shown_) {
        shown_ = next;
        uploads_left_ = most_buffers;
        say_line("frustumscreen-calibrate", fmt::format("{}", fmt::join(touch_words(procedure), " ")));
        picture_ = touch_picture(procedure, display_->width(), display_->height(), prop_px_, typesetter_,
                                 house_ ? &*house_ : nullptr);
        if (voice_) {
            voice_->say(word_key(procedure));
        }
    }
    if (uploads_left_ > 0 || display_->buffer_age() == 0) {
        uploads_left_ = std::max(uploads_left_ - 1, 0);
        upload_.show(picture_, display_->framebuffer());
    }
    if (voice_) {
        voice_->poll(now);
    }
    const Result<MonotonicTime> lit = display_->present(now);
    if (!lit) {
        return tl::unexpected<Error>(lit.error());
    }
    if (!fed_) {
        manager_.ready();
    }
    if (!fed_ || now - *fed_ >= between_feeds) {
        manager_.feed_watchdog();
        fed_ = now;
    }
    return {};
}

} // namespace frustumscreen
