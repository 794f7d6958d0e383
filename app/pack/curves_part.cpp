#include "app/pack/curves_part.h"

#include "firmware_host/base/byte_reader.h"

#include <array>
#include <cassert>
#include <cstring>

namespace frustumscreen::pack {

namespace {

constexpr std::array<char, 4> curves_magic{'F', 'S', 'C', 'V'};
constexpr std::uint32_t curves_version = 1;
constexpr std::size_t header_bytes = 16;
constexpr std::size_t curve_header_bytes = 8;

void append_curve(Bytes& bytes, const StoredCurve& stored) {
    const world::Curve& curve = stored.curve;
    assert(curve.values.size() == curve.times_s.size() * values_per_key(curve.interpolation));
    append(bytes, static_cast<std::uint16_t>(curve.interpolation));
    append(bytes, stored.components);
    append(bytes, static_cast<std::uint32_t>(curve.times_s.size()));
    append_all(bytes, curve.times_s);
    for (const glm::vec4& value : curve.values) {
        for (int component = 0; component < stored.components; ++component) {
            append(bytes, value[component]);
        }
    }
}

/// `keys_left`: of those that the header announces.
Result<StoredCurve> read_curve(ByteReader& reader, std::size_t number, std::uint32_t& keys_left) {
    if (reader.left() < curve_header_bytes) {
        return bad_input("curves.cut", "it ends before curve {}", number);
    }
    const auto interpolation = reader.read<std::uint16_t>();
    const auto components = reader.read<std::uint16_t>();
    const auto keys = reader.read<std::uint32_t>();
    if (interpolation > static_cast<std::uint16_t>(world::Interpolation::CubicSpline) ||
        (components != 3 && components != 4)) {
        return bad_input(
            "curves.kind",
            "curve {} has interpolation {} and values of {} numbers; allowed are 0 to 2, and 3 or 4", number,
            interpolation, components);
    }
    StoredCurve stored{{static_cast<world::Interpolation>(interpolation), {}, {}}, components};
    const std::size_t values = keys * values_per_key(stored.curve.interpolation);
    if (keys == 0 || keys > keys_left || reader.left() < (keys + values * components) * sizeof(float)) {
        return bad_input("curves.keys",
                         "curve {} claims {} keys; allowed are 1 to {}, and its {} bytes must hold them",
                         number, keys, keys_left, reader.left());
    }
    keys_left -= keys;
    stored.curve.times_s = reader.read_all<float>(keys);
    stored.curve.values.assign(values, glm::vec4(0.0F));
    for (glm::vec4& value : stored.curve.values) {
        for (int component = 0; component < components; ++component) {
            value[component] = reader.read<float>();
        }
    }
    return stored;
}

} // namespace

Bytes encode_curves(std::span<const StoredCurve> curves) {
    std::size_t keys = 0;
    for (const StoredCurve& stored : curves) {
        keys += stored.curve.times_s.size();
    }
    Bytes bytes;
    for (const char c : curves_magic) {
        append(bytes, c);
    }
    append(bytes, curves_version);
    append(bytes, static_cast<std::uint32_t>(curves.size()));
    append(bytes, static_cast<std::uint32_t>(keys));
    for (const StoredCurve& stored : curves) {
        append_curve(bytes, stored);
    }
    return bytes;
}

Result<std::vector<StoredCurve>> decode_curves(std::span<const std::byte> bytes) {
    if (bytes.size() < header_bytes ||
        std::memcmp(bytes.data(), curves_magic.data(), curves_magic.size()) != 0) {
        return bad_input("curves.no_magic", "it does not begin as curves do (FSCV)");
    }
    ByteReader reader(bytes.subspan(curves_magic.size()));
    const auto version = reader.read<std::uint32_t>();
    const auto count = reader.read<std::uint32_t>();
    auto keys = reader.read<std::uint32_t>();
    if (version != curves_version) {
        return bad_input("curves.version", "its curves have version {}, allowed is {}", version,
                         curves_version);
    }
    if (count == 0 || count > world::max_channels || keys > world::max_keys) {
        return bad_input("curves.counts", "it has {} curves with {} keys; allowed are 1 to {}, and {} keys",
                         count, keys, world::max_channels, world::max_keys);
    }
    std::vector<StoredCurve> curves;
    for (std::size_t k = 0; k < count; ++k) {
        TRY(StoredCurve curve, read_curve(reader, k, keys));
        curves.push_back(std::move(curve));
    }
    if (keys != 0 || reader.left() != 0) {
        return bad_input("curves.length", "{} keys are missing and {} bytes are left over", keys,
                         reader.left());
    }
    return curves;
}

} // namespace frustumscreen::pack
