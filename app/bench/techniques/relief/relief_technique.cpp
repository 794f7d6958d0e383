#include "app/bench/techniques/relief/relief_technique.h"

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include <array>
#include <utility>

namespace frustumscreen::bench {

namespace {

constexpr std::string_view vertex_source = R"(
layout(location = 0) in vec3 position;
uniform mat4 clip_from_prop;
uniform vec3 eye;
uniform vec3 box_size;
out vec3 ray;
void main() {
    ray = (position - eye) / box_size;
    gl_Position = clip_from_prop * vec4(position, 1.0);
})";

constexpr std::string_view common_source = R"(
precision highp usampler2DArray;
precision highp sampler2DArray;
in vec3 ray;
uniform vec3 eye;
uniform vec3 eye_in_box;
uniform vec3 box_size;
uniform usampler2DArray relief;
uniform sampler2DArray colours;
out vec4 result;
const float box_codes = 65535.0;

vec2 material(vec2 at, int axis) {
    return vec2(texelFetch(relief, ivec3(ivec2(at * float(texels)), axis), 0).xy);
}
bool inside(vec3 p) {
    vec3 q = p * box_codes;
    vec2 x = material(p.yz, 0);
    vec2 y = material(p.xz, 1);
    vec2 z = material(p.xy, 2);
    vec3 low = vec3(x.x, y.x, z.x);
    vec3 high = vec3(x.y, y.y, z.y);
    vec3 out_of = max(low - q, q - high);
    return max(max(out_of.x, out_of.y), out_of.z) <= 0.0;
}
)";

/// A hit lies on the surface of some images: the one that sees it most nearly along its normal shows it. If
/// it lies on none, the nearest image shows it. Layers of `colours`: 2 axis + (1 if high).
constexpr std::string_view main_source = R"(
vec3 colour_at(vec3 p) {
    vec2 x = material(p.yz, 0);
    vec2 y = material(p.xz, 1);
    vec2 z = material(p.xy, 2);
    vec3 q = p * box_codes;
    vec3 off_low = abs(q - vec3(x.x, y.x, z.x)) * box_size + no_image_low;
    vec3 off_high = abs(q - vec3(x.y, y.y, z.y)) * box_size + no_image_high;
    vec3 off = min(off_low, off_high);
    vec3 layer = vec3(0.0, 2.0, 4.0) + vec3(lessThan(off_high, off_low));
    ivec3 texel = ivec3(p * float(texels));
    ivec3 whole = ivec3(layer);
    vec3 square = vec3(texelFetch(colours, ivec3(texel.yz, whole.x), 0).a,
                       texelFetch(colours, ivec3(texel.xz, whole.y), 0).a,
                       texelFetch(colours, ivec3(texel.xy, whole.z), 0).a);
    float two_texels = 2.0 * max(max(box_size.x, box_size.y), box_size.z) * box_codes / float(texels);
    vec3 score = mix(-off, square, vec3(lessThan(off * square, vec3(two_texels))));
    vec3 best = vec3(p.yz, layer.x);
    float most = score.x;
    if (score.y > most) {
        most = score.y;
        best = vec3(p.xz, layer.y);
    }
    if (score.z > most) {
        best = vec3(p.xy, layer.z);
    }
    return textureLod(colours, best, 0.0).rgb;
}
void main() {
    vec3 along = ray + vec3(equal(ray, vec3(0.0))) * 1e-12;
    vec3 to_low = -eye_in_box / along;
    vec3 to_high = (1.0 - eye_in_box) / along;
    vec3 near = min(to_low, to_high);
    vec3 far = max(to_low, to_high);
    float enter = max(max(near.x, near.y), near.z);
    float leave = min(min(far.x, far.y), far.z);
    float at = 0.0;
    vec3 start = eye_in_box + enter * along;
    if (enter < leave && search(start, along, leave - enter, at)) {
#ifdef POINT
        result = vec4(eye + (enter + at) * ray * box_size, 1.0);
#else
        result = vec4(colour_at(clamp(start + at * along, 0.0, 0.999999)), 1.0);
#endif
    } else {
        result = vec4(0.0);
    }
})";

