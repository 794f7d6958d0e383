// Choosing an artifact by holding the prop before its object in the room.

#include "app/exhibit/object_dwell.h"
#include "tests/exhibit/exhibits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace frustumscreen::exhibit {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr RoomObject vase{4, 1};

ObjectDwell::Input before(const std::optional<RoomObject>& object, const glm::dvec3& prop_m = {}) {
    return {.object = object, .prop_m = prop_m, .in_prop = 0, .choose = false, .other_press = false};
}

TEST(ObjectDwell, ChoosesAfter1500MsAtAnyFrameRate) {
    std::mt19937_64 random(8);
    for (const std::int64_t longest_us : {1'000, 17'000, 400'000}) {
        ObjectDwell dwell;
        MonotonicTime now = sample::start;
        MonotonicTime last = now;
        std::optional<RoomObject> chosen;
        while (!chosen) {
            ASSERT_LT(now - sample::start, milliseconds(2500));
            const double t = to_seconds(now - sample::start);
            const glm::dvec3 trembling =
                0.01 * glm::dvec3(std::sin(50.0 * t), std::cos(43.0 * t), std::sin(t));
            chosen = dwell.step(now, before(vase, trembling));
            EXPECT_EQ(dwell.settled().has_value(), now - sample::start >= milliseconds(300));
            last = chosen ? last : now;
            now += chosen ? microseconds(0)
                          : microseconds(1 + random() % static_cast<std::uint64_t>(longest_us));
        }
        EXPECT_EQ(*chosen, vase);
        EXPECT_GE(now - sample::start, milliseconds(1500));
        EXPECT_LT(last - sample::start, milliseconds(1500)); // in the first step after
    }
}

TEST(ObjectDwell, MovingOrSweepingHandChoosesNothing) {
    ObjectDwell dwell;
    for (int k = 0; k < 1000; ++k) { // at 4 cm/s, longer before the object than a rest takes
        EXPECT_FALSE(dwell.step(sample::start + milliseconds(10 * k), before(vase, {0.0004 * k, 0.0, 0.0})));
    }
    ObjectDwell other;
    for (int k = 0; k < 1000; ++k) {
        const bool away = k % 140 == 139; // for one frame
        EXPECT_FALSE(other.step(sample::start + milliseconds(10 * k),
                                before(away ? std::nullopt : std::optional(vase))));
    }
}

TEST(ObjectDwell, PropMustLeaveBeforeChoosingAgain) {
    ObjectDwell dwell;
    MonotonicTime now = sample::start;
    int chosen = 0;
    const auto rest = [&](const std::optional<RoomObject>& object, int ms) {
        for (int k = 0; k < ms / 10; ++k, now += milliseconds(10)) {
            chosen += dwell.step(now, before(object)) ? 1 : 0;
        }
    };
    rest(vase, 9000);
    EXPECT_EQ(chosen, 1);
    rest(std::nullopt, 100);
    rest(vase, 1400);
    EXPECT_EQ(chosen, 1);
    rest(vase, 200);
    EXPECT_EQ(chosen, 2);
    rest(RoomObject{5, 2}, 1600); // straight on to another one
    EXPECT_EQ(chosen, 3);
}

TEST(ObjectDwell, LongGapRestartsTheDwell) {
    ObjectDwell dwell;
    EXPECT_FALSE(dwell.step(sample::start, before(vase)));
    EXPECT_FALSE(dwell.step(sample::start + milliseconds(400), before(vase)));
    EXPECT_FALSE(dwell.step(sample::start + milliseconds(3000), before(vase)));
    for (const int ms : {3400, 3800, 4200, 4499}) {
        EXPECT_FALSE(dwell.step(sample::start + milliseconds(ms), before(vase))) << ms;
    }
    EXPECT_EQ(dwell.step(sample::start + milliseconds(4500), before(vase)), vase);
}

TEST(ObjectDwell, IgnoresTheArtifactAlreadyInTheProp) {
    ObjectDwell dwell;
    for (int k = 0; k < 300; ++k) {
        EXPECT_FALSE(dwell.step(sample::start + milliseconds(10 * k), before(RoomObject{4, 0})));
        EXPECT_FALSE(dwell.settled());
    }
}

TEST(ObjectDwell, ButtonChoosesAtOnceAndOtherPressesCancel) {
    ObjectDwell dwell;
    ObjectDwell::Input input = before(vase);
    EXPECT_FALSE(dwell.step(sample::start, input));
    input.choose = true;
    EXPECT_FALSE(
        dwell.step(sample::start + milliseconds(200), input)); // nothing shows yet what it would choose
    EXPECT_EQ(dwell.step(sample::start + milliseconds(310), input), vase);
    ObjectDwell other;
    input.choose = false;
    for (int k = 0; k < 500; ++k) {
        input.other_press = k == 40;
        EXPECT_FALSE(other.step(sample::start + milliseconds(10 * k), input)) << k;
    }
}

/// The exhibit with a room: the rest before an object changes the artifact, as a ring on the table does.
class ExhibitWithRoom : public ::testing::Test {
protected:
    Presentation step(const std::optional<RoomObject>& object,
                      std::span<const settings::Command> commands = {}) {
        now += milliseconds(20);
        tracking::TrackedState state = sample::tracked_state(now);
        state.table_from_prop.translation = {0.0, shift_m, 0.1};
        exhibit.note_object(object);
        return exhibit.step(now, commands, state);
    }
    void touch() {
        static_cast<void>(step({}));
        shift_m += 0.03;
        static_cast<void>(step({}));
    }
    exhibit::Exhibit exhibit = sample::exhibit(3, {"en"});
    MonotonicTime now = sample::start;
    double shift_m = 0.0;
};

TEST_F(ExhibitWithRoom, DwellBeforeAnObjectChoosesItsArtifact) {
    touch();
    ASSERT_EQ(exhibit.chosen(), 0U);
    for (int k = 0; k < 74; ++k) {
        const Presentation shown = step(vase);
        EXPECT_EQ(shown.state, k * 20 < 300 ? State::View : State::Browse) << k;
        EXPECT_EQ(shown.before, k * 20 < 300 ? std::nullopt : std::optional(vase));
        EXPECT_EQ(exhibit.chosen(), 0U);
    }
    for (int k = 0; k < 3; ++k) {
        static_cast<void>(step(vase));
    }
    EXPECT_EQ(exhibit.chosen(), 1U);
    const Presentation after = step(vase);
    EXPECT_EQ(after.state, State::View);
    EXPECT_EQ(after.before, std::nullopt);
    for (int k = 0; k < 40; ++k) {
        static_cast<void>(step(vase));
    }
    EXPECT_EQ(step(vase).artifact, 1U);
    EXPECT_EQ(step(vase).artifact_light, 1.0);
}

TEST_F(ExhibitWithRoom, ChoosesNothingWithoutAVisitor) {
    for (int k = 0; k < 200; ++k) {
        static_cast<void>(step(vase)); // the prop stands there, untouched
    }
    EXPECT_EQ(exhibit.chosen(), 0U);
}

} // namespace
} // namespace frustumscreen::exhibit
