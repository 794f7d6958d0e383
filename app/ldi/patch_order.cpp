#include "app/ldi/patch_order.h"

namespace frustumscreen::ldi {

std::optional<std::size_t> PatchOrder::look_from(const glm::dvec3& eye) {
    const std::optional<std::size_t> patch = hemisphere_.patch_of(eye);
    if (patch) {
        looking_from_ = glm::normalize(eye);
    }
    return patch;
}

std::optional<std::size_t> PatchOrder::next(const std::array<bool, patch_count>& made) const {
    const std::optional<std::size_t> looked_at = hemisphere_.patch_of(looking_from_);
    std::optional<std::size_t> next;
    double nearest = -2.0;
    for (std::size_t patch = 0; patch < patch_count; ++patch) {
        const double near = patch == looked_at ? 2.0 : glm::dot(looking_from_, hemisphere_.middle_of(patch));
        if (!made[patch] && near > nearest) {
            next = patch;
            nearest = near;
        }
    }
    return next;
}

} // namespace frustumscreen::ldi
