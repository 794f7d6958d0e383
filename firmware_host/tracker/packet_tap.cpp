#include "firmware_host/tracker/packet_tap.h"

#include "firmware_host/base/byte_reader.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::tracker {

namespace {

struct Layout {
    std::uint32_t model;
    std::uint32_t zero;
    std::array<double, 5> numbers;
};
static_assert(sizeof(Layout) == OpenedDevice::size);

} // namespace

std::array<std::byte, OpenedDevice::size> OpenedDevice::bytes() const {
    const Layout layout{static_cast<std::uint32_t>(model),
                        0,
                        {set_up.hemisphere.x, set_up.hemisphere.y, set_up.hemisphere.z, set_up.table_half_m.x,
                         set_up.table_half_m.y}};
    return std::bit_cast<std::array<std::byte, size>>(layout);
}

std::optional<OpenedDevice> OpenedDevice::from(std::span<const std::byte> bytes) {
    const auto layout = ByteReader(bytes).read<Layout>();
    const auto& numbers = layout.numbers;
    const bool finite =
        std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
    const bool known = layout.model >= static_cast<std::uint32_t>(UsbTrackerModel::Viper) &&
                       layout.model <= static_cast<std::uint32_t>(UsbTrackerModel::SpaceMouse);
    if (bytes.size() != size || !known || !finite) {
        return std::nullopt;
    }
    OpenedDevice opened;
    opened.model = static_cast<UsbTrackerModel>(layout.model);
    opened.set_up.hemisphere = {numbers[0], numbers[1], numbers[2]};
    opened.set_up.table_half_m = glm::abs(glm::dvec2(numbers[3], numbers[4]));
    return opened;
}

} // namespace frustumscreen::tracker
