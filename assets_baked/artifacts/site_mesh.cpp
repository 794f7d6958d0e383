#include "assets_baked/artifacts/site_mesh.h"

#include <cstddef>

namespace frustumscreen::artifacts {

bake::SourceMesh mesh_of_site(const simulation::Site& site) {
    bake::SourceMesh mesh;
    mesh.positions.assign(site.positions.begin(), site.positions.end());
    mesh.uvs = site.texture_places;
    for (std::size_t k = 0; k + 2 < site.indices.size(); k += 3) {
        mesh.triangles.push_back({site.indices[k], site.indices[k + 1], site.indices[k + 2]});
    }
    mesh.triangle_materials.assign(mesh.triangles.size(), 0);
    mesh.materials.resize(1);
    mesh.materials.front().texture = 0;
    mesh.textures = {{site.texture, bake::Wrap::Clamp, bake::Wrap::Clamp}};
    mesh.is_unlit = true;
    mesh.default_up = 'z';
    return mesh;
}

} // namespace frustumscreen::artifacts
