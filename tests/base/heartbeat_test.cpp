#include "firmware_host/base/heartbeat.h"

#include <gtest/gtest.h>

#include <thread>

namespace frustumscreen {
namespace {

TEST(Heartbeat, IsVisibleAcrossThreads) {
    Heartbeat heartbeat(from_microseconds(5));
    EXPECT_EQ(heartbeat.promised_until(), from_microseconds(5));
    std::thread([&heartbeat] { heartbeat.promise(from_microseconds(7)); }).join();
    EXPECT_EQ(heartbeat.promised_until(), from_microseconds(7));
}

} // namespace
} // namespace frustumscreen
