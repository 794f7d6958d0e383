#include "firmware_host/sound/silent_sound.h"

namespace frustumscreen::sound {

SoundReport SilentSound::poll(MonotonicTime now, const SoundRequest& request) {
    mix_in_blocks(mixer_, clock_.take_due(now), [](std::span<const std::int16_t>) {});
    mixer_.follow(request);
    return mixer_.report(Nanoseconds(0));
}

} // namespace frustumscreen::sound
