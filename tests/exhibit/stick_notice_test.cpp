// The notice about a stick, and its duration, for reports that an importer might write and for presses.
#include "app/exhibit/reset_offer.h"
#include "app/exhibit/stick_notice.h"
#include "app/library/report_request.h"
#include "tests/exhibit/block_words.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

namespace frustumscreen::exhibit {
namespace {

using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;

const MonotonicTime start{seconds(100)};

library::ImportReport report_of(const std::string& id, library::ImportStage stage, std::uint64_t done = 0,
                                std::uint64_t total = 100) {
    library::ImportReport report;
    report.import_id = id;
    report.stage = stage;
    report.done_bytes = done;
    report.total_bytes = total;
    return report;
}

library::ImportedPack pack_of(const std::string& name, library::ImportOutcome outcome,
                              library::ImportRefusal refusal = library::ImportRefusal::None) {
    return {name + ".fspack", "Title of " + name, outcome, refusal, "because"};
}

using Keys = std::vector<std::string_view>;

} // namespace

TEST(NoticeText, each_stage_has_its_sentence_and_its_ring) {
    EXPECT_EQ(notice_text(report_of("a", library::ImportStage::Found)),
              (NoticeText{{"stick.found"}, {}, true}));
    EXPECT_EQ(notice_text(report_of("a", library::ImportStage::Copying)),
              (NoticeText{{"stick.copying"}, {}, true}));
    EXPECT_EQ(notice_text(report_of("a", library::ImportStage::MayTakeOut)),
              (NoticeText{{"stick.take_out"}, {}, true}));
    EXPECT_EQ(notice_text(report_of("a", library::ImportStage::Done)),
              (NoticeText{{"stick.nothing_on_it", "stick.take_out"}, {}, false}));
    library::ImportReport failed = report_of("a", library::ImportStage::Failed);
    failed.refusal = library::ImportRefusal::NoRoom;
    EXPECT_EQ(notice_text(failed), (NoticeText{{"stick.refused.no_room", "stick.take_out"}, {}, false}));
    failed.refusal = library::ImportRefusal::Unreadable; // a stick that was pulled out need not be taken out
    EXPECT_EQ(notice_text(failed).sentences, (Keys{"stick.refused.unreadable"}));
}

TEST(NoticeText, reports_wrong_settings_with_their_line) {
    library::ImportReport report = report_of("a", library::ImportStage::Done);
    report.packs = {
        {"kiosk.toml", "", library::ImportOutcome::Refused, library::ImportRefusal::NotAPack, "line 3: no"},
        {"vase.fspack", "", library::ImportOutcome::Refused, library::ImportRefusal::Unsigned,
         "it is not signed"}};
    EXPECT_EQ(notice_text(report).remark, "kiosk.toml: line 3: no");
    EXPECT_EQ(notice_text(report).lines.size(), 2U);
    report.packs.front() = {"kiosk.toml", "", library::ImportOutcome::Taken, library::ImportRefusal::None,
                            ""};
    EXPECT_EQ(notice_text(report).remark, "") << "what a curator must mend is in the report alone";
}

TEST(NoticeText, names_the_folder_of_a_report_or_why_it_is_missing) {
    library::ImportReport report = report_of("a", library::ImportStage::Done);
    report.packs = {{"frustumscreen-report-2031-05-04-120000", "", library::ImportOutcome::Written, {}, ""}};
    EXPECT_EQ(notice_text(report), (NoticeText{{"stick.take_out"},
                                               {{"frustumscreen-report-2031-05-04-120000",
                                                 "frustumscreen-report-2031-05-04-120000", "stick.written"}},
                                               false}));
    report.packs = {{"frustumscreen-report.toml", "", library::ImportOutcome::NotWritten,
                     library::ImportRefusal::NoRoom, "the stick is full"}};
    EXPECT_EQ(notice_text(report).remark, "frustumscreen-report.toml: the stick is full");
    EXPECT_EQ(notice_text(report).lines.front().key, "stick.not_written");
    // A report that is written in spite of a mistake in the file
    report.packs = {{"frustumscreen-report-2031-05-04-120000", "", library::ImportOutcome::Written, {}, ""},
                    {"frustumscreen-report.toml", "", library::ImportOutcome::Refused,
                     library::ImportRefusal::NotAPack, "frustumscreen-report.toml:1: unknown"}};
    EXPECT_EQ(notice_text(report).lines.size(), 2U);
    EXPECT_NE(notice_text(report).remark, "");
}

TEST(NoticeText, shows_only_the_instruction_for_a_pending_request) {
    library::ImportReport report = report_of("a", library::ImportStage::Done);
    report.packs = {
        {"frustumscreen-request.toml", "", library::ImportOutcome::Pending, {}, "hold the first button"}};
    EXPECT_EQ(
        notice_text(report),
        (NoticeText{{"stick.take_out"}, {}, false, "frustumscreen-request.toml: hold the first button"}));
}

TEST(ResetOffer, ExpiresTenMinutesAfterASignedStick) {
    const MonotonicTime start{std::chrono::seconds(100)};
    library::ImportReport asks = report_of("a", library::ImportStage::Found);
    asks.packs = {{"frustumscreen-request.toml", "", library::ImportOutcome::Pending, {}, "hold"}};
    ResetOffer offer;
    EXPECT_FALSE(offer.at(start));
    offer.take(start, asks, true);
    EXPECT_FALSE(offer.at(start)) << "the report was there before the exhibit";
    offer.take(start, asks, false);
    EXPECT_TRUE(offer.at(start));
    asks.stage = library::ImportStage::Done; // the same stick's later report does not prolong it
    offer.take(start + std::chrono::minutes(1), asks, false);
    EXPECT_TRUE(offer.at(start + ResetOffer::stands - std::chrono::milliseconds(1)));
    EXPECT_FALSE(offer.at(start + ResetOffer::stands));
    // Packs that are being copied are pending too; another stick ends the offer.
    library::ImportReport other = report_of("b", library::ImportStage::Copying);
    other.packs = {{"vase.fspack", "", library::ImportOutcome::Pending, {}, ""}};
    offer.take(start + std::chrono::minutes(2), other, false);
    EXPECT_FALSE(offer.at(start + std::chrono::minutes(2)));
    // An unsigned request waits for the staff too, for a copy: it must not offer this.
    other.packs = {library::copy_offer()};
    offer.take(start + std::chrono::minutes(3), other, false);
    EXPECT_FALSE(offer.at(start + std::chrono::minutes(3)));
    // A line of this name that was not believed offers nothing.
    other.packs = {{"frustumscreen-request.toml", "", library::ImportOutcome::NotWritten,
                    library::ImportRefusal::Unsigned, ""}};
    offer.take(start + std::chrono::minutes(3), other, false);
    EXPECT_FALSE(offer.at(start + std::chrono::minutes(3)));
}

TEST(NoticeText, maps_each_outcome_and_refusal_to_a_word) {
    std::set<std::string> keys;
    for (const auto& [key, letters] : synthetic::stick_words()) {
        keys.insert(key);
    }
    for (std::size_t k = 1; k < library::import_refusal_names.size(); ++k) {
        EXPECT_EQ(outcome_word(library::ImportOutcome::Refused, static_cast<library::ImportRefusal>(k)),
                  "stick.refused." + std::string(library::import_refusal_names[k]));
    }
    for (const library::ImportOutcome outcome :
         {library::ImportOutcome::Taken, library::ImportOutcome::AlreadyThere,
          library::ImportOutcome::Removed, library::ImportOutcome::Written,
          library::ImportOutcome::NotWritten}) {
        EXPECT_TRUE(keys.contains(std::string(outcome_word(outcome, library::ImportRefusal::None))));
    }
}

TEST(NoticeText, lists_refused_packs_first_by_file_name) {
    library::ImportReport report = report_of("a", library::ImportStage::Done);
    report.packs = {pack_of("vase", library::ImportOutcome::Taken),
                    pack_of("old", library::ImportOutcome::Removed),
                    pack_of("coin", library::ImportOutcome::Refused, library::ImportRefusal::Altered),
                    pack_of("cup", library::ImportOutcome::AlreadyThere)};
    EXPECT_EQ(notice_text(report).lines,
              (std::vector<NoticeLine>{{"coin.fspack", "coin.fspack", "stick.refused.altered"},
                                       {"Title of vase", "vase.fspack", "stick.taken"},
                                       {"Title of cup", "cup.fspack", "stick.already_there"},
                                       {"Title of old", "old.fspack", "stick.removed"}}));
}

TEST(NoticeText, counts_every_pack_once) {
    std::mt19937 random(7);
    for (int round = 0; round < 400; ++round) {
        library::ImportReport report =
            report_of("a", round % 5 == 0 ? library::ImportStage::Failed : library::ImportStage::Done);
        report.refusal = library::ImportRefusal::TooMuch;
        const std::size_t count = random() % (round % 3 == 0 ? 600 : 12);
        std::map<std::string, int, std::less<>> expected;
        for (std::size_t k = 0; k < count; ++k) {
            const auto outcome =
                static_cast<library::ImportOutcome>(random() % library::import_outcome_names.size());
            const auto refusal = outcome == library::ImportOutcome::Refused
                                     ? static_cast<library::ImportRefusal>(1 + random() % 9)
                                     : library::ImportRefusal::None;
            report.packs.push_back(pack_of(std::to_string(k), outcome, refusal));
            if (outcome != library::ImportOutcome::Pending) {
                ++expected[std::string(outcome_word(outcome, refusal))];
            }
        }
        for (const std::size_t most : {std::size_t{3}, max_notice_lines}) {
            std::map<std::string, int, std::less<>> told;
            bool refusals_are_over = false;
            std::set<std::string_view> single;
            const NoticeText text = notice_text(report, most);
            for (const NoticeLine& line : text.lines) {
                const bool together = line.file.empty();
                const std::string number =
                    together ? line.label.substr(line.label.starts_with("+ ") ? 2 : 0) : "1";
                told[std::string(line.key)] += std::stoi(number);
                EXPECT_EQ(together && single.contains(line.key), line.label.starts_with("+ "));
                if (!together) {
                    single.insert(line.key);
                }
                const bool refused =
                    line.key.starts_with("stick.refused.") || line.key == "stick.not_written";
                EXPECT_FALSE(refused && refusals_are_over && !together);
                refusals_are_over = refusals_are_over || (!refused && !together);
            }
            EXPECT_EQ(told, expected);
            EXPECT_LE(text.lines.size(), std::max(most, expected.size()));
        }
    }
}

TEST(StickNotice, lines_stay_for_two_minutes_or_until_a_press) {
    for (const bool pressed : {false, true}) {
        StickNotice notice;
        EXPECT_FALSE(notice.press(start));
        notice.take(start, report_of("a", library::ImportStage::Found), false);
        EXPECT_EQ(notice.at(start)->speech, "stick.found");
        notice.take(start + seconds(1), report_of("a", library::ImportStage::Copying, 0), false);
        EXPECT_FALSE(notice.press(start + seconds(2))) << "a visitor's press is a visitor's";
        notice.take(start + seconds(3), report_of("a", library::ImportStage::Copying, 40), false);
        EXPECT_NEAR(*notice.at(start + seconds(4))->ring, 0.4, 1e-9);
        EXPECT_TRUE(notice.at(start + seconds(4))->speech.empty());
        notice.take(start + seconds(5), report_of("a", library::ImportStage::MayTakeOut), false);
        EXPECT_NEAR(*notice.at(start + seconds(6))->ring, 1.0, 1e-9);
        EXPECT_EQ(notice.at(start + seconds(6))->speech, "stick.take_out");
        EXPECT_FALSE(notice.press(start + seconds(7)));
        const MonotonicTime over = start + seconds(8);
        notice.take(over, report_of("a", library::ImportStage::Done), false);
        EXPECT_FALSE(notice.at(over)->ring);
        EXPECT_TRUE(notice.at(over + minutes(2) - milliseconds(1)));
        EXPECT_EQ(notice.press(over + seconds(pressed ? 10 : 120)), pressed);
        EXPECT_FALSE(notice.at(over + seconds(120)));
        EXPECT_EQ(notice.at(over + seconds(11)).has_value(), !pressed);
        EXPECT_FALSE(notice.press(over + seconds(121))) << "nothing is there to end";
        notice.take(over + seconds(122), report_of("a", library::ImportStage::Done, 1), false);
        EXPECT_FALSE(notice.at(over + seconds(122))) << "it was over";
        notice.take(over + seconds(123), report_of("b", library::ImportStage::Found), false);
        ASSERT_TRUE(notice.at(over + seconds(123))) << "another stick";
        EXPECT_EQ(notice.at(over + seconds(123))->import, 2U);
    }
}

TEST(StickNotice, ignores_imports_that_ended_before_the_start) {
    for (const library::ImportStage stage : {library::ImportStage::Done, library::ImportStage::Failed}) {
        StickNotice notice;
        notice.take(start, report_of("a", stage), true);
        EXPECT_FALSE(notice.at(start));
        EXPECT_FALSE(notice.press(start));
        notice.take(start, report_of("b", stage), false); // faster than a person can see
        EXPECT_TRUE(notice.at(start));
    }
    StickNotice notice;
    notice.take(start, report_of("a", library::ImportStage::Copying, 20), true);
    EXPECT_TRUE(notice.at(start)) << "it goes on";
    notice.take(start + seconds(1), report_of("a", library::ImportStage::Done), true);
    EXPECT_TRUE(notice.at(start + seconds(1)));
}

TEST(StickNotice, reports_a_stalled_copy_as_stopped) {
    StickNotice notice;
    notice.take(start, report_of("a", library::ImportStage::Copying, 20), false);
    const MonotonicTime renewed = start + seconds(20);
    notice.take(renewed, report_of("a", library::ImportStage::Copying, 20), false); // the same report again
    EXPECT_FALSE(notice.at(start + seconds(30) - milliseconds(1))->stopped);
    EXPECT_TRUE(notice.at(start + seconds(30))->stopped);
    EXPECT_FALSE(notice.at(start + seconds(30))->ring);
    EXPECT_TRUE(notice.at(start + seconds(30) + minutes(2) - milliseconds(1)));
    EXPECT_FALSE(notice.at(start + seconds(30) + minutes(2)));
    EXPECT_TRUE(notice.press(start + seconds(40)));
    EXPECT_FALSE(notice.at(start + seconds(41)));
    notice.take(start + seconds(50), report_of("a", library::ImportStage::Copying, 30), false);
    ASSERT_TRUE(notice.at(start + seconds(50))) << "a slow stick";
    EXPECT_FALSE(notice.at(start + seconds(50))->stopped);

    StickNotice looked;
    looked.take(start, report_of("a", library::ImportStage::Found), false);
    EXPECT_FALSE(looked.at(start + seconds(60))->stopped) << "looking may take a minute";
    EXPECT_TRUE(looked.at(start + seconds(90))->stopped);
}

TEST(StickNotice, clamps_the_ring_for_inconsistent_sizes) {
    StickNotice notice;
    notice.take(start, report_of("a", library::ImportStage::Copying, 500, 100), false);
    EXPECT_EQ(*notice.at(start + seconds(1))->ring, 1.0);
    notice.take(start, report_of("b", library::ImportStage::Copying, 5, 0), false);
    EXPECT_EQ(*notice.at(start + seconds(1))->ring, 1.0);
    notice.take(start, report_of("c", library::ImportStage::Copying, 0, 0), false);
    EXPECT_EQ(*notice.at(start + seconds(1))->ring, 0.0);
}

/// Any reports in any order, and presses; the ring's end moves no faster than a smooth step of 0.3 s.
TEST(StickNotice, ring_moves_smoothly_and_notices_expire) {
    int moved = 0;
    int expired = 0;
    int ended = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
        std::mt19937 random(seed);
        StickNotice notice;
        MonotonicTime now = start;
        MonotonicTime silent_since = now; // the last report
        std::optional<ShownNotice> before;
        for (int k = 0; k < 3000; ++k) {
            const Nanoseconds later = milliseconds(random() % 40 == 0 ? random() % 60000 : 10);
            now += later;
            if (random() % 50 == 0) {
                library::ImportReport report = report_of(
                    std::to_string(random() % 2), library::ImportStage(random() % 5), random() % 101, 100);
                report.refusal = static_cast<library::ImportRefusal>(random() % 10);
                notice.take(now, report, random() % 4 == 0);
                silent_since = now;
            }
            const std::optional<ShownNotice> shown = notice.at(now);
            if (now - silent_since >= StickNotice::look_timeout + StickNotice::told_for) {
                EXPECT_FALSE(shown);
                ++expired;
            }
            if (shown && shown->ring) {
                EXPECT_GE(*shown->ring, 0.0);
                EXPECT_LE(*shown->ring, 1.0);
            }
            if (shown && shown->ring && before && before->ring && before->import == shown->import) {
                const double way = std::abs(*shown->ring - *before->ring);
                EXPECT_LE(way, 1.5 * to_seconds(later) / 0.3 + 1e-9) << seed;
                moved += way > 0.0 ? 1 : 0;
            }
            before = shown;
            if (random() % 100 == 0) {
                const bool ends = shown && shown->ends_at_press;
                ended += ends ? 1 : 0;
                EXPECT_EQ(notice.press(now), ends);
                EXPECT_EQ(notice.at(now).has_value(), shown.has_value() && !ends);
            }
        }
    }
    EXPECT_GT(moved, 1000);
    EXPECT_GT(expired, 100);
    EXPECT_GT(ended, 100);
    StickNotice notice;
    double last = 0.0;
    for (int k = 0; k < 500; ++k) {
        const MonotonicTime now = start + milliseconds(10 * k);
        if (k % 7 == 0) {
            notice.take(now,
                        report_of("a", library::ImportStage::Copying,
                                  std::min(100U, 2U * static_cast<unsigned>(k / 7))),
                        false);
        }
        const double ring = *notice.at(now)->ring;
        EXPECT_GE(ring, last - 1e-9);
        EXPECT_LE(ring - last, 1.5 * 0.010 / 0.3);
        last = ring;
    }
    EXPECT_GT(last, 0.9);
}

} // namespace frustumscreen::exhibit
