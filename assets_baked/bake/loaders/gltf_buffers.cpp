#include "assets_baked/bake/loaders/gltf_buffers.h"

#include "assets_baked/bake/loaders/refusal.h"

#include <meshoptimizer.h>

namespace frustumscreen::bake {

namespace {

int base64_digit(char c) {
    if (c >= 'A' && c <= 'Z') {
        return c - 'A';
    }
    if (c >= 'a' && c <= 'z') {
        return c - 'a' + 26;
    }
    if (c >= '0' && c <= '9') {
        return c - '0' + 52;
    }
    return c == '+' ? 62 : (c == '/' ? 63 : -1);
}

Bytes base64_decoded(std::string_view text, std::string_view place) {
    while (text.ends_with('=')) {
        text.remove_suffix(1);
    }
    Bytes bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int held = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const int digit = base64_digit(text[i]);
        if (digit < 0) {
            refuse_damage("{}: the data URI is damaged at its base64 character {}", place, i);
        }
        bits = (bits << 6U) | static_cast<std::uint32_t>(digit);
        held += 6;
        if (held >= 8) {
            held -= 8;
            bytes.push_back(static_cast<std::byte>((bits >> static_cast<unsigned>(held)) & 0xffU));
        }
    }
    return bytes;
}

/// The decoder needs its output allocated first, so a count must be one that the packed bytes can hold: a
/// vertex block uses at least four header bytes for each byte of a vertex and 256 vertices; index data use at
/// least a byte for each triangle or index.
bool is_plausible(const GltfMeshopt& meshopt) {
    const std::uint64_t packed = meshopt.byte_length;
    switch (meshopt.mode) {
    case MeshoptMode::Attributes:
        return meshopt.count <= packed * 64 / meshopt.byte_stride + 256;
    case MeshoptMode::Triangles:
        return meshopt.count / 3 <= packed;
    default:
        return meshopt.count <= packed;
    }
}

/// Checks the conditions that the decoder and the filters assert.
void check_form(const GltfMeshopt& meshopt, const std::string& place) {
    const std::size_t stride = meshopt.byte_stride;
    const bool attributes = meshopt.mode == MeshoptMode::Attributes;
    if (attributes ? stride % 4 != 0 : (stride != 2 && stride != 4)) {
        refuse_contradiction("{}.byteStride: {} is not allowed in this mode", place, stride);
    }
    if (meshopt.mode == MeshoptMode::Triangles && meshopt.count % 3 != 0) {
        refuse_contradiction("{}.count: {} is not a multiple of 3", place, meshopt.count);
    }
    const bool filter_fits = meshopt.filter == MeshoptFilter::None ||
                             (attributes && (meshopt.filter == MeshoptFilter::Exponential || stride == 8 ||
                                             (meshopt.filter == MeshoptFilter::Octahedral && stride == 4)));
    if (!filter_fits) {
        refuse_contradiction("{}.filter: does not go with a stride of {} in this mode", place, stride);
    }
    if (!is_plausible(meshopt)) {
        refuse_contradiction("{}.count: {} elements cannot be packed into {} bytes", place, meshopt.count,
                             meshopt.byte_length);
    }
}

int decode(const GltfMeshopt& meshopt, ByteView packed, Bytes& out) {
    const auto* data = reinterpret_cast<const unsigned char*>(packed.data());
    switch (meshopt.mode) {
    case MeshoptMode::Attributes:
        return meshopt_decodeVertexBuffer(out.data(), meshopt.count, meshopt.byte_stride, data,
                                          packed.size());
    case MeshoptMode::Triangles:
        return meshopt_decodeIndexBuffer(out.data(), meshopt.count, meshopt.byte_stride, data, packed.size());
    default:
        return meshopt_decodeIndexSequence(out.data(), meshopt.count, meshopt.byte_stride, data,
                                           packed.size());
    }
}

void filter(const GltfMeshopt& meshopt, Bytes& out) {
    switch (meshopt.filter) {
    case MeshoptFilter::None:
        break;
    case MeshoptFilter::Octahedral:
        meshopt_decodeFilterOct(out.data(), meshopt.count, meshopt.byte_stride);
        break;
    case MeshoptFilter::Quaternion:
        meshopt_decodeFilterQuat(out.data(), meshopt.count, meshopt.byte_stride);
        break;
    case MeshoptFilter::Exponential:
        meshopt_decodeFilterExp(out.data(), meshopt.count, meshopt.byte_stride);
        break;
    }
}

} // namespace

double number_at(ByteView bytes, std::size_t offset, ComponentType type) {
    switch (type) {
    case ComponentType::I8:
        return load_little<std::int8_t>(bytes, offset);
    case ComponentType::U8:
        return load_little<std::uint8_t>(bytes, offset);
    case ComponentType::I16:
        return load_little<std::int16_t>(bytes, offset);
    case ComponentType::U16:
        return load_little<std::uint16_t>(bytes, offset);
    case ComponentType::U32:
        return load_little<std::uint32_t>(bytes, offset);
    default:
        return static_cast<double>(load_little<float>(bytes, offset));
    }
}

