// The kernel's checks of a card's next state.
#include "tests/display/fake_card.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace frustumscreen::display {

bool FakeCard::takes(const FakeProperty& property, std::uint64_t value) const {
    const std::uint32_t kind = property.flags & (DRM_MODE_PROP_LEGACY_TYPE | DRM_MODE_PROP_EXTENDED_TYPE);
    if ((property.flags & DRM_MODE_PROP_IMMUTABLE) != 0) {
        return false;
    }
    if (kind == DRM_MODE_PROP_RANGE) {
        return value >= property.limits.at(0) && value <= property.limits.at(1);
    }
    if (kind == DRM_MODE_PROP_ENUM) {
        return std::any_of(property.choices.begin(), property.choices.end(),
                           [value](const auto& choice) { return choice.second == value; });
    }
    if (kind == DRM_MODE_PROP_BITMASK) {
        std::uint64_t all = 0;
        for (const auto& [name, bit] : property.choices) {
            all |= std::uint64_t{1} << bit;
        }
        return (value & ~all) == 0;
    }
    if (kind == DRM_MODE_PROP_BLOB) {
        const auto blob = blobs_.find(static_cast<std::uint32_t>(value));
        return value == 0 ||
               (blob != blobs_.end() &&
                (property.name != "MODE_ID" || blob->second.data.size() == sizeof(drm_mode_modeinfo)));
    }
    if (kind == DRM_MODE_PROP_OBJECT) {
        const auto id = static_cast<std::uint32_t>(value);
        const auto object = kinds_.find(id);
        return id == 0 || (property.limits.at(0) == DRM_MODE_OBJECT_FB
                               ? framebuffers_.contains(id)
                               : object != kinds_.end() && object->second == property.limits.at(0));
    }
    return true; // a signed range: its limits are those of its type
}

std::optional<drmModeModeInfo> FakeCard::mode_of(const State& state, std::uint32_t crtc) const {
    const auto blob = blobs_.find(static_cast<std::uint32_t>(get(state, crtc, "MODE_ID")));
    if (blob == blobs_.end()) {
        return std::nullopt;
    }
    drmModeModeInfo mode;
    std::memcpy(&mode, blob->second.data.data(), sizeof mode);
    return mode;
}

int FakeCard::judge_plane(const State& next, const FakePlane& plane) const {
    const auto framebuffer = static_cast<std::uint32_t>(get(next, plane.id, "FB_ID"));
    const auto crtc = static_cast<std::uint32_t>(get(next, plane.id, "CRTC_ID"));
    if (framebuffer == 0 && crtc == 0) {
        return 0;
    }
    if (framebuffer == 0 || crtc == 0 || ((plane.possible_crtcs >> index_of(crtc)) & 1U) == 0) {
        return -EINVAL;
    }
    const FakeFramebuffer& memory = framebuffers_.at(framebuffer);
    const auto whole = [&](const char* name) { return get(next, plane.id, name) >> 16U; };
    if (whole("SRC_X") + whole("SRC_W") > memory.width || whole("SRC_Y") + whole("SRC_H") > memory.height) {
        return -ENOSPC;
    }
    const std::uint64_t width = get(next, plane.id, "CRTC_W");
    const std::uint64_t height = get(next, plane.id, "CRTC_H");
    if (!scales && (width != whole("SRC_W") || height != whole("SRC_H"))) {
        return -ERANGE;
    }
    const std::optional<drmModeModeInfo> mode = mode_of(next, crtc);
    const bool covers = !mode || (width == mode->hdisplay && height == mode->vdisplay);
    return scales || covers || plane.type != DRM_PLANE_TYPE_PRIMARY ? 0 : -EINVAL;
}

int FakeCard::judge_crtc(const State& next, std::uint32_t crtc) const {
    const std::optional<drmModeModeInfo> mode = mode_of(next, crtc);
    std::ptrdiff_t fed = 0;
    for (const FakeConnector& connector : connectors_) {
        if (get(next, connector.id, "CRTC_ID") == crtc) {
            ++fed;
            if (!can_feed(connector, crtc)) {
                return -EINVAL;
            }
        }
    }
    const bool active = get(next, crtc, "ACTIVE") != 0;
    const bool too_fast = mode && mode->clock > max_khz;
    return (active && !mode) || mode.has_value() != (fed > 0) || fed > 1 || too_fast ? -EINVAL : 0;
}

int FakeCard::judge(const State& next) const {
    for (const FakePlane& plane : planes_) {
        if (const int refused = judge_plane(next, plane); refused != 0) {
            return refused;
        }
    }
    for (const std::uint32_t crtc : crtcs_) {
        if (const int refused = judge_crtc(next, crtc); refused != 0) {
            return refused;
        }
    }
    return 0;
}

