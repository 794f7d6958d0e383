// The kernel's leases of a card's objects.
#include "tests/display/fake_card.h"

#include <algorithm>
#include <cerrno>

namespace frustumscreen::display {

std::set<std::uint32_t> FakeCard::leased_with(const FakeFile& lessor,
                                              std::span<const std::uint32_t> objects) const {
    std::set<std::uint32_t> all(objects.begin(), objects.end());
    for (const std::uint32_t object : objects) {
        const bool is_crtc = index_of(object) < crtcs_.size();
        if (const FakePlane* plane = is_crtc ? primary(object) : nullptr;
            plane != nullptr && !lessor.universal_planes) {
            all.insert(plane->id);
        }
    }
    return all;
}

int FakeCard::judge_lease(const FakeFile& lessor, std::span<const std::uint32_t> objects,
                          const std::set<std::uint32_t>& held) const {
    if (lessor.lessor != nullptr) {
        return -EINVAL;
    }
    std::set<std::uint32_t> kinds;
    for (const std::uint32_t object : objects) {
        const auto kind = kinds_.find(object);
        if (kind == kinds_.end()) {
            return -ENOENT;
        }
        kinds.insert(kind->second);
    }
    if (!kinds.contains(DRM_MODE_OBJECT_CRTC) || !kinds.contains(DRM_MODE_OBJECT_CONNECTOR) ||
        (lessor.universal_planes && !kinds.contains(DRM_MODE_OBJECT_PLANE)) ||
        kinds.contains(DRM_MODE_OBJECT_ENCODER)) {
        return -EINVAL;
    }
    const std::set<std::uint32_t> all = leased_with(lessor, objects);
    const bool busy = std::any_of(all.begin(), all.end(), [&](auto object) { return held.contains(object); });
    return busy ? -EBUSY : 0;
}

std::uint32_t FakeCard::counted(const FakeFile& file, std::uint32_t crtcs) const {
    std::uint32_t mask = 0;
    unsigned count = 0;
    for (std::size_t k = 0; k < crtcs_.size(); ++k) {
        if (file.holds(crtcs_[k])) {
            mask |= ((crtcs >> k) & 1U) << count++;
        }
    }
    return mask;
}

} // namespace frustumscreen::display
