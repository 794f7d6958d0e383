#include "app/pack/colours_part.h"

#include "app/pack/corner_planes.h"

#include <array>
#include <cassert>
#include <cstring>

namespace frustumscreen::pack {

namespace {

constexpr std::array<char, 4> colours_magic{'F', 'S', 'R', 'L'};
constexpr std::uint32_t colours_version = 1;
constexpr std::size_t header_bytes = 12;
constexpr int channels = 4;

} // namespace

Bytes encode_colours(std::span<const glm::u8vec4> colours) {
    assert(colours.size() % plane_corners == 0);
    const std::size_t blocks = colours.size() / plane_corners;
    Bytes bytes;
    bytes.reserve(header_bytes + channels * colours.size());
    for (const char c : colours_magic) {
        append(bytes, c);
    }
    append(bytes, colours_version);
    append(bytes, static_cast<std::uint32_t>(blocks));
    for (int channel = 0; channel < channels; ++channel) {
        for (std::size_t k = 0; k < blocks; ++k) {
            Plane values{};
            for (std::size_t corner = 0; corner < plane_corners; ++corner) {
                values.at(corner) = colours[k * plane_corners + corner][channel];
            }
            append_plane(bytes, values);
        }
    }
    return bytes;
}

Result<std::vector<glm::u8vec4>> decode_colours(std::span<const std::byte> bytes, std::size_t corners) {
    if (bytes.size() < header_bytes ||
        std::memcmp(bytes.data(), colours_magic.data(), colours_magic.size()) != 0) {
        return bad_input("colours.no_magic", "it does not begin as the colours of a layer do (FSRL)");
    }
    ByteReader reader(bytes.subspan(colours_magic.size()));
    if (const auto version = reader.read<std::uint32_t>(); version != colours_version) {
        return bad_input("colours.version", "its colours have version {}, allowed is {}", version,
                         colours_version);
    }
    const std::size_t blocks = reader.read<std::uint32_t>();
    if (blocks * plane_corners != corners || bytes.size() - header_bytes != channels * corners) {
        return bad_input("colours.size",
                         "it has {} blocks and {} bytes, for a relief of {} corners; bake the pack again",
                         blocks, bytes.size(), corners);
    }
    std::vector<glm::u8vec4> colours(corners);
    for (int channel = 0; channel < channels; ++channel) {
        for (std::size_t k = 0; k < blocks; ++k) {
            const Plane values = read_plane(reader);
            for (std::size_t corner = 0; corner < plane_corners; ++corner) {
                colours[k * plane_corners + corner][channel] = values.at(corner);
            }
        }
    }
    return colours;
}

} // namespace frustumscreen::pack
