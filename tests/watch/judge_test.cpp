#include "app/watch/judge.h"

#include <gtest/gtest.h>

namespace frustumscreen::watch {
namespace {

using std::chrono::hours;
using std::chrono::minutes;
using std::chrono::seconds;

/// A healthy exhibit that a test modifies.
struct Scene {
    MonotonicTime now{seconds(100)};
    Judge judge{Timeouts{}, now};
    Outcome outcome = healthy();
    Mode mode = Mode::Normal;
    bool counts = true; ///< new pictures are shown

    static Outcome healthy() {
        Outcome outcome;
        outcome.process = 321;
        outcome.exhibit = ExhibitSays{.age = Nanoseconds(0), .well = true, .pictures = 1, .artifacts = 2};
        return outcome;
    }
    Observation look() {
        now += seconds(1);
        if (counts && outcome.exhibit) {
            ++outcome.exhibit->pictures;
        }
        return judge.look(now, mode, outcome);
    }
    /// Seconds until the fault is detected; -1: not within `length`.
    int trouble_after(Cause cause, Nanoseconds length = minutes(5)) {
        for (int second = 1; seconds(second) <= length; ++second) {
            const Observation seen = look();
            if (seen.trouble) {
                EXPECT_EQ(word_of(*seen.trouble), word_of(cause));
                return second;
            }
        }
        return -1;
    }
    void well(Nanoseconds length) {
        for (int second = 0; seconds(second) < length; ++second) {
            const Observation seen = look();
            ASSERT_FALSE(seen.trouble) << word_of(*seen.trouble);
            ASSERT_TRUE(seen.lit);
        }
    }
};

TEST(Judge, ReportsNothingForAHealthyExhibit) {
    Scene scene;
    scene.well(hours(3));
}

TEST(Judge, SleepingExhibitCountsAsLit) {
    Scene scene;
    scene.counts = false;
    scene.outcome.exhibit->asleep = true;
    scene.well(hours(1));
}

TEST(Judge, IgnoresTheStatusOfThePreviousProcess) {
    Scene scene;
    scene.well(minutes(2));
    scene.outcome.process = 0; // killed; its last status stays until the next process overwrites it
    scene.counts = false;
    scene.outcome.exhibit->age = seconds(1);
    EXPECT_FALSE(scene.look().trouble);
    scene.outcome.process = 322;
    for (int second = 2; second < 50; ++second) { // its start takes long, but within the timeout
        scene.outcome.exhibit->age = seconds(second);
        const Observation seen = scene.look();
        ASSERT_FALSE(seen.lit);
        ASSERT_FALSE(seen.trouble) << word_of(*seen.trouble) << " after " << second << " s";
    }
    scene.outcome.exhibit->age = seconds(0);
    scene.counts = true;
    scene.well(minutes(2));
}

TEST(Judge, DetectsAFrozenPicture) {
    Scene scene;
    scene.well(minutes(2));
    scene.counts = false;
    EXPECT_NEAR(scene.trouble_after(Cause::NoPicture), 20, 2); // fresh for 5 s, then a timeout of 15 s
}

TEST(Judge, ReportsNoPictureForAnOldOrMissingStatus) {
    Scene scene;
    scene.well(minutes(2));
    scene.outcome.exhibit->age = seconds(6);
    EXPECT_NEAR(scene.trouble_after(Cause::NoPicture), 16, 2);
    scene.outcome.exhibit->age = seconds(1);
    scene.well(seconds(5));
    scene.outcome.exhibit.reset();
    EXPECT_NEAR(scene.trouble_after(Cause::NoPicture), 16, 2);
}

TEST(Judge, AllowsMoreTimeForAStart) {
    Scene scene;
    scene.well(minutes(2));
    scene.outcome.process = 322; // systemd has restarted it
    scene.outcome.exhibit.reset();
    EXPECT_NEAR(scene.trouble_after(Cause::NoPicture), 60, 2);
}

TEST(Judge, DetectsAProcessThatIsNotStarted) {
    Scene scene;
    scene.well(minutes(2));
    scene.outcome.process = 0;
    EXPECT_NEAR(scene.trouble_after(Cause::NoPicture), 16, 2);
}

TEST(Judge, IgnoresRareEnds) {
    Scene scene;
    for (int end = 0; end < 40; ++end) { // one every quarter of an hour
        scene.outcome.failures++;
        scene.outcome.process++;
        scene.outcome.exhibit->well = false;
        for (int second = 0; second < 3; ++second) {
            EXPECT_FALSE(scene.look().trouble);
        }
        scene.outcome.exhibit->well = true;
        scene.well(minutes(15));
    }
}

TEST(Judge, DetectsThreeEndsAtOnce) {
    Scene scene;
    scene.well(minutes(1));
    scene.outcome.exhibit.reset();
    for (int end = 0; end < 3; ++end) {
        scene.outcome.failures++;
        scene.outcome.process++;
        for (int second = 0; second < 3 && end < 2; ++second) {
            EXPECT_FALSE(scene.look().trouble);
        }
    }
    EXPECT_EQ(scene.trouble_after(Cause::KeepsEnding), 1);
    scene.judge.step_taken(scene.now);
    EXPECT_NEAR(scene.trouble_after(Cause::NoPicture), 60, 2); // counting starts again
}

TEST(Judge, DetectsAnEndEveryFiveMinutes) {
    Scene scene;
    int ends = 0;
    for (std::optional<Cause> trouble; !trouble && ends < 20;) {
        scene.well(minutes(5));
        scene.outcome.failures++;
        scene.outcome.process++;
        ++ends;
        scene.outcome.exhibit->well = false;
        for (int second = 0; second < 3 && !trouble; ++second) {
            trouble = scene.look().trouble;
        }
        scene.outcome.exhibit->well = true;
        if (trouble) {
            EXPECT_EQ(*trouble, Cause::KeepsEnding);
        }
    }
    EXPECT_GE(ends, 4);
    EXPECT_LE(ends, 6);
}

TEST(Judge, ReportsLesserTroublesOnlyAfterADelay) {
    Scene scene;
    scene.outcome.exhibit->artifacts = 0;
    EXPECT_NEAR(scene.trouble_after(Cause::NothingToShow), 46, 2);
    scene.outcome.exhibit->artifacts = 1;
    scene.well(seconds(3));
    scene.outcome.memory_free = 0.01;
    EXPECT_NEAR(scene.trouble_after(Cause::MemoryShort), 31, 2);
    scene.outcome.memory_free = 0.5;
    scene.well(seconds(3));
    scene.outcome.exhibit_memory = 0.95;
    EXPECT_NEAR(scene.trouble_after(Cause::MemoryShort), 31, 2);
    scene.outcome.exhibit_memory = 0.3;
    scene.outcome.exhibit->device_hangs = true;
    EXPECT_NEAR(scene.trouble_after(Cause::DeviceSilent), 16, 2);
    for (int second = 0; second < 100; ++second) { // a device that comes and goes is handled by its driver
        scene.outcome.exhibit->device_hangs = second % 10 != 0;
        const Observation seen = scene.look();
        EXPECT_FALSE(second > 0 && seen.trouble);
    }
}

TEST(Judge, IgnoresTimeInWhichTheMachineWasSuspended) {
    Scene scene;
    scene.well(minutes(1));
    scene.outcome.exhibit->age = seconds(30); // the whole machine was suspended, including this judge
    scene.now += seconds(30);
    EXPECT_FALSE(scene.look().trouble);
    scene.outcome.exhibit->age = seconds(0);
    scene.well(minutes(1));
}

TEST(Judge, JudgesTheSafePictureByItsFlips) {
    Scene scene;
    scene.mode = Mode::Safe;
    scene.outcome = {};
    for (std::uint64_t flips = 1; flips < 100; ++flips) {
        scene.outcome.safe_pictures = flips;
        EXPECT_FALSE(scene.look().trouble);
    }
    scene.outcome.projector = false; // it is switched off, so no picture can be shown
    EXPECT_EQ(scene.trouble_after(Cause::SafePictureFails), -1);
    scene.outcome.projector = true;
    EXPECT_NEAR(scene.trouble_after(Cause::SafePictureFails), 30, 2);
}

} // namespace
} // namespace frustumscreen::watch
