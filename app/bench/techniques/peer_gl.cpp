#include "app/bench/techniques/peer_gl.h"

#include "app/scene/face_view.h"
#include "app/scene/pixel_density.h"
#include "firmware_host/gl/gl_program.h"

#include <GLES2/gl2ext.h>
#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>

namespace frustumscreen::bench {

Result<OffscreenTarget> make_target(int width, int height, GLenum colour_format) {
    OffscreenTarget target{.colour = gl::GlTexture::generate(),
                           .depth_stencil = gl::GlRenderbuffer::generate(),
                           .framebuffer = gl::GlFramebuffer::generate(),
                           .width = width,
                           .height = height};
    glBindTexture(GL_TEXTURE_2D, target.colour.get());
    glTexStorage2D(GL_TEXTURE_2D, 1, colour_format, width, height);
    for (const GLenum filter : {GLenum{GL_TEXTURE_MIN_FILTER}, GLenum{GL_TEXTURE_MAG_FILTER}}) {
        glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
    }
    for (const GLenum wrap : {GLenum{GL_TEXTURE_WRAP_S}, GLenum{GL_TEXTURE_WRAP_T}}) {
        glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
    }
    glBindRenderbuffer(GL_RENDERBUFFER, target.depth_stencil.get());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer.get());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.colour.get(), 0);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                              target.depth_stencil.get());
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        return fail(ErrorKind::Internal, "bench.no_picture_format",
                    "the driver cannot draw into a {} x {} picture of format {:#x}", width, height,
                    colour_format);
    }
    return target;
}

namespace {

void begin(GLuint framebuffer, int width, int height) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, width, height);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    for (const GLenum off : std::initializer_list<GLenum>{GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_DEPTH_TEST,
                                                          GL_CULL_FACE, GL_BLEND}) {
        glDisable(off);
    }
}

} // namespace

void begin_picture(GLuint framebuffer, int width, int height, PictureOf what) {
    begin(framebuffer, width, height);
    if (what == PictureOf::Codes) {
        glDisable(GL_FRAMEBUFFER_SRGB_EXT);
    }
    glDepthMask(GL_TRUE);
    glStencilMask(0xFF);
    glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

void begin_codes(GLuint framebuffer, int width, int height, float alpha) {
    begin(framebuffer, width, height);
    glDisable(GL_FRAMEBUFFER_SRGB_EXT);
    glClearColor(0.0F, 0.0F, 0.0F, alpha);
    glClear(GL_COLOR_BUFFER_BIT);
}

void end_codes() {
    glEnable(GL_FRAMEBUFFER_SRGB_EXT);
}

void clear_depth_stencil(const PixelRectangle& part) {
    glDepthMask(GL_TRUE);
    glStencilMask(0xFF);
    glEnable(GL_SCISSOR_TEST);
    glScissor(part.x, part.y, std::max(part.width, 0), std::max(part.height, 0));
    glClear(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST);
}

Result<OutputPrograms> make_programs(const std::string& defines, std::string_view vertex,
                                     std::string_view fragment) {
    OutputPrograms programs;
    for (const Output output : {Output::Colour, Output::Point}) {
        TRY(gl::GlProgram program,
            gl::make_program(defines + (output == Output::Point ? "#define POINT\n" : ""), vertex, fragment));
        programs[static_cast<std::size_t>(output)] = std::move(program);
    }
    return programs;
}

Result<image::ImageFloat> PeerTechnique::hit_points(const BenchPose& pose) {
    draw_into(points_.framebuffer.get(), pose, Output::Point);
    return read_points(points_);
}

image::ImageFloat read_points(const OffscreenTarget& target) {
    image::Image<glm::vec4> raw(target.width, target.height);
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer.get());
    glReadPixels(0, 0, raw.width, raw.height, GL_RGBA, GL_FLOAT, raw.texels.data());
    image::ImageFloat points(raw.width, raw.height, glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    for (std::size_t k = 0; k < raw.texels.size(); ++k) {
        if (raw.texels[k].a != 0.0F) {
            points.texels[k] = glm::vec3(raw.texels[k]);
        }
    }
    return points;
}

PeerView peer_view(const Kiosk& kiosk, const BenchPose& pose) {
    const TruthView view = view_of(kiosk.settings, pose);
    PeerView result{.projector = view.projector,
                    .clip_from_prop =
                        view.projector.clip_from_point() * view.prop_from_projector.inverse().matrix(),
                    .eye_m = view.eye_m,
                    .projector_m = view.prop_from_projector.translation,
                    .faces = {}};
    for (const geometry::PropFace& face : kiosk.prop.faces) {
        if (face.plane.distance(view.eye_m) > 0.0 &&
            face.plane.distance(view.prop_from_projector.translation) > 0.0) {
            result.faces.push_back(&face);
        }
    }
    return result;
}

std::vector<PeerFace> faces_before(const geometry::Box& box, const PeerView& view) {
    std::vector<PeerFace> faces;
    for (const geometry::PropFace* face : view.faces) {
        const std::optional<glm::dmat4> clip =
            geometry::collineation(face->plane, view.eye_m, view.clip_from_prop, box);
        if (!clip) {
            continue;
        }
        const PixelRectangle bounds =
            scene::face_bounds(*face, box, view.clip_from_prop, *clip, view.projector);
        if (!bounds.empty()) {
            faces.push_back({face, *clip, bounds});
        }
    }
    return faces;
}

double pixel_density(std::span<const PeerFace> faces, const geometry::Box& box, const PeerView& view) {
    const glm::dvec3 middle = 0.5 * (box.low + box.high);
    scene::PixelDensity density;
    for (const PeerFace& face : faces) {
        density.add(face.bounds, scene::pixels_per_unit(face.clip_from_prop, middle, view.projector));
    }
    return density.share(glm::distance(middle, view.projector_m), view.projector);
}

FaceFans::FaceFans() : array_(gl::GlVertexArray::generate()), buffer_(gl::GlBuffer::generate()) {
    glBindVertexArray(array_.get());
    glBindBuffer(GL_ARRAY_BUFFER, buffer_.get());
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(glm::vec3), nullptr);
    glBindVertexArray(0);
}

void FaceFans::set(const std::vector<PeerFace>& faces) {
    std::vector<glm::vec3> corners;
    first_ = {0};
    for (const PeerFace& each : faces) {
        corners.insert(corners.end(), each.face->corners.begin(), each.face->corners.end());
        first_.push_back(static_cast<GLint>(corners.size()));
    }
    glBindBuffer(GL_ARRAY_BUFFER, buffer_.get());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size() * sizeof(glm::vec3)), corners.data(),
                 GL_STREAM_DRAW);
}

void FaceFans::draw(std::size_t face) const {
    glBindVertexArray(array_.get());
    glDrawArrays(GL_TRIANGLE_FAN, first_[face], first_[face + 1] - first_[face]);
}

} // namespace frustumscreen::bench
