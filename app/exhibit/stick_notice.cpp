#include "app/exhibit/stick_notice.h"

#include "app/geometry/time_curves.h"
#include "app/library/report_request.h"
#include "app/library/stick_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace frustumscreen::exhibit {

namespace {

constexpr double ring_follows_s = 0.3;

/// Entries are in the order of ImportRefusal.
constexpr std::array<std::string_view, library::import_refusal_names.size()> refusal_words{
    "stick.refused.unreadable", // a refusal without a reason
    "stick.refused.unsigned",   "stick.refused.wrong_key",  "stick.refused.altered",
    "stick.refused.older",      "stick.refused.not_a_pack", "stick.refused.no_room",
    "stick.refused.unreadable", "stick.refused.unwritable", "stick.refused.too_much"};

bool is_over(library::ImportStage stage) {
    return stage == library::ImportStage::Done || stage == library::ImportStage::Failed;
}

double share_done(const library::ImportReport& report) {
    if (report.stage == library::ImportStage::Found) {
        return 0.0;
    }
    if (report.stage != library::ImportStage::Copying) {
        return 1.0;
    }
    const auto all = static_cast<double>(std::max<std::uint64_t>(report.total_bytes, 1));
    return std::min(1.0, static_cast<double>(report.done_bytes) / all);
}

/// Order of the lines: refusals first, then by interest to the reader.
int rank_of(const library::ImportedPack& pack) {
    switch (pack.outcome) {
    case library::ImportOutcome::Refused:
    case library::ImportOutcome::NotWritten:
        return 0;
    case library::ImportOutcome::Taken:
    case library::ImportOutcome::Written:
        return 1;
    case library::ImportOutcome::AlreadyThere:
        return 2;
    default:
        return 3;
    }
}

NoticeLine line_of(const library::ImportedPack& pack) {
    const bool believed = pack.outcome != library::ImportOutcome::Refused && !pack.title.empty();
    return {believed ? pack.title : pack.file, pack.file, outcome_word(pack.outcome, pack.refusal)};
}

/// The number of packs with each word.
struct WordCount {
    std::string_view key;
    std::size_t count = 0;
    const library::ImportedPack* first = nullptr;
};
std::vector<WordCount> count_words(const std::vector<const library::ImportedPack*>& packs,
                                   std::size_t first) {
    std::vector<WordCount> counts;
    for (std::size_t k = first; k < packs.size(); ++k) {
        const std::string_view key = outcome_word(packs[k]->outcome, packs[k]->refusal);
        const auto found = std::find_if(counts.begin(), counts.end(),
                                        [&](const WordCount& count) { return count.key == key; });
        if (found != counts.end()) {
            ++found->count;
        } else {
            counts.push_back({key, 1, packs[k]});
        }
    }
    return counts;
}

/// As many single packs as leave space for the combined lines.
std::vector<NoticeLine> lines_of(const library::ImportReport& report, std::size_t most) {
    std::vector<const library::ImportedPack*> packs;
    for (const library::ImportedPack& pack : report.packs) {
        if (pack.outcome != library::ImportOutcome::Pending) {
            packs.push_back(&pack);
        }
    }
    std::stable_sort(packs.begin(), packs.end(),
                     [](const library::ImportedPack* a, const library::ImportedPack* b) {
                         return rank_of(*a) < rank_of(*b);
                     });
    std::size_t single = packs.size() <= most ? packs.size() : most;
    while (single > 0 && single < packs.size() && single + count_words(packs, single).size() > most) {
        --single;
    }
    std::vector<NoticeLine> lines;
    for (std::size_t k = 0; k < single; ++k) {
        lines.push_back(line_of(*packs[k]));
    }
    for (const WordCount& rest : count_words(packs, single)) {
        const bool more = std::any_of(lines.begin(), lines.end(),
                                      [&](const NoticeLine& line) { return line.key == rest.key; });
        lines.push_back(rest.count == 1
                            ? line_of(*rest.first)
                            : NoticeLine{fmt::format("{}{}", more ? "+ " : "", rest.count), {}, rest.key});
    }
    return lines;
}

/// A kiosk has no shell, so only the notice tells the technician which line is wrong, and why no report was written.
std::string remark_of(const library::ImportReport& report) {
    const auto wrong =
        std::find_if(report.packs.begin(), report.packs.end(), [](const library::ImportedPack& pack) {
            return pack.outcome == library::ImportOutcome::NotWritten ||
                   (pack.outcome == library::ImportOutcome::Pending &&
                    pack.file == library::copy_request_name) ||
                   (pack.outcome == library::ImportOutcome::Refused &&
                    (pack.file == library::settings_file_name || pack.file == library::report_request_name ||
                     pack.file == library::copy_request_name || pack.file == library::kiosk_copy_name));
        });
    return wrong != report.packs.end() ? fmt::format("{}: {}", wrong->file, wrong->reason) : std::string();
}

} // namespace

