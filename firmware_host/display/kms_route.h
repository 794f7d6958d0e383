/// The route from a graphics card's memory to a connector.
///
/// Threads  the render thread.
/// Errors   none: CRTCs that the card does not report are missing.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

struct _drmModePlane;

namespace frustumscreen::display {

struct KmsCrtc {
    std::uint32_t id = 0;
    int index = 0; ///< in the card's list
};

/// CRTCs that can feed the connector. The one that feeds it now comes first: an earlier program may have set
/// it up.
[[nodiscard]] std::vector<KmsCrtc> crtcs_for(int card, std::uint32_t connector);

using KmsPlane = std::unique_ptr<_drmModePlane, void (*)(_drmModePlane*)>;
[[nodiscard]] std::vector<KmsPlane> planes_of(int card);
/// The primary plane of the CRTC of this index, if it shows the exhibit's pixels; 0 = none.
[[nodiscard]] std::uint32_t primary_plane(int card, const std::vector<KmsPlane>& planes, int crtc_index);

} // namespace frustumscreen::display
