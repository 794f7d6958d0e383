#include "app/render/shader_cache.h"

#include "app/render/shader_source.h"
#include "app/scene/lit_tiles.h"
#include "firmware_host/gl/gl_program.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::render {

namespace {

/// In the order of Uniform.
constexpr std::array<const char*, static_cast<std::size_t>(Uniform::Count)> uniform_names{
    "corners",
    "clip_from_unit",
    "prop_from_unit",
    "brightness",
    "dither",
    "pixel_from_fragment",
    "ray_from_fragment",
    "inverse_depth",
    "face_gain",
    "edge_share",
    "rectangles",
    "picture",
    "raster",
    "clip_from_grid",
    "prop_from_grid",
    "mirrored",
    "light",
    "depth_from_nearness",
    "beam",
    "fall",
    "falloff_range",
    "inverse_z",
    "content_kind",
    "stage_kind",
    "stage_colour",
    "stage_size",
    "stage_from_content",
    "height_per_width",
    "torch_from_projector",
    "eye",
    "edge_count",
    "edges"};

/// In the order of the texture units that they read (GpuStore::Texture, GpuStore::Blocks, RasterPass, torch_uniforms.h).
constexpr std::array<const char*, 10> sampler_names{"image",  "blocks",  "covers", "nearness",
                                                    "shadow", "content", "layer",  "seen_by_torch",
                                                    "depths", "backs"};

} // namespace

Result<Shader> Shader::compile(const scene::ShaderKey& key, const std::optional<geometry::Pinhole>& bent_by) {
    const ShaderSource source = source_of(key, bent_by.has_value());
    TRY(gl::GlProgram program, gl::make_program(source.defines, source.vertex, source.fragment));
    Shader made;
    made.program_ = std::move(program);
    for (std::size_t k = 0; k < uniform_names.size(); ++k) {
        made.locations_[k] = glGetUniformLocation(made.program_.get(), uniform_names[k]);
    }
    made.use();
    for (std::size_t unit = 0; unit < sampler_names.size(); ++unit) {
        glUniform1i(glGetUniformLocation(made.program_.get(), sampler_names[unit]), static_cast<GLint>(unit));
    }
    if (bent_by) {
        made.bends_ = true;
        made.lens_from_clip_ = glGetUniformLocation(made.program_.get(), "lens_from_clip");
        made.distortion_ = glGetUniformLocation(made.program_.get(), "distortion");
        made.bend_by(*bent_by);
    }
    return made;
}

void Shader::bend_by(const geometry::Pinhole& pinhole) const {
    if (!bends_) {
        return;
    }
    const glm::dvec2 half = 0.5 * glm::dvec2(pinhole.width, pinhole.height);
    const glm::dvec2 focal(pinhole.fx, pinhole.fy);
    const glm::vec4 lens_from_clip(half / focal, (half - glm::dvec2(pinhole.cx, pinhole.cy)) / focal);
    const glm::vec3 distortion(pinhole.lens.k1, pinhole.lens.k2, pinhole.bends_to_r2());
    glUniform4fv(lens_from_clip_, 1, &lens_from_clip.x);
    glUniform3fv(distortion_, 1, &distortion.x);
}

void Shader::draw_quad() const {
    if (bends_) {
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 2 * (quad_cells + 1), quad_cells);
    } else {
        glDrawArrays(GL_TRIANGLE_FAN, 0, 4);
    }
}

void Shader::draw_rectangles(const glm::ivec2& picture, std::span<const PixelRectangle> rectangles) const {
    constexpr std::size_t corners_per_rectangle = 6;
    glUniform2f(location(Uniform::Picture), static_cast<float>(picture.x), static_cast<float>(picture.y));
    while (!rectangles.empty()) {
        const auto some = rectangles.first(std::min(rectangles.size(), scene::LitTiles::max_rectangles));
        std::array<glm::vec4, scene::LitTiles::max_rectangles> corners{};
        std::transform(some.begin(), some.end(), corners.begin(),
                       [](const PixelRectangle& r) { return glm::vec4(r.x, r.y, r.width, r.height); });
        glUniform4fv(location(Uniform::Rectangles), static_cast<GLsizei>(some.size()), &corners[0].x);
        glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners_per_rectangle * some.size()));
        rectangles = rectangles.subspan(some.size());
    }
}

Result<void> ShaderCache::prepare(const std::set<scene::ShaderKey>& keys,
                                  const std::optional<geometry::Pinhole>& bent_by) {
    if (bent_by != bent_by_) {
        shaders_.clear();
        bent_by_ = bent_by;
    }
    for (const scene::ShaderKey& key : keys) {
        if (find(key) != nullptr) {
            continue;
        }
        TRY(Shader shader, Shader::compile(key, bent_by));
        shaders_.emplace(key, std::move(shader));
    }
    return {};
}

const Shader* ShaderCache::find(const scene::ShaderKey& key) const {
    const auto found = shaders_.find(key);
    return found != shaders_.end() ? &found->second : nullptr;
}

std::set<scene::ShaderKey> ShaderCache::keys() const {
    std::set<scene::ShaderKey> keys;
    for (const auto& [key, shader] : shaders_) {
        keys.insert(key);
    }
    return keys;
}

} // namespace frustumscreen::render
