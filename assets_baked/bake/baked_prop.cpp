#include "assets_baked/bake/bake.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::bake {

BakedProp baked_frustum() {
    return {"frustum", geometry::make_frustum(geometry::shipped_frustum), {}};
}

BakedProp baked_cube() {
    return {"cube", geometry::make_cube(geometry::FrustumSize{}.base_m), ViewingZone::all_around()};
}

BakedProp baked_solid(geometry::PropShape shape) {
    return {"cube", std::move(shape), ViewingZone::all_around()};
}

std::uintmax_t space_for_pack(int size) {
    constexpr std::uintmax_t triangles_bytes = 20'000'000;
    constexpr std::uintmax_t bytes_each_square = 200; // for all levels and the relief
    constexpr std::uintmax_t max_bytes = std::uintmax_t{2} << 30;
    const auto edge = static_cast<std::uintmax_t>(size);
    return std::min(max_bytes, triangles_bytes + bytes_each_square * edge * edge);
}

std::int64_t useful_picture_texels(int size) {
    constexpr std::int64_t least = std::int64_t{1} << 24; // 4096 x 4096
    constexpr std::int64_t most = std::int64_t{1} << 28;  // 1 GiB
    return std::clamp(std::int64_t{256} * size * size, least, most);
}

} // namespace frustumscreen::bake
