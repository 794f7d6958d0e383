#include "app/bench/techniques/peers.h"
#include "firmware_host/gl/gl_program.h"

#include <glm/gtc/type_ptr.hpp>

namespace frustumscreen::bench {

namespace {

constexpr std::string_view mark_vertex = R"(
layout(location = 0) in vec3 position;
uniform mat4 clip_from_prop;
void main() { gl_Position = clip_from_prop * vec4(position, 1.0); })";
constexpr std::string_view mark_fragment = R"(
out vec4 result;
void main() { result = vec4(0.0); })";

class FullMesh final : public SampledPeer {
public:
    FullMesh(const Kiosk& kiosk, std::shared_ptr<const PeerMesh> mesh, const std::string& name,
             std::shared_ptr<const PeerSamples> samples, gl::GlProgram mark, OffscreenTarget points)
        : SampledPeer(kiosk, name, std::move(samples), std::move(points)), mesh_(std::move(mesh)),
          mark_(std::move(mark)) {}

private:
    Shown prepare(const BenchPose& pose, Output /*output*/) override {
        view_ = peer_view(kiosk_, pose);
        visible_.find(mesh_->triangles(), mesh_->box(), view_);
        return {visible_.lit(), pixel_density(visible_.faces(), mesh_->box(), view_)};
    }

    void paint(const render::Raster& raster, Output output) override {
        const glm::ivec2 picture(kiosk_.width(), kiosk_.height());
        render::set_viewport(picture, raster);
        glEnable(GL_STENCIL_TEST);
        glEnable(GL_SCISSOR_TEST);
        mark_faces(raster);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        for (std::size_t k = 0; k < visible_.faces().size(); ++k) {
            const PeerFace& face = visible_.faces()[k];
            glStencilFunc(GL_EQUAL, static_cast<GLint>(k + 1), 0xFF);
            render::set_scissor(face.bounds, raster);
            mesh_->draw({.clip_from_prop = face.clip_from_prop,
                         .size = picture * raster.fragments,
                         .output = output,
                         .front = GL_CW},
                        visible_, k);
        }
        glDisable(GL_SCISSOR_TEST);
        glDisable(GL_STENCIL_TEST);
        glDisable(GL_DEPTH_TEST);
    }

    void mark_faces(const render::Raster& raster) {
        fans_.set(visible_.faces());
        glDisable(GL_DEPTH_TEST);
        glDepthMask(GL_FALSE);
        glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        glStencilOp(GL_REPLACE, GL_REPLACE, GL_REPLACE);
        glUseProgram(mark_.get());
        const glm::mat4 clip(view_.clip_from_prop);
        glUniformMatrix4fv(clip_from_prop_, 1, GL_FALSE, glm::value_ptr(clip));
        for (std::size_t k = 0; k < visible_.faces().size(); ++k) {
            glStencilFunc(GL_ALWAYS, static_cast<GLint>(k + 1), 0xFF);
            render::set_scissor(visible_.faces()[k].bounds, raster);
            fans_.draw(k);
        }
        glDepthMask(GL_TRUE);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    }

    std::shared_ptr<const PeerMesh> mesh_;
    gl::GlProgram mark_;
    GLint clip_from_prop_ = glGetUniformLocation(mark_.get(), "clip_from_prop");
    FaceFans fans_;
    PeerView view_;
    VisibleParts visible_;
};

} // namespace

Result<std::unique_ptr<Technique>> make_full_mesh(const Kiosk& kiosk, std::shared_ptr<const PeerMesh> mesh,
                                                  std::shared_ptr<const PeerSamples> samples,
                                                  const std::string& name) {
    TRY(gl::GlProgram mark, gl::make_program("", mark_vertex, mark_fragment));
    TRY(OffscreenTarget points, make_target(kiosk.width(), kiosk.height(), GL_RGBA32F));
    return std::make_unique<FullMesh>(kiosk, std::move(mesh), name, std::move(samples), std::move(mark),
                                      std::move(points));
}

} // namespace frustumscreen::bench
