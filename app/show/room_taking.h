/// The artifacts of the exhibit that stand in the room behind the screen: which objects stand for them, which one is in the
/// prop or on its way, and what both pictures show of it (room/taking.h).
///
/// Match    an object stands for the artifact of its key `artifact`, else for the artifact of its pack: the same id, or the
///          same file where the pack has none. A kiosk's packs are copies, so the id counts, not the file.
/// Rest     without a visitor all objects are in their places; the prop shows only artifacts that no object stands for.
/// Frames   table T; metres.
/// Time     `now` never goes back.
/// Threads  the render thread; `create` any. Only `create` and `set_artifacts` allocate or read.
/// Errors   of `create`: as load_pack. Messages begin with the file's name.
#pragma once

#include "app/exhibit/presentation.h"
#include "app/room/line_of_sight.h"
#include "app/room/taking.h"
#include "app/settings/settings.h"
#include "app/show/show.h"
#include "firmware_host/base/result.h"

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::show {

class RoomTaking {
public:
    /// `start`: the time at which the room's objects begin to move; RoomShow::draw takes `seconds` of the same `now`.
    [[nodiscard]] static Result<std::unique_ptr<RoomTaking>>
    create(const settings::Settings& settings, const room::Room& room, MonotonicTime start);

    /// The exhibit's artifacts, at first and when another set is shown.
    void set_artifacts(std::span<const ArtifactInProp> artifacts);
    /// The object that the prop is before, for Exhibit::note_object.
    [[nodiscard]] std::optional<exhibit::RoomObject> before(MonotonicTime now,
                                                            const tracking::TrackedState& on_table);
    /// Moves the objects by what the exhibit has decided, and dims what of it the screen shows. `chosen`: Exhibit::chosen.
    void step(MonotonicTime now, std::size_t chosen, exhibit::Presentation& presentation);

    /// As of the latest step; valid until the next one.
    [[nodiscard]] std::span<const room::TakenPose> poses() const { return taking_.poses(); }
    [[nodiscard]] double seconds(MonotonicTime now) const { return taking_.seconds(now); }

private:
    /// A pack of the room.
    struct RoomPack {
        std::string id; ///< empty: it has none
        std::filesystem::path file;
        glm::dvec3 box_size{1.0};
    };
    RoomTaking(const settings::Settings& settings, const room::Room& room, std::vector<RoomPack> packs,
               MonotonicTime start);
    [[nodiscard]] bool stands_for(const room::Object& object, const ArtifactInProp& artifact) const;
    [[nodiscard]] bool has_object(std::size_t artifact) const;

    glm::dvec3 prop_middle_m_; ///< prop frame
    std::array<glm::dvec3, 4> screen_m_;
    std::vector<RoomPack> packs_;
    room::Taking taking_;
    std::vector<room::TakeableObject> takeable_;
    std::vector<room::SeenObject> seen_; ///< as `takeable_`
    std::optional<std::size_t> before_;  ///< the object that the prop was before at the latest call
};

} // namespace frustumscreen::show
