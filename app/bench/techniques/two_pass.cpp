#include "app/bench/techniques/peers.h"

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include <cmath>
#include <limits>

namespace frustumscreen::bench {

namespace {

constexpr std::string_view project_vertex = R"(
layout(location = 0) in vec3 position;
uniform mat4 clip_from_prop;
uniform mat4 eye_clip_from_prop;
out vec4 at_eye;
void main() {
    at_eye = eye_clip_from_prop * vec4(position, 1.0);
    gl_Position = clip_from_prop * vec4(position, 1.0);
})";

/// Colours are bilinear between codes; coverage (alpha) decides the silhouette, which keeps it sharp. Points
/// are blended over those of the four neighbours that lie on the nearest one's surface.
constexpr std::string_view project_fragment = R"(
in vec4 at_eye;
uniform sampler2D eye_picture;
#ifdef POINT
uniform sampler2D eye_points;
uniform float same_surface;
#endif
out vec4 result;
void main() {
    vec2 uv = 0.5 * at_eye.xy / at_eye.w + 0.5;
    vec4 seen = texture(eye_picture, uv);
    if (seen.a < 0.5) {
        result = vec4(0.0);
        return;
    }
#ifdef POINT
    vec2 size = vec2(textureSize(eye_points, 0));
    vec2 at = uv * size - 0.5;
    vec2 part = fract(at);
    ivec2 base = ivec2(floor(at));
    ivec2 last = ivec2(size) - 1;
    float best = -1.0;
    vec3 nearest = vec3(0.0);
    for (int k = 0; k < 4; ++k) {
        ivec2 step = ivec2(k & 1, k >> 1);
        vec2 w = mix(1.0 - part, part, vec2(step));
        vec4 point = texelFetch(eye_points, clamp(base + step, ivec2(0), last), 0);
        if (point.a > 0.0 && w.x * w.y > best) {
            best = w.x * w.y;
            nearest = point.xyz;
        }
    }
    vec4 sum = vec4(0.0);
    for (int k = 0; k < 4; ++k) {
        ivec2 step = ivec2(k & 1, k >> 1);
        vec2 w = mix(1.0 - part, part, vec2(step));
        vec4 point = texelFetch(eye_points, clamp(base + step, ivec2(0), last), 0);
        if (point.a > 0.0 && distance(point.xyz, nearest) < same_surface) {
            sum += w.x * w.y * vec4(point.xyz, 1.0);
        }
    }
    result = vec4(sum.xyz / sum.w, 1.0);
#else
    result = vec4(seen.rgb / seen.a, 1.0);
#endif
})";

/// Clip matrix of the eye's picture: a perspective from the eye, cropped to the part of the artifact's box
/// that the visible faces show; w = distance along the axis. Outside it everything is black, like the
/// picture's edge.
glm::dmat4 eye_clip(const PeerView& view, const geometry::Box& box) {
    glm::dvec3 middle(0.0);
    for (const geometry::PropFace* face : view.faces) {
        for (const glm::dvec3& corner : face->corners) {
            middle += corner / static_cast<double>(face->corners.size() * view.faces.size());
        }
    }
    const glm::dvec3 forward = glm::normalize(middle - view.eye_m);
    const glm::dvec3 helper = std::abs(forward.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, helper));
    const glm::dvec3 up = glm::cross(right, forward);
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high(-std::numeric_limits<double>::infinity());
    for (const geometry::PropFace* face : view.faces) {
        for (const glm::dvec3& corner : face->corners) {
            const glm::dvec3 to = corner - view.eye_m;
            const glm::dvec2 slope =
                glm::dvec2(glm::dot(to, right), glm::dot(to, up)) / glm::dot(to, forward);
            low = glm::min(low, slope);
            high = glm::max(high, slope);
        }
    }
    glm::dvec2 box_low(std::numeric_limits<double>::infinity());
    glm::dvec2 box_high(-std::numeric_limits<double>::infinity());
    double near = std::numeric_limits<double>::infinity();
    double far = 0.0;
    for (unsigned k = 0; k < 8; ++k) {
        const glm::dvec3 corner((k & 1U) != 0 ? box.high.x : box.low.x,
                                (k & 2U) != 0 ? box.high.y : box.low.y,
                                (k & 4U) != 0 ? box.high.z : box.low.z);
        const double depth = glm::dot(corner - view.eye_m, forward);
        near = std::fmin(near, depth);
        far = std::fmax(far, depth);
        const glm::dvec3 to = corner - view.eye_m;
        const glm::dvec2 slope = glm::dvec2(glm::dot(to, right), glm::dot(to, up)) / std::fmax(depth, 1e-9);
        box_low = glm::min(box_low, slope);
        box_high = glm::max(box_high, slope);
    }
    if (near > 0.0) {
        const glm::dvec2 margin = 0.01 * (box_high - box_low); // keeps a few black pixels around it
        low = glm::max(low, box_low - margin);
        high = glm::max(glm::min(high, box_high + margin), low + 1e-9);
    }
    far *= 1.01;
    near = std::fmax(0.99 * near, 1e-3 * far);
    const glm::dvec2 scale = 2.0 / (high - low);
    const glm::dvec2 shift = -(high + low) / (high - low);
    const auto row = [&view](const glm::dvec3& axis) {
        return glm::dvec4(axis, -glm::dot(axis, view.eye_m));
    };
    const glm::dvec4 depth = row(forward);
    const double a = (far + near) / (far - near);
    const double b = -2.0 * far * near / (far - near);
    return glm::transpose(glm::dmat4(scale.x * row(right) + shift.x * depth,
                                     scale.y * row(up) + shift.y * depth, a * depth + glm::dvec4(0, 0, 0, b),
                                     depth));
}

