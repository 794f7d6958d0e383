#include "app/pack/check_pack.h"
#include "app/pack/container/limits.h"
#include "app/pack/relief_texel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::pack {

namespace {

constexpr double similarity_tolerance = 1e-6; ///< relative
/// The extremes of an artifact authored far from its origin have lost some digits there.
constexpr double extremes_tolerance = 1e-3; ///< box units

bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// True for a rotation times one positive scale, and a translation: no mirror, no shear, no perspective.
bool is_similarity(const glm::dmat4& m) {
    const glm::dmat3 linear(m);
    const double scale = std::cbrt(glm::determinant(linear));
    if (!is_finite(m[0]) || !is_finite(m[1]) || !is_finite(m[2]) || !is_finite(m[3]) || !(scale > 1e-40) ||
        !(scale < 1e40)) {
        return false;
    }
    if (m[0][3] != 0.0 || m[1][3] != 0.0 || m[2][3] != 0.0 || m[3][3] != 1.0) {
        return false;
    }
    const glm::dmat3 rotation = linear / scale;
    const glm::dmat3 identity = glm::transpose(rotation) * rotation;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            if (!(std::abs(identity[column][row] - (row == column ? 1.0 : 0.0)) <= similarity_tolerance)) {
                return false;
            }
        }
    }
    return true;
}

Result<void> check_extremes(const PackDescription& pack) {
    if (pack.extremes.empty() || pack.extremes.size() > max_extremes) {
        return bad_input("placement.extreme_count", "the placement has {} extremes, allowed are 1 to {}",
                         pack.extremes.size(), max_extremes);
    }
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    for (const glm::dvec3& extreme : pack.extremes) {
        if (!is_finite(extreme)) {
            return bad_input("placement.extreme_not_finite",
                             "an extreme of the placement is not a finite number");
        }
        low = glm::min(low, extreme);
        high = glm::max(high, extreme);
    }
    const glm::dvec3 low_off = glm::abs(low - box_low(pack.box_size));
    const glm::dvec3 high_off = glm::abs(high - box_low(pack.box_size) - pack.box_size);
    const glm::dvec3 off = glm::max(low_off, high_off);
    if (std::max({off.x, off.y, off.z}) > extremes_tolerance) {
        return bad_input(
            "placement.extremes_of_box",
            "the placement's extremes do not reach exactly to the sides of its box; bake the pack again");
    }
    return {};
}

} // namespace

Result<void> check_placement(const PackDescription& pack) {
    const glm::dvec3& size = pack.box_size;
    if (!is_finite(size) || !(std::min({size.x, size.y, size.z}) > 0.0) ||
        !(std::abs(std::max({size.x, size.y, size.z}) - 1.0) <= similarity_tolerance)) {
        return bad_input("placement.box_size",
                         "box_size is {} x {} x {}; allowed are edges above 0, the longest 1", size.x, size.y,
                         size.z);
    }
    if (!is_similarity(pack.box_from_file)) {
        return bad_input(
            "placement.box_from_file",
            "box_from_file is not a rotation with one scale and a translation; bake the pack again");
    }
    if (!(pack.scale >= min_scale) || !(pack.scale <= max_scale)) {
        return bad_input("placement.scale", "the placement's scale is {}, allowed are {} to {}", pack.scale,
                         min_scale, max_scale);
    }
    return check_extremes(pack);
}

} // namespace frustumscreen::pack
