/// The floor: what the plainest picture on the prop costs, the unit of every frame time. A picture that
/// leaves most of a face dark may cost less.
///
/// The same prop and pixels as the exhibit's picture, each face that it would light one 1024 x 1024 trilinear
/// texture of its own colour format; the same clear, always a full redraw; the caller calls glFinish.
///
/// Threads  the one whose context is current, which must outlive it.
/// Errors   at creation only: the driver refuses a shader or has no memory.
#pragma once

#include "app/scene/frame_plan.h"
#include "firmware_host/base/result.h"
#include "firmware_host/gl/gl_handle.h"

namespace frustumscreen {

class Floor {
public:
    [[nodiscard]] static Result<Floor> create();
    /// Number of faces drawn: those turned to the first eye and lit.
    int draw(const PropShape& prop, const PlanView& view, unsigned framebuffer) const;

private:
    Floor() = default;

    GlProgram program_;
    GLint corners_ = -1;
    GlTexture texture_;
    GlVertexArray no_attributes_;
};

} // namespace frustumscreen
