#include "app/bench/measures/subdivide.h"

#include <algorithm>
#include <map>
#include <utility>

namespace frustumscreen::bench {

namespace {

/// Creates one middle vertex per edge, at the end of the mesh's vertices.
class Middles {
public:
    explicit Middles(bake::SourceMesh& mesh) : mesh_(mesh) {}

    std::uint32_t of(std::uint32_t a, std::uint32_t b) {
        const auto [middle, is_new] = found_.try_emplace(std::minmax(a, b), mesh_.positions.size());
        if (is_new) {
            append(mesh_.positions, a, b);
            append(mesh_.uvs, a, b);
            append(mesh_.colours, a, b);
        }
        return middle->second;
    }

private:
    /// Does nothing if the mesh lacks the attribute.
    template <typename Value>
    static void append(std::vector<Value>& values, std::uint32_t a, std::uint32_t b) {
        if (!values.empty()) {
            values.push_back((values[a] + values[b]) / typename Value::value_type(2));
        }
    }

    bake::SourceMesh& mesh_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> found_;
};

} // namespace

bake::SourceMesh subdivide(const bake::SourceMesh& mesh) {
    bake::SourceMesh result = mesh;
    result.triangles.clear();
    result.triangle_materials.clear();
    Middles middles(result);
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
        const auto& [a, b, c] = mesh.triangles[k];
        const std::uint32_t ab = middles.of(a, b);
        const std::uint32_t bc = middles.of(b, c);
        const std::uint32_t ca = middles.of(c, a);
        result.triangles.insert(result.triangles.end(),
                                {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        result.triangle_materials.insert(result.triangle_materials.end(), 4, mesh.triangle_materials[k]);
    }
    return result;
}

} // namespace frustumscreen::bench
