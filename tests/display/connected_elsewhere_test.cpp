#include "firmware_host/display/connected_elsewhere.h"
#include "tests/base/temporary_folder.h"

#include <gtest/gtest.h>

namespace frustumscreen::display {
namespace {

/// A folder like /sys/class/drm.
class ConnectedElsewhere : public WithTemporaryFolder {
protected:
    void SetUp() override {
        std::filesystem::create_directory(folder / "card0");
        put("version", "drm 1.1.0 20060810\n");
    }
    void say(const std::string& connector, const std::string& status) const {
        put(connector + "/status", status + "\n");
    }
};

TEST_F(ConnectedElsewhere, ListsTheConnectedConnectorsOfAllCards) {
    EXPECT_TRUE(connected_connectors(folder).empty());
    EXPECT_TRUE(connected_connectors(folder / "nowhere").empty());
    say("card1-HDMI-A-1", "connected");
    say("card0-DP-1", "connected");
    say("card0-VGA-1", "unknown");
    say("card0-HDMI-A-1", "disconnected");
    EXPECT_EQ(connected_connectors(folder), (std::vector<std::string>{"card0-DP-1", "card1-HDMI-A-1"}));
    say("card1-HDMI-A-1", "disconnected");
    EXPECT_EQ(connected_connectors(folder), (std::vector<std::string>{"card0-DP-1"}));
}

TEST_F(ConnectedElsewhere, MatchesConnectorsToTheirOwnCard) {
    const std::vector<std::string> connected{"card1-DP-1", "card11-HDMI-A-1"};
    EXPECT_TRUE(has_connected(connected, "/dev/dri/card1", ""));
    EXPECT_TRUE(has_connected(connected, "/dev/dri/card1", "DP-1"));
    EXPECT_FALSE(has_connected(connected, "/dev/dri/card1", "HDMI-A-1"));
    EXPECT_TRUE(has_connected(connected, "/dev/dri/card11", "HDMI-A-1"));
    EXPECT_FALSE(has_connected(connected, "/dev/dri/card0", ""));
}

} // namespace
} // namespace frustumscreen::display
