#include "firmware_host/display/kms_route.h"

#include "firmware_host/display/kms_handles.h"

#include <algorithm>

namespace frustumscreen::display {

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

} // namespace frustumscreen::display
