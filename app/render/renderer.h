/// Draws a plan into a display's framebuffer: only what changed, and nothing if nothing changed. Owns the
/// meshes and textures that plans name, and a program for each of their shaders.
///
/// Colour   the framebuffer is sRGB (display.h); shaders work in linear light.
/// Threads  the render thread; `draw` allocates nothing and makes no GL object.
/// Errors   when something is created, prepared or uploaded: shaders, buffers or textures that the driver
///          refuses.
#pragma once

#include "app/render/cast_pass.h"
#include "app/render/face_pass.h"
#include "app/render/gpu_store.h"
#include "app/render/sample_grid.h"
#include "app/render/shader_cache.h"
#include "app/render/table_pass.h"
#include "app/scene/frame_plan.h"
#include "app/scene/shader_key.h"
#include "firmware_host/base/result.h"

#include <array>
#include <optional>
#include <set>

namespace frustumscreen {

/// Samples a pixel lie on a regular grid and are averaged in linear light: 1, 2, 4, 8 or 16. More smooth the
/// outlines and the texture. The artifact's rectangle alone is drawn larger and averaged down: on llvmpipe
/// that takes half the time of the driver's own multisampling.
///
/// The live exhibit has room for this many on each pixel of the prop. An artifact that asks for more gets them where it takes less of
/// the picture than the prop; a picture that there is no room for takes half as many, until there is.
inline constexpr int default_samples = 4;
/// For the finest level, where the cost does not matter.
inline constexpr int finest_samples = 16;

/// Display::framebuffer, whose colour is a texture, and Display::buffer_age.
struct RenderTarget {
    unsigned framebuffer = 0;
    int buffer_age = 0;
};

struct DrawResult {
    bool drawn = false;     ///< false: the picture on show is still right; do not present
    PixelRectangle redrawn; ///< what was cleared and drawn
    PixelRectangle lit;     ///< every pixel that the picture may light
    int draw_calls = 0;
};

enum class Redraw {
    Changes,
    Again,      ///< to present it once more: as Changes, but `drawn` is true in any case
    Everything, ///< the whole picture, whether it changed or not
};

class Renderer {
public:
    /// Makes a renderer for pictures of that size.
    [[nodiscard]] static Result<Renderer> create(int width, int height, const RenderNeeds& needs = {});
    /// Compiles and allocates what these needs add to the earlier ones, so that no frame compiles anything.
    [[nodiscard]] Result<void> prepare(const RenderNeeds& needs);

    /// The meshes and textures that plans name. A picture counts as unchanged until its plan names something
    /// else; what is released is missing from the next picture that is drawn.
    [[nodiscard]] GpuStore& store() { return store_; }
    [[nodiscard]] const GpuStore& store() const { return store_; }

    /// Each drawn picture must be presented before the next call: the target's age counts presents.
    DrawResult draw(const FramePlan& plan, const RenderTarget& target, Redraw redraw = Redraw::Changes);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    /// The shaders that were compiled.
    [[nodiscard]] std::set<ShaderKey> shaders() const { return shaders_.keys(); }
    /// Whose lens they bend what they draw for.
    [[nodiscard]] const std::optional<Pinhole>& bent_by() const { return needs_.bent_by; }
    /// Bytes of GPU memory, as the driver says, without the indices that come with each picture.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    /// What lies on the table is told apart by its draws, so that one that changes alone is drawn alone.
    struct Picture {
        struct OnTable {
            std::uint64_t hash = 0;
            PixelRectangle bounds;
        };
        std::uint64_t hash = 0;
        std::uint64_t prop_hash = 0;
        PixelRectangle prop_bounds;
        std::array<OnTable, most_on_table + 16> on_table{}; ///< with the prop's faces, in black
        std::size_t count = 0;
        [[nodiscard]] bool lies(const OnTable& draw) const;
        void add_changes(const Picture& other, PixelRectangle& changes) const;
    };
    struct Repaint {
        PixelRectangle part;
        bool prop = true; ///< else the part does not meet it
    };
    [[nodiscard]] static Picture picture_of(const FramePlan& plan);
    Renderer(int width, int height) : width_(width), height_(height) {}
    void paint(const FramePlan& plan, const RenderTarget& target, const Repaint& repaint, DrawResult& result);
    [[nodiscard]] Repaint to_redraw(const Picture& picture, const RenderTarget& target, Redraw redraw) const;

    int width_, height_;
    /// There is room for so many samples; a plan may ask for fewer, and for more in a smaller part.
    RenderNeeds needs_;
    GpuStore store_;
    ShaderCache shaders_;
    CastPass casts_;
    FacePass faces_;
    TablePass table_;
    std::optional<SampleGrid> sample_grid_; ///< for more than one sample
    std::array<Picture, 4> history_{};      ///< [0] is the last picture presented
    std::size_t pictures_ = 0;              ///< valid entries of history_
};

} // namespace frustumscreen