std::string_view outcome_word(library::ImportOutcome outcome, library::ImportRefusal refusal) {
    switch (outcome) {
    case library::ImportOutcome::Taken:
        return "stick.taken";
    case library::ImportOutcome::AlreadyThere:
        return "stick.already_there";
    case library::ImportOutcome::Removed:
        return "stick.removed";
    case library::ImportOutcome::Written:
        return "stick.written";
    case library::ImportOutcome::NotWritten:
        return "stick.not_written";
    default:
        return refusal_words.at(static_cast<std::size_t>(refusal));
    }
}

NoticeText notice_text(const library::ImportReport& report, std::size_t max_lines) {
    switch (report.stage) {
    case library::ImportStage::Found:
        return {.sentences = {"stick.found"}, .lines = {}, .ring = true};
    case library::ImportStage::Copying:
        return {.sentences = {"stick.copying"}, .lines = {}, .ring = true};
    case library::ImportStage::MayTakeOut:
        return {.sentences = {"stick.take_out"}, .lines = {}, .ring = true};
    case library::ImportStage::Done:
        break;
    case library::ImportStage::Failed: {
        NoticeText text{.sentences = {outcome_word(library::ImportOutcome::Refused, report.refusal)},
                        .lines = {},
                        .ring = false};
        if (report.refusal != library::ImportRefusal::Unreadable) { // an unreadable stick may be out already
            text.sentences.emplace_back("stick.take_out");
        }
        text.lines = lines_of(report, max_lines);
        text.remark = remark_of(report);
        return text;
    }
    }
    NoticeText text{.sentences = {"stick.take_out"},
                    .lines = lines_of(report, max_lines),
                    .ring = false,
                    .remark = remark_of(report)};
    if (text.lines.empty() && text.remark.empty()) {
        text.sentences.insert(text.sentences.begin(), "stick.nothing_on_it");
    }
    return text;
}

NoticeText stopped_text() {
    return {.sentences = {"stick.stopped"}, .lines = {}, .ring = false};
}

void StickNotice::take(MonotonicTime now, const library::ImportReport& report, bool is_old) {
    const bool another = import_ == 0 || report.import_id != id_;
    if (!another && report.stage == stage_ && report.done_bytes == done_bytes_) {
        return;
    }
    if (another) {
        id_ = report.import_id;
        ++import_;
        hidden_ = is_old && is_over(report.stage);
        changed_ = now;
        ring_to_ = 0.0;
    } else if (is_over(stage_)) {
        return; // it has already ended
    } else {
        hidden_ = false; // an import reported as stopped goes on
    }
    const double full = share_done(report);
    ring_from_ = another ? full : ring_at(now);
    ring_to_ = full;
    stage_ = report.stage;
    refusal_ = report.refusal;
    done_bytes_ = report.done_bytes;
    changed_ = now;
}

bool StickNotice::stopped(MonotonicTime now) const {
    return (stage_ == library::ImportStage::Copying && now - changed_ >= copy_timeout) ||
           (stage_ == library::ImportStage::Found && now - changed_ >= look_timeout);
}

double StickNotice::ring_at(MonotonicTime now) const {
    return ring_from_ + (ring_to_ - ring_from_) * geometry::ease(to_seconds(now - changed_) / ring_follows_s);
}

std::optional<ShownNotice> StickNotice::at(MonotonicTime now) const {
    if (import_ == 0 || hidden_) {
        return std::nullopt;
    }
    const bool has_stopped = stopped(now);
    const MonotonicTime since =
        has_stopped ? changed_ + (stage_ == library::ImportStage::Found ? look_timeout : copy_timeout)
                    : changed_;
    const bool lasts =
        !has_stopped && (stage_ == library::ImportStage::Found || stage_ == library::ImportStage::Copying);
    if (!lasts && now - since >= told_for) {
        return std::nullopt;
    }
    ShownNotice shown;
    shown.import = import_;
    shown.stopped = has_stopped;
    shown.ends_at_press = has_stopped || is_over(stage_);
    if (has_stopped) {
        return shown;
    }
    if (!is_over(stage_)) {
        shown.ring = ring_at(now);
    }
    if (stage_ == library::ImportStage::Found) {
        shown.speech = "stick.found";
    } else if (stage_ != library::ImportStage::Copying &&
               !(stage_ == library::ImportStage::Failed && refusal_ == library::ImportRefusal::Unreadable)) {
        shown.speech = "stick.take_out";
    }
    return shown;
}

bool StickNotice::press(MonotonicTime now) {
    const std::optional<ShownNotice> shown = at(now);
    hidden_ = hidden_ || (shown && shown->ends_at_press);
    return shown && shown->ends_at_press;
}

} // namespace frustumscreen::exhibit
