// Corrects the checksums of a mutated recording, three times in four.
#include "firmware_host/tracker/crc.h"
#include "tests/fuzz/fuzz.h"

#include <cstring>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned int seed);

std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                    unsigned int seed) {
    constexpr std::size_t header_bytes = 16;
    constexpr std::size_t head_bytes = 16;
    size = LLVMFuzzerMutate(data, size, most);
    std::size_t at = header_bytes;
    while (seed % 4 != 0 && at + head_bytes + sizeof(std::uint32_t) <= size) {
        std::uint32_t payload = 0;
        std::memcpy(&payload, data + at, sizeof(payload));
        const std::size_t left = size - at - head_bytes - sizeof(std::uint32_t);
        if (payload > left) { // limits the last packet to the remaining bytes
            payload = static_cast<std::uint32_t>(left);
            std::memcpy(data + at, &payload, sizeof(payload));
        }
        const std::size_t covered = head_bytes + payload;
        const std::uint32_t crc = frustumscreen::crc32_ieee(std::as_bytes(std::span(data + at, covered)));
        std::memcpy(data + at + covered, &crc, sizeof(crc));
        at += covered + sizeof(crc);
    }
    return size;
}
