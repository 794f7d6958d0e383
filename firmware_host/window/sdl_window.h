/// A window on a developer's desktop in place of the projector, the mouse in place of the tracker, keys in
/// place of the buttons. Never in the kiosk's program.
///
/// Halves   left the projector's picture, right what the visitor's eye sees.
/// Input    drag = slide the prop; wheel or right drag = turn it; middle drag = move the eye; keys 1 to 5 = buttons 0 to 4;
///          H = help over the window; Esc, or closing the window, raises SIGTERM.
/// Frame    table T.
/// Threads  one: the display, the tracker and the panel share it and the window.
/// Errors   no desktop, no OpenGL ES 3 on it.
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

namespace frustumscreen {

/// A picture laid over the window, pixel for pixel: sRGB codes, RGBA, row 0 at the top.
struct WindowHelp {
    PixelSize size;
    std::vector<std::uint8_t> rgba;
};

using TableFromPicture = std::function<std::optional<glm::dvec2>(const glm::dvec2& pixel)>;

/// What the window shows and does not know itself. Pixels are of the picture and of the visitor's half, from their top
/// left corners.
struct WindowSetUp {
    int width = 0; ///< of the picture, pixels
    int height = 0;
    glm::dvec2 half_extent_m{0.3, 0.2}; ///< where the prop can be slid to
    glm::dvec3 eye_m{0.0, -0.55, 0.5};  ///< at first
    TableFromPicture table_from_picture;
    std::function<std::optional<glm::dvec2>(const glm::dvec2& pixel, const glm::dvec3& eye_m, PixelSize half)>
        table_from_view;
    std::function<void(const PoseSample& prop, const glm::dvec3& eye_m, PixelSize half, SeenSurfaces& seen)>
        see;
    WindowHelp help;
};

struct Window {
    std::unique_ptr<Display> display;
    std::unique_ptr<Tracker> tracker; ///< the prop and the head
    std::unique_ptr<Panel> panel;
};
[[nodiscard]] Result<Window> open_window(const WindowSetUp& set_up);

} // namespace frustumscreen
