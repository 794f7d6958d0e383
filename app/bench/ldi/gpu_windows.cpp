#include "app/bench/ldi/gpu_windows.h"

#include "app/bench/measures/timing.h"
#include "app/ldi/triangle_rasterizer.h"

#include <glm/gtc/type_ptr.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace frustumscreen::bench {

namespace {

constexpr std::string_view vertex_source = R"(
layout(location = 0) in vec3 at;
layout(location = 1) in vec4 colour;
layout(location = 2) in float size;
uniform mat4 clip_from_window;
uniform float pixels_per_m;
out vec3 place;
out vec4 code;
void main() {
    gl_Position = clip_from_window * vec4(at, 1.0);
    gl_PointSize = size * pixels_per_m / gl_Position.w + 0.5; // a square that is not quite in the raster leaves no gap
    place = at;
    code = colour;
}
)";
constexpr std::string_view fragment_source = R"(
in vec3 place;
in vec4 code;
out vec4 result;
void main() {
#ifdef POINT
    result = vec4(place, 1.0);
#else
    result = vec4(code.rgb, 1.0);
#endif
}
)";

/// w is 1 on the window's plane; y = -1 is the picture's top; depth grows away from the eye.
glm::dmat4 clip_from_window(const glm::dvec3& eye) {
    constexpr double half = 0.5 * window_side_m;
    glm::dmat4 rows(0.0); // transposed at the end
    const glm::dvec4 w(0.0, 0.0, -1.0 / eye.z, 1.0);
    rows[0] = (glm::dvec4(1.0, 0.0, 0.0, -eye.x) + eye.x * w) / half;
    rows[1] = -(glm::dvec4(0.0, 1.0, 0.0, -eye.y) + eye.y * w) / half;
    rows[2] = w - glm::dvec4(0.0, 0.0, 0.0, 1.0);
    rows[3] = w;
    return glm::transpose(rows);
}

template <typename Value> GLsizeiptr size_of(std::span<const Value> values) {
    return static_cast<GLsizeiptr>(values.size_bytes());
}

} // namespace

Result<GpuWindow> GpuWindow::create(WindowSet& set, std::span<const Vertex> vertices,
                                    std::span<const std::uint32_t> indices) {
    GpuWindow made;
    made.set_ = &set;
    TRY(made.programs_, make_programs("", vertex_source, fragment_source));
    TRY(made.points_, make_target(set.pixels(), set.pixels(), GL_RGBA32F));
    made.array_ = gl::GlVertexArray::generate();
    made.vertices_ = gl::GlBuffer::generate();
    made.indices_ = gl::GlBuffer::generate();
    glBindVertexArray(made.array_.get());
    glBindBuffer(GL_ARRAY_BUFFER, made.vertices_.get());
    glBufferData(GL_ARRAY_BUFFER, size_of(vertices), vertices.data(), GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, made.indices_.get());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, size_of(indices), indices.data(), GL_STATIC_DRAW);
    const auto offset = [](std::size_t bytes) { return reinterpret_cast<const void*>(bytes); };
    constexpr GLsizei stride = sizeof(Vertex);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, stride, offset(offsetof(Vertex, at_m)));
    glVertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, offset(offsetof(Vertex, colour)));
    glVertexAttribPointer(2, 1, GL_FLOAT, GL_FALSE, stride, offset(offsetof(Vertex, size_m)));
    for (GLuint attribute = 0; attribute < 3; ++attribute) {
        glEnableVertexAttribArray(attribute);
    }
    glBindVertexArray(0);
    made.as_points_ = indices.empty();
    made.count_ = static_cast<GLsizei>(made.as_points_ ? vertices.size() : indices.size());
    made.bytes_ = vertices.size_bytes() + indices.size_bytes();
    return made;
}

void GpuWindow::draw_into(unsigned framebuffer, const glm::dvec3& eye_m, Output output) {
    begin_picture(framebuffer, set_->pixels(), set_->pixels(), PictureOf::Codes);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    const GLuint program = programs_.at(static_cast<std::size_t>(output)).get();
    glUseProgram(program);
    const glm::mat4 clip(clip_from_window(eye_m));
    glUniformMatrix4fv(glGetUniformLocation(program, "clip_from_window"), 1, GL_FALSE, glm::value_ptr(clip));
    glUniform1f(glGetUniformLocation(program, "pixels_per_m"), static_cast<float>(1.0 / set_->pixel_m()));
    glBindVertexArray(array_.get());
    if (as_points_) {
        glDrawArrays(GL_POINTS, 0, count_);
    } else {
        glDrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
    }
    glBindVertexArray(0);
    glDisable(GL_DEPTH_TEST);
    end_codes();
}