bool FakeCard::needs_modeset(const State& next, std::uint32_t crtc) const {
    const auto moved = [&](const FakeConnector& connector) {
        const std::uint64_t before = get(state_, connector.id, "CRTC_ID");
        const std::uint64_t after = get(next, connector.id, "CRTC_ID");
        return before != after && (before == crtc || after == crtc);
    };
    return get(state_, crtc, "ACTIVE") != get(next, crtc, "ACTIVE") ||
           get(state_, crtc, "MODE_ID") != get(next, crtc, "MODE_ID") ||
           std::any_of(connectors_.begin(), connectors_.end(), moved);
}

int FakeCard::commit(FakeFile& file, std::span<const FakeChange> changes, std::uint32_t flags,
                     std::uint64_t given_back) {
    const bool event = (flags & DRM_MODE_PAGE_FLIP_EVENT) != 0;
    const bool only_a_test = (flags & DRM_MODE_ATOMIC_TEST_ONLY) != 0;
    if (!atomic) {
        return -EOPNOTSUPP;
    }
    if (!file.atomic || (flags & ~static_cast<std::uint32_t>(DRM_MODE_ATOMIC_FLAGS)) != 0 ||
        (only_a_test && event)) {
        return -EINVAL;
    }
    State next = state_;
    std::set<std::uint32_t> touched;
    const auto touch = [&](std::uint32_t object) {
        const bool is_crtc = kinds_.at(object) == DRM_MODE_OBJECT_CRTC;
        touched.insert(is_crtc ? object : static_cast<std::uint32_t>(get(next, object, "CRTC_ID")));
    };
    for (const FakeChange& change : changes) {
        const auto object = next.find(change.object);
        if (object == next.end() || !object->second.contains(change.property) || !file.holds(change.object)) {
            return -ENOENT;
        }
        const FakeProperty& property = properties_.at(change.property);
        if (property.name == "CRTC_ID" && change.value != 0 &&
            !file.holds(static_cast<std::uint32_t>(change.value))) {
            return -EACCES;
        }
        std::uint64_t& value = object->second.at(change.property);
        if (!takes(property, change.value) || (fixed.contains(property.name) && value != change.value)) {
            return -EINVAL;
        }
        touch(change.object);
        value = change.value;
        touch(change.object);
    }
    touched.erase(0);
    if (event && touched.empty()) {
        return -EINVAL;
    }
    if (const int refused = judge(next); refused != 0) {
        return refused;
    }
    for (const std::uint32_t crtc : touched) {
        const bool dark = get(state_, crtc, "ACTIVE") == 0 && get(next, crtc, "ACTIVE") == 0;
        if ((event && dark) || ((flags & DRM_MODE_ATOMIC_ALLOW_MODESET) == 0 && needs_modeset(next, crtc))) {
            return -EINVAL;
        }
    }
    if (only_a_test) {
        return 0;
    }
    for (const std::uint32_t crtc : touched) {
        if (pending_.contains(crtc)) {
            if ((flags & DRM_MODE_ATOMIC_NONBLOCK) != 0) {
                return -EBUSY;
            }
            finish_pending(crtc);
        }
    }
    for (const std::uint32_t crtc : touched) {
        const bool modeset = (flags & DRM_MODE_ATOMIC_ALLOW_MODESET) != 0;
        pending_[crtc] = Pending{.file = event ? &file : nullptr,
                                 .given_back = given_back,
                                 .queued_at = refreshes,
                                 .modeset = modeset};
    }
    settle(std::move(next));
    if (flips_at_once) {
        refresh();
    }
    return 0;
}

