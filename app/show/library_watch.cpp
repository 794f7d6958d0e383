#include "app/show/library_watch.h"

#include "firmware_host/base/device_thread.h"
#include "firmware_host/base/standard_error.h"

#include <fmt/format.h>

#include <utility>

namespace frustumscreen::show {

namespace {

/// A disk that is busy with a stick's packs is slow.
constexpr Nanoseconds look_timeout = std::chrono::seconds(30);
/// Longest time for one pack, or for all small pictures of a set.
constexpr Nanoseconds pack_timeout = std::chrono::minutes(5);

} // namespace

LibraryWatch::LibraryWatch(const settings::Settings& settings, SetUp set_up)
    : settings_(settings), set_up_(std::move(set_up)), trial_(std::move(set_up_.start.trial)),
      offered_(set_up_.shown), on_show_(set_up_.shown), heartbeat_(monotonic_now() + look_timeout) {
    if (trial_) {
        verdict_trouble_ = set_up_.start.trouble;
        kept_ = trial_->verdict();
        keep_again_ = monotonic_now() + set_up_.between_tries;
        if (trial_->target().number == offered_) {
            offered_set_ = shown_set_ = trial_->target();
        } else {
            failed_ = trial_->target().number; // the exhibit could not begin with it
        }
    }
    thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

LibraryWatch::~LibraryWatch() {
    thread_.request_stop();
    thread_.join();
    delete coming_.load();
    delete gone_.load();
}

std::unique_ptr<ShownSet> LibraryWatch::take() {
    return std::unique_ptr<ShownSet>(coming_.exchange(nullptr));
}

bool LibraryWatch::give_back(std::unique_ptr<ShownSet>& set) {
    ShownSet* none = nullptr;
    if (!gone_.compare_exchange_strong(none, set.get())) {
        return false;
    }
    static_cast<void>(set.release());
    return true;
}

void LibraryWatch::work(const std::stop_token& stop) {
    begin_device_thread("library", ThreadPriority::Low);
    while (!stop.stop_requested()) {
        heartbeat_.promise(monotonic_now() + look_timeout);
        take_what_comes();
        look();
        keep();
        follow_target(stop);
        keep();
        look_at_keys();
        post();
        sleep_until_stop(stop, set_up_.between_looks);
    }
}

void LibraryWatch::take_what_comes() {
    if (const std::unique_ptr<ShownSet> gone(gone_.exchange(nullptr));
        gone && trial_ && !gone->trouble.empty()) {
        refuse(*gone);
    }
    ShownReport report;
    if (!shown_.take(report)) {
        return;
    }
    if (report.number == offered_set_.number) {
        shown_set_ = offered_set_;
    }
    on_show_ = report.number;
    if (trial_) {
        trial_->shown(report.now, report.number, fault_of(report.left_out, report.shows_nothing));
    }
}

/// Handles a set that was offered and never shown: the shown set stays, and is not offered as another one.
void LibraryWatch::refuse(const ShownSet& gone) {
    trial_->refuse(gone.number, gone.trouble);
    if (gone.number == offered_) {
        failed_ = offered_;
        offered_ = on_show_;
        offered_set_ = shown_set_;
    }
}

/// Reads a new file at once, and again some seconds after a failed read.
void LibraryWatch::look() {
    const std::optional<FileStamp> stamp = stamp_of_set(set_up_.library);
    const MonotonicTime now = monotonic_now();
    if (!stamp || (stamp == stamp_ && (trouble_.empty() || now < read_again_))) {
        return;
    }
    stamp_ = stamp;
    read_again_ = now + set_up_.between_tries;
    Result<std::optional<library::SetChoice>> choice = read_choice(set_up_.library);
    trouble_ = choice ? "" : choice.error().message;
    if (!choice || !*choice) {
        stamp_ = choice ? std::nullopt : stamp_; // it was removed meanwhile
        return;
    }
    if (trial_) {
        trial_->take(std::move(**choice));
    } else {
        trial_.emplace(std::move(**choice), read_verdict(set_up_.library));
    }
}

/// Runs before anything of the set is shown. Writes a new verdict at once, and again some seconds after a failed
/// write.
void LibraryWatch::keep() {
    const MonotonicTime now = monotonic_now();
    if (!trial_ || (kept_ == trial_->verdict() && (verdict_trouble_.empty() || now < keep_again_))) {
        return;
    }
    kept_ = trial_->verdict();
    keep_again_ = now + set_up_.between_tries;
    const Result<void> written = keep_verdict(set_up_.library, *kept_);
    trial_->note_kept(written.has_value());
    verdict_trouble_ = written ? "" : written.error().message;
}

void LibraryWatch::follow_target(const std::stop_token& stop) {
    // A bad set leads to the previous one: two steps at most.
    for (int step = 0; step < 2 && trial_; ++step) {
        const library::InstalledSet& target = trial_->target();
        if (target.number == offered_ || target.number == failed_ || stop.stop_requested()) {
            return;
        }
        offer(library::InstalledSet(target), stop);
    }
}

void LibraryWatch::offer(const library::InstalledSet& set, const std::stop_token& stop) {
    SetRequest request = request_of(set, set_up_.library, settings_);
    request.goes_on = [&] {
        heartbeat_.promise(monotonic_now() + pack_timeout);
        return !stop.stop_requested();
    };
    Result<std::unique_ptr<ShownSet>> opened = open_set(settings_, set_up_.options, request, set_up_.frames);
    if (stop.stop_requested()) {
        return;
    }
    const std::string fault =
        opened ? fault_of((*opened)->artifact_cache->left_out(), false) : opened.error().message;
    if (opened) {
        for (const std::string& note : (*opened)->notes) {
            say_line(set_up_.options.program, note);
        }
    }
    if (!fault.empty()) {
        trial_->refuse(set.number, fault);
    }
    if (!opened || trial_->target().number != set.number) {
        failed_ = set.number;
        return;
    }
    failed_.reset();
    offered_ = set.number;
    offered_set_ = set;
    delete coming_.exchange(opened->release());
}

/// Checks again for another set or set.txt, and each hour, because a key expires after its last day.
void LibraryWatch::look_at_keys() {
    const MonotonicTime now = monotonic_now();
    const std::pair looked_at(on_show_, stamp_);
    if (keys_of_ == looked_at && now < keys_again_) {
        return;
    }
    keys_of_ = looked_at;
    keys_again_ = now + std::chrono::hours(1);
    const auto clock = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
    of_ended_keys_ = on_show_ == shown_set_.number
                         ? packs_of_ended_keys(set_up_.library, shown_set_, settings_, clock)
                         : std::string();
}

void LibraryWatch::post() {
    status::SetStatus status;
    status.shown = on_show_;
    if (on_show_ == shown_set_.number) {
        status.packs = shown_set_.packs;
        status.of_ended_keys = of_ended_keys_;
    }
    if (trial_) {
        status.newest = trial_->told();
        status.on_trial = trial_->on_trial();
    }
    status.trouble = !trouble_.empty() ? trouble_ : verdict_trouble_;
    if (status != posted_) {
        posted_ = status;
        status_.put(std::make_shared<const status::SetStatus>(std::move(status)));
    }
}

} // namespace frustumscreen::show
