#include "app/residency/torch_contents.h"

#include "app/image/light_mips.h"
#include "app/residency/thrown_layer.h"
#include "firmware_host/base/standard_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustumscreen::residency {

namespace {

constexpr std::size_t frames_from = 64; ///< of an artifact's items; before them pictures, films and layers
constexpr std::size_t films_from = 32, layers_from = 48;
constexpr std::size_t frames_of_film = 1024;
constexpr std::size_t items_of_artifact = frames_from + frames_of_film * pack::max_films;

std::uint64_t bytes_of(const image::Image8& picture) {
    return std::uint64_t{4} * static_cast<std::uint64_t>(picture.width) *
           static_cast<std::uint64_t>(picture.height);
}

std::uint64_t bytes_of(std::span<const image::Image8> pictures) {
    std::uint64_t bytes = 0;
    for (const image::Image8& picture : pictures) {
        bytes += bytes_of(picture);
    }
    return bytes;
}

std::uint64_t bytes_of(const ReadLayer& layer) {
    std::uint64_t bytes = bytes_of(std::span(layer.textures)) * 4 / 3;
    for (const auto& relief : layer.reliefs) {
        bytes += sizeof(glm::u8vec4) * relief->size();
    }
    for (const ReadLayer& cell : layer.cells) {
        bytes += bytes_of(cell);
    }
    return bytes;
}

bool uses(const torch::Content& content, torch::Source source, std::size_t item) {
    return std::any_of(content.stages.begin(), content.stages.end(), [&](const torch::Stage& stage) {
        return stage.source == source && stage.item == item;
    });
}

} // namespace

TorchContents::TorchContents(std::vector<ThrownContents> artifacts, const Options& options)
    : artifacts_(std::move(artifacts)), options_(options) {
    if (!options_.waits) {
        reader_ = std::make_unique<Reader>(
            [this](std::size_t item, const Reader::GivenUp&) { return read(item); }, "torches");
    }
}

TorchContents::~TorchContents() = default;

std::size_t TorchContents::item_of(std::size_t artifact, const Part& part) {
    const std::size_t from = items_of_artifact * artifact;
    switch (part.kind) {
    case Kind::Picture:
        return from + part.number;
    case Kind::Film:
        return from + films_from + part.number;
    case Kind::Layer:
        return from + layers_from + part.number;
    case Kind::Frame:
        break;
    }
    return from + frames_from + frames_of_film * part.number + part.frame;
}

std::pair<std::size_t, TorchContents::Part> TorchContents::part_of(std::size_t item) {
    const std::size_t artifact = item / items_of_artifact;
    const std::size_t within = item % items_of_artifact;
    if (within >= frames_from) {
        return {
            artifact,
            {Kind::Frame, (within - frames_from) / frames_of_film, (within - frames_from) % frames_of_film}};
    }
    if (within >= layers_from) {
        return {artifact, {Kind::Layer, within - layers_from, 0}};
    }
    return {artifact,
            within >= films_from ? Part{Kind::Film, within - films_from, 0} : Part{Kind::Picture, within, 0}};
}

Result<TorchContents::Read> TorchContents::read(std::size_t item) {
    const auto [artifact, part] = part_of(item);
    const ThrownContents& thrown = artifacts_[artifact];
    const std::filesystem::path& file = thrown.file;
    const pack::PackTorches& torches = thrown.torches;
    if (packed_of_ != artifact) {
        packed_.clear();
        packed_of_ = artifact;
    }
    switch (part.kind) {
    case Kind::Picture: {
        TRY(const image::Image8 picture, pack::load_torch_picture(file, torches.pictures[part.number]));
        std::vector<image::Image8> mips = image::cut_out_mips(picture);
        const auto fits = std::find_if(mips.begin(), mips.end(), [](const image::Image8& mip) {
            return bytes_of(mip) <= max_upload_bytes;
        });
        mips.erase(mips.begin(), fits);
        return Read(ReadPicture{std::move(mips)});
    }
    case Kind::Film: {
        TRY(std::vector<Bytes> frames, pack::load_film(file, torches.films[part.number]));
        ReadFilm film;
        TRY(const image::Image8 first, pack::film_frame_of(torches.films[part.number], frames.front()));
        film.first = image::cut_out_mips(first);
        for (const Bytes& frame : frames) {
            film.packed_bytes += frame.size();
        }
        packed_[part.number] = std::move(frames);
        return Read(std::move(film));
    }
    case Kind::Layer: {
        TRY(ReadLayer layer, read_layer(thrown, part.number));
        return Read(std::move(layer));
    }
    case Kind::Frame:
        break;
    }
    const auto frames = packed_.find(part.number);
    if (frames == packed_.end()) {
        return bad_input("torches.film_not_wanted", "not wanted any more");
    }
    TRY(const image::Image8 picture,
        pack::film_frame_of(torches.films[part.number], frames->second.at(part.frame)));
    return Read(ReadFrame{std::move(image::cut_out_mips(picture).front())}); // its colours over black
}

