#include "firmware_host/base/format_sentence.h"
#include "firmware_host/service/service_manager.h"
#include "tests/service/notify_socket.h"

#include <gtest/gtest.h>

namespace frustumscreen::service {
namespace {

class ServiceManagerTest : public ::testing::Test {
protected:
    void SetUp() override {
        ASSERT_TRUE(socket.bound());
        ::setenv("NOTIFY_SOCKET", socket.path().c_str(), 1);
        ::unsetenv("WATCHDOG_USEC");
        ::unsetenv("WATCHDOG_PID");
    }
    void TearDown() override { ::unsetenv("NOTIFY_SOCKET"); }
    NotifySocket socket;
};

TEST_F(ServiceManagerTest, SendsTheMessagesOfTheNotifyProtocol) {
    const ServiceManager manager;
    EXPECT_TRUE(manager.listens());
    manager.still_starting(std::chrono::milliseconds(1500));
    EXPECT_EQ(socket.receive(), "EXTEND_TIMEOUT_USEC=1500000");
    manager.ready();
    EXPECT_EQ(socket.receive(), "READY=1");
    manager.feed_watchdog();
    EXPECT_EQ(socket.receive(), "WATCHDOG=1");
    manager.stopping();
    EXPECT_EQ(socket.receive(), "STOPPING=1");
}

TEST_F(ServiceManagerTest, SendsAStatusOnlyWhenItChanges) {
    ServiceManager manager;
    manager.status(Sentence("the cat"));
    EXPECT_EQ(socket.receive(), "STATUS=the cat");
    manager.status(Sentence("the cat"));
    EXPECT_EQ(socket.receive(), std::nullopt);
    manager.status(Sentence("the dog\nREADY=1"));
    EXPECT_EQ(socket.receive(), "STATUS=the dog READY=1"); // an external title must stay one line
}

TEST_F(ServiceManagerTest, TruncatesAStatusBetweenCharacters) {
    ServiceManager manager;
    std::string title = "shows ";
    for (int k = 0; k < 40; ++k) {
        title += "Νεφερτίτη ";
    }
    manager.status(format_sentence("x{}", title)); // the leading byte shifts every character across the limit
    EXPECT_EQ(socket.receive(), "STATUS=x" + title.substr(0, 238));
    manager.status(format_sentence("{}", title));
    EXPECT_EQ(socket.receive(), "STATUS=" + title.substr(0, 240));
}

TEST_F(ServiceManagerTest, WatchdogIntervalAppliesToThisProcessOnly) {
    EXPECT_EQ(ServiceManager().watchdog_interval(), std::nullopt);
    ::setenv("WATCHDOG_USEC", "5000000", 1);
    EXPECT_EQ(ServiceManager().watchdog_interval(), Nanoseconds(std::chrono::seconds(5)));
    ::setenv("WATCHDOG_PID", std::to_string(::getpid()).c_str(), 1);
    EXPECT_EQ(ServiceManager().watchdog_interval(), Nanoseconds(std::chrono::seconds(5)));
    ::setenv("WATCHDOG_PID", "1", 1);
    EXPECT_EQ(ServiceManager().watchdog_interval(), std::nullopt);
}

TEST(ServiceManager, DoesNothingWithoutASocket) {
    ::unsetenv("NOTIFY_SOCKET");
    ServiceManager manager;
    EXPECT_FALSE(manager.listens());
    manager.ready();
    manager.status(Sentence("nobody hears this"));
    ::setenv("NOTIFY_SOCKET", "/nowhere/at/all", 1);
    manager.feed_watchdog();
    ::unsetenv("NOTIFY_SOCKET");
}

} // namespace
} // namespace frustumscreen::service
