/// What the table tells the staff of a stick: what the importer's report says in words, and when that is shown.
///
///     ImportReport -> notice_text -> NoticeText: sentences and lines, as keys of the exhibit's own words
///     ImportReport, now, presses -> StickNotice -> which of it is shown, and how full its ring is
///
/// Shown    from the report on until two minutes after it was over, or until a button is pressed then. A report that was over
///          two minutes before the exhibit began is not shown. Another import begins anew.
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

namespace frustumscreen {

/// Key of the word for what became of a pack; `refusal` counts for what was refused.
[[nodiscard]] std::string_view outcome_word(ImportOutcome outcome, ImportRefusal refusal);

struct NoticeLine {
    std::string
        label; ///< the pack's title; of a refused one its file's name; 490: so many; `+ 483`: so many more
    std::string file;     ///< in place of a title that no typeface has; may be empty
    std::string_view key; ///< of the word for what became of it
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
/// `max_lines`: with more packs than this, those that are left come together, a line for each word; there may be more of these.
[[nodiscard]] NoticeText notice_text(const ImportReport& report, std::size_t max_lines = max_notice_lines);
/// That nothing comes any more.
[[nodiscard]] NoticeText stopped_text();

struct ShownNotice {
    bool stopped = false;       ///< stopped_text in place of the report's
    std::optional<double> ring; ///< how full it is, 0..1
    std::string_view speech;    ///< key of the word that is spoken while this is shown; empty: none
    std::uint64_t import = 0;   ///< which one, by its number: what was spoken of it is spoken once
    bool ends_at_press = false; ///< and the press does nothing else
    [[nodiscard]] bool operator==(const ShownNotice&) const = default;
};

class StickNotice {
public:
    static constexpr Nanoseconds told_for = std::chrono::minutes(2);
    /// A copy that stands still for so long has stopped: the stick was pulled, or the importer has ended.
    static constexpr Nanoseconds copy_patience = std::chrono::seconds(30);
    /// A stick with many files is looked through for a minute at most.
    static constexpr Nanoseconds look_patience = std::chrono::seconds(90);

    /// `is_old`: it was long there when the exhibit began. The same report again changes nothing.
    void take(MonotonicTime now, const ImportReport& report, bool is_old);
    /// Nothing: nothing is shown.
    [[nodiscard]] std::optional<ShownNotice> at(MonotonicTime now) const;
    /// Ends what ends at a press. True: it did.
    bool press(MonotonicTime now);

private:
    [[nodiscard]] bool stopped(MonotonicTime now) const;
    [[nodiscard]] double ring_at(MonotonicTime now) const;

    std::string id_;
    std::uint64_t import_ = 0; ///< its number; 0: there was none
    ImportStage stage_ = ImportStage::Found;
    ImportRefusal refusal_ = ImportRefusal::None;
    std::uint64_t done_bytes_ = 0;
    MonotonicTime changed_; ///< when the report last said something new
    double ring_from_ = 0.0, ring_to_ = 0.0;
    bool hidden_ = false; ///< by a press, or from the beginning
};

} // namespace frustumscreen
