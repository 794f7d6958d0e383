// The exhibit passes its request in every frame; the sound returns what has been heard of it.
#include "firmware_host/sound/silent_sound.h"

#include <gtest/gtest.h>

#include <memory>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Sound) {
    // example
    using std::chrono::milliseconds;
    const MonotonicTime start{};
    sound::Prompt prompt;
    prompt.samples.resize(2 * sound::sample_rate_hz); // two seconds
    sound::SoundRequest request;
    const std::uint64_t number = request.say(std::make_shared<const sound::Prompt>(prompt));
    sound::SilentSound sound(start); // only keeps time; a loudspeaker has the same interface
    EXPECT_EQ(sound.poll(start, request).heard, milliseconds(0)); // begins
    EXPECT_EQ(sound.poll(start + milliseconds(1500), request).heard, milliseconds(1500));
    EXPECT_EQ(sound.poll(start + milliseconds(2600), request).over, number);
    // end
}

} // namespace
} // namespace frustumscreen::example
