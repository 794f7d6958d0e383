#include "app/show/import_watch.h"

#include "firmware_host/base/device_thread.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/standard_error.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <utility>

namespace frustumscreen::show {

namespace {

constexpr std::uintmax_t max_report_bytes = 8U << 20U;
constexpr std::size_t notices_kept = 4;    ///< of one import: found, copied, may be removed, over
constexpr std::size_t lines_of_counts = 3; ///< if all lines may not fit

/// Age by the wall clock, in which the file's times are given.
Nanoseconds age_of(const struct stat& file) {
    const auto changed = std::chrono::seconds(file.st_mtim.tv_sec) + Nanoseconds(file.st_mtim.tv_nsec);
    return std::chrono::system_clock::now().time_since_epoch() - changed;
}

} // namespace

ImportWatch::ImportWatch(std::filesystem::path file, Draw draw, Answer answer)
    : file_(std::move(file)), draw_(std::move(draw)), answer_(answer) {
    if (answer_ == Answer::WhenReady) {
        worker_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
    }
}

const SharedImport& ImportWatch::latest(MonotonicTime now) {
    if (answer_ == Answer::Always && (!looked_ || now - *looked_ >= between_looks)) {
        looked_ = now;
        look(now);
    }
    if (const std::unique_lock lock(mutex_, std::try_to_lock); lock.owns_lock()) {
        latest_ = found_;
    }
    return latest_;
}

void ImportWatch::work(const std::stop_token& stop) {
    begin_device_thread("import", ThreadPriority::Low);
    while (!stop.stop_requested()) {
        look(monotonic_now());
        sleep_until_stop(stop, between_looks);
    }
}

Result<library::ImportReport> ImportWatch::read() const {
    TRY(const Bytes bytes, read_file(file_, max_report_bytes));
    return at(file_.string(), library::parse_import_report(as_text(bytes)));
}

/// Reads a new file at once, and again some seconds after a failed read.
void ImportWatch::look(MonotonicTime now) {
    struct stat file {};
    if (::stat(file_.c_str(), &file) != 0) {
        mark_.reset();
        first_ = false;
        return;
    }
    const FileMark mark{.device = file.st_dev,
                        .inode = file.st_ino,
                        .bytes = static_cast<std::uint64_t>(file.st_size),
                        .changed_ns =
                            std::int64_t{file.st_mtim.tv_sec} * 1'000'000'000 + file.st_mtim.tv_nsec};
    if (mark_ == mark && (!read_again_ || now < *read_again_)) {
        return;
    }
    mark_ = mark;
    Result<library::ImportReport> report = read();
    if (!report) {
        read_again_ = now + between_tries;
        const std::string line = report.error().message + "; the table shows no notice about this stick";
        if (line != said_) {
            say_line("frustumscreen", line);
            said_ = line;
        }
        return;
    }
    read_again_.reset();
    auto seen = std::make_shared<SeenImport>();
    seen->notice = drawn(exhibit::notice_text(*report), exhibit::notice_text(*report, lines_of_counts));
    seen->stopped = drawn(exhibit::stopped_text(), exhibit::stopped_text());
    seen->report = std::move(*report);
    const SharedImport before = found_; // only this thread changes it
    seen->is_old = (std::exchange(first_, false) && age_of(file) >= is_news_for) ||
                   (before && before->is_old && before->report.import_id == seen->report.import_id);
    const std::scoped_lock lock(mutex_);
    found_ = std::move(seen);
}

/// The notice's picture; kept ones are reused, since the report changes while a stick is copied but its text does
/// not.
exhibit::SharedNotice ImportWatch::drawn(const exhibit::NoticeText& text, const exhibit::NoticeText& counts) {
    const auto kept = std::find_if(drawn_.begin(), drawn_.end(),
                                   [&](const exhibit::SharedNotice& notice) { return notice->text == text; });
    if (kept != drawn_.end()) {
        return *kept;
    }
    exhibit::SharedNotice notice = draw_(text, counts);
    if (notice) {
        drawn_.insert(drawn_.begin(), notice);
        drawn_.resize(std::min(drawn_.size(), notices_kept));
    }
    return notice;
}

} // namespace frustumscreen::show
