// ALSA's 'file' and 'null' devices replace a sound card: the file receives what would be heard. An ALSA
// plugin acts as a card with faults.
#include "firmware_host/base/file.h"
#include "firmware_host/sound/device_sound.h"
#include "tests/base/comes_true.h"
#include "tests/sound/faulty_card.h"
#include "tests/sound/sound_samples.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace frustumscreen::sound {
namespace {

using namespace testing;
using std::chrono::milliseconds;
using std::chrono::seconds;

class AlsaDevice : public ::testing::Test {
protected:
    static void SetUpTestSuite() {
        std::ofstream("asound.conf") << R"(
pcm.nowhere { type null }
pcm.kept { type file slave.pcm { type null } file "kept.raw" format "raw" }
pcm.mono_44100 {
    type plug
    slave { pcm { type file slave.pcm { type null } file "mono.raw" format "raw" } rate 44100 channels 1 }
}
)";
        std::ofstream("asound.conf", std::ios::app)
            << "pcm_type.faulty { lib \"" FRUSTUMSCREEN_FAULTY_CARD "\" }\npcm.faulty { type faulty }\n";
        ::setenv("ALSA_CONFIG_PATH", "asound.conf", 1); // before ALSA's first access
    }

    /// The plugin's instance, as loaded by ALSA.
    static FaultyCard& faulty_card() {
        void* const plugin = ::dlopen(FRUSTUMSCREEN_FAULTY_CARD, RTLD_NOW);
        if (plugin == nullptr) {
            throw std::runtime_error(::dlerror());
        }
        return *static_cast<FaultyCard*>(::dlsym(plugin, "faulty_card"));
    }

    static std::vector<std::int16_t> recorded(const std::string& file) {
        const Result<Bytes> bytes = read_file(file);
        EXPECT_TRUE(bytes);
        std::vector<std::int16_t> samples(bytes ? bytes->size() / 2 : 0);
        if (!samples.empty()) {
            std::memcpy(samples.data(), bytes->data(), samples.size() * 2);
        }
        return samples;
    }

    /// Plays the prompt and waits until it is over.
    static bool say(const std::string& device, const SharedPrompt& prompt) {
        DeviceSound sound([device] { return open_alsa(device); });
        SoundRequest wish;
        const std::uint64_t number = wish.say(prompt);
        if (!comes_true([&] { return sound.poll(monotonic_now(), wish).over >= number; })) {
            ADD_FAILURE() << sound.state();
            return false;
        }
        std::this_thread::sleep_for(milliseconds(30));
        EXPECT_EQ(sound.state(), "its sound goes to " + device);
        return sound.poll(monotonic_now(), wish).audible;
    }
};

TEST_F(AlsaDevice, PlaysThePromptOnBothChannels) {
    const SharedPrompt prompt = noise(20'000, 20'000, 41);
    ASSERT_TRUE(say("kept", prompt));
    const std::vector<std::int16_t> frames = recorded("kept.raw");
    std::vector<std::int16_t> left;
    for (std::size_t k = 0; k + 1 < frames.size(); k += 2) {
        ASSERT_EQ(frames[k], frames[k + 1]) << k;
        left.push_back(frames[k]);
    }
    const auto middle = prompt->samples.begin() + Mixer::fade_samples;
    const auto found =
        std::search(left.begin(), left.end(), middle, middle + 20'000 - 2 * Mixer::fade_samples);
    ASSERT_NE(found, left.end());
    EXPECT_LE(end_of_heard(left), static_cast<std::size_t>(found - left.begin()) + 20'000);
}

TEST_F(AlsaDevice, ConvertsForAMonoCardOfAnotherRate) {
    // A tone in the middle of the prompt keeps its length in seconds.
    const SharedPrompt tone = prompt_of(24'000, {}, [](std::size_t k) {
        return 10'000.0 * std::sin(2.0 * std::numbers::pi * 440.0 * static_cast<double>(k) / 48'000.0);
    });
    ASSERT_TRUE(say("mono_44100", tone));
    const std::vector<std::int16_t> heard = recorded("mono.raw");
    const double length_s = static_cast<double>(end_of_heard(heard) - first_heard(heard)) / 44'100.0;
    EXPECT_NEAR(length_s, 0.5, 0.002);
}

/// Polls until `done(report)`.
template <typename Done> bool until(Sound& sound, const SoundRequest& wish, const Done& done) {
    const bool is_done = comes_true([&] { return done(sound.poll(monotonic_now(), wish)); });
    EXPECT_TRUE(is_done) << sound.state();
    return is_done;
}

