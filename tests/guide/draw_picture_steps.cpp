// Draws, for docs/conventions.md, how a picture comes onto the prop, after Fig. 11 of Kim, Shin, Kim, Using relief texture for
// interactive and tangible virtual environments, 2008. From left to right: the artifact in the prop's outline; the picture that
// belongs on the prop's faces, as the visitor sees it; what the projector sends for it; that light on the bare table; on the
// prop.
//
//   draw_picture_steps PACK PICTURE.webp

#include "app/image/image.h"
#include "app/settings/settings.h"
#include "app/show/offline_renderer.h"
#include "app/simulation/visitor_view.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace frustumscreen::tests {
namespace {

constexpr int panel_px = 240;
constexpr int gap_px = 4;

const geometry::RigidTransform table_from_prop{glm::angleAxis(0.4, glm::dvec3(0.0, 0.0, 1.0)),
                                               {0.06, 0.0, 0.0}};
constexpr glm::dvec3 eye_m(0.22, -0.5, 0.5);

/// The shipped settings, or those of a projector that stands where a camera does.
Result<settings::CheckedSettings> settings_of(const simulation::VisitorCamera* camera) {
    if (camera == nullptr) {
        return settings::parse_settings("", "shipped");
    }
    const glm::dmat4 place = camera->table_from_camera.matrix();
    std::string numbers;
    for (int k = 0; k < 16; ++k) {
        numbers += fmt::format("{}{:.17e}", k > 0 ? ", " : "", glm::value_ptr(place)[k]);
    }
    const geometry::Pinhole& lens = camera->pinhole;
    return settings::parse_settings(
        fmt::format(
            "[projector]\nwidth = {}\nheight = {}\nfx = {:.9f}\nfy = {:.9f}\ncx = {:.9f}\ncy = {:.9f}\n"
            "table_from_projector = [{}]\n",
            lens.width, lens.height, lens.fx, lens.fy, lens.cx, lens.cy, numbers),
        "camera");
}

/// The projector's picture for the eye. Without light, a pixel has the artifact's own colour.
Result<image::Image8> projected(const std::filesystem::path& pack, const settings::CheckedSettings& settings,
                                bool light) {
    show::OfflineOptions options;
    options.technique = "finest";
    options.light = light;
    TRY(const show::OfflineScene scene, show::load_offline(pack, [&](const pack::PackOutline&) {
            return Result<show::OfflineSetup>(show::OfflineSetup{settings, options});
        }));
    TRY(const std::unique_ptr<show::OfflineRenderer> renderer, show::OfflineRenderer::create(scene));
    return renderer->draw(table_from_prop, eye_m).colour;
}

/// A grey line of one pixel and a half, over what is there.
void draw_line(image::Image8& picture, const glm::dvec2& a, const glm::dvec2& b) {
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const glm::dvec2 p(x + 0.5, y + 0.5);
            const double along = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
            const double cover = std::clamp(1.25 - glm::distance(p, glm::mix(a, b, along)), 0.0, 1.0);
            glm::u8vec4& texel = picture.at(x, y);
            const glm::dvec3 mixed = glm::mix(glm::dvec3(texel), glm::dvec3(150.0), cover);
            texel = glm::u8vec4(glm::u8vec3(mixed + 0.5), 255);
        }
    }
}

void draw_outline(image::Image8& picture, const geometry::PropShape& prop, const geometry::Pinhole& pinhole,
                  const geometry::RigidTransform& table_from_view) {
    const geometry::RigidTransform view_from_prop = table_from_view.inverse() * table_from_prop;
    const auto pixel = [&](const glm::dvec3& corner) {
        return pinhole.pixel(view_from_prop.point(corner)).value();
    };
    for (const geometry::PropFace& face : prop.faces) {
        for (std::size_t k = 0; k < face.corners.size(); ++k) {
            draw_line(picture, pixel(face.corners[k]), pixel(face.corners[(k + 1) % face.corners.size()]));
        }
    }
}

