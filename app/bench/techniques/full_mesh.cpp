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

class FullMesh final : public Technique {
public:
    FullMesh(const Stage& stage, const PeerMesh& mesh, std::string name, GlProgram mark,
             OffscreenTarget points)
        : stage_(stage), mesh_(mesh), name_(std::move(name)), mark_(std::move(mark)),
          points_(std::move(points)) {}

    [[nodiscard]] std::string name() const override { return name_; }
    void draw(const BenchPose& pose) override {
        draw_into(stage_.framebuffer, pose, PeerMesh::Output::Colour);
    }
    [[nodiscard]] Result<ImageFloat> hit_points(const BenchPose& pose) override {
        draw_into(points_.framebuffer.get(), pose, PeerMesh::Output::Point);
        return read_points(points_);
    }

private:
    void draw_into(GLuint framebuffer, const BenchPose& pose, PeerMesh::Output output) {
        const PeerView view = peer_view(stage_, pose);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glViewport(0, 0, stage_.width(), stage_.height());
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        glDepthMask(GL_TRUE);
        glStencilMask(0xFF);
        glDisable(GL_SCISSOR_TEST);
        glDisable(GL_CULL_FACE);
        glDisable(GL_BLEND);
        glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
        mark_faces(view);
        visible_.find(mesh_.triangles(), view);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
        for (std::size_t k = 0; k < view.faces.size(); ++k) {
            const std::optional<glm::dmat4> clip =
                collineation(view.faces[k]->plane, view.eye_m, view.clip_from_prop, mesh_.box());
            if (clip) {
                glStencilFunc(GL_EQUAL, static_cast<GLint>(k + 1), 0xFF);
                mesh_.draw(*clip, output, GL_CW, visible_, k);
            }
        }
        glDisable(GL_STENCIL_TEST);
        glDisable(GL_DEPTH_TEST);
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

    const Stage& stage_;
    const PeerMesh& mesh_;
    std::string name_;
    GlProgram mark_;
    OffscreenTarget points_;
    FaceQuads quads_;
    VisibleParts visible_;
};

} // namespace

Result<std::unique_ptr<Technique>> make_full_mesh(const Stage& stage, const PeerMesh& mesh,
                                                  std::string name) {
    Result<GlProgram> mark = make_program("", mark_vertex, mark_fragment);
    if (!mark) {
        return tl::unexpected<Error>(mark.error());
    }
    Result<OffscreenTarget> points = make_target(stage.width(), stage.height(), GL_RGBA32F);
    if (!points) {
        return tl::unexpected<Error>(points.error());
    }
    return std::make_unique<FullMesh>(stage, mesh, std::move(name), std::move(*mark), std::move(*points));
}

} // namespace frustumscreen
