/// LiveLoop: counts and the status.
#include "app/show/live_loop.h"
#include "app/show/screen_output.h"
#include "app/show/torch_show.h"

#include <optional>

namespace frustumscreen::show {

namespace {

status::VisitsReport report_of(const counts::CountedVisits& visits) {
    return {.today = visits.today.visits,
            .since_start = visits.since_start.visits,
            .today_s = 1e-3 * static_cast<double>(visits.today.ms),
            .since_start_s = 1e-3 * static_cast<double>(visits.since_start.ms),
            .trouble = visits.trouble};
}

} // namespace

std::string_view shown_artifact(const ShowState& state) {
    return state.state != exhibit::State::Fault ? state.artifact : std::string_view{};
}

void LiveLoop::count_visits(MonotonicTime now, const ShowState& state) {
    if (options_.visits == nullptr) {
        return;
    }
    if (visit_pieces_.size() < max_visit_pieces / 2) {
        visit_counter_.step({.now = now,
                             .used = state.used,
                             .rests = asleep_ || state.state == exhibit::State::Attract,
                             .staff = state.state == exhibit::State::Staff,
                             .artifact = shown_artifact(state),
                             .language = state.language},
                            visit_pieces_);
    }
    options_.visits->post(visit_pieces_);
}

void LiveLoop::count(bool presented, bool changed, MonotonicTime now, double ms) {
    RunStatus& status = result_.status;
    ++status.frames;
    status.probes += presented && !changed ? 1 : 0;
    ++(changed ? status.drawn : status.unchanged);
    if (changed && status.frames > 1) { // the first one compiles shaders
        times_.add(ms);
        status.missed_deadlines += ms > 1e3 * to_seconds(period_) ? 1 : 0;
        show_.record_time(now, ms);
    }
}

void LiveLoop::post_status(MonotonicTime now) {
    renew_status(now);
    if (result_.first_resident_mib == 0.0 && options_.length && now - start_ >= *options_.length / 10) {
        result_.first_resident_mib = resident_mib();
    }
    watch_.note(result_.status);
    show_.tell(result_.status);
    status_file_.post(result_.status);
}

void LiveLoop::renew_status(MonotonicTime now) {
    RunStatus& status = result_.status;
    const ShowState state = show_.state();
    status.left_out = state.left_out;
    status.set = state.set;
    status.library_hangs = state.library_hangs;
    status.hours = hours_ != nullptr ? hours_->status() : status::HoursStatus{};
    status.state = status.hours.asleep ? exhibit::asleep_name : exhibit::name_of(state.state);
    status.artifact = shown_artifact(state);
    status.shown_for_s = to_seconds(now - artifact_since_);
    status.shown_since =
        std::chrono::system_clock::now() -
        std::chrono::duration_cast<std::chrono::system_clock::duration>(now - artifact_since_);
    status.environment = status_file_.environment();
    if (status.environment) {
        status.versions.system = status.environment->system;
    }
    status.loaded = state.loaded;
    status.loaded_bytes = state.loaded_bytes;
    status.seen_import = state.import;
    status.import = report_of(state.import);
    status.torch = state.torch ? std::optional(torch_report(*state.torch, torches_)) : std::nullopt;
    status.language = state.language;
    status.louder_db = state.louder_db;
    status.technique = state.levels.technique;
    status.level = state.levels.level;
    status.samples = state.levels.samples;
    const std::optional<scene::ErrorEstimate>& error = state.levels.error;
    status.estimated_error_mm = error ? std::optional(error->mean_mm) : std::nullopt;
    status.p95_error_mm = error ? std::optional(error->p95_mm) : std::nullopt;
    status.level_switches = state.levels.switches;
    status.ignored_times = state.levels.ignored_times;
    status.frame_ms = {times_.quantile(0.5), times_.quantile(0.95), times_.quantile(0.99)};
    status.uptime_s = to_seconds(now - start_);
    const auto& [turn, place] = shown_.table_from_prop;
    status.presented.prop_m = {place.x, place.y, place.z};
    status.presented.prop_wxyz = {turn.w, turn.x, turn.y, turn.z};
    status.presented.eye_m = {shown_.eye_m.x, shown_.eye_m.y, shown_.eye_m.z};
    status.shown_code = watch_.shown_code();
    status.health = service::word_of(watch_.health());
    status.display = Sentence(display_.state());
    status.devices.display = status::DeviceReport(display_.condition());
    if (options_.screen != nullptr) {
        options_.screen->tell(status);
    }
    status.mode = options_.mode;
    status.settings = options_.settings;
    status.hour_of_day = local_hour();
    if (options_.visits != nullptr) {
        options_.visits->read(visits_);
        status.visits = report_of(visits_);
    }
    intake_.tell(shown_, status);
}

} // namespace frustumscreen::show
