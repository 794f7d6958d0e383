#include "firmware_host/tracker/space_mouse_codec.h"

#include "firmware_host/base/byte_reader.h"

namespace frustumscreen::tracker {

namespace {

constexpr std::uint8_t push_report = 1;
constexpr std::uint8_t turn_report = 2;
constexpr std::size_t three_axes_bytes = 1 + 3 * sizeof(std::int16_t);
constexpr std::size_t six_axes_bytes = 1 + 6 * sizeof(std::int16_t);

glm::dvec3 read_axes(ByteReader& reader) {
    const double x = reader.read<std::int16_t>();
    const double y = reader.read<std::int16_t>();
    const double z = reader.read<std::int16_t>();
    return {x, -y, -z};
}

} // namespace

SpaceMouseMessage parse_space_mouse(std::span<const std::byte> report) {
    ByteReader reader(report);
    const auto id = reader.read<std::uint8_t>();
    if (!reader.ok()) {
        return DiscardReason::Length;
    }
    SpaceMouseMotion motion;
    if (id == push_report && report.size() == six_axes_bytes) {
        motion.push = read_axes(reader);
        motion.turn = read_axes(reader);
    } else if (id == push_report && report.size() == three_axes_bytes) {
        motion.push = read_axes(reader);
    } else if (id == turn_report && report.size() == three_axes_bytes) {
        motion.turn = read_axes(reader);
    } else if (id == push_report || id == turn_report) {
        return DiscardReason::Length;
    } else {
        return SpaceMouseOther{};
    }
    return motion;
}

} // namespace frustumscreen::tracker
