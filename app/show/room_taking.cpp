#include "app/show/room_taking.h"

#include "app/pack/pack_file.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace frustumscreen::show {

namespace {

bool are_one_file(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code error;
    return a == b || std::filesystem::equivalent(a, b, error);
}

/// True if a visitor is at the exhibit, so that an artifact may be in the prop.
bool is_in_use(const exhibit::Presentation& presentation) {
    const exhibit::State state = presentation.staff ? presentation.before_staff : presentation.state;
    return state != exhibit::State::Attract && state != exhibit::State::Fault;
}

} // namespace

Result<std::unique_ptr<RoomTaking>> RoomTaking::create(const settings::Settings& settings,
                                                       const room::Room& room, MonotonicTime start) {
    std::vector<RoomPack> packs;
    for (const std::filesystem::path& file : room.packs) {
        TRY(const pack::VerifiedPack pack,
            pack::load_pack(file, [](const pack::PackOutline&) { return std::vector<std::uint32_t>{}; }));
        packs.push_back({pack->id, file, pack->box_size});
    }
    return std::unique_ptr<RoomTaking>(new RoomTaking(settings, room, std::move(packs), start));
}

RoomTaking::RoomTaking(const settings::Settings& settings, const room::Room& room,
                       std::vector<RoomPack> packs, MonotonicTime start)
    : prop_middle_m_(settings::make_prop(settings.prop).middle), screen_m_(settings.screen.corners_m),
      packs_(std::move(packs)), taking_(room.objects, start) {}

bool RoomTaking::stands_for(const room::Object& object, const ArtifactInProp& artifact) const {
    if (!object.artifact.empty()) {
        return object.artifact == artifact.name;
    }
    const RoomPack& pack = packs_[object.pack];
    return pack.id.empty() ? are_one_file(pack.file, artifact.name) : pack.id == artifact.name;
}

void RoomTaking::set_artifacts(std::span<const ArtifactInProp> artifacts) {
    takeable_.clear();
    seen_.clear();
    const std::span<const room::Object> objects = taking_.objects();
    for (std::size_t k = 0; k < objects.size(); ++k) {
        const auto of = std::find_if(artifacts.begin(), artifacts.end(), [&](const ArtifactInProp& artifact) {
            return stands_for(objects[k], artifact);
        });
        if (of != artifacts.end()) {
            takeable_.push_back({k, static_cast<std::size_t>(of - artifacts.begin()), of->metres_per_box});
            seen_.push_back({k, packs_[objects[k].pack].box_size});
        }
    }
    taking_.set_takeable(takeable_);
}

bool RoomTaking::has_object(std::size_t artifact) const {
    return std::any_of(takeable_.begin(), takeable_.end(),
                       [&](const room::TakeableObject& each) { return each.artifact == artifact; });
}

std::optional<exhibit::RoomObject> RoomTaking::before(MonotonicTime now,
                                                      const tracking::TrackedState& on_table) {
    std::optional<std::size_t> met;
    if (on_table.prop_known) {
        const room::Line line{on_table.eye_m, on_table.table_from_prop.point(prop_middle_m_)};
        if (room::goes_through(line, screen_m_)) { // only what the screen shows
            met = room::first_met(line, taking_.objects(), seen_, taking_.seconds(now), before_);
        }
    }
    before_ = met ? std::optional(seen_[*met].object) : std::nullopt;
    return met ? std::optional(exhibit::RoomObject{takeable_[*met].object, takeable_[*met].artifact})
               : std::nullopt;
}

void RoomTaking::step(MonotonicTime now, std::size_t chosen, exhibit::Presentation& presentation) {
    taking_.step({.now = now,
                  .chosen = is_in_use(presentation) ? std::optional(chosen) : std::nullopt,
                  .shown = presentation.artifact,
                  .shown_light = presentation.artifact_light,
                  .table_from_prop = presentation.table_from_prop,
                  .idle = presentation.attracts,
                  .before = presentation.before ? std::optional(presentation.before->object) : std::nullopt});
    const double share = taking_.prop_share();
    presentation.brightness *= share;
    presentation.settled = presentation.settled && !taking_.moves();
    if (presentation.placeholder && has_object(presentation.placeholder->artifact)) {
        presentation.placeholder.reset(); // the object on the screen stands for it
    }
    if (presentation.hotspot && presentation.hotspot->artifact == presentation.artifact) {
        presentation.hotspot->brightness *= share;
        if (share <= 0.0) {
            presentation.hotspot.reset();
        }
    }
}

} // namespace frustumscreen::show
