#include "app/render/raster_pass.h"

#include "app/render/face_pass.h"
#include "app/render/gl_memory.h"
#include "firmware_host/base/usable_cores.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

namespace frustumscreen::render {

namespace {

/// True if the picture can be copied there: all colours are written, no mesh, no picture on the table. A face drawn in
/// black under such a picture does not matter, because the relief's unlit pixels are black too.
bool stands_alone(const scene::FramePlan& plan, const PixelRectangle& part) {
    return glm::all(plan.picture.channels) &&
           std::none_of(plan.draws.begin(), plan.draws.end(), [&](const scene::Draw& draw) {
               const bool black = draw.face == scene::Draw::on_table &&
                                  draw.drawable.material.texture == scene::TextureId::None;
               return draw.shader.pass != scene::ShaderKey::Pass::Raster && !black &&
                      !intersected(draw.bounds, part).empty();
           });
}

/// True if the two draws may light one pixel: not if a fade gives each pixel to one of them.
bool may_share_pixels(const scene::Draw& surface, const scene::Draw& raster,
                      const std::optional<scene::Dither>& dither) {
    const bool apart = surface.shader.dithered && dither && surface.dither.share == dither->share &&
                       surface.dither.complement != dither->complement;
    return surface.face == raster.face && !apart;
}

/// The pixels that a draw in the prop may light. For a relief, its view bounds them more closely than the draw. None for points: they
/// meet nothing by depth.
PixelRectangle pixels_of(const scene::FramePlan& plan, const scene::Draw& draw) {
    if (draw.shader.pass == scene::ShaderKey::Pass::Surface && !draw.shader.blocks) {
        return draw.bounds;
    }
    const int face = plan.faces[static_cast<std::size_t>(draw.face)].face;
    const scene::ReliefDraw& drawn = plan.relief_draws[draw.relief_draw];
    for (const relief::RasterFace& seen : drawn.view.faces) {
        if (seen.face == face && drawn.points == nullptr) {
            return seen.lit;
        }
    }
    return {};
}

bool has_layers(const scene::RenderNeeds& needs) {
    return std::any_of(needs.torches.begin(), needs.torches.end(),
                       [](std::uint8_t content) { return (content & torch::LayerPart) != 0; });
}

} // namespace

Result<void> RasterPass::prepare(const scene::RenderNeeds& needs, int width, int height) {
    const auto make = [&](gl::GlTexture& texture, GLenum format, const Upload& zeros) {
        texture = gl::GlTexture::generate();
        glBindTexture(GL_TEXTURE_2D, texture.get());
        glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        // Touches the driver's pages now, instead of when a shader first reads them.
        const PixelRectangle whole{.x = 0, .y = 0, .width = width, .height = height};
        upload(zeros, std::span(&whole, 1), {});
    };
    const bool rasterizes = needs.rasterizes && !painter_;
    const bool interlocks =
        needs.rasterizes && (needs.interlocks || !needs.torches.empty()) && nearness_.texels.empty();
    const bool layers = needs.rasterizes && has_layers(needs) && layer_.texels.empty();
    if (rasterizes) {
        painter_ = std::make_unique<relief::ReliefPainter>(static_cast<int>(usable_cores()));
        memory_ = image::Image8(width, height);
        make(colour_texels_, GL_RGBA8, colours());
    }
    if (interlocks) {
        nearness_ = image::Image<float>(width, height);
        make(nearness_texels_, GL_R32F, depths());
    }
    if (layers) {
        layer_ = image::Image8(width, height);
        make(layer_texels_, GL_RGBA8, layers_of_torches());
    }
    if ((rasterizes || interlocks || layers) && glGetError() != GL_NO_ERROR) {
        return fail(ErrorKind::BadConfiguration, "render.no_room_for_cast",
                    "render: the driver has no memory for the picture of a relief; use a mesh level, such as "
                    "--technique level1");
    }
    return {};
}

RasterPass::Upload RasterPass::colours() const {
    return {.format = GL_RGBA,
            .type = GL_UNSIGNED_BYTE,
            .texels = memory_.texels.data(),
            .bytes_of_texel = sizeof(glm::u8vec4),
            .width = memory_.width};
}

RasterPass::Upload RasterPass::depths() const {
    return {.format = GL_RED,
            .type = GL_FLOAT,
            .texels = nearness_.texels.data(),
            .bytes_of_texel = sizeof(float),
            .width = nearness_.width};
}

RasterPass::Upload RasterPass::layers_of_torches() const {
    Upload upload = colours();
    upload.texels = layer_.texels.data();
    upload.width = layer_.width;
    return upload;
}

void RasterPass::list_reliefs(const scene::FramePlan& plan, const GpuStore& store, relief::Facing facing) {
    seen_.clear();
    for (std::size_t k = 0; k < plan.relief_draw_count; ++k) {
        const scene::ReliefDraw& planned = plan.relief_draws[k];
        const relief::BlockRelief* const relief =
            planned.on_gpu || planned.points != nullptr ? nullptr : store.find_relief(planned.relief);
        if (relief != nullptr) {
            seen_.push_back({.relief = relief,
                             .view = &planned.view,
                             .dither = planned.dither,
                             .light = light_.rest_of(planned.light),
                             .facing = facing});
        }
    }
}

void RasterPass::find_meeting(const scene::FramePlan& plan) {
    meeting_.clear();
    if (nearness_.texels.empty()) {
        return;
    }
    std::array<PixelRectangle, geometry::max_faces> on_face{}; // all that is rasterized
    for (const scene::Draw& raster : plan.draws) {
        if (raster.shader.pass == scene::ShaderKey::Pass::Raster) {
            PixelRectangle& all = on_face[static_cast<std::size_t>(raster.face)];
            all = united(all, pixels_of(plan, raster));
        }
    }
    for (const scene::Draw& surface : plan.draws) {
        if (surface.shader.pass != scene::ShaderKey::Pass::Surface) {
            continue;
        }
        PixelRectangle reliefs =
            surface.shader.dithered ? PixelRectangle{} : on_face[static_cast<std::size_t>(surface.face)];
        for (const scene::Draw& raster : plan.draws) {
            if (surface.shader.dithered && raster.shader.pass == scene::ShaderKey::Pass::Raster &&
                may_share_pixels(surface, raster, plan.relief_draws[raster.relief_draw].dither)) {
                reliefs = united(reliefs, pixels_of(plan, raster));
            }
        }
        const PixelRectangle both = intersected(reliefs, pixels_of(plan, surface));
        if (!both.empty()) {
            meeting_.push_back(both);
        }
    }
}

void RasterPass::add_painted(const scene::FramePlan& plan, const PixelRectangle& part,
                             Rectangles rectangles) {
    const bool may_copy = rectangles == Rectangles::MayBeCopied;
    const auto add = [&](int left, int right) {
        const PixelRectangle columns{.x = left, .y = part.y, .width = right - left, .height = part.height};
        if (!columns.empty()) {
            (may_copy && stands_alone(plan, columns) ? copied_ : drawn_).push_back(columns);
        }
    };
    const int right = part.x + part.width;
    if (const PixelRectangle overlaid = relief::depth_part(part, lit_); !overlaid.empty()) {
        overlaid_.push_back(overlaid);
    }
    const PixelRectangle deep = relief::depth_part(part, meeting_);
    if (deep.empty()) {
        add(part.x, right);
        return;
    }
    in_depth_.push_back(deep);
    add(part.x, deep.x);
    add(deep.x + deep.width, right);
}

PixelRectangle RasterPass::paint_points(const scene::ReliefDraw& points) {
    if (!points_) {
        points_ = std::make_unique<PointPainter>();
    }
    return points_->paint(points,
                          {.first = memory_.texels.data(),
                           .width = memory_.width,
                           .height = memory_.height,
                           .stride = memory_.width},
                          light_);
}

bool RasterPass::paint_points_alone(const scene::FramePlan& plan) {
    if (plan.relief_draw_count == 0 || plan.relief_draws.front().points == nullptr ||
        plan.relief_draws.front().dither) {
        return false;
    }
    const PixelRectangle painted = paint_points(plan.relief_draws.front());
    if (!painted.empty()) {
        drawn_.push_back(painted);
        glActiveTexture(GL_TEXTURE0);
        glBindTexture(GL_TEXTURE_2D, colour_texels_.get());
        upload(colours(), drawn_, plan.picture.viewport);
    }
    return true;
}

void RasterPass::paint(const scene::FramePlan& plan, const GpuStore& store, Depth depth_of,
                       Rectangles rectangles, relief::Facing facing) {
    copied_.clear();
    drawn_.clear();
    in_depth_.clear();
    overlaid_.clear();
    if (!painter_) {
        return;
    }
    light_.begin(plan);
    if (paint_points_alone(plan)) {
        return;
    }
    list_reliefs(plan, store, facing);
    if (depth_of == Depth::Everywhere) {
        meeting_.assign(1, {.x = 0, .y = 0, .width = memory_.width, .height = memory_.height});
    } else {
        find_meeting(plan);
    }
    find_lit(plan, store);
    layered_ = std::any_of(seen_.begin(), seen_.end(),
                           [](const relief::SeenRelief& seen) { return seen.layer != nullptr; });
    int samples = 1;
    for (std::size_t k = 0; k < plan.relief_draw_count; ++k) {
        const scene::ReliefDraw& drawn = plan.relief_draws[k];
        samples = drawn.on_gpu || drawn.points != nullptr ? samples : std::max(samples, drawn.samples);
    }
    const relief::DepthPicture depth{.parts = meeting_,
                                     .nearness = {.first = nearness_.texels.data(),
                                                  .width = nearness_.width,
                                                  .height = nearness_.height,
                                                  .stride = nearness_.width},
                                     .overlaid = lit_,
                                     .layer = {.first = layered_ ? layer_.texels.data() : nullptr,
                                               .width = layer_.width,
                                               .height = layer_.height,
                                               .stride = layer_.width}};
    const std::span<const PixelRectangle> painted = painter_->paint(seen_, samples,
                                                                    {.first = memory_.texels.data(),
                                                                     .width = memory_.width,
                                                                     .height = memory_.height,
                                                                     .stride = memory_.width},
                                                                    &light_, depth);
    for (const PixelRectangle& part : painted) {
        add_painted(plan, part, rectangles);
    }
    glActiveTexture(GL_TEXTURE0);
    if (!drawn_.empty() || !in_depth_.empty()) {
        glBindTexture(GL_TEXTURE_2D, colour_texels_.get());
        upload(colours(), drawn_, plan.picture.viewport);
        upload(colours(), in_depth_, plan.picture.viewport);
    }
    if (!in_depth_.empty()) {
        glBindTexture(GL_TEXTURE_2D, nearness_texels_.get());
        upload(depths(), in_depth_, plan.picture.viewport);
    }
    if (!in_depth_.empty() && layered_) {
        glBindTexture(GL_TEXTURE_2D, layer_texels_.get());
        upload(layers_of_torches(), overlaid_, plan.picture.viewport);
    }
}

void RasterPass::upload(const Upload& from, std::span<const PixelRectangle> parts,
                        const PixelRectangle& viewport) {
    glPixelStorei(GL_UNPACK_ROW_LENGTH, from.width);
    for (const PixelRectangle& part : parts) {
        const auto first = static_cast<std::ptrdiff_t>(part.y) * from.width + part.x;
        glTexSubImage2D(GL_TEXTURE_2D, 0, viewport.x + part.x, viewport.y + part.y, part.width, part.height,
                        from.format, from.type,
                        static_cast<const std::byte*>(from.texels) + first * from.bytes_of_texel);
    }
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

int RasterPass::show_in_depth(const scene::FramePlan& plan, const ShaderCache& shaders,
                              const Raster& raster) const {
    const Shader* const shader = shaders.find({scene::ShaderKey::Pass::RasterInDepth});
    if (in_depth_.empty() || shader == nullptr) {
        return 0;
    }
    shader->use();
    shader->bend_by(plan.projector);
    const glm::ivec2 corner = raster.corner + glm::ivec2(plan.picture.viewport.x, plan.picture.viewport.y);
    glUniform4i(shader->location(Uniform::Raster), raster.fragments.x, raster.fragments.y, corner.x,
                corner.y);
    const glm::vec4 ray = ray_from_fragment(plan.projector, raster);
    glUniform4fv(shader->location(Uniform::RayFromFragment), 1, glm::value_ptr(ray));
    glActiveTexture(GL_TEXTURE3);
    glBindTexture(GL_TEXTURE_2D, nearness_texels_.get());
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, colour_texels_.get());
    glBindVertexArray(no_attributes_.get());
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_STENCIL_TEST);
    glEnable(GL_SCISSOR_TEST);
    for (std::size_t face = 0; face < plan.faces.size(); ++face) {
        glStencilFunc(GL_EQUAL, static_cast<GLint>(stencil_value(face)), 0xFF);
        set_scissor(plan.faces[face].bounds, raster);
        glUniform4fv(shader->location(Uniform::DepthFromNearness), 1,
                     glm::value_ptr(plan.faces[face].depth_from_nearness));
        shader->draw_rectangles({plan.projector.width, plan.projector.height}, in_depth_);
    }
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
    glBindVertexArray(0);
    return static_cast<int>(plan.faces.size());
}

