/// One compiled program for each shader key, all made before the first frame.
///
/// Threads  the render thread; `find` allocates and compiles nothing.
/// Errors   Internal: a shader that the driver refuses.
#pragma once

#include "app/scene/shader_key.h"
#include "firmware_host/base/pixel_rectangle.h"
#include "firmware_host/base/result.h"
#include "firmware_host/gl/gl_handle.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <span>

namespace frustumscreen::render {

/// The uniforms of all shaders; each shader has some of them.
enum class Uniform : std::size_t {
    Corners,
    ClipFromUnit,
    PropFromUnit,
    Brightness,
    Dither,
    PixelFromFragment,
    RayFromFragment,
    InverseDepth,
    FaceGain,
    EdgeShare,
    Rectangles,
    Picture,
    Raster,
    ClipFromGrid,
    PropFromGrid,
    Mirrored,
    Light,
    DepthFromNearness,
    // Torches (torch_shader.h):
    Beam,
    Fall,
    FalloffRange,
    InverseZ,
    ContentKind,
    StageKind,
    StageColour,
    StageSize,
    StageFromContent,
    HeightPerWidth,
    TorchFromProjector,
    Eye,
    EdgeCount,
    Edges,
    Count
};

class Shader {
public:
    [[nodiscard]] static Result<Shader> compile(const scene::ShaderKey& key,
                                                const std::optional<geometry::Pinhole>& bent_by);
    void use() const { glUseProgram(program_.get()); }
    /// If the shader bends: bends by the pinhole's lens from now on, at first by that of `compile`. Call `use` first.
    void bend_by(const geometry::Pinhole& pinhole) const;
    /// Draws the quadrilateral of Uniform::Corners, in cells if the shader bends; call `use` first.
    void draw_quad() const;
    /// Draws rectangles of a picture of this size: Uniform::Rectangles. Call `use` first, and bind a vertex
    /// array without attributes.
    void draw_rectangles(const glm::ivec2& picture, std::span<const PixelRectangle> rectangles) const;
    /// -1, which OpenGL ignores, if the shader does not have the uniform.
    [[nodiscard]] GLint location(Uniform uniform) const {
        return locations_[static_cast<std::size_t>(uniform)];
    }

private:
    gl::GlProgram program_;
    bool bends_ = false;
    GLint distortion_ = -1, lens_from_clip_ = -1; ///< locations
    std::array<GLint, static_cast<std::size_t>(Uniform::Count)> locations_{};
};

class ShaderCache {
public:
    /// Compiles the missing shaders. `bent_by`: as RenderNeeds; shaders for another lens are deleted.
    [[nodiscard]] Result<void> prepare(const std::set<scene::ShaderKey>& keys,
                                       const std::optional<geometry::Pinhole>& bent_by);
    /// Null if the shader was not prepared.
    [[nodiscard]] const Shader* find(const scene::ShaderKey& key) const;
    [[nodiscard]] std::set<scene::ShaderKey> keys() const;

private:
    std::optional<geometry::Pinhole> bent_by_;
    std::map<scene::ShaderKey, Shader> shaders_;
};

} // namespace frustumscreen::render
