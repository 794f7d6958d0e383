#include "app/show/run_watch.h"

#include "app/exhibit/states.h"
#include "app/render/probe.h"
#include "firmware_host/base/format_sentence.h"

#include <array>
#include <span>

namespace frustumscreen::show {

namespace {

/// The interval of the policy if the service manager has no watchdog.
constexpr Nanoseconds usual_interval = std::chrono::seconds(3);

Sentence what_is_shown(const RunStatus& status) {
    if (status.state == exhibit::name_of(exhibit::State::Fault)) {
        return Sentence("shows that there is no artifact");
    }
    if (status.state == exhibit::name_of(exhibit::State::Staff) || status.artifact.empty()) {
        return Sentence("shows the alignment pattern");
    }
    return format_sentence("shows {} ({}, {})", status.artifact, status.language, status.level);
}

} // namespace

void RunWatch::begin(MonotonicTime now, bool simulated_time, StatusFile& status_file) {
    if (simulated_time) {
        return;
    }
    if (const auto interval = manager_.watchdog_interval(); interval || status_file.wanted()) {
        watchdog_.emplace(interval.value_or(usual_interval), now);
    }
    hang_watch_.emplace(loop_timeout, [this, &status_file](std::optional<const char*> part) {
        const Sentence line =
            part
                ? format_sentence("watchdog: the picture hangs: the exhibit was silent for {} s, while it {}",
                                  loop_timeout / std::chrono::seconds(1), *part)
                : Sentence("watchdog: the exhibit responds again");
        journal_.note(part ? service::LogPriority::Error : service::LogPriority::Notice, line.view(),
                      {{"DEVICE", "watchdog"}});
        status_file.note_hang(part.has_value());
    });
}

void RunWatch::enters(const char* part) {
    if (hang_watch_) {
        hang_watch_->enters(part);
    }
}

void RunWatch::presented(MonotonicTime now, const display::Display& display, bool has_code) {
    if (!ready_ && display.settled()) {
        ready_ = true;
        manager_.ready();
    }
    if (!watchdog_) {
        return;
    }
    watchdog_->presented(now);
    if (watchdog_->wants_code(now)) {
        shown_code_ = has_code ? code_of(display) : std::nullopt;
        watchdog_->read_back(now, {!has_code, shown_code_});
    }
}

/// A driver that has never returned a code cannot read back what it shows; the exhibit does not end for that.
std::optional<std::uint8_t> RunWatch::code_of(const display::Display& display) {
    std::array<std::byte, probe_bytes> corner{};
    if (display.read_shown(corner)) {
        const std::optional<std::uint8_t> code = read_probe(corner);
        shown_is_readable_ = shown_is_readable_ || code;
        if (shown_is_readable_) {
            return code;
        }
    }
    return render::read_probe(display.framebuffer());
}

void RunWatch::look(MonotonicTime now, const display::Display& display, const Inputs& inputs) {
    if (!watchdog_) {
        return;
    }
    std::array<MonotonicTime, 4> promises{};
    std::size_t count = 0;
    const auto add = [&](const auto* device) {
        if (const std::optional<MonotonicTime> until =
                device != nullptr ? device->alive_until() : std::nullopt;
            until) {
            promises.at(count++) = *until;
        }
    };
    add(&display);
    add(inputs.tracker.get());
    add(inputs.panel.get());
    add(inputs.sound.get());
    const service::Health health = watchdog_->health(now, std::span(promises).first(count));
    note_health(health);
    if (watchdog_->feed(now, health)) {
        manager_.feed_watchdog();
    }
}

void RunWatch::note_health(service::Health health) {
    if (health == health_) {
        return;
    }
    health_ = health;
    const bool well = health == service::Health::Well;
    note_state(
        well ? service::LogPriority::Notice : service::LogPriority::Error, "watchdog",
        service::sentence_of(health),
        format_sentence("watchdog: {}: {}", well ? "fed again" : "not fed", service::sentence_of(health)));
}

void RunWatch::note(const RunStatus& status) {
    const Sentence shows = what_is_shown(status);
    const bool other = Sentence(status.artifact) != artifact_ || Sentence(status.language) != language_;
    artifact_ = Sentence(status.artifact);
    language_ = Sentence(status.language);
    level_ = Sentence(status.level);
    if (other) {
        note_state(service::LogPriority::Info, "exhibit", shows.view(), shows);
    }
    note_device("display", status.display, display_);
    note_device("screen", status.screen, screen_);
    note_device("tracker", status.tracker, tracker_);
    note_device("camera", status.camera, camera_);
    note_device("drift", status.drift, drift_);
    note_device("panel", status.panel, panel_);
    note_device("sound", status.sound, sound_);
    note_device("recording", status.recording, recording_);
    note_device("hours", status.hours.why, hours_);
    note_device("clock", status.hours.clock, clock_);
    if (status.visits && !status.visits->trouble.empty()) {
        note_device("visits", Sentence(status.visits->trouble), visits_);
    }
    if (status.set && status.set != noted_set_) { // the sentence is made only for a new status
        noted_set_ = status.set;
        note_device("set", Sentence(status::sentence_of(*status.set)), set_);
    }
    if (status.library_hangs != library_hung_) {
        library_hung_ = status.library_hangs;
        const std::string_view state =
            status.library_hangs ? status::library_hangs_sentence : "the library's disk answers again";
        note_state(status.library_hangs ? service::LogPriority::Warning : service::LogPriority::Notice, "set",
                   state, format_sentence("set: {}", state));
    }
    imports_.note(status.seen_import, [this](service::LogPriority priority, const Sentence& line) {
        note_state(priority, "stick", line.view(), line);
    });
    // Most important to a technician first, as a long line is cut.
    const auto comma = [](const Sentence& state) { return state.view().empty() ? "" : "; "; };
    manager_.status(format_sentence("{}{}{}{}{}{}{}{}{}{}{}", display_.view(), comma(display_),
                                    screen_.view(), comma(screen_), tracker_.view(), comma(tracker_),
                                    panel_.view(), comma(panel_), sound_.view(), comma(sound_),
                                    shows.view()));
}

void RunWatch::note_device(std::string_view device, const Sentence& state, Sentence& noted) {
    if (state != noted) {
        noted = state;
        note_state(service::LogPriority::Notice, device, state.view(),
                   format_sentence("{}: {}", device, state.view()));
    }
}

void RunWatch::note_state(service::LogPriority priority, std::string_view device, std::string_view state,
                          const Sentence& line) const {
    journal_.note(priority, line.view(),
                  {{"DEVICE", device},
                   {"STATE", state},
                   {"ARTIFACT", artifact_.view()},
                   {"LANGUAGE", language_.view()},
                   {"LEVEL", level_.view()}});
}

} // namespace frustumscreen::show
