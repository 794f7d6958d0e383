#include "firmware_host/base/mailbox.h"
#include "firmware_host/base/sentence.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>

namespace frustumscreen {
namespace {

struct Item {
    MonotonicTime time;
    std::int64_t value = 0;
};
constexpr std::size_t capacity = 256;
using Box = Mailbox<Item, capacity>;

TEST(Mailbox, KeepsTheNewestAndReturnsNoFutureItems) {
    Box mailbox;
    std::vector<Item> put(1);
    for (int k = 1; k <= 1000; ++k) {
        put[0].time = from_microseconds(k);
        mailbox.put(put);
    }
    std::vector<Item> taken;
    mailbox.take(from_microseconds(900), taken);
    ASSERT_EQ(taken.size(), capacity - 100);
    EXPECT_EQ(taken.front().time, from_microseconds(1001 - static_cast<int>(capacity)));
    EXPECT_EQ(taken.back().time, from_microseconds(900));
    taken.clear();
    mailbox.take(from_microseconds(2000), taken);
    EXPECT_EQ(taken.size(), 100U);
    taken.clear();
    mailbox.take(from_microseconds(2000), taken);
    EXPECT_TRUE(taken.empty());
}

TEST(Mailbox, KeepsOrderAcrossTwoThreads) {
    Box mailbox;
    constexpr int count = 20'000;
    std::thread device([&] {
        std::vector<Item> put(3);
        for (int k = 1; k <= count; ++k) {
            for (Item& item : put) {
                item.time = from_microseconds(k);
                item.value = k;
            }
            mailbox.put(put);
        }
    });
    std::vector<Item> taken;
    MonotonicTime last{};
    while (last < from_microseconds(count)) {
        taken.clear();
        mailbox.take(from_microseconds(count), taken);
        for (const Item& item : taken) {
            EXPECT_GE(item.time, last);
            EXPECT_EQ(item.value, to_microseconds(item.time));
            last = item.time;
        }
        std::this_thread::yield(); // a spinning poll would hold the lock almost permanently
    }
    device.join();
}

TEST(Sentence, KeepsItsTextAndTruncatesIfTooLong) {
    EXPECT_EQ(Sentence("at first").view(), "at first");
    const std::string long_text(1000, 'x');
    const Sentence cut(long_text);
    EXPECT_GT(cut.view().size(), 200U);
    EXPECT_EQ(cut.view(), std::string_view(long_text).substr(0, cut.view().size()));
}

} // namespace
} // namespace frustumscreen
