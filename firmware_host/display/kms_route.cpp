#include "firmware_host/display/kms_route.h"

#include "firmware_host/display/kms_handles.h"
#include "firmware_host/display/kms_properties.h"

#include <algorithm>

extern "C" {
#include <drm_fourcc.h>
}

namespace frustumscreen::display {

namespace {

using PlaneList = std::unique_ptr<drmModePlaneRes, decltype(&drmModeFreePlaneResources)>;

bool shows_our_format(const drmModePlane& plane) {
    const std::uint32_t* first = plane.formats;
    const std::uint32_t* end = first + plane.count_formats;
    return std::find(first, end, std::uint32_t{DRM_FORMAT_XRGB8888}) != end;
}

} // namespace

std::vector<KmsCrtc> crtcs_for(int card, std::uint32_t connector_id) {
    std::vector<KmsCrtc> crtcs;
    const KmsResources resources = resources_of(card);
    const KmsConnector connector(drmModeGetConnectorCurrent(card, connector_id), drmModeFreeConnector);
    if (!resources || !connector) {
        return crtcs;
    }
    std::uint32_t possible = 0; // one bit for each CRTC, in the list's order
    std::uint32_t feeding = 0;
    for (int k = 0; k < connector->count_encoders; ++k) {
        if (const KmsEncoder encoder(drmModeGetEncoder(card, connector->encoders[k]), drmModeFreeEncoder);
            encoder) {
            possible |= encoder->possible_crtcs;
            feeding = encoder->encoder_id == connector->encoder_id ? encoder->crtc_id : feeding;
        }
    }
    for (int k = 0; k < resources->count_crtcs; ++k) {
        if (((possible >> static_cast<unsigned>(k)) & 1U) != 0) {
            crtcs.push_back({resources->crtcs[k], k});
        }
    }
    std::stable_partition(crtcs.begin(), crtcs.end(),
                          [feeding](const KmsCrtc& crtc) { return crtc.id == feeding; });
    return crtcs;
}

std::vector<KmsPlane> planes_of(int card) {
    std::vector<KmsPlane> planes;
    const PlaneList list(drmModeGetPlaneResources(card), drmModeFreePlaneResources);
    for (std::uint32_t k = 0; list && k < list->count_planes; ++k) {
        if (KmsPlane plane(drmModeGetPlane(card, list->planes[k]), drmModeFreePlane); plane) {
            planes.push_back(std::move(plane));
        }
    }
    return planes;
}

std::uint32_t primary_plane(int card, const std::vector<KmsPlane>& planes, int crtc_index) {
    for (const KmsPlane& plane : planes) {
        const bool fits = ((plane->possible_crtcs >> static_cast<unsigned>(crtc_index)) & 1U) != 0;
        if (fits && shows_our_format(*plane) &&
            KmsProperties(card, plane->plane_id, DRM_MODE_OBJECT_PLANE).value("type") ==
                DRM_PLANE_TYPE_PRIMARY) {
            return plane->plane_id;
        }
    }
    return 0;
}

} // namespace frustumscreen::display
