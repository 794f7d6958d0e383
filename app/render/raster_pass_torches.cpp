/// RasterPass: torches on what it has painted.
#include "app/render/raster_pass.h"
#include "app/scene/torch_plan.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <span>

namespace frustumscreen::render {

namespace {

/// A torch's draw of every relief on its face: they share one picture, in which a pixel is lit once. nullopt: the
/// draw of an earlier relief covers them all.
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
        set_nearness(*shader, lit.plan, light, face.face,
                     {lit.raster.fragments, lit.raster.corner + viewport});
        calls += light_face(lit, face, *shader, lit_parts_[k].rectangles);
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

} // namespace frustumscreen::render
