#include "app/render/torch_pass.h"

#include "app/render/gl_memory.h"
#include "app/scene/torch_plan.h"

#include <GLES2/gl2ext.h>
#include <glm/gtc/matrix_inverse.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace frustumscreen::render {

namespace {

gl::GlTexture make_texture(GLenum format, GLint filter) {
    gl::GlTexture texture = gl::GlTexture::generate();
    glBindTexture(GL_TEXTURE_2D, texture.get());
    glTexStorage2D(GL_TEXTURE_2D, 1, format, scene::torch_picture_px, scene::torch_picture_px);
    for (const GLenum direction : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
        glTexParameteri(GL_TEXTURE_2D, direction, filter);
    }
    for (const GLenum direction : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) {
        glTexParameteri(GL_TEXTURE_2D, direction, GL_CLAMP_TO_EDGE);
    }
    return texture;
}

/// True if the torch lies in the level's box, and so may be in the object.
bool is_within(const scene::TorchLight& light, const scene::PlacedLevel& level) {
    const glm::dvec3 torch(glm::affineInverse(light.torch_from_prop * level.prop_from_placed)[3]);
    const geometry::Box box = level.placed_box();
    return glm::all(glm::greaterThanEqual(torch, box.low)) && glm::all(glm::lessThanEqual(torch, box.high));
}

bool is_within_any(const scene::TorchLight& light, const scene::FramePlan& view) {
    return std::any_of(view.casters.begin(), view.casters.end(),
                       [&](const scene::Part& part) { return is_within(light, part.level); });
}

/// The tiles of a beam's picture that its light may meet: of a round one those around its circle and within.
relief::TileMask tiles_in(const torch::Beam& beam) {
    constexpr int tile = relief::TileMask::tile_px;
    constexpr int px = scene::torch_picture_px;
    relief::TileMask tiles;
    for (int y = 0; y < px; y += tile) {
        const double middle = 0.5 * px;
        const double away = std::max({y - middle, middle - (y + tile), 0.0}); // of the tiles' nearest row
        constexpr double beside = 2.0;
        const double half = beam.shape == torch::Shape::Round
                                ? std::sqrt(std::max(middle * middle - away * away, 0.0)) + beside
                                : middle;
        const int first = std::max(static_cast<int>(middle - half), 0);
        tiles.ask({.x = first, .y = y, .width = px - 2 * first, .height = tile});
    }
    return tiles;
}

} // namespace

PixelRectangle TorchPass::lit_by(const scene::FramePlan& plan) {
    PixelRectangle lit;
    for (const scene::TorchDraw& draw : plan.torch_draws) {
        lit = united(lit, draw.bounds);
    }
    return lit;
}

Result<void> TorchPass::prepare(const scene::RenderNeeds& needs) {
    if (needs.torches.empty()) {
        return {};
    }
    scene::RenderNeeds own = needs;
    own.interlocks = true;
    TRY_VOID(rasters_.prepare(own, scene::torch_picture_px, scene::torch_picture_px));
    return targets_.empty() ? make_targets() : Result<void>();
}

Result<void> TorchPass::make_targets() {
    targets_.resize(torch::max_torches);
    pictures_.reserve(torch::max_torches);
    drawn_depth_ = make_texture(GL_DEPTH24_STENCIL8, GL_NEAREST);
    drawn_backs_ = make_texture(GL_DEPTH24_STENCIL8, GL_NEAREST);
    for (Target& target : targets_) {
        target.framebuffer = gl::GlFramebuffer::generate();
        target.depth = make_texture(GL_DEPTH24_STENCIL8, GL_NEAREST);
        target.colour = make_texture(GL_RGBA8, GL_LINEAR);
        target.nearness = make_texture(GL_RG32F, GL_NEAREST);
        glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer.get());
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.colour.get(), 0);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D, drawn_depth_.get(),
                               0);
        if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE ||
            glGetError() != GL_NO_ERROR) {
            return fail(ErrorKind::BadConfiguration, "render.no_room_for_torches",
                        "render: the driver has no memory for a torch's picture of {0} x {0} pixels; "
                        "set torch.source = \"none\"",
                        scene::torch_picture_px);
        }
    }
    return {};
}

