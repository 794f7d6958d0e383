// The staff's buttons: a table of presses, and every state that can be reached with them.

#include "app/exhibit/staff_tool.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace frustumscreen::exhibit {
namespace {

using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;

const MonotonicTime start{seconds(100)};

/// A tool operated as by the exhibit. Letters: 1 to 5 press; F holds the first button, O another.
class Played {
public:
    explicit Played(bool stays = false) : tool(stays) {
        tool.begin(State::View, now);
        tool.step(now);
    }
    void play(const std::string& letters) {
        for (const char letter : letters) {
            now += seconds(1);
            letter == 'F' || letter == 'O' ? tool.hold(letter == 'F', now)
                                           : tool.press(static_cast<std::size_t>(letter - '1'), now);
            tool.step(now);
        }
    }
    [[nodiscard]] const StaffView& shown() const { return tool.shown(); }

    MonotonicTime now = start;
    StaffTool tool;
};

struct Row {
    const char* presses;
    StaffPage page;
    StaffLight light;
    int louder_db;
    std::uint32_t tones;
    bool kept;
    bool measures;
};
using enum StaffPage;
using enum StaffLight;
constexpr Row table[] = {
    {"", Status, White, 0, 0, false, false},
    {"1", Status, White, 0, 0, false, false},
    {"345", Status, White, 0, 0, false, false},
    {"2", Place, White, 0, 0, false, false},
    {"22", Focus, White, 0, 0, false, false},
    {"222", Light, White, 0, 0, false, false},
    {"2221", Light, Black, 0, 0, false, false},
    {"22211", Light, Greys, 0, 0, false, false},
    {"222111", Light, White, 0, 0, false, false},
    {"2223", Light, Greys, 0, 0, false, false},
    {"22213", Light, White, 0, 0, false, false},
    {"22245", Light, White, 0, 0, false, false},
    {"2222", Sound, White, 0, 0, false, false},
    {"22221", Sound, White, 3, 1, false, false},
    {"222211", Sound, White, 6, 2, false, false},
    {"2222113", Sound, White, 3, 3, false, false},
    {"22221111", Sound, White, 12, 4, false, false},
    {"222211111", Sound, White, -18, 5, false, false},
    {"22223333333", Sound, White, 12, 7, false, false},
    {"22222", Tracker, White, 0, 0, false, false},
    {"2222213", Tracker, White, 0, 0, false, false},
    {"222222", Copy, White, 0, 0, false, false},
    {"222222134", Copy, White, 0, 0, false, false},
    {"2222221F", Copy, White, 0, 0, true, false},
    {"2222222", Buttons, White, 0, 0, false, false},
    {"222222222222", Buttons, White, 0, 0, false, false},
    {"22222221345", Buttons, White, 0, 0, false, false},
    {"22222222O1F", Buttons, White, 0, 0, false, false},
    {"2O", Status, White, 0, 0, true, false},
    {"1F", Status, White, 0, 0, true, false},
    {"22O", Place, White, 0, 0, true, false},
    {"21F", Place, White, 0, 0, false, true},
    {"2213F", Focus, White, 0, 0, true, false},
    {"2221F", Light, White, 0, 0, true, false},
    {"22221F", Sound, White, 0, 1, true, false},
    {"222211F", Sound, White, 3, 2, true, false},
    {"22223O", Sound, White, 0, 1, true, false},
};

TEST(StaffTool, PressesHaveTheTabulatedEffects) {
    for (const Row& row : table) {
        Played played;
        played.play(row.presses);
        const StaffView& shown = played.shown();
        EXPECT_EQ(shown.page, row.page) << row.presses;
        EXPECT_EQ(shown.light, row.light) << row.presses;
        EXPECT_EQ(shown.louder_db, row.louder_db) << row.presses;
        EXPECT_EQ(played.tool.louder_db(), row.louder_db) << row.presses;
        EXPECT_EQ(played.tool.tones(), row.tones) << row.presses;
        EXPECT_EQ(shown.kept, row.kept) << row.presses;
        EXPECT_EQ(played.tool.take_measure(), row.measures) << row.presses;
        EXPECT_FALSE(played.tool.take_measure()) << "once";
        for (std::size_t button = 0; button < shown.presses.size(); ++button) {
            const std::string presses(row.presses);
            EXPECT_EQ(shown.presses[button],
                      std::count(presses.begin(), presses.end(), '1' + static_cast<char>(button)))
                << row.presses;
        }
    }
}

TEST(StaffTool, ResetIsConfirmedOnTheFirstPageOnlyIfOffered) {
    for (const auto& [presses, offered, resets] :
         {std::tuple("F", true, true), std::tuple("1F", true, true), std::tuple("O", true, false),
          std::tuple("2F", true, false), std::tuple("22F", true, false), std::tuple("F", false, false)}) {
        Played played;
        played.tool.offer_reset(offered);
        played.play(presses);
        EXPECT_EQ(played.tool.take_reset(), resets) << presses;
        EXPECT_FALSE(played.tool.take_reset()) << "once";
    }
    Played played;
    played.tool.offer_reset(true);
    played.tool.begin(State::View, played.now);
    played.play("F");
    EXPECT_TRUE(played.shown().resets) << "a new picture offers it too";
    played.tool.begin(State::View, played.now);
    EXPECT_FALSE(played.tool.take_reset()) << "what was asked on another picture is over";
}

TEST(StaffTool, CopyIsConfirmedOnItsPageOnlyIfOffered) {
    for (const auto& [presses, offered, copies] :
         {std::tuple("222222F", true, true), std::tuple("2222221F", true, true),
          std::tuple("222222O", true, false), std::tuple("222222", true, false),
          std::tuple("2222221", true, false), std::tuple("F", true, false), std::tuple("2F", true, false),
          std::tuple("22222F", true, false), std::tuple("2222222F", true, false),
          std::tuple("222222F", false, false)}) {
        Played played;
        played.tool.offer_copy(offered);
        played.play(presses);
        EXPECT_EQ(played.tool.take_copy(), copies) << presses;
        EXPECT_TRUE(!copies || played.shown().kept) << "what becomes of it is told here";
        EXPECT_FALSE(played.tool.take_copy()) << "once";
        EXPECT_FALSE(played.tool.take_reset()) << presses;
    }
    Played played;
    played.tool.offer_copy(true);
    played.tool.begin(State::View, played.now);
    played.play("222222F");
    EXPECT_TRUE(played.shown().copies) << "a new picture offers it too";
    played.tool.begin(State::View, played.now);
    EXPECT_FALSE(played.tool.take_copy()) << "what was asked on another picture is over";
}

/// On every page, with every number of buttons, in either order, and with another press in between.
TEST(StaffTool, ChordUndoesItsPresses) {
    for (const std::size_t buttons : {2U, 3U, 4U, 5U}) {
        const char last = static_cast<char>('0' + buttons);
        std::vector<std::string> chords{{'1', last}, {last, '1'}};
        if (buttons > 2) {
            chords.insert(chords.end(), {{'1', '2', last}, {last, '2', '1'}});
        }
        for (std::size_t pages = 0; pages < staff_page_names.size(); ++pages) {
            for (const std::string& chord : chords) {
                Played played;
                played.play(std::string(pages, '2') + (pages == 3 || pages == 4 ? "1" : ""));
                const StaffView before = played.shown();
                ASSERT_EQ(static_cast<std::size_t>(before.page), pages);
                played.play(chord);
                played.tool.undo_chord(buttons - 1);
                played.now += seconds(2);
                played.tool.step(played.now);
                EXPECT_EQ(played.shown().page, before.page) << pages << " " << chord;
                EXPECT_EQ(played.shown().light, before.light) << pages << " " << chord;
                EXPECT_EQ(played.tool.louder_db(), before.louder_db) << pages << " " << chord;
            }
        }
    }
}

TEST(StaffTool, TimesOutAMinuteAfterAPressOrAfterHalfAnHour) {
    Played played;
    EXPECT_FALSE(played.tool.is_over(start + minutes(1) - milliseconds(1)));
    EXPECT_TRUE(played.tool.is_over(start + minutes(1)));
    while (played.now < start + minutes(29) + seconds(30)) { // a child that keeps pressing
        played.now += seconds(49);
        played.play("1");
        EXPECT_EQ(played.tool.is_over(played.now), played.now >= start + minutes(30));
    }
    EXPECT_TRUE(played.tool.is_over(start + minutes(30)));

    Played kept;
    kept.play("2O");
    EXPECT_FALSE(kept.tool.is_over(start + minutes(30) - milliseconds(1)));
    EXPECT_TRUE(kept.tool.is_over(start + minutes(30)));
    while (kept.now < start + minutes(30)) { // repeated keeping does not extend it either
        kept.play("2O");
    }
    EXPECT_TRUE(kept.tool.is_over(kept.now));
    kept.tool.begin(State::View, kept.now);
    EXPECT_FALSE(kept.tool.is_over(kept.now + minutes(1) - milliseconds(1)));
    EXPECT_TRUE(kept.tool.is_over(kept.now + minutes(1))) << "the next one is not kept";

    const Played uncalibrated(true);
    EXPECT_FALSE(uncalibrated.tool.is_over(start + std::chrono::hours(1000)));
}

TEST(StaffTool, WhiteAndBlackPicturesHideTheirWordsAfterAWhile) {
    Played played;
    played.play("222");
    EXPECT_TRUE(played.shown().has_words);
    const auto words_after = [&](Nanoseconds time) {
        played.tool.step(played.now + time);
        return played.shown().has_words;
    };
    EXPECT_TRUE(words_after(StaffTool::words_stay - milliseconds(1)));
    EXPECT_FALSE(words_after(StaffTool::words_stay + StaffTool::between_views));
    played.now += seconds(10);
    played.play("1");
    EXPECT_TRUE(played.shown().has_words) << "black, and what it is";
    EXPECT_FALSE(words_after(StaffTool::words_stay));
    played.now += seconds(10);
    played.play("1");
    EXPECT_TRUE(words_after(StaffTool::words_stay)) << "the greys keep their numbers";
}

/// With presses every 50 ms, the shown content changes at most every 350 ms, and ends where the presses lead.
TEST(StaffTool, LimitsTheRateOfVisibleChanges) {
    Played played;
    played.play("222");
    StaffView before = played.shown();
    MonotonicTime changed = played.now - seconds(1);
    int changes = 0;
    for (int k = 0; k < 200; ++k) {
        played.now += milliseconds(50);
        played.tool.press(k % 3 == 2 ? 4 : 0, played.now);
        played.tool.step(played.now);
        if (played.shown() != before) {
            EXPECT_GE(played.now - changed, StaffTool::between_views);
            changed = played.now;
            before = played.shown();
            ++changes;
        }
    }
    EXPECT_GT(changes, 20);
    played.tool.step(played.now + StaffTool::between_views);
    EXPECT_EQ(played.shown().light, StaffLight(134 % 3)) << "no press is lost";
}

TEST(StaffTool, ClampsAndRoundsTheStoredVolume) {
    for (const auto& [kept, counts] :
         std::map<int, int>{{-100, -18}, {-18, -18}, {-4, -3}, {0, 0}, {1, 0}, {2, 3}, {11, 12}, {99, 12}}) {
        StaffTool tool(false);
        tool.set_louder_db(kept);
        EXPECT_EQ(tool.louder_db(), counts) << kept;
        tool.begin(State::View, start);
        EXPECT_EQ(tool.shown().louder_db, counts);
    }
}

/// Everything that five buttons, long presses and the chord can reach: the chord's presses are undone everywhere, the
/// second button leaves every page but the last, every page is reached, and no volume is out of its limits.
TEST(StaffTool, EveryReachableStateIsValid) {
    using Key = std::tuple<StaffPage, StaffLight, int, bool>;
    const auto key_of = [](const StaffTool& tool) {
        return Key{tool.shown().page, tool.shown().light, tool.louder_db(), tool.shown().kept};
    };
    std::map<Key, std::string> reached{{key_of(Played().tool), ""}};
    std::deque<std::string> open{""};
    std::set<StaffPage> pages;
    while (!open.empty()) {
        const std::string way = open.front();
        open.pop_front();
        for (const std::string step : {"1", "2", "3", "4", "5", "1F", "2O", "3O", "5O"}) {
            Played played;
            played.play(way);
            const StaffView before = played.shown();
            played.play(step);
            const StaffView& after = played.shown();
            pages.insert(after.page);
            ASSERT_LT(static_cast<std::size_t>(after.page), staff_page_names.size());
            ASSERT_LE(static_cast<int>(after.light), 2);
            ASSERT_TRUE(after.louder_db >= StaffTool::quietest_db &&
                        after.louder_db <= StaffTool::loudest_db &&
                        after.louder_db % StaffTool::volume_step_db == 0)
                << way << step;
            ASSERT_TRUE(after.page == before.page || (step == "2" && before.page != StaffPage::Buttons))
                << way << step;
            ASSERT_TRUE(after.page != before.page || step != "2" || before.page == StaffPage::Buttons)
                << way << step;
            ASSERT_TRUE(before.page != StaffPage::Buttons ||
                        std::tie(after.page, after.light, after.louder_db, after.kept) ==
                            std::tie(before.page, before.light, before.louder_db, before.kept))
                << "a press on the page that tests buttons did something: " << way << step;
            ASSERT_TRUE(after.kept || !before.kept);
            ASSERT_TRUE(played.tool.is_over(start + minutes(30)));
            if (reached.emplace(key_of(played.tool), way + step).second) {
                open.push_back(way + step);
            }
        }
    }
    EXPECT_EQ(pages.size(), staff_page_names.size());
    // Volumes on and after the sound page, lights on their own page, kept or not.
    EXPECT_EQ(reached.size(), 2U * (1 + 1 + 1 + 3 + 11 + 11 + 11 + 11));
}

} // namespace
} // namespace frustumscreen::exhibit
