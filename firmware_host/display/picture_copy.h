/// Copies the exhibit's picture into what a screen shows.
///
/// On a screen of the picture's size every sRGB code arrives unchanged. On another the picture is scaled as
/// large as it fits, with black around it, and the first `probe_pixels` of its top row are written unchanged
/// into the screen's top left corner.
///
/// Scaling interpolates codes and not light, as a card's own scaler does: where the processor draws, this
/// takes half to a third of the time (800 x 600: 7 against 14 ms; on an emulated processor: 0.4 against 1.7
/// s), and a mode of another size is the exception. Edges between bright and dark become a little darker.
///
/// Threads  a separate context is current that shares the picture's texture; its GL state is left changed.
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

    /// Draws into the bound framebuffer, whose colour has 8 bits a channel and holds codes as they are
    /// written. `part` of the picture is what the framebuffer lacks; if it is the whole picture, what lies
    /// around it is blackened too. Returns what was drawn into, row 0 at the top.
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