void TorchContents::leave_out(const Part& part, std::string_view why) {
    (part.kind == Kind::Picture ? picture_states_
     : part.kind == Kind::Layer ? layer_states_
                                : film_states_)[part.number] = PartState::LeftOut;
    say_line(options_.program, fmt::format("a torch's content is left out: {}", why));
}

TorchContents::PartState TorchContents::state(const Part& part) const {
    return (part.kind == Kind::Picture ? picture_states_
            : part.kind == Kind::Layer ? layer_states_
                                       : film_states_)[part.number];
}

Result<void> TorchContents::upload(render::GpuStore& store, const Part& part, Read read) {
    if (auto* const picture = std::get_if<ReadPicture>(&read)) {
        TRY(pictures_[part.number], store.upload_picture(picture->mips));
        picture_states_[part.number] = PartState::Ready;
    } else if (auto* const film = std::get_if<ReadFilm>(&read)) {
        TRY(films_[part.number].texture, store.upload_picture(film->first));
        film_states_[part.number] = PartState::Ready;
    } else if (auto* const layer = std::get_if<ReadLayer>(&read)) {
        layer_ = std::move(*layer);
        layer_states_[part.number] = PartState::Read;
    } else if (auto* const frame = std::get_if<ReadFrame>(&read)) {
        films_[part.number].ahead = std::move(frame->picture);
        films_[part.number].ahead_frame = part.frame;
    }
    return {};
}

void TorchContents::receive(render::GpuStore& store, std::size_t item, Result<Read> read) {
    const auto [artifact, part] = part_of(item);
    if (artifact_ != artifact || state(part) == PartState::LeftOut) {
        return;
    }
    if (!read) {
        leave_out(part, read.error().message);
        return;
    }
    std::uint64_t bytes = 0;
    if (const auto* const picture = std::get_if<ReadPicture>(&*read)) {
        bytes = bytes_of(picture->mips);
    } else if (const auto* const film = std::get_if<ReadFilm>(&*read)) {
        bytes = film->packed_bytes +
                3 * bytes_of(std::span(film->first)); // on the GPU, decoded ahead, being decoded
    } else if (const auto* const layer = std::get_if<ReadLayer>(&*read)) {
        bytes = bytes_of(*layer);
    }
    if (bytes_ + bytes > options_.max_bytes) {
        leave_out(part, fmt::format("{} needs {} MB more than there are for torches; raise exhibit.memory_mb",
                                    artifacts_[artifact].file.string(),
                                    (bytes_ + bytes - options_.max_bytes) / 1'000'000 + 1));
        return;
    }
    bytes_ += bytes;
    if (const Result<void> uploaded = upload(store, part, std::move(*read)); !uploaded) {
        leave_out(part, uploaded.error().message);
    }
}

std::optional<TorchContents::Part> TorchContents::next_of(const torch::Content& content) const {
    for (const torch::Stage& stage : content.stages) {
        const std::optional<Kind> kind = stage.source == torch::Source::Picture ? std::optional(Kind::Picture)
                                         : stage.source == torch::Source::Film  ? std::optional(Kind::Film)
                                         : stage.source == torch::Source::Layer ? std::optional(Kind::Layer)
                                                                                : std::nullopt;
        if (kind && state({*kind, stage.item, 0}) == PartState::Absent) {
            return Part{*kind, stage.item, 0};
        }
    }
    return std::nullopt;
}

std::optional<TorchContents::Part> TorchContents::next(std::span<const WantedContent> wanted,
                                                       std::span<const std::size_t> layers) const {
    const pack::PackTorches& torches = artifacts_[*artifact_].torches;
    for (std::size_t k = 0; k < films_.size(); ++k) {
        const Film& film = films_[k];
        const std::size_t frames = torches.films[k].frames;
        const std::size_t ahead = (film.due + (film.shown == film.due ? 1 : 0)) % frames;
        if (film.runs && film_states_[k] == PartState::Ready && ahead != film.shown &&
            film.ahead_frame != ahead) {
            return Part{Kind::Frame, k, ahead};
        }
    }
    for (const WantedContent& each : wanted) {
        if (const std::optional<Part> part = next_of(torches.contents[each.content].content)) {
            return part;
        }
    }
    for (const std::size_t layer : layers) {
        if (const Part part{Kind::Layer, layer, 0}; state(part) == PartState::Absent) {
            return part;
        }
    }
    if (options_.waits || layer_) {
        return std::nullopt;
    }
    for (const pack::PackTorchContent& content : torches.contents) {
        if (const std::optional<Part> part = next_of(content.content)) {
            return part;
        }
    }
    return std::nullopt;
}

