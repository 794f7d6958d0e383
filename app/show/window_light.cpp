#include "app/show/window_light.h"

#include "app/scene/torch_tiles.h"

#include <algorithm>

namespace frustumscreen::show {

namespace {

bool shows_texture(const scene::PlacedTorch& torch) {
    return torch.picture != scene::TextureId::None || (scene::parts_of(torch) & torch::LayerPart) != 0;
}

} // namespace

void WindowLight::keep(const LightInProp& light) {
    const geometry::RigidTransform prop_from_table = light.table_from_prop.inverse();
    count_ = 0;
    for (const scene::PlacedTorch& torch : light.torches) {
        if (torch.brightness > 0.0F && count_ < in_prop_.size()) {
            in_prop_[count_] = torch;
            in_prop_[count_++].table_from_torch = prop_from_table * torch.table_from_torch;
        }
    }
    house_light_ = light.house_light;
}

template <typename IsLeftOut> bool WindowLight::leave_out(const IsLeftOut& is_left_out) {
    const auto end = in_prop_.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto kept = std::remove_if(in_prop_.begin(), end, is_left_out);
    count_ = static_cast<std::size_t>(kept - in_prop_.begin());
    return kept != end;
}

void WindowLight::leave_out_beside(const scene::WorldBall& world) {
    leave_out([&](const scene::PlacedTorch& torch) {
        const scene::BeamPlanes beam(torch.beam, torch.table_from_torch.inverse().matrix());
        return !beam.may_light(world.middle, world.radius);
    });
}

bool WindowLight::leave_out_textures() {
    return leave_out(shows_texture);
}

std::span<const scene::PlacedTorch> WindowLight::behind(const scene::PinnedView& view,
                                                        const geometry::RigidTransform& table_from_window) {
    std::transform(
        in_prop_.begin(), in_prop_.begin() + static_cast<std::ptrdiff_t>(count_), behind_.begin(),
        [&](const scene::PlacedTorch& torch) { return scene::moved_behind(view, table_from_window, torch); });
    return std::span(behind_).first(count_);
}

} // namespace frustumscreen::show