TEST_F(AlsaDevice, SurvivesUnderrunsSuspensionsAndLosses) {
    FaultyCard& card = faulty_card();
    card.opened = 0;
    const auto plays_on = [&card](Sound& sound, const SoundRequest& wish) {
        return until(sound, wish, [&card, from = card.frames.load()](const SoundReport& report) {
            return report.audible && card.frames > from + 9600;
        });
    };
    DeviceSound sound([] { return open_alsa("faulty"); });
    SoundRequest wish;
    wish.say(level(120 * 48'000, 100));
    ASSERT_TRUE(plays_on(sound, wish));
    const std::uint64_t own = sound.poll(monotonic_now(), wish).underruns; // underruns caused by a busy
                                                                           // machine
    card.underruns = 3;
    ASSERT_TRUE(until(sound, wish, [&](const SoundReport& report) { return report.underruns >= own + 3; }));
    ASSERT_TRUE(plays_on(sound, wish));
    // On a busy machine an underrun may come first, and then there is nothing to resume.
    const std::uint64_t before = sound.poll(monotonic_now(), wish).underruns;
    card.resumes_refused = 5;
    card.suspensions = 1;
    ASSERT_TRUE(until(sound, wish, [&](const SoundReport& report) {
        return card.resumed == 1 || report.underruns > before;
    }));
    card.resumes_refused = 0;
    ASSERT_TRUE(plays_on(sound, wish));
    EXPECT_EQ(card.opened, 1);
    EXPECT_EQ(sound.poll(monotonic_now(), wish).losses, 0U);
    card.gone = true;
    ASSERT_TRUE(until(sound, wish, [](const SoundReport& report) { return !report.audible; }));
    ASSERT_TRUE(until(sound, wish, [&](const SoundReport&) {
        return sound.state().find("sound device faulty: it is not there") == 0;
    }));
    card.gone = false;
    ASSERT_TRUE(plays_on(sound, wish));
    EXPECT_EQ(card.opened, 2);
    EXPECT_EQ(sound.poll(monotonic_now(), wish).losses, 1U);
    EXPECT_EQ(sound.poll(monotonic_now(), wish).number, 1U); // the prompt continued meanwhile
}

TEST_F(AlsaDevice, QueueIsNoLongerThanItsLimit) {
    Result<std::unique_ptr<PcmDevice>> device = open_alsa("nowhere");
    ASSERT_TRUE(device) << device.error().message;
    const Result<std::size_t> free = (*device)->free_samples();
    ASSERT_TRUE(free);
    EXPECT_LE(*free, samples_in(longest_queue));
    EXPECT_GE(*free, samples_in(longest_queue) / 2);
}

TEST_F(AlsaDevice, DoesNotFillALargeBuffer) {
    FaultyCard& card = faulty_card();
    card.period = 480;
    card.buffer = 48'000;
    Result<std::unique_ptr<PcmDevice>> device = open_alsa("faulty");
    card.period = 0;
    card.buffer = 0;
    ASSERT_TRUE(device) << device.error().message;
    std::size_t most = 0;
    for (int round = 0; round < 40; ++round) {
        const Result<std::size_t> free = (*device)->free_samples();
        ASSERT_TRUE(free);
        const std::vector<std::int16_t> silence(*free);
        ASSERT_TRUE((*device)->write(silence));
        most = std::max(most, (*device)->queued());
        (*device)->wait(milliseconds(10));
    }
    EXPECT_LE(most, samples_in(longest_queue));
    EXPECT_GE(most, samples_in(longest_queue) / 2);
}

TEST_F(AlsaDevice, ReportsLateSpeechForLongPeriods) {
    FaultyCard& card = faulty_card();
    card.period = 2048;
    card.buffer = 8192;
    const Result<std::unique_ptr<PcmDevice>> device = open_alsa("faulty");
    card.period = 0;
    card.buffer = 0;
    ASSERT_TRUE(device) << device.error().message;
    EXPECT_EQ(*(*device)->free_samples(), 2 * 2048U);
    EXPECT_NE((*device)->state().sentence.view().find("queues 85 ms: speech is late"), std::string_view::npos)
        << (*device)->state().sentence.view();
    EXPECT_EQ((*device)->state().condition.health, DeviceHealth::Impaired);
}

TEST_F(AlsaDevice, NamesAMissingDevice) {
    const Result<std::unique_ptr<PcmDevice>> device = open_alsa("no_such_device");
    ASSERT_FALSE(device);
    EXPECT_EQ(device.error().kind, ErrorKind::DeviceLost);
    EXPECT_EQ(device.error().id, "sound.device");
    EXPECT_EQ(device.error().message.find("sound device no_such_device: it is not there"), 0U)
        << device.error().message;
}

} // namespace
} // namespace frustumscreen::sound
