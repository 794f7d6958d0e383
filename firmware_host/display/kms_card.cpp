#include "firmware_host/display/kms_card.h"

#include "firmware_host/display/kms_properties.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>

extern "C" {
#include <xf86drm.h>
#include <xf86drmMode.h>
}

namespace frustumscreen {

namespace {

using Resources = std::unique_ptr<drmModeRes, decltype(&drmModeFreeResources)>;
using Connector = std::unique_ptr<drmModeConnector, decltype(&drmModeFreeConnector)>;

constexpr const char* folder = "/dev/dri";
constexpr std::uint64_t link_is_bad = 1; ///< DRM_MODE_LINK_STATUS_BAD

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

bool is_built_in(std::uint32_t type) {
    return type == DRM_MODE_CONNECTOR_LVDS || type == DRM_MODE_CONNECTOR_eDP ||
           type == DRM_MODE_CONNECTOR_DSI || type == DRM_MODE_CONNECTOR_DPI;
}

Plugged plugged(drmModeConnection connection) {
    switch (connection) {
    case DRM_MODE_CONNECTED:
        return Plugged::Yes;
    case DRM_MODE_DISCONNECTED:
        return Plugged::No;
    case DRM_MODE_UNKNOWNCONNECTION:
        break;
    }
    return Plugged::Unknown;
}

std::vector<std::string> card_paths() {
    std::vector<std::string> paths;
    std::error_code failed;
    for (std::filesystem::directory_iterator entry(folder, failed), end; !failed && entry != end;
         entry.increment(failed)) {
        if (entry->path().filename().string().starts_with("card")) {
            paths.push_back(entry->path().string());
        }
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

} // namespace

Result<KmsCard> KmsCard::open(std::string_view name) {
    if (!name.empty()) {
        return open_path(name.front() == '/' ? std::string(name) : fmt::format("{}/{}", folder, name));
    }
    Result<KmsCard> best =
        fail(ErrorKind::DeviceLost,
             fmt::format("display: no graphics card in {}; load its driver, or run with --headless", folder));
    for (const std::string& path : card_paths()) {
        Result<KmsCard> card = open_path(path);
        if (card) {
            card->wanted_.clear();
            const std::vector<ConnectorSeen> seen = card->look(false).connectors;
            if (std::any_of(seen.begin(), seen.end(),
                            [](const ConnectorSeen& one) { return one.plugged == Plugged::Yes; })) {
                return card;
            }
        }
        if (!best) {
            best = std::move(card); // or the reason why there is none
        }
    }
    return best;
}

Result<KmsCard> KmsCard::open_path(const std::string& path) {
    const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) {
        const bool refused = errno == EACCES || errno == EPERM;
        return fail(refused ? ErrorKind::BadConfiguration : ErrorKind::DeviceLost,
                    fmt::format("display: {} cannot be opened: {}; {}", path, std::strerror(errno),
                                refused ? "the exhibit's user must be in the group video"
                                        : "is it the card's name, and is its driver loaded?"));
    }
    KmsCard card(file, path);
    const Resources resources(drmModeGetResources(file), drmModeFreeResources);
    if (!resources || resources->count_crtcs == 0 || resources->count_connectors == 0) {
        return fail(ErrorKind::DeviceLost, // the one that has may come later
                    fmt::format("display: the graphics card {} has no connectors; name another one", path));
    }
    if (drmSetClientCap(file, DRM_CLIENT_CAP_UNIVERSAL_PLANES, 1) != 0 ||
        drmSetClientCap(file, DRM_CLIENT_CAP_ATOMIC, 1) != 0) {
        return fail(
            ErrorKind::BadConfiguration,
            fmt::format("display: the driver of {} has no atomic modesetting; another card is needed", path));
    }
    return card;
}

KmsCard::~KmsCard() {
    if (file_ >= 0) {
        ::close(file_);
    }
}

KmsCard::KmsCard(KmsCard&& other) noexcept
    : file_(std::exchange(other.file_, -1)), path_(std::move(other.path_)),
      wanted_(std::move(other.wanted_)) {}

KmsCard& KmsCard::operator=(KmsCard&& other) noexcept {
    std::swap(file_, other.file_);
    std::swap(path_, other.path_);
    std::swap(wanted_, other.wanted_);
    return *this;
}

CardSeen KmsCard::look(bool thoroughly) const {
    CardSeen seen;
    const Resources resources(drmModeGetResources(file_), drmModeFreeResources);
    if (!resources) {
        seen.state = state();
        return seen;
    }
    for (int k = 0; k < resources->count_connectors; ++k) {
        const std::uint32_t id = resources->connectors[k];
        const Connector connector(thoroughly ? drmModeGetConnector(file_, id)
                                             : drmModeGetConnectorCurrent(file_, id),
                                  drmModeFreeConnector);
        if (!connector || connector->connector_type == DRM_MODE_CONNECTOR_WRITEBACK) {
            continue;
        }
        const char* kind = drmModeGetConnectorTypeName(connector->connector_type);
        ConnectorSeen one;
        one.id = id;
        one.name = fmt::format("{}-{}", kind != nullptr ? kind : "Unknown", connector->connector_type_id);
        one.plugged = plugged(connector->connection);
        one.built_in = is_built_in(connector->connector_type);
        one.link_bad =
            KmsProperties(file_, id, DRM_MODE_OBJECT_CONNECTOR).value("link-status") == link_is_bad;
        for (int m = 0; m < connector->count_modes; ++m) {
            one.modes.push_back(timing_of(connector->modes[m]));
        }
        seen.connectors.push_back(std::move(one));
    }
    return seen;
}

bool take_screen(int card) {
    return drmIsMaster(card) != 0 || drmSetMaster(card) == 0;
}

/// Of a card that does not answer: it, or another one, may be there anew.
CardState KmsCard::state() const {
    return open(wanted_) ? CardState::Back : CardState::Gone;
}

} // namespace frustumscreen
