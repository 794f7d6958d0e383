/// The notice about a stick: the importer's report in words, and when it is shown.
///
///     ImportReport -> notice_text -> NoticeText: sentences and lines, as keys of the exhibit's own words
///     ImportReport, now, presses -> StickNotice -> the part of it that is shown, and how full its ring is
///
/// Shown    from the report until two minutes after its end, or until a button is pressed after its end. A report
///          that ended two minutes before the exhibit began is not shown. Another import is a new notice.
/// Time     `now` never goes back.
/// Threads  values; one caller. `at` and `press` allocate nothing.
/// Errors   none.
#pragma once

#include "app/library/import_report.h"
#include "firmware_host/base/time.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::exhibit {

/// Key of the word for a pack's outcome; `refusal` counts only for a refused pack.
[[nodiscard]] std::string_view outcome_word(library::ImportOutcome outcome, library::ImportRefusal refusal);

struct NoticeLine {
    std::string
        label; ///< the pack's title; a refused one's file name; 490: number of packs; `+ 483`: more packs
    std::string file;     ///< in place of a title that no typeface can set; may be empty
    std::string_view key; ///< of the word for its outcome
    [[nodiscard]] bool operator==(const NoticeLine&) const = default;
};
struct NoticeText {
    std::vector<std::string_view> sentences; ///< keys, one below the other
    std::vector<NoticeLine> lines;           ///< refusals first
    bool ring = false;
    std::string remark{}; ///< what is wrong with the stick's settings, or why no report is on it, in English
    [[nodiscard]] bool operator==(const NoticeText&) const = default;
};
inline constexpr std::size_t max_notice_lines = 8;
/// `max_lines`: with more packs than this, the rest are combined, one line for each word; these lines may exceed the
/// limit.
[[nodiscard]] NoticeText notice_text(const library::ImportReport& report,
                                     std::size_t max_lines = max_notice_lines);
/// The text for a copy that has stopped.
[[nodiscard]] NoticeText stopped_text();

struct ShownNotice {
    bool stopped = false;       ///< stopped_text in place of the report's text
    std::optional<double> ring; ///< how full the ring is, 0..1
    std::string_view speech;    ///< key of the word that is spoken meanwhile; empty: none
    std::uint64_t import = 0;   ///< number of the import: each speech is spoken once for each import
    bool ends_at_press = false; ///< the press has no other effect
    [[nodiscard]] bool operator==(const ShownNotice&) const = default;
};

class StickNotice {
public:
    static constexpr Nanoseconds told_for = std::chrono::minutes(2);
    /// A copy without progress for this long has stopped: the stick was pulled, or the importer has ended.
    static constexpr Nanoseconds copy_timeout = std::chrono::seconds(30);
    /// Searching a stick with many files takes a minute at most.
    static constexpr Nanoseconds look_timeout = std::chrono::seconds(90);

    /// `is_old`: it ended long before the exhibit began. The same report again changes nothing.
    void take(MonotonicTime now, const library::ImportReport& report, bool is_old);
    /// The notice to show; nothing: none.
    [[nodiscard]] std::optional<ShownNotice> at(MonotonicTime now) const;
    /// Ends a notice that ends at a press. True if it did.
    bool press(MonotonicTime now);

private:
    [[nodiscard]] bool stopped(MonotonicTime now) const;
    [[nodiscard]] double ring_at(MonotonicTime now) const;

    std::string id_;
    std::uint64_t import_ = 0; ///< its number; 0: there was none
    library::ImportStage stage_ = library::ImportStage::Found;
    library::ImportRefusal refusal_ = library::ImportRefusal::None;
    std::uint64_t done_bytes_ = 0;
    MonotonicTime changed_; ///< when the report last changed
    double ring_from_ = 0.0, ring_to_ = 0.0;
    bool hidden_ = false; ///< by a press, or from the beginning
};

} // namespace frustumscreen::exhibit
