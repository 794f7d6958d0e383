/// The values of an animation's channel over time, checked.
///
/// Units    seconds; a rotation is a unit quaternion x, y, z, w, except in a cubic spline, which keeps the file's numbers.
/// Errors   throws Refusal naming the sampler: other types than glTF allows, keys that are not finite, times that do not
///          rise, a count of values that does not fit, a rotation of length zero.
/// Source   Khronos, glTF 2.0, 3.11.
#pragma once

#include "assets_baked/bake/loaders/gltf_buffers.h"
#include "assets_baked/bake/loaders/gltf_model.h"

namespace frustumscreen::bake {

/// `path`: translation, rotation or scale. The caller has looked at the number of keys, which costs no memory yet.
[[nodiscard]] world::Curve gltf_curve_of(const GltfModel& model, GltfBuffers& buffers,
                                         const GltfSampler& sampler, GltfPath path);

} // namespace frustumscreen::bake
