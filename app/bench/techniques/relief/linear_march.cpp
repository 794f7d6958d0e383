#include "app/bench/techniques/relief/relief_march.h"
#include "app/bench/techniques/relief/relief_technique.h"

#include <fmt/format.h>

namespace frustumscreen::bench {

namespace {

constexpr std::string_view linear_source = R"(
bool search(vec3 start, vec3 along, float leave, out float at) {
    float step = leave / float(STEPS);
    vec3 stride = along * step;
    vec3 p = start + 0.5 * stride;
    int taken = 0;
    while (taken < STEPS && !inside(p)) {
        p += stride;
        ++taken;
    }
    at = (float(taken) + 0.5) * step;
    if (taken == STEPS) {
        return false;
    }
    for (int k = 0; k < BISECTIONS; ++k) {
        step *= 0.5;
        float earlier = at - step;
        at = inside(start + earlier * along) ? earlier : at;
    }
    return true;
}
)";

} // namespace

Result<std::unique_ptr<Technique>> make_linear_march(const Kiosk& kiosk, const ReliefImages& images,
                                                     const LinearBinary& search) {
    gl::GlTexture relief = make_relief_array(GL_RG16UI, images.texels, 1, 3);
    for (int axis = 0; axis < 3; ++axis) {
        set_layer(0, axis, material_along(images, axis));
    }
    return make_relief_technique(
        kiosk, images,
        {.name = fmt::format("linear {}+{} {}", search.steps, search.bisections, images.texels),
         .defines = fmt::format("#define STEPS {}\n#define BISECTIONS {}\n", search.steps, search.bisections),
         .source = linear_source,
         .relief = std::move(relief)});
}

} // namespace frustumscreen::bench
