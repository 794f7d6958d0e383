#include "app/residency/room_models.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace frustumscreen::residency {

namespace {

/// A quality level is unloaded for another one only if that is clearly more urgent, so that two of them do not
/// replace each other in turn.
constexpr double clearly = 1.25;

} // namespace

RoomModels::RoomModels(std::vector<std::optional<KnownModel>> models, const Options& options,
                       render::GpuStore& store)
    : options_(options), store_(store) {
    for (std::optional<KnownModel>& known : models) {
        first_.push_back(first_.empty() ? 0 : first_.back() + entries_.back().slots.size() + 1);
        Entry& entry = entries_.emplace_back();
        entry.is_missing = !known;
        entry.slots.resize(known ? known->quality_levels.size() : 0);
        entry.known = std::move(known);
    }
    loaded_.reserve(64);
    if (!options_.waits) {
        reader_ = std::make_unique<BackgroundReader<Item>>(
            [this](std::size_t number, const auto&) { return read(place_of(number)); }, "room");
    }
}

std::size_t RoomModels::number_of(const Place& place) const {
    return first_[place.model] + place.quality_level;
}

RoomModels::Place RoomModels::place_of(std::size_t number) const {
    const auto after = std::upper_bound(first_.begin(), first_.end(), number);
    const auto model = static_cast<std::size_t>(after - first_.begin()) - 1;
    return {model, number - first_[model]};
}

const scene::PlacedLevel* RoomModels::find(std::size_t model, std::size_t quality_level) const {
    const Entry& entry = entries_[model];
    return quality_level < entry.slots.size() && entry.slots[quality_level].is_there
               ? &entry.slots[quality_level].placed
               : nullptr;
}

void RoomModels::begin_frame() {
    for (Entry& entry : entries_) {
        entry.solid_urgency = 0.0;
        for (Slot& slot : entry.slots) {
            slot.urgency = 0.0;
            slot.is_shown = false;
        }
    }
}

void RoomModels::want(std::size_t model, std::size_t quality_level, double urgency) {
    double& present = entries_[model].slots[quality_level].urgency;
    present = std::max(present, urgency);
}

void RoomModels::want_solid(std::size_t model, double urgency) {
    double& present = entries_[model].solid_urgency;
    present = std::max(present, urgency);
}

void RoomModels::keep(std::size_t model, std::size_t quality_level) {
    entries_[model].slots[quality_level].is_shown = true;
}

Result<RoomModels::Item> RoomModels::read(const Place& place) const {
    const KnownModel& known = *entries_[place.model].known;
    if (place.quality_level == known.quality_levels.size()) {
        TRY(std::optional<scene::BoxCorners> solid, read_solid(known));
        return Item(solid);
    }
    TRY(ReadQualityLevel read, read_quality_level(known, place.quality_level));
    return Item(std::move(read));
}

std::optional<RoomModels::Place> RoomModels::next_to_read() const {
    std::optional<Place> found;
    double most = 0.0;
    for (std::size_t model = 0; model < entries_.size(); ++model) {
        const Entry& entry = entries_[model];
        if (entry.is_missing) {
            continue;
        }
        for (std::size_t quality_level = 0; quality_level < entry.slots.size(); ++quality_level) {
            if (!entry.slots[quality_level].is_there && entry.slots[quality_level].urgency > most) {
                most = entry.slots[quality_level].urgency;
                found = {model, quality_level};
            }
        }
        if (!entry.is_solid_known && entry.solid_urgency > most) {
            most = entry.solid_urgency;
            found = {model, entry.slots.size()};
        }
    }
    return found;
}

void RoomModels::unload(const Place& place) {
    Slot& slot = entries_[place.model].slots[place.quality_level];
    store_.release(slot.placed.drawable);
    slot.placed = {};
    slot.is_there = false;
    bytes_ -= entries_[place.model].known->quality_levels[place.quality_level].bytes;
}

