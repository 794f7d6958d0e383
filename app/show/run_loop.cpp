#include "app/show/run_loop.h"

#include "app/render/probe.h"
#include "app/show/live_loop.h"
#include "app/show/screen_output.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

namespace frustumscreen::show {

namespace {

constexpr std::size_t window_frames = 8192; ///< for the status's frame times
constexpr std::size_t max_rows = 1U << 20U;
constexpr Nanoseconds between_statuses = std::chrono::seconds(1);
constexpr Nanoseconds between_probes = std::chrono::seconds(1);

/// The smallest light that still draws; 0 means asleep.
constexpr double min_light = 1e-6;

double milliseconds_since(MonotonicTime start) {
    return 1e3 * to_seconds(monotonic_now() - start);
}

} // namespace

LiveLoop::LiveLoop(const settings::Settings& settings, display::Display& display, Inputs& inputs, Show& show,
                   const LoopOptions& options, StatusFile& status_file, RunWatch& watch, MonotonicTime start)
    : display_(display), inputs_(inputs), show_(show), options_(options), status_file_(status_file),
      watch_(watch), hours_(options.fast || !show.sleeps() ? nullptr : options.hours), start_(start),
      period_(static_cast<Nanoseconds::rep>(std::llround(1e9 / settings.projector.refresh_hz))),
      light_delay_(Nanoseconds(std::llround(1e6 * settings.tracker.display_latency_ms))),
      intake_(settings, inputs), stills_(options.stills, options.length, start, display),
      times_(window_frames), presented_(start), artifact_since_(start) {
    visit_pieces_.reserve(max_visit_pieces);
    if (options.screen != nullptr) {
        options.screen->keep_stills(options.stills, options.length);
    }
    result_.status.calibrates = static_cast<bool>(options.calibrate);
    result_.status.copies = static_cast<bool>(options.copy);
    result_.status.camera_for = camera_uses(inputs);
    if (options.keep_rows && options.length) {
        rows_expected_ =
            std::min<std::size_t>(max_rows, static_cast<std::size_t>(*options.length / period_) + 2);
        result_.rows.reserve(rows_expected_);
    }
}

Result<LoopResult> LiveLoop::run() {
    MonotonicTime now = start_;
    watch_.begin(start_, options_.fast, status_file_);
    MonotonicTime next_status = start_ + between_statuses;
    while (!(options_.length && now - start_ >= *options_.length) && !told_to_stop()) {
        TRY_VOID(frame(now));
        if (fault_since_ && now - *fault_since_ >= longest_fault) {
            return fail(ErrorKind::BadConfiguration, "show.no_artifact_left",
                        "no artifact can be shown any more; the lines before this "
                        "one say why, and a restart looks for packs again");
        }
        if (now >= next_status) {
            post_status(now);
            next_status += between_statuses;
        }
        now = next_display_time(now);
    }
    if (options_.visits != nullptr) {
        visit_counter_.end(now, visit_pieces_);
        options_.visits->post_last(visit_pieces_);
    }
    post_status(now);
    if (stills_.lacks_all() && result_.status.frames > 0 && !shows_camera_) {
        stills_.keep(now, shown_); // a short run leaves its last picture
    }
    result_.stills = std::move(stills_).finish();
    if (options_.screen != nullptr) {
        result_.screen_stills = options_.screen->finish_stills(now, shown_);
    }
    return std::move(result_);
}

Result<void> LiveLoop::frame(MonotonicTime now) {
    const MonotonicTime begin = monotonic_now();
    watch_.enters("asks its devices");
    intake_.poll(now);
    follow_hours(now);
    follow_viewfinder(now);
    watch_.enters("draws");
    const tracking::TrackedState tracked_state = intake_.tracked_state_at(now + light_delay_.from_now());
    show_.set_mark(mark(now));
    if (staff_) {
        show_.set_signal(intake_.prop_signal().at(now), intake_.head_signal().at(now));
    }
    const std::vector<settings::Command>& commands = intake_.commands();
    show_.step(now, commands, tracked_state);
    if (inputs_.sound) {
        const sound::SoundReport heard = inputs_.sound->poll(now, show_.sound_request());
        show_.hear(heard);
        result_.status.sound_underruns = heard.underruns;
    }
    if (std::find(commands.begin(), commands.end(), settings::Command::StaffMode) != commands.end()) {
        renew_status(now);
        show_.tell(result_.status);
    }
    if (asleep_) {
        return sleep(now, tracked_state, begin);
    }
    TRY(const Drawn drawn, draw(now, tracked_state));
    const double ms = milliseconds_since(begin);
    watch_.enters("reports its status");
    if (drawn.presented) {
        watch_.presented(now, display_, drawn.coded);
    }
    watch_.look(now, display_, inputs_);
    count(drawn.presented, drawn.changed, now, ms);
    step_screen(now, tracked_state, begin);
    torches_ = tracked_state.torches;
    result_.status.prop_known = tracked_state.prop_known;
    result_.status.head_known = tracked_state.head_known;
    const ShowState state = show_.state();
    follow_state(now, state);
    if (result_.rows.size() < rows_expected_) {
        result_.rows.push_back({.t_us = to_microseconds(MonotonicTime(now - start_)),
                                .ms = static_cast<float>(ms),
                                .error = state.levels.error,
                                .drawn = drawn.changed,
                                .artifact = state.artifact,
                                .technique = state.levels.level,
                                .state = exhibit::name_of(state.state),
                                .language = state.language,
                                .told = state.told});
    }
    shown_ = tracked_state;
    shown_.table_from_prop = state.stands.value_or(tracked_state.table_from_prop);
    if (options_.screenshot != nullptr && !shows_camera_) { // a screenshot may become a file
        watch_.enters("reads its picture back for the staff");
        options_.screenshot->serve(display_);
    }
    watch_.enters("rests until the next display time");
    if (!shows_camera_) {
        stills_.take(now, shown_, state.settled);
    }
    if (options_.screen != nullptr) {
        options_.screen->take_still(now, shown_, state.settled);
    }
    return {};
}

void LiveLoop::step_screen(MonotonicTime now, const tracking::TrackedState& tracked_state,
                           MonotonicTime begin) {
    if (options_.screen != nullptr) {
        watch_.enters("draws the screen");
        options_.screen->step({.now = now,
                               .tracked_state = tracked_state,
                               .light = hours_ != nullptr ? hours_->light() : 1.0,
                               .asleep = asleep_,
                               .unused = attracts_,
                               .budget_us = options_.fast
                                                ? std::numeric_limits<double>::infinity()
                                                : 1e6 * to_seconds(period_) - 1e3 * milliseconds_since(begin),
                               .taken = show_.taken(),
                               .redraw = options_.redraw});
    }
}

Result<LiveLoop::Drawn> LiveLoop::draw(MonotonicTime now, const tracking::TrackedState& tracked_state) {
    const render::RenderTarget target{display_.framebuffer(), display_.buffer_age()};
    const bool probe =
        options_.redraw == render::Redraw::Changes && (now - presented_ >= between_probes || !watch_.ready());
    const render::DrawResult drawn =
        show_.draw(now, tracked_state, target, probe ? render::Redraw::Again : options_.redraw);
    if (!drawn.drawn) {
        return Drawn{};
    }
    const bool coded = render::write_probe(target.framebuffer, ++probe_code_, drawn.lit);
    for (const PixelRectangle& part :
         {drawn.redrawn, PixelRectangle{.x = 0, .y = 0, .width = probe_pixels, .height = 1}}) {
        display_.changed(part);
    }
    watch_.enters("waits for the display");
    TRY(const MonotonicTime shown, display_.present(now));
    light_delay_.flipped(now, shown);
    presented_ = now;
    result_.status.presented.code = coded ? std::optional(probe_code_) : std::nullopt;
    return Drawn{.presented = true, .changed = !drawn.redrawn.empty(), .coded = coded};
}

void LiveLoop::follow_state(MonotonicTime now, const ShowState& state) {
    count_visits(now, state);
    used_ = state.used;
    attracts_ = state.state == exhibit::State::Attract;
    staff_ = state.state == exhibit::State::Staff;
    if (state.calibrate && options_.calibrate) {
        options_.calibrate();
    }
    if (state.reset && options_.reset) {
        options_.reset();
    }
    if (state.copy && options_.copy) {
        options_.copy();
    }
    fault_since_ = state.state != exhibit::State::Fault ? std::nullopt : fault_since_ ? fault_since_ : now;
    if (const Sentence artifact(shown_artifact(state)); artifact != artifact_) {
        artifact_ = artifact;
        artifact_since_ = now;
    }
    if (inputs_.panel) {
        inputs_.panel->light(state.lamps);
    }
    result_.status.presented.settled = state.settled;
}

std::optional<drift::ShownMark> LiveLoop::mark(MonotonicTime now) {
    if (!inputs_.drift) {
        return std::nullopt;
    }
    const bool is_seen =
        !inputs_.camera || camera::health_of(inputs_.camera->state()) == camera::CameraHealth::Well;
    return inputs_.drift->step(now, attracts_ && !asleep_ && intake_.commands().empty() && is_seen);
}

void LiveLoop::follow_viewfinder(MonotonicTime now) {
    if (!inputs_.viewfinder) {
        return;
    }
    shows_camera_ = staff_ && !asleep_ && inputs_.panel && inputs_.panel->chord_held(now);
    const bool sees = !inputs_.camera || camera::shows_something(inputs_.camera->state());
    inputs_.viewfinder->want(shows_camera_ && sees);
    show_.set_viewfinder(shows_camera_ ? inputs_.viewfinder.get() : nullptr);
}

void LiveLoop::follow_hours(MonotonicTime now) {
    if (hours_ == nullptr) {
        return;
    }
    const bool was_dark = hours_->asleep();
    hours_->step(now, {.wall = std::chrono::system_clock::now(),
                       .pressed = !intake_.commands().empty(),
                       .used = used_,
                       .may_sleep = watch_.ready() && !staff_}); // staff on a ladder are not left in the dark
    if (was_dark) {
        intake_.drop_commands();
    }
    asleep_ = was_dark && hours_->asleep(); // the last picture before sleep is drawn, and is black
    show_.set_light(asleep_ ? 0.0 : std::max(hours_->light(), min_light));
}

Result<void> LiveLoop::sleep(MonotonicTime now, const tracking::TrackedState& tracked_state,
                             MonotonicTime begin) {
    watch_.enters("waits for the display");
    TRY_VOID(display_.stay_dark());
    count_visits(now, show_.state());
    presented_ = now - between_probes; // so that the first picture after sleep is presented
    fault_since_
        .reset(); // a fault is not visible in the dark, and a restart of the exhibit would light the projector
    watch_.enters("reports its status");
    watch_.asleep(now);
    watch_.look(now, display_, inputs_);
    count(false, false, now, milliseconds_since(begin));
    step_screen(now, tracked_state, begin);
    result_.status.prop_known = tracked_state.prop_known;
    result_.status.head_known = tracked_state.head_known;
    if (inputs_.panel) {
        inputs_.panel->light(0);
    }
    watch_.enters("rests until the next display time");
    return {};
}

bool LiveLoop::told_to_stop() const {
    return (options_.stop != nullptr && options_.stop->received()) || (options_.ends && options_.ends());
}

MonotonicTime LiveLoop::next_display_time(MonotonicTime now) {
    if (options_.fast) {
        return now + period_;
    }
    MonotonicTime next = display_.next_frame(now, period_);
    const MonotonicTime clock = monotonic_now();
    if (clock > next) {
        const auto missed = (clock - next) / period_;
        result_.status.skipped += static_cast<std::uint64_t>(missed);
        next += missed * period_;
    }
    std::this_thread::sleep_until(next);
    return next;
}

Result<LoopResult> run_loop(const settings::Settings& settings, display::Display& display, Inputs& inputs,
                            Show& show, const LoopOptions& options, StatusFile& status_file, RunWatch& watch,
                            MonotonicTime start) {
    Result<LoopResult> result =
        LiveLoop(settings, display, inputs, show, options, status_file, watch, start).run();
    watch.end();
    return result;
}

} // namespace frustumscreen::show
