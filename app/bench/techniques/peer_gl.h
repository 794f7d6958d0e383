/// The parts of OpenGL ES that the bench's peers need: offscreen pictures and the prop's faces.
///
/// Threads  the one whose context is current, which must outlive every object here.
/// Errors   a target that the driver cannot hold is an Internal error.
#pragma once

#include "app/bench/techniques/technique.h"
#include "app/geometry/collineation.h"
#include "firmware_host/base/pixel_rectangle.h"
#include "firmware_host/gl/gl_handle.h"

#include <glm/glm.hpp>

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::bench {

/// An offscreen picture with depth and stencil; the colour is a texture (nearest filter unless changed).
struct OffscreenTarget {
    gl::GlTexture colour;
    gl::GlRenderbuffer depth_stencil;
    gl::GlFramebuffer framebuffer;
    int width = 0;
    int height = 0;
};
[[nodiscard]] Result<OffscreenTarget> make_target(int width, int height, GLenum colour_format);
/// From a float target: NaN where alpha is 0.
[[nodiscard]] image::ImageFloat read_points(const OffscreenTarget& target);

enum class PictureOf { Light, Codes }; ///< output of the shader; end_codes must follow Codes
/// Binds and clears a picture, with every test and mask in its initial state.
void begin_picture(GLuint framebuffer, int width, int height, PictureOf what = PictureOf::Light);
/// Begins like the exhibit's picture, for shaders that write codes directly: only colour is cleared.
void begin_codes(GLuint framebuffer, int width, int height, float alpha = 1.0F);
void end_codes();
/// Clears depth to far and stencil to 0, in a part of the bound framebuffer.
void clear_depth_stencil(const PixelRectangle& part);

enum class Output { Colour, Point }; ///< Point: the hit's position in the prop frame, alpha 1
/// One program per output; POINT is defined for Output::Point.
using OutputPrograms = std::array<gl::GlProgram, 2>;
[[nodiscard]] Result<OutputPrograms> make_programs(const std::string& defines, std::string_view vertex,
                                                   std::string_view fragment);

/// A technique that draws points the way it draws colours, into a separate picture.
class PeerTechnique : public Technique {
public:
    [[nodiscard]] std::string name() const override { return name_; }
    void draw(const BenchPose& pose) override { draw_into(kiosk_.framebuffer, pose, Output::Colour); }
    [[nodiscard]] Result<image::ImageFloat> hit_points(const BenchPose& pose) override;

protected:
    /// `points`: a float target of the kiosk's size.
    PeerTechnique(const Kiosk& kiosk, std::string name, OffscreenTarget points)
        : kiosk_(kiosk), name_(std::move(name)), points_(std::move(points)) {}
    virtual void draw_into(GLuint framebuffer, const BenchPose& pose, Output output) = 0;

    const Kiosk& kiosk_;

private:
    std::string name_;
    OffscreenTarget points_;
};

/// A pose in the form needed by the peers' passes.
struct PeerView {
    geometry::Pinhole projector;
    glm::dmat4 clip_from_prop{1.0};               ///< the projector's; depth row zero
    glm::dvec3 eye_m{0.0};                        ///< prop frame
    glm::dvec3 projector_m{0.0};                  ///< prop frame
    std::vector<const geometry::PropFace*> faces; ///< turned to the eye and lit
};
[[nodiscard]] PeerView peer_view(const Kiosk& kiosk, const BenchPose& pose);

/// A face through which the eye sees part of a mesh.
struct PeerFace {
    const geometry::PropFace* face = nullptr;
    glm::dmat4 clip_from_prop{1.0}; ///< the face's collineation
    PixelRectangle bounds;
};
/// The view's faces through which the eye sees part of the box.
[[nodiscard]] std::vector<PeerFace> faces_before(const geometry::Box& box, const PeerView& view);
/// As in the exhibit's plan, at the middle of the box (PixelDensity::share).
[[nodiscard]] double pixel_density(std::span<const PeerFace> faces, const geometry::Box& box,
                                   const PeerView& view);

/// The corners of each face in one buffer, drawn as fans.
class FaceFans {
public:
    FaceFans();
    /// Positions are attribute 0, prop frame.
    void set(const std::vector<PeerFace>& faces);
    void draw(std::size_t face) const;

private:
    gl::GlVertexArray array_;
    gl::GlBuffer buffer_;
    std::vector<GLint> first_; ///< corner of each face, and the end
};

} // namespace frustumscreen::bench
