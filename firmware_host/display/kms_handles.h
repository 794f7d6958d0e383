/// Owning handles of libdrm's mode objects, and the conversion between ModeTiming and the kernel's timing.
#pragma once

#include "firmware_host/display/kms_device.h"

#include <memory>
#include <string>

extern "C" {
#include <xf86drm.h>
#include <xf86drmMode.h>
}

namespace frustumscreen::display {

using KmsResources = std::unique_ptr<drmModeRes, decltype(&drmModeFreeResources)>;
using KmsConnector = std::unique_ptr<drmModeConnector, decltype(&drmModeFreeConnector)>;
using KmsEncoder = std::unique_ptr<drmModeEncoder, decltype(&drmModeFreeEncoder)>;

[[nodiscard]] inline KmsResources resources_of(int card) {
    return {drmModeGetResources(card), drmModeFreeResources};
}

/// The ticket as user data of a flip event; it is not an address.
[[nodiscard]] inline void* user_data_of(std::uint64_t ticket) {
    return reinterpret_cast<void*>(ticket); // NOLINT(performance-no-int-to-ptr)
}
/// The kernel's name, such as "HDMI-A-1".
[[nodiscard]] std::string connector_name(const drmModeConnector& connector);
[[nodiscard]] bool is_hdmi(int card, std::uint32_t connector);
/// The answer for the negative error number of a call; 0 = done.
[[nodiscard]] KmsAnswer kms_answer(int status);
/// The answer if a required object was not found: the card lacks it, or the card is gone.
[[nodiscard]] KmsAnswer answer_for_missing_object(int card);
[[nodiscard]] ModeTiming timing_of(const drmModeModeInfo& mode);
[[nodiscard]] drmModeModeInfo mode_info(const ModeTiming& timing);

} // namespace frustumscreen::display
