/// One way to make the projector's picture, as the bench draws and times it.
///
/// Colour   drawn into the display's framebuffer, a texture's sRGB codes as they are passed on; --unlit --no-light,
///          so that it can be compared with the ray cast.
/// Threads  the one that owns the display's context.
#pragma once

#include "app/bench/truth/poses.h"
#include "app/bench/truth/shown_light.h"
#include "app/scene/error_estimate.h"

#include <optional>
#include <string>

namespace frustumscreen {

/// What every technique draws on: one kiosk's settings, its prop and a framebuffer of the projector's size.
struct Stage {
    Settings settings;
    PropShape prop;
    unsigned framebuffer = 0;

    [[nodiscard]] int width() const { return settings.projector.pinhole.width; }
    [[nodiscard]] int height() const { return settings.projector.pinhole.height; }
};

/// What the kiosk makes of a technique of its own: even light, the artifact's exposure, soft edges between faces.
class ShownPicture {
public:
    virtual ~ShownPicture() = default;
    virtual void draw_shown(const BenchPose& pose) = 0;
    [[nodiscard]] virtual LightAim light(const BenchPose& pose) const = 0;
    /// The artifact white all over and in no light, so that a pixel's linear light is the share of it that the artifact covers.
    /// Returns the samples a pixel that are asked for; where there is no room for them, fewer are drawn.
    [[nodiscard]] virtual int draw_white(const BenchPose& pose) = 0;
};

class Technique {
public:
    virtual ~Technique() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    /// A full redraw, clear included.
    virtual void draw(const BenchPose& pose) = 0;
    /// The one that is timed, in the light that was asked for. Whoever times it calls glFinish.
    virtual void draw_timed(const BenchPose& pose) { draw(pose); }
    /// Each pixel's hit point in the prop's frame, metres; NaN = no hit.
    [[nodiscard]] virtual Result<ImageFloat> hit_points(const BenchPose& pose) = 0;
    /// What the exhibit says of its own picture's error; nothing: the technique says nothing, or shows nothing.
    [[nodiscard]] virtual std::optional<ErrorEstimate> estimate(const BenchPose& /*pose*/) {
        return std::nullopt;
    }
    /// Null: the kiosk shows no such picture.
    [[nodiscard]] virtual ShownPicture* as_shown() { return nullptr; }
};

} // namespace frustumscreen
