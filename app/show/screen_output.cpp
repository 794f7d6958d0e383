#include "app/show/screen_output.h"

#include "app/render/probe.h"
#include "app/scene/flat_screen.h"
#include "app/show/room_show.h"
#include "firmware_host/base/format_sentence.h"
#include "firmware_host/base/standard_error.h"

#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace frustumscreen::show {

namespace {

constexpr Nanoseconds between_probes = std::chrono::seconds(1);
constexpr Nanoseconds watch_interval = std::chrono::seconds(3);
constexpr std::size_t window_frames = 1024; ///< for the status's frame times

/// The sentences of an output speak of a projector, which is the whole exhibit's light.
constexpr std::array<std::array<std::string_view, 2>, 7> screens_words{{
    {"display: ", ""},
    {"in the dark", "without it"},
    {"; the exhibit must be restarted", "; it is opened again while nobody uses the exhibit"},
    {" to use it", ""},
    {"; set display.mode and display.force", "; try another cable"},
    {"eye.stereo", "screen.stereo"},
    {"projector", "screen"},
}};

Sentence words_for_screen(std::string_view sentence) {
    std::string words(sentence);
    for (const auto& [of_projector, of_screen] : screens_words) {
        for (std::size_t at = words.find(of_projector); at != std::string::npos;
             at = words.find(of_projector, at + of_screen.size())) {
            words.replace(at, of_projector.size(), of_screen);
        }
    }
    return Sentence(words);
}

scene::StereoLayout layout_of(const settings::Settings& settings) {
    const settings::ScreenSettings& screen = settings.screen;
    return scene::stereo_layout(scene::flat_screen(screen.corners_m, screen.width, screen.height).pinhole,
                                settings::screen_stereo_of(settings));
}

/// Makes the screen's context current during its lifetime, and the projector's afterwards.
class ScreenNow {
public:
    ScreenNow(const display::Display& screen, const display::Display& projector)
        : projector_(projector), current_(screen.make_current()) {}
    ~ScreenNow() { static_cast<void>(projector_.make_current()); }
    ScreenNow(const ScreenNow&) = delete;
    ScreenNow& operator=(const ScreenNow&) = delete;
    [[nodiscard]] bool current() const { return current_; }

private:
    const display::Display& projector_;
    bool current_;
};

} // namespace

std::function<Result<DrawRoom>()> room_of(const settings::Settings& settings, bool live) {
    return [&settings, live]() -> Result<DrawRoom> {
        TRY(std::shared_ptr<RoomShow> room, RoomShow::create(settings, {.both_eyes = true, .live = live}));
        return [room = std::move(room), told = std::size_t{0}](const RoomFrame& frame) mutable {
            if (frame.before_ms) {
                room->record_time(*frame.before_ms);
            }
            room->set_light(frame.light);
            room->set_budget(frame.budget_us);
            room->set_taken(frame.taken);
            const render::DrawResult drawn =
                room->draw(frame.seconds, frame.eyes_m, frame.target, frame.redraw);
            for (; told < room->faults().size(); ++told) {
                say_line("frustumscreen", room->faults()[told]);
            }
            return drawn;
        };
    };
}

ScreenOutput::ScreenOutput(const settings::Settings& settings, ScreenParts parts,
                           const display::Display& projector, MonotonicTime start)
    : settings_(settings), parts_(std::move(parts)), projector_(projector), start_(start),
      layout_(layout_of(settings)), watch_(watch_interval, start), tried_(start), times_(window_frames) {
    open(start);
}

ScreenOutput::~ScreenOutput() {
    if (display_) {
        const ScreenNow drawing(*display_, projector_);
        draw_room_ = nullptr;
        display_.reset();
    }
}

void ScreenOutput::open(MonotonicTime now) {
    tried_ = now;
    Result<std::unique_ptr<display::Display>> display = parts_.make_display();
    if (!display) {
        static_cast<void>(projector_.make_current()); // an attempt may leave no context
        why_not_ = away(display.error());
        return;
    }
    display_ = std::move(*display);
    const ScreenNow drawing(*display_, projector_);
    Result<DrawRoom> room = parts_.make_room();
    if (!room) {
        room_failed_ = true;
        close(room.error());
        return;
    }
    draw_room_ = std::move(*room);
    presented_.reset();
    watch_ = service::WatchdogPolicy(watch_interval, now);
}

/// The context must be current.
void ScreenOutput::close(const Error& why) {
    why_not_ = away(why);
    draw_room_ = nullptr;
    stills_.reset();
    display_.reset();
    report_.code.reset();
    report_.shown_code.reset();
    health_ = service::Health::Well;
}

