#include "firmware_host/tracker/patriot_codec.h"

#include "firmware_host/base/byte_reader.h"

#include <algorithm>

namespace frustumscreen::tracker {

namespace {

constexpr std::size_t header_bytes = 8;
constexpr std::size_t payload_bytes = 40;
constexpr std::size_t whole_bytes = header_bytes + payload_bytes;
constexpr double metres_per_centimetre = 0.01;
constexpr std::array<std::array<char, 2>, 3> tags{{{'P', 'A'}, {'L', 'Y'}, {'L', 'U'}}};

/// Whether the available bytes may begin a header. Checks every field with a known value.
bool may_be_header(std::span<const std::byte> stream) {
    const auto at = [&](std::size_t k) { return static_cast<unsigned>(stream[k]); };
    const bool tag = std::any_of(tags.begin(), tags.end(), [&](const std::array<char, 2>& letters) {
        return at(0) == static_cast<unsigned>(letters[0]) &&
               (stream.size() < 2 || at(1) == static_cast<unsigned>(letters[1]));
    });
    return tag && (stream.size() < 3 || (at(2) >= 1 && at(2) <= DeviceFrame::max_sensors)) &&
           (stream.size() < 4 || at(3) == 'C' || at(3) == 'P') &&
           (stream.size() < 7 || at(6) == payload_bytes) && (stream.size() < 8 || at(7) == 0);
}

PatriotStep refuse(std::span<const std::byte> stream, DiscardReason refusal) {
    std::size_t next = 1;
    while (next < stream.size() && !may_be_header(stream.subspan(next))) {
        ++next;
    }
    return {next, refusal};
}

} // namespace

PatriotStep parse_patriot(std::span<const std::byte> stream) {
    if (stream.empty()) {
        return {};
    }
    if (!may_be_header(stream)) {
        return refuse(stream, DiscardReason::Garbage);
    }
    if (stream.size() < whole_bytes) {
        return {};
    }
    ByteReader reader(stream.subspan(header_bytes, payload_bytes));
    DeviceFrame frame;
    frame.tick = reader.read<std::uint32_t>();
    frame.counter = reader.read<std::uint32_t>();
    const auto distortion = reader.read<std::int32_t>();
    std::array<double, 7> numbers{};
    for (double& number : numbers) {
        number = static_cast<double>(reader.read<float>());
    }
    SensorPose& pose = frame.sensors[0];
    frame.count = 1;
    pose.sensor = static_cast<int>(stream[2]);
    pose.position_m = glm::dvec3(numbers[0], numbers[1], numbers[2]) * metres_per_centimetre;
    pose.rotation = glm::dquat(numbers[3], numbers[4], numbers[5], numbers[6]);
    pose.distortion = std::clamp(distortion, 0, 255);
    const bool good = stream[4] == std::byte{' '};
    pose.usable = good && is_pose(pose.position_m, pose.rotation);
    if (good && !pose.usable) { // a good frame never has such a pose: bytes were lost or changed
        return refuse(stream, DiscardReason::Content);
    }
    return {whole_bytes, frame};
}

std::optional<int> patriot_units_answer(std::string_view text) {
    while (true) {
        const std::size_t end = text.find_first_of("\r\n");
        if (end == std::string_view::npos) {
            return std::nullopt;
        }
        std::string_view line = text.substr(0, end);
        text.remove_prefix(end + 1);
        line.remove_prefix(std::min(line.find_first_not_of(" 0123456789"), line.size()));
        if (line.empty() || line.front() != 'U') {
            continue;
        }
        const std::size_t digit = line.find_first_not_of(' ', 1);
        const bool only = digit != std::string_view::npos &&
                          line.find_first_not_of(' ', digit + 1) == std::string_view::npos;
        if (only && (line[digit] == '0' || line[digit] == '1')) {
            return line[digit] - '0';
        }
    }
}

} // namespace frustumscreen::tracker
