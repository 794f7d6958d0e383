/// Which of a connector's properties to set, so that every code and every pixel arrives as it was drawn.
///
/// Threads  pure.
/// Source   the kernel's "Standard Connector Properties" and Documentation/gpu/kms-properties.csv: "Broadcast
///          RGB" (i915, gma500; vc4 from 6.8 on), "underscan" (amdgpu, radeon, nouveau), margins (vc4),
///          "content type" and "Colorspace" (HDMI; CTA-861 has what they tell the projector).
#pragma once

#include "firmware_host/display/kms_mode.h"
#include "firmware_host/display/kms_properties.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace frustumscreen {

struct PropertySetting {
    std::uint32_t property = 0;
    std::uint64_t value = 0;
    [[nodiscard]] bool operator==(const PropertySetting&) const = default;
};

/// The settings that the driver has and that are not in force yet.
[[nodiscard]] std::vector<PropertySetting> exact_picture(std::span<const KmsProperty> connector);

/// A clause for a technician; empty: nothing is in doubt. Only HDMI has two ranges of codes, and the driver
/// chooses the limited one by itself only for a television's mode (CTA-861, 5.1); `set`: what the driver has
/// of `exact_picture` could be set.
[[nodiscard]] std::string_view range_in_doubt(std::span<const KmsProperty> connector, bool hdmi,
                                              const ModeTiming& mode, bool set);

} // namespace frustumscreen
