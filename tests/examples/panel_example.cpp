// Every panel is polled for presses. A script operates this one.
#include "firmware_host/panel/scripted_panel.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Panel) {
    // example
    using std::chrono::seconds;
    const MonotonicTime start{};
    panel::ScriptedPanel panel({{seconds(2), 1}, {seconds(5), 0}}, Nanoseconds(0), start); // played once
    std::vector<panel::PanelEvent> events;
    ASSERT_TRUE(panel.poll(start + seconds(3), events));
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].button, 1);
    EXPECT_EQ(events[0].time, start + seconds(2));
    // end
}

} // namespace
} // namespace frustumscreen::example
