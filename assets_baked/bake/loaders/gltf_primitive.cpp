#include "assets_baked/bake/loaders/gltf_primitive.h"

#include "assets_baked/bake/loaders/refusal.h"

#include <algorithm>

namespace frustumscreen {

namespace {

constexpr std::uint64_t mode_triangles = 4;
constexpr std::uint64_t mode_strip = 5;
constexpr std::uint64_t mode_fan = 6;
/// Largest size of an array without data. A sparse accessor may replace some of its zeros; genuine ones are smaller.
constexpr std::size_t max_positions_without_data = std::size_t{1} << 20U;

bool is_small_integer(ComponentType type) {
    return type != ComponentType::F32 && type != ComponentType::U32;
}
bool is_small_unsigned(ComponentType type) {
    return type == ComponentType::U8 || type == ComponentType::U16;
}

void expect(const GltfPrimitive& primitive, const char* name, const GltfAttribute& attribute, bool fits,
            const char* allowed) {
    if (!fits) {
        refuse_contradiction("{}.attributes.{}: {} does not have the form of {}", primitive.place, name,
                             attribute.place(), allowed);
    }
}

void check_position(const GltfPrimitive& primitive, const GltfAttribute& position, bool quantised) {
    const bool fits = position.components() == 3 && (position.type() == ComponentType::F32 ||
                                                     (quantised && is_small_integer(position.type())));
    expect(primitive, "POSITION", position, fits,
           quantised ? "three floats or small integers"
                     : "three floats (integers need KHR_mesh_quantization in extensionsUsed)");
    if (!position.has_data() && position.count() > max_positions_without_data) {
        refuse_contradiction("{}.attributes.POSITION: {} declares {} positions without data", primitive.place,
                             position.place(), position.count());
    }
}

void check_uv(const GltfPrimitive& primitive, const GltfAttribute& uv, bool quantised) {
    const bool fits = uv.components() == 2 &&
                      (uv.type() == ComponentType::F32 || (is_small_unsigned(uv.type()) && uv.normalised()) ||
                       (quantised && is_small_integer(uv.type())));
    expect(primitive, "TEXCOORD", uv, fits, "two floats or normalised integers");
}

void check_colour(const GltfPrimitive& primitive, const GltfAttribute& colour) {
    const bool fits = (colour.components() == 3 || colour.components() == 4) &&
                      (colour.type() == ComponentType::F32 || is_small_unsigned(colour.type()));
    expect(primitive, "COLOR_0", colour, fits, "three or four floats or normalised integers");
}

/// Corner numbers of triangle `i` (glTF 2.0, 3.7.2.1).
std::array<std::size_t, 3> corners_of(std::uint64_t mode, std::size_t i) {
    switch (mode) {
    case mode_strip:
        return {i, i + 1 + i % 2, i + 2 - i % 2};
    case mode_fan:
        return {i + 1, i + 2, 0};
    default:
        return {3 * i, 3 * i + 1, 3 * i + 2};
    }
}

std::size_t triangles_in(std::uint64_t mode, std::size_t corners) {
    return mode == mode_triangles ? corners / 3 : (corners < 3 ? 0 : corners - 2);
}

} // namespace

/// The arrays of one primitive, all of the same length except the indices.
struct GltfPrimitives::Streams {
    std::string place;
    std::string vertex_place; ///< for messages about one vertex
    std::uint64_t mode = mode_triangles;
    std::optional<GltfAttribute> position;
    std::optional<GltfAttribute> uv;
    std::optional<GltfTextureUse> texture;
    std::optional<GltfAttribute> colour;
    std::optional<GltfAttribute> normal; ///< none where a morph target bends the surface
    std::vector<std::pair<GltfAttribute, GltfAttribute>> joints_and_weights;
    std::vector<std::pair<double, GltfAttribute>> morphs;
    std::optional<GltfAttribute> indices;
    const DracoMesh* draco = nullptr;

