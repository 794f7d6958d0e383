#include "firmware_host/display/legacy_kms.h"

#include "firmware_host/display/kms_handles.h"
#include "firmware_host/display/kms_route.h"
#include "firmware_host/display/output_properties.h"

#include <vector>

namespace frustumscreen::display {

namespace {

KmsAnswer turn_off(int card, std::uint32_t crtc) {
    return kms_answer(drmModeSetCrtc(card, crtc, 0, 0, 0, nullptr, 0, nullptr));
}

/// Makes the picture arrive unaltered; returns false if the driver refused a setting.
bool set_properties(int card, const KmsProperties& connector) {
    bool all = true;
    for (const PropertySetting& setting : exact_picture(connector.all())) {
        all = drmModeObjectSetProperty(card, connector.object(), DRM_MODE_OBJECT_CONNECTOR, setting.property,
                                       setting.value) == 0 &&
              all;
    }
    return all;
}

} // namespace

/// Shows a framebuffer only without scaling, and of a higher one its first rows. The connector's first CRTC is used;
/// all others that are not leased are turned off first, because they may hold resources that this mode needs.
KmsAnswer LegacyKms::light(std::uint32_t connector, const ModeTiming& mode, const ScannedOut& shown,
                           std::uint64_t ticket) {
    const PixelSize screen{mode.width, mode.height};
    std::vector<KmsCrtc> crtcs = crtcs_for(file_, connector);
    std::erase_if(crtcs, [this](const KmsCrtc& crtc) { return card_.has_leased(crtc.id); });
    if (crtcs.empty()) {
        return answer_for_missing_object(file_);
    }
    if (!(shown.size == screen)) {
        return KmsAnswer::Refused;
    }
    const std::uint32_t crtc = crtcs.front().id;
    const KmsResources resources = resources_of(file_);
    for (int k = 0; resources && k < resources->count_crtcs; ++k) {
        if (resources->crtcs[k] != crtc && !card_.has_leased(resources->crtcs[k])) {
            static_cast<void>(turn_off(file_, resources->crtcs[k]));
        }
    }
    const KmsProperties properties(file_, connector, DRM_MODE_OBJECT_CONNECTOR);
    const bool set = set_properties(file_, properties);
    drmModeModeInfo info = mode_info(mode);
    const KmsAnswer answer =
        kms_answer(drmModeSetCrtc(file_, crtc, shown.framebuffer, 0, 0, &connector, 1, &info));
    if (answer == KmsAnswer::Done) {
        crtc_ = crtc;
        shortcoming_ = range_in_doubt(properties.all(), is_hdmi(file_, connector), mode, set);
        flips_.expect_of(crtc);
        flips_.add({.time = monotonic_now(), .ticket = ticket});
    }
    return answer;
}

KmsAnswer LegacyKms::flip(FramebufferId shown, std::uint64_t ticket) {
    if (crtc_ == 0) {
        return KmsAnswer::Refused;
    }
    return kms_answer(drmModePageFlip(file_, crtc_, shown, DRM_MODE_PAGE_FLIP_EVENT, user_data_of(ticket)));
}

KmsAnswer LegacyKms::darken() {
    const KmsAnswer answer = crtc_ != 0 ? turn_off(file_, crtc_) : KmsAnswer::Done;
    crtc_ = answer == KmsAnswer::Done ? 0 : crtc_;
    return answer;
}

} // namespace frustumscreen::display
