/// A window on a developer's desktop in place of the projector, the mouse in place of the tracker, keys in
/// place of the buttons. Not part of the kiosk's program.
///
/// Halves   left: the projector's picture; right: the view from the visitor's eye.
/// Input    drag = slide the prop; wheel or right drag = turn it; middle drag = move the eye; keys 1 to 5 =
///          buttons 0 to 5; H = help over the window; Esc, or closing the window, raises SIGTERM.
/// Frame    table T.
/// Threads  one: the display, the tracker and the panel share it and the window.
/// Errors   no desktop, or no OpenGL ES 3 on it.
#pragma once

#include "firmware_host/display/display.h"
#include "firmware_host/panel/panel.h"
#include "firmware_host/tracker/tracker.h"
#include "firmware_host/window/seen_surfaces.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace frustumscreen::window {

/// A picture drawn over the window without scaling: sRGB codes, RGBA, row 0 at the top.
struct WindowHelp {
    PixelSize size;
    std::vector<std::uint8_t> rgba;
};

using TableFromPicture = std::function<std::optional<glm::dvec2>(const glm::dvec2& pixel)>;

/// Parameters of the window. Pixels are those of the picture and of the visitor's half, from their top left
/// corners.
struct WindowSetUp {
    int width = 0; ///< of the picture, pixels
    int height = 0;
    glm::dvec2 half_extent_m{0.3, 0.2}; ///< bounds of the prop's centre
    glm::dvec3 eye_m{0.0, -0.55, 0.5};  ///< initially
    TableFromPicture table_from_picture;
    std::function<std::optional<glm::dvec2>(const glm::dvec2& pixel, const glm::dvec3& eye_m, PixelSize half)>
        table_from_view;
    std::function<void(const tracker::PoseSample& prop, const glm::dvec3& eye_m, PixelSize half,
                       SeenSurfaces& seen)>
        see;
    WindowHelp help;
};

struct Window {
    std::unique_ptr<display::Display> display;
    std::unique_ptr<tracker::Tracker> tracker; ///< the prop and the head
    std::unique_ptr<panel::Panel> panel;
};
[[nodiscard]] Result<Window> open_window(const WindowSetUp& set_up);

} // namespace frustumscreen::window
