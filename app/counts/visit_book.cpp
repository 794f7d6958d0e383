#include "app/counts/visit_book.h"

#include "app/counts/counts_folder.h"
#include "firmware_host/base/calendar_day.h"
#include "firmware_host/base/device_thread.h"

#include <utility>

namespace frustumscreen::counts {

namespace {

constexpr std::size_t max_posted = 512; ///< more than an hour of one long visit
constexpr Nanoseconds between_looks = std::chrono::seconds(1);

} // namespace

void DayKeeper::take(std::span<const VisitPiece> pieces, MonotonicTime now, std::chrono::sys_seconds wall) {
    const std::chrono::sys_seconds local = wall + offset_(wall);
    const auto day = std::chrono::floor<std::chrono::days>(local);
    const auto hour = static_cast<std::size_t>(std::chrono::floor<std::chrono::hours>(local - day).count());
    const bool knows_day = wall >= earliest_plausible_day;
    turn_to(knows_day ? std::optional(day) : std::nullopt, now);
    for (const VisitPiece& piece : pieces) {
        DayCounts one;
        one.add(piece, hour);
        counts_.add(one);
        visits_.since_start += one.all();
        changed_ = true;
    }
    if (changed_ && !next_) {
        next_ = now + between_writes;
    }
    open(now);
    keep(now);
    visits_.today = counts_.all();
}

void DayKeeper::turn_to(std::optional<std::chrono::sys_days> day, MonotonicTime now) {
    if (counts_.day == day) {
        return;
    }
    if (changed_) {
        finish();
    }
    counts_ = {};
    counts_.day = day;
    opened_ = changed_ = false;
    next_ = now;
    drop_old_days(folder_);
}

/// Adds the counts made before the file could be read to those of the file.
void DayKeeper::open(MonotonicTime now) {
    if (opened_ || (next_ && now < *next_)) {
        return;
    }
    const Result<OpenedDay> opened = open_day(folder_, counts_.day);
    if (!opened) {
        visits_.trouble = opened.error().message;
        next_ = now + between_tries;
        return;
    }
    counts_.add(opened->counts);
    opened_ = true;
    aside_ = opened->trouble.empty() ? aside_ : opened->trouble;
    visits_.trouble = aside_;
    next_ = changed_ ? std::optional(now + between_writes) : std::nullopt;
}

void DayKeeper::keep(MonotonicTime now) {
    if (!opened_ || !changed_ || !next_ || now < *next_) {
        return;
    }
    const Result<void> kept = keep_day(folder_, counts_);
    changed_ = !kept.has_value();
    next_ = kept ? std::nullopt : std::optional(now + between_tries);
    visits_.trouble = kept ? aside_ : kept.error().message;
}

void DayKeeper::finish() {
    const MonotonicTime due = next_.value_or(MonotonicTime{});
    open(due);
    next_ = due;
    keep(due);
}

VisitBook::VisitBook(std::filesystem::path folder, LocalOffset offset)
    : keeper_(std::move(folder), std::move(offset)) {
    posted_.reserve(max_posted);
    thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

VisitBook::~VisitBook() {
    thread_.request_stop();
    thread_.join();
}

void VisitBook::post(std::vector<VisitPiece>& pieces) {
    if (const std::unique_lock lock(mutex_, std::try_to_lock); lock.owns_lock()) {
        take(pieces);
    }
}

void VisitBook::post_last(std::vector<VisitPiece>& pieces) {
    const std::lock_guard lock(mutex_);
    take(pieces);
}

void VisitBook::take(std::vector<VisitPiece>& pieces) {
    for (const VisitPiece& piece : pieces) {
        if (posted_.size() < max_posted) {
            posted_.push_back(piece);
        }
    }
    pieces.clear();
}

void VisitBook::read(CountedVisits& visits) {
    if (const std::unique_lock lock(mutex_, std::try_to_lock); lock.owns_lock()) {
        visits = visits_;
    }
}

void VisitBook::work(const std::stop_token& stop) {
    begin_device_thread("counts", ThreadPriority::Low);
    std::vector<VisitPiece> pieces;
    bool ends = false;
    while (!ends) {
        ends = stop.stop_requested();
        pieces.reserve(max_posted);
        {
            const std::lock_guard lock(mutex_);
            std::swap(pieces, posted_);
        }
        keeper_.take(pieces, monotonic_now(),
                     std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now()));
        pieces.clear();
        if (ends) {
            keeper_.finish();
        }
        {
            const std::lock_guard lock(mutex_);
            visits_ = keeper_.visits();
        }
        sleep_until_stop(stop, between_looks);
    }
}

} // namespace frustumscreen::counts