    [[nodiscard]] std::size_t corner_count() const {
        return draco != nullptr ? draco->triangles.size() * 3
                                : (indices ? indices->count() : position->count());
    }
};

const DracoMesh* GltfPrimitives::draco_mesh(const GltfPrimitive& primitive) {
    if (!primitive.draco) {
        return nullptr;
    }
    const GltfDraco& draco = *primitive.draco;
    const auto key = std::pair(draco.view, draco.attributes);
    auto known = draco_.find(key);
    if (known == draco_.end()) {
        const std::string place = primitive.place + ".extensions.KHR_draco_mesh_compression";
        const ByteView stream = buffers_.view(draco.view);
        buffers_.spend_packed(stream.size(), place);
        known = draco_.emplace(key, decode_draco(stream, draco, place)).first;
    }
    return &known->second;
}

std::optional<GltfAttribute> GltfPrimitives::attribute(const GltfPrimitive& primitive,
                                                       const std::string& name, const Streams& streams) {
    const auto accessor = primitive.attributes.find(name);
    if (accessor == primitive.attributes.end()) {
        return std::nullopt;
    }
    std::optional<GltfAttribute> found;
    if (streams.draco != nullptr && streams.draco->attributes.contains(name)) {
        const DracoNumbers& unpacked = streams.draco->attributes.find(name)->second;
        found.emplace(model_, accessor->second, unpacked.numbers, unpacked.components);
    } else {
        found.emplace(model_, buffers_, accessor->second);
    }
    if (streams.position && found->count() != streams.position->count()) {
        refuse_contradiction("{}.attributes.{}: {} elements, but POSITION has {}", primitive.place, name,
                             found->count(), streams.position->count());
    }
    return found;
}

GltfPrimitives::Streams GltfPrimitives::streams_of(const GltfPrimitive& primitive,
                                                   const GltfPlacement& placement) {
    Streams streams;
    streams.place = primitive.place;
    streams.vertex_place = primitive.place + ", vertex";
    streams.draco = draco_mesh(primitive);
    streams.mode = streams.draco != nullptr ? mode_triangles : primitive.mode;
    streams.position = attribute(primitive, "POSITION", streams);
    if (!streams.position) {
        return streams;
    }
    check_position(primitive, *streams.position, model_.quantised);
    if (primitive.indices && streams.draco == nullptr) {
        streams.indices.emplace(model_, buffers_, *primitive.indices);
        const bool fits =
            streams.indices->components() == 1 &&
            (is_small_unsigned(streams.indices->type()) || streams.indices->type() == ComponentType::U32);
        expect(primitive, "indices", *streams.indices, fits, "unsigned whole numbers");
    }
    if (primitive.material) {
        streams.texture = model_.materials[*primitive.material].texture;
    }
    if (streams.texture) {
        streams.uv = attribute(primitive, fmt::format("TEXCOORD_{}", streams.texture->uv_set), streams);
        if (streams.uv) {
            check_uv(primitive, *streams.uv, model_.quantised);
        }
    }
    streams.colour = attribute(primitive, "COLOR_0", streams);
    if (streams.colour) {
        check_colour(primitive, *streams.colour);
        streams.colour->normalise();
    }
    add_morphs(primitive, placement, streams);
    if (streams.morphs.empty()) {
        streams.normal = normals(primitive, streams);
    }
    if (!placement.scene_from_mesh_by_joint.empty()) {
        add_skin(primitive, streams);
    }
    return streams;
}

std::optional<GltfAttribute> GltfPrimitives::normals(const GltfPrimitive& primitive, const Streams& streams) {
    try {
        std::optional<GltfAttribute> found = attribute(primitive, "NORMAL", streams);
        const bool is_direction = found && found->components() == 3 && found->has_data();
        return is_direction ? std::move(found) : std::nullopt;
    } catch (const Refusal&) {
        return std::nullopt;
    }
}

void GltfPrimitives::add_morphs(const GltfPrimitive& primitive, const GltfPlacement& placement,
                                Streams& streams) {
    const std::size_t count = std::min(primitive.targets.size(), placement.morph_weights.size());
    for (std::size_t i = 0; i < count; ++i) {
        const auto accessor = primitive.targets[i].find("POSITION");
        if (placement.morph_weights[i] == 0.0 || accessor == primitive.targets[i].end()) {
            continue;
        }
        GltfAttribute shift(model_, buffers_, accessor->second);
        check_position(primitive, shift, model_.quantised);
        if (shift.count() != streams.position->count()) {
            refuse_contradiction("{}.targets[{}].POSITION: {} elements, but the primitive has {}",
                                 primitive.place, i, shift.count(), streams.position->count());
        }
        streams.morphs.emplace_back(placement.morph_weights[i], std::move(shift));
    }
}

void GltfPrimitives::add_skin(const GltfPrimitive& primitive, Streams& streams) {
    for (int set = 0;; ++set) {
        std::optional<GltfAttribute> joints = attribute(primitive, fmt::format("JOINTS_{}", set), streams);
        std::optional<GltfAttribute> weights = attribute(primitive, fmt::format("WEIGHTS_{}", set), streams);
        if (!joints || !weights) {
            return;
        }
        expect(primitive, "JOINTS", *joints, joints->components() == 4 && is_small_unsigned(joints->type()),
               "four small whole numbers");
        expect(primitive, "WEIGHTS", *weights,
               weights->components() == 4 &&
                   (weights->type() == ComponentType::F32 || is_small_unsigned(weights->type())),
               "four floats or normalised integers");
        weights->normalise();
        streams.joints_and_weights.emplace_back(*std::move(joints), *std::move(weights));
    }
}

void GltfPrimitives::begin_vertices(std::size_t count) {
    if (drawn_in_.size() < count) {
        drawn_in_.resize(count, 0);
        vertex_of_.resize(count, 0);
    }
    ++drawing_;
}

std::uint32_t GltfPrimitives::corner(const Streams& streams, std::size_t i) const {
    if (streams.draco != nullptr) {
        return streams.draco->triangles[i / 3][i % 3];
    }
    const std::uint32_t element = streams.indices ? streams.indices->whole(i) : static_cast<std::uint32_t>(i);
    if (element >= streams.position->count()) {
        refuse_contradiction("{}.indices: element {} is {}, but POSITION has {} vertices", streams.place, i,
                             element, streams.position->count());
    }
    return element;
}

namespace {

/// The weighted mean of the joints' transforms at one vertex. Weights are scaled to add up to 1.
glm::dmat4 blended(const std::vector<std::pair<GltfAttribute, GltfAttribute>>& joints_and_weights,
                   std::span<const glm::dmat4> transforms, std::uint32_t element, const std::string& place) {
    glm::dmat4 sum(0.0);
    double total = 0.0;
    for (const auto& [joints, weights] : joints_and_weights) {
        for (std::size_t i = 0; i < 4; ++i) {
            const double weight = weights.value(element, i);
            const std::uint32_t joint = joints.whole(element, i);
            if (weight <= 0.0) {
                continue;
            }
            if (joint >= transforms.size()) {
                refuse_contradiction("{}: vertex {} hangs on joint {}, but the skin has {}", place, element,
                                     joint, transforms.size());
            }
            sum += weight * transforms[joint];
            total += weight;
        }
    }
    return total > 0.0 ? sum / total : transforms.front();
}

/// The normal in the scene, of any length; zero if it cannot be read.
glm::dvec3 normal_in_scene(const GltfAttribute& normal, std::uint32_t element, const glm::dmat4& transform) {
    try {
        const glm::dmat3 linear(transform);
        return glm::determinant(linear) == 0.0 ? glm::dvec3(0.0)
                                               : glm::transpose(glm::inverse(linear)) * normal.vec3(element);
    } catch (const Refusal&) {
        return glm::dvec3(0.0);
    }
}

} // namespace

std::uint32_t GltfPrimitives::vertex(const Streams& streams, const GltfPlacement& placement,
                                     std::uint32_t element) {
    if (drawn_in_[element] == drawing_) {
        return vertex_of_[element];
    }
    glm::dvec3 position = streams.position->vec3(element);
    for (const auto& [weight, shift] : streams.morphs) {
        position += weight * shift.vec3(element);
    }
    const glm::dmat4 transform =
        streams.joints_and_weights.empty()
            ? placement.scene_from_mesh
            : blended(streams.joints_and_weights, placement.scene_from_mesh_by_joint, element, streams.place);
    const std::uint32_t added = mesh_.add_vertex(glm::dvec3(transform * glm::dvec4(position, 1.0)),
                                                 streams.vertex_place.c_str(), element);
    if (streams.uv) {
        mesh_.set_uv(streams.texture->transformed(streams.uv->vec2(element)));
    }
    if (streams.colour) {
        const bool has_alpha = streams.colour->components() == 4;
        mesh_.set_colour(glm::vec4(glm::vec3(streams.colour->vec3(element)),
                                   has_alpha ? static_cast<float>(streams.colour->value(element, 3)) : 1.0F));
    }
    if (streams.normal) {
        mesh_.set_normal(normal_in_scene(*streams.normal, element, transform));
    }
    drawn_in_[element] = drawing_;
    vertex_of_[element] = added;
    return added;
}

void GltfPrimitives::draw_corners(const Streams& streams, const GltfPlacement& placement,
                                  std::uint32_t material) {
    // A mirroring node turns counter-clockwise into clockwise (glTF 2.0, 3.7.4).
    const glm::dmat4& transform = streams.joints_and_weights.empty()
                                      ? placement.scene_from_mesh
                                      : placement.scene_from_mesh_by_joint.front();
    const bool mirrored = glm::determinant(glm::dmat3(transform)) < 0.0;
    const std::size_t triangles = triangles_in(streams.mode, streams.corner_count());
    mesh_.expect_triangles(triangles);
    for (std::size_t i = 0; i < triangles; ++i) {
        std::array<std::uint32_t, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = vertex(streams, placement, corner(streams, corners_of(streams.mode, i)[k]));
        }
        mesh_.add_triangle(corners[0], corners[mirrored ? 2 : 1], corners[mirrored ? 1 : 2], material);
    }
}

std::size_t GltfPrimitives::declared_triangles(const GltfPrimitive& primitive) const {
    const auto position = primitive.attributes.find("POSITION");
    if (primitive.mode < mode_triangles || position == primitive.attributes.end()) {
        return 0;
    }
    const std::size_t corners = model_.accessors[primitive.indices.value_or(position->second)].count;
    return triangles_in(primitive.mode, corners);
}

void GltfPrimitives::draw(const GltfPrimitive& primitive, const GltfPlacement& placement) {
    if (primitive.mode < mode_triangles) {
        return;
    }
    const Streams streams = streams_of(primitive, placement);
    if (!streams.position || streams.corner_count() < 3) {
        return;
    }
    begin_vertices(streams.position->count());
    mesh_.expect_vertices(streams.position->count());
    draw_corners(streams, placement, material_of_(primitive.material));
}

} // namespace frustumscreen
