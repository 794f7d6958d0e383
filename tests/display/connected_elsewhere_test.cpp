#include "firmware_host/display/connected_elsewhere.h"

#include <gtest/gtest.h>

#include <fstream>

namespace frustumscreen::display {
namespace {

namespace fs = std::filesystem;

/// A folder like /sys/class/drm.
class ConnectedElsewhere : public testing::Test {
protected:
    ConnectedElsewhere() : folder_(fs::path(testing::TempDir()) / "connected_elsewhere_test") {
        fs::remove_all(folder_);
        fs::create_directories(folder_ / "card0");
        std::ofstream(folder_ / "version") << "drm 1.1.0 20060810\n";
    }
    ~ConnectedElsewhere() override { fs::remove_all(folder_); }

    void put(const std::string& connector, const std::string& status) {
        fs::create_directories(folder_ / connector);
        std::ofstream(folder_ / connector / "status") << status << "\n";
    }

    fs::path folder_;
};

TEST_F(ConnectedElsewhere, ListsWhatIsConnectedToEachCard) {
    EXPECT_TRUE(connected_connectors(folder_).empty());
    EXPECT_TRUE(connected_connectors(folder_ / "nowhere").empty());
    put("card1-HDMI-A-1", "connected");
    put("card0-DP-1", "connected");
    put("card0-VGA-1", "unknown");
    put("card0-HDMI-A-1", "disconnected");
    EXPECT_EQ(connected_connectors(folder_), (std::vector<std::string>{"card0-DP-1", "card1-HDMI-A-1"}));
    put("card1-HDMI-A-1", "disconnected");
    EXPECT_EQ(connected_connectors(folder_), (std::vector<std::string>{"card0-DP-1"}));
}

TEST_F(ConnectedElsewhere, ACardHasItsOwnConnectorsAlone) {
    const std::vector<std::string> connected{"card1-DP-1", "card11-HDMI-A-1"};
    EXPECT_TRUE(has_connected(connected, "/dev/dri/card1", ""));
    EXPECT_TRUE(has_connected(connected, "/dev/dri/card1", "DP-1"));
    EXPECT_FALSE(has_connected(connected, "/dev/dri/card1", "HDMI-A-1"));
    EXPECT_TRUE(has_connected(connected, "/dev/dri/card11", "HDMI-A-1"));
    EXPECT_FALSE(has_connected(connected, "/dev/dri/card0", ""));
}

} // namespace
} // namespace frustumscreen::display
