#include "firmware_host/panel/scripted_panel.h"

#include <gtest/gtest.h>

namespace frustumscreen::panel {
namespace {

using std::chrono::seconds;
constexpr MonotonicTime start{seconds(100)};

std::vector<PanelEvent> polled(ScriptedPanel& panel, Nanoseconds after) {
    std::vector<PanelEvent> events;
    EXPECT_TRUE(panel.poll(start + after, events));
    return events;
}

TEST(ScriptedPanel, PressesEachButtonOnceAtItsTime) {
    ScriptedPanel panel({{seconds(1), 1}, {seconds(2), 0}}, Nanoseconds(0), start);
    EXPECT_TRUE(polled(panel, seconds(1) - Nanoseconds(1)).empty());
    const auto first = polled(panel, seconds(1));
    ASSERT_EQ(first.size(), 1U);
    EXPECT_EQ(first[0].button, 1);
    EXPECT_EQ(first[0].time, start + seconds(1));
    EXPECT_TRUE(polled(panel, seconds(1)).empty());
    const auto second = polled(panel, seconds(1000));
    ASSERT_EQ(second.size(), 1U);
    EXPECT_EQ(second[0].button, 0);
    EXPECT_EQ(second[0].time, start + seconds(2));
    EXPECT_TRUE(polled(panel, seconds(2000)).empty());
}

TEST(ScriptedPanel, RestartsAfterTheRepeatInterval) {
    ScriptedPanel panel({{seconds(0), 1}, {seconds(2), 2}}, seconds(5), start);
    const auto events = polled(panel, seconds(12));
    ASSERT_EQ(events.size(), 6U);
    const int expected_s[] = {0, 2, 5, 7, 10, 12};
    for (std::size_t k = 0; k < 6; ++k) {
        EXPECT_EQ(events[k].time, start + seconds(expected_s[k]));
        EXPECT_EQ(events[k].button, k % 2 == 0 ? 1 : 2);
    }
}

TEST(ScriptedPanel, AnEmptyScriptPressesNothing) {
    ScriptedPanel panel({}, seconds(1), start);
    EXPECT_TRUE(polled(panel, seconds(1000)).empty());
}

} // namespace
} // namespace frustumscreen::panel
