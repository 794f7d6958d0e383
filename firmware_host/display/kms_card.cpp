#include "firmware_host/display/kms_card.h"

#include "firmware_host/base/folder_entries.h"
#include "firmware_host/display/atomic_kms.h"
#include "firmware_host/display/connected_elsewhere.h"
#include "firmware_host/display/kms_handles.h"
#include "firmware_host/display/kms_lease.h"
#include "firmware_host/display/kms_properties.h"
#include "firmware_host/display/legacy_kms.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace frustumscreen::display {

namespace {

constexpr std::uint64_t link_is_bad = 1; ///< DRM_MODE_LINK_STATUS_BAD

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

std::vector<std::string> card_paths(const std::filesystem::path& folder) {
    std::vector<std::string> paths;
    for (const std::filesystem::directory_entry& entry : entries_of(folder)) {
        if (entry.path().filename().string().starts_with("card")) {
            paths.push_back(entry.path().string());
        }
    }
    return paths;
}

} // namespace

OwnedFile::~OwnedFile() {
    ::close(file_);
}

Result<KmsCard> KmsCard::open(std::string_view name, const OutputRequest& request,
                              const std::string& folder) {
    if (!name.empty()) {
        return open_path(name.front() == '/' ? std::string(name) : fmt::format("{}/{}", folder, name),
                         request);
    }
    Result<KmsCard> best = fail(ErrorKind::DeviceLost, "display.no_card",
                                "display: no graphics card in {}; load its driver", folder);
    CardRank best_rank{};
    const std::vector<std::string> paths = card_paths(folder);
    for (const std::string& path : paths) {
        Result<KmsCard> card = open_path(path, request);
        if (card) {
            card->any_ = true;
            const CardRank rank = paths.size() > 1 ? rank_of(card->look(true), request) : CardRank{};
            if (!best || rank < best_rank) {
                best_rank = rank;
                best = std::move(card);
            }
        } else if (!best && best.error().kind == ErrorKind::DeviceLost) {
            best = std::move(card); // a refused permission is the most useful reason
        }
    }
    return best;
}

Result<KmsCard> KmsCard::open_path(const std::string& path, const OutputRequest& request) {
    const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) {
        const bool refused = errno == EACCES || errno == EPERM;
        return fail(refused ? ErrorKind::BadConfiguration : ErrorKind::DeviceLost, "display.card_not_opened",
                    "display: {} cannot be opened: {}; {}", path, std::strerror(errno),
                    refused ? "this user must be in the group video"
                            : "is it the card's name, and is its driver loaded?");
    }
    KmsCard card(file, path);
    const KmsResources resources = resources_of(file);
    if (!resources || resources->count_crtcs == 0 || resources->count_connectors == 0) {
        return fail(ErrorKind::DeviceLost, "display.no_connectors", // a card with connectors may come later
                    "display: the graphics card {} has no connectors; name another one", path);
    }
    card.set_capabilities(request);
    return card;
}

void KmsCard::set_capabilities(const OutputRequest& request) {
    atomic_ = drmSetClientCap(file(), DRM_CLIENT_CAP_UNIVERSAL_PLANES, 1) == 0 &&
              drmSetClientCap(file(), DRM_CLIENT_CAP_ATOMIC, 1) == 0;
    if (request.eyes == EyeLayout::SideBySide || request.eyes == EyeLayout::TopBottom) {
        static_cast<void>(
            drmSetClientCap(file(), DRM_CLIENT_CAP_STEREO_3D, 1)); // else no such mode is listed
    }
}

Result<KmsCard> KmsCard::lease(const OutputRequest& request, std::string_view stays) {
    const std::lock_guard quiet(shared_state_->probe_mutex);
    leased_.clear();
    TRY(KmsLease lease, lease_output(*this, request.connector, stays));
    leased_ = std::move(lease.objects);
    KmsCard output(lease.file, path_);
    output.set_capabilities(request);
    output.whole_ = file_;
    output.shared_state_ = shared_state_;
    shared_state_->has_lease = true;
    return output;
}

bool KmsCard::become_master() const {
    return take_screen(memory_file());
}

CardSeen KmsCard::look(bool thoroughly) const {
    CardSeen seen;
    const KmsResources resources = resources_of(file());
    if (!resources) {
        seen.state = state();
        return seen;
    }
    for (int k = 0; k < resources->count_connectors; ++k) {
        const std::uint32_t id = resources->connectors[k];
        const bool probes = thoroughly && !has_leased(id); // the lease's own watch probes that one
        const KmsConnector connector(probes ? drmModeGetConnector(file(), id)
                                            : drmModeGetConnectorCurrent(file(), id),
                                     drmModeFreeConnector);
        if (!connector || connector->connector_type == DRM_MODE_CONNECTOR_WRITEBACK) {
            continue;
        }
        ConnectorSeen one;
        one.id = id;
        one.name = connector_name(*connector);
        one.plugged = plugged(connector->connection);
        one.built_in = is_built_in(connector->connector_type);
        one.link_bad =
            KmsProperties(file(), id, DRM_MODE_OBJECT_CONNECTOR).value("link-status") == link_is_bad;
        for (int m = 0; m < connector->count_modes; ++m) {
            one.modes.push_back(timing_of(connector->modes[m]));
        }
        seen.connectors.push_back(std::move(one));
    }
    return seen;
}

CardSeen look_for_projector(const KmsCard& card, OtherCards* others, const OutputRequest& request,
                            bool thoroughly) {
    CardSeen seen = card.look(thoroughly);
    if (others != nullptr && seen.state == CardState::There && choose_connector(seen, request) == nullptr &&
        others->have_projector()) {
        seen.state = CardState::Elsewhere;
    }
    return seen;
}

std::unique_ptr<KmsDevice> make_kms_device(const KmsCard& card) {
    if (card.is_atomic()) {
        return std::make_unique<AtomicKms>(card);
    }
    return std::make_unique<LegacyKms>(card);
}

bool take_screen(int card) {
    return drmIsMaster(card) != 0 || drmSetMaster(card) == 0;
}

CardState KmsCard::state() const {
    const std::string folder = std::filesystem::path(path_).parent_path();
    return open(any_ ? std::string_view() : path_, {}, folder) ? CardState::Back : CardState::Gone;
}

bool OtherCards::have_projector() {
    std::vector<std::string> connected = connected_connectors(connectors_);
    if (connected == looked_at_) {
        return false;
    }
    bool all_opened = true;
    for (const std::string& path : card_paths(std::filesystem::path(own_path_).parent_path())) {
        if (path == own_path_ || !has_connected(connected, path, request_.connector)) {
            continue;
        }
        const Result<KmsCard> card = KmsCard::open_path(path, request_);
        if (card && rank_of(card->look(true), request_) < CardRank::NothingCertain) {
            return true;
        }
        all_opened = all_opened && card.has_value();
    }
    if (all_opened) {
        looked_at_ = std::move(connected);
    }
    return false;
}

} // namespace frustumscreen::display
