/// Reads the importer's report of a stick whenever it changes, and draws the notice for the table, on its own thread.
///
/// Checks four times a second whether the file has been replaced. The render thread takes the latest result and never
/// waits.
///
/// Threads  one caller, the render thread; one worker of low priority, which alone reads the file and draws. It has
///          no heartbeat: an unreadable report is no reason to end the exhibit.
/// Errors   without a file there is no report. A file that is not a report is ignored, with one line on standard
///          error, and read again some seconds later.
#pragma once

#include "app/exhibit/notice_place.h"
#include "app/library/import_report.h"
#include "firmware_host/base/time.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace frustumscreen::show {

struct SeenImport {
    library::ImportReport report;
    bool is_old = false;          ///< the file existed when the watch began, and was older than `is_news_for`
    exhibit::SharedNotice notice; ///< none: there are no texts to draw it with
    exhibit::SharedNotice stopped; ///< says that the copy has stopped
};
using SharedImport = std::shared_ptr<const SeenImport>;
/// The report; null if there is none.
[[nodiscard]] inline std::shared_ptr<const library::ImportReport> report_of(const SharedImport& import) {
    return import ? std::shared_ptr<const library::ImportReport>(import, &import->report) : nullptr;
}

class ImportWatch {
public:
    /// Always: the caller reads the file, at most four times a second of the given time. For runs on a simulated
    /// clock.
    enum class Answer : std::uint8_t { WhenReady, Always };
    /// `counts`: as draw_notice. May return null.
    using Draw = std::function<exhibit::SharedNotice(const exhibit::NoticeText& text,
                                                     const exhibit::NoticeText& counts)>;
    static constexpr Nanoseconds between_looks = std::chrono::milliseconds(250);
    static constexpr Nanoseconds between_tries = std::chrono::seconds(5); ///< after a failed read
    /// Compared with the wall clock, which may be wrong: a report from the future counts as news.
    static constexpr Nanoseconds is_news_for = std::chrono::minutes(2);

    ImportWatch(std::filesystem::path file, Draw draw, Answer answer);

    /// The latest report; null: there is none yet. Allocates nothing while the report does not change.
    [[nodiscard]] const SharedImport& latest(MonotonicTime now);

private:
    /// Distinguishes a file from one that was renamed over it.
    struct FileMark {
        std::uint64_t device = 0, inode = 0, bytes = 0;
        std::int64_t changed_ns = 0;
        [[nodiscard]] bool operator==(const FileMark&) const = default;
    };
    void work(const std::stop_token& stop);
    void look(MonotonicTime now);
    [[nodiscard]] Result<library::ImportReport> read() const;
    [[nodiscard]] exhibit::SharedNotice drawn(const exhibit::NoticeText& text,
                                              const exhibit::NoticeText& counts);

    std::filesystem::path file_;
    Draw draw_;
    Answer answer_;
    // Owned by the worker; with Answer::Always, by the caller.
    std::optional<FileMark> mark_;
    bool first_ = true;                       ///< nothing has been read yet
    std::optional<MonotonicTime> read_again_; ///< after a failed read
    std::string said_;                        ///< last line on standard error
    std::vector<exhibit::SharedNotice> drawn_;

    std::mutex mutex_; ///< guards found_; nothing is read or drawn under it
    SharedImport found_;
    SharedImport latest_; ///< the caller's
    std::optional<MonotonicTime> looked_;
    std::jthread worker_; ///< last, so that it ends first
};

} // namespace frustumscreen::show
