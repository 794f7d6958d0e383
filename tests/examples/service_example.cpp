// systemd's watchdog is fed while pictures change and every device thread gives a sign of life by the time it has promised.
#include "firmware_host/service/watchdog_policy.h"

#include <gtest/gtest.h>

#include <array>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Service) {
    // example
    using std::chrono::seconds;
    const MonotonicTime start{};
    service::WatchdogPolicy policy(seconds(10), start); // to be fed within ten seconds
    policy.presented(start + seconds(1));
    policy.read_back(start + seconds(1), {.code = std::uint8_t{7}});
    const std::array promises{start + seconds(60)}; // of one device thread
    EXPECT_EQ(policy.health(start + seconds(4), promises), service::Health::Well);
    EXPECT_TRUE(policy.feed(start + seconds(4), service::Health::Well));
    EXPECT_EQ(policy.health(start + seconds(5), promises),
              service::Health::NoPicture); // none for more than 3.5 s
    // end
}

} // namespace
} // namespace frustumscreen::example
