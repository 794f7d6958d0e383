// Random walks of ten million events: properties that hold over time, checked with a separate record.
#include "app/watch/ladder.h"
#include "app/watch/ladder_memory.h"

#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <random>

namespace frustumscreen::watch {
namespace {

using std::chrono::hours;
using std::chrono::minutes;
using std::chrono::seconds;

/// Record of actions, independent of the ladder's own memory.
struct Book {
    std::deque<Awake> reboots;
    Awake latest{-hours(1)};
    Step latest_step = Step::RestartExhibit;
    Awake good_since{0};
    bool is_good = false;
    std::array<std::size_t, step_count> steps{};

    void enter(Awake now, const LadderAction& act, const Observation& seen, Mode mode_before) {
        ++steps.at(static_cast<std::size_t>(act.step));
        EXPECT_GE(now - latest, Ladder::settling(latest_step)) << "two steps at once";
        latest = now;
        latest_step = act.step;
        if (act.step == Step::Return) {
            EXPECT_TRUE(is_good && now - good_since >= minutes(10)) << "back without ten good minutes";
        } else {
            EXPECT_TRUE(act.cause.has_value());
            EXPECT_TRUE(seen.trouble || mode_before == Mode::Safe) << "a step on a healthy exhibit";
        }
        if (act.step == Step::Reboot) {
            while (!reboots.empty() && now - reboots.front() >= hours(24)) {
                reboots.pop_front();
            }
            EXPECT_LT(reboots.size(), 6U) << "a seventh reboot in a day";
            EXPECT_TRUE(reboots.empty() || now - reboots.back() >= minutes(10))
                << "two reboots in ten minutes";
            reboots.push_back(now);
        }
    }
};

class Walk {
public:
    explicit Walk(unsigned seed) : chance_(seed) {}

    void go(int events) {
        for (int k = 0; k < events && !testing::Test::HasFailure(); ++k) {
            now_ += step_length();
            change_weather();
            look();
        }
    }
    [[nodiscard]] const Book& book() const { return book_; }

private:
    unsigned any(unsigned below) { return static_cast<unsigned>(chance_() % below); }
    /// Mostly a second; sometimes as long as a pause.
    Awake step_length() { return any(20) == 0 ? Awake(seconds(any(1500))) : Awake(seconds(1)); }
    void change_weather() {
        if (any(200) == 0) {
            trouble_ = any(2) == 0 ? std::nullopt : std::optional(static_cast<Cause>(any(cause_count)));
            lit_ = !trouble_ && any(4) != 0;
        }
        if (any(500) == 0) {
            means_ = {any(2) == 0, any(2) == 0, any(4) != 0};
        }
        if (any(3000) == 0) { // power cut, or restart of this program alone; only written memory survives
            const std::optional<KeptMemory> kept = read_slot(slot_of({1, 2, Awake(0), ladder_.memory()}));
            ASSERT_TRUE(kept);
            ASSERT_EQ(kept->memory, ladder_.memory());
            ladder_ = Ladder(kept->memory, any(2) == 0);
            book_.is_good = false;
        }
    }
    void look() {
        const Mode mode = ladder_.memory().mode;
        const bool is_safe = mode == Mode::Safe;
        Observation seen{trouble_, lit_ || (trouble_ && !is_dark(*trouble_))};
        if (is_safe != (trouble_ == Cause::SafePictureFails)) {
            seen.trouble.reset(); // a judge reports this only of the safe picture, and no other fault of it
        }
        seen.lit = seen.lit && !is_safe;
        const bool given_up =
            seen.trouble && (ladder_.memory().given_up >> static_cast<unsigned>(*seen.trouble) & 1U) != 0;
        const bool is_good = seen.lit && (!seen.trouble || given_up);
        book_.good_since = is_good && book_.is_good ? book_.good_since : now_;
        book_.is_good = is_good;
        if (const std::optional<LadderAction> act = ladder_.look(now_, seen, means_)) {
            book_.enter(now_, *act, seen, mode);
            book_.is_good = false;
            if (act->step == Step::Reboot) {
                ladder_ = Ladder(ladder_.memory(), true);
            }
        }
    }

    std::mt19937_64 chance_;
    Awake now_{0};
    Ladder ladder_{LadderMemory{}, true};
    Book book_;
    std::optional<Cause> trouble_;
    bool lit_ = true;
    Capabilities means_{true, true, true};
};

TEST(LadderWalk, TenMillionRandomEventsBreakNoRule) {
    std::array<std::size_t, step_count> steps{};
    for (unsigned seed = 1; seed <= 10; ++seed) {
        Walk walk(seed);
        walk.go(1'000'000);
        for (std::size_t k = 0; k < step_count; ++k) {
            steps[k] += walk.book().steps[k];
        }
    }
    for (std::size_t k = 0; k < step_count; ++k) {
        EXPECT_GT(steps[k], 100U) << word_of(static_cast<Step>(k))
                                  << " was hardly taken; the walk proves little";
    }
}

} // namespace
} // namespace frustumscreen::watch
