#include "assets_baked/texts/level_speech.h"

#include "assets_baked/texts/limit_peaks.h"
#include "assets_baked/texts/ogg_serial.h"
#include "assets_baked/texts/sound_bytes.h"

#include <ebur128.h>
#include <fmt/format.h>
#include <samplerate.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::texts {

namespace {

/// R 128 measures in blocks of 400 ms; a shorter sound is measured as if repeated.
constexpr std::size_t min_measured_samples = speech_rate_hz;
constexpr double block_s = 0.01;
constexpr double silent_db = -45.0;   ///< relative to the loudest block: pauses and room noise
constexpr double quietest_db = -70.0; ///< of the loudest block, relative to full scale: nothing was recorded
constexpr double before_s = 0.06;     ///< kept around speech: a word's first sound may be soft, its last one
                                      ///< may fade
constexpr double after_s = 0.15;
constexpr double kilobits_a_second = 40.0;
constexpr int max_tries = 12;

double db(double amplitude) {
    return 20.0 * std::log10(std::max(amplitude, 1e-12));
}

/// Root mean square of each block of 10 ms.
std::vector<double> block_levels(std::span<const float> samples, std::size_t block) {
    std::vector<double> levels;
    for (std::size_t begin = 0; begin < samples.size(); begin += block) {
        const std::span<const float> part = samples.subspan(begin, std::min(block, samples.size() - begin));
        double squares = 0.0;
        for (const float sample : part) {
            squares += static_cast<double>(sample) * static_cast<double>(sample);
        }
        levels.push_back(std::sqrt(squares / static_cast<double>(part.size())));
    }
    return levels;
}

/// Trims the silence at both ends; empty if everything is silent.
std::vector<float> trimmed(std::span<const float> samples, int rate_hz) {
    if (samples.empty()) {
        return {};
    }
    const auto block = static_cast<std::size_t>(block_s * rate_hz);
    const std::vector<double> levels = block_levels(samples, block);
    const double loudest = *std::max_element(levels.begin(), levels.end());
    if (db(loudest) < quietest_db) {
        return {};
    }
    const auto is_heard = [&](double level) { return db(level) > db(loudest) + silent_db; };
    const auto first =
        static_cast<std::size_t>(std::find_if(levels.begin(), levels.end(), is_heard) - levels.begin());
    const auto last =
        static_cast<std::size_t>(levels.rend() - std::find_if(levels.rbegin(), levels.rend(), is_heard));
    const auto before = static_cast<std::size_t>(before_s * rate_hz);
    const auto after = static_cast<std::size_t>(after_s * rate_hz);
    const std::size_t begin = std::max(first * block, before) - before;
    const std::size_t end = std::min(samples.size(), last * block + after);
    return {samples.begin() + static_cast<std::ptrdiff_t>(begin),
            samples.begin() + static_cast<std::ptrdiff_t>(end)};
}

Result<std::vector<float>> resampled(std::vector<float> samples, int rate_hz) {
    if (rate_hz == speech_rate_hz) {
        return samples;
    }
    const double ratio = static_cast<double>(speech_rate_hz) / rate_hz;
    std::vector<float> out(static_cast<std::size_t>(std::ceil(static_cast<double>(samples.size()) * ratio)) +
                           1);
    SRC_DATA data{};
    data.data_in = samples.data();
    data.input_frames = static_cast<long>(samples.size());
    data.data_out = out.data();
    data.output_frames = static_cast<long>(out.size());
    data.src_ratio = ratio;
    if (const int error = src_simple(&data, SRC_SINC_MEDIUM_QUALITY, 1); error != 0) {
        return fail(ErrorKind::Internal, "speech.rate", "the recording cannot be brought to {} Hz: {}",
                    speech_rate_hz, src_strerror(error));
    }
    out.resize(static_cast<std::size_t>(data.output_frames_gen));
    return out;
}

Result<Bytes> encoded(std::span<const float> samples) {
    SoundBytes bytes{.view = {}, .written = {}, .writing = true, .cursor = 0};
    SF_INFO info{};
    info.samplerate = speech_rate_hz;
    info.channels = 1;
    info.format = SF_FORMAT_OGG | SF_FORMAT_OPUS;
    {
        const SoundFile file = open_sound(bytes, SFM_WRITE, info);
        // libsndfile's scale for Opus: 1 to 0 for 6 to 256 kilobits per second and channel.
        double compression = 1.0 - (kilobits_a_second - 6.0) / 250.0;
        const bool written =
            file &&
            sf_command(file.get(), SFC_SET_COMPRESSION_LEVEL, &compression, sizeof(compression)) == SF_TRUE &&
            sf_writef_float(file.get(), samples.data(), static_cast<sf_count_t>(samples.size())) ==
                static_cast<sf_count_t>(samples.size());
        if (!written) {
            return fail(ErrorKind::Internal, "speech.opus", "the speech cannot be stored as Opus: {}",
                        sf_strerror(file.get()));
        }
    }
    set_ogg_serial(bytes.written,
                   1); // not the library's random one: equal recordings give equal bytes
    return std::move(bytes.written);
}

float amplitude(double level_db) {
    return static_cast<float>(std::pow(10.0, level_db / 20.0));
}

std::vector<float> scaled(std::span<const float> samples, double gain_db) {
    const float gain = amplitude(gain_db);
    std::vector<float> out(samples.begin(), samples.end());
    for (float& sample : out) {
        sample *= gain;
    }
    return out;
}

/// Scales to `speech_lufs` and lowers the peaks. A loud knock raises the measured loudness until it is
/// lowered, so this takes several rounds.
std::vector<float> levelled(std::span<const float> samples, double lufs, double max_db) {
    constexpr int max_rounds = 8;
    constexpr double near_db = 0.1;
    double gain_db = speech_lufs - lufs;
    for (int round = 1;; ++round) {
        std::vector<float> limited = limit_peaks(scaled(samples, gain_db), speech_rate_hz, amplitude(max_db));
        const double missing_db = speech_lufs - loudness_of(limited).lufs;
        if (std::abs(missing_db) < near_db || round == max_rounds) {
            return limited;
        }
        gain_db += missing_db;
    }
}

/// The sound as Opus, with the length and loudness after decoding.
Result<Speech> stored(std::span<const float> samples) {
    TRY(Bytes opus, encoded(samples));
    TRY(const Recording decoded, read_recording(opus, RecordingSource::File));
    return Speech{std::move(opus), static_cast<double>(decoded.samples.size()) / speech_rate_hz,
                  loudness_of(decoded.samples)};
}

} // namespace