int FakeCard::set_crtc(std::uint32_t crtc, std::uint32_t framebuffer,
                       std::span<const std::uint32_t> connectors, const drmModeModeInfo* mode) {
    if (index_of(crtc) == crtcs_.size()) {
        return -ENOENT;
    }
    State next = state_;
    turn_off(next, crtc);
    if ((mode == nullptr) != connectors.empty()) {
        return -EINVAL;
    }
    if (mode != nullptr) {
        const auto memory = framebuffers_.find(framebuffer);
        const FakePlane* plane = primary(crtc);
        if (memory == framebuffers_.end() || plane == nullptr) {
            return -ENOENT;
        }
        if (memory->second.width < mode->hdisplay || memory->second.height < mode->vdisplay) {
            return -ENOSPC;
        }
        for (const std::uint32_t connector : connectors) {
            if (!kinds_.contains(connector) || kinds_.at(connector) != DRM_MODE_OBJECT_CONNECTOR) {
                return -ENOENT;
            }
            if (const auto other = static_cast<std::uint32_t>(get(next, connector, "CRTC_ID")); other != 0) {
                turn_off(next, other);
            }
            put(next, connector, "CRTC_ID", crtc);
        }
        const auto* bytes = reinterpret_cast<const std::byte*>(mode);
        blobs_[++last_id_] = {{bytes, bytes + sizeof *mode}, nullptr};
        put(next, crtc, "MODE_ID", last_id_);
        put(next, crtc, "ACTIVE", 1);
        put(next, plane->id, "FB_ID", framebuffer);
        put(next, plane->id, "CRTC_ID", crtc);
        for (const auto& [name, pixels] : {std::pair{"_W", mode->hdisplay}, {"_H", mode->vdisplay}}) {
            put(next, plane->id, std::string("SRC") + name, std::uint64_t{pixels} << 16U);
            put(next, plane->id, std::string("CRTC") + name, pixels);
        }
    }
    const int refused = judge(next);
    if (refused == 0) {
        finish_pending(crtc);
        settle(std::move(next));
        if (mode != nullptr) {
            pending_[crtc] = Pending{.queued_at = refreshes, .modeset = true};
            finish_pending(crtc);
        }
    }
    forget_unheld_blobs();
    return refused;
}

void FakeCard::finish_pending(std::uint32_t crtc) {
    while (pending_.contains(crtc)) {
        refresh();
    }
}

int FakeCard::page_flip(FakeFile& file, std::uint32_t crtc, std::uint32_t framebuffer, std::uint32_t flags,
                        std::uint64_t given_back) {
    const auto next = framebuffers_.find(framebuffer);
    if ((flags & ~static_cast<std::uint32_t>(DRM_MODE_PAGE_FLIP_FLAGS)) != 0) {
        return -EINVAL;
    }
    if (index_of(crtc) == crtcs_.size()) {
        return -ENOENT;
    }
    const FakePlane* plane = primary(crtc);
    if (plane == nullptr || value(plane->id, "FB_ID") == 0 || pending_.contains(crtc)) {
        return -EBUSY;
    }
    if (next == framebuffers_.end()) {
        return -ENOENT;
    }
    const drmModeModeInfo mode = mode_of(state_, crtc).value();
    if (next->second.width < mode.hdisplay || next->second.height < mode.vdisplay) {
        return -ENOSPC;
    }
    put(state_, plane->id, "FB_ID", framebuffer);
    pending_[crtc] = Pending{.file = (flags & DRM_MODE_PAGE_FLIP_EVENT) != 0 ? &file : nullptr,
                             .given_back = given_back,
                             .queued_at = refreshes};
    if (flips_at_once) {
        refresh();
    }
    return 0;
}

int FakeCard::set_property(std::uint32_t object, std::uint32_t id, std::uint64_t value) {
    const auto found = state_.find(object);
    if (found == state_.end() || !found->second.contains(id)) {
        return -ENOENT;
    }
    if (!takes(properties_.at(id), value) || fixed.contains(properties_.at(id).name)) {
        return -EINVAL;
    }
    found->second[id] = value;
    return 0;
}

void FakeCard::turn_off(State& state, std::uint32_t crtc) const {
    put(state, crtc, "ACTIVE", 0);
    put(state, crtc, "MODE_ID", 0);
    for (const FakePlane& plane : planes_) {
        if (get(state, plane.id, "CRTC_ID") == crtc) {
            put(state, plane.id, "CRTC_ID", 0);
            put(state, plane.id, "FB_ID", 0);
        }
    }
    for (const FakeConnector& connector : connectors_) {
        if (get(state, connector.id, "CRTC_ID") == crtc) {
            put(state, connector.id, "CRTC_ID", 0);
        }
    }
}

void FakeCard::settle(State next) {
    state_ = std::move(next);
    forget_unheld_blobs();
}

void FakeCard::forget_unheld_blobs() {
    std::erase_if(blobs_, [this](const auto& blob) {
        return blob.second.owner == nullptr &&
               std::none_of(state_.begin(), state_.end(), [&](const auto& object) {
                   return std::any_of(object.second.begin(), object.second.end(), [&](const auto& value) {
                       const bool is_blob = (properties_.at(value.first).flags & DRM_MODE_PROP_BLOB) != 0;
                       return is_blob && value.second == blob.first;
                   });
               });
    });
}

} // namespace frustumscreen::display