bool RoomModels::make_space(std::uint64_t bytes, double urgency) {
    const auto least = [&]() -> std::optional<Place> {
        std::optional<Place> found;
        double urgency_there = urgency / clearly;
        for (std::size_t model = 0; model < entries_.size(); ++model) {
            for (std::size_t quality_level = 0; quality_level < entries_[model].slots.size();
                 ++quality_level) {
                const Slot& there = entries_[model].slots[quality_level];
                if (there.is_there && !there.is_shown && there.urgency < urgency_there) {
                    urgency_there = there.urgency;
                    found = {model, quality_level};
                }
            }
        }
        return found;
    };
    std::uint64_t others = 0; // that may be unloaded
    for (const Entry& entry : entries_) {
        for (std::size_t quality_level = 0; quality_level < entry.slots.size(); ++quality_level) {
            const bool may = entry.slots[quality_level].is_there && !entry.slots[quality_level].is_shown &&
                             entry.slots[quality_level].urgency < urgency / clearly;
            others += may ? entry.known->quality_levels[quality_level].bytes : 0;
        }
    }
    if (bytes_ - others + bytes > options_.max_bytes) {
        return false;
    }
    while (bytes_ + bytes > options_.max_bytes) {
        unload(*least());
    }
    return true;
}

void RoomModels::give_up(const Place& place, const Error& error) {
    entries_[place.model].is_missing = true;
    faults_.push_back(error.message);
}

/// Replaces the expected bytes by the actual ones.
void RoomModels::receive(const Place& place, Result<Item> item) {
    Entry& entry = entries_[place.model];
    const bool is_solid = place.quality_level == entry.slots.size();
    if (!is_solid) {
        bytes_ -= entry.known->quality_levels[place.quality_level].bytes;
    }
    if (!item) {
        give_up(place, item.error());
        return;
    }
    if (is_solid) {
        entry.solid = std::get<std::optional<scene::BoxCorners>>(*item);
        entry.is_solid_known = true;
        return;
    }
    ReadQualityLevel read = std::get<ReadQualityLevel>(std::move(*item));
    entry.known->quality_levels[place.quality_level].bytes = read.bytes;
    if (!make_space(read.bytes, entry.slots[place.quality_level].urgency)) {
        return; // larger than expected
    }
    bytes_ += read.bytes;
    std::shared_ptr<const relief::BlockRelief> relief = read.data.relief;
    upload_.emplace(Upload{.place = place,
                           .upload = render::LevelUpload(std::move(read.data)),
                           .triangles = std::move(read.triangles),
                           .relief = std::move(relief)});
}

void RoomModels::go_on_uploading(std::uint64_t max_bytes) {
    const Place place = upload_->place;
    KnownModel& known = *entries_[place.model].known;
    if (Result<void> sent = upload_->upload.go_on(max_bytes); !sent) {
        bytes_ -= known.quality_levels[place.quality_level].bytes;
        give_up(place, sent.error());
        upload_.reset();
        return;
    }
    if (!upload_->upload.done()) {
        return;
    }
    Slot& slot = entries_[place.model].slots[place.quality_level];
    slot.placed = {.triangles = upload_->triangles,
                   .box_size = known.box_size,
                   .metres_per_box = 1.0,
                   .drawable = store_.keep(std::move(upload_->upload))};
    slot.placed.relief = upload_->relief;
    slot.is_there = true;
    loaded_.push_back(known.file.stem().string() + " " + known.quality_levels[place.quality_level].name);
    upload_.reset();
}

void RoomModels::go_on() {
    if (reader_) {
        if (const auto answer = reader_->take(); answer && reading_ && answer->item == number_of(*reading_)) {
            const Place place = *reading_;
            reading_.reset();
            receive(place, std::move(answer->prepared));
        }
    }
    if (upload_) {
        go_on_uploading(options_.max_upload_bytes);
    }
    while (!reading_ && !upload_) {
        const std::optional<Place> next = next_to_read();
        if (!next) {
            return;
        }
        Entry& entry = entries_[next->model];
        if (next->quality_level < entry.slots.size()) {
            const std::uint64_t bytes = entry.known->quality_levels[next->quality_level].bytes;
            if (!make_space(bytes, entry.slots[next->quality_level].urgency)) {
                entry.slots[next->quality_level].urgency = 0.0; // not in this frame
                continue;
            }
            bytes_ += bytes;
        }
        if (reader_) {
            reading_ = next;
            reader_->request(number_of(*next));
            return;
        }
        receive(*next, read(*next));
        if (upload_) {
            go_on_uploading(std::numeric_limits<std::uint64_t>::max());
        }
    }
}

} // namespace frustumscreen::residency
