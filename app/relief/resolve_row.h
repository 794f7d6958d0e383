/// The codes of a row of pixels, from what their samples met.
///
/// Colour   bilinear between the corners' codes: once for all of a pixel's samples where they lie within a cell of one block, else
///          once for each, and averaged in linear light, where a sample that met nothing counts as black.
/// Threads  pure; any.
/// SIMD     as cast_blocks.h; the codes are equal.
#pragma once

#include "app/relief/cast_blocks.h"
#include "app/relief/sample_light.h"

#include <glm/glm.hpp>

#include <span>

namespace frustumscreen {

/// Of row `y`, from pixel `first` on; alpha 0 where nothing was met.
void resolve_row(const CastSamples& samples, const BlockRelief& relief, const SampleLight& light, int y,
                 int first, std::span<glm::u8vec4> codes, Instructions instructions = best_instructions());

} // namespace frustumscreen