image::ImageFloat GpuWindow::hit_points(const glm::dvec3& eye_m) {
    draw_into(points_.framebuffer.get(), eye_m, Output::Point);
    return read_points(points_);
}

namespace {

/// Appends the grid of a picture: a vertex for each pixel with a surface, two triangles between four neighbours.
void add_grid(const ldi::DepthPicture& picture, std::vector<GpuWindow::Vertex>& vertices,
              std::vector<std::uint32_t>& indices) {
    constexpr std::uint32_t none = 0xFFFFFFFFU;
    const ldi::PictureCamera& camera = picture.camera;
    const ldi::PictureMap map(camera);
    const double pixel_m = 2.0 * glm::length(camera.half_right) / camera.width;
    std::vector<std::uint32_t> number(picture.nearness.size(), none);
    for (int y = 0; y < camera.height; ++y) {
        for (int x = 0; x < camera.width; ++x) {
            const std::size_t k = picture.at(x, y);
            const auto nearness = static_cast<double>(picture.nearness[k]);
            if (nearness > 0.0) {
                number[k] = static_cast<std::uint32_t>(vertices.size());
                vertices.push_back({.at_m = glm::vec3(map.point(x + 0.5, y + 0.5, nearness)),
                                    .colour = picture.colours[k],
                                    .size_m = static_cast<float>(pixel_m / nearness)});
            }
        }
    }
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        if (number[a] != none && number[b] != none && number[c] != none) {
            indices.insert(indices.end(), {number[a], number[b], number[c]});
        }
    };
    for (int y = 0; y + 1 < camera.height; ++y) {
        for (int x = 0; x + 1 < camera.width; ++x) {
            const std::size_t a = picture.at(x, y);
            const std::size_t b = picture.at(x + 1, y);
            const std::size_t c = picture.at(x + 1, y + 1);
            const std::size_t d = picture.at(x, y + 1);
            add(a, b, c);
            add(a, c, d);
        }
    }
}

class Gpu final : public WindowTechnique {
public:
    Gpu(std::string name, GpuWindow window, double make_ms)
        : name_(std::move(name)), window_(std::move(window)), make_ms_(make_ms) {}
    [[nodiscard]] std::string name() const override { return name_; }
    void draw(const glm::dvec3& eye_m) override { window_.draw(eye_m); }
    [[nodiscard]] image::ImageFloat hit_points(const glm::dvec3& eye_m) override {
        return window_.hit_points(eye_m);
    }
    [[nodiscard]] std::uint64_t bytes() const override { return window_.bytes(); }
    [[nodiscard]] double make_ms() const override { return make_ms_; }

private:
    std::string name_;
    GpuWindow window_;
    double make_ms_;
};

Result<std::unique_ptr<WindowTechnique>> warped(WindowSet& set, std::string name,
                                                std::span<const ldi::PictureCamera> cameras) {
    const double begun_ms = cpu_now_ms();
    ldi::TriangleRasterizer rasterizer;
    ldi::DepthPicture picture;
    std::vector<GpuWindow::Vertex> vertices;
    std::vector<std::uint32_t> indices;
    for (const ldi::PictureCamera& camera : cameras) {
        picture.begin(camera);
        rasterizer.draw(*set.scene().world, picture);
        add_grid(picture, vertices, indices);
    }
    TRY(GpuWindow window, GpuWindow::create(set, vertices, indices));
    return std::make_unique<Gpu>(std::move(name), std::move(window), cpu_now_ms() - begun_ms);
}

} // namespace

Result<std::unique_ptr<WindowTechnique>> make_cube_depth(WindowSet& set) {
    const glm::dvec3 eye(0.0, 0.0, 0.0);
    constexpr double half = 0.01; // any value does: the sides are at right angles
    const std::array<glm::dvec3, 5> ahead{glm::dvec3(0, 0, -1), {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
    std::vector<ldi::PictureCamera> cameras;
    for (const glm::dvec3& each : ahead) {
        const glm::dvec3 up = each.z != 0.0 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
        cameras.push_back({.eye = eye,
                           .middle = eye + half * each,
                           .half_right = half * glm::cross(each, up),
                           .half_up = half * up,
                           .width = set.pixels(),
                           .height = set.pixels()});
    }
    return warped(set, "cube_depth", cameras);
}

Result<std::unique_ptr<WindowTechnique>> make_view_depth(WindowSet& set) {
    const ldi::PictureCamera camera = ldi::camera_through_window(
        set.scene().frozen_eye_m, glm::dvec2(0.5 * window_side_m), set.pixels(), set.pixels());
    return warped(set, "view_depth", {&camera, 1});
}

} // namespace frustumscreen::bench
