/// A device's report of itself: whether it can be used, in one sentence for the person beside it, and the sentence's id.
///
/// Threads  values of fixed size.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/base/sentence.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace frustumscreen {

enum class DeviceHealth : std::uint8_t {
    None,     ///< no device is asked for: there is none, or something stands in for it
    Well,     ///< it is there and works
    Impaired, ///< it is there, and something about it is to be put right
    Away,     ///< it is not there, or cannot be used
};
/// In the order of DeviceHealth.
inline constexpr std::array<std::string_view, 4> device_health_words{"none", "well", "impaired", "away"};
[[nodiscard]] constexpr std::string_view word_of(DeviceHealth health) {
    return device_health_words[static_cast<std::size_t>(health)];
}

/// `id` names the sentence that the device says.
struct DeviceCondition {
    DeviceHealth health = DeviceHealth::None;
    MessageId id = "device.none";
};

/// One of the sentences of a device, and its id.
struct DeviceNote {
    MessageId id;
    std::string_view sentence;
};

struct DeviceState {
    DeviceCondition condition;
    Sentence sentence;
};
[[nodiscard]] inline DeviceState away(const Error& error) {
    return {{DeviceHealth::Away, error.id}, Sentence(error.message)};
}

} // namespace frustumscreen
