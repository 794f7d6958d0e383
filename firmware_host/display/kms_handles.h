/// Owners of libdrm's mode objects, and our ModeTiming converted to and from the kernel's.
#pragma once

#include "firmware_host/display/kms_device.h"

#include <memory>

extern "C" {
#include <xf86drm.h>
#include <xf86drmMode.h>
}

namespace frustumscreen {

using KmsResources = std::unique_ptr<drmModeRes, decltype(&drmModeFreeResources)>;
using KmsConnector = std::unique_ptr<drmModeConnector, decltype(&drmModeFreeConnector)>;
using KmsEncoder = std::unique_ptr<drmModeEncoder, decltype(&drmModeFreeEncoder)>;

[[nodiscard]] inline KmsResources resources_of(int card) {
    return {drmModeGetResources(card), drmModeFreeResources};
}

/// What the kernel gives back with a flip; it is no address.
[[nodiscard]] inline void* bits_given_back(std::uint64_t ticket) {
    return reinterpret_cast<void*>(ticket); // NOLINT(performance-no-int-to-ptr)
}
[[nodiscard]] bool is_hdmi(int card, std::uint32_t connector);
/// The answer for a call's negative error number; 0 = done.
[[nodiscard]] KmsAnswer kms_answer(int status);
/// The answer where something that is needed was not found on the card: it lacks that, or it is gone.
[[nodiscard]] KmsAnswer answer_to_a_lack(int card);
[[nodiscard]] ModeTiming timing_of(const drmModeModeInfo& mode);
[[nodiscard]] drmModeModeInfo mode_info(const ModeTiming& timing);

} // namespace frustumscreen
