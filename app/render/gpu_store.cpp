#include "app/render/gpu_store.h"

#include "app/render/gl_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

namespace frustumscreen::render {

namespace {

/// The driver's limit for a texture's side.
int max_texels() {
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    return limit;
}

void clamp_to_edge(GLenum minification) {
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, static_cast<GLint>(minification));
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

gl::GlTexture upload_coverage(const image::Image<std::uint8_t>& coverage) {
    gl::GlTexture texture = gl::GlTexture::generate();
    glBindTexture(GL_TEXTURE_2D, texture.get());
    const auto longest = static_cast<unsigned>(std::max(coverage.width, coverage.height));
    const auto mips = static_cast<GLsizei>(std::bit_width(longest));
    glTexStorage2D(GL_TEXTURE_2D, mips, GL_R8, coverage.width, coverage.height);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, coverage.width, coverage.height, GL_RED, GL_UNSIGNED_BYTE,
                    coverage.texels.data());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glGenerateMipmap(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_G, GL_RED); // white light
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_B, GL_RED);
    clamp_to_edge(GL_LINEAR_MIPMAP_LINEAR);
    return texture;
}

/// The sampler decodes the codes, so that it filters in linear light.
gl::GlTexture upload_light(std::span<const image::Image8> mips) {
    gl::GlTexture texture = gl::GlTexture::generate();
    glBindTexture(GL_TEXTURE_2D, texture.get());
    glTexStorage2D(GL_TEXTURE_2D, static_cast<GLsizei>(mips.size()), GL_SRGB8_ALPHA8, mips.front().width,
                   mips.front().height);
    for (std::size_t k = 0; k < mips.size(); ++k) {
        glTexSubImage2D(GL_TEXTURE_2D, static_cast<GLint>(k), 0, 0, mips[k].width, mips[k].height, GL_RGBA,
                        GL_UNSIGNED_BYTE, mips[k].texels.data());
    }
    clamp_to_edge(GL_LINEAR_MIPMAP_LINEAR);
    return texture;
}

/// `over` over `colours`, by its alpha, in linear light.
std::vector<glm::u8vec4> mixed(const std::vector<glm::u8vec4>& colours, std::vector<glm::u8vec4> over) {
    for (std::size_t k = 0; k < over.size(); ++k) {
        const double share = over[k].a / 255.0;
        for (int channel = 0; channel < 3; ++channel) {
            over[k][channel] = image::srgb8_from_linear(
                glm::mix(static_cast<double>(image::linear_from_srgb8()[colours[k][channel]]),
                         static_cast<double>(image::linear_from_srgb8()[over[k][channel]]), share));
        }
        over[k].a = 255;
    }
    return over;
}

template <typename Map, typename Id> auto found(const Map& map, Id id) -> const typename Map::mapped_type* {
    const auto place = map.find(id);
    return place != map.end() ? &place->second : nullptr;
}

} // namespace

Result<scene::Drawable> GpuStore::upload(const pack::Pack& pack, std::uint32_t level) {
    return upload(scene::whole_level(pack, level), pack.textures[pack.levels[level].texture]);
}

Result<scene::Drawable> GpuStore::upload(const scene::SceneLevel& level, const image::Image8& texture) {
    LevelUpload whole(scene::level_data(level, texture));
    TRY_VOID(whole.go_on());
    return keep(std::move(whole));
}

scene::Drawable GpuStore::keep(LevelUpload upload, scene::TextureId texture) {
    if (upload.data_.relief && !upload.blocks_) {
        return keep(std::move(upload.data_.relief));
    }
    const scene::MeshId id{++last_};
    if (upload.blocks_) {
        BlockUpload::Textures blocks = upload.blocks_->take();
        blocks_.emplace(
            id, Blocks{std::move(upload.data_.relief), std::move(blocks.numbers), std::move(blocks.covers)});
        return {id, {keep(std::move(blocks.colours), 0)}};
    }
    meshes_.emplace(id, Mesh{std::move(upload.vertex_array_), std::move(upload.vertices_)});
    const scene::LevelData& data = upload.data_;
    if (!data.texture_of) {
        texture = keep(std::move(upload.texels_), data.finest_mip);
    } else if (const auto shared = textures_.find(texture); shared != textures_.end()) {
        ++shared->second.users;
    }
    return {id, {texture, data.texels_per_box, data.cut_out}};
}

Result<scene::Drawable> GpuStore::upload(std::shared_ptr<const relief::BlockRelief> relief) {
    scene::LevelData data;
    data.relief = std::move(relief);
    data.on_gpu = true;
    LevelUpload whole(std::move(data));
    TRY_VOID(whole.go_on());
    return keep(std::move(whole));
}

scene::Drawable GpuStore::keep(std::shared_ptr<const relief::BlockRelief> relief) {
    const scene::MeshId id{++last_};
    reliefs_.emplace(id, std::move(relief));
    return {id, {}};
}

Result<scene::TextureId> GpuStore::upload(const image::Image<std::uint8_t>& coverage) {
    const int limit = max_texels();
    if (coverage.width < 1 || coverage.height < 1 || std::max(coverage.width, coverage.height) > limit) {
        return fail(ErrorKind::BadConfiguration, "render.caption_size",
                    "render: a caption has {} x {} pixels, and this driver allows 1 to {} on each side; use "
                    "smaller letters",
                    coverage.width, coverage.height, limit);
    }
    return keep(upload_coverage(coverage), 0);
}