int TorchPass::see(const scene::FramePlan& plan, const GpuStore& store, const ShaderCache& shaders,
                   RasterPass& painted) {
    const bool meshes = FacePass::draws(plan);
    pictures_.clear();
    int calls = 0;
    for (std::size_t k = 0; k < plan.torches.size() && k < targets_.size(); ++k) {
        const scene::TorchLight& light = plan.torches[k];
        const scene::FramePlan& view = plan.torch_views[k];
        const Target& target = targets_[k];
        TorchPicture& picture = pictures_.emplace_back();
        picture = {.shadow = target.depth.get(),
                   .colour = target.colour.get(),
                   .inverse_z = light.inverse_z_of_depth};
        if (!light.torch.casts_shadows) {
            if (painted.lights_here()) {
                painted.light_here(plan, k, nullptr);
            }
            continue;
        }
        const bool on_processor = scene::is_found_on_processor(view);
        const bool is_within = is_within_any(light, view);
        if (!on_processor && is_within) {
            calls += draw_view(view, target, store, shaders, false, relief::Facing::Away);
        }
        if (!on_processor || shows_own_view(light)) {
            calls += draw_view(view, target, store, shaders, shows_own_view(light));
        }
        if (on_processor) {
            const relief::TileMask asked = meshes ? tiles_in(light.torch.beam) : painted.asked_of(k);
            rasterize_view(light, view, asked, store);
            if (painted.lights_here()) {
                painted.light_here(plan, k, &shadow_map_);
            }
            if (meshes || !painted.lights_here()) {
                upload_shadow(asked.bounds(), target);
            }
            picture.shadow = target.nearness.get();
            picture.inverse_z = light.inverse_z_of_nearness;
        } else {
            calls += find_farthest(light, target, shaders, is_within);
        }
    }
    set_channels(glm::bvec3(true));
    return calls;
}

void TorchPass::rasterize_view(const scene::TorchLight& light, const scene::FramePlan& view,
                               const relief::TileMask& asked, const GpuStore& store) {
    if (asked.bounds().empty()) {
        return;
    }
    constexpr int px = scene::torch_picture_px;
    shadow_map_.begin(px, px, asked.bounds());
    if (view.relief_draw_count > 0) {
        const auto as_picture = [](std::span<float> rows) {
            return relief::PictureSpan<float>{.first = rows.data(), .width = px, .height = px, .stride = px};
        };
        rasters_.paint_nearness(view, store, asked, as_picture(shadow_map_.nearness()));
        if (is_within_any(light, view)) {
            rasters_.paint_nearness(view, store, asked, as_picture(shadow_map_.backs()),
                                    relief::Facing::Away);
        }
    }
    const geometry::Pinhole& pinhole = view.projector;
    const glm::dmat3 picture_from_ray(pinhole.fx, 0.0, 0.0, 0.0, pinhole.fy, 0.0, pinhole.cx, pinhole.cy,
                                      1.0);
    const glm::dvec4 casting(glm::dvec3(light.casting) * glm::inverse(picture_from_ray), light.casting.w);
    for (const scene::Draw& draw : view.draws) {
        const scene::PlacedLevel& level = view.casters[draw.part].level;
        if (level.triangles) {
            shadow_map_.draw({.picture_from_model = picture_from_ray * glm::dmat4x3(light.torch_from_prop *
                                                                                    level.prop_from_box()),
                              .metres = 1.0 / static_cast<double>(light.inverse_z_of_nearness.x),
                              .from_within = casting != glm::dvec4(0.0) || is_within(light, level),
                              .casting = casting},
                             level.triangles->positions,
                             std::span(view.indices).subspan(draw.range.first, draw.range.count));
        }
    }
    shadow_map_.end(slack_of(light));
}

void TorchPass::upload_shadow(const PixelRectangle& bounds, const Target& target) {
    if (bounds.empty()) {
        return;
    }
    shadow_map_.find_farthest();
    constexpr int px = scene::torch_picture_px;
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, target.nearness.get());
    const std::span<const torch::ShadowMap::Farthest> first =
        shadow_map_.farthest().subspan(static_cast<std::size_t>(bounds.y * px + bounds.x));
    glPixelStorei(GL_UNPACK_ROW_LENGTH, px);
    glTexSubImage2D(GL_TEXTURE_2D, 0, bounds.x, bounds.y, bounds.width, bounds.height, GL_RG, GL_FLOAT,
                    first.data());
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

