/// The GPU that draws the picture: the graphics card that shows it, if it can; otherwise another GPU of this
/// machine; otherwise the processor.
///
/// Mesa itself pairs the display and the GPU of many boards (kmsro: vc4 and v3d of a Raspberry Pi, most ARM
/// boards). This class serves cards that only display, without such a pair (bochs, ast, mgag200, udl, gud),
/// in a machine with a separate GPU.
///
/// Threads  the render thread; afterwards the context is current.
/// Errors   neither GBM nor EGL.
/// Source   Mesa, src/gbm/backends/dri (kms_swrast draws for a card without a driver) and
///          src/gallium/winsys/kmsro.
#pragma once

#include "firmware_host/display/egl_context.h"

#include <memory>
#include <utility>

struct gbm_device;

namespace frustumscreen::display {

class DrawingGpu {
public:
    /// `card` shows the picture and must stay open.
    [[nodiscard]] static Result<DrawingGpu> choose_for(int card);

    [[nodiscard]] const EglContext& context() const { return context_; }
    /// The card's own memory; nullptr: pictures must be copied into it.
    [[nodiscard]] gbm_device* card_memory() const { return shows_ ? device_.get() : nullptr; }

private:
    using Device = std::unique_ptr<gbm_device, void (*)(gbm_device*)>;
    DrawingGpu(Device device, EglContext context, bool shows)
        : device_(std::move(device)), context_(std::move(context)), shows_(shows) {}
    [[nodiscard]] static Result<DrawingGpu> on(Device device, bool shows);
    [[nodiscard]] static Result<DrawingGpu> on_render_node(const char* path);

    Device device_; ///< nullptr: the processor draws
    EglContext context_;
    bool shows_;
};

} // namespace frustumscreen::display
