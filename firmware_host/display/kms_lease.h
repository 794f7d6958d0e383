/// A lease of one output of a graphics card: the kernel gives its connector, a CRTC and the planes of that CRTC to another
/// file of the same program, whose modes and flips are its own.
///
/// Choice   a CRTC that leaves another one for the connector that stays: preferably the one that feeds the leased
///          connector now, otherwise the first that can feed it. Outputs that an earlier program has lit are turned
///          off first, except the connector that stays.
/// Threads  the render thread, while no mode is being set.
/// Errors   the card lacks the connector, cannot light both at once, or refuses the lease.
/// Source   Linux 6.1, drivers/gpu/drm/drm_lease.c: the lessor must be the master; connector, CRTC and, with universal planes,
///          a plane are needed; EBUSY while another lease holds one of them; the lessor can still change all of them. A
///          framebuffer needs no lease (drm_mode_object.c, drm_mode_object_lease_required).
#pragma once

#include "firmware_host/base/result.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace frustumscreen::display {

class KmsCard;

struct KmsLease {
    int file = -1;                      ///< the caller closes it, which ends the lease
    std::vector<std::uint32_t> objects; ///< connector, CRTC, planes
};

/// `stays`: name of the connector that must still be lit beside it.
[[nodiscard]] Result<KmsLease> lease_output(const KmsCard& card, std::string_view connector,
                                            std::string_view stays);

} // namespace frustumscreen::display
