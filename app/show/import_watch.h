/// Reads what the importer says of a stick, as often as it is said anew, and draws it for the table, on a thread of its own.
///
/// Four times a second it looks whether the file is another one. The render thread takes the latest and never waits.
///
/// Threads  one caller, the render thread; one worker of low priority, which alone reads the file and draws. It makes no promise to
///          be heard of again: a report that cannot be read is no reason to end the exhibit.
/// Errors   a file that is not there says nothing. One that is no report is left out, and one line on standard error says why;
///          it is read again some seconds later.
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

namespace frustumscreen {

struct SeenImport {
    ImportReport report;
    bool is_old =
        false; ///< it was there when the watch began, and nothing had been said of it for `is_news_for`
    SharedNotice notice;  ///< none: there are no words to draw it with
    SharedNotice stopped; ///< that nothing comes any more
};
using SharedImport = std::shared_ptr<const SeenImport>;
/// None where nothing was seen.
[[nodiscard]] inline std::shared_ptr<const ImportReport> report_of(const SharedImport& import) {
    return import ? std::shared_ptr<const ImportReport>(import, &import->report) : nullptr;
}

class ImportWatch {
public:
    /// Always: the file is read by who asks, at most four times a second of the time that is given. For runs on a clock that is
    /// not the wall's.
    enum class Answer : std::uint8_t { WhenReady, Always };
    /// `counts`: as draw_notice. It may return none.
    using Draw = std::function<SharedNotice(const NoticeText& text, const NoticeText& counts)>;
    static constexpr Nanoseconds between_looks = std::chrono::milliseconds(250);
    static constexpr Nanoseconds between_tries = std::chrono::seconds(5); ///< of what could not be read
    /// By the wall's clock, which may be wrong: a report from the future is news.
    static constexpr Nanoseconds is_news_for = std::chrono::minutes(2);

    ImportWatch(std::filesystem::path file, Draw draw, Answer answer);

    /// The latest; none: nothing was said yet. Allocates nothing while nothing new is said.
    [[nodiscard]] const SharedImport& latest(MonotonicTime now);

private:
    /// What tells one file from another that was renamed over it.
    struct FileMark {
        std::uint64_t device = 0, inode = 0, bytes = 0;
        std::int64_t changed_ns = 0;
        [[nodiscard]] bool operator==(const FileMark&) const = default;
    };
    void work(const std::stop_token& stop);
    void look(MonotonicTime now);
    [[nodiscard]] Result<ImportReport> read() const;
    [[nodiscard]] SharedNotice drawn(const NoticeText& text, const NoticeText& counts);

    std::filesystem::path file_;
    Draw draw_;
    Answer answer_;
    // The worker's own, or the caller's where it answers always.
    std::optional<FileMark> mark_;
    bool first_ = true;                       ///< nothing was found out yet
    std::optional<MonotonicTime> read_again_; ///< it could not be read
    std::string said_;                        ///< the last line on standard error
    std::vector<SharedNotice> drawn_;

    std::mutex mutex_; ///< for found_; nothing is read or drawn under it
    SharedImport found_;
    SharedImport latest_; ///< the caller's own
    std::optional<MonotonicTime> looked_;
    std::jthread worker_; ///< last, so that it ends first
};

} // namespace frustumscreen
