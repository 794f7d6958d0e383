#include "firmware_host/sound/device_sound.h"
#include "tests/base/comes_true.h"
#include "tests/render/counted_new.h"
#include "tests/sound/sound_samples.h"

#include <gtest/gtest.h>

#include <atomic>

namespace frustumscreen::sound {
namespace {

using namespace testing;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::size_t capacity = samples_in(longest_queue);

/// A sound card that a test plugs in, unplugs, stops and listens to.
struct FakeCard {
    std::atomic<bool> plugged{true};
    std::atomic<bool> plays{true};        ///< consumes its queue immediately
    std::atomic<bool> drains{false};      ///< a full queue loses 10 ms in every third wait of its thread
    std::atomic<std::uint64_t> played{0}; ///< samples that left the queue
    std::atomic<std::uint64_t> underruns{0};
    std::atomic<int> opened{0};
    std::atomic<int> fails_every{0}; ///< every so many calls; 0: never
    std::atomic<bool> holds{false};  ///< its thread stands still in a round that has something to write
    std::atomic<bool> is_held{false};

    std::mutex mutex;
    std::vector<std::int16_t> written;

    [[nodiscard]] std::uint64_t count() {
        const std::lock_guard lock(mutex);
        return written.size();
    }
    [[nodiscard]] std::vector<std::int16_t> heard() {
        const std::lock_guard lock(mutex);
        return written;
    }
    void play_on() {
        const std::lock_guard lock(mutex); // no samples are written between the two
        plays = true;
        played = written.size();
    }
    void hold() {
        holds = true;
        is_held.wait(false);
    }
    void let_go() {
        holds = false;
        holds.notify_all();
    }
};

class FakePcm final : public PcmDevice {
public:
    explicit FakePcm(FakeCard& card) : card_(card) {}

    [[nodiscard]] Result<std::size_t> free_samples() override {
        if (fails()) {
            return fail(ErrorKind::DeviceLost, "test.device", "unplugged");
        }
        const std::size_t free = capacity - queued();
        if (card_.holds && free > 0) {
            waits_ = 0; // the queue that it then fills stays full for some rounds
            card_.is_held = true;
            card_.is_held.notify_all();
            card_.holds.wait(true);
            card_.is_held = false;
        }
        return free;
    }
    [[nodiscard]] Result<void> write(std::span<const std::int16_t> samples) override {
        if (fails()) {
            return fail(ErrorKind::DeviceLost, "test.device", "unplugged");
        }
        EXPECT_LE(samples.size(), capacity - queued());
        const std::lock_guard lock(card_.mutex);
        card_.written.insert(card_.written.end(), samples.begin(), samples.end());
        if (card_.plays) {
            card_.played = card_.written.size();
        }
        return {};
    }
    [[nodiscard]] std::size_t queued() const override { return card_.count() - card_.played; }
    void wait(Nanoseconds longest) override {
        std::this_thread::sleep_for(card_.drains ? longest : std::min<Nanoseconds>(longest, milliseconds(1)));
        if (card_.drains && ++waits_ % 3 == 0 && queued() == capacity) {
            card_.played += capacity / 5;
        }
    }
    [[nodiscard]] std::uint64_t underruns() const override { return card_.underruns; }
    [[nodiscard]] DeviceState state() const override {
        return {{DeviceHealth::Well, "sound.well"}, Sentence("it sounds")};
    }

private:
    [[nodiscard]] bool fails() {
        ++calls_;
        return !card_.plugged || (card_.fails_every > 0 && calls_ % card_.fails_every == 0);
    }