/// The square around the prop, as a projector or camera sees it, in a panel's size.
image::Image8 around_prop(const image::Image8& picture, const geometry::PropShape& prop,
                          const geometry::Pinhole& pinhole, const geometry::RigidTransform& table_from_view) {
    const geometry::RigidTransform view_from_prop = table_from_view.inverse() * table_from_prop;
    glm::dvec2 low(1e9);
    glm::dvec2 high(-1e9);
    for (const geometry::PropFace& face : prop.faces) {
        for (const glm::dvec3& corner : face.corners) {
            const glm::dvec2 at = pinhole.pixel(view_from_prop.point(corner)).value();
            low = glm::min(low, at);
            high = glm::max(high, at);
        }
    }
    const double side = 1.08 * std::max(high.x - low.x, high.y - low.y);
    const glm::dvec2 corner = 0.5 * (low + high) - 0.5 * side;
    image::Image8 panel(panel_px, panel_px);
    constexpr int rays = 4;
    for (int y = 0; y < panel_px; ++y) {
        for (int x = 0; x < panel_px; ++x) {
            glm::dvec3 sum(0.0);
            for (int k = 0; k < rays * rays; ++k) {
                const glm::dvec2 at =
                    corner + side *
                                 (glm::dvec2(x, y) + (glm::dvec2(k % rays, k / rays) + 0.5) / double{rays}) /
                                 double{panel_px};
                const glm::ivec2 from = glm::clamp(glm::ivec2(glm::floor(at)), glm::ivec2(0),
                                                   glm::ivec2(picture.width - 1, picture.height - 1));
                sum += glm::dvec3(picture.at(from.x, from.y));
            }
            panel.at(x, y) = glm::u8vec4(glm::u8vec3(sum / double{rays * rays} + 0.5), 255);
        }
    }
    return panel;
}

image::Image8 beside_each_other(const std::vector<image::Image8>& panels) {
    const int count = static_cast<int>(panels.size());
    image::Image8 strip(count * panel_px + (count - 1) * gap_px, panel_px, glm::u8vec4(255));
    for (int k = 0; k < count; ++k) {
        for (int y = 0; y < panel_px; ++y) {
            for (int x = 0; x < panel_px; ++x) {
                strip.at(k * (panel_px + gap_px) + x, y) = panels[static_cast<std::size_t>(k)].at(x, y);
            }
        }
    }
    return strip;
}

Result<void> draw(const std::filesystem::path& pack, const std::filesystem::path& file) {
    TRY(const settings::CheckedSettings shipped, settings_of(nullptr));
    const settings::ProjectorSettings& projector = shipped->projector;
    const geometry::PropShape prop = settings::make_prop(shipped->prop);
    const simulation::VisitorCamera camera =
        simulation::visitor_camera(prop, table_from_prop, eye_m, panel_px, panel_px);
    TRY(const settings::CheckedSettings as_projector, settings_of(&camera));
    TRY(image::Image8 in_the_box, projected(pack, as_projector, false));
    draw_outline(in_the_box, prop, camera.pinhole, camera.table_from_camera);
    TRY(const image::Image8 plain, projected(pack, shipped, false));
    TRY(const image::Image8 sent, projected(pack, shipped, true));
    simulation::VisitorScene scene{.projector = projector.pinhole,
                                   .table_from_projector = projector.table_from_projector,
                                   .prop = prop,
                                   .table_from_prop = table_from_prop,
                                   .eye_m = eye_m,
                                   .table_size_m = {shipped->table.width_m, shipped->table.depth_m}};
    image::Image8 on_faces = simulation::visitor_view(scene, plain, camera, {.light = false});
    draw_outline(on_faces, prop, camera.pinhole, camera.table_from_camera);
    image::Image8 sent_outlined = sent;
    draw_outline(sent_outlined, prop, projector.pinhole, projector.table_from_projector);
    const image::Image8 from_above =
        around_prop(sent_outlined, prop, projector.pinhole, projector.table_from_projector);
    const image::Image8 on_prop = simulation::visitor_view(scene, sent, camera);
    scene.table_from_prop.translation.z = -100.0; // away
    const image::Image8 on_table = simulation::visitor_view(scene, sent, camera);
    const image::Image8 strip = beside_each_other({in_the_box, on_faces, from_above, on_table, on_prop});
    return write_file(file, image::encode_lossy_webp(strip, 92.0F));
}

} // namespace
} // namespace frustumscreen::tests

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("usage: draw_picture_steps PACK PICTURE.webp\n", stderr);
        return 2;
    }
    if (const auto drawn = frustumscreen::tests::draw(argv[1], argv[2]); !drawn) {
        fmt::print(stderr, "draw_picture_steps: {}\n", drawn.error().message);
        return 1;
    }
    return 0;
}
