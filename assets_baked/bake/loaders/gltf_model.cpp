#include "assets_baked/bake/loaders/gltf_model.h"

#include "assets_baked/bake/loaders/refusal.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace frustumscreen::bake {

namespace {

/// Supported extensions, and those that change neither shape nor base colour: a file that requires one of the latter is
/// still shown correctly.
constexpr std::array known_extensions = {
    std::string_view("KHR_draco_mesh_compression"),
    std::string_view("EXT_meshopt_compression"),
    std::string_view("KHR_mesh_quantization"),
    std::string_view("KHR_texture_transform"),
    std::string_view("EXT_texture_webp"),
    std::string_view("KHR_materials_unlit"),
    std::string_view("KHR_materials_pbrSpecularGlossiness"),
    std::string_view("KHR_materials_anisotropy"),
    std::string_view("KHR_materials_clearcoat"),
    std::string_view("KHR_materials_emissive_strength"),
    std::string_view("KHR_materials_ior"),
    std::string_view("KHR_materials_iridescence"),
    std::string_view("KHR_materials_sheen"),
    std::string_view("KHR_materials_specular"),
    std::string_view("KHR_materials_transmission"),
    std::string_view("KHR_materials_variants"),
    std::string_view("KHR_materials_volume"),
    std::string_view("KHR_lights_punctual"),
    std::string_view("KHR_xmp_json_ld"),
    std::string_view("EXT_mesh_gpu_instancing"),
    std::string_view("KHR_node_visibility"),
    std::string_view("KHR_materials_diffuse_transmission"),
    std::string_view("KHR_materials_dispersion"),
    std::string_view("FB_ngon_encoding"),
    std::string_view("EXT_mesh_features"),
    std::string_view("EXT_structural_metadata"),
    std::string_view("MSFT_packing_normalRoughnessMetallic"),
    std::string_view("MSFT_packing_occlusionRoughnessMetallic"),
};

bool is_known(std::string_view extension) {
    return std::find(known_extensions.begin(), known_extensions.end(), extension) != known_extensions.end();
}

void check_header(const JsonPlace& document) {
    const std::string version = document.at("asset").at("version").text();
    if (!version.starts_with("2.")) {
        refuse("mesh.gltf_version", "glTF {} cannot be read, only 2.x (asset.version); export it as glTF 2.0",
               version.substr(0, 20));
    }
    const std::optional<JsonPlace> required = document.find("extensionsRequired");
    for (std::size_t i = 0; required && i < required->size(); ++i) {
        const std::string name = (*required)[i].text();
        if (!is_known(name)) {
            refuse("mesh.gltf_extension",
                   "it needs the extension {} of glTF, which is not supported; export it without that "
                   "(extensionsRequired[{}])",
                   name.substr(0, 80), i);
        }
    }
}

/// All extensions that the file declares or, without a declaration, has.
std::vector<std::string> unknown_extensions_of(const JsonPlace& document) {
    std::vector<std::string> unknown;
    for (const std::string& name : document.extensions_inside()) {
        if (!is_known(name)) {
            unknown.push_back(name);
        }
    }
    const std::optional<JsonPlace> used = document.find("extensionsUsed");
    for (std::size_t i = 0; used && i < used->size(); ++i) {
        std::string name = (*used)[i].text();
        if (!is_known(name) && std::find(unknown.begin(), unknown.end(), name) == unknown.end()) {
            unknown.push_back(std::move(name));
        }
    }
    return unknown;
}

std::vector<std::string> variants_of(const JsonPlace& document) {
    std::vector<std::string> names;
    if (const auto extension = extension_of(document, "KHR_materials_variants")) {
        const JsonPlace variants = extension->at("variants");
        for (std::size_t i = 0; i < variants.size(); ++i) {
            names.push_back(variants[i].text_or("name", "without a name"));
        }
    }
    return names;
}

bool declares(const JsonPlace& document, std::string_view extension) {
    for (const std::string_view list : {"extensionsUsed", "extensionsRequired"}) {
        const std::optional<JsonPlace> names = document.find(list);
        for (std::size_t i = 0; names && i < names->size(); ++i) {
            if ((*names)[i].text() == extension) {
                return true;
            }
        }
    }
    return false;
}

/// Refuses [offset, offset + length) outside the buffer.
void check_range(const JsonPlace& place, const GltfModel& model, std::size_t buffer, std::uint64_t offset,
                 std::uint64_t length) {
    const std::uint64_t available = model.buffers[buffer].byte_length;
    if (offset > available || length > available - offset) {
        refuse_contradiction("{}: bytes {} to {} are out of range, buffers[{}] has {}", place.path(), offset,
                             offset + length, buffer, available);
    }
}

template <typename Value, std::size_t count>
Value named(const JsonPlace& place, const std::array<std::pair<std::string_view, Value>, count>& names) {
    const std::string text = place.text();
    for (const auto& [name, value] : names) {
        if (text == name) {
            return value;
        }
    }
    refuse_damage("{}: \"{}\" is not known", place.path(), text.substr(0, 40));
}

GltfMeshopt meshopt_from(const JsonPlace& place, const GltfModel& model) {
    using namespace std::string_view_literals;
    constexpr std::array modes = {std::pair("ATTRIBUTES"sv, MeshoptMode::Attributes),
                                  std::pair("TRIANGLES"sv, MeshoptMode::Triangles),
                                  std::pair("INDICES"sv, MeshoptMode::Indices)};
    constexpr std::array filters = {std::pair("NONE"sv, MeshoptFilter::None),
                                    std::pair("OCTAHEDRAL"sv, MeshoptFilter::Octahedral),
                                    std::pair("QUATERNION"sv, MeshoptFilter::Quaternion),
                                    std::pair("EXPONENTIAL"sv, MeshoptFilter::Exponential)};
    GltfMeshopt meshopt;
    meshopt.buffer = place.at("buffer").index_into(model.buffers.size());
    meshopt.byte_offset = place.whole_or("byteOffset", 0);
    meshopt.byte_length = place.at("byteLength").whole(1);
    meshopt.byte_stride = static_cast<std::size_t>(place.at("byteStride").whole(1, 256));
    meshopt.count = static_cast<std::size_t>(place.at("count").whole(1));
    meshopt.mode = named(place.at("mode"), modes);
    if (const auto filter = place.find("filter")) {
        meshopt.filter = named(*filter, filters);
    }
    check_range(place, model, meshopt.buffer, meshopt.byte_offset, meshopt.byte_length);
    return meshopt;
}

GltfBufferView view_from(const JsonPlace& place, const GltfModel& model) {
    GltfBufferView view;
    view.buffer = place.at("buffer").index_into(model.buffers.size());
    view.byte_offset = place.whole_or("byteOffset", 0);
    view.byte_length = place.at("byteLength").whole(1);
    if (const auto stride = place.find("byteStride")) {
        view.byte_stride = stride->whole(4, 252);
        if (*view.byte_stride > view.byte_length) {
            refuse_contradiction("{}: {} is more than the view's {} bytes", stride->path(), *view.byte_stride,
                                 view.byte_length);
        }
    }
    check_range(place, model, view.buffer, view.byte_offset, view.byte_length);
    if (const auto meshopt = extension_of(place, "EXT_meshopt_compression")) {
        view.meshopt = meshopt_from(*meshopt, model);
    }
    return view;
}

ComponentType component_type_from(const JsonPlace& place) {
    const std::uint64_t number = place.whole();
    if (number < 5120 || number > 5126 || number == 5124) {
        refuse_damage("{}: {} is not a component type of glTF 2.0", place.path(), number);
    }
    return static_cast<ComponentType>(number);
}

GltfSparse sparse_from(const JsonPlace& place, const GltfModel& model, std::size_t accessor_count) {
    GltfSparse sparse;
    sparse.count = static_cast<std::size_t>(place.at("count").whole(1, accessor_count));
    const JsonPlace indices = place.at("indices");
    sparse.indices_view = indices.at("bufferView").index_into(model.views.size());
    sparse.indices_offset = indices.whole_or("byteOffset", 0);
    sparse.indices_type = component_type_from(indices.at("componentType"));
    if (sparse.indices_type != ComponentType::U8 && sparse.indices_type != ComponentType::U16 &&
        sparse.indices_type != ComponentType::U32) {
        refuse_damage("{}.componentType: indices are unsigned whole numbers", indices.path());
    }
    const JsonPlace values = place.at("values");
    sparse.values_view = values.at("bufferView").index_into(model.views.size());
    sparse.values_offset = values.whole_or("byteOffset", 0);
    return sparse;
}

/// `count` elements of `size` bytes, `stride` apart, from `offset` on, must lie inside the view.
void check_elements(const std::string& place, const GltfModel& model, std::size_t view, std::uint64_t offset,
                    std::uint64_t stride, std::uint64_t size, std::uint64_t count) {
    const std::uint64_t available = model.views[view].byte_length;
    if (offset > available || size > available - offset ||
        (count - 1) > (available - offset - size) / stride) {
        refuse_contradiction(
            "{}: {} elements of {} bytes, {} apart, from byte {} do not fit into bufferViews[{}], which "
            "has {}",
            place, count, size, stride, offset, view, available);
    }
}

GltfAccessor accessor_from(const JsonPlace& place, const GltfModel& model) {
    using namespace std::string_view_literals;
    constexpr std::array types = {
        std::pair("SCALAR"sv, std::size_t{1}), std::pair("VEC2"sv, std::size_t{2}),
        std::pair("VEC3"sv, std::size_t{3}),   std::pair("VEC4"sv, std::size_t{4}),
        std::pair("MAT2"sv, std::size_t{4}),   std::pair("MAT3"sv, std::size_t{9}),
        std::pair("MAT4"sv, std::size_t{16}),
    };
    GltfAccessor accessor;
    accessor.type = component_type_from(place.at("componentType"));
    accessor.components = named(place.at("type"), types);
    accessor.normalised = place.truth_or("normalized", false);
    accessor.count = static_cast<std::size_t>(place.at("count").whole(1, std::uint64_t{1} << 32));
    accessor.view = place.index_or_none("bufferView", model.views.size());
    accessor.byte_offset = place.whole_or("byteOffset", 0);
    const std::uint64_t element = size_of(accessor.type) * accessor.components;
    accessor.byte_stride = element;
    if (accessor.view) {
        accessor.byte_stride = model.views[*accessor.view].byte_stride.value_or(element);
        if (accessor.byte_stride < element) {
            refuse_contradiction("{}: its elements have {} bytes, but bufferViews[{}] puts them {} apart",
                                 place.path(), element, *accessor.view, accessor.byte_stride);
        }
        check_elements(place.path(), model, *accessor.view, accessor.byte_offset, accessor.byte_stride,
                       element, accessor.count);
    }
    if (const auto sparse = place.find("sparse")) {
        accessor.sparse = sparse_from(*sparse, model, accessor.count);
        const std::uint64_t index_size = size_of(accessor.sparse->indices_type);
        check_elements(sparse->path() + ".indices", model, accessor.sparse->indices_view,
                       accessor.sparse->indices_offset, index_size, index_size, accessor.sparse->count);
        check_elements(sparse->path() + ".values", model, accessor.sparse->values_view,
                       accessor.sparse->values_offset, element, element, accessor.sparse->count);
    }
    return accessor;
}

GltfDraco draco_from(const JsonPlace& place, const GltfModel& model) {
    GltfDraco draco;
    draco.view = place.at("bufferView").index_into(model.views.size());
    const JsonPlace attributes = place.at("attributes");
    for (const std::string& name : attributes.keys()) {
        draco.attributes.emplace(name, static_cast<std::uint32_t>(attributes.at(name).whole(0, 0xffffffffU)));
    }
    return draco;
}

GltfPrimitive primitive_from(const JsonPlace& place, const GltfModel& model) {
    GltfPrimitive primitive;
    primitive.place = place.path();
    primitive.attributes = attributes_from(place.at("attributes"), model);
    primitive.indices = place.index_or_none("indices", model.accessors.size());
    primitive.material = place.index_or_none("material", model.materials.size());
    primitive.mode = place.whole_or("mode", 4, 6);
    const std::optional<JsonPlace> targets = place.find("targets");
    for (std::size_t i = 0; targets && i < targets->size(); ++i) {
        primitive.targets.push_back(attributes_from((*targets)[i], model));
    }
    if (const auto draco = extension_of(place, "KHR_draco_mesh_compression")) {
        primitive.draco = draco_from(*draco, model);
    }
    return primitive;
}

GltfMesh mesh_from(const JsonPlace& place, const GltfModel& model) {
    GltfMesh mesh;
    const JsonPlace primitives = place.at("primitives");
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        mesh.primitives.push_back(primitive_from(primitives[i], model));
    }
    if (const auto weights = place.find("weights")) {
        mesh.weights = weights->numbers();
    }
    return mesh;
}

