#include "app/programs/pack/pack_preview.h"

#include "app/settings/settings.h"
#include "app/show/offline_renderer.h"
#include "app/typography/canvas.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <string_view>

namespace frustumscreen::programs {

namespace {

constexpr int drawn_px = 1280;               ///< square picture of the whole prop
constexpr int side_px = 560;                 ///< the part that is kept
constexpr int caption_px = 56;               ///< the strip below it
constexpr glm::dvec3 eye_m(0.0, -0.6, 0.45); ///< settings require 30 degrees

/// Settings of a table whose projector stands at the eye, with the prop's sphere filling the picture.
Result<settings::CheckedSettings> settings_for(const settings::PropSettings& prop) {
    const geometry::PropShape shape = settings::make_prop(prop);
    double radius_m = 0.0;
    for (const glm::dvec3& corner : shape.corners) {
        radius_m = std::max(radius_m, glm::distance(corner, shape.middle));
    }
    const double distance_m = glm::distance(eye_m, shape.middle);
    const double focal_px = 0.5 * drawn_px / std::tan(std::asin(radius_m / distance_m));
    const std::string text =
        fmt::format("[projector]\nwidth = {0}\nheight = {0}\nfx = {1}\n"
                    "position_m = [{2}, {3}, {4}]\naim_m = [0.0, 0.0, {5}]\n"
                    "[prop]\nkind = \"{6}\"\nbase_m = {7}\n{8}"
                    "[eye]\ndefault_m = [{2}, {3}, {4}]\n"
                    "[tracker]\nkind = \"none\"\n",
                    drawn_px, focal_px, eye_m.x, eye_m.y, eye_m.z, shape.middle.z,
                    settings::name_of(prop.kind), prop.base_m,
                    prop.kind == settings::PropKind::Cube
                        ? std::string()
                        : fmt::format("top_m = {}\nheight_m = {}\n", prop.top_m, prop.height_m));
    return settings::parse_settings(text, "preview");
}

/// Poses of the prop in which each side in turn faces the eye.
std::array<geometry::RigidTransform, 4> turned_props() {
    std::array<geometry::RigidTransform, 4> props;
    for (std::size_t k = 0; k < props.size(); ++k) {
        const double angle = -0.5 * std::numbers::pi * static_cast<double>(k);
        props[k].rotation = glm::angleAxis(angle, glm::dvec3(0, 0, 1));
    }
    return props;
}

Result<show::OfflineSetup> setup_of(const pack::PackOutline& outline) {
    const bool is_cube = outline.description.prop_kind == settings::name_of(settings::PropKind::Cube);
    TRY(settings::CheckedSettings settings,
        settings_for(is_cube ? settings::cube_settings() : settings::PropSettings{}));
    show::OfflineOptions options;
    options.technique = "finest";
    options.light = false;
    for (const geometry::RigidTransform& table_from_prop : turned_props()) {
        options.views.push_back({table_from_prop, eye_m});
    }
    return show::OfflineSetup{std::move(settings), std::move(options)};
}

/// The square, centred on the picture's vertical middle line, that contains all light of all pictures, with a margin.
struct Frame {
    glm::dvec2 corner{0.0};
    double size = drawn_px;
};

Frame frame_of(const std::array<image::Image8, 4>& sides) {
    constexpr int dark = 8; // codes up to this are not visible
    constexpr double margin = 1.1;
    int top = drawn_px;
    int bottom = -1;
    int across = 0; // largest distance from the middle line
    for (const image::Image8& side : sides) {
        for (int y = 0; y < side.height; ++y) {
            for (int x = 0; x < side.width; ++x) {
                const glm::u8vec4 texel = side.at(x, y);
                if (std::max({texel.r, texel.g, texel.b}) > dark) {
                    top = std::min(top, y);
                    bottom = std::max(bottom, y);
                    across = std::max(across, std::abs(2 * x + 1 - side.width) / 2 + 1);
                }
            }
        }
    }
    if (bottom < top) {
        return {};
    }
    const double size = margin * std::max(2 * across, bottom + 1 - top);
    return {{0.5 * (drawn_px - size), 0.5 * (top + bottom + 1 - size)}, size};
}

} // namespace

Result<image::Image8> preview_of_pack(const std::filesystem::path& file) {
    static constexpr std::array<std::string_view, 4> names = {"front", "right", "back", "left"};
    static constexpr typography::Colour grey(150, 150, 150);
    TRY(const show::OfflineScene scene, show::load_offline(file, setup_of));
    TRY(const typography::Typesetter typesetter, typography::Typesetter::open());
    TRY(const std::unique_ptr<show::OfflineRenderer> renderer, show::OfflineRenderer::create(scene));
    std::array<image::Image8, 4> sides;
    for (std::size_t k = 0; k < sides.size(); ++k) {
        sides[k] = renderer->draw(turned_props()[k], eye_m).colour;
    }
    const Frame frame = frame_of(sides);
    typography::Canvas canvas(static_cast<int>(names.size()) * side_px, side_px + caption_px,
                              typography::Colour(0));
    int left = 0;
    for (std::size_t k = 0; k < names.size(); ++k, left += side_px) {
        canvas.picture(sides[k], frame.corner, glm::dvec2(frame.size), {left, 0}, {side_px, side_px});
        canvas.text(typesetter, names[k], {left + 0.5 * side_px, side_px + 0.5 * caption_px}, 24.0, grey,
                    {0.5, 0.5});
    }
    return canvas.take();
}

} // namespace frustumscreen::programs
