/// glTF 2.0, text (.gltf) and binary (.glb).
///
/// Frame    the scene's. Default scene, otherwise scene 0; without scenes every root node; without nodes every
///          mesh once.
/// Follows  KHR_draco_mesh_compression, EXT_meshopt_compression, KHR_mesh_quantization,
///          KHR_texture_transform, EXT_texture_webp, KHR_materials_unlit, KHR_materials_pbrSpecularGlossiness
///          (its diffuse colour). Moving parts have the pose of the nodes, skins and morph weights; animations that
///          move whole parts are kept (gltf_world.h).
/// Errors   throws Refusal.
/// Library  nlohmann::json reads the JSON. Debian's tinygltf was considered and not used: it refuses
///          buffers without data, which EXT_meshopt_compression uses, and its errors do not name the place in the
///          file.
#pragma once

#include "assets_baked/bake/loaders/bytes.h"
#include "assets_baked/bake/loaders/model_files.h"

namespace frustumscreen::bake {

[[nodiscard]] SourceMesh load_gltf(ByteView file, ModelFiles& files);

} // namespace frustumscreen::bake
