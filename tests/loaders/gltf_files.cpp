#include "tests/loaders/gltf_files.h"

#include <fmt/format.h>

namespace frustumscreen::testing {

namespace {

Numbers floats(const char* type, std::size_t each, const std::vector<float>& values) {
    return {bytes_of(values), values.size() / each, fmt::format(R"("type":"{}","componentType":5126)", type)};
}
} // namespace

Numbers times(const std::vector<float>& values) {
    return floats("SCALAR", 1, values);
}
Numbers vectors(const std::vector<float>& values) {
    return floats("VEC3", 3, values);
}
Numbers rotations(const std::vector<float>& values) {
    return floats("VEC4", 4, values);
}

std::string file_with(const std::string& nodes, const std::string& more,
                      const std::vector<Numbers>& numbers) {
    std::vector<Numbers> all{vectors({0, 0, 0, 1, 0, 0, 0, 1, 0})};
    all.insert(all.end(), numbers.begin(), numbers.end());
    std::string bytes;
    std::string views;
    std::string accessors;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const char* comma = k == 0 ? "" : ",";
        views += fmt::format(R"({}{{"buffer":0,"byteOffset":{},"byteLength":{}}})", comma, bytes.size(),
                             all[k].bytes.size());
        accessors +=
            fmt::format(R"({}{{"bufferView":{},{},"count":{}}})", comma, k, all[k].form, all[k].count);
        bytes += all[k].bytes;
    }
    return gltf_text(
        bytes,
        fmt::format(
            R"("bufferViews":[{}],"accessors":[{}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],"nodes":[{}]{})",
            views, accessors, nodes, more));
}

std::string animation(int node, const char* path, const char* interpolation, const char* name) {
    return fmt::format(
        R"({{"name":"{}","samplers":[{{"input":1,"output":2,"interpolation":"{}"}}],"channels":[{{"sampler":0,"target":{{"node":{},"path":"{}"}}}}]}})",
        name, interpolation, node, path);
}
std::string animations(const std::string& list) {
    return fmt::format(R"(,"animations":[{}])", list);
}

} // namespace frustumscreen::testing
