#include "firmware_host/display/atomic_kms.h"

#include "firmware_host/display/kms_properties.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

extern "C" {
#include <drm_fourcc.h>
#include <xf86drm.h>
#include <xf86drmMode.h>
}

namespace frustumscreen {

namespace {

using Resources = std::unique_ptr<drmModeRes, decltype(&drmModeFreeResources)>;
using Connector = std::unique_ptr<drmModeConnector, decltype(&drmModeFreeConnector)>;
using Encoder = std::unique_ptr<drmModeEncoder, decltype(&drmModeFreeEncoder)>;
using PlaneList = std::unique_ptr<drmModePlaneRes, decltype(&drmModeFreePlaneResources)>;
using Plane = std::unique_ptr<drmModePlane, decltype(&drmModeFreePlane)>;

KmsAnswer answer_of(int status) {
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

/// Properties to set at once. What an object has not, or has already, is left out.
class Commit {
public:
    explicit Commit(int file) : file_(file), request_(drmModeAtomicAlloc(), drmModeAtomicFree) {}

    void set(const KmsProperties& object, std::string_view name, std::uint64_t value) {
        if (const KmsProperty* property = object.find(name); property != nullptr && !property->immutable) {
            set(object.object(), property->id, value);
        }
    }
    void reset(const KmsProperties& object, std::string_view name, std::uint64_t value) {
        if (object.value(name) != value) {
            set(object, name, value);
        }
    }
    void set(std::uint32_t object, std::uint32_t property, std::uint64_t value) {
        drmModeAtomicAddProperty(request_.get(), object, property, value);
    }
    [[nodiscard]] KmsAnswer send(std::uint32_t flags, std::uint64_t ticket) const {
        // NOLINTNEXTLINE(performance-no-int-to-ptr): no address; the kernel gives these bits back with the
        // flip
        void* const given_back = reinterpret_cast<void*>(ticket);
        return answer_of(
            drmModeAtomicCommit(file_, request_.get(), flags | DRM_MODE_ATOMIC_NONBLOCK, given_back));
    }

private:
    int file_;
    std::unique_ptr<drmModeAtomicReq, decltype(&drmModeAtomicFree)> request_;
};

void turn_off_plane(Commit& commit, const KmsProperties& plane) {
    commit.set(plane, "FB_ID", 0);
    commit.set(plane, "CRTC_ID", 0);
}

void turn_off_crtc(Commit& commit, const KmsProperties& crtc) {
    commit.set(crtc, "ACTIVE", 0);
    commit.set(crtc, "MODE_ID", 0);
}

/// The plane shows the whole framebuffer on the whole of the CRTC, whatever a program before did with it.
void show_on_plane(Commit& commit, const KmsProperties& plane, std::uint32_t crtc, FramebufferId shown,
                   const ModeTiming& mode) {
    commit.set(plane, "FB_ID", shown);
    commit.set(plane, "CRTC_ID", crtc);
    commit.set(plane, "SRC_X", 0);
    commit.set(plane, "SRC_Y", 0);
    commit.set(plane, "SRC_W", std::uint64_t{mode.width} << 16U);
    commit.set(plane, "SRC_H", std::uint64_t{mode.height} << 16U);
    commit.set(plane, "CRTC_X", 0);
    commit.set(plane, "CRTC_Y", 0);
    commit.set(plane, "CRTC_W", mode.width);
    commit.set(plane, "CRTC_H", mode.height);
    commit.reset(plane, "rotation", DRM_MODE_ROTATE_0);
    commit.reset(plane, "alpha", 0xFFFF);
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

std::vector<Plane> planes_of(int file) {
    std::vector<Plane> planes;
    const PlaneList list(drmModeGetPlaneResources(file), drmModeFreePlaneResources);
    for (std::uint32_t k = 0; list && k < list->count_planes; ++k) {
        if (Plane plane(drmModeGetPlane(file, list->planes[k]), drmModeFreePlane); plane) {
            planes.push_back(std::move(plane));
        }
    }
    return planes;
}

bool shows_our_format(const drmModePlane& plane) {
    const std::uint32_t* first = plane.formats;
    const std::uint32_t* end = first + plane.count_formats;
    return std::find(first, end, std::uint32_t{DRM_FORMAT_XRGB8888}) != end;
}

/// The plane that carries the CRTC's picture; 0 = none.
std::uint32_t primary_plane(int file, const std::vector<Plane>& planes, int crtc_index) {
    for (const Plane& plane : planes) {
        const bool fits = ((plane->possible_crtcs >> static_cast<unsigned>(crtc_index)) & 1U) != 0;
        if (fits && shows_our_format(*plane) &&
            KmsProperties(file, plane->plane_id, DRM_MODE_OBJECT_PLANE).value("type") ==
                DRM_PLANE_TYPE_PRIMARY) {
            return plane->plane_id;
        }
    }
    return 0;
}

/// CRTCs that can feed the connector, a bit for each, by their order in the card's list.
std::uint32_t possible_crtcs(int file, std::uint32_t connector_id) {
    std::uint32_t possible = 0;
    const Connector connector(drmModeGetConnectorCurrent(file, connector_id), drmModeFreeConnector);
    for (int k = 0; connector && k < connector->count_encoders; ++k) {
        if (const Encoder encoder(drmModeGetEncoder(file, connector->encoders[k]), drmModeFreeEncoder);
            encoder) {
            possible |= encoder->possible_crtcs;
        }
    }
    return possible;
}

} // namespace

AtomicKms::AtomicKms(const KmsCard& card) : file_(card.file()) {
    std::uint64_t monotonic = 0;
    monotonic_flips_ = drmGetCap(file_, DRM_CAP_TIMESTAMP_MONOTONIC, &monotonic) == 0 && monotonic == 1;
}

AtomicKms::~AtomicKms() {
    forget_mode();
}

void AtomicKms::forget_mode() {
    if (mode_blob_ != 0) {
        drmModeDestroyPropertyBlob(file_, mode_blob_);
        mode_blob_ = 0;
    }
}

/// By the CRTC that feeds the connector already, if any: a program before may have set it up.
std::optional<AtomicKms::Route> AtomicKms::route_to(std::uint32_t connector) const {
    const Resources resources(drmModeGetResources(file_), drmModeFreeResources);
    if (!resources) {
        return std::nullopt;
    }
    const std::vector<Plane> planes = planes_of(file_);
    const std::uint32_t possible = possible_crtcs(file_, connector);
    const std::uint64_t feeding = KmsProperties(file_, connector, DRM_MODE_OBJECT_CONNECTOR).value("CRTC_ID");
    std::optional<Route> route;
    for (int k = 0; k < resources->count_crtcs; ++k) {
        const std::uint32_t crtc = resources->crtcs[k];
        const std::uint32_t plane =
            ((possible >> static_cast<unsigned>(k)) & 1U) != 0 ? primary_plane(file_, planes, k) : 0;
        if (plane != 0 && (!route || crtc == feeding)) {
            const KmsProperty* shown = KmsProperties(file_, plane, DRM_MODE_OBJECT_PLANE).find("FB_ID");
            route = Route{connector, crtc, plane, shown != nullptr ? shown->id : 0};
        }
    }
    return route;
}

KmsAnswer AtomicKms::light(std::uint32_t connector, const ModeTiming& mode, FramebufferId shown,
                           std::uint64_t ticket) {
    const Resources resources(drmModeGetResources(file_), drmModeFreeResources);
    if (!resources) {
        return answer_of(-errno);
    }
    const std::optional<Route> route = route_to(connector);
    const drmModeModeInfo info = mode_info(mode);
    std::uint32_t blob = 0;
    if (!route || drmModeCreatePropertyBlob(file_, &info, sizeof info, &blob) != 0) {
        return KmsAnswer::Refused;
    }
    forget_mode(); // the kernel keeps what is set
    mode_blob_ = blob;
    Commit commit(file_);
    for (int k = 0; k < resources->count_connectors; ++k) {
        const KmsProperties other(file_, resources->connectors[k], DRM_MODE_OBJECT_CONNECTOR);
        if (other.object() == connector) {
            commit.set(other, "CRTC_ID", route->crtc);
            commit.reset(other, "link-status", 0); // good: the link is trained anew
        } else {
            commit.reset(other, "CRTC_ID", 0);
        }
    }
    for (int k = 0; k < resources->count_crtcs; ++k) {
        const KmsProperties crtc(file_, resources->crtcs[k], DRM_MODE_OBJECT_CRTC);
        if (crtc.object() == route->crtc) {
            commit.set(crtc, "MODE_ID", blob);
            commit.set(crtc, "ACTIVE", 1);
            for (const std::string_view colours : {"GAMMA_LUT", "DEGAMMA_LUT", "CTM", "VRR_ENABLED"}) {
                commit.reset(crtc, colours, 0);
            }
        } else if (crtc.value("ACTIVE") != 0) {
            turn_off_crtc(commit, crtc);
        }
    }
    for (const Plane& plane : planes_of(file_)) {
        const KmsProperties properties(file_, plane->plane_id, DRM_MODE_OBJECT_PLANE);
        if (plane->plane_id == route->plane) {
            show_on_plane(commit, properties, route->crtc, shown, mode);
        } else if (properties.value("CRTC_ID") != 0) {
            turn_off_plane(commit, properties);
        }
    }
    const KmsAnswer answer = commit.send(DRM_MODE_ATOMIC_ALLOW_MODESET | DRM_MODE_PAGE_FLIP_EVENT, ticket);
    if (answer == KmsAnswer::Done) {
        route_ = route;
        std::uint64_t refresh = 0;
        std::uint64_t at_ns = 0;
        flips_keep_time_ = monotonic_flips_ && drmCrtcGetSequence(file_, route->crtc, &refresh, &at_ns) == 0;
    }
    return answer;
}

KmsAnswer AtomicKms::flip(FramebufferId shown, std::uint64_t ticket) {
    if (!route_) {
        return KmsAnswer::Refused;
    }
    Commit commit(file_);
    commit.set(route_->plane, route_->plane_framebuffer, shown);
    return commit.send(DRM_MODE_PAGE_FLIP_EVENT, ticket);
}

KmsAnswer AtomicKms::darken() {
    if (!route_) {
        return KmsAnswer::Done;
    }
    Commit commit(file_);
    turn_off_plane(commit, KmsProperties(file_, route_->plane, DRM_MODE_OBJECT_PLANE));
    turn_off_crtc(commit, KmsProperties(file_, route_->crtc, DRM_MODE_OBJECT_CRTC));
    commit.set(KmsProperties(file_, route_->connector, DRM_MODE_OBJECT_CONNECTOR), "CRTC_ID", 0);
    const KmsAnswer answer = commit.send(DRM_MODE_ATOMIC_ALLOW_MODESET, 0);
    if (answer == KmsAnswer::Done) {
        route_.reset();
    }
    return answer;
}

bool AtomicKms::become_master() {
    return take_screen(file_);
}

std::optional<Flipped> AtomicKms::wait_flip(Nanoseconds at_most) {
    const MonotonicTime give_up = monotonic_now() + at_most;
    while (true) {
        if (!flips_.empty()) {
            const Flipped first = flips_.front();
            flips_.erase(flips_.begin());
            return first;
        }
        const auto left = std::max(give_up - monotonic_now(), Nanoseconds(0));
        pollfd card{file_, POLLIN, 0};
        const auto left_ms = std::chrono::ceil<std::chrono::milliseconds>(left).count();
        if (::poll(&card, 1, static_cast<int>(left_ms)) <= 0 || (card.revents & POLLIN) == 0) {
            return std::nullopt;
        }
        read_flips();
    }
}

/// A commit that turns other CRTCs off brings events of theirs too.
void AtomicKms::read_flips() {
    alignas(drm_event_vblank) std::array<char, 1024> bytes; // the kernel hands out whole events
    const ssize_t length = ::read(file_, bytes.data(), bytes.size());
    std::size_t at = 0;
    while (length > 0 && at + sizeof(drm_event) <= static_cast<std::size_t>(length)) {
        drm_event event;
        std::memcpy(&event, bytes.data() + at, sizeof event);
        if (event.length < sizeof event || at + event.length > static_cast<std::size_t>(length)) {
            return;
        }
        if (event.type == DRM_EVENT_FLIP_COMPLETE && event.length >= sizeof(drm_event_vblank)) {
            drm_event_vblank flip;
            std::memcpy(&flip, bytes.data() + at, sizeof flip);
            const MonotonicTime time(std::chrono::seconds(flip.tv_sec) +
                                     std::chrono::microseconds(flip.tv_usec));
            if (!route_ || flip.crtc_id == 0 || flip.crtc_id == route_->crtc) {
                flips_.push_back({monotonic_flips_ ? time : monotonic_now(), flip.user_data});
            }
        }
        at += event.length;
    }
}

} // namespace frustumscreen