void ScreenOutput::step(const ScreenFrame& frame) {
    if (!display_) {
        if (!room_failed_ && frame.unused && !frame.asleep && frame.now - tried_ >= between_tries) {
            open(frame.now);
        }
        return;
    }
    const ScreenNow drawing(*display_, projector_);
    if (!drawing.current()) {
        close({ErrorKind::DeviceLost, "screen.no_context",
               "the graphics driver no longer draws for the screen"});
        return;
    }
    if (frame.asleep) {
        presented_.reset();
        watch_.asleep(frame.now);
        if (const Result<void> dark = display_->stay_dark(); !dark) {
            close(dark.error());
        }
    } else if (display_->takes_picture()) {
        draw(frame);
    } else {
        ++report_.held_up;
    }
    if (display_) {
        judge(frame.now);
    }
}

void ScreenOutput::draw(const ScreenFrame& frame) {
    const MonotonicTime begin = monotonic_now();
    const bool probe = !presented_ || frame.now - *presented_ >= between_probes;
    const render::RenderTarget target{display_->framebuffer(), display_->buffer_age()};
    const std::array<glm::dvec3, 2> both_m =
        tracking::eyes_of(frame.tracked_state, 1e-3 * settings_.eye.interocular_mm);
    const render::DrawResult drawn = draw_room_(
        {.seconds = to_seconds(frame.now - start_),
         .light = frame.light,
         .budget_us = frame.budget_us,
         .before_ms = std::exchange(before_ms_, std::nullopt),
         .taken = frame.taken,
         .eyes_m = scene::drawn_eyes(layout_, frame.tracked_state.eye_m, both_m),
         .target = target,
         .redraw = probe && frame.redraw == render::Redraw::Changes ? render::Redraw::Again : frame.redraw});
    if (!drawn.drawn) {
        return;
    }
    const auto code = static_cast<std::uint8_t>(report_.presented + 1);
    const bool coded = render::write_probe(target.framebuffer, code, drawn.lit);
    for (const PixelRectangle& part :
         {drawn.redrawn, PixelRectangle{.x = 0, .y = 0, .width = probe_pixels, .height = 1}}) {
        display_->changed(part);
    }
    if (const Result<MonotonicTime> shown = display_->present(frame.now); !shown) {
        close(shown.error());
        return;
    }
    presented_ = frame.now;
    ++report_.presented;
    report_.code = coded ? std::optional(code) : std::nullopt;
    watch_.presented(frame.now);
    if (!drawn.redrawn.empty()) {
        ++report_.drawn;
        before_ms_ = 1e3 * to_seconds(monotonic_now() - begin);
        times_.add(*before_ms_);
    }
    if (watch_.wants_code(frame.now)) {
        read_back(frame.now);
    }
}

/// Reads what the screen shows if the card can, otherwise what was drawn.
void ScreenOutput::read_back(MonotonicTime now) {
    std::array<std::byte, probe_bytes> corner{};
    std::optional<std::uint8_t> code;
    if (report_.code && display_->read_shown(corner)) {
        code = read_probe(corner);
    }
    if (report_.code && !code) {
        code = render::read_probe(display_->framebuffer());
    }
    report_.shown_code = code;
    watch_.read_back(now, {.covered = !report_.code, .code = code});
}

void ScreenOutput::judge(MonotonicTime now) {
    const std::optional<MonotonicTime> alive_until = display_->alive_until();
    health_ =
        watch_.health(now, alive_until ? std::span(&*alive_until, 1) : std::span<const MonotonicTime>());
}

void ScreenOutput::tell(RunStatus& status) {
    DeviceState state = why_not_;
    if (display_ && health_ != service::Health::Well) {
        state = {{DeviceHealth::Impaired, "screen.not_alive"},
                 format_sentence("the screen at {}: {}", settings_.screen.connector, sentence_of(health_))};
    } else if (display_) {
        state = {display_->condition(), Sentence(display_->state())};
    }
    status.screen = words_for_screen(state.sentence.view());
    status.devices.screen = status::DeviceReport(state.condition);
    report_.health = word_of(health_);
    report_.frame_ms = {times_.quantile(0.5), times_.quantile(0.95), times_.quantile(0.99)};
    status.screen_picture = report_;
}

void ScreenOutput::keep_stills(int count, std::optional<Nanoseconds> length) {
    if (display_ && count > 0) {
        stills_.emplace(count, length, start_, *display_);
    }
}

void ScreenOutput::take_still(MonotonicTime now, const tracking::TrackedState& shown, bool settled) {
    if (stills_ && presented_) {
        const ScreenNow drawing(*display_, projector_);
        stills_->take(now, shown, settled);
    }
}

std::vector<Still> ScreenOutput::finish_stills(MonotonicTime now, const tracking::TrackedState& shown) {
    if (!stills_) {
        return {};
    }
    if (stills_->lacks_all() && presented_) {
        const ScreenNow drawing(*display_, projector_);
        stills_->keep(now, shown);
    }
    return std::move(*stills_).finish();
}

} // namespace frustumscreen::show
