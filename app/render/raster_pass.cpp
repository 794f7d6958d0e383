#include "app/render/raster_pass.h"

#include "app/render/face_pass.h"
#include "app/render/gl_memory.h"
#include "app/scene/torch_plan.h"
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

/// The pixels that a draw in the prop may light. For a relief, its view bounds them more closely than the draw.
PixelRectangle pixels_of(const scene::FramePlan& plan, const scene::Draw& draw) {
    if (draw.shader.pass == scene::ShaderKey::Pass::Surface && !draw.shader.blocks) {
        return draw.bounds;
    }
    const int face = plan.faces[static_cast<std::size_t>(draw.face)].face;
    for (const relief::RasterFace& seen : plan.relief_draws[draw.relief_draw].view.faces) {
        if (seen.face == face) {
            return seen.lit;
        }
    }
    return {};
}

bool has_layers(const scene::RenderNeeds& needs) {
    return std::any_of(needs.torches.begin(), needs.torches.end(),
                       [](std::uint8_t content) { return (content & torch::LayerPart) != 0; });
}

/// A torch's draw of every relief on its face: they share one picture, in which a pixel is lit once. nullopt: the draw of another
/// relief before it has them all.
std::optional<scene::TorchDraw> of_all_reliefs(const scene::FramePlan& plan, const scene::TorchDraw& draw) {
    const int face = plan.draws[draw.draw].face;
    scene::TorchDraw all = draw;
    for (const scene::TorchDraw& other : plan.torch_draws) {
        const scene::Draw& shown = plan.draws[other.draw];
        if (other.torch != draw.torch || shown.face != face ||
            shown.shader.pass != scene::ShaderKey::Pass::Raster) {
            continue;
        }
        if (other.draw < draw.draw) {
            return std::nullopt;
        }
        all.bounds = united(all.bounds, other.bounds);
    }
    return all;
}

/// The pixels of a torch's face that have a relief in its light, of which alone the nearness was found.
PixelRectangle reliefs_in_light(const scene::FramePlan& plan, const scene::TorchFace& face) {
    PixelRectangle reliefs;
    for (const scene::TorchDraw& lit : plan.torch_draws) {
        const scene::Draw& draw = plan.draws[lit.draw];
        if (lit.torch == face.torch && draw.face == face.face &&
            draw.shader.pass == scene::ShaderKey::Pass::Raster) {
            reliefs = united(reliefs, lit.bounds);
        }
    }
    return reliefs;
}

/// True if each torch is plain light whose shadows are found on the processor.
bool lights_on_processor(const scene::FramePlan& plan) {
    for (std::size_t k = 0; k < plan.torches.size(); ++k) {
        const scene::PlacedTorch& torch = plan.torches[k].torch;
        if (!is_plain(torch) || (torch.casts_shadows && !scene::is_found_on_processor(plan.torch_views[k]))) {
            return false;
        }
    }
    return true;
}

/// The edges of the draw's face as half spaces of rays.
void set_edges(const Shader& shader, const scene::FramePlan& plan, const scene::Draw& draw) {
    const geometry::Pinhole& pinhole = plan.projector;
    const int face = plan.faces[static_cast<std::size_t>(draw.face)].face;
    std::array<glm::vec3, geometry::max_face_corners> edges{};
    std::size_t count = 0;
    for (const relief::RasterFace& seen : plan.relief_draws[draw.relief_draw].view.faces) {
        for (std::size_t k = 0; seen.face == face && k < seen.edges.size(); ++k) {
            const glm::dvec3& edge = seen.edges[k]; // times (x, y, 1) of a pixel
            edges[count++] = glm::vec3(edge.x * pinhole.fx, edge.y * pinhole.fy,
                                       edge.x * pinhole.cx + edge.y * pinhole.cy + edge.z);
        }
    }
    glUniform1i(shader.location(Uniform::EdgeCount), static_cast<GLint>(count));
    glUniform3fv(shader.location(Uniform::Edges), static_cast<GLsizei>(edges.size()),
                 glm::value_ptr(edges[0]));
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
                    "render: the driver has no memory for a picture that is cast; use a technique of meshes");
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
            planned.on_gpu ? nullptr : store.find_relief(planned.relief);
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

