#include "firmware_host/display/kms_handles.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>

namespace frustumscreen::display {

std::string connector_name(const drmModeConnector& connector) {
    const char* kind = drmModeGetConnectorTypeName(connector.connector_type);
    return fmt::format("{}-{}", kind != nullptr ? kind : "Unknown", connector.connector_type_id);
}

bool is_hdmi(int card, std::uint32_t connector_id) {
    const KmsConnector connector(drmModeGetConnectorCurrent(card, connector_id), drmModeFreeConnector);
    return connector && (connector->connector_type == DRM_MODE_CONNECTOR_HDMIA ||
                         connector->connector_type == DRM_MODE_CONNECTOR_HDMIB);
}

KmsAnswer kms_answer(int status) {
    switch (status) {
    case 0:
        return KmsAnswer::Done;
    case -EBUSY:
    case -EINTR:
    case -EAGAIN:
        return KmsAnswer::Busy;
    case -EACCES:
    case -EPERM:
        return KmsAnswer::NotMaster;
    case -ENODEV:
    case -ENXIO:
    case -EIO:
        return KmsAnswer::Gone;
    default:
        return KmsAnswer::Refused;
    }
}

KmsAnswer answer_for_missing_object(int card) {
    return resources_of(card) ? KmsAnswer::Refused : kms_answer(-errno);
}

ModeTiming timing_of(const drmModeModeInfo& mode) {
    ModeTiming timing;
    timing.clock_khz = mode.clock;
    timing.width = mode.hdisplay;
    timing.hsync_start = mode.hsync_start;
    timing.hsync_end = mode.hsync_end;
    timing.htotal = mode.htotal;
    timing.hskew = mode.hskew;
    timing.height = mode.vdisplay;
    timing.vsync_start = mode.vsync_start;
    timing.vsync_end = mode.vsync_end;
    timing.vtotal = mode.vtotal;
    timing.vscan = mode.vscan;
    timing.flags = mode.flags;
    timing.preferred = (mode.type & DRM_MODE_TYPE_PREFERRED) != 0;
    return timing;
}

drmModeModeInfo mode_info(const ModeTiming& timing) {
    drmModeModeInfo mode{};
    mode.clock = timing.clock_khz;
    mode.hdisplay = timing.width;
    mode.hsync_start = timing.hsync_start;
    mode.hsync_end = timing.hsync_end;
    mode.htotal = timing.htotal;
    mode.hskew = timing.hskew;
    mode.vdisplay = timing.height;
    mode.vsync_start = timing.vsync_start;
    mode.vsync_end = timing.vsync_end;
    mode.vtotal = timing.vtotal;
    mode.vscan = timing.vscan;
    mode.flags = timing.flags;
    mode.vrefresh = static_cast<std::uint32_t>(std::lround(refresh_hz(timing)));
    mode.type = DRM_MODE_TYPE_USERDEF;
    return mode;
}

} // namespace frustumscreen::display
