/// Copies the exhibit's picture into what a screen shows.
///
/// Of the same size, every sRGB code arrives as it is; of another one, the picture is scaled to as large as
/// it fits, with black around it, and the first `code_pixels` of its top row are written into the screen's
/// top left corner as they are.
///
/// Codes are interpolated, as a card's own scaler does it, not light: on a processor that draws this takes
/// half to a third of the time (800 x 600: 7 against 14 ms; one that is emulated: 0.4 against 1.7 s), and a
/// mode of another size is the way out, not the rule. Edges between bright and dark become a little darker.
///
/// Threads  a context of its own is current that shares the picture's texture: it leaves other state behind.
/// Errors   the driver does not take the shaders.
/// Source   EXT_texture_sRGB_decode; IEC 61966-2-1 for the codes.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/display/letterbox.h"
#include "firmware_host/display/picture_framebuffer.h"
#include "firmware_host/gl/gl_handle.h"

namespace frustumscreen {

/// Which row of the target is the picture's top: the first in a buffer that is scanned out, the last in a
/// window.
enum class TopRow { First, Last };

class PictureCopy {
public:
    [[nodiscard]] static Result<PictureCopy> create();

    /// Into the framebuffer bound, whose colour is 8 bits a channel and holds codes as they are written.
    /// `part`: of the picture, what the framebuffer has not yet; all of it: what lies around it is blackened
    /// too. What was drawn into, row 0 at the top.
    PixelRectangle draw(const PictureFramebuffer& picture, PixelSize target, TopRow top,
                        const PixelRectangle& part) const;

private:
    struct Pass;
    void draw(const PictureFramebuffer& picture, const Pass& pass) const;
    PictureCopy(GlProgram program, GlSampler nearest, GlSampler interpolated);

    GlProgram program_;
    GlSampler nearest_;
    GlSampler interpolated_;
    GlVertexArray vertices_ = GlVertexArray::generate();
};

} // namespace frustumscreen
