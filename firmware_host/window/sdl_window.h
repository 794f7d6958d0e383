/// A window on a developer's desktop in place of the projector, the mouse in place of the tracker, keys in
/// place of the buttons. Never in the kiosk's program.
///
/// Input    drag = slide the prop; wheel or right drag = turn it; keys 1, 2, 3 = buttons; Esc, or closing the
///          window, raises SIGTERM.
/// Frame    table T; `table_from_picture` says where on the table a pixel of the picture lies.
/// Threads  one: the display, the tracker and the panel share it and the window.
/// Errors   no desktop, no OpenGL ES 3 on it.
#pragma once

#include "firmware_host/display/display.h"
#include "firmware_host/panel/panel.h"
#include "firmware_host/tracker/tracker.h"

#include <glm/glm.hpp>

#include <functional>
#include <memory>
#include <optional>

namespace frustumscreen {

using TableFromPicture = std::function<std::optional<glm::dvec2>(const glm::dvec2& pixel)>;

struct WindowSetUp {
    int width = 0; ///< of the picture, pixels
    int height = 0;
    glm::dvec2 half_extent_m{0.3, 0.2}; ///< where the prop can be slid to
    TableFromPicture table_from_picture;
};

struct Window {
    std::unique_ptr<Display> display;
    std::unique_ptr<Tracker> tracker;
    std::unique_ptr<Panel> panel;
};
[[nodiscard]] Result<Window> open_window(const WindowSetUp& set_up);

} // namespace frustumscreen
