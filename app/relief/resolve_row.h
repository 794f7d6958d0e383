/// The codes of a row of pixels, from the hits of their samples.
///
/// Colour   bilinear between the corners' codes: once for all of a pixel's samples if they lie within a cell
///          of one block; otherwise once for each, averaged in linear light, where a sample without a hit
///          counts as black.
/// Threads  pure; any.
/// SIMD     as rasterize_blocks.h; every instruction set makes equal codes.
#pragma once

#include "app/relief/rasterize_blocks.h"
#include "app/relief/sample_light.h"

#include <glm/glm.hpp>

#include <span>

namespace frustumscreen::relief {

/// For row `y`, from pixel `first` on; alpha 0 without a hit.
void resolve_row(const RasterSamples& samples, const BlockRelief& relief, const SampleLight& light, int y,
                 int first, std::span<glm::u8vec4> codes, Instructions instructions = best_instructions());

} // namespace frustumscreen::relief
