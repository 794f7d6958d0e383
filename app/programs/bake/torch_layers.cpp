#include "app/programs/bake/torch_layers.h"

#include "app/pack/pack_torches.h"
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/load_mesh.h"
#include "assets_baked/bake/loaders/decode_image.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace frustumscreen::programs {

namespace {

using folder::ArtifactTorchStage;

constexpr std::uintmax_t max_picture_bytes = std::uintmax_t{1} << 30;

bool is_model(const std::filesystem::path& file) {
    constexpr std::array<std::string_view, 5> endings{".glb", ".gltf", ".obj", ".ply", ".stl"};
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

/// A layer of a state covers the surface: where its picture is transparent it has the artifact's own colours.
struct WrittenLayer {
    const ArtifactTorchStage* stage = nullptr;
    bool covers = false;
};

bool is_same(const WrittenLayer& a, const WrittenLayer& b) {
    return a.stage->file == b.stage->file && a.stage->lit == b.stage->lit && a.covers == b.covers;
}

/// A model's layer covers all as it is.
WrittenLayer layer_of_state(const ArtifactTorchStage& stage) {
    return {&stage, !is_model(stage.file)};
}

/// Each different layer once.
std::vector<WrittenLayer> layers_in(const BakeRequest& request) {
    std::vector<WrittenLayer> layers;
    const auto add = [&](const WrittenLayer& layer) {
        if (std::none_of(layers.begin(), layers.end(),
                         [&](const WrittenLayer& each) { return is_same(each, layer); })) {
            layers.push_back(layer);
        }
    };
    for (const folder::ArtifactTorch& content : request.torches) {
        for (const ArtifactTorchStage& stage : content.stages) {
            if (stage.look.source == torch::Source::Layer) {
                add({&stage, false});
            }
        }
    }
    for (const folder::ArtifactState& state : request.states) {
        if (state.layer) {
            add(layer_of_state(*state.layer));
        }
    }
    return layers;
}

std::size_t number_of(const BakeRequest& request, const WrittenLayer& layer) {
    const std::vector<WrittenLayer> layers = layers_in(request);
    const auto found = std::find_if(layers.begin(), layers.end(),
                                    [&](const WrittenLayer& each) { return is_same(each, layer); });
    return static_cast<std::size_t>(found - layers.begin());
}

tl::unexpected<Error> other_surface(const ArtifactTorchStage& stage, std::string_view what) {
    return bad_input(
        "torch_layers.other_surface",
        "{}: {} has {} than the scan; allowed is the same surface with other pictures: export it "
        "from the same model, with only its pictures changed",
        stage.place, stage.file.filename().string(), what);
}

double extent_of(const bake::SourceMesh& mesh) {
    double extent = 0.0;
    for (const glm::dvec3& position : mesh.positions) {
        const glm::dvec3 away = glm::abs(position - mesh.positions.front());
        extent = std::max({extent, away.x, away.y, away.z});
    }
    return extent;
}

/// Same triangles of the same materials, corners and texture coordinates.
Result<void> check_surface(const ArtifactTorchStage& stage, const bake::SourceMesh& mesh,
                           const bake::SourceMesh& other) {
    constexpr double together = 1e-5; // of the surface's size
    constexpr float uv_together = 1e-5F;
    if (other.triangles != mesh.triangles || other.positions.size() != mesh.positions.size()) {
        return other_surface(stage, "other triangles");
    }
    if (other.triangle_materials != mesh.triangle_materials ||
        other.materials.size() != mesh.materials.size()) {
        return other_surface(stage, "other materials");
    }
    const double far = together * extent_of(mesh);
    for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
        if (!(glm::distance(mesh.positions[k], other.positions[k]) <= far)) {
            return other_surface(stage, "corners in other places");
        }
    }
    const auto near = [](const glm::vec2& a, const glm::vec2& b) {
        return glm::distance(a, b) <= uv_together;
    };
    if (!std::equal(mesh.uvs.begin(), mesh.uvs.end(), other.uvs.begin(), other.uvs.end(), near)) {
        return other_surface(stage, "other texture coordinates");
    }
    return {};
}

Result<bake::SourceLayer> layer_of_model(const ArtifactTorchStage& stage, const bake::SourceMesh& mesh,
                                         std::int64_t kept_texels) {
    TRY(const bake::SourceMesh other,
        at(stage.place, bake::load_mesh(stage.file, {.texture = {}, .kept_texels = kept_texels})));
    TRY_VOID(check_surface(stage, mesh, other));
    if (other.textures.empty() && !other.colours.empty()) {
        return bad_input("torch_layers.vertex_colours",
                         "{}: {} has its colours at its vertices; a layer needs them as a picture",
                         stage.place, stage.file.filename().string());
    }
    bake::SourceLayer layer;
    layer.textures = other.textures;
    layer.has_alpha = false;
    for (const bake::SourceMaterial& material : other.materials) {
        layer.looks.push_back({material.base_colour, material.texture});
    }
    return layer;
}

/// Refuses a picture that cannot stand in place of the scan's one picture.
Result<void> check_scan(const ArtifactTorchStage& stage, const bake::SourceMesh& mesh) {
    std::set<int> pictures;
    for (const std::uint32_t material : mesh.triangle_materials) {
        pictures.insert(mesh.materials[material].texture);
    }
    pictures.erase(-1);
    if (mesh.uvs.empty()) {
        return bad_input("torch_layers.no_coordinates",
                         "{}: the scan has no texture coordinates, by which the picture {} would lie on it; "
                         "allowed is a scan with a picture",
                         stage.place, stage.file.filename().string());
    }
    if (pictures.size() > 1) {
        return bad_input("torch_layers.several_pictures",
                         "{}: the scan has {} pictures, and {} is one; write layer = \"...glb\", the same "
                         "surface with other pictures",
                         stage.place, pictures.size(), stage.file.filename().string());
    }
    return {};
}

Result<bake::SourceLayer> layer_of_picture(const ArtifactTorchStage& stage, const bake::SourceMesh& mesh,
                                           std::int64_t kept_texels) {
    constexpr double same_shape = 0.02;
    TRY_VOID(check_scan(stage, mesh));
    TRY(const Bytes bytes, at(stage.place, read_file(stage.file, max_picture_bytes)));
    TRY(bake::ShrunkImage picture,
        at(stage.place,
           at(stage.file.filename().string(),
              bake::decode_shrunk(
                  bytes, [&](const glm::ivec2& size) { return bake::halvings_within(size, kept_texels); },
                  std::max(kept_texels, std::int64_t{1} << 24)))));
    const glm::ivec2 size = picture.file_size;
    if (std::min(size.x, size.y) < pack::min_torch_picture_px) {
        return bad_input("torch_layers.too_small",
                         "{}: {} has {} x {} pixels; allowed are {} a side and more, of the shape of the "
                         "scan's picture",
                         stage.place, stage.file.filename().string(), size.x, size.y,
                         pack::min_torch_picture_px);
    }
    if (mesh.contents.picture_sizes.size() == 1) {
        const glm::dvec2 own(mesh.contents.picture_sizes.front());
        const double ratio = size.x * own.y / (size.y * own.x);
        if (!(std::abs(ratio - 1.0) <= same_shape)) {
            return bad_input("torch_layers.other_shape",
                             "{}: {} has {} x {} pixels, the scan's picture {} x {}; allowed is one of the "
                             "same shape, since it takes that one's place",
                             stage.place, stage.file.filename().string(), size.x, size.y, own.x, own.y);
        }
    }
    bake::SourceLayer layer;
    bake::SourceTexture texture{std::make_shared<const image::Image8>(std::move(picture.image))};
    for (const bake::SourceMaterial& material : mesh.materials) {
        if (material.texture >= 0) {
            const bake::SourceTexture& own = mesh.textures[static_cast<std::size_t>(material.texture)];
            texture.wrap_u = own.wrap_u;
            texture.wrap_v = own.wrap_v;
        }
    }
    layer.textures = {std::move(texture)};
    layer.looks.assign(mesh.materials.size(), {glm::vec4(1.0F), 0});
    return layer;
}

} // namespace

