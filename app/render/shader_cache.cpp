#include "app/render/shader_cache.h"

#include "app/render/shader_source.h"
#include "firmware_host/gl/gl_program.h"

#include <utility>

namespace frustumscreen {

namespace {

/// In the order of Uniform.
constexpr std::array<const char*, static_cast<std::size_t>(Uniform::Count)> uniform_names{
    "corners",   "clip_from_unit",      "prop_from_unit",    "brightness",
    "dither",    "pixel_from_fragment", "ray_from_fragment", "inverse_depth",
    "face_gain", "edge_share",          "rectangles",        "picture",
    "raster",    "lens_from_clip",      "distortion"};

} // namespace

Result<Shader> Shader::compile(const ShaderKey& key, bool bends) {
    const ShaderSource source = source_of(key, bends);
    Result<GlProgram> program = make_program(source.defines, source.vertex, source.fragment);
    if (!program) {
        return tl::unexpected<Error>(program.error());
    }
    Shader made;
    made.program_ = std::move(*program);
    for (std::size_t k = 0; k < uniform_names.size(); ++k) {
        made.locations_[k] = glGetUniformLocation(made.program_.get(), uniform_names[k]);
    }
    made.use();
    glUniform1i(glGetUniformLocation(made.program_.get(), "image"), 0);
    return made;
}

Result<void> ShaderCache::prepare(const std::set<ShaderKey>& keys, bool bends) {
    if (bends != bends_) {
        shaders_.clear();
        bends_ = bends;
    }
    for (const ShaderKey& key : keys) {
        if (find(key) != nullptr) {
            continue;
        }
        Result<Shader> shader = Shader::compile(key, bends);
        if (!shader) {
            return tl::unexpected<Error>(shader.error());
        }
        shaders_.emplace(key, std::move(*shader));
    }
    return {};
}

const Shader* ShaderCache::find(const ShaderKey& key) const {
    const auto found = shaders_.find(key);
    return found != shaders_.end() ? &found->second : nullptr;
}

std::set<ShaderKey> ShaderCache::keys() const {
    std::set<ShaderKey> keys;
    for (const auto& [key, shader] : shaders_) {
        keys.insert(key);
    }
    return keys;
}

} // namespace frustumscreen
