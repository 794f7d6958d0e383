#include "assets_baked/bake/loaders/gltf_draco.h"

#include "assets_baked/bake/loaders/draco_counts.h"
#include "assets_baked/bake/loaders/refusal.h"

#include <draco/compression/decode.h>

namespace frustumscreen::bake {

namespace {

/// True for the attributes that the loader uses; normals and tangents stay packed.
bool is_needed(std::string_view name) {
    return name == "POSITION" || name == "COLOR_0" || name.starts_with("TEXCOORD_") ||
           name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_");
}

std::size_t byte_size(draco::DataType type) {
    const int length = draco::DataTypeLength(type);
    return length > 0 ? static_cast<std::size_t>(length) : 0;
}

double number_at(ByteView bytes, std::size_t offset, draco::DataType type, const std::string& place) {
    switch (type) {
    case draco::DT_INT8:
        return load_little<std::int8_t>(bytes, offset);
    case draco::DT_UINT8:
    case draco::DT_BOOL:
        return load_little<std::uint8_t>(bytes, offset);
    case draco::DT_INT16:
        return load_little<std::int16_t>(bytes, offset);
    case draco::DT_UINT16:
        return load_little<std::uint16_t>(bytes, offset);
    case draco::DT_INT32:
        return load_little<std::int32_t>(bytes, offset);
    case draco::DT_UINT32:
        return load_little<std::uint32_t>(bytes, offset);
    case draco::DT_FLOAT32:
        return static_cast<double>(load_little<float>(bytes, offset));
    case draco::DT_FLOAT64:
        return load_little<double>(bytes, offset);
    default:
        refuse_damage("{}: a Draco attribute has a type that glTF does not know", place);
    }
}

DracoNumbers numbers_of(const draco::PointAttribute& attribute, std::size_t points,
                        const std::string& place) {
    const auto components = static_cast<std::size_t>(attribute.num_components());
    const draco::DataType type = attribute.data_type();
    const std::size_t component_size = byte_size(type);
    if (components == 0 || attribute.buffer() == nullptr ||
        (!attribute.is_mapping_identity() && attribute.indices_map_size() < points)) {
        refuse_damage("{}: an attribute of the Draco stream lacks values", place);
    }
    const ByteView bytes(reinterpret_cast<const std::byte*>(attribute.buffer()->data()),
                         attribute.buffer()->data_size());
    std::vector<double> numbers;
    numbers.reserve(points * components);
    for (std::size_t point = 0; point < points; ++point) {
        const draco::AttributeValueIndex row =
            attribute.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(point)));
        const auto offset = static_cast<std::size_t>(attribute.GetBytePos(row));
        for (std::size_t component = 0; component < components; ++component) {
            numbers.push_back(
                number_at(bytes, offset + component * component_size, type, place)); // checks range
        }
    }
    return {std::make_shared<const std::vector<double>>(std::move(numbers)), components};
}

} // namespace

DracoMesh decode_draco(ByteView stream, const GltfDraco& draco, const std::string& place) {
    check_draco_stream(stream, place);
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
    auto decoded = draco::Decoder().DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) {
        refuse_damage("{}: Draco stream: {}", place, decoded.status().error_msg());
    }
    const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();

    DracoMesh result;
    result.points = mesh->num_points();
    result.triangles.reserve(mesh->num_faces());
    for (draco::FaceIndex face(0); face < mesh->num_faces(); ++face) {
        const draco::Mesh::Face& corners = mesh->face(face);
        for (const draco::PointIndex& corner : corners) {
            if (corner.value() >= result.points) {
                refuse_contradiction("{}: in the Draco stream face {} uses vertex {} of {}", place,
                                     face.value(), corner.value(), result.points);
            }
        }
        result.triangles.push_back({corners[0].value(), corners[1].value(), corners[2].value()});
    }
    for (const auto& [name, id] : draco.attributes) {
        const draco::PointAttribute* attribute = mesh->GetAttributeByUniqueId(id);
        if (attribute == nullptr) {
            refuse_contradiction("{}: the Draco stream has no attribute {} for {}", place, id,
                                 name.substr(0, 40));
        }
        if (is_needed(name)) {
            result.attributes.emplace(name, numbers_of(*attribute, result.points, place));
        }
    }
    return result;
}

} // namespace frustumscreen::bake
