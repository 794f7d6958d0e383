/// A silent sound, for an exhibit without a loudspeaker: it only keeps time.
///
/// Time     that of `poll`, in whole samples since `start`; a request takes effect where the last `poll` ended.
/// Threads  one caller.
#pragma once

#include "firmware_host/sound/mixer.h"
#include "firmware_host/sound/sample_clock.h"
#include "firmware_host/sound/sound.h"

namespace frustumscreen::sound {

class SilentSound final : public Sound {
public:
    explicit SilentSound(MonotonicTime start) : clock_(start) {}

    SoundReport poll(MonotonicTime now, const SoundRequest& request) override;
    [[nodiscard]] std::string name() const override { return "silent"; }

private:
    Mixer mixer_;
    SampleClock clock_;
};

} // namespace frustumscreen::sound