Loudness loudness_of(std::span<const float> samples) {
    struct Destroy {
        void operator()(ebur128_state* state) const { ebur128_destroy(&state); }
    };
    const std::unique_ptr<ebur128_state, Destroy> meter(
        ebur128_init(1, speech_rate_hz, EBUR128_MODE_I | EBUR128_MODE_TRUE_PEAK));
    Loudness loudness{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    if (!meter || samples.empty()) {
        return loudness;
    }
    for (std::size_t fed = 0; fed < std::max(samples.size(), min_measured_samples); fed += samples.size()) {
        ebur128_add_frames_float(meter.get(), samples.data(), samples.size());
    }
    double peak = 0.0;
    ebur128_loudness_global(meter.get(), &loudness.lufs);
    ebur128_true_peak(meter.get(), 0, &peak);
    loudness.true_peak_db = db(peak);
    return loudness;
}

Result<std::optional<Speech>> level_speech(const Recording& recording) {
    TRY(std::vector<float> samples,
        resampled(trimmed(recording.samples, recording.rate_hz), recording.rate_hz));
    const Loudness before = loudness_of(samples);
    if (!std::isfinite(before.lufs)) {
        return std::optional<Speech>();
    }
    double max_db = max_true_peak_db;
    for (int tries = 1; tries <= max_tries; ++tries) {
        TRY(Speech speech, stored(levelled(samples, before.lufs, max_db)));
        // Opus does not preserve peaks exactly, and a sound exceeds its samples between them.
        const double over_db = speech.loudness.true_peak_db - max_true_peak_db;
        if (over_db <= 0.0) {
            return std::optional<Speech>(std::move(speech));
        }
        max_db -= over_db + 0.1 * tries;
    }
    return fail(ErrorKind::Internal, "speech.peak", "the speech cannot be brought below {} dBTP",
                max_true_peak_db);
}

} // namespace frustumscreen::texts