GltfBuffer buffer_from(const JsonPlace& place, const GltfModel&) {
    GltfBuffer buffer;
    if (const auto uri = place.find("uri")) {
        buffer.uri = uri->text();
    }
    buffer.byte_length = place.at("byteLength").whole(1);
    if (const auto meshopt = extension_of(place, "EXT_meshopt_compression")) {
        buffer.fallback = meshopt->truth_or("fallback", false);
    }
    return buffer;
}

template <typename Part, typename Reader>
void read_all(const JsonPlace& document, std::string_view key, const GltfModel& model,
              std::vector<Part>& parts, Reader reader) {
    const std::optional<JsonPlace> list = document.find(key);
    for (std::size_t i = 0; list && i < list->size(); ++i) {
        parts.push_back(reader((*list)[i], model));
    }
}

} // namespace

std::optional<JsonPlace> extension_of(const JsonPlace& place, std::string_view name) {
    const std::optional<JsonPlace> extensions = place.find("extensions");
    return extensions ? extensions->find(name) : std::nullopt;
}

std::string gltf_name_of(const JsonPlace& place) {
    try {
        return place.text_or("name", "");
    } catch (const Refusal&) {
        return {};
    }
}

GltfAttributes attributes_from(const JsonPlace& place, const GltfModel& model) {
    GltfAttributes attributes;
    for (const std::string& name : place.keys()) {
        attributes.emplace(name, place.at(name).index_into(model.accessors.size()));
    }
    return attributes;
}

std::size_t size_of(ComponentType type) {
    switch (type) {
    case ComponentType::I8:
    case ComponentType::U8:
        return 1;
    case ComponentType::I16:
    case ComponentType::U16:
        return 2;
    default:
        return 4;
    }
}

GltfModel gltf_model_from(const JsonPlace& document) {
    check_header(document);
    GltfModel model;
    model.quantised = declares(document, "KHR_mesh_quantization");
    // In the order of their references, because each part is checked against what it points to.
    read_all(document, "buffers", model, model.buffers, buffer_from);
    read_all(document, "bufferViews", model, model.views, view_from);
    read_all(document, "accessors", model, model.accessors, accessor_from);
    read_surface(document, model);
    read_all(document, "meshes", model, model.meshes, mesh_from);
    read_nodes(document, model);
    read_animations(document, model);
    model.variants = variants_of(document);
    model.unknown_extensions = unknown_extensions_of(document);
    return model;
}

} // namespace frustumscreen::bake