void TorchContents::run_films(render::GpuStore& store, std::span<const WantedContent> wanted) {
    const pack::PackTorches& torches = artifacts_[*artifact_].torches;
    for (std::size_t k = 0; k < films_.size(); ++k) {
        Film& film = films_[k];
        const auto throws = std::find_if(wanted.begin(), wanted.end(), [&](const WantedContent& each) {
            return uses(torches.contents[each.content].content, torch::Source::Film, k);
        });
        film.runs = throws != wanted.end();
        if (!film.runs || film_states_[k] != PartState::Ready) {
            continue;
        }
        const double frames = torches.films[k].frames;
        film.due = static_cast<std::size_t>(
            std::fmod(std::floor(throws->seconds * torches.films[k].rate_hz), frames));
        // A frame ahead waits until it is due; one that was due earlier is better than none.
        const bool is_ahead =
            film.ahead_frame == (film.due + 1) % torches.films[k].frames && film.shown == film.due;
        if (film.ahead_frame && !is_ahead) {
            store.replace_picture(film.texture, film.ahead);
            film.shown = *std::exchange(film.ahead_frame, std::nullopt);
            ++film.version;
        }
    }
}

void TorchContents::step(render::GpuStore& store, std::size_t artifact, std::span<const WantedContent> wanted,
                         std::span<const std::size_t> layers) {
    if (artifact_ != artifact) {
        release(store);
        artifact_ = artifact;
        const pack::PackTorches& torches = artifacts_[artifact].torches;
        picture_states_.assign(torches.pictures.size(), PartState::Absent);
        film_states_.assign(torches.films.size(), PartState::Absent);
        layer_states_.assign(torches.layers.size(), PartState::Absent);
        pictures_.assign(torches.pictures.size(), scene::TextureId::None);
        films_.assign(torches.films.size(), Film{});
    }
    if (reader_) {
        if (std::unique_ptr<Reader::Answer> answer = reader_->take()) {
            receive(store, answer->item, std::move(answer->prepared));
        }
        run_films(store, wanted);
        const std::optional<Part> part = next(wanted, layers);
        reader_->request(part ? std::optional(item_of(artifact, *part)) : std::nullopt);
        return;
    }
    run_films(store, wanted);
    for (std::optional<Part> part = next(wanted, layers); part && !layer_; part = next(wanted, layers)) {
        const std::size_t item = item_of(artifact, *part);
        receive(store, item, read(item));
        run_films(store, wanted);
    }
}

std::optional<ReadLayer> TorchContents::take_layer() {
    return std::exchange(layer_, std::nullopt);
}

void TorchContents::note_layer(std::size_t layer, const Result<void>& uploaded) {
    if (!uploaded) {
        leave_out({Kind::Layer, layer, 0}, uploaded.error().message);
    } else {
        layer_states_.at(layer) = PartState::Ready;
    }
}

void TorchContents::release(render::GpuStore& store) {
    for (const scene::TextureId picture : pictures_) {
        if (picture != scene::TextureId::None) {
            store.release(picture);
        }
    }
    for (const Film& film : films_) {
        if (film.texture != scene::TextureId::None) {
            store.release(film.texture);
        }
    }
    pictures_.clear();
    films_.clear();
    layer_.reset();
    bytes_ = 0;
    artifact_.reset();
    if (reader_) {
        reader_->request(std::nullopt);
    }
}

const torch::Content* TorchContents::find(std::size_t artifact, std::size_t content) const {
    return artifact < artifacts_.size() && content < artifacts_[artifact].torches.contents.size()
               ? &artifacts_[artifact].torches.contents[content].content
               : nullptr;
}

TorchContents::Shown TorchContents::shown(std::size_t content) const {
    Shown shown;
    if (!artifact_ || find(*artifact_, content) == nullptr) {
        return shown;
    }
    shown.ready = true;
    for (const torch::Stage& stage : find(*artifact_, content)->stages) {
        switch (stage.source) {
        case torch::Source::Picture:
            shown.ready = shown.ready && picture_states_[stage.item] == PartState::Ready;
            shown.picture = pictures_[stage.item];
            break;
        case torch::Source::Film:
            shown.ready = shown.ready && film_states_[stage.item] == PartState::Ready;
            shown.picture = films_[stage.item].texture;
            shown.version = films_[stage.item].version;
            break;
        case torch::Source::Layer:
            shown.ready = shown.ready && layer_states_[stage.item] == PartState::Ready;
            break;
        default:
            break;
        }
    }
    return shown;
}

} // namespace frustumscreen::residency
