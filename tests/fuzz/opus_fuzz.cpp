// Ogg Opus recordings: refused in one line, or within the allowed length, with marks inside the recording.
#include "firmware_host/sound/mixer.h"
#include "firmware_host/sound/opus_reader.h"
#include "firmware_host/sound/pauses.h"
#include "tests/fuzz/fuzz.h"

#include <algorithm>

using namespace frustumscreen;

namespace {

constexpr sound::OpusLimits limits{std::chrono::seconds(1)}; ///< keeps the fuzzer quick

void check(std::span<const std::byte> bytes) {
    const Result<sound::Prompt> prompt = sound::read_opus(bytes, limits);
    if (!prompt) {
        fuzz::require_one_line(prompt.error().message);
        return;
    }
    fuzz::require(!prompt->samples.empty() && prompt->samples.size() <= sound::samples_in(limits.longest),
                  "a recording has samples, no more than allowed");
    std::uint32_t last = 0;
    for (const sound::Mark& mark : sound::find_pauses(prompt->samples)) {
        fuzz::require(mark.begin >= last && mark.begin <= mark.end, "marks ascend");
        fuzz::require(mark.end + sound::Mixer::fade_samples <= prompt->samples.size(),
                      "a fade fits behind a mark");
        last = mark.end;
    }
}

/// RFC 3533: polynomial 0x04c11db7, most significant bit first, over the page with its own checksum as 0.
std::uint32_t checksum(std::span<const std::byte> page) {
    std::uint32_t sum = 0;
    for (const std::byte byte : page) {
        sum ^= std::to_integer<std::uint32_t>(byte) << 24U;
        for (int bit = 0; bit < 8; ++bit) {
            sum = (sum << 1U) ^ ((sum >> 31U) != 0 ? 0x04c11db7U : 0U);
        }
    }
    return sum;
}

/// Corrects the checksum of each page; otherwise no altered page would get past it.
std::vector<std::byte> with_checksums(std::span<const std::byte> bytes) {
    constexpr std::size_t header = 27;
    constexpr std::size_t checksum_at = 22;
    const std::string_view capture = "OggS";
    std::vector<std::byte> file(bytes.begin(), bytes.end());
    for (std::size_t at = 0; at + header <= file.size();) {
        const bool begins = std::equal(capture.begin(), capture.end(), file.begin() + static_cast<long>(at),
                                       [](char c, std::byte b) { return std::byte(c) == b; });
        if (!begins) {
            ++at;
            continue;
        }
        const std::size_t segments = std::to_integer<std::size_t>(file[at + header - 1]);
        std::size_t length = header + segments;
        for (std::size_t k = 0; k < segments && at + header + k < file.size(); ++k) {
            length += std::to_integer<std::size_t>(file[at + header + k]);
        }
        length = std::min(length, file.size() - at);
        const std::span<std::byte> page = std::span(file).subspan(at, length);
        std::fill_n(page.begin() + checksum_at, 4, std::byte(0));
        const std::uint32_t sum = checksum(page);
        for (std::size_t k = 0; k < 4; ++k) {
            page[checksum_at + k] = std::byte(sum >> (8 * k) & 0xffU);
        }
        at += length;
    }
    return file;
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span<const std::byte> bytes = fuzz::bytes_of(data, size);
    check(bytes);
    check(with_checksums(bytes));
    return 0;
}