gl::GlTexture upload_colours(const ReliefImages& images) {
    gl::GlTexture texture = gl::GlTexture::generate();
    glBindTexture(GL_TEXTURE_2D_ARRAY, texture.get());
    glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, GL_SRGB8_ALPHA8, images.texels, images.texels, 6);
    for (const ReliefImage& image : images.images) {
        glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 2 * image.axis + (image.high ? 1 : 0), images.texels,
                        images.texels, 1, GL_RGBA, GL_UNSIGNED_BYTE, image.colour.texels.data());
    }
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

/// Shader constants: the number of texels, and a large distance for the sides without an image.
std::string constants_of(const ReliefImages& images) {
    std::array<std::array<bool, 3>, 2> has{};
    for (const ReliefImage& image : images.images) {
        has[image.high ? 1 : 0][static_cast<std::size_t>(image.axis)] = true;
    }
    std::string text = fmt::format("const int texels = {};\n", images.texels);
    for (std::size_t side = 0; side < 2; ++side) {
        text += fmt::format("const vec3 no_image_{} = vec3({:.1f}, {:.1f}, {:.1f});\n",
                            side == 0 ? "low" : "high", has[side][0] ? 0.0 : 1e9, has[side][1] ? 0.0 : 1e9,
                            has[side][2] ? 0.0 : 1e9);
    }
    return text;
}

struct ReliefGl {
    OutputPrograms programs;
    gl::GlTexture relief;
    gl::GlTexture colours;
};

class ReliefTechnique final : public PeerTechnique {
public:
    ReliefTechnique(const Kiosk& kiosk, const geometry::Box& box, std::string name, ReliefGl gl,
                    OffscreenTarget points)
        : PeerTechnique(kiosk, std::move(name), std::move(points)), box_(box), gl_(std::move(gl)),
          array_(gl::GlVertexArray::generate()), corners_(gl::GlBuffer::generate()) {
        glBindVertexArray(array_.get());
        glBindBuffer(GL_ARRAY_BUFFER, corners_.get());
        glEnableVertexAttribArray(0);
        glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(glm::vec3), nullptr);
        glBindVertexArray(0);
    }

private:
    void draw_into(GLuint framebuffer, const BenchPose& pose, Output output) override {
        begin_picture(framebuffer, kiosk_.width(), kiosk_.height());
        const PeerView view = peer_view(kiosk_, pose);
        set_uniforms(gl_.programs[static_cast<std::size_t>(output)].get(), view);
        glActiveTexture(GL_TEXTURE1);
        glBindTexture(GL_TEXTURE_2D_ARRAY, gl_.colours.get());
        glActiveTexture(GL_TEXTURE0);
        glBindTexture(GL_TEXTURE_2D_ARRAY, gl_.relief.get());
        draw_shadows(view);
    }

    void set_uniforms(GLuint program, const PeerView& view) const {
        const glm::dvec3 size = box_.high - box_.low;
        const auto set = [program](const char* name, const glm::vec3& value) {
            glUniform3fv(glGetUniformLocation(program, name), 1, glm::value_ptr(value));
        };
        const glm::mat4 clip(view.clip_from_prop);
        glUseProgram(program);
        glUniformMatrix4fv(glGetUniformLocation(program, "clip_from_prop"), 1, GL_FALSE,
                           glm::value_ptr(clip));
        set("eye", glm::vec3(view.eye_m));
        set("eye_in_box", glm::vec3((view.eye_m - box_.low) / size));
        set("box_size", glm::vec3(size));
        glUniform1i(glGetUniformLocation(program, "relief"), 0);
        glUniform1i(glGetUniformLocation(program, "colours"), 1);
    }

    void draw_shadows(const PeerView& view) const {
        std::vector<glm::vec3> corners;
        std::vector<GLint> ends;
        for (const geometry::PropFace* face : view.faces) {
            for (const glm::dvec3& corner : shadow_on_face(*face, view.eye_m, box_)) {
                corners.emplace_back(corner);
            }
            ends.push_back(static_cast<GLint>(corners.size()));
        }
        glBindVertexArray(array_.get());
        glBindBuffer(GL_ARRAY_BUFFER, corners_.get());
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size() * sizeof(glm::vec3)),
                     corners.data(), GL_STREAM_DRAW);
        GLint begin = 0;
        for (const GLint end : ends) {
            glDrawArrays(GL_TRIANGLE_FAN, begin, end - begin);
            begin = end;
        }
        glBindVertexArray(0);
    }

    geometry::Box box_;
    ReliefGl gl_;
    gl::GlVertexArray array_;
    gl::GlBuffer corners_;
};

