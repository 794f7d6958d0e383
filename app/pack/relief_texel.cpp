#include "app/pack/relief_texel.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::pack {

namespace {

constexpr double full_code = 65535.0;

std::uint16_t code_of(double value01) {
    return static_cast<std::uint16_t>(std::lround(std::clamp(value01, 0.0, 1.0) * full_code));
}

} // namespace

ReliefAxes axes_of(ReliefDirection direction) {
    switch (direction) {
    case ReliefDirection::PlusX:
    case ReliefDirection::MinusX:
        return {1, 2, 0};
    case ReliefDirection::PlusY:
    case ReliefDirection::MinusY:
        return {0, 2, 1};
    case ReliefDirection::PlusZ:
    case ReliefDirection::MinusZ:
        break;
    }
    return {0, 1, 2};
}

std::uint16_t uv_code(int x, int width) {
    return code_of((x + 0.5) / width);
}

PackVertex relief_vertex(const ReliefAtlas& atlas, const ReliefChart& chart, int x, int y,
                         const glm::dvec3& box_size) {
    const ReliefAxes axes = axes_of(chart.direction);
    const double pitch = atlas.texel_box;
    const glm::dvec3 low = box_low(box_size);
    glm::dvec3 unit(0.0);
    unit[axes.u] = (chart.u0_box + (x - chart.x) * pitch - low[axes.u]) / box_size[axes.u];
    unit[axes.v] = (chart.v0_box + (y - chart.y) * pitch - low[axes.v]) / box_size[axes.v];
    unit[axes.along] = atlas.relief.at(x, y) / full_relief;
    PackVertex vertex;
    vertex.position = {code_of(unit.x), code_of(unit.y), code_of(unit.z)};
    vertex.uv = {uv_code(x, atlas.relief.width), uv_code(y, atlas.relief.height)};
    return vertex;
}

} // namespace frustumscreen::pack
