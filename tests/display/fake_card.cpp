#include "tests/display/fake_card.h"

#include <drm_fourcc.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <limits>

namespace frustumscreen::display {

namespace {

constexpr std::uint32_t atomic_property = DRM_MODE_PROP_ATOMIC;
constexpr std::uint32_t atomic_object = DRM_MODE_PROP_OBJECT | DRM_MODE_PROP_ATOMIC;

} // namespace

std::uint32_t FakeCard::add_object(std::uint32_t kind) {
    kinds_[++last_id_] = kind;
    state_[last_id_] = {};
    return last_id_;
}

std::uint32_t FakeCard::add_crtc() {
    const std::uint32_t id = add_object(DRM_MODE_OBJECT_CRTC);
    crtcs_.push_back(id);
    add_property(id, {0, "ACTIVE", DRM_MODE_PROP_RANGE | atomic_property, {0, 1}, {}}, 0);
    add_property(id, {0, "MODE_ID", DRM_MODE_PROP_BLOB | atomic_property, {}, {}}, 0);
    add_property(id, {0, "GAMMA_LUT", DRM_MODE_PROP_BLOB, {}, {}}, 0);
    add_property(id, {0, "VRR_ENABLED", DRM_MODE_PROP_RANGE, {0, 1}, {}}, 0);
    return id;
}

std::uint32_t FakeCard::add_encoder(std::uint32_t possible_crtcs) {
    const std::uint32_t id = add_object(DRM_MODE_OBJECT_ENCODER);
    encoders_[id] = possible_crtcs;
    return id;
}

FakeConnector& FakeCard::add_connector(std::uint32_t type, std::uint32_t number,
                                       std::vector<std::uint32_t> encoders) {
    FakeConnector made;
    made.id = add_object(DRM_MODE_OBJECT_CONNECTOR);
    made.type = type;
    made.number = number;
    made.encoders = std::move(encoders);
    add_property(made.id, {0, "CRTC_ID", atomic_object, {DRM_MODE_OBJECT_CRTC}, {}}, 0);
    add_property(made.id, {0, "link-status", DRM_MODE_PROP_ENUM, {}, {{"Good", 0}, {"Bad", 1}}}, 0);
    connectors_.push_back(std::move(made));
    return connectors_.back();
}

std::uint32_t FakeCard::add_plane(std::uint32_t type, std::uint32_t possible_crtcs) {
    const std::uint32_t id = add_object(DRM_MODE_OBJECT_PLANE);
    planes_.push_back({id, type, possible_crtcs, {DRM_FORMAT_ARGB8888, DRM_FORMAT_XRGB8888}});
    add_property(id,
                 {0,
                  "type",
                  DRM_MODE_PROP_ENUM | DRM_MODE_PROP_IMMUTABLE,
                  {},
                  {{"Overlay", DRM_PLANE_TYPE_OVERLAY},
                   {"Primary", DRM_PLANE_TYPE_PRIMARY},
                   {"Cursor", DRM_PLANE_TYPE_CURSOR}}},
                 type);
    add_property(id, {0, "FB_ID", atomic_object, {DRM_MODE_OBJECT_FB}, {}}, 0);
    add_property(id, {0, "CRTC_ID", atomic_object, {DRM_MODE_OBJECT_CRTC}, {}}, 0);
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    for (const char* name : {"SRC_X", "SRC_Y", "SRC_W", "SRC_H", "CRTC_W", "CRTC_H"}) {
        add_property(id, {0, name, DRM_MODE_PROP_RANGE | atomic_property, {0, most}, {}}, 0);
    }
    for (const char* name : {"CRTC_X", "CRTC_Y"}) {
        add_property(id, {0, name, DRM_MODE_PROP_SIGNED_RANGE | atomic_property, {}, {}}, 0);
    }
    add_property(id, {0, "rotation", DRM_MODE_PROP_BITMASK, {}, {{"rotate-0", 0}, {"rotate-180", 2}}},
                 DRM_MODE_ROTATE_0);
    add_property(id, {0, "alpha", DRM_MODE_PROP_RANGE, {0, 0xFFFF}, {}}, 0xFFFF);
    return id;
}

void FakeCard::add_property(std::uint32_t object, const FakeProperty& property, std::uint64_t value) {
    for (const auto& [id, known] : properties_) {
        if (known.name == property.name && known.limits == property.limits &&
            known.choices == property.choices) {
            state_.at(object)[id] = value;
            return;
        }
    }
    FakeProperty made = property;
    made.id = ++last_id_;
    state_.at(object)[made.id] = value;
    properties_[made.id] = std::move(made);
}

void FakeCard::take_property(std::uint32_t object, const std::string& name) {
    state_.at(object).erase(id_of(object, name));
}

std::uint32_t FakeCard::id_of(std::uint32_t object, const std::string& name) const {
    for (const auto& [id, value] : state_.at(object)) {
        if (properties_.at(id).name == name) {
            return id;
        }
    }
    return 0;
}

std::uint64_t FakeCard::get(const State& state, std::uint32_t object, const std::string& name) const {
    const Values& values = state.at(object);
    const auto found = values.find(id_of(object, name));
    return found != values.end() ? found->second : 0;
}

void FakeCard::put(State& state, std::uint32_t object, const std::string& name, std::uint64_t value) const {
    if (const std::uint32_t id = id_of(object, name); id != 0) {
        state.at(object)[id] = value;
    }
}

std::uint64_t FakeCard::value(std::uint32_t object, const std::string& property) const {
    return get(state_, object, property);
}

void FakeCard::set(std::uint32_t object, const std::string& property, std::uint64_t value) {
    put(state_, object, property, value);
}

const FakeProperty* FakeCard::property(std::uint32_t id) const {
    const auto found = properties_.find(id);
    return found != properties_.end() ? &found->second : nullptr;
}

const std::map<std::uint32_t, std::uint64_t>* FakeCard::values_of(std::uint32_t object) const {
    const auto found = state_.find(object);
    return found != state_.end() ? &found->second : nullptr;
}

FakeConnector& FakeCard::connector(std::uint32_t id) {
    return *std::find_if(connectors_.begin(), connectors_.end(),
                         [id](const FakeConnector& one) { return one.id == id; });
}

void FakeCard::plug(std::uint32_t connector_id, std::vector<drmModeModeInfo> edid) {
    connector(connector_id).cable = DRM_MODE_CONNECTED;
    connector(connector_id).edid = std::move(edid);
}

void FakeCard::unplug(std::uint32_t connector_id) {
    connector(connector_id).cable = DRM_MODE_DISCONNECTED;
    connector(connector_id).edid.clear();
}

void FakeCard::probe(FakeConnector& connector) {
    connector.known = connector.cable;
    connector.modes = connector.edid;
}

unsigned FakeCard::index_of(std::uint32_t crtc) const {
    return static_cast<unsigned>(std::find(crtcs_.begin(), crtcs_.end(), crtc) - crtcs_.begin());
}

bool FakeCard::can_feed(const FakeConnector& connector, std::uint32_t crtc) const {
    return std::any_of(connector.encoders.begin(), connector.encoders.end(), [&](std::uint32_t encoder) {
        return ((encoders_.at(encoder) >> index_of(crtc)) & 1U) != 0;
    });
}

std::uint32_t FakeCard::encoder_of(const FakeConnector& connector) const {
    const auto crtc = static_cast<std::uint32_t>(value(connector.id, "CRTC_ID"));
    for (const std::uint32_t encoder : connector.encoders) {
        if (crtc != 0 && ((encoders_.at(encoder) >> index_of(crtc)) & 1U) != 0) {
            return encoder;
        }
    }
    return 0;
}

std::uint32_t FakeCard::crtc_of(std::uint32_t encoder) const {
    for (const FakeConnector& connector : connectors_) {
        if (encoder_of(connector) == encoder) {
            return static_cast<std::uint32_t>(value(connector.id, "CRTC_ID"));
        }
    }
    return 0;
}

const FakePlane* FakeCard::primary(std::uint32_t crtc) const {
    for (const FakePlane& plane : planes_) {
        if (plane.type == DRM_PLANE_TYPE_PRIMARY && ((plane.possible_crtcs >> index_of(crtc)) & 1U) != 0) {
            return &plane;
        }
    }
    return nullptr;
}

std::optional<FakeCard::Shown> FakeCard::shown(std::uint32_t connector) const {
    const auto crtc = static_cast<std::uint32_t>(value(connector, "CRTC_ID"));
    if (crtc == 0 || value(crtc, "ACTIVE") == 0) {
        return std::nullopt;
    }
    for (const FakePlane& plane : planes_) {
        if (plane.type == DRM_PLANE_TYPE_PRIMARY && value(plane.id, "CRTC_ID") == crtc) {
            return Shown{static_cast<std::uint32_t>(value(plane.id, "FB_ID")), mode_of(state_, crtc).value()};
        }
    }
    return std::nullopt;
}

int FakeCard::become_master(FakeFile& file) {
    if (!file.was_master) {
        return -EACCES;
    }
    if (master_ != nullptr && master_ != &file) {
        return -EBUSY;
    }
    master_ = &file;
    return 0;
}

void FakeCard::opened(FakeFile& file) {
    if (master_ == nullptr) {
        master_ = &file;
        file.was_master = true;
    }
}

std::string FakeCard::closed(FakeFile& file) {
    std::string left;
    const auto count = [&left](std::size_t number, const char* what) {
        if (number > 0) {
            left += (left.empty() ? "" : ", ") + std::to_string(number) + " " + what;
        }
    };
    count(file.framebuffers.size(), "framebuffers");
    count(file.blobs.size(), "blobs");
    count(file.handles.size(), "buffers");
    while (!file.framebuffers.empty()) {
        remove_framebuffer(file, *file.framebuffers.begin());
    }
    while (!file.blobs.empty()) {
        destroy_blob(file, *file.blobs.begin());
    }
    while (!file.handles.empty()) {
        destroy_buffer(file, *file.handles.begin());
    }
    std::erase_if(pending_, [&file](const auto& one) { return one.second.file == &file; });
    master_ = master_ == &file ? nullptr : master_;
    return left;
}

std::uint32_t FakeCard::create_buffer(FakeFile& file, std::uint32_t width, std::uint32_t height) {
    const std::uint32_t handle = ++last_id_;
    const std::uint32_t pitch = (width * 4 + 63) / 64 * 64;
    buffers_[handle] = {pitch,
                        std::make_shared<std::vector<std::byte>>(static_cast<std::size_t>(pitch) * height)};
    file.handles.insert(handle);
    return handle;
}

const FakeBuffer* FakeCard::buffer(const FakeFile& file, std::uint32_t handle) const {
    return file.handles.contains(handle) ? &buffers_.at(handle) : nullptr;
}

int FakeCard::destroy_buffer(FakeFile& file, std::uint32_t handle) {
    if (file.handles.erase(handle) == 0) {
        return -EINVAL;
    }
    buffers_.erase(handle);
    return 0;
}

int FakeCard::add_framebuffer(FakeFile& file, std::uint32_t width, std::uint32_t height, std::uint32_t handle,
                              std::uint32_t pitch, std::uint32_t* id) {
    const FakeBuffer* memory = buffer(file, handle);
    if (memory == nullptr) {
        return -ENOENT;
    }
    if (width == 0 || height == 0 || pitch < width * 4 ||
        static_cast<std::size_t>(pitch) * height > memory->memory->size()) {
        return -EINVAL;
    }
    *id = ++last_id_;
    framebuffers_[*id] = {width, height, memory->memory};
    file.framebuffers.insert(*id);
    return 0;
}

int FakeCard::remove_framebuffer(FakeFile& file, std::uint32_t id) {
    if (file.framebuffers.erase(id) == 0) {
        return -ENOENT;
    }
    for (const FakePlane& plane : planes_) {
        if (value(plane.id, "FB_ID") == id) {
            ++removed_while_shown_;
            const auto crtc = static_cast<std::uint32_t>(value(plane.id, "CRTC_ID"));
            put(state_, plane.id, "FB_ID", 0);
            put(state_, plane.id, "CRTC_ID", 0);
            if (!atomic) {
                turn_off(state_, crtc);
            }
        }
    }
    framebuffers_.erase(id);
    return 0;
}

int FakeCard::create_blob(FakeFile& file, std::span<const std::byte> data, std::uint32_t* id) {
    if (data.empty()) {
        return -EINVAL;
    }
    *id = ++last_id_;
    blobs_[*id] = {{data.begin(), data.end()}, &file};
    file.blobs.insert(*id);
    return 0;
}

int FakeCard::destroy_blob(FakeFile& file, std::uint32_t id) {
    const auto blob = blobs_.find(id);
    if (blob == blobs_.end()) {
        return -ENOENT;
    }
    if (file.blobs.erase(id) == 0) {
        return -EPERM;
    }
    blob->second.owner = nullptr;
    forget_unheld_blobs();
    return 0;
}

int FakeCard::sequence(std::uint32_t crtc) const {
    if (!vertical_blanks) {
        return -EOPNOTSUPP;
    }
    if (index_of(crtc) == crtcs_.size()) {
        return -ENOENT;
    }
    return value(crtc, "ACTIVE") != 0 ? 0 : -EINVAL;
}

void FakeCard::refresh() {
    time_us += refresh_us;
    ++refreshes;
    for (auto& [crtc, scanned] : scanned_) {
        scanned.waited = 0;
    }
    if (late > 0) {
        --late;
    } else {
        for (const auto& [crtc, pending] : std::exchange(pending_, {})) {
            if (pending.file != nullptr && lost == 0) {
                send_event(pending, crtc);
            }
            lost -= lost > 0 ? 1 : 0;
            if (const FakePlane* plane = primary(crtc); plane != nullptr) {
                scanned_[crtc] =
                    Scanned{.framebuffer = static_cast<std::uint32_t>(value(plane->id, "FB_ID")),
                            .first_row = static_cast<std::uint32_t>(value(plane->id, "SRC_Y") >> 16U),
                            .waited = refreshes - pending.queued_at,
                            .modeset = pending.modeset};
            }
        }
    }
    if (refreshed) {
        refreshed();
    }
}

std::optional<FakeCard::Scanned> FakeCard::scanned(std::uint32_t connector) const {
    const auto crtc = static_cast<std::uint32_t>(value(connector, "CRTC_ID"));
    const auto found = scanned_.find(crtc);
    if (crtc == 0 || value(crtc, "ACTIVE") == 0 || found == scanned_.end() ||
        !framebuffers_.contains(found->second.framebuffer)) {
        return std::nullopt;
    }
    return found->second;
}

void FakeCard::send_event(const Pending& pending, std::uint32_t crtc) const {
    drm_event_vblank event{};
    event.base.type = DRM_EVENT_FLIP_COMPLETE;
    event.base.length = sizeof event;
    event.user_data = pending.given_back;
    event.tv_sec = static_cast<std::uint32_t>(time_us / 1'000'000);
    event.tv_usec = static_cast<std::uint32_t>(time_us % 1'000'000);
    event.sequence = refreshes;
    event.crtc_id = crtc;
    static_cast<void>(!::write(pending.file->events, &event, sizeof event));
}

} // namespace frustumscreen::display
