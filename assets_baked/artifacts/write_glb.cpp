#include "assets_baked/artifacts/write_glb.h"

#include "firmware_host/base/json.h"
#include "firmware_host/base/version.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <map>
#include <string>

namespace frustumscreen::artifacts {
namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little,
              "glTF is little-endian, and so are the copies below");

// Constants of the specification.
constexpr int type_float = 5126;
constexpr int type_unsigned = 5125;
constexpr int target_vertices = 34962;
constexpr int target_indices = 34963;

class Writer {
public:
    explicit Writer(const bake::SourceMesh& mesh) : mesh_(mesh) {}

    Bytes write() {
        document_ = Json::object();
        document_["asset"] = {{"version", "2.0"}, {"generator", name_and_version("FrustumScreen")}};
        document_["scene"] = 0;
        document_["scenes"] = {{{"nodes", {0}}}};
        document_["nodes"] = {{{"mesh", 0}}};
        write_primitives(write_vertices());
        write_materials();
        write_textures();
        document_["buffers"] = {{{"byteLength", binary_.size()}}};
        return container();
    }

private:
    template <typename Value> void append(const Value& value) {
        const std::size_t at = binary_.size();
        binary_.resize(at + sizeof(Value));
        std::memcpy(binary_.data() + at, &value, sizeof(Value));
    }

    int close_view(std::size_t first, int target) {
        Json view = {{"buffer", 0}, {"byteOffset", first}, {"byteLength", binary_.size() - first}};
        if (target != 0) {
            view["target"] = target;
        }
        binary_.resize((binary_.size() + 3) / 4 * 4);
        document_["bufferViews"].push_back(view);
        return static_cast<int>(document_["bufferViews"].size()) - 1;
    }

    int accessor(std::size_t first, int target, int component, const char* type, std::size_t count) {
        const int view = close_view(first, target);
        document_["accessors"].push_back(
            {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
        return static_cast<int>(document_["accessors"].size()) - 1;
    }

    template <typename Vector> int attribute(const std::vector<Vector>& values, const char* type) {
        const std::size_t first = binary_.size();
        binary_.reserve(first + values.size() * sizeof(Vector));
        for (const Vector& value : values) {
            append(value);
        }
        return accessor(first, target_vertices, type_float, type, values.size());
    }

    Json write_vertices() {
        std::vector<glm::vec3> positions;
        positions.reserve(mesh_.positions.size());
        glm::vec3 low{std::numeric_limits<float>::max()};
        glm::vec3 high{std::numeric_limits<float>::lowest()};
        for (const glm::dvec3& position : mesh_.positions) {
            positions.emplace_back(position);
            low = glm::min(low, positions.back());
            high = glm::max(high, positions.back());
        }
        Json attributes;
        const int position = attribute(positions, "VEC3");
        document_["accessors"][static_cast<std::size_t>(position)]["min"] = {low.x, low.y, low.z};
        document_["accessors"][static_cast<std::size_t>(position)]["max"] = {high.x, high.y, high.z};
        attributes["POSITION"] = position;
        if (!mesh_.uvs.empty()) {
            attributes["TEXCOORD_0"] = attribute(mesh_.uvs, "VEC2");
        }
        if (!mesh_.colours.empty()) {
            attributes["COLOR_0"] = attribute(mesh_.colours, "VEC4");
        }
        return attributes;
    }

    /// One primitive for each material with triangles; all share the vertices.
    void write_primitives(const Json& attributes) {
        Json primitives = Json::array();
        for (std::uint32_t material = 0; material < mesh_.materials.size(); ++material) {
            const std::size_t first = binary_.size();
            for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
                if (mesh_.triangle_materials[i] == material) {
                    append(mesh_.triangles[i]);
                }
            }
            const std::size_t count = (binary_.size() - first) / sizeof(std::uint32_t);
            if (count > 0) {
                const int indices = accessor(first, target_indices, type_unsigned, "SCALAR", count);
                primitives.push_back(
                    {{"attributes", attributes}, {"indices", indices}, {"material", material}});
            }
        }
        document_["meshes"] = {{{"primitives", primitives}}};
    }

    void write_materials() {
        for (const bake::SourceMaterial& material : mesh_.materials) {
            const glm::vec4& colour = material.base_colour;
            Json surface = {{"baseColorFactor", {colour.r, colour.g, colour.b, colour.a}},
                            {"metallicFactor", 0.0},
                            {"roughnessFactor", 0.8}};
            if (material.texture >= 0) {
                surface["baseColorTexture"] = {{"index", material.texture}};
            }
            Json entry = {{"pbrMetallicRoughness", surface}, {"doubleSided", true}};
            if (material.alpha_mask) {
                entry["alphaMode"] = "MASK";
                entry["alphaCutoff"] = material.alpha_cutoff;
            }
            document_["materials"].push_back(entry);
        }
    }

    void write_textures() {
        const auto wrap = [](bake::Wrap mode) {
            return mode == bake::Wrap::Repeat ? 10497 : mode == bake::Wrap::Mirror ? 33648 : 33071;
        };
        std::map<const image::Image8*, std::size_t> images;
        for (const bake::SourceTexture& texture : mesh_.textures) {
            const auto [image, is_new] = images.try_emplace(texture.image.get(), images.size());
            if (is_new) {
                const std::size_t first = binary_.size();
                const Bytes png = image::encode_png(*texture.image);
                binary_.insert(binary_.end(), png.begin(), png.end());
                document_["images"].push_back(
                    {{"bufferView", close_view(first, 0)}, {"mimeType", "image/png"}});
            }
            document_["textures"].push_back(
                {{"source", image->second}, {"sampler", document_["samplers"].size()}});
            document_["samplers"].push_back(
                {{"wrapS", wrap(texture.wrap_u)}, {"wrapT", wrap(texture.wrap_v)}});
        }
    }

    /// Header, JSON chunk padded with spaces, binary chunk padded with zeros. Empty if it is too long.
    Bytes container() {
        std::string json = document_.dump();
        json.resize((json.size() + 3) / 4 * 4, ' ');
        const std::uint64_t total = 12 + 8 + json.size() + 8 + binary_.size();
        if (total > std::numeric_limits<std::uint32_t>::max()) {
            return {};
        }
        Bytes head(20 + json.size() + 8);
        const auto put = [&head](std::size_t at, std::uint64_t value) {
            const auto word = static_cast<std::uint32_t>(value);
            std::memcpy(head.data() + at, &word, sizeof(word));
        };
        put(0, 0x46546C67); // "glTF"
        put(4, 2);
        put(8, total);
        put(12, json.size());
        put(16, 0x4E4F534A); // "JSON"
        std::memcpy(head.data() + 20, json.data(), json.size());
        put(20 + json.size(), binary_.size());
        put(24 + json.size(), 0x004E4942); // "BIN"
        binary_.insert(binary_.begin(), head.begin(), head.end());
        return std::move(binary_);
    }

    const bake::SourceMesh& mesh_;
    Json document_;
    Bytes binary_;
};

} // namespace

Result<Bytes> write_glb(const bake::SourceMesh& mesh) {
    Bytes bytes = Writer(mesh).write();
    if (bytes.empty()) {
        return bad_input("artifact.too_large",
                         "the mesh is too large for a GLB file, which ends at 4 GiB; take fewer triangles");
    }
    return bytes;
}

} // namespace frustumscreen::artifacts
