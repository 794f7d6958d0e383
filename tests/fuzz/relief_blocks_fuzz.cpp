// Relief blocks: refused in one line, or written again they give the same bytes, and rasterizing them stays
// inside their memory.
#include "app/pack/block_part.h"
#include "app/relief/rasterize_blocks.h"
#include "tests/fuzz/fuzz.h"

#include <algorithm>

using namespace frustumscreen;

namespace {

/// A small number keeps each input fast.
constexpr std::size_t max_rasterized_blocks = 64;

/// From above, at an angle, close enough for the limits of a block to matter.
relief::RasterView view_of_box() {
    relief::RasterScene scene;
    scene.prop_from_box = glm::dmat4(0.1);
    scene.prop_from_box[3][3] = 1.0;
    scene.projector = {32, 24, 60.0, 60.0, 16.0, 12.0};
    scene.prop_from_projector = {{0.0, 1.0, 0.0, 0.0}, {0.02, 0.0, 0.5}}; // looking down
    scene.eye_m = {0.1, -0.3, 0.4};
    relief::RasterView view;
    relief::set_up(view, geometry::make_frustum(geometry::FrustumSize{}), scene);
    return view;
}

void require_raster(const relief::BlockRelief& relief) {
    const relief::RasterView view = view_of_box();
    fuzz::require(!view.faces.empty(), "the box is seen");
    relief::BlockItems items;
    relief::list_blocks(items, relief, view);
    relief::RasterSamples samples;
    samples.begin(view.lit, 2);
    relief::rasterize(samples, relief, view, items);
    for (std::size_t k = 0; k < samples.nearness.size(); ++k) {
        if (samples.nearness[k] > 0.0F) {
            fuzz::require(samples.block[k] < relief.blocks.size(), "a sample shows a block that is there");
            fuzz::require(relief::colour_at(relief, samples.block[k], samples.place[k]).a == 255,
                          "what is shown is opaque");
        }
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto bytes = fuzz::bytes_of(data, size);
    const auto relief = pack::decode_blocks(bytes);
    if (!relief) {
        fuzz::require_one_line(relief.error().message);
        return 0;
    }
    const Bytes written = pack::encode_blocks(*relief);
    fuzz::require(std::equal(written.begin(), written.end(), bytes.begin(), bytes.end()),
                  "what was read is written again byte for byte");
    if (relief->blocks.size() <= max_rasterized_blocks) {
        require_raster(*relief);
    }
    return 0;
}
