/// The amphora's texture and the relief of its paint.
///
/// Frame    the atlas has strips of rows: body (u around, v from the lip down to the foot), mouth, underside,
///          handles (u along, v around).
/// Threads  uses all cores; the result does not depend on their number.
#pragma once

#include "app/image/image.h"
#include "assets_baked/artifacts/atlas.h"
#include "assets_baked/artifacts/profile.h"

#include <glm/glm.hpp>

#include <vector>

namespace frustumscreen::artifacts {

/// Heights over a strip, sampled with a cubic B-spline; periodic in u.
class ReliefMap {
public:
    ReliefMap(int width, int height)
        : width_(width), height_(height),
          texels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}
    [[nodiscard]] float& at(int x, int y) { return texels_[index(x, y)]; }
    [[nodiscard]] double sample(double u, double v) const; ///< u, v in 0..1
private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }
    int width_;
    int height_;
    std::vector<float> texels_;
};

namespace amphora_atlas {
inline constexpr int size = 2048;
inline constexpr AtlasStrip body{0, 1536};
inline constexpr AtlasStrip mouth{1544, 216};
inline constexpr AtlasStrip underside{1768, 56};
inline constexpr AtlasStrip handle{1832, 216};
} // namespace amphora_atlas

struct AmphoraSkin {
    image::Image8 texture;
    ReliefMap body_relief_mm; ///< v = 0 at the lip
};

/// `body` must run from the foot's resting ring to the top of the lip.
[[nodiscard]] AmphoraSkin paint_amphora(const Profile& body);
/// The texture as the painter left it: nothing is worn, and the pigments are whole.
[[nodiscard]] image::Image8 paint_new_amphora(const Profile& body);

} // namespace frustumscreen::artifacts