Result<scene::TextureId> GpuStore::upload_picture(std::span<const image::Image8> mips) {
    const int width = mips.empty() ? 0 : mips.front().width;
    const int height = mips.empty() ? 0 : mips.front().height;
    const int limit = max_texels();
    if (width < 1 || height < 1 || std::max(width, height) > limit) {
        return fail(ErrorKind::BadConfiguration, "render.picture_size",
                    "render: a picture has {} x {} texels, and this driver allows 1 to {} on each side; use "
                    "a smaller picture",
                    width, height, limit);
    }
    return keep(upload_light(mips), 0);
}

scene::TextureId GpuStore::keep(gl::GlTexture texels, int finest_mip) {
    const scene::TextureId id{++last_};
    textures_.emplace(id, Texture{std::move(texels), finest_mip});
    return id;
}

Result<void> GpuStore::add_layer(scene::Drawable& drawable, std::size_t layer, const image::Image8& texture) {
    const int limit = max_texels();
    if (texture.width < 1 || texture.height < 1 || std::max(texture.width, texture.height) > limit) {
        return fail(ErrorKind::BadConfiguration, "render.layer_size",
                    "render: a layer has {} x {} texels, and this driver allows 1 to {} on each side; bake "
                    "with a smaller --size",
                    texture.width, texture.height, limit);
    }
    gl::GlTexture texels = gl::GlTexture::generate();
    glBindTexture(GL_TEXTURE_2D, texels.get());
    const auto longest = static_cast<unsigned>(std::max(texture.width, texture.height));
    glTexStorage2D(GL_TEXTURE_2D, static_cast<GLsizei>(std::bit_width(longest)), GL_RGBA8, texture.width,
                   texture.height);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, texture.width, texture.height, GL_RGBA, GL_UNSIGNED_BYTE,
                    texture.texels.data());
    glGenerateMipmap(GL_TEXTURE_2D);
    clamp_to_edge(GL_LINEAR_MIPMAP_LINEAR);
    release(drawable.layers[layer]);
    drawable.layers[layer] = keep(std::move(texels), 0);
    return {};
}

void GpuStore::add_layer(scene::Drawable& drawable, std::size_t layer,
                         std::shared_ptr<const std::vector<glm::u8vec4>> colours) {
    const relief::BlockRelief* const relief = find_relief(drawable.mesh);
    if (relief != nullptr && std::any_of(colours->begin(), colours->end(),
                                         [](const glm::u8vec4& colour) { return colour.a < 255; })) {
        colours = std::make_shared<const std::vector<glm::u8vec4>>(mixed(relief->colours, *colours));
    }
    release(drawable.layers[layer]);
    if (const Blocks* const blocks = find_blocks(drawable.mesh)) {
        drawable.layers[layer] = keep(upload_block_colours(*blocks->relief, *colours), 0);
        return;
    }
    drawable.layers[layer] = scene::TextureId{++last_};
    colours_.emplace(drawable.layers[layer], std::move(colours));
}

void GpuStore::replace_picture(scene::TextureId texture, const image::Image8& picture) {
    if (const Texture* const held = find(texture)) {
        glBindTexture(GL_TEXTURE_2D, held->texels.get());
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, picture.width, picture.height, GL_RGBA, GL_UNSIGNED_BYTE,
                        picture.texels.data());
        glGenerateMipmap(GL_TEXTURE_2D);
    }
}

const std::vector<glm::u8vec4>* GpuStore::find_colours(scene::TextureId layer) const {
    const auto* const held = found(colours_, layer);
    return held != nullptr ? held->get() : nullptr;
}

void GpuStore::release(const scene::Drawable& drawable) {
    for (const scene::TextureId layer : drawable.layers) {
        release(layer);
    }
    meshes_.erase(drawable.mesh);
    reliefs_.erase(drawable.mesh);
    blocks_.erase(drawable.mesh);
    release(drawable.material.texture);
}

void GpuStore::release(scene::TextureId texture) {
    if (const auto held = textures_.find(texture); held != textures_.end() && --held->second.users == 0) {
        textures_.erase(held);
    }
    colours_.erase(texture);
}

const GpuStore::Mesh* GpuStore::find(scene::MeshId mesh) const {
    return found(meshes_, mesh);
}

const relief::BlockRelief* GpuStore::find_relief(scene::MeshId relief) const {
    const auto place = reliefs_.find(relief);
    const Blocks* const blocks = find_blocks(relief);
    return place != reliefs_.end() ? place->second.get() : blocks != nullptr ? blocks->relief.get() : nullptr;
}

const GpuStore::Blocks* GpuStore::find_blocks(scene::MeshId relief) const {
    return found(blocks_, relief);
}

const GpuStore::Texture* GpuStore::find(scene::TextureId texture) const {
    return found(textures_, texture);
}

std::uint64_t GpuStore::bytes() const {
    std::uint64_t bytes = 0;
    for (const auto& [id, mesh] : meshes_) {
        bytes += bytes_of_buffer(mesh.vertices);
    }
    for (const auto& [id, blocks] : blocks_) {
        bytes += bytes_of_texture(blocks.numbers) + bytes_of_texture(blocks.covers);
    }
    for (const auto& [id, texture] : textures_) {
        bytes += bytes_of_texture(texture.texels);
    }
    return bytes;
}

std::uint64_t GpuStore::bytes(const scene::Drawable& drawable) const {
    const Mesh* const mesh = find(drawable.mesh);
    const Blocks* const blocks = find_blocks(drawable.mesh);
    return (mesh != nullptr ? bytes_of_buffer(mesh->vertices) : 0) +
           (blocks != nullptr ? bytes_of_texture(blocks->numbers) + bytes_of_texture(blocks->covers) : 0) +
           bytes(drawable.material.texture);
}

std::uint64_t GpuStore::bytes(scene::TextureId texture) const {
    const Texture* const held = find(texture);
    return held != nullptr ? bytes_of_texture(held->texels) : 0;
}

} // namespace frustumscreen::render
