#include "app/show/window_light.h"

#include "app/scene/torch_tiles.h"

#include <algorithm>
#include <cmath>

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

bool WindowLight::shows_textures() const {
    return std::any_of(in_prop_.begin(), in_prop_.begin() + static_cast<std::ptrdiff_t>(count_),
                       shows_texture);
}

bool WindowLight::fade_textures(MonotonicTime now, bool is_on_show) {
    const double step = faded_at_ ? to_seconds(now - *faded_at_) / fade_s : 0.0;
    faded_at_ = now;
    share_ = std::clamp(share_ + (is_on_show ? step : -step), 0.0, 1.0);
    return share_ <= 0.0 && leave_out(shows_texture);
}

/// Returns to 1 as the last lights fade.
double WindowLight::house_light() const {
    const auto end = in_prop_.begin() + static_cast<std::ptrdiff_t>(count_);
    const bool all_fade = std::all_of(in_prop_.begin(), end, shows_texture);
    return !is_lit() ? 1.0 : std::lerp(1.0, house_light_, all_fade ? share_ : 1.0);
}

std::span<const scene::PlacedTorch> WindowLight::behind(const scene::PinnedView& view,
                                                        const geometry::RigidTransform& table_from_window) {
    std::transform(in_prop_.begin(), in_prop_.begin() + static_cast<std::ptrdiff_t>(count_), behind_.begin(),
                   [&](const scene::PlacedTorch& torch) {
                       scene::PlacedTorch moved = scene::moved_behind(view, table_from_window, torch);
                       moved.brightness *= shows_texture(torch) ? static_cast<float>(share_) : 1.0F;
                       return moved;
                   });
    return std::span(behind_).first(count_);
}

} // namespace frustumscreen::show
