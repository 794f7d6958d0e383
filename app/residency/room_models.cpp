#include "app/residency/room_models.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace frustumscreen::residency {

namespace {

/// A way of drawing is unloaded for another one only if that is clearly more urgent, so that two of them do not
/// replace each other in turn.
constexpr double clearly = 1.25;

} // namespace

RoomModels::RoomModels(std::vector<std::optional<KnownModel>> models, const Options& options,
                       render::GpuStore& store)
    : options_(options), store_(store) {
    for (std::optional<KnownModel>& known : models) {
        first_.push_back(first_.empty() ? 0 : first_.back() + entries_.back().ways.size() + 1);
        Entry& entry = entries_.emplace_back();
        entry.is_missing = !known;
        entry.ways.resize(known ? known->ways.size() : 0);
        entry.known = std::move(known);
    }
    loaded_.reserve(64);
    if (!options_.waits) {
        reader_ = std::make_unique<BackgroundReader<Item>>(
            [this](std::size_t number, const auto&) { return read(place_of(number)); }, "room");
    }
}

std::size_t RoomModels::number_of(const Place& place) const {
    return first_[place.model] + place.way;
}

RoomModels::Place RoomModels::place_of(std::size_t number) const {
    const auto after = std::upper_bound(first_.begin(), first_.end(), number);
    const auto model = static_cast<std::size_t>(after - first_.begin()) - 1;
    return {model, number - first_[model]};
}

const scene::PlacedLevel* RoomModels::find(std::size_t model, std::size_t way) const {
    const Entry& entry = entries_[model];
    return way < entry.ways.size() && entry.ways[way].is_there ? &entry.ways[way].placed : nullptr;
}

void RoomModels::begin_frame() {
    for (Entry& entry : entries_) {
        entry.solid_urgency = 0.0;
        for (Way& way : entry.ways) {
            way.urgency = 0.0;
            way.is_shown = false;
        }
    }
}

void RoomModels::want(std::size_t model, std::size_t way, double urgency) {
    double& present = entries_[model].ways[way].urgency;
    present = std::max(present, urgency);
}

void RoomModels::want_solid(std::size_t model, double urgency) {
    double& present = entries_[model].solid_urgency;
    present = std::max(present, urgency);
}

void RoomModels::keep(std::size_t model, std::size_t way) {
    entries_[model].ways[way].is_shown = true;
}

Result<RoomModels::Item> RoomModels::read(const Place& place) const {
    const KnownModel& known = *entries_[place.model].known;
    if (place.way == known.ways.size()) {
        TRY(std::optional<scene::BoxCorners> solid, read_solid(known));
        return Item(solid);
    }
    TRY(ReadWay read, read_way(known, place.way));
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
        for (std::size_t way = 0; way < entry.ways.size(); ++way) {
            if (!entry.ways[way].is_there && entry.ways[way].urgency > most) {
                most = entry.ways[way].urgency;
                found = {model, way};
            }
        }
        if (!entry.is_solid_known && entry.solid_urgency > most) {
            most = entry.solid_urgency;
            found = {model, entry.ways.size()};
        }
    }
    return found;
}

void RoomModels::unload(const Place& place) {
    Way& way = entries_[place.model].ways[place.way];
    store_.release(way.placed.drawable);
    way.placed = {};
    way.is_there = false;
    bytes_ -= entries_[place.model].known->ways[place.way].bytes;
}

bool RoomModels::make_space(std::uint64_t bytes, double urgency) {
    const auto least = [&]() -> std::optional<Place> {
        std::optional<Place> found;
        double urgency_there = urgency / clearly;
        for (std::size_t model = 0; model < entries_.size(); ++model) {
            for (std::size_t way = 0; way < entries_[model].ways.size(); ++way) {
                const Way& there = entries_[model].ways[way];
                if (there.is_there && !there.is_shown && there.urgency < urgency_there) {
                    urgency_there = there.urgency;
                    found = {model, way};
                }
            }
        }
        return found;
    };
    std::uint64_t others = 0; // that may be unloaded
    for (const Entry& entry : entries_) {
        for (std::size_t way = 0; way < entry.ways.size(); ++way) {
            const bool may = entry.ways[way].is_there && !entry.ways[way].is_shown &&
                             entry.ways[way].urgency < urgency / clearly;
            others += may ? entry.known->ways[way].bytes : 0;
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
    const bool is_solid = place.way == entry.ways.size();
    if (!is_solid) {
        bytes_ -= entry.known->ways[place.way].bytes;
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
    ReadWay read = std::get<ReadWay>(std::move(*item));
    entry.known->ways[place.way].bytes = read.bytes;
    if (!make_space(read.bytes, entry.ways[place.way].urgency)) {
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
        bytes_ -= known.ways[place.way].bytes;
        give_up(place, sent.error());
        upload_.reset();
        return;
    }
    if (!upload_->upload.done()) {
        return;
    }
    Way& way = entries_[place.model].ways[place.way];
    way.placed = {.triangles = upload_->triangles,
                  .box_size = known.box_size,
                  .metres_per_box = 1.0,
                  .drawable = store_.keep(std::move(upload_->upload))};
    way.placed.relief = upload_->relief;
    way.is_there = true;
    loaded_.push_back(known.file.stem().string() + " " + known.ways[place.way].name);
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
        if (next->way < entry.ways.size()) {
            const std::uint64_t bytes = entry.known->ways[next->way].bytes;
            if (!make_space(bytes, entry.ways[next->way].urgency)) {
                entry.ways[next->way].urgency = 0.0; // not in this frame
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
