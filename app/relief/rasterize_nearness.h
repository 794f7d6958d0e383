/// A relief's nearness alone, without its hits: what a shadow map takes.
///
/// Frames   pixels as in raster_view.h, of a plain pinhole.
/// Units    1 / t along the ray of each pixel's centre; 0 without a hit.
/// Threads  pure; any. It writes whole rows, those of the band alone.
/// SIMD     as rasterize_blocks.h.
/// Method   the triangles and the tests of rasterize_blocks.h; but the cells are larger than pixels here, so the lanes are pixels of
///          one cell in place of one pixel of eight cells.
#pragma once

#include "app/relief/block_items.h"
#include "app/relief/picture_span.h"
#include "app/relief/tile_mask.h"

namespace frustumscreen::relief {

/// Keeps the nearer of what is in the picture, which is at least 8 pixels wide, and of the items' cells that meet asked tiles in band
/// `band` of its rows (block_items.h). The edges of faces do not count.
void rasterize_nearness(const PictureSpan<float>& nearness, const TileMask& asked, int band,
                        const BlockRelief& relief, const RasterView& view, const BlockItems& items,
                        Instructions instructions = best_instructions());

/// Divides the asked tiles of a band by the face's slant (RasterFace::slant): the measure of nearness_row.h.
void divide_by_slant(const PictureSpan<float>& nearness, const TileMask& asked, int band,
                     const glm::vec3& slant, Instructions instructions = best_instructions());

} // namespace frustumscreen::relief