int TorchPass::draw_view(const scene::FramePlan& view, const Target& target, const GpuStore& store,
                         const ShaderCache& shaders, bool colours, relief::Facing facing) {
    constexpr Raster whole{};
    if (view.relief_draw_count > 0) {
        rasters_.paint(view, store, RasterPass::Depth::Everywhere, RasterPass::Rectangles::MayBeCopied,
                       facing);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer.get());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D,
                           facing == relief::Facing::Eye ? drawn_depth_.get() : drawn_backs_.get(), 0);
    set_viewport({scene::torch_picture_px, scene::torch_picture_px}, whole);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_FRAMEBUFFER_SRGB_EXT);
    set_channels(glm::bvec3(colours));
    glDepthMask(GL_TRUE);
    glStencilMask(0xFF);
    glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
    glClearDepthf(1.0F);
    glClearStencil(static_cast<GLint>(stencil_value(0))); // its only face is the whole picture
    glClear((colours ? GL_COLOR_BUFFER_BIT : 0U) | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    const int calls = faces_.draw(view, store, shaders, whole, FacePass::Output::Colours, facing);
    const int reliefs = view.relief_draw_count > 0 ? rasters_.show_in_depth(view, shaders, whole) : 0;
    return calls + reliefs;
}

int TorchPass::find_farthest(const scene::TorchLight& light, const Target& target, const ShaderCache& shaders,
                             bool has_backs) const {
    const Shader* const shader = shaders.find({scene::ShaderKey::Pass::FarthestDepths});
    if (shader == nullptr) {
        return 0;
    }
    glBindFramebuffer(GL_FRAMEBUFFER, farthest_.get());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D, target.depth.get(), 0);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    glDepthMask(GL_TRUE);
    bind(depths_unit, drawn_depth_.get());
    bind(backs_unit, drawn_backs_.get());
    shader->use();
    glUniform3f(shader->location(Uniform::InverseZ), light.inverse_z_of_depth.x, light.inverse_z_of_depth.y,
                static_cast<float>(slack_of(light)));
    glUniform4i(shader->location(Uniform::Raster), has_backs ? 1 : 0, 0, 0, 0);
    glBindVertexArray(no_attributes_.get());
    constexpr int px = scene::torch_picture_px;
    const PixelRectangle whole{.x = 0, .y = 0, .width = px, .height = px};
    shader->draw_rectangles({px, px}, std::span(&whole, 1));
    glBindVertexArray(0);
    glDisable(GL_DEPTH_TEST);
    return 1;
}

int TorchPass::light_samples(const Lit& lit, const Raster& averaged, unsigned depths) const {
    const scene::ShaderKey::Pass pass = averaged.fragments == glm::ivec2(1)
                                            ? scene::ShaderKey::Pass::TorchOnPixels
                                            : scene::ShaderKey::Pass::TorchOnSamples;
    int calls = 0;
    glBindVertexArray(no_attributes_.get());
    glEnable(GL_SCISSOR_TEST);
    glDisable(GL_CULL_FACE);
    bind(depths_unit, depths);
    for (const scene::TorchFace& face : lit.plan.torch_faces) {
        const scene::TorchLight& light = lit.plan.torches[face.torch];
        const Shader* const shader = find_torch(lit.shaders, {pass}, light);
        if (shader == nullptr || shows_layer(light) || face.lit.rectangles().empty()) {
            continue;
        }
        shader->use();
        set_depths(*shader, face, {averaged.fragments, averaged.corner - lit.raster.corner});
        calls += light_face(lit, face, *shader, face.lit.rectangles());
    }
    end_blending();
    glDisable(GL_SCISSOR_TEST);
    glBindVertexArray(0);
    return calls;
}

int TorchPass::light_pixels(const Lit& lit) const {
    GLint framebuffer = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
    const GLuint colour = texture_of_framebuffer(GL_COLOR_ATTACHMENT0);
    const GLuint depths = texture_of_framebuffer(GL_DEPTH_ATTACHMENT);
    glBindFramebuffer(GL_FRAMEBUFFER, colour_alone_.get());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour, 0);
    const int calls = light_samples(lit, lit.raster, depths);
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(framebuffer));
    return calls;
}

std::uint64_t TorchPass::bytes() const {
    std::uint64_t bytes =
        rasters_.bytes() +
        (targets_.empty() ? 0 : bytes_of_texture(drawn_depth_) + bytes_of_texture(drawn_backs_));
    for (const Target& target : targets_) {
        bytes += bytes_of_texture(target.depth) + bytes_of_texture(target.colour) +
                 bytes_of_texture(target.nearness);
    }
    return bytes;
}

} // namespace frustumscreen::render
