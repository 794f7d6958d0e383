/// One way to make the projector's picture, drawn and timed by the bench.
///
/// Colour   drawn into the display's framebuffer; a texture's sRGB codes pass unchanged, as with --unlit
///          --no-light, for comparison with the ray cast.
/// Threads  the one that owns the display's context.
#pragma once

#include "app/bench/truth/poses.h"
#include "app/bench/truth/shown_light.h"
#include "app/scene/error_estimate.h"

#include <optional>
#include <string>

namespace frustumscreen::bench {

/// The target of every technique: one kiosk's settings, its prop and a framebuffer of the projector's size.
struct Kiosk {
    settings::Settings settings;
    geometry::PropShape prop;
    unsigned framebuffer = 0;

    [[nodiscard]] int width() const { return settings.projector.pinhole.width; }
    [[nodiscard]] int height() const { return settings.projector.pinhole.height; }
};

/// A technique's picture as the kiosk shows it: even light, the artifact's exposure, soft edges between
/// faces.
class ShownPicture {
public:
    virtual ~ShownPicture() = default;
    virtual void draw_shown(const BenchPose& pose) = 0;
    [[nodiscard]] virtual LightAim light(const BenchPose& pose) const = 0;
    /// Draws the artifact entirely white and without light, so a pixel's linear light is the share of it that
    /// the artifact covers. Returns the requested samples per pixel; without space for them, fewer are drawn.
    [[nodiscard]] virtual int draw_white(const BenchPose& pose) = 0;
};

class Technique {
public:
    virtual ~Technique() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    /// A full redraw, including the clear.
    virtual void draw(const BenchPose& pose) = 0;
    /// The redraw that is timed, in the requested light. The caller that times it calls glFinish.
    virtual void draw_timed(const BenchPose& pose) { draw(pose); }
    /// Each pixel's hit point in the prop's frame, metres; NaN = no hit.
    [[nodiscard]] virtual Result<image::ImageFloat> hit_points(const BenchPose& pose) = 0;
    /// The exhibit's estimate of its own picture's error; nullopt: the technique has no estimate, or shows
    /// nothing.
    [[nodiscard]] virtual std::optional<scene::ErrorEstimate> estimate(const BenchPose& /*pose*/) {
        return std::nullopt;
    }
    /// Null: the kiosk shows no such picture.
    [[nodiscard]] virtual ShownPicture* as_shown() { return nullptr; }
};

} // namespace frustumscreen::bench