class TwoPass final : public SampledPeer {
public:
    TwoPass(const Kiosk& kiosk, std::shared_ptr<const PeerMesh> mesh, const std::string& name,
            std::shared_ptr<const PeerSamples> samples, OutputPrograms project,
            std::array<OffscreenTarget, 2> eye, OffscreenTarget points)
        : SampledPeer(kiosk, name, std::move(samples), std::move(points)), mesh_(std::move(mesh)),
          project_(std::move(project)), eye_(std::move(eye)) {
        for (std::size_t k = 0; k < places_.size(); ++k) {
            const GLuint program = project_[k].get();
            places_[k] = {glGetUniformLocation(program, "clip_from_prop"),
                          glGetUniformLocation(program, "eye_clip_from_prop")};
        }
        const GLuint points_program = project_[static_cast<std::size_t>(Output::Point)].get();
        const double texel_m = glm::distance(mesh_->box().low, mesh_->box().high) / eye_[1].width;
        glUseProgram(points_program);
        glUniform1i(glGetUniformLocation(points_program, "eye_points"), 1);
        glUniform1f(glGetUniformLocation(points_program, "same_surface"), static_cast<float>(4.0 * texel_m));
    }

private:
    Shown prepare(const BenchPose& pose, Output output) override {
        view_ = peer_view(kiosk_, pose);
        eye_clip_ = eye_clip(view_, mesh_->box());
        from_eye(eye_[0], Output::Colour);
        if (output == Output::Point) {
            from_eye(eye_[1], Output::Point);
        }
        faces_ = faces_before(mesh_->box(), view_);
        lit_.begin(kiosk_.width(), kiosk_.height());
        for (const PeerFace& face : faces_) {
            lit_.light(face.bounds);
        }
        lit_.finish();
        return {lit_, pixel_density(faces_, mesh_->box(), view_)};
    }

    void from_eye(const OffscreenTarget& target, Output output) {
        begin_picture(target.framebuffer.get(), target.width, target.height, PictureOf::Codes);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        mesh_->draw({.clip_from_prop = eye_clip_,
                     .size = {target.width, target.height},
                     .output = output,
                     .front = GL_CCW});
        glDisable(GL_DEPTH_TEST);
        end_codes();
    }

    void paint(const render::Raster& raster, Output output) override {
        const auto k = static_cast<std::size_t>(output);
        const glm::mat4 clip(view_.clip_from_prop);
        const glm::mat4 eye_clip_from_prop(eye_clip_);
        glUseProgram(project_[k].get());
        glUniformMatrix4fv(places_[k].clip_from_prop, 1, GL_FALSE, glm::value_ptr(clip));
        glUniformMatrix4fv(places_[k].eye_clip_from_prop, 1, GL_FALSE, glm::value_ptr(eye_clip_from_prop));
        if (output == Output::Point) {
            glActiveTexture(GL_TEXTURE1);
            glBindTexture(GL_TEXTURE_2D, eye_[1].colour.get());
        }
        glActiveTexture(GL_TEXTURE0);
        glBindTexture(GL_TEXTURE_2D, eye_[0].colour.get());
        render::set_viewport({kiosk_.width(), kiosk_.height()}, raster);
        glEnable(GL_SCISSOR_TEST);
        fans_.set(faces_);
        for (std::size_t face = 0; face < faces_.size(); ++face) {
            render::set_scissor(faces_[face].bounds, raster);
            fans_.draw(face);
        }
        glDisable(GL_SCISSOR_TEST);
    }

    struct Places {
        GLint clip_from_prop = -1;
        GLint eye_clip_from_prop = -1;
    };

    std::shared_ptr<const PeerMesh> mesh_;
    OutputPrograms project_;
    std::array<Places, 2> places_;       ///< by output
    std::array<OffscreenTarget, 2> eye_; ///< by output
    PeerView view_;
    glm::dmat4 eye_clip_{1.0};
    std::vector<PeerFace> faces_;
    scene::LitTiles lit_;
    FaceFans fans_;
};

} // namespace

Result<std::unique_ptr<Technique>> make_two_pass(const Kiosk& kiosk, std::shared_ptr<const PeerMesh> mesh,
                                                 int eye_pixels, std::shared_ptr<const PeerSamples> samples,
                                                 const std::string& of_mesh) {
    TRY(OutputPrograms project, make_programs("", project_vertex, project_fragment));
    Result<OffscreenTarget> colours = make_target(eye_pixels, eye_pixels, GL_RGBA8);
    Result<OffscreenTarget> eye_points = make_target(eye_pixels, eye_pixels, GL_RGBA32F);
    Result<OffscreenTarget> points = make_target(kiosk.width(), kiosk.height(), GL_RGBA32F);
    for (const Result<OffscreenTarget>* target : {&colours, &eye_points, &points}) {
        if (!*target) {
            return tl::unexpected<Error>(target->error());
        }
    }
    glBindTexture(GL_TEXTURE_2D, colours->colour.get());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return std::make_unique<TwoPass>(
        kiosk, std::move(mesh),
        fmt::format("two-pass {}{}{}", eye_pixels, of_mesh.empty() ? "" : " ", of_mesh), std::move(samples),
        std::move(project), std::array{std::move(*colours), std::move(*eye_points)}, std::move(*points));
}

} // namespace frustumscreen::bench