void RasterPass::find_lit(const scene::FramePlan& plan, const GpuStore& store) {
    lit_.clear();
    for (const scene::TorchDraw& lit : plan.torch_draws) {
        const scene::Draw& draw = plan.draws[lit.draw];
        if (draw.shader.pass != scene::ShaderKey::Pass::Raster || nearness_.texels.empty()) {
            continue;
        }
        lit_.push_back(lit.bounds);
        const scene::TextureId layer = layer_of(plan.torches[lit.torch], draw.drawable);
        for (relief::SeenRelief& seen : seen_) {
            if (seen.view == &plan.relief_draws[draw.relief_draw].view && seen.layer == nullptr) {
                seen.layer = store.find_colours(layer);
            }
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

bool RasterPass::paint_points(const scene::FramePlan& plan) {
    if (plan.relief_draw_count == 0 || plan.relief_draws.front().points == nullptr) {
        return false;
    }
    if (!points_) {
        points_ = std::make_unique<PointPainter>();
    }
    const PixelRectangle painted = points_->paint(plan.relief_draws.front(),
                                                  {.first = memory_.texels.data(),
                                                   .width = memory_.width,
                                                   .height = memory_.height,
                                                   .stride = memory_.width},
                                                  light_);
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
    if (paint_points(plan)) {
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
        samples = plan.relief_draws[k].on_gpu ? samples : std::max(samples, plan.relief_draws[k].samples);
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

int RasterPass::light_rectangles(const scene::FramePlan& plan, const scene::TorchDraw& lit,
                                 const Shader& shader, const Raster& raster,
                                 std::span<const PixelRectangle> rectangles) {
    rectangles_.clear();
    for (const PixelRectangle& each : rectangles) {
        if (const PixelRectangle part = intersected(each, lit.bounds); !part.empty()) {
            rectangles_.push_back(part);
        }
    }
    if (rectangles_.empty()) {
        return 0;
    }
    const scene::Draw& draw = plan.draws[lit.draw];
    const glm::ivec2 corner = raster.corner + glm::ivec2(plan.picture.viewport.x, plan.picture.viewport.y);
    set_lit_face(shader, plan, draw, raster);
    set_nearness(shader, plan, plan.torches[lit.torch], draw.face, {raster.fragments, corner});
    set_edges(shader, plan, draw);
    shader.draw_rectangles({plan.projector.width, plan.projector.height}, rectangles_);
    return 1;
}

int RasterPass::light_layers_in_depth(const Lit& lit) {
    if (overlaid_.empty() || in_depth_.empty()) {
        return 0;
    }
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_FALSE);
    begin_lighting();
    int calls = 0;
    for (const scene::TorchDraw& draw : lit.plan.torch_draws) {
        const scene::TorchLight& light = lit.plan.torches[draw.torch];
        const Shader* const shader = find_torch(lit.shaders, {scene::ShaderKey::Pass::RasterInDepth}, light);
        if (lit.plan.draws[draw.draw].shader.pass != scene::ShaderKey::Pass::Raster || shader == nullptr ||
            !shows_layer(light)) {
            continue;
        }
        if (const std::optional<scene::TorchDraw> all = of_all_reliefs(lit.plan, draw)) {
            shader->use();
            set_torch(*shader, light, lit.torches[draw.torch], lit.store);
            begin_blending(light);
            calls += light_rectangles(lit.plan, *all, *shader, lit.raster, in_depth_);
        }
    }
    end_blending();
    glBindVertexArray(0);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glDisable(GL_DEPTH_TEST);
    return calls;
}

void RasterPass::begin_lighting() const {
    glBindVertexArray(no_attributes_.get());
    bind(3, nearness_texels_.get());
    bind(layer_unit, layer_texels_.get());
    bind(0, colour_texels_.get());
}

int RasterPass::light(const Lit& lit) const {
    if (lights_here_ || overlaid_.empty() || (copied_.empty() && drawn_.empty())) {
        return 0;
    }
    begin_lighting();
    glEnable(GL_SCISSOR_TEST);
    const glm::ivec2 viewport(lit.plan.picture.viewport.x, lit.plan.picture.viewport.y);
    int calls = 0;
    for (std::size_t k = 0; k < lit.plan.torch_faces.size(); ++k) {
        const scene::TorchFace& face = lit.plan.torch_faces[k];
        const scene::TorchLight& light = lit.plan.torches[face.torch];
        const Shader* const shader = find_torch(lit.shaders, scene::raster_shader(), light);
        if (shader == nullptr || lit_parts_[k].rectangles.empty()) {
            continue;
        }
        shader->use();
        set_torch(*shader, light, lit.torches[face.torch], lit.store);
        set_lit_face(*shader, lit.plan, lit.plan.draws[face.draw], lit.raster);
        set_nearness(*shader, lit.plan, light, face.face,
                     {lit.raster.fragments, lit.raster.corner + viewport});
        begin_blending(light);
        for (const PixelRectangle& part : lit_parts_[k].rectangles) {
            set_scissor(part, lit.raster);
            calls += draw_outline(lit.plan.faces[static_cast<std::size_t>(face.face)].corners_clip, *shader);
        }
    }
    end_blending();
    glDisable(GL_SCISSOR_TEST);
    glBindVertexArray(0);
    return calls;
}

void RasterPass::find_lit_parts(const scene::FramePlan& plan) {
    lit_parts_.resize(std::max(lit_parts_.size(), plan.torch_faces.size()));
    for (relief::TileMask& asked : asked_) {
        asked.clear();
    }
    lights_here_ = drawn_.empty() && lights_on_processor(plan);
    const relief::PictureSpan<const float> nearness{.first = nearness_.texels.data(),
                                                    .width = nearness_.width,
                                                    .height = nearness_.height,
                                                    .stride = nearness_.width};
    for (std::size_t k = 0; k < plan.torch_faces.size(); ++k) {
        const scene::TorchFace& face = plan.torch_faces[k];
        LitParts& lit = lit_parts_[k];
        lit.rectangles.clear();
        lit.asked.clear();
        const PixelRectangle reliefs = reliefs_in_light(plan, face);
        for (const std::vector<PixelRectangle>* const parts : {&copied_, &drawn_}) {
            for (const PixelRectangle& part : *parts) {
                for (const PixelRectangle& rectangle : face.lit.rectangles()) {
                    const PixelRectangle both = intersected(intersected(part, rectangle), reliefs);
                    if (!both.empty()) {
                        add_lit(plan, face, both, nearness, lit);
                    }
                }
            }
        }
        asked_.at(face.torch).ask(lit.asked);
        if (lit.rectangles.empty() || lights_here_) {
            continue;
        }
        glActiveTexture(GL_TEXTURE0);
        glBindTexture(GL_TEXTURE_2D, nearness_texels_.get());
        upload(depths(), lit.rectangles, plan.picture.viewport);
        if (layered_) {
            glBindTexture(GL_TEXTURE_2D, layer_texels_.get());
            upload(layers_of_torches(), lit.rectangles, plan.picture.viewport);
        }
    }
}

void RasterPass::light_here(const scene::FramePlan& plan, std::size_t torch, const torch::ShadowMap* shadow) {
    for (std::size_t k = 0; k < plan.torch_faces.size(); ++k) {
        const scene::TorchFace& face = plan.torch_faces[k];
        if (face.torch != torch || lit_parts_[k].rectangles.empty()) {
            continue;
        }
        plain_light_.light({.plan = plan, .face = face, .shadow = shadow}, lit_parts_[k].rectangles,
                           {.first = nearness_.texels.data(),
                            .width = nearness_.width,
                            .height = nearness_.height,
                            .stride = nearness_.width},
                           {.first = memory_.texels.data(),
                            .width = memory_.width,
                            .height = memory_.height,
                            .stride = memory_.width});
    }
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
