/// Copies the picture into memory that the drawing GPU cannot reach: draws it into a renderbuffer of the
/// screen's size and reads that back.
///
/// Shape    memory as KMS expects it: rows from the top, `stride` bytes each; pixels of four bytes: blue,
///          green, red, unused.
/// Threads  the copy's context is current in every call and at destruction.
/// Errors   the driver cannot read back in this order, or lacks memory.
/// Source   EXT_read_format_bgra.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/display/picture_copy.h"
#include "firmware_host/gl/gl_handle.h"

#include <cstddef>
#include <span>

namespace frustumscreen::display {

class ReadBack {
public:
    [[nodiscard]] static Result<ReadBack> create(PixelSize screen);

    /// Writes `part` of the picture, which `memory` lacks.
    void fill(const PictureCopy& copy, const PictureFramebuffer& picture, const PixelRectangle& part,
              std::span<std::byte> memory, std::size_t stride) const;

private:
    explicit ReadBack(PixelSize screen);

    PixelSize screen_;
    gl::GlFramebuffer framebuffer_ = gl::GlFramebuffer::generate();
    gl::GlRenderbuffer colour_ = gl::GlRenderbuffer::generate();
};

} // namespace frustumscreen::display
