/// The codes of a row of pixels, from the hits of their samples.
///
/// Colour   bilinear between the corners' codes: once for all of a pixel's samples if they lie within a cell
///          of one block; otherwise once for each, averaged in linear light, where a sample without a hit
///          counts as black. A relief's light multiplies its codes by sRGB's power law, as the shaders do.
/// Threads  pure; any.
/// SIMD     as rasterize_blocks.h; every instruction set makes equal codes.
#pragma once

#include "app/relief/block_pages.h"
#include "app/relief/rasterize_blocks.h"
#include "app/relief/sample_light.h"

#include <glm/glm.hpp>

#include <span>

namespace frustumscreen::relief {

enum class Outline {
    OverBlack, ///< a sample without a hit is black; alpha is 255 if any sample has a hit
    Coverage,  ///< the mean of the hits; alpha is their share of the samples
};

/// For row `y`, from pixel `first` on; alpha 0 without a hit. `reliefs`: those that were rasterized into the samples.
void resolve_row(const RasterSamples& samples, const BlockPages& reliefs, const SampleLight& light, int y,
                 int first, std::span<glm::u8vec4> codes, Outline outline = Outline::OverBlack,
                 Instructions instructions = best_instructions());

} // namespace frustumscreen::relief
