/// The parts of the display's picture in which the eyes see a picture that is made for the projector's whole picture,
/// such as the alignment pattern: shrunk into each eye's part of a stereo layout. Without stereo, and as an anaglyph, both
/// eyes see it unchanged.
///
/// Units    pixels.
/// Threads  the render thread, with the display's context current. Allocates nothing.
#pragma once

#include "app/render/picture_upload.h"
#include "app/scene/stereo.h"
#include "app/settings/settings.h"

#include <cstddef>

namespace frustumscreen::show {

class EyeParts {
public:
    explicit EyeParts(const settings::Settings& settings);

    /// The display's picture.
    [[nodiscard]] PixelRectangle whole() const {
        return {.x = 0, .y = 0, .width = layout_.display.width, .height = layout_.display.height};
    }
    /// True if each eye has a part of its own.
    [[nodiscard]] bool are_apart() const { return !layout_.pictures[0].viewport.empty(); }
    /// The part of the display's picture in which the eye sees `part` of the projector's picture.
    [[nodiscard]] PixelRectangle seen_by(std::size_t eye, const PixelRectangle& part) const;

    /// Shows a stored picture to both eyes. `place`: of its upper left corner in the projector's picture.
    void show(render::PictureUpload& upload, unsigned framebuffer,
              const glm::ivec2& place = glm::ivec2(0)) const;
    /// Shows it to one eye; if the eyes are not apart, to both.
    void show_to(std::size_t eye, render::PictureUpload& upload, unsigned framebuffer,
                 const glm::ivec2& place) const;

private:
    scene::StereoLayout layout_;
    PixelSize picture_; ///< of the projector
};

} // namespace frustumscreen::show
