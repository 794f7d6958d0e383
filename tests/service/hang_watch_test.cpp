// A thread that is not heard of is told of by another, once, and so is its return.
#include "firmware_host/base/latest.h"
#include "firmware_host/base/sentence.h"
#include "firmware_host/service/hang_watch.h"
#include "tests/base/comes_true.h"

#include <gtest/gtest.h>

#include <vector>

namespace frustumscreen::service {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using News = HangPolicy::News;

/// Checks at the policy's interval from `now` on, for `length`; returns the news.
std::vector<News> news_in(HangPolicy& policy, MonotonicTime& now, Nanoseconds length, MonotonicTime heard) {
    std::vector<News> all;
    for (const MonotonicTime end = now + length; now < end; now += policy.between_looks()) {
        if (const News news = policy.look(now, heard); news != News::None) {
            all.push_back(news);
        }
    }
    return all;
}

TEST(HangPolicy, ReportsAHangAndItsEndOnce) {
    HangPolicy policy(seconds(4));
    MonotonicTime now{seconds(100)};
    EXPECT_TRUE(news_in(policy, now, milliseconds(3900), MonotonicTime(seconds(100))).empty());
    EXPECT_EQ(news_in(policy, now, seconds(60), MonotonicTime(seconds(100))), std::vector{News::Hangs});
    EXPECT_EQ(news_in(policy, now, milliseconds(500), now), std::vector{News::HeardAgain});
    EXPECT_EQ(news_in(policy, now, seconds(5), now), std::vector{News::Hangs});
}

TEST(HangPolicy, ReportsNothingForALivingThread) {
    HangPolicy policy(seconds(4));
    MonotonicTime now{seconds(100)};
    for (int second = 0; second < 60; ++second) {
        EXPECT_TRUE(news_in(policy, now, seconds(1), now).empty());
    }
}

TEST(HangPolicy, SuspendedMachineIsNoHang) {
    HangPolicy policy(seconds(4));
    MonotonicTime now{seconds(100)};
    EXPECT_TRUE(news_in(policy, now, seconds(1), now).empty());
    const MonotonicTime heard = now;
    now += seconds(30); // the whole process was suspended, including the watch
    EXPECT_TRUE(news_in(policy, now, milliseconds(3900), heard).empty());
    EXPECT_EQ(news_in(policy, now, seconds(1), heard), std::vector{News::Hangs});
}

TEST(HangWatch, ReportsTheHangingActivityAndItsEnd) {
    Latest<Sentence> told;
    HangWatch watch(milliseconds(40), [&told](std::optional<const char*> doing) {
        told.put(Sentence(doing ? *doing : "it is heard again"));
    });
    const auto wait_for = [&told](std::string_view what) {
        Sentence now;
        EXPECT_TRUE(comes_true([&] {
            static_cast<void>(told.take(now));
            return now.view() == what;
        })) << now.view();
    };
    watch.enters("it draws");
    wait_for("it draws");
    std::jthread alive([&watch](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
            watch.enters("it waits");
            std::this_thread::sleep_for(milliseconds(1));
        }
    });
    wait_for("it is heard again");
}

} // namespace
} // namespace frustumscreen::service
