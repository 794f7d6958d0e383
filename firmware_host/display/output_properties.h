/// The connector properties that make every code and every pixel arrive unaltered.
///
/// Threads  pure.
/// Source   the kernel's "Standard Connector Properties" and Documentation/gpu/kms-properties.csv: "Broadcast
///          RGB" (i915, gma500; vc4 from 6.8 on), "underscan" (amdgpu, radeon, nouveau), margins (vc4),
///          "content type" and "Colorspace" (HDMI; CTA-861 defines what they tell the projector).
#pragma once

#include "firmware_host/display/kms_mode.h"
#include "firmware_host/display/kms_properties.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace frustumscreen::display {

struct PropertySetting {
    std::uint32_t property = 0;
    std::uint64_t value = 0;
    [[nodiscard]] bool operator==(const PropertySetting&) const = default;
};

/// The settings that the driver supports and that do not have their value yet.
[[nodiscard]] std::vector<PropertySetting> exact_picture(std::span<const KmsProperty> connector);

/// A clause for a technician; empty: the range is certain. Only HDMI has two ranges of codes; drivers choose
/// the limited one only for television modes (CTA-861, 5.1). `set`: all settings of `exact_picture` were
/// made.
[[nodiscard]] std::string_view range_in_doubt(std::span<const KmsProperty> connector, bool hdmi,
                                              const ModeTiming& mode, bool set);

} // namespace frustumscreen::display
