#include "firmware_host/service/watchdog_policy.h"

#include <gtest/gtest.h>

#include <vector>

namespace frustumscreen::service {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const MonotonicTime start = from_microseconds(1'000'000);

/// An exhibit that advances by milliseconds: presents every `period`, once a second at rest.
struct Exhibit {
    WatchdogPolicy policy{seconds(6), start};
    MonotonicTime now = start;
    Nanoseconds period = milliseconds(1000);
    MonotonicTime next_present = start;
    std::uint8_t code = 0;
    bool presents = true;
    bool covered = false; ///< the picture lights the corner
    bool frozen = false;  ///< the scanned-out picture stays
    bool blank = false;   ///< the scanned-out picture has no code
    std::vector<MonotonicTime> promises;
    std::vector<MonotonicTime> fed;
    int read = 0;

    void run(Nanoseconds length) {
        for (const MonotonicTime end = now + length; now < end; now += milliseconds(1)) {
            if (presents && now >= next_present) {
                next_present = now + period;
                policy.presented(now);
                code = frozen ? code : static_cast<std::uint8_t>(code + 1);
                if (policy.wants_code(now)) {
                    ++read;
                    policy.read_back(now, {covered, covered || blank ? std::nullopt : std::optional(code)});
                }
            }
            if (policy.feed(now, health())) {
                fed.push_back(now);
            }
        }
    }
    [[nodiscard]] Health health() const { return policy.health(now, promises); }
    /// The longest interval without feeding the watchdog since `from`, up to now.
    [[nodiscard]] Nanoseconds hunger(MonotonicTime from) const {
        Nanoseconds longest{0};
        MonotonicTime last = from;
        for (const MonotonicTime each : fed) {
            if (each > from) {
                longest = std::max<Nanoseconds>(longest, each - last);
                last = each;
            }
        }
        return std::max<Nanoseconds>(longest, now - last);
    }
};

TEST(WatchdogPolicy, FeedsWithinTheIntervalAtAnyFrameRate) {
    for (const milliseconds period :
         {milliseconds(1), milliseconds(16), milliseconds(300), milliseconds(1000)}) {
        Exhibit exhibit;
        exhibit.period = period;
        exhibit.run(seconds(60));
        EXPECT_LE(exhibit.hunger(start), seconds(2)) << period.count(); // of 6
        EXPECT_EQ(exhibit.health(), Health::Well);
    }
}

TEST(WatchdogPolicy, FeedsThreeTimesInAShortInterval) {
    Exhibit exhibit;
    exhibit.policy = WatchdogPolicy(milliseconds(900), start);
    exhibit.period = milliseconds(16);
    exhibit.run(seconds(10));
    EXPECT_LE(exhibit.hunger(start), milliseconds(300));
    EXPECT_GE(exhibit.hunger(start), milliseconds(299)); // but not more often than that
}

TEST(WatchdogPolicy, ReadsBackAFewTimesASecondNotInEveryFrame) {
    Exhibit exhibit;
    exhibit.period = milliseconds(16);
    exhibit.run(seconds(60));
    EXPECT_LE(exhibit.read, 3 * 60);
    EXPECT_GE(exhibit.read, 60);
}

TEST(WatchdogPolicy, StopsFeedingIfNothingIsPresented) {
    Exhibit exhibit;
    exhibit.run(seconds(10));
    exhibit.presents = false;
    const MonotonicTime stopped = exhibit.now;
    exhibit.run(seconds(20));
    EXPECT_EQ(exhibit.health(), Health::NoPicture);
    EXPECT_GE(exhibit.hunger(stopped), seconds(16));
    exhibit.presents = true; // recovers fully
    exhibit.run(seconds(1));
    EXPECT_EQ(exhibit.health(), Health::Well);
}

TEST(WatchdogPolicy, FeedsWhileAsleep) {
    Exhibit exhibit;
    exhibit.run(seconds(10));
    exhibit.presents = false;
    const MonotonicTime slept = exhibit.now;
    for (int k = 0; k < 200; ++k) {
        exhibit.policy.asleep(exhibit.now);
        exhibit.run(milliseconds(100));
        ASSERT_EQ(exhibit.health(), Health::Well);
    }
    EXPECT_LE(exhibit.hunger(slept), seconds(2));
    exhibit.promises = {exhibit.now - milliseconds(1)};
    EXPECT_EQ(exhibit.health(), Health::ThreadHangs) << "devices are read in sleep too";
    exhibit.promises.clear();
    exhibit.run(WatchdogPolicy::picture_within + milliseconds(1)); // it woke, but shows no picture
    EXPECT_EQ(exhibit.health(), Health::NoPicture);
}

TEST(WatchdogPolicy, StopsFeedingForAFrozenPicture) {
    for (const bool blank : {false, true}) {
        Exhibit exhibit;
        exhibit.period = milliseconds(16);
        exhibit.run(seconds(10));
        (blank ? exhibit.blank : exhibit.frozen) = true;
        const MonotonicTime stuck = exhibit.now;
        exhibit.run(seconds(20));
        EXPECT_EQ(exhibit.health(), Health::FrozenCode);
        EXPECT_GE(exhibit.hunger(stuck), seconds(16));
    }
}

TEST(WatchdogPolicy, FeedsIfThePictureCoversTheCode) {
    Exhibit exhibit;
    exhibit.covered = true;
    exhibit.run(seconds(20));
    EXPECT_EQ(exhibit.health(), Health::Well);
    EXPECT_LE(exhibit.hunger(start), seconds(2));
}

TEST(WatchdogPolicy, AcceptsTheSameCodeTwiceAtRest) {
    WatchdogPolicy policy(seconds(6), start);
    for (int k = 0; k < 60; ++k) {
        const MonotonicTime now = start + k * milliseconds(1100); // a slow machine's second
        EXPECT_EQ(policy.health(now, {}), Health::Well) << k;
        policy.presented(now);
        policy.read_back(now, {false, static_cast<std::uint8_t>(k / 2)});
    }
}

TEST(WatchdogPolicy, FeedsDespiteCoincidentallyEqualCodes) {
    Exhibit exhibit; // 256 pictures between two checks would show an equal code each time
    exhibit.period = Nanoseconds(seconds(1)) / 512;
    exhibit.run(seconds(20));
    EXPECT_LE(exhibit.hunger(start), seconds(2));
}

TEST(WatchdogPolicy, StopsFeedingOnceAThreadBreaksItsPromise) {
    Exhibit exhibit;
    exhibit.period = milliseconds(16);
    exhibit.promises = {start + seconds(1000), start + seconds(30)};
    exhibit.run(seconds(30) + milliseconds(1));
    EXPECT_EQ(exhibit.policy.health(start + seconds(30), exhibit.promises), Health::Well);
    EXPECT_EQ(exhibit.health(), Health::ThreadHangs);
    const MonotonicTime broken = exhibit.now;
    exhibit.run(seconds(20));
    EXPECT_GE(exhibit.hunger(broken), seconds(20) - milliseconds(1));
    exhibit.promises[1] = exhibit.now + seconds(10);
    exhibit.run(milliseconds(20));
    EXPECT_EQ(exhibit.health(), Health::Well);
}

TEST(WatchdogPolicy, EachHealthHasItsOwnSentence) {
    for (const Health a : {Health::Well, Health::NoPicture, Health::FrozenCode, Health::ThreadHangs}) {
        EXPECT_FALSE(sentence_of(a).empty());
        for (const Health b : {Health::Well, Health::NoPicture, Health::FrozenCode, Health::ThreadHangs}) {
            EXPECT_EQ(a == b, sentence_of(a) == sentence_of(b));
        }
    }
}

} // namespace
} // namespace frustumscreen::service
