/// The bytes behind a glTF document: GLB chunk, data URIs, files beside it, and buffer views unpacked from
/// EXT_meshopt_compression.
///
/// Lifetime  views stay valid as long as the GltfBuffers.
/// Errors    throws Refusal: missing or short data, a damaged stream.
#pragma once

#include "assets_baked/bake/loaders/bytes.h"
#include "assets_baked/bake/loaders/gltf_model.h"
#include "assets_baked/bake/loaders/sidecar.h"

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace frustumscreen::bake {

class GltfBuffers {
public:
    GltfBuffers(const GltfModel& model, Sidecars& sidecars, std::optional<ByteView> binary_chunk);

    /// At least as many bytes as the view declares.
    [[nodiscard]] ByteView view(std::size_t index);
    /// Elements that a sparse accessor replaces, ascending.
    [[nodiscard]] const std::vector<std::uint32_t>& sparse_elements(std::size_t accessor);
    /// Call this before `bytes` packed bytes are unpacked. The budget allows each packed byte once, so that a file
    /// cannot have the same bytes unpacked again and again.
    void spend_packed(std::uint64_t bytes, const std::string& place);

private:
    [[nodiscard]] ByteView range(std::size_t buffer, std::uint64_t offset, std::uint64_t length) const;
    [[nodiscard]] Bytes unpacked(std::size_t view);

    const GltfModel& model_;
    std::vector<std::shared_ptr<const Bytes>> owned_;
    std::vector<std::optional<ByteView>> buffers_;
    std::map<std::size_t, Bytes> unpacked_;
    std::map<std::size_t, std::vector<std::uint32_t>> sparse_elements_;
    std::uint64_t packed_left_ = 0;
};

/// A component of an accessor as stored.
[[nodiscard]] double number_at(ByteView bytes, std::size_t offset, ComponentType type);

/// Bytes of a `data:` URI (RFC 2397, base64 only); nothing if the URI is of another kind.
[[nodiscard]] std::optional<Bytes> bytes_of_data_uri(std::string_view uri, std::string_view place);

} // namespace frustumscreen::bake
