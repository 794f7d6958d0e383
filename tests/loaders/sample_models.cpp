#include "tests/loaders/sample_models.h"

#include "tests/loaders/loaders_testing.h"
#include "tests/loaders/sample_pictures.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <fmt/format.h>
#include <meshoptimizer.h>

namespace frustumscreen::testing {

std::vector<float> grid_positions(int n) {
    std::vector<float> positions;
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            const float x = static_cast<float>(i) / static_cast<float>(n);
            const float y = static_cast<float>(j) / static_cast<float>(n);
            positions.insert(positions.end(), {x, y, x * x + y * y});
        }
    }
    return positions;
}

std::vector<unsigned int> grid_indices(int n) {
    std::vector<unsigned int> indices;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const auto a = static_cast<unsigned>(j * (n + 1) + i);
            const auto below = a + static_cast<unsigned>(n) + 1;
            indices.insert(indices.end(), {a, a + 1, below, a + 1, below + 1, below});
        }
    }
    return indices;
}

std::string draco_glb(int n, bool edge_breaker) {
    const std::vector<float> positions = grid_positions(n);
    const std::vector<unsigned int> indices = grid_indices(n);
    draco::TriangleSoupMeshBuilder builder;
    const auto faces = static_cast<std::uint32_t>(indices.size() / 3);
    builder.Start(static_cast<int>(faces));
    const int id = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    for (std::uint32_t face = 0; face < faces; ++face) {
        builder.SetAttributeValuesForFace(id, draco::FaceIndex(face), &positions[indices[face * 3] * 3],
                                          &positions[indices[face * 3 + 1] * 3],
                                          &positions[indices[face * 3 + 2] * 3]);
    }
    const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 12);
    encoder.SetEncodingMethod(edge_breaker ? draco::MESH_EDGEBREAKER_ENCODING
                                           : draco::MESH_SEQUENTIAL_ENCODING);
    draco::EncoderBuffer buffer;
    if (!encoder.EncodeMeshToBuffer(*mesh, &buffer).ok()) {
        return {};
    }
    const std::string packed(buffer.data(), buffer.size());
    const std::string json = fmt::format(
        R"({{"asset":{{"version":"2.0"}},"extensionsRequired":["KHR_draco_mesh_compression"],)"
        R"("buffers":[{{"byteLength":{0}}}],"bufferViews":[{{"buffer":0,"byteLength":{0}}}],)"
        R"("accessors":[{{"componentType":5126,"type":"VEC3","count":{1}}},{{"componentType":5125,"type":"SCALAR","count":{2}}}],)"
        R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"extensions":)"
        R"({{"KHR_draco_mesh_compression":{{"bufferView":0,"attributes":{{"POSITION":{3}}}}}}}}}]}}],)"
        R"("nodes":[{{"mesh":0}}],"scenes":[{{"nodes":[0]}}]}})",
        packed.size(), mesh->num_points(), indices.size(), mesh->attribute(id)->unique_id());
    return glb_bytes(json, packed);
}

std::string meshopt_glb(int n) {
    const std::vector<float> positions = grid_positions(n);
    const std::vector<unsigned int> indices = grid_indices(n);
    const std::size_t count = positions.size() / 3;

    std::vector<std::uint32_t> filtered(positions.size());
    meshopt_encodeFilterExp(filtered.data(), count, 12, 20, positions.data());
    std::vector<unsigned char> vertices(meshopt_encodeVertexBufferBound(count, 12));
    vertices.resize(meshopt_encodeVertexBuffer(vertices.data(), vertices.size(), filtered.data(), count, 12));
    std::vector<unsigned char> triangles(meshopt_encodeIndexBufferBound(indices.size(), count));
    triangles.resize(
        meshopt_encodeIndexBuffer(triangles.data(), triangles.size(), indices.data(), indices.size()));

    std::string packed = bytes_of(vertices);
    packed.resize((packed.size() + 3) / 4 * 4, '\0');
    const std::size_t second = packed.size();
    packed += bytes_of(triangles);
    const std::string json = fmt::format(
        R"({{"asset":{{"version":"2.0"}},"extensionsRequired":["EXT_meshopt_compression"],"buffers":[{{"byteLength":{0}}},)"
        R"({{"byteLength":{1},"extensions":{{"EXT_meshopt_compression":{{"fallback":true}}}}}}],"bufferViews":[)"
        R"({{"buffer":1,"byteLength":{2},"byteStride":12,"extensions":{{"EXT_meshopt_compression":{{"buffer":0,)"
        R"("byteLength":{3},"byteStride":12,"count":{4},"mode":"ATTRIBUTES","filter":"EXPONENTIAL"}}}}}},)"
        R"({{"buffer":1,"byteOffset":{2},"byteLength":{5},"extensions":{{"EXT_meshopt_compression":{{"buffer":0,)"
        R"("byteOffset":{6},"byteLength":{7},"byteStride":4,"count":{8},"mode":"TRIANGLES"}}}}}}],)"
        R"("accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":{4}}},)"
        R"({{"bufferView":1,"componentType":5125,"type":"SCALAR","count":{8}}}],)"
        R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],"nodes":[{{"mesh":0}}],)"
        R"("scenes":[{{"nodes":[0]}}]}})",
        packed.size(), count * 12 + indices.size() * 4, count * 12, vertices.size(), count,
        indices.size() * 4, second, triangles.size(), indices.size());
    return glb_bytes(json, packed);
}