    FakeCard& card_;
    int calls_ = 0;
    int waits_ = 0;
};

OpenPcm opener(FakeCard& card) {
    return [&card]() -> Result<std::unique_ptr<PcmDevice>> {
        if (!card.plugged) {
            return fail(ErrorKind::DeviceLost, "test.device", "not there");
        }
        ++card.opened;
        return std::make_unique<FakePcm>(card);
    };
}

/// Polls until `done(report)`.
template <typename Done> bool until(Sound& sound, const SoundRequest& wish, const Done& done) {
    return comes_true([&] { return done(sound.poll(monotonic_now(), wish)); });
}

/// Whether a prompt is heard, or was: a caller that stands still for longer than the prompt sees only its end.
bool has_begun(const SoundReport& report, std::uint64_t number) {
    return report.number == number || report.over >= number;
}

TEST(DeviceSound, PlaysAPromptToItsEnd) {
    FakeCard card;
    const SharedPrompt prompt = noise(15'000, 20'000, 31);
    {
        DeviceSound sound(opener(card));
        SoundRequest wish;
        const std::uint64_t number = wish.say(prompt);
        ASSERT_TRUE(
            until(sound, wish, [&](const SoundReport& r) { return r.audible && has_begun(r, number); }));
        EXPECT_EQ(sound.state(), "it sounds");
        ASSERT_TRUE(sound.alive_until());
        EXPECT_GT(*sound.alive_until(), monotonic_now());
        ASSERT_TRUE(until(sound, wish, [&](const SoundReport& r) { return r.over == number; }));
    }
    const std::vector<std::int16_t> heard = card.heard();
    const auto middle = prompt->samples.begin() + Mixer::fade_samples;
    EXPECT_NE(std::search(heard.begin(), heard.end(), middle, middle + 15'000 - 2 * Mixer::fade_samples),
              heard.end());
}

TEST(DeviceSound, StartsSpeechWithinTheQueueAndOneRound) {
    FakeCard card;
    card.plays = false;
    card.drains = true;
    DeviceSound sound(opener(card));
    SoundRequest wish;
    ASSERT_TRUE(until(sound, wish, [&](const SoundReport&) { return card.count() > 2 * capacity; }));
    card.hold(); // in a round that has looked for a request already: the latest possible start
    const std::uint64_t written = card.count();
    const std::uint64_t played = card.played;
    wish.say(level(24'000, 20'000));
    static_cast<void>(sound.poll(monotonic_now(), wish));
    card.let_go();
    ASSERT_TRUE(
        until(sound, wish, [&](const SoundReport&) { return card.count() > written + 2 * capacity; }));
    const std::size_t begin = first_heard(card.heard());
    EXPECT_GE(begin, written);
    EXPECT_LE(begin, played + capacity + capacity / 5); // 60 ms after the request
}

TEST(DeviceSound, PauseOfItsThreadIsNoDeviceStall) {
    FakeCard card;
    card.plays = false;
    card.drains = true;
    DeviceSound sound(opener(card));
    const SoundRequest wish;
    const auto plays_on = [&] {
        return until(sound, wish, [&, from = card.count()](const SoundReport&) {
            return card.count() > from + 2 * capacity;
        });
    };
    ASSERT_TRUE(plays_on());
    card.hold();
    std::this_thread::sleep_for(milliseconds(600)); // a device is lost after 500 ms without space
    card.let_go();
    ASSERT_TRUE(plays_on());
    EXPECT_EQ(card.opened, 1);
}

TEST(DeviceSound, KeepsTimeWithoutADeviceAndReconnects) {
    FakeCard card;
    card.plugged = false;
    DeviceSound sound(opener(card));
    SoundRequest wish;
    const std::uint64_t number = wish.say(level(60 * 48'000, 5000));
    Nanoseconds heard{0};
    const auto goes_on = [&](bool audible) {
        return until(sound, wish, [&, from = heard](const SoundReport& report) {
            if (report.number == number) {
                EXPECT_GE(report.heard + longest_queue, heard);
                heard = std::max(heard, report.heard);
            }
            return report.audible == audible && heard > from + milliseconds(50);
        });
    };
    ASSERT_TRUE(goes_on(false)); // device missing at the start
    EXPECT_EQ(sound.state(), "not there");
    EXPECT_EQ(sound.condition().health, DeviceHealth::Away);
    EXPECT_EQ(card.count(), 0U);
    card.plugged = true;
    ASSERT_TRUE(goes_on(true));
    EXPECT_EQ(sound.state(), "it sounds");
    card.plugged = false;
    ASSERT_TRUE(goes_on(false)); // lost
    EXPECT_EQ(sound.poll(monotonic_now(), wish).losses, 1U);
    card.plugged = true;
    ASSERT_TRUE(goes_on(true)); // found again, in the middle of the prompt
    EXPECT_EQ(card.opened, 2);
    EXPECT_EQ(sound.poll(monotonic_now(), wish).losses, 1U);
    EXPECT_EQ(card.heard().back(), 5000);
}

TEST(DeviceSound, ReopensAStalledDevice) {
    FakeCard card;
    DeviceSound sound(opener(card));
    const SoundRequest wish;
    ASSERT_TRUE(until(sound, wish, [](const SoundReport& report) { return report.audible; }));
    card.plays = false;
    ASSERT_TRUE(until(sound, wish, [&](const SoundReport& report) { return report.losses > 0; }));
    ASSERT_TRUE(until(sound, wish, [&](const SoundReport&) {
        return sound.state() == "the sound device takes no more samples; it is opened again";
    }));
    card.play_on();
    // It may have been lost more than once before it played on; then no more.
    ASSERT_TRUE(until(sound, wish, [&, from = card.count()](const SoundReport& report) {
        return report.audible && card.opened == 1 + static_cast<int>(report.losses) &&
               card.count() > from + 2 * capacity;
    }));
    EXPECT_GE(card.opened, 2);
}

TEST(DeviceSound, RetriesASlowlyFailingDeviceRarely) {
    static constexpr Nanoseconds takes = milliseconds(300);
    std::atomic<int> asked{0};
    const MonotonicTime before = monotonic_now();
    DeviceSound sound([&asked]() -> Result<std::unique_ptr<PcmDevice>> {
        ++asked;
        std::this_thread::sleep_for(takes);
        return fail(ErrorKind::DeviceLost, "test.device", "not there");
    });
    SoundRequest wish;
    wish.say(level(60 * 48'000, 1));
    ASSERT_TRUE(until(sound, wish, [](const SoundReport& report) { return report.heard > seconds(3); }));
    const int times = asked;
    EXPECT_LE(times, 1 + (monotonic_now() - before) / (11 * takes)); // each takes one part, and its pause ten
}

TEST(DeviceSound, AddsUpUnderrunsOfAllDevices) {
    FakeCard card;
    DeviceSound sound(opener(card));
    const SoundRequest wish;
    card.underruns = 3;
    ASSERT_TRUE(until(sound, wish, [](const SoundReport& report) { return report.underruns == 3; }));
    card.plugged = false;
    ASSERT_TRUE(until(sound, wish, [](const SoundReport& report) { return report.losses == 1; }));
    card.underruns = 2; // counted by a different device
    card.plugged = true;
    ASSERT_TRUE(until(sound, wish, [](const SoundReport& report) { return report.underruns == 5; }));
}

TEST(DeviceSound, PacesADeviceThatTakesEverything) {
    FakeCard card; // plays its data immediately, without end
    const MonotonicTime before = monotonic_now();
    DeviceSound sound(opener(card));
    SoundRequest wish;
    wish.say(level(60 * 48'000, 1));
    ASSERT_TRUE(
        until(sound, wish, [](const SoundReport& report) { return report.heard > milliseconds(300); }));
    const std::uint64_t count = card.count();
    const Nanoseconds took = monotonic_now() - before;
    EXPECT_LE(duration_of(count), took + took / 40 + 2 * longest_queue);
}

/// Accepts all samples and queues none.
class DeafPcm final : public PcmDevice {
public:
    [[nodiscard]] Result<std::size_t> free_samples() override { return capacity; }
    [[nodiscard]] Result<void> write(std::span<const std::int16_t>) override { return {}; }
    [[nodiscard]] std::size_t queued() const override { return 0; }
    void wait(Nanoseconds longest) override { std::this_thread::sleep_for(longest); }
    [[nodiscard]] std::uint64_t underruns() const override { return 0; }
    [[nodiscard]] DeviceState state() const override { return {{}, Sentence("nobody listens")}; }
};

TEST(DeviceSound, AllocatesNothing) {
    if (!synthetic::allocations_are_counted) {
        GTEST_SKIP() << "the sanitizers bring their own allocations";
    }
    DeviceSound sound([]() -> Result<std::unique_ptr<PcmDevice>> { return std::make_unique<DeafPcm>(); });
    SoundRequest wish;
    ASSERT_TRUE(until(sound, wish, [](const SoundReport& report) { return report.audible; }));
    const SharedPrompt prompts[] = {noise(4000, 9000, 34, {{1000, 1100}}), noise(9000, 9000, 35)};
    const long before = synthetic::allocations_so_far();
    std::uint64_t number = 0;
    for (int k = 0; k < 20; ++k) {
        number = wish.say(prompts[k % 2]);
        wish.set_gain_db(-1.0 * k);
        ASSERT_TRUE(until(sound, wish, [&](const SoundReport& report) { return has_begun(report, number); }));
        if (k % 3 == 0) {
            wish.leave();
        }
    }
    ASSERT_TRUE(until(sound, wish, [&](const SoundReport& report) { return report.over == number; }));
    EXPECT_EQ(synthetic::allocations_so_far(), before);
}

/// For the thread sanitizer, and for the order of reports: the caller constantly changes its request, and the
/// device constantly fails.
TEST(DeviceSound, RandomRequestsAndLossesLeaveNoPromptStuck) {
    FakeCard card;
    card.fails_every = 7;
    DeviceSound sound([&card, open = opener(card)]() -> Result<std::unique_ptr<PcmDevice>> {
        return card.opened % 3 == 1 && card.opened++ > 0
                   ? fail(ErrorKind::DeviceLost, "test.device", "not now")
                   : open();
    });
    SoundRequest wish;
    std::mt19937 random(32);
    const SharedPrompt prompts[] = {noise(3000, 9000, 33, {{1000, 1100}}), level(700, 9), level(0, 0)};
    std::uint64_t number = 0;
    std::uint64_t over = 0;
    for (int k = 0; k < 4000; ++k) {
        switch (random() % 7) {
        case 0:
            wish.leave();
            break;
        case 1:
            wish.stop();
            break;
        case 2:
            wish.set_gain_db(-static_cast<double>(random() % 70));
            break;
        default:
            number = wish.say(prompts[random() % 3]);
            break;
        }
        const SoundReport report = sound.poll(monotonic_now(), wish);
        ASSERT_GE(report.over, over);
        ASSERT_LE(report.over, number);
        ASSERT_TRUE(report.number == 0 || report.number == report.over + 1);
        over = report.over;
        if (k % 16 == 0) {
            std::this_thread::sleep_for(milliseconds(1));
        }
    }
    wish.stop();
    EXPECT_TRUE(until(sound, wish, [&](const SoundReport& report) { return report.over == number; }));
    EXPECT_TRUE(until(sound, wish, [](const SoundReport& report) { return report.losses > 0; }));
}

} // namespace
} // namespace frustumscreen::sound
