#include "firmware_host/display/atomic_kms.h"

#include "firmware_host/display/kms_commit.h"
#include "firmware_host/display/kms_handles.h"
#include "firmware_host/display/kms_route.h"

#include <cerrno>
#include <vector>

namespace frustumscreen::display {

namespace {

/// A number of pixels in the plane's fixed point.
std::uint64_t fixed_point(int pixels) {
    return static_cast<std::uint64_t>(pixels) << 16U;
}

/// Shows the framebuffer from its first row on the plane, whatever an earlier program has set there.
void show_on_plane(KmsCommit& commit, const KmsProperties& plane, std::uint32_t crtc,
                   const ScannedOut& shown) {
    const auto number = [](int pixels) { return static_cast<std::uint64_t>(pixels); };
    commit.set(plane, "FB_ID", shown.framebuffer);
    commit.set(plane, "CRTC_ID", crtc);
    commit.set(plane, "SRC_X", 0);
    commit.set(plane, "SRC_Y", 0);
    commit.set(plane, "SRC_W", fixed_point(shown.size.width));
    commit.set(plane, "SRC_H", fixed_point(shown.size.height));
    commit.set(plane, "CRTC_X", number(shown.place.x));
    commit.set(plane, "CRTC_Y", number(shown.place.y));
    commit.set(plane, "CRTC_W", number(shown.place.width));
    commit.set(plane, "CRTC_H", number(shown.place.height));
    commit.reset(plane, "rotation", DRM_MODE_ROTATE_0);
    commit.reset(plane, "alpha", 0xFFFF);
}

} // namespace

AtomicKms::~AtomicKms() {
    forget_mode();
}

void AtomicKms::forget_mode() {
    if (mode_blob_ != 0) {
        drmModeDestroyPropertyBlob(file_, mode_blob_);
        mode_blob_ = 0;
    }
}

std::optional<AtomicKms::Route> AtomicKms::route_to(std::uint32_t connector) const {
    const std::vector<KmsPlane> planes = planes_of(file_);
    for (const KmsCrtc& crtc : crtcs_for(file_, connector)) {
        if (card_.has_leased(crtc.id)) {
            continue;
        }
        if (const std::uint32_t plane = primary_plane(file_, planes, crtc.index); plane != 0) {
            const KmsProperties properties(file_, plane, DRM_MODE_OBJECT_PLANE);
            const auto number_of = [&properties](std::string_view name) {
                const KmsProperty* property = properties.find(name);
                return property != nullptr ? property->id : 0;
            };
            return Route{.connector = connector,
                         .crtc = crtc.id,
                         .plane = plane,
                         .plane_framebuffer = number_of("FB_ID"),
                         .plane_row = number_of("SRC_Y")};
        }
    }
    return std::nullopt;
}

KmsAnswer AtomicKms::light(std::uint32_t connector, const ModeTiming& mode, const ScannedOut& shown,
                           std::uint64_t ticket) {
    const std::optional<Route> route = route_to(connector);
    const drmModeModeInfo info = mode_info(mode);
    std::uint32_t blob = 0;
    if (!route || drmModeCreatePropertyBlob(file_, &info, sizeof info, &blob) != 0) {
        return answer_for_missing_object(file_);
    }
    forget_mode(); // the kernel keeps the current mode alive
    mode_blob_ = blob;
    const KmsProperties properties(file_, connector, DRM_MODE_OBJECT_CONNECTOR);
    const std::vector<PropertySetting> settings = exact_picture(properties.all());
    KmsAnswer answer = light(*route, shown, ticket, settings);
    const bool set = answer != KmsAnswer::Refused || settings.empty();
    if (!set) {
        answer = light(*route, shown, ticket, {}); // a lit screen is worth more than an exact picture
    }
    if (answer == KmsAnswer::Done) {
        route_ = route;
        flips_.expect_of(route->crtc);
        shortcoming_ = range_in_doubt(properties.all(), is_hdmi(file_, connector), mode, set);
    }
    return answer;
}

KmsAnswer AtomicKms::light(const Route& route, const ScannedOut& shown, std::uint64_t ticket,
                           std::span<const PropertySetting> settings) const {
    const KmsResources resources = resources_of(file_);
    if (!resources) {
        return kms_answer(-errno);
    }
    KmsCommit commit(file_);
    for (int k = 0; k < resources->count_connectors; ++k) {
        const KmsProperties connector(file_, resources->connectors[k], DRM_MODE_OBJECT_CONNECTOR);
        if (connector.object() != route.connector) {
            if (!card_.has_leased(connector.object())) {
                commit.reset(connector, "CRTC_ID", 0);
            }
            continue;
        }
        commit.set(connector, "CRTC_ID", route.crtc);
        commit.reset(connector, "link-status", 0); // 0 = good; makes the kernel train the link again
        for (const PropertySetting& setting : settings) {
            commit.set(connector.object(), setting.property, setting.value);
        }
    }
    for (int k = 0; k < resources->count_crtcs; ++k) {
        const KmsProperties crtc(file_, resources->crtcs[k], DRM_MODE_OBJECT_CRTC);
        if (crtc.object() == route.crtc) {
            commit.set(crtc, "MODE_ID", mode_blob_);
            commit.set(crtc, "ACTIVE", 1);
            for (const std::string_view colours : {"GAMMA_LUT", "DEGAMMA_LUT", "CTM", "VRR_ENABLED"}) {
                commit.reset(crtc, colours, 0);
            }
        } else if (crtc.value("ACTIVE") != 0 && !card_.has_leased(crtc.object())) {
            commit.turn_off_crtc(crtc);
        }
    }
    for (const KmsPlane& plane : planes_of(file_)) {
        const KmsProperties properties(file_, plane->plane_id, DRM_MODE_OBJECT_PLANE);
        if (plane->plane_id == route.plane) {
            show_on_plane(commit, properties, route.crtc, shown);
        } else if (properties.value("CRTC_ID") != 0 && !card_.has_leased(plane->plane_id)) {
            commit.turn_off_plane(properties);
        }
    }
    return commit.send(DRM_MODE_ATOMIC_ALLOW_MODESET | DRM_MODE_PAGE_FLIP_EVENT, ticket);
}

KmsAnswer AtomicKms::flip(FramebufferId shown, std::uint64_t ticket) {
    if (!route_) {
        return KmsAnswer::Refused;
    }
    KmsCommit commit(file_);
    commit.set(route_->plane, route_->plane_framebuffer, shown);
    return commit.send(DRM_MODE_PAGE_FLIP_EVENT, ticket);
}

KmsAnswer AtomicKms::flip_from(int first_row, FramebufferId shown, std::uint64_t ticket) {
    if (!route_) {
        return KmsAnswer::Refused;
    }
    KmsCommit commit(file_);
    commit.set(route_->plane, route_->plane_framebuffer, shown);
    commit.set(route_->plane, route_->plane_row, fixed_point(first_row));
    return commit.send(DRM_MODE_PAGE_FLIP_EVENT, ticket);
}

KmsAnswer AtomicKms::darken() {
    if (!route_) {
        return KmsAnswer::Done;
    }
    KmsCommit commit(file_);
    commit.turn_off_plane(KmsProperties(file_, route_->plane, DRM_MODE_OBJECT_PLANE));
    commit.turn_off_crtc(KmsProperties(file_, route_->crtc, DRM_MODE_OBJECT_CRTC));
    commit.set(KmsProperties(file_, route_->connector, DRM_MODE_OBJECT_CONNECTOR), "CRTC_ID", 0);
    const KmsAnswer answer = commit.send(DRM_MODE_ATOMIC_ALLOW_MODESET, 0);
    if (answer == KmsAnswer::Done) {
        route_.reset();
    }
    return answer;
}

} // namespace frustumscreen::display
