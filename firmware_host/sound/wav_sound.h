/// A sound that goes to a WAV file (RIFF, 16-bit PCM, mono, 48 kHz); equal polls give equal samples.
///
/// Time     that of `poll`, in whole samples since `start`; a request takes effect where the last `poll` ended.
/// Memory   96 kB per second, until `write`; it holds `longest` and drops later samples.
/// Errors   those of the file, one sentence; the file appears by rename.
/// Threads  one caller.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/sound/mixer.h"
#include "firmware_host/sound/sample_clock.h"
#include "firmware_host/sound/sound.h"

#include <filesystem>

namespace frustumscreen::sound {

class WavSound final : public Sound {
public:
    static constexpr Nanoseconds longest = std::chrono::hours(1);

    explicit WavSound(MonotonicTime start) : clock_(start) {}

    SoundReport poll(MonotonicTime now, const SoundRequest& request) override;
    [[nodiscard]] std::string name() const override { return "wav"; }
    [[nodiscard]] std::string_view state() const override;
    /// Writes all samples up to the last `poll`.
    [[nodiscard]] Result<void> write(const std::filesystem::path& path) const;

private:
    Mixer mixer_;
    SampleClock clock_;
    std::vector<std::int16_t> samples_;
};

} // namespace frustumscreen::sound
