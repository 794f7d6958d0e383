// A handle owns one OpenGL object, which is deleted with its last owner.
#include "firmware_host/display/surfaceless_display.h"
#include "firmware_host/gl/gl_handle.h"

#include <gtest/gtest.h>

#include <utility>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Gl) {
    // example
    const auto display = display::SurfacelessDisplay::create(64, 40).value(); // makes a context current
    gl::GlBuffer first = gl::GlBuffer::generate();
    const GLuint name = first.get();
    glBindBuffer(GL_ARRAY_BUFFER, name);
    {
        const gl::GlBuffer second = std::move(first);
        EXPECT_EQ(glIsBuffer(name), GL_TRUE);
    }
    EXPECT_EQ(glIsBuffer(name), GL_FALSE);
    // end
}

} // namespace
} // namespace frustumscreen::example