namespace {

std::string grid_stl(int n) {
    const std::vector<float> positions = grid_positions(n);
    const std::vector<unsigned int> indices = grid_indices(n);
    std::string file(80, ' ');
    file += bytes_of(std::vector{static_cast<std::uint32_t>(indices.size() / 3)});
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        file += std::string(12, '\0');
        for (std::size_t k = 0; k < 3; ++k) {
            const float* p = &positions[indices[i + k] * 3];
            file += bytes_of(std::vector<float>(p, p + 3));
        }
        file += std::string(2, '\0');
    }
    return file;
}

std::string grid_ply(int n, bool text) {
    const std::vector<float> positions = grid_positions(n);
    const std::vector<unsigned int> indices = grid_indices(n);
    std::string file =
        fmt::format("ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
                    "property float z\nelement face {}\nproperty list uchar uint vertex_indices\n"
                    "end_header\n",
                    text ? "ascii" : "binary_little_endian", positions.size() / 3, indices.size() / 3);
    for (std::size_t i = 0; i < positions.size(); i += 3) {
        file += text ? fmt::format("{} {} {}\n", positions[i], positions[i + 1], positions[i + 2])
                     : bytes_of(std::vector{positions[i], positions[i + 1], positions[i + 2]});
    }
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        file += text ? fmt::format("3 {} {} {}\n", indices[i], indices[i + 1], indices[i + 2])
                     : "\3" + bytes_of(std::vector{indices[i], indices[i + 1], indices[i + 2]});
    }
    return file;
}

std::string grid_obj(int n) {
    const std::vector<float> positions = grid_positions(n);
    std::string file = "mtllib none.mtl\n";
    for (std::size_t i = 0; i < positions.size(); i += 3) {
        file += fmt::format("v {} {} {}\nvt {} {}\n", positions[i], positions[i + 1], positions[i + 2],
                            positions[i], positions[i + 1]);
    }
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const int a = j * (n + 1) + i + 1;
            const int below = a + n + 1;
            file += fmt::format("usemtl m{0}\nf {1}/{1} {2}/{2} {3}//{3} -1\n", i % 2, a, a + 1, below + 1);
        }
    }
    return file;
}

std::string grid_stl_text() {
    return "solid s\n facet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 1e-3 0\n "
           "endloop\n"
           " endfacet\nendsolid s\n";
}

