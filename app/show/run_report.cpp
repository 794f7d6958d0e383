#include "app/show/run_report.h"

#include "app/pack/pack_file.h"
#include "firmware_host/base/device_thread.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/json.h"
#include "firmware_host/base/local_time.h"
#include "firmware_host/base/quantile.h"
#include "firmware_host/base/standard_error.h"
#include "firmware_host/base/this_boot.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iterator>

namespace frustumscreen {

namespace {

/// Empty: nothing.
std::string words_of(const CameraUses& uses) {
    std::vector<std::string_view> words;
    if (uses.tags) {
        words.emplace_back("the prop's tags");
    }
    if (uses.visitor) {
        words.emplace_back("the visitor's eye");
    }
    if (uses.drift) {
        words.emplace_back("the picture's place");
    }
    return fmt::format("{}", fmt::join(words, ", "));
}

/// Quotes a text for CSV where it must be.
std::string csv_text(std::string_view text) {
    if (text.find_first_of(",\"\n\r") == std::string_view::npos) {
        return std::string(text);
    }
    std::string quoted = "\"";
    for (const char c : text) {
        quoted += c == '"' ? "\"\"" : std::string(1, c);
    }
    return quoted + "\"";
}

std::string told_name(const ToldText& told) {
    switch (told.kind) {
    case ToldText::Kind::Description:
        return fmt::format("description.{}", told.number);
    case ToldText::Kind::Label:
        return fmt::format("label.{}", told.number);
    case ToldText::Kind::Words:
        return "words";
    case ToldText::Kind::Nothing:
        break;
    }
    return "";
}

double rounded(double value) {
    return std::round(value * 1000.0) / 1000.0;
}

/// Null where there is none. A finest level is off by less than a micrometre.
nlohmann::ordered_json json_of_mm(const std::optional<ErrorEstimate>& error, double ErrorEstimate::*figure) {
    return error ? nlohmann::ordered_json(std::round((*error).*figure * 1e4) / 1e4)
                 : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json json_of(std::optional<std::uint8_t> code) {
    return code ? nlohmann::ordered_json(*code) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json json_of(const PresentedPicture& picture) {
    const glm::dvec3& place = picture.table_from_prop.translation;
    const glm::dquat& turn = picture.table_from_prop.rotation;
    return {{"code", json_of(picture.code)},
            {"prop_m", {place.x, place.y, place.z}},
            {"prop_wxyz", {turn.w, turn.x, turn.y, turn.z}},
            {"eye_m", {picture.eye_m.x, picture.eye_m.y, picture.eye_m.z}},
            {"settled", picture.settled}};
}

nlohmann::ordered_json json_of(const TrackerCounts& counts) {
    return {{"connections", counts.connections},
            {"frames", counts.frames},
            {"lost", counts.lost},
            {"duplicated", counts.duplicated},
            {"reordered", counts.reordered},
            {"strange", counts.strange},
            {"unusable", counts.unusable},
            {"broken", counts.broken},
            {"clock_restarts", counts.clock_restarts},
            {"clock_drift_ppm", rounded(1e6 * counts.clock_drift)}};
}

/// In the order of TrialState.
constexpr std::array<std::string_view, 3> verdict_words{"trying", "good", "bad"};

nlohmann::ordered_json json_of(const SharedSetStatus& status, bool library_hangs) {
    if (!status) {
        return nullptr;
    }
    nlohmann::ordered_json packs = nlohmann::ordered_json::array();
    for (const InstalledPack& pack : status->packs) {
        packs.push_back(
            {{"file", pack.file}, {"id", pack.id}, {"title", pack.title}, {"serial", pack.serial}});
    }
    const SetVerdict& newest = status->newest;
    return {{"number", status->shown},
            {"packs", packs},
            {"newest",
             {{"number", newest.number},
              {"verdict", verdict_words.at(static_cast<std::size_t>(newest.state))},
              {"on_trial", status->on_trial},
              {"starts", newest.starts},
              {"reason", newest.reason}}},
            {"trouble", library_hangs ? std::string(library_hangs_sentence) : status->trouble}};
}

/// The importer's own report, as its file has it.
nlohmann::ordered_json json_of(const SharedImport& import) {
    return import ? nlohmann::ordered_json::parse(write_import_report(import->report), nullptr, false)
                  : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json json_of(const HoursStatus& hours) {
    return {{"state", hours.state},
            {"until", hours.until ? nlohmann::ordered_json(local_time_text(*hours.until))
                                  : nlohmann::ordered_json(nullptr)},
            {"why", hours.why.view()},
            {"clock", hours.clock.view()}};
}

} // namespace

PackLeftOut pack_left_out(const std::string& pack, std::string_view message) {
    const std::string place = pack + ": ";
    if (message.substr(0, place.size()) == place) {
        message.remove_prefix(place.size());
    }
    return {pack, std::string(message)};
}

std::string frames_csv(const std::vector<FrameRow>& rows) {
    std::string csv =
        "frame,t_us,ms,technique,estimated_error_mm,drawn,artifact,state,language,told,p95_error_mm\n";
    auto out = std::back_inserter(csv);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const FrameRow& row = rows[k];
        const auto error_mm = [&](double ErrorEstimate::*figure) {
            return row.error ? fmt::format("{:.4f}", (*row.error).*figure) : std::string();
        };
        fmt::format_to(out, "{},{},{:.3f},{},{},{},{},{},{},{},{}\n", k, row.t_us, row.ms, row.technique,
                       error_mm(&ErrorEstimate::mean_mm), row.drawn ? 1 : 0, csv_text(row.artifact),
                       row.state, csv_text(row.language), told_name(row.told),
                       error_mm(&ErrorEstimate::p95_mm));
    }
    return csv;
}

RecentFrameTimes::RecentFrameTimes(std::size_t window) : window_(window), sorted_(window) {}

void RecentFrameTimes::add(double ms) {
    window_[count_++ % window_.size()] = static_cast<float>(ms);
}

double RecentFrameTimes::quantile(double share) {
    const std::size_t count = std::min(count_, window_.size());
    std::copy_n(window_.begin(), count, sorted_.begin());
    return quantile_in(std::span(sorted_).first(count), share);
}

std::string status_json(const RunStatus& status) {
    nlohmann::ordered_json left_out = nlohmann::ordered_json::array();
    if (status.left_out) {
        for (const PackLeftOut& each : *status.left_out) {
            left_out.push_back({{"pack", each.pack}, {"reason", each.reason}});
        }
    }
    const nlohmann::ordered_json json = {
        {"written_at", utc_text(status.written_at)},
        {"monotonic_ns", status.written_at_monotonic.time_since_epoch().count()},
        {"boot_id", status.boot_id.view()},
        {"versions",
         {{"program", FRUSTUMSCREEN_VERSION},
          {"pack_format", pack_format_version},
          {"system", status.surroundings ? status.surroundings->system : std::string()}}},
        {"health", word_of(status.health)},
        {"presented", json_of(status.presented)},
        {"shown_code", json_of(status.shown_code)},
        {"mode", status.mode},
        {"settings", status.settings.view()},
        {"left_out", left_out},
        {"set", json_of(status.set, status.library_hangs)},
        {"state", status.state},
        {"asleep", status.hours.asleep},
        {"hours", json_of(status.hours)},
        {"artifact", status.artifact},
        {"shown_since", utc_text(status.shown_since)},
        {"shown_for_s", rounded(status.shown_for_s)},
        {"loaded", {{"artifacts", status.loaded}, {"bytes", status.loaded_bytes}}},
        {"technique", status.technique},
        {"level", status.level},
        {"samples", status.samples},
        {"language", status.language},
        {"estimated_error_mm", json_of_mm(status.error, &ErrorEstimate::mean_mm)},
        {"p95_error_mm", json_of_mm(status.error, &ErrorEstimate::p95_mm)},
        {"frame_ms",
         {{"p50", rounded(status.median_ms)},
          {"p95", rounded(status.p95_ms)},
          {"p99", rounded(status.p99_ms)}}},
        {"missed_deadlines", status.missed_deadlines},
        {"level_switches", status.level_switches},
        {"ignored_times", status.ignored_times},
        {"frames", status.frames},
        {"drawn", status.drawn},
        {"unchanged", status.unchanged},
        {"probes", status.probes},
        {"skipped", status.late},
        {"device_errors", status.bad_samples},
        {"display", status.display.view()},
        {"tracker", status.tracker.view()},
        {"tracker_hangs", status.tracker_hangs},
        {"tracker_counts", json_of(status.tracker_counts)},
        {"camera", status.camera.view()},
        {"camera_hz", rounded(status.camera_hz)},
        {"camera_for", words_of(status.camera_for)},
        {"drift", status.drift.view()},
        {"drift_mm", status.drift_m ? nlohmann::ordered_json(rounded(1e3 * *status.drift_m))
                                    : nlohmann::ordered_json(nullptr)},
        {"drifted", status.drifted},
        {"prop_by", status.prop_by},
        {"hand_overs", status.hand_overs},
        {"panel", status.panel.view()},
        {"sound", status.sound.view()},
        {"sound_underruns", status.sound_underruns},
        {"recording", status.recording.view()},
        {"import", json_of(status.import)},
        {"prop_known", status.prop_known},
        {"head_known", status.head_known},
        {"eye_by", status.eye_by},
        {"eye_sd_mm", status.eye_by == "camera" ? nlohmann::ordered_json(rounded(1e3 * status.eye_sd_m))
                                                : nlohmann::ordered_json()},
        {"uptime_s", rounded(status.uptime_s)},
        {"resident_mib", rounded(status.resident_mib)}};
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

double local_hour() {
    const std::tm local = fmt::localtime(std::time(nullptr));
    return local.tm_hour + local.tm_min / 60.0 + local.tm_sec / 3600.0;
}

double resident_mib() {
    std::ifstream statm("/proc/self/statm");
    std::uint64_t size = 0;
    std::uint64_t resident = 0;
    statm >> size >> resident;
    return static_cast<double>(resident) * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

void stamp(RunStatus& status) {
    status.written_at = std::chrono::system_clock::now();
    status.written_at_monotonic = monotonic_now();
    status.boot_id = Sentence(boot_id());
    status.resident_mib = resident_mib();
}

StatusFile::StatusFile(std::filesystem::path file, std::function<void(const RunStatus&)> written)
    : file_(std::move(file)), written_(std::move(written)) {
    if (!file_.empty()) {
        writer_ = std::jthread([this] { work(); });
    }
}

StatusFile::~StatusFile() {
    {
        const std::lock_guard lock(mutex_);
        closing_ = true;
    }
    changed_.notify_one();
}

void StatusFile::post(const RunStatus& status) {
    if (file_.empty()) {
        return;
    }
    {
        const std::lock_guard lock(mutex_);
        latest_ = status;
        pending_ = true;
    }
    changed_.notify_one();
}

void StatusFile::note_hang(bool hangs) {
    {
        const std::lock_guard lock(mutex_);
        hangs_ = hangs;
        pending_ = !file_.empty();
    }
    changed_.notify_one();
}

SharedSurroundings StatusFile::surroundings() {
    const std::lock_guard lock(mutex_);
    return surroundings_;
}

void StatusFile::work() {
    begin_device_thread("status");
    bool complained = false;
    Surroundings surroundings;
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return pending_ || closing_; });
        if (!pending_) {
            return;
        }
        RunStatus status = latest_;
        status.health = hangs_ ? Health::Hangs : status.health;
        pending_ = false;
        lock.unlock();
        stamp(status);
        renew_surroundings(surroundings, {.status_file = file_}, status_clock());
        status.surroundings = std::make_shared<const Surroundings>(surroundings);
        const Result<void> written = renew_file(file_, as_bytes(status_json(status)));
        if (!written && !complained) {
            say_line("frustumscreen", written.error().message);
            complained = true;
        }
        if (written_) {
            written_(status);
        }
        lock.lock();
        surroundings_ = std::move(status.surroundings);
    }
}

} // namespace frustumscreen
