// Recordings by a curator or a voice (WAV, FLAC, Ogg): refused in one line, or valid samples within the
// allowed number; a file and a stream give equal results.
#include "assets_baked/texts/recording.h"
#include "tests/fuzz/fuzz.h"

#include <algorithm>

using namespace frustumscreen;

namespace {

Result<texts::Recording> checked(std::span<const std::byte> bytes, texts::RecordingSource source) {
    Result<texts::Recording> recording = texts::read_recording(bytes, source);
    if (!recording) {
        fuzz::require_one_line(recording.error().message);
        return recording;
    }
    const std::vector<float>& samples = recording->samples;
    fuzz::require(recording->rate_hz >= 8000 && recording->rate_hz <= 96000, "its rate is one of speech");
    fuzz::require(!samples.empty() && samples.size() <= static_cast<std::size_t>(texts::longest_recording_s) *
                                                            static_cast<std::size_t>(recording->rate_hz),
                  "a recording has samples, no more than allowed");
    fuzz::require(std::all_of(samples.begin(), samples.end(), [](float s) { return std::isfinite(s); }),
                  "its samples are numbers");
    return recording;
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span<const std::byte> bytes = fuzz::bytes_of(data, size);
    const Result<texts::Recording> file = checked(bytes, texts::RecordingSource::File);
    const Result<texts::Recording> stream = checked(bytes, texts::RecordingSource::Stream);
    fuzz::require(!file || (stream && stream->samples == file->samples),
                  "what a file gives, a stream does too");
    return 0;
}
