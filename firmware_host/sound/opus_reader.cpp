#include "firmware_host/sound/opus_reader.h"

#include "firmware_host/base/file.h"

#include <fmt/format.h>
#include <opusfile.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace frustumscreen::sound {

namespace {

struct CloseFile {
    void operator()(OggOpusFile* file) const { ::op_free(file); }
};
using OpusFile = std::unique_ptr<OggOpusFile, CloseFile>;

constexpr int max_channels = 2;
constexpr std::size_t longest_packet = 5760; ///< samples per channel: 120 ms, RFC 6716

std::string_view reason(int error) {
    switch (error) {
    case OP_ENOTFORMAT:
        return "this is not an Ogg Opus recording; store it as Opus";
    case OP_EVERSION:
    case OP_EIMPL:
        return "this kind of Opus recording is not known; store it as Opus with one or two channels";
    case OP_EFAULT:
        return "there is not enough memory for it";
    default:
        return "this Opus recording is damaged; make it again";
    }
}

tl::unexpected<Error> refused(int error) {
    return bad_input("opus.library", "{} (libopusfile: {})", reason(error), error);
}

tl::unexpected<Error> too_long(const OpusLimits& limits) {
    return bad_input("opus.too_long", "the recording is longer than {} s; shorten it, or divide it",
                     std::chrono::duration_cast<std::chrono::seconds>(limits.longest).count());
}

/// Number of pages that begin a stream (RFC 3533, 'Beginning of stream'), anywhere in the file. libopusfile
/// 0.12 leaks memory for each damaged stream after the first, so further streams are refused.
std::size_t streams_in(std::span<const std::byte> bytes) {
    constexpr std::string_view capture = "OggS";
    constexpr std::size_t flags_at = 5;
    constexpr std::byte begins_stream{2};
    const std::string_view text = as_text(bytes);
    std::size_t streams = 0;
    for (std::size_t at = text.find(capture); at != text.npos; at = text.find(capture, at + 1)) {
        const bool begins =
            at + flags_at < bytes.size() && (bytes[at + flags_at] & begins_stream) != std::byte(0);
        streams += begins ? 1 : 0;
    }
    return streams;
}

std::int16_t code_of(float x) {
    const float held = std::isfinite(x) ? std::clamp(x * 32768.0F, -32768.0F, 32767.0F) : 0.0F;
    return static_cast<std::int16_t>(std::lrint(held));
}

} // namespace

Result<Prompt> read_opus(std::span<const std::byte> bytes, const OpusLimits& limits) {
    if (streams_in(bytes) > 1) {
        return bad_input("opus.several",
                         "the file holds more than one recording; store each in a file of its own");
    }
    int error = 0;
    const OpusFile file(
        ::op_open_memory(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), &error));
    if (!file) {
        return refused(error);
    }
    const int channels = ::op_channel_count(file.get(), 0);
    if (channels > max_channels) {
        return bad_input("opus.channels", "the recording has {} channels; store it with one or two",
                         channels);
    }
    const ogg_int64_t claimed = ::op_pcm_total(file.get(), -1);
    if (claimed < 0) {
        return refused(static_cast<int>(claimed));
    }
    const std::uint64_t most = samples_in(limits.longest);
    if (static_cast<std::uint64_t>(claimed) > most) {
        return too_long(limits);
    }
    Prompt prompt;
    prompt.samples.reserve(static_cast<std::size_t>(claimed));
    std::array<float, longest_packet * max_channels> packet{};
    for (;;) {
        const int read = ::op_read_float(file.get(), packet.data(), static_cast<int>(packet.size()), nullptr);
        if (read == 0) {
            break;
        }
        if (read < 0) {
            return refused(read);
        }
        const auto count = static_cast<std::size_t>(read);
        if (prompt.samples.size() + count > most) {
            return too_long(limits);
        }
        for (std::size_t k = 0; k < count; ++k) {
            prompt.samples.push_back(
                code_of(channels == 2 ? 0.5F * (packet[2 * k] + packet[2 * k + 1]) : packet[k]));
        }
    }
    if (prompt.samples.empty()) {
        return bad_input("opus.empty", "the recording is empty; record it again");
    }
    return prompt;
}

} // namespace frustumscreen::sound
