#include "firmware_host/base/latest.h"

#include <gtest/gtest.h>

#include <memory>
#include <thread>

namespace frustumscreen {
namespace {

TEST(Latest, ReturnsTheNewestValueOnce) {
    Latest<int> latest;
    int value = 7;
    EXPECT_FALSE(latest.take(value));
    EXPECT_EQ(value, 7);
    latest.put(1);
    EXPECT_TRUE(latest.try_put(2));
    EXPECT_TRUE(latest.try_take(value));
    EXPECT_EQ(value, 2);
    EXPECT_FALSE(latest.try_take(value));
}

TEST(Latest, ValuesArriveInOrderIncludingTheLast) {
    Latest<std::shared_ptr<const int>> latest;
    constexpr int count = 20'000;
    std::thread hurried([&] {
        for (int k = 1; k <= count; ++k) {
            const auto value = std::make_shared<const int>(k);
            while (!latest.try_put(value) && k == count) { // only the last one is retried
                std::this_thread::yield();
            }
        }
    });
    int last = 0;
    while (last < count) {
        if (std::shared_ptr<const int> value; latest.take(value)) {
            EXPECT_GT(*value, last);
            last = *value;
        }
        std::this_thread::yield();
    }
    hurried.join();
}

} // namespace
} // namespace frustumscreen
