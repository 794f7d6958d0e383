#include "app/simulation/room.h"

#include "app/simulation/room_light.h"

#include <cmath>

namespace frustumscreen::simulation {

namespace {

constexpr double table_height_m = 0.76;
constexpr double top_thickness_m = 0.03;
constexpr double leg_m = 0.05;
constexpr double room_m = 6.0;
constexpr double wall_m = 1.7; ///< behind the table's centre
constexpr double ceiling_m = 2.0;
constexpr double floor_albedo = 0.30;
constexpr double wall_albedo = 0.60;
constexpr double case_albedo = 0.75;
const glm::dvec3 case_half_m(0.17, 0.13, 0.055);
constexpr double pole_half_m = 0.015;

} // namespace

std::vector<RoomObject> stand_of(const VisitorScreen& screen) {
    const auto& [top_left, top_right, bottom_right, bottom_left] = screen.corners_m;
    const glm::dvec3 middle = 0.25 * (top_left + top_right + bottom_right + bottom_left);
    constexpr glm::dvec2 post_m(0.05, 0.02); // half of its sides
    constexpr glm::dvec2 foot_m(0.28, 0.16);
    constexpr double behind_m = 0.04;
    const glm::dvec2 at(middle.x, std::fmax(middle.y, std::fmax(top_left.y, bottom_left.y)) + behind_m);
    return {{{at - post_m, -table_height_m}, {at + post_m, middle.z}, screen_case_albedo},
            {{at - foot_m, -table_height_m}, {at + foot_m, -table_height_m + 0.02}, screen_case_albedo}};
}

std::vector<RoomObject> room_around(const glm::dvec2& table_size_m, const glm::dvec3& lens_m) {
    const glm::dvec2 half = table_size_m / 2.0;
    const glm::dvec3 case_middle = lens_m + glm::dvec3(0.0, 0.0, case_half_m.z);
    const glm::dvec3 pole_half(pole_half_m, pole_half_m, 0.0);
    std::vector<RoomObject> objects{
        {{-room_m, -room_m, -table_height_m - 0.1}, {room_m, room_m, -table_height_m}, floor_albedo},
        {{-room_m, wall_m, -table_height_m}, {room_m, wall_m + 0.1, room_m}, wall_albedo},
        {glm::dvec3(-half, -top_thickness_m), glm::dvec3(half, -1e-6), table_albedo},
        {case_middle - case_half_m, case_middle + case_half_m, case_albedo},
        {case_middle - pole_half, glm::dvec3(glm::dvec2(lens_m), lens_m.z + ceiling_m) + pole_half,
         case_albedo}};
    for (const glm::dvec2 side :
         {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(1, 1)}) {
        const glm::dvec2 outer = side * half;
        const glm::dvec2 inner = side * (half - leg_m);
        objects.push_back({glm::dvec3(glm::min(outer, inner), -table_height_m),
                           glm::dvec3(glm::max(outer, inner), -top_thickness_m), table_albedo});
    }
    return objects;
}

} // namespace frustumscreen::simulation
