/// The letters of the two eyes on the alignment pattern (typography/eye_letter.h): each is shown to its eye alone, in an
/// anaglyph by its colour: the L in red, the R in cyan.
///
/// Memory   `put` allocates; `show` does not.
/// Threads  the render thread, with the display's context current.
#pragma once

#include "app/image/image.h"
#include "app/render/picture_upload.h"
#include "app/show/eye_parts.h"
#include "app/typography/eye_letter.h"

#include <array>

namespace frustumscreen::show {

class EyeLetters {
public:
    /// `pattern`: without the prop's edges.
    EyeLetters(const EyeParts& eyes, const image::Image8& pattern, const typography::Typesetter& typesetter);

    /// Draws the letters below the contents that `picture` has in their places.
    void put(const image::Image8& picture);
    /// Shows them on that picture.
    void show(unsigned framebuffer);

private:
    EyeParts eyes_;
    std::array<typography::EyeLetter, 2> letters_;
    std::array<render::PictureUpload, 2> uploads_;
};

} // namespace frustumscreen::show
