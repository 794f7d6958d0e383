/// Draws the screen's picture, in a context of its own.
///
/// Frames   table T, metres.
/// Threads  the one that created it. Its GL context is current after `create` and after `draw`; another one may be current
///          at destruction.
/// Errors   as RoomShow; both eyes without a layout for them.
#pragma once

#include "app/image/image.h"
#include "app/programs/frustumscreen/render/eye_choice.h"
#include "app/show/room_show.h"
#include "firmware_host/display/surfaceless_display.h"

#include <memory>
#include <span>
#include <string_view>

namespace frustumscreen::programs {

class ScreenPainter {
public:
    /// The settings must have a screen. `eye`, `one_eye`: as choose_eye.
    [[nodiscard]] static Result<std::unique_ptr<ScreenPainter>> create(const settings::Settings& settings,
                                                                       std::string_view eye, bool one_eye);
    ~ScreenPainter();
    ScreenPainter(const ScreenPainter&) = delete;
    ScreenPainter& operator=(const ScreenPainter&) = delete;

    [[nodiscard]] EyeChoice eye() const { return eye_; }
    /// `seconds`: since the objects began to move. `eyes_m`: those of `eye()`. Waits until it is drawn.
    void draw(double seconds, std::span<const glm::dvec3> eyes_m);
    /// The latest picture.
    [[nodiscard]] image::Image8 picture() const;
    [[nodiscard]] const show::RoomShow& room() const { return *room_; }

private:
    explicit ScreenPainter(EyeChoice eye) : eye_(eye) {}

    EyeChoice eye_;
    std::unique_ptr<display::SurfacelessDisplay> display_; ///< before what lives in its context
    std::unique_ptr<show::RoomShow> room_;
};

} // namespace frustumscreen::programs