Result<void> add_layers(const BakeRequest& request, bake::SourceMesh& mesh) {
    const std::vector<WrittenLayer> layers = layers_in(request);
    if (layers.size() > pack::max_layers) {
        return bad_input("torch_layers.count", "{}: torch and states have {} layers; allowed are {}",
                         layers.back().stage->place, layers.size(), pack::max_layers);
    }
    const std::int64_t kept_texels = bake::useful_picture_texels(request.options.size);
    for (const auto& [stage, covers] : layers) {
        TRY(bake::SourceLayer layer, is_model(stage->file) ? layer_of_model(*stage, mesh, kept_texels)
                                                           : layer_of_picture(*stage, mesh, kept_texels));
        layer.name = fmt::format("{}{}", printable(stage->file.filename().string(), 100),
                                 stage->lit ? "" : ", without light");
        for (std::size_t number = 2; std::any_of(mesh.layers.begin(), mesh.layers.end(),
                                                 [&](const auto& each) { return each.name == layer.name; });
             ++number) {
            layer.name = fmt::format("{} {}", printable(stage->file.filename().string(), 100), number);
        }
        layer.lit = stage->lit;
        layer.covers = covers;
        mesh.layers.push_back(std::move(layer));
    }
    return {};
}

std::size_t layer_of(const BakeRequest& request, const ArtifactTorchStage& stage) {
    return number_of(request, {&stage, false});
}

std::size_t state_layer_of(const BakeRequest& request, const ArtifactTorchStage& stage) {
    return number_of(request, layer_of_state(stage));
}

} // namespace frustumscreen::programs
