/// A scene on a display of its own: in the prop, as the exhibit shows it, and behind windows of `pixels` x `pixels`.
///
/// One window's data serve all windows of the bench: they freeze the same world in the same pose.
///
/// Samples  one a pixel.
/// Frames   table T for the prop; window for windows.
/// Threads  the one that opened the set: the display's context is current there.
/// Errors   no display; a driver without memory.
#pragma once

#include "app/bench/ldi/window_scene.h"
#include "app/bench/techniques/peer_gl.h"
#include "app/render/hit_points.h"
#include "app/render/renderer.h"
#include "app/scene/frame_plan.h"
#include "app/settings/settings.h"
#include "firmware_host/display/surfaceless_display.h"

#include <memory>
#include <optional>
#include <span>

namespace frustumscreen::bench {

class WindowSet {
public:
    [[nodiscard]] static Result<std::unique_ptr<WindowSet>> open(settings::Settings settings,
                                                                 WindowScene scene, int pixels);
    WindowSet(const WindowSet&) = delete;
    WindowSet& operator=(const WindowSet&) = delete;

    [[nodiscard]] const WindowScene& scene() const { return scene_; }
    [[nodiscard]] int pixels() const { return pixels_; } ///< along a window's side
    [[nodiscard]] double pixel_m() const { return window_side_m / pixels_; }
    [[nodiscard]] const scene::FlatScreen& screen() const { return screen_; }
    /// Plans and draws the scene alone, in the prop, for an eye in the window's directions.
    void draw_alone(const glm::dvec3& eye_m);

    /// Renderer and target of a single window.
    [[nodiscard]] render::Renderer& renderer() { return *windows_; }
    [[nodiscard]] render::RenderTarget target() const { return {target_.framebuffer.get(), 0}; }
    /// Plans and draws a window's whole picture.
    void draw(std::span<const scene::Part> parts, const glm::dvec3& eye_m, scene::FramePlan& plan);
    /// Puts a picture from main memory into the target: sRGB codes, row by row, the top one first.
    void show(std::span<const glm::u8vec4> codes);
    [[nodiscard]] image::ImageFloat hit_points(const scene::FramePlan& plan);
    [[nodiscard]] image::Image8 read_colour() const;
    /// The picture of the scene alone.
    [[nodiscard]] image::Image8 read_alone() const;

    /// A mesh in the site's frame, to be drawn by the renderer of windows, or of the scene alone.
    struct Uploaded {
        scene::PlacedLevel placed;
        std::uint64_t bytes = 0; ///< of both memories
    };
    [[nodiscard]] Result<Uploaded> upload(render::Renderer& renderer, const bake::SourceMesh& mesh) const;
    /// The scene's own triangles behind a window.
    [[nodiscard]] const scene::PlacedLevel& geometry() const { return geometry_; }

private:
    WindowSet(settings::Settings settings, WindowScene scene, int pixels);

    settings::Settings settings_;
    WindowScene scene_;
    int pixels_;
    geometry::PropShape prop_;
    scene::FlatScreen screen_;
    std::unique_ptr<display::SurfacelessDisplay> display_; ///< first of all that lives in its context
    std::optional<render::Renderer> alone_, windows_;
    OffscreenTarget target_;
    std::optional<render::HitPointRenderer> hit_points_;
    scene::PlacedLevel in_prop_, geometry_;
    scene::FramePlan alone_plan_;
};

} // namespace frustumscreen::bench
