#include "firmware_host/display/connector_watch.h"
#include "tests/display/fake_kms.h"

#include <gtest/gtest.h>

#include <condition_variable>

namespace frustumscreen::display {
namespace {

/// Hotplug events occur only when the test triggers them; no time passes otherwise.
class ScriptedHotplug final : public Hotplug {
public:
    bool wait(Nanoseconds /*at_most*/) override {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return plugged_ || timed_out_ || woken_; });
        timed_out_ = false;
        return std::exchange(plugged_, false);
    }
    void wake() override { set(woken_); }
    void plug() { set(plugged_); }
    void time_out() { set(timed_out_); }

private:
    void set(bool& what) {
        {
            const std::lock_guard lock(mutex_);
            what = true;
        }
        changed_.notify_all();
    }
    std::mutex mutex_;
    std::condition_variable changed_;
    bool plugged_ = false;
    bool timed_out_ = false;
    bool woken_ = false;
};

/// A card whose connectors the test changes while the watch checks them.
struct Card {
    CardSeen look(bool thoroughly) {
        const std::lock_guard lock(mutex);
        ++looks;
        thorough_looks += thoroughly ? 1 : 0;
        looked.notify_all();
        return seen;
    }
    void wait_for_look(int number) {
        std::unique_lock lock(mutex);
        looked.wait(lock, [&] { return looks >= number; });
    }
    void set(CardSeen now) {
        const std::lock_guard lock(mutex);
        seen = std::move(now);
    }
    std::mutex mutex;
    std::condition_variable looked;
    CardSeen seen;
    int looks = 0;
    int thorough_looks = 0;
};

CardSeen next_news(ConnectorWatch& watch) {
    while (true) {
        if (std::optional<CardSeen> seen = watch.news()) {
            return std::move(*seen);
        }
        std::this_thread::yield();
    }
}

TEST(ConnectorWatch, ReportsTheConnectorsAndTheirChanges) {
    Card card;
    auto hotplug = std::make_unique<ScriptedHotplug>();
    ScriptedHotplug& events = *hotplug;
    ConnectorWatch watch([&card](bool thoroughly) { return card.look(thoroughly); }, std::move(hotplug));
    EXPECT_EQ(next_news(watch), CardSeen{});
    card.set(a_card({a_projector()}));
    events.time_out();
    EXPECT_EQ(next_news(watch), a_card({a_projector()}));
    events.time_out();
    card.wait_for_look(3);
    events.time_out();
    card.wait_for_look(4);
    EXPECT_FALSE(watch.news()) << "nothing changed";
    events.plug();
    EXPECT_EQ(next_news(watch), a_card({a_projector()}))
        << "plugged again is news even where nothing changed";
}

TEST(ConnectorWatch, ProbesALitProjectorOnlyAfterAHotplugEvent) {
    Card card;
    auto hotplug = std::make_unique<ScriptedHotplug>();
    ScriptedHotplug& events = *hotplug;
    ConnectorWatch watch([&card](bool thoroughly) { return card.look(thoroughly); }, std::move(hotplug));
    card.wait_for_look(1);
    watch.set_lit(true);
    for (int k = 2; k < 6; ++k) {
        events.time_out();
        card.wait_for_look(k);
    }
    {
        const std::lock_guard lock(card.mutex);
        EXPECT_EQ(card.thorough_looks, 1);
    }
    events.plug();
    card.wait_for_look(6);
    const std::lock_guard lock(card.mutex);
    EXPECT_EQ(card.thorough_looks, 2);
}

TEST(ConnectorWatch, DoesNotBlockWhileTheCardIsProbed) {
    std::mutex slow;
    std::condition_variable answered;
    bool answer = false;
    ConnectorWatch watch(
        [&](bool /*thoroughly*/) {
            std::unique_lock lock(slow);
            answered.wait(lock, [&] { return answer; });
            return CardSeen{};
        },
        std::make_unique<ScriptedHotplug>());
    while (watch.quiet().owns_lock()) {
        std::this_thread::yield(); // until the thread has begun
    }
    EXPECT_FALSE(watch.news());
    EXPECT_FALSE(watch.quiet().owns_lock());
    {
        const std::lock_guard lock(slow);
        answer = true;
    }
    answered.notify_all();
    EXPECT_EQ(next_news(watch), CardSeen{});
    while (!watch.quiet().owns_lock()) {
        std::this_thread::yield();
    }
}

} // namespace
} // namespace frustumscreen::display
