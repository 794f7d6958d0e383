#include "app/bench/techniques/peers.h"
#include "firmware_host/gl/gl_program.h"

#include <glm/gtc/type_ptr.hpp>

namespace frustumscreen {

namespace {

constexpr std::string_view mark_vertex = R"(
layout(location = 0) in vec3 position;
uniform mat4 clip_from_prop;
void main() { gl_Position = clip_from_prop * vec4(position, 1.0); })";
constexpr std::string_view mark_fragment = R"(
out vec4 result;
void main() { result = vec4(0.0); })";

class FullMesh final : public PeerTechnique {
public:
    FullMesh(const Stage& stage, std::shared_ptr<const PeerMesh> mesh, std::string name, GlProgram mark,
             OffscreenTarget points)
        : PeerTechnique(stage, std::move(name), std::move(points)), mesh_(std::move(mesh)),
          mark_(std::move(mark)) {}

private:
    void draw_into(GLuint framebuffer, const BenchPose& pose, Output output) override {
        const PeerView view = peer_view(stage_, pose);
        begin_picture(framebuffer, stage_.width(), stage_.height(), PictureOf::Codes);
        mark_faces(view);
        visible_.find(mesh_->triangles(), view);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
        for (std::size_t k = 0; k < view.faces.size(); ++k) {
            const std::optional<glm::dmat4> clip =
                collineation(view.faces[k]->plane, view.eye_m, view.clip_from_prop, mesh_->box());
            if (clip) {
                glStencilFunc(GL_EQUAL, static_cast<GLint>(k + 1), 0xFF);
                mesh_->draw({*clip, {stage_.width(), stage_.height()}, output, GL_CW}, visible_, k);
            }
        }
        glDisable(GL_STENCIL_TEST);
        glDisable(GL_DEPTH_TEST);
        end_codes();
    }

    void mark_faces(const PeerView& view) {
        quads_.set(view.faces);
        glEnable(GL_STENCIL_TEST);
        glDisable(GL_DEPTH_TEST);
        glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        glStencilOp(GL_REPLACE, GL_REPLACE, GL_REPLACE);
        glUseProgram(mark_.get());
        const glm::mat4 clip(view.clip_from_prop);
        glUniformMatrix4fv(glGetUniformLocation(mark_.get(), "clip_from_prop"), 1, GL_FALSE,
                           glm::value_ptr(clip));
        for (std::size_t k = 0; k < view.faces.size(); ++k) {
            glStencilFunc(GL_ALWAYS, static_cast<GLint>(k + 1), 0xFF);
            quads_.draw(k);
        }
    }

    std::shared_ptr<const PeerMesh> mesh_;
    GlProgram mark_;
    FaceQuads quads_;
    VisibleParts visible_;
};

} // namespace

Result<std::unique_ptr<Technique>> make_full_mesh(const Stage& stage, std::shared_ptr<const PeerMesh> mesh,
                                                  std::string name) {
    Result<GlProgram> mark = make_program("", mark_vertex, mark_fragment);
    if (!mark) {
        return tl::unexpected<Error>(mark.error());
    }
    Result<OffscreenTarget> points = make_target(stage.width(), stage.height(), GL_RGBA32F);
    if (!points) {
        return tl::unexpected<Error>(points.error());
    }
    return std::make_unique<FullMesh>(stage, std::move(mesh), std::move(name), std::move(*mark),
                                      std::move(*points));
}

} // namespace frustumscreen
