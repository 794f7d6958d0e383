#include "assets_baked/bake/loaders/ply_surface.h"

#include "assets_baked/bake/loaders/ply_roles.h"
#include "firmware_host/base/printable.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace frustumscreen::bake {

namespace {

constexpr int no_picture = -1;

} // namespace

std::size_t PlySurface::CornerHash::operator()(const CornerKey& key) const noexcept {
    std::uint64_t hash = key.vertex;
    for (const float value : {key.uv.x, key.uv.y}) {
        hash = (hash ^ std::bit_cast<std::uint32_t>(value)) * 0x9E3779B97F4A7C15U;
        hash ^= hash >> 29U;
    }
    return hash;
}

void PlySurface::at_vertices(bool coloured, bool textured) {
    coloured_ = coloured;
    textured_ = textured;
}

void PlySurface::face_value(std::string_view name, double value) {
    if (name == "texnumber") {
        const auto pictures = static_cast<double>(std::max<std::size_t>(pictures_.size(), 1));
        const bool is_known = value >= 0.0 && value < pictures;
        picture_ = is_known ? static_cast<int>(value) : no_picture;
    } else if (const PlyRole role = colour_role_of(name); role != PlyRole::None && role != PlyRole::Alpha) {
        colours_at_faces_ = true;
    }
}

void PlySurface::end_face(std::size_t first_corner, std::size_t end_corner) {
    const std::size_t count = end_corner - first_corner;
    const int last = picture_from_.empty() ? 0 : picture_from_.rbegin()->second;
    if (picture_ != last) {
        picture_from_.insert_or_assign(picture_from_.end(), first_corner, picture_);
    }
    if (!texcoord_.empty() && texcoord_.size() == 2 * count) {
        uvs_.resize(first_corner, glm::vec2(0.0F));
        for (std::size_t k = 0; k < count; ++k) {
            uvs_.push_back(MeshAssembly::finite_uv({texcoord_[2 * k], 1.0 - texcoord_[2 * k + 1]}));
        }
    } else {
        ++faces_without_uv_;
    }
    texcoord_.clear();
    picture_ = 0;
}

void PlySurface::begin() {
    const bool has_uvs = textured_ || !uvs_.empty();
    shows_pictures_ = has_uvs && (!pictures_.empty() || files_.pictures.has_curators());
    if (!pictures_.empty() && !has_uvs) {
        files_.notes.lost("the picture \"{}\": the file has no texture coordinates for it",
                          printable(pictures_.front()));
    }
    if (has_uvs && !shows_pictures_) {
        files_.notes.lost(
            "the picture: the file has texture coordinates, but does not name the picture; name it "
            "with --texture FILE");
    }
    if (!uvs_.empty() && shows_pictures_ && faces_without_uv_ > 0) {
        files_.notes.lost("the picture on {} without texture coordinates",
                          counted(faces_without_uv_, "face", "faces"));
    }
    if (colours_at_faces_ && !shows_pictures_ && !coloured_) {
        files_.notes.lost(
            "the colours: they stand at the faces; in MeshLab, transfer them to the vertices and "
            "export it again");
    }
    if (shows_pictures_ && coloured_) {
        files_.notes.guessed("it has a picture and colours at the vertices; the picture is shown");
        mesh_.drop_colours();
    }
    if (!shows_pictures_) {
        uvs_.clear();
        mesh_.drop_uvs();
    } else if (!uvs_.empty()) {
        taken_.resize(mesh_.positions().size(), false);
    }
}

std::uint32_t PlySurface::material(std::size_t first_corner) {
    if (!shows_pictures_) {
        return 0;
    }
    const auto after = picture_from_.upper_bound(first_corner);
    const int picture = after == picture_from_.begin() ? 0 : std::prev(after)->second;
    const auto [known, is_new] = materials_.try_emplace(picture, 0U);
    if (is_new) {
        SourceMaterial made;
        if (picture != no_picture) {
            const auto number = static_cast<std::size_t>(picture);
            made.texture = mesh_.add_texture(
                {number < pictures_.size()
                     ? files_.pictures.named(pictures_[number], "TextureFile " + printable(pictures_[number]))
                     : files_.pictures.curators()});
        }
        known->second = mesh_.add_material(made);
    }
    return known->second;
}

void PlySurface::split(std::size_t first_corner, std::span<std::uint32_t> corners) {
    if (uvs_.empty()) {
        return;
    }
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const glm::vec2 uv = first_corner + k < uvs_.size() ? uvs_[first_corner + k] : glm::vec2(0.0F);
        const std::uint32_t vertex = corners[k];
        const auto [known, is_new] = vertices_.try_emplace(CornerKey{vertex, uv}, vertex);
        if (is_new) {
            if (taken_[vertex]) {
                known->second = mesh_.copy_vertex(vertex);
            } else {
                taken_[vertex] = true;
            }
            mesh_.set_uv(known->second, glm::dvec2(uv));
        }
        corners[k] = known->second;
    }
}

} // namespace frustumscreen::bake