std::optional<Bytes> bytes_of_data_uri(std::string_view uri, std::string_view place) {
    if (!uri.starts_with("data:")) {
        return std::nullopt;
    }
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64")) {
        refuse_damage("{}: the data URI is not base64", place);
    }
    return base64_decoded(uri.substr(comma + 1), place);
}

GltfBuffers::GltfBuffers(const GltfModel& model, Sidecars& sidecars, std::optional<ByteView> binary_chunk)
    : model_(model) {
    for (std::size_t i = 0; i < model.buffers.size(); ++i) {
        const GltfBuffer& buffer = model.buffers[i];
        const std::string place = fmt::format("buffers[{}]", i);
        std::optional<ByteView> bytes;
        if (buffer.uri) {
            std::optional<Bytes> inside = bytes_of_data_uri(*buffer.uri, place);
            owned_.push_back(inside ? std::make_shared<const Bytes>(*std::move(inside))
                                    : sidecars.read(percent_decoded(*buffer.uri, place), place));
            bytes = *owned_.back();
        } else if (i == 0 && binary_chunk) {
            bytes = binary_chunk;
        } else if (!buffer.fallback) {
            refuse_contradiction("{}: has no data: neither a uri nor a binary chunk of a GLB", place);
        }
        if (bytes && bytes->size() < buffer.byte_length && !buffer.fallback) {
            refuse_cut_short("{}: {} bytes are declared, but there are only {}", place, buffer.byte_length,
                             bytes->size());
        }
        buffers_.push_back(bytes);
        packed_left_ += bytes ? bytes->size() : 0;
    }
}

ByteView GltfBuffers::range(std::size_t buffer, std::uint64_t offset, std::uint64_t length) const {
    const std::optional<ByteView>& bytes = buffers_[buffer];
    if (!bytes || offset > bytes->size() || length > bytes->size() - offset) {
        refuse_contradiction("buffers[{}]: has no data for bytes {} to {}", buffer, offset, offset + length);
    }
    return bytes->subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
}

ByteView GltfBuffers::view(std::size_t index) {
    const GltfBufferView& view = model_.views[index];
    if (!view.meshopt) {
        return range(view.buffer, view.byte_offset, view.byte_length);
    }
    auto known = unpacked_.find(index);
    if (known == unpacked_.end()) {
        known = unpacked_.emplace(index, unpacked(index)).first;
    }
    return known->second;
}

void GltfBuffers::spend_packed(std::uint64_t bytes, const std::string& place) {
    if (bytes > packed_left_) {
        refuse_contradiction("{}: the same packed data are used again and again", place);
    }
    packed_left_ -= bytes;
}

const std::vector<std::uint32_t>& GltfBuffers::sparse_elements(std::size_t accessor) {
    const auto [known, is_new] = sparse_elements_.try_emplace(accessor);
    std::vector<std::uint32_t>& elements = known->second;
    if (!is_new) {
        return elements;
    }
    const GltfSparse& sparse = *model_.accessors[accessor].sparse;
    const ByteView bytes = view(sparse.indices_view).subspan(static_cast<std::size_t>(sparse.indices_offset));
    const std::size_t count = model_.accessors[accessor].count;
    for (std::size_t i = 0; i < sparse.count; ++i) {
        const double element = number_at(bytes, i * size_of(sparse.indices_type), sparse.indices_type);
        if (element >= static_cast<double>(count) || (i > 0 && element <= elements.back())) {
            refuse_contradiction(
                "accessors[{}].sparse.indices: element {} is {}; ascending numbers below {} are allowed",
                accessor, i, element, count);
        }
        elements.push_back(static_cast<std::uint32_t>(element));
    }
    return elements;
}

Bytes GltfBuffers::unpacked(std::size_t view) {
    const GltfMeshopt& meshopt = *model_.views[view].meshopt;
    const std::string place = fmt::format("bufferViews[{}].extensions.EXT_meshopt_compression", view);
    check_form(meshopt, place);
    const ByteView packed = range(meshopt.buffer, meshopt.byte_offset, meshopt.byte_length);
    spend_packed(meshopt.byte_length, place);
    Bytes out(meshopt.count * meshopt.byte_stride);
    if (out.size() < model_.views[view].byte_length) {
        refuse_contradiction("{}: unpacks to {} bytes, but the view has {}", place, out.size(),
                             model_.views[view].byte_length);
    }
    if (decode(meshopt, packed, out) != 0) {
        refuse_damage("{}: the packed data are damaged", place);
    }
    filter(meshopt, out);
    return out;
}

} // namespace frustumscreen::bake
