#include "firmware_host/display/kms_lease.h"

#include "firmware_host/display/kms_card.h"
#include "firmware_host/display/kms_commit.h"
#include "firmware_host/display/kms_handles.h"
#include "firmware_host/display/kms_route.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>

namespace frustumscreen::display {

namespace {

struct Found {
    std::uint32_t wanted = 0; ///< connectors; 0: the card lacks it
    std::uint32_t stays = 0;
    std::string names; ///< of all
};

Found find_connectors(int card, std::string_view wanted, std::string_view stays) {
    Found found;
    const KmsResources resources = resources_of(card);
    for (int k = 0; resources && k < resources->count_connectors; ++k) {
        const KmsConnector connector(drmModeGetConnectorCurrent(card, resources->connectors[k]),
                                     drmModeFreeConnector);
        if (!connector) {
            continue;
        }
        const std::string name = connector_name(*connector);
        found.names += (found.names.empty() ? "" : ", ") + name;
        if (name == wanted) {
            found.wanted = connector->connector_id;
        } else if (name == stays) {
            found.stays = connector->connector_id;
        }
    }
    return found;
}

/// CRTCs that can show the exhibit's pixels on the connector.
std::vector<KmsCrtc> usable_crtcs(const KmsCard& card, std::uint32_t connector,
                                  const std::vector<KmsPlane>& planes) {
    std::vector<KmsCrtc> crtcs = crtcs_for(card.file(), connector);
    if (card.is_atomic()) {
        std::erase_if(
            crtcs, [&](const KmsCrtc& crtc) { return primary_plane(card.file(), planes, crtc.index) == 0; });
    }
    return crtcs;
}

/// A CRTC that leaves another one for the connector that stays; if possible not the one that feeds that connector.
std::optional<KmsCrtc> choose_crtc(const std::vector<KmsCrtc>& wanted, const std::vector<KmsCrtc>& stays) {
    const auto leaves_one = [&stays](const KmsCrtc& taken) {
        return stays.empty() || std::any_of(stays.begin(), stays.end(),
                                            [&](const KmsCrtc& other) { return other.id != taken.id; });
    };
    std::optional<KmsCrtc> chosen;
    for (const KmsCrtc& crtc : wanted) {
        const bool feeds_other = !stays.empty() && stays.front().id == crtc.id;
        if (leaves_one(crtc) && (!chosen || !feeds_other)) {
            chosen = crtc;
            if (!feeds_other) {
                break;
            }
        }
    }
    return chosen;
}

std::uint32_t crtc_of(int card, std::uint32_t connector) {
    const KmsConnector seen(drmModeGetConnectorCurrent(card, connector), drmModeFreeConnector);
    const KmsEncoder encoder(seen ? drmModeGetEncoder(card, seen->encoder_id) : nullptr, drmModeFreeEncoder);
    return encoder ? encoder->crtc_id : 0;
}

/// Turns off what an earlier program shows with the lease's connector or CRTC. The connector that stays keeps its picture,
/// unless that comes from the lease's CRTC.
void turn_off(const KmsCard& card, std::uint32_t connector, std::uint32_t leased_crtc,
              std::uint32_t kept_crtc, const std::vector<KmsPlane>& planes) {
    const int file = card.file();
    const std::uint32_t feeding = crtc_of(file, connector);
    const auto goes_off = [&](std::uint32_t crtc) {
        return crtc != 0 && (crtc == leased_crtc || (crtc == feeding && crtc != kept_crtc));
    };
    KmsCommit commit(file);
    const KmsResources resources = resources_of(file);
    for (int k = 0; resources && k < resources->count_connectors; ++k) {
        const std::uint32_t one = resources->connectors[k];
        if (one == connector || goes_off(crtc_of(file, one))) {
            commit.reset(KmsProperties(file, one, DRM_MODE_OBJECT_CONNECTOR), "CRTC_ID", 0);
        }
    }
    for (int k = 0; resources && k < resources->count_crtcs; ++k) {
        const KmsProperties crtc(file, resources->crtcs[k], DRM_MODE_OBJECT_CRTC);
        if (goes_off(crtc.object()) && crtc.value("ACTIVE") != 0) {
            commit.turn_off_crtc(crtc);
        }
    }
    for (const KmsPlane& plane : planes) {
        if (goes_off(plane->crtc_id)) {
            commit.turn_off_plane(KmsProperties(file, plane->plane_id, DRM_MODE_OBJECT_PLANE));
        }
    }
    if (!commit.empty()) { // refused: lighting the output turns it off too
        static_cast<void>(commit.send(DRM_MODE_ATOMIC_ALLOW_MODESET, 0));
    }
}

std::vector<std::uint32_t> objects_of(const KmsCard& card, std::uint32_t connector, const KmsCrtc& crtc,
                                      const std::vector<KmsPlane>& planes) {
    std::vector<std::uint32_t> objects{connector, crtc.id};
    const std::uint32_t primary = primary_plane(card.file(), planes, crtc.index);
    for (const KmsPlane& plane : planes) {
        if (plane->plane_id == primary || plane->crtc_id == crtc.id) {
            objects.push_back(plane->plane_id);
        }
    }
    return objects;
}

} // namespace

Result<KmsLease> lease_output(const KmsCard& card, std::string_view connector, std::string_view stays) {
    const Found found = find_connectors(card.file(), connector, stays);
    if (found.wanted == 0) {
        return fail(ErrorKind::DeviceLost, "screen.no_such_connector",
                    "the graphics card {} has no connector {}; it has {}", card.path(), connector,
                    found.names);
    }
    const std::vector<KmsPlane> planes = planes_of(card.file());
    const std::vector<KmsCrtc> kept =
        found.stays != 0 ? usable_crtcs(card, found.stays, planes) : std::vector<KmsCrtc>();
    const std::optional<KmsCrtc> crtc = choose_crtc(usable_crtcs(card, found.wanted, planes), kept);
    if (!crtc) {
        return fail(ErrorKind::DeviceLost, "screen.one_output",
                    "the graphics card {} cannot light {} beside {}; use another connector or another card",
                    card.path(), connector, stays);
    }
    if (card.is_atomic()) {
        turn_off(card, found.wanted, crtc->id, found.stays != 0 ? crtc_of(card.file(), found.stays) : 0,
                 planes);
    }
    KmsLease lease{.file = -1, .objects = objects_of(card, found.wanted, *crtc, planes)};
    std::uint32_t lessee = 0;
    lease.file = drmModeCreateLease(card.file(), lease.objects.data(), static_cast<int>(lease.objects.size()),
                                    O_CLOEXEC | O_NONBLOCK, &lessee);
    if (lease.file < 0) {
        return fail(ErrorKind::DeviceLost, "screen.lease_refused",
                    "the graphics card {} cannot drive {} separately from {}: {}", card.path(), connector,
                    stays, std::strerror(-lease.file));
    }
    return lease;
}

} // namespace frustumscreen::display
