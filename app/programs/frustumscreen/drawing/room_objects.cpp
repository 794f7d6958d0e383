#include "app/programs/frustumscreen/drawing/room_objects.h"

#include "app/pack/pack_file.h"
#include "app/room/room_file.h"

namespace frustumscreen::programs {

Result<std::vector<drawing::DrawnObject>> drawn_objects(const std::filesystem::path& room_file) {
    TRY(const room::Room room, room::read_room(room_file));
    std::vector<glm::dvec3> boxes; // of each pack; the longest edge is 1
    for (const std::filesystem::path& file : room.packs) {
        const auto coarsest = [](const pack::PackOutline& /*outline*/) -> Result<std::vector<std::uint32_t>> {
            return std::vector<std::uint32_t>{0};
        };
        TRY(const pack::VerifiedPack read, pack::load_pack(file, coarsest));
        boxes.push_back(read->box_size);
    }
    std::vector<drawing::DrawnObject> drawn;
    for (const room::Object& object : room.objects) {
        const geometry::RigidTransform table_from_object = room::table_from_object(object, 0.0);
        const glm::dvec3 size_m = object.size_m * boxes[object.pack];
        drawing::DrawnObject& each = drawn.emplace_back();
        each.name = object.name;
        for (const glm::dvec2 side :
             {glm::dvec2(-0.5, -0.5), glm::dvec2(0.5, -0.5), glm::dvec2(0.5, 0.5), glm::dvec2(-0.5, 0.5)}) {
            each.foot_m.emplace_back(table_from_object.point(glm::dvec3(side * glm::dvec2(size_m), 0.0)));
        }
        each.low_m = object.place_m.z;
        each.high_m = object.place_m.z + size_m.z;
        each.place_m = object.place_m;
        each.size_m = object.size_m;
        each.moves = object.motion.moves();
    }
    return drawn;
}

} // namespace frustumscreen::programs