/// Every feature of a glTF triangle: two nested nodes, a skin, a morph, a sparse accessor, interleaved and
/// normalised attributes, a texture with a transform.
std::string rich_gltf(const std::string& picture) {
    std::string bytes = bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});     // 0: positions
    bytes += bytes_of(std::vector<std::uint16_t>{0, 0, 65535, 0, 0, 65535, 65535, 65535});    // 48: uvs
    bytes += std::string("\xff\x80\x40\xff", 4) + std::string(12, '\x7f');                    // 64: colours
    bytes += bytes_of(std::vector<std::uint16_t>{0, 1, 2, 3});                                // 80: indices
    bytes += bytes_of(std::vector<std::uint32_t>{3}) + bytes_of(std::vector<float>{2, 2, 0}); // 88: sparse
    bytes += std::string(16, '\0');                                                           // 104: joints
    bytes += bytes_of(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});    // 120: weights
    bytes += bytes_of(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}); // 184: bind matrix
    const std::size_t picture_offset = bytes.size();
    bytes += picture;
    return gltf_text(
        bytes,
        fmt::format(
            R"("extensionsUsed":["KHR_texture_transform"],"bufferViews":[{{"buffer":0,"byteLength":248}},)"
            R"({{"buffer":0,"byteOffset":{0},"byteLength":{1}}}],"accessors":[)"
            R"({{"bufferView":0,"componentType":5126,"type":"VEC3","count":4,"sparse":{{"count":1,"indices":)"
            R"({{"bufferView":0,"byteOffset":88,"componentType":5125}},"values":{{"bufferView":0,"byteOffset":92}}}}}},)"
            R"({{"bufferView":0,"byteOffset":48,"componentType":5123,"normalized":true,"type":"VEC2","count":4}},)"
            R"({{"bufferView":0,"byteOffset":64,"componentType":5121,"normalized":true,"type":"VEC4","count":4}},)"
            R"({{"bufferView":0,"byteOffset":80,"componentType":5123,"type":"SCALAR","count":4}},)"
            R"({{"bufferView":0,"byteOffset":104,"componentType":5121,"type":"VEC4","count":4}},)"
            R"({{"bufferView":0,"byteOffset":120,"componentType":5126,"type":"VEC4","count":4}},)"
            R"({{"bufferView":0,"byteOffset":184,"componentType":5126,"type":"MAT4","count":1}}],)"
            R"("images":[{{"bufferView":1}}],"samplers":[{{"wrapS":33648}}],"textures":[{{"source":0,"sampler":0}}],)"
            R"("materials":[{{"alphaMode":"MASK","pbrMetallicRoughness":{{"baseColorFactor":[1,0.5,1,1],)"
            R"("baseColorTexture":{{"index":0,"extensions":{{"KHR_texture_transform":{{"scale":[2,2]}}}}}}}}}}],)"
            R"("meshes":[{{"weights":[0.5],"primitives":[{{"mode":5,"indices":3,"material":0,"targets":[{{"POSITION":0}}],)"
            R"("attributes":{{"POSITION":0,"TEXCOORD_0":1,"COLOR_0":2,"JOINTS_0":4,"WEIGHTS_0":5}}}}]}}],)"
            R"("skins":[{{"joints":[1],"inverseBindMatrices":6}}],"nodes":[{{"mesh":0,"skin":0,"children":[1]}},)"
            R"({{"rotation":[0,0,1,0],"children":[2]}},{{"mesh":0,"scale":[1,-1,1],"translation":[0,0,5]}}],)"
            R"("scene":0,"scenes":[{{"nodes":[0]}}])",
            picture_offset, picture.size()));
}

/// A box's lid: a triangle that turns about its parent, by one animation of two channels.
std::string moving_gltf() {
    const std::string bytes = bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 2, 0, 0, 0, 1, 0,
                                                          1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 2});
    return gltf_text(
        bytes,
        R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":12},)"
        R"({"buffer":0,"byteOffset":48,"byteLength":48},{"buffer":0,"byteOffset":96,"byteLength":36}],)"
        R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3},)"
        R"({"bufferView":1,"componentType":5126,"type":"SCALAR","count":3},)"
        R"({"bufferView":2,"componentType":5126,"type":"VEC4","count":3},)"
        R"({"bufferView":3,"componentType":5126,"type":"VEC3","count":3}],)"
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
        R"("nodes":[{"name":"box","mesh":0,"children":[1]},{"name":"lid","mesh":0,"translation":[0,0,1]}],)"
        R"("animations":[{"name":"open","samplers":[{"input":1,"output":2},{"input":1,"output":3,"interpolation":"STEP"}],)"
        R"("channels":[{"sampler":0,"target":{"node":1,"path":"rotation"}},{"sampler":1,"target":{"node":1,"path":"translation"}}]}])");
}

} // namespace

std::vector<SampleModel> sample_models() {
    const image::Image8 picture = smooth_picture(8, 8);
    return {
        {"png.gltf", rich_gltf(png_of(picture))},
        {"jpeg.gltf", rich_gltf(jpeg_of(picture))},
        {"webp.gltf", rich_gltf(webp_of(picture))},
        {"edge_breaker.glb", draco_glb(5, true)},
        {"sequential.glb", draco_glb(3, false)},
        {"meshopt.glb", meshopt_glb(5)},
        {"moving.gltf", moving_gltf()},
        {"grid.obj", grid_obj(3)},
        {"text.ply", grid_ply(3, true)},
        {"binary.ply", grid_ply(3, false)},
        {"text.stl", grid_stl_text()},
        {"binary.stl", grid_stl(2)},
    };
}

} // namespace frustumscreen::testing