glm::dvec3 corner_of(const geometry::Box& box, unsigned k) {
    return {(k & 1U) != 0 ? box.high.x : box.low.x, (k & 2U) != 0 ? box.high.y : box.low.y,
            (k & 4U) != 0 ? box.high.z : box.low.z};
}

/// Clips the convex polygon by the plane through the eye, a and b; keeps the side of `kept`.
void cut(std::vector<glm::dvec3>& polygon, const glm::dvec3& eye, const glm::dvec3& a, const glm::dvec3& b,
         const glm::dvec3& kept) {
    glm::dvec3 normal = glm::cross(a - eye, b - eye);
    if (glm::dot(normal, kept - eye) < 0.0) {
        normal = -normal;
    }
    std::vector<glm::dvec3> result;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const glm::dvec3& from = polygon[k];
        const glm::dvec3& to = polygon[(k + 1) % polygon.size()];
        const double at_from = glm::dot(normal, from - eye);
        const double at_to = glm::dot(normal, to - eye);
        if (at_from >= 0.0) {
            result.push_back(from);
        }
        if ((at_from < 0.0) != (at_to < 0.0)) {
            result.push_back(from + (to - from) * (at_from / (at_from - at_to)));
        }
    }
    polygon = std::move(result);
}

template <typename Texel>
void set_layer_of(int level, int layer, GLenum format, const image::Image<Texel>& image) {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, level, 0, 0, layer, image.width, image.height, 1, format,
                    GL_UNSIGNED_SHORT, image.texels.data());
}

} // namespace

std::vector<glm::dvec3> shadow_on_face(const geometry::PropFace& face, const glm::dvec3& eye_m,
                                       const geometry::Box& box) {
    std::vector<glm::dvec3> polygon(face.corners.begin(), face.corners.end());
    const glm::dvec3 middle = 0.5 * (box.low + box.high);
    const auto faces_eye = [&](int axis, bool high) {
        return high ? eye_m[axis] > box.high[axis] : eye_m[axis] < box.low[axis];
    };
    // An edge along `axis` lies between a side across `u` and one across `v`: it is on the outline if exactly
    // one of them is visible.
    for (int axis = 0; axis < 3; ++axis) {
        const auto [u, v] = image_axes(axis);
        for (unsigned sides = 0; sides < 4; ++sides) {
            const bool u_high = (sides & 1U) != 0;
            const bool v_high = (sides & 2U) != 0;
            if (faces_eye(u, u_high) == faces_eye(v, v_high)) {
                continue;
            }
            const unsigned k = (u_high ? 1U << u : 0U) | (v_high ? 1U << v : 0U);
            cut(polygon, eye_m, corner_of(box, k), corner_of(box, k | (1U << axis)), middle);
        }
    }
    return polygon;
}

gl::GlTexture make_relief_array(GLenum format, int texels, int levels, int layers) {
    gl::GlTexture texture = gl::GlTexture::generate();
    glBindTexture(GL_TEXTURE_2D_ARRAY, texture.get());
    glTexStorage3D(GL_TEXTURE_2D_ARRAY, levels, format, texels, texels, layers);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER,
                    levels > 1 ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

void set_layer(int level, int layer, const image::Image<glm::u16vec2>& image) {
    set_layer_of(level, layer, GL_RG_INTEGER, image);
}
void set_layer(int level, int layer, const image::Image<glm::u16vec4>& image) {
    set_layer_of(level, layer, GL_RGBA_INTEGER, image);
}

Result<std::unique_ptr<Technique>> make_relief_technique(const Kiosk& kiosk, const ReliefImages& images,
                                                         ReliefSearch search) {
    std::string fragment(common_source);
    fragment += search.source;
    fragment += main_source;
    TRY(OutputPrograms programs,
        make_programs(search.defines + constants_of(images), vertex_source, fragment));
    TRY(OffscreenTarget points, make_target(kiosk.width(), kiosk.height(), GL_RGBA32F));
    ReliefGl gl{std::move(programs), std::move(search.relief), upload_colours(images)};
    if (glGetError() != GL_NO_ERROR) {
        return fail(ErrorKind::Internal, "bench.no_room_for_relief",
                    "the driver cannot hold the relief images");
    }
    return std::make_unique<ReliefTechnique>(kiosk, images.box, std::move(search.name), std::move(gl),
                                             std::move(points));
}

} // namespace frustumscreen::bench