int RasterPass::show(const scene::FramePlan& plan, const ShaderCache& shaders) const {
    if (!copied_.empty()) {
        glActiveTexture(GL_TEXTURE0);
        glBindTexture(GL_TEXTURE_2D, texture_of_framebuffer(GL_COLOR_ATTACHMENT0));
        upload(colours(), copied_, plan.picture.viewport);
    }
    const Shader* const shader = shaders.find(scene::raster_shader());
    if (drawn_.empty() || shader == nullptr) {
        return 0;
    }
    // One draw serves all faces: their pixels are disjoint, and the light is already applied.
    shader->use();
    glBindVertexArray(no_attributes_.get());
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, colour_texels_.get());
    shader->draw_rectangles({plan.projector.width, plan.projector.height}, drawn_);
    glBindVertexArray(0);
    return 1;
}

int RasterPass::blend_points(const scene::FramePlan& plan, const ShaderCache& shaders) {
    const auto drawn = std::span(plan.relief_draws).first(plan.relief_draw_count);
    const auto points = std::find_if(drawn.begin(), drawn.end(), [](const scene::ReliefDraw& each) {
        return each.points != nullptr && each.dither;
    });
    const Shader* const shader = shaders.find(scene::raster_shader());
    if (points == drawn.end() || shader == nullptr || !painter_) {
        return 0;
    }
    const PixelRectangle whole = scene::bounds_in_prop(plan);
    for (int y = whole.y; y < whole.y + whole.height; ++y) {
        std::fill_n(&memory_.at(whole.x, y), whole.width, glm::u8vec4(0, 0, 0, 255));
    }
    const PixelRectangle painted = intersected(paint_points(*points), whole);
    // Where there is no point, what is drawn there fades out.
    for (int y = painted.y; y < painted.y + painted.height; ++y) {
        for (int x = painted.x; x < painted.x + painted.width; ++x) {
            memory_.at(x, y).a = 255;
        }
    }
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, colour_texels_.get());
    upload(colours(), std::span(&whole, 1), plan.picture.viewport);
    shader->use();
    glBindVertexArray(no_attributes_.get());
    glEnable(GL_BLEND);
    glBlendColor(0.0F, 0.0F, 0.0F, points->dither->share);
    glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA);
    shader->draw_rectangles({plan.projector.width, plan.projector.height}, std::span(&whole, 1));
    glDisable(GL_BLEND);
    glBindVertexArray(0);
    return 1;
}

void RasterPass::paint_nearness(const scene::FramePlan& plan, const GpuStore& store,
                                const relief::TileMask& asked, const relief::PictureSpan<float>& nearness,
                                relief::Facing facing) {
    list_reliefs(plan, store, facing);
    painter_->paint_nearness(seen_, asked, nearness);
}

std::uint64_t RasterPass::bytes() const {
    return bytes_of_texture(colour_texels_) + bytes_of_texture(nearness_texels_) +
           bytes_of_texture(layer_texels_);
}

} // namespace frustumscreen::render
