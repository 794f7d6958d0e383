#include "app/show/run_report.h"

#include "firmware_host/base/device_thread.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/quantile.h"
#include "firmware_host/base/standard_error.h"
#include "firmware_host/base/this_boot.h"
#include "firmware_host/service/watchdog_policy.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <iterator>

namespace frustumscreen::show {

namespace {

/// Quotes a text for CSV if necessary.
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

} // namespace

std::string frames_csv(const std::vector<FrameRow>& rows) {
    std::string csv =
        "frame,t_us,ms,technique,estimated_error_mm,drawn,artifact,state,language,told,p95_error_mm\n";
    auto out = std::back_inserter(csv);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const FrameRow& row = rows[k];
        const auto error_mm = [&](double scene::ErrorEstimate::*figure) {
            return row.error ? fmt::format("{:.4f}", (*row.error).*figure) : std::string();
        };
        fmt::format_to(out, "{},{},{:.3f},{},{},{},{},{},{},{},{}\n", k, row.t_us, row.ms, row.technique,
                       error_mm(&scene::ErrorEstimate::mean_mm), row.drawn ? 1 : 0, csv_text(row.artifact),
                       row.state, csv_text(row.language), told_name(row.told),
                       error_mm(&scene::ErrorEstimate::p95_mm));
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
    status.written = {std::chrono::system_clock::now(), monotonic_now(), Sentence(boot_id())};
    status.resident_mib = resident_mib();
}

StatusFile::StatusFile(status::StatusPlaces places, std::function<void(const RunStatus&)> written)
    : places_(std::move(places)), written_(std::move(written)) {
    if (wanted()) {
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
    if (!wanted()) {
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
        pending_ = wanted();
    }
    changed_.notify_one();
}

status::SharedEnvironment StatusFile::environment() {
    const std::lock_guard lock(mutex_);
    return environment_;
}

void StatusFile::work() {
    begin_device_thread("status");
    bool complained = false;
    status::Environment environment;
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return pending_ || closing_; });
        if (!pending_) {
            return;
        }
        RunStatus status = latest_;
        if (hangs_) {
            status.health = service::word_of(service::Health::Hangs);
        }
        pending_ = false;
        lock.unlock();
        stamp(status);
        status::renew_environment(environment, places_, status::status_clock());
        status.environment = std::make_shared<const status::Environment>(environment);
        status.versions.system = environment.system;
        const Result<void> written = renew_file(places_.status_file, as_bytes(status::status_json(status)));
        if (!written && !complained) {
            say_line("frustumscreen", written.error().message);
            complained = true;
        }
        if (written_) {
            written_(status);
        }
        lock.lock();
        environment_ = std::move(status.environment);
    }
}

} // namespace frustumscreen::show
