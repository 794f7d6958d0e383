/// Copies the exhibit's picture into the framebuffer of a screen.
///
/// Pictures above each other, for the eyes in turn, are each copied into its own part of the framebuffer.
///
/// On a screen of the picture's size every sRGB code arrives unchanged. On any other screen the picture is
/// scaled as large as fits, with black around it; the first `probe_pixels` of its top row are written
/// unscaled into the screen's top left corner.
///
/// Scaling interpolates codes, not light, as a card's own scaler does. On the processor this takes half to a
/// third of the time (800 x 600: 7 against 14 ms; on an emulated processor: 0.4 against 1.7 s), and a mode of
/// another size is the exception. Edges between bright and dark become slightly darker.
///
/// Threads  a separate context is current that shares the picture's texture; its GL state is changed.
/// Errors   the driver rejects the shaders.
/// Source   EXT_texture_sRGB_decode; IEC 61966-2-1 for the codes.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/display/letterbox.h"
#include "firmware_host/display/picture_framebuffer.h"
#include "firmware_host/gl/gl_handle.h"

namespace frustumscreen::display {

/// The row of the target that holds the picture's top row: the first in a scanned-out buffer, the last in a
/// window.
enum class TopRow { First, Last };

class PictureCopy {
public:
    /// `stacked`: number of pictures of equal height above each other, in the picture and in the framebuffer.
    [[nodiscard]] static Result<PictureCopy> create(int stacked = 1);

    /// Draws into the bound framebuffer, whose colour has 8 bits a channel and stores codes as written.
    /// `part` is the part of the picture that the framebuffer lacks; for the whole picture the surroundings
    /// are blackened too. Returns the drawn rectangle, row 0 at the top.
    PixelRectangle draw(const PictureFramebuffer& picture, PixelSize target, TopRow top,
                        const PixelRectangle& part) const;

private:
    struct Pass;
    void draw(const PictureFramebuffer& picture, const Pass& pass) const;
    PictureCopy(int stacked, gl::GlProgram program, gl::GlSampler nearest, gl::GlSampler interpolated);

    int stacked_;
    gl::GlProgram program_;
    gl::GlSampler nearest_;
    gl::GlSampler interpolated_;
    gl::GlVertexArray vertices_ = gl::GlVertexArray::generate();
};

} // namespace frustumscreen::display
