/// Pictures for the preview's page: the artifact as seen by a visitor who turns the prop once around.
///
/// The exhibit's renderer draws the projector's picture at the finest level, and the simulated eye sees the prop under
/// it (preview_view.h).
///
/// Frames   table T, metres; places in a picture as shares of its width and height, from the top left.
/// Errors   as load_pack; no OpenGL ES.
/// Threads  one: it holds a GL context while it draws; the views use all cores.
#pragma once

#include "app/image/image.h"
#include "firmware_host/base/result.h"

#include <glm/glm.hpp>

#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

namespace frustumscreen::programs {

/// A hotspot's place in a picture; `seen` is false while its surface faces away from the visitor.
struct MarkPlace {
    double x = 0.0, y = 0.0;
    bool seen = false;
};

/// A whole turn, counter-clockwise seen from above, in equal steps from the front.
struct TurnPictures {
    int columns = 1, rows = 1; ///< in the sheet
    int frames = 1;
    glm::ivec2 size{0};                        ///< size of one picture
    image::Image8 sheet;                       ///< row by row
    std::vector<std::vector<MarkPlace>> marks; ///< by hotspot, by frame
};

struct TurnOptions {
    int columns = 6, rows = 6; ///< one step is 360 degrees / (columns x rows)
    glm::ivec2 size{600, 420};
    int projected_width = 0; ///< width of the projector's picture; 0: the projector's own
    std::function<void(std::string_view step, double done)> progress = [](std::string_view, double) {};
};

[[nodiscard]] Result<TurnPictures> turn_pictures(const std::filesystem::path& pack_file,
                                                 const TurnOptions& options = {});

} // namespace frustumscreen::programs
