// Mutates the contents of a pack and corrects the hashes, sizes and checksums of PNG pictures that would
// reveal it. One mutation in four changes the file itself.
#include "tests/fuzz/fuzz.h"
#include "tests/pack/samples.h"

#include <zlib.h>

#include <algorithm>
#include <exception>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned int seed);

using namespace frustumscreen;

namespace {

/// Maximum growth of a part in one mutation.
constexpr std::size_t growth = 256;

Bytes mutated(Bytes bytes) {
    const std::size_t size = bytes.size();
    bytes.resize(size + growth);
    bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), size, bytes.size()));
    return bytes;
}

std::uint32_t big_endian(std::span<const std::byte> bytes) {
    std::uint32_t value = 0;
    for (const std::byte byte : bytes.first(4)) {
        value = value << 8U | std::to_integer<std::uint32_t>(byte);
    }
    return value;
}

/// Each chunk: length, type, data, CRC over type and data (PNG specification, 5.3).
void right_checksums(Bytes& png) {
    constexpr std::size_t signature_bytes = 8;
    std::span<std::byte> rest(png);
    rest = rest.subspan(std::min(signature_bytes, rest.size()));
    while (rest.size() >= 12) {
        const std::size_t length = big_endian(rest);
        if (length > rest.size() - 12) {
            return;
        }
        const auto* covered = reinterpret_cast<const Bytef*>(rest.data() + 4);
        const auto crc = static_cast<std::uint32_t>(crc32(0, covered, static_cast<uInt>(length + 4)));
        for (unsigned k = 0; k < 4; ++k) {
            rest[8 + length + k] = static_cast<std::byte>(crc >> (24U - 8U * k));
        }
        rest = rest.subspan(12 + length);
    }
}

/// Mutates the manifest's text, or one part, and corrects everything that depends on it.
Bytes with_one_mutation(std::span<const std::byte> pack, unsigned seed) {
    samples::Entries entries = samples::take_apart(Bytes(pack.begin(), pack.end()));
    const std::size_t choice = seed % (entries.parts.size() + 1);
    if (choice == entries.parts.size()) {
        const std::string text = entries.manifest.dump();
        const Bytes manifest = mutated(Bytes(as_bytes(text).begin(), as_bytes(text).end()));
        return samples::put_together(std::string(as_text(manifest)), entries.parts);
    }
    auto& [name, bytes] = entries.parts[choice];
    bytes = mutated(bytes);
    if (name.ends_with(".png")) {
        right_checksums(bytes);
    }
    samples::right_hashes(entries);
    return samples::put_together(entries);
}

} // namespace

std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                    unsigned int seed) {
    if (seed % 4 != 0) {
        try {
            const Bytes pack = with_one_mutation(fuzz::bytes_of(data, size), seed / 4);
            if (pack.size() <= most) {
                std::copy(pack.begin(), pack.end(), reinterpret_cast<std::byte*>(data));
                return pack.size();
            }
        } catch (const std::exception&) { // not a pack any more
            return LLVMFuzzerMutate(data, size, most);
        }
    }
    return LLVMFuzzerMutate(data, size, most);
}
