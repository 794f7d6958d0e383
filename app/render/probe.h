/// Writes the probe into a framebuffer, and reads it from a framebuffer or a picture; base/probe_code.h
/// defines it.
///
/// Colour   linear light into an sRGB framebuffer; read as sRGB codes.
/// Place    where the artifact or a caption may light the corner, the picture has priority and has no code.
/// Threads  functions that take a framebuffer: the render thread; they allocate nothing. The others are pure.
#pragma once

#include "app/image/image.h"
#include "app/scene/frame_plan.h"
#include "firmware_host/base/probe_code.h"

#include <cstdint>
#include <optional>

namespace frustumscreen::render {

/// Writes only into the picture's corner. Returns false and writes nothing if `lit` covers the corner.
bool write_probe(unsigned framebuffer, std::uint8_t code, const PixelRectangle& lit);

/// The code in a picture's corner; nullopt if there is none.
[[nodiscard]] std::optional<std::uint8_t> read_probe(const image::Image8& picture);
/// As above, from a framebuffer, once everything in it is drawn. It waits for the GPU, so do not call it in
/// every frame.
[[nodiscard]] std::optional<std::uint8_t> read_probe(unsigned framebuffer);

/// Makes the corner black again, as in the picture. A picture without a code is left unchanged.
void erase_probe(image::Image8& picture);

} // namespace frustumscreen::render
