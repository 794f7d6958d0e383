#include "app/residency/artifact_cache.h"

#include "firmware_host/base/spare_memory.h"
#include "firmware_host/base/standard_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>
#include <utility>

namespace frustumscreen::residency {

namespace {

/// Mean size of an artifact's textures.
std::uint64_t texture_bytes_of(const PreparedArtifact& artifact) {
    std::uint64_t bytes = 0;
    std::size_t textures = 0;
    for (const scene::LevelData& level : artifact.data) {
        textures += level.mips.empty() ? 0 : 1;
        for (const image::Image8& mip : level.mips) {
            bytes += mip.texels.size() * sizeof(glm::u8vec4);
        }
    }
    return bytes / std::max<std::size_t>(textures, 1);
}

} // namespace

ArtifactCache::ArtifactCache(ArtifactCacheSetUp set_up, PreparedArtifact first)
    : set_up_(std::move(set_up)), states_(set_up_.artifacts.size(), exhibit::ArtifactState::Away),
      left_out_(std::make_shared<const std::vector<library::UnshownPack>>(set_up_.left_out)) {
    const std::uint64_t texture_bytes = texture_bytes_of(first);
    for (std::size_t artifact = 0; artifact < size(); ++artifact) {
        const KnownArtifact& of = known(artifact);
        first_items_.push_back(items_.size());
        items_.push_back({artifact, std::nullopt, 0});
        records_.push_back({expected_bytes(of, texture_bytes)});
        for (std::size_t language = 0; language < of.texts.entry.languages.size(); ++language) {
            for (const TextPart part : {TextPart::Caption, TextPart::Narration}) {
                items_.push_back({artifact, part, language});
                records_.push_back({text_bytes(of.texts.entry, part, language, set_up_.style)});
            }
        }
        first_pages_.push_back(items_.size());
        for (const PageName& page : of.world ? pages_of(*of.world) : std::vector<PageName>()) {
            items_.push_back({artifact, std::nullopt, 0, page});
            records_.push_back({expected_page_bytes(*of.world, page, texture_bytes)});
        }
    }
    loaded_.resize(items_.size());
    receive(0, std::move(first));
}

Result<void> ArtifactCache::upload_first(render::GpuStore& store) {
    Queue seen_first;
    seen_first.add(levels_item(0));
    add_text(seen_first, 0, TextPart::Caption, set_up_.language);
    for (const std::size_t item : seen_first.items()) {
        if (item != 0) {
            Result<ArtifactReader::Prepared> texts = prepare(item, [] { return false; });
            if (!texts) {
                say_left_out(item, texts.error().message);
            }
            receive(item, std::move(texts));
        }
        while (arrives(item)) {
            if (Result<void> done = upload(store, item, std::numeric_limits<std::uint64_t>::max()); !done) {
                release(store, 0);
                return done;
            }
        }
    }
    return {};
}

ArtifactCache::~ArtifactCache() = default;

Result<ArtifactReader::Prepared> ArtifactCache::prepare(std::size_t item,
                                                        const ArtifactReader::GivenUp& given_up) const {
    const Item& of = items_[item];
    if (of.part) {
        return prepare_texts(known(of.artifact), *of.part, of.language, set_up_.style, given_up);
    }
    if (of.page) {
        TRY(PreparedPage page, prepare_page(known(of.artifact).file, *known(of.artifact).world, *of.page));
        return page;
    }
    return prepare_artifact(known(of.artifact), set_up_.technique, set_up_.deadline_ms, given_up);
}

void ArtifactCache::start(const scene::FrameCost& cost, const geometry::PropShape& prop,
                          const scene::PlanView& view, const glm::dvec3& eye_m) {
    return_spare_memory(); // of reading the first artifact, and of a software driver that drew all of its levels
    if (std::none_of(records_.begin(), records_.end(),
                     [](const ResidentItem& item) { return !item.loaded && item.bytes > 0; })) {
        return;
    }
    reader_ = std::make_unique<ArtifactReader>([this, cost, prop, view, eye_m, after_levels = false](
                                                   std::size_t item,
                                                   const ArtifactReader::GivenUp& given_up) mutable {
        if (std::exchange(after_levels, items_[item].is_levels())) {
            return_spare_memory(); // of the levels read before
        }
        Result<ArtifactReader::Prepared> prepared = prepare(item, given_up);
        if (!prepared && !given_up()) {
            say_left_out(item, prepared.error().message);
        }
        if (PreparedArtifact* const levels = prepared ? std::get_if<PreparedArtifact>(&*prepared) : nullptr) {
            scene::PlanView seen = view;
            seen.eyes_m = std::span(&eye_m, 1);
            seen.light = known(items_[item].artifact).plan.light;
            levels->levels.start(cost, prop, seen);
            if (levels->cells) {
                levels->cells->start(cost);
            }
        }
        return prepared;
    });
}

void ArtifactCache::step(render::GpuStore& store, const CacheRequest& request) {
    step_once(store, request);
    while (set_up_.waits && !steady_) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        step_once(store, request);
    }
}

void ArtifactCache::step_once(render::GpuStore& store, const CacheRequest& request) {
    note_shown(request);
    if (const std::unique_ptr<ArtifactReader::Answer> answer = reader_ ? reader_->take() : nullptr) {
        receive(answer->item, std::move(answer->prepared));
    }
    const Queue needs = needed(request);
    const Queue wants = wanted(request);
    const ResidencyStep next = next_step(records_, needs.items(), wants.items(), set_up_.budget_bytes);
    const bool is_seen = next.release && !release_if_unseen(store, *next.release);
    std::optional<std::size_t> load = next.load;
    if (is_seen) { // other items are released first; a needed item is loaded in any case
        records_[*next.release].last_shown = shows_;
        load = next_step(records_, needs.items(), {}, std::numeric_limits<std::uint64_t>::max()).load;
    }
    if (reader_ && (!next.release || is_seen)) {
        reader_->request(load);
    }
    upload(store, needs.items(), wants.items());
    bool arriving = false;
    for (std::size_t item = 0; item < items_.size(); ++item) {
        arriving = arriving || arrives(item);
    }
    steady_ = (!next.release || is_seen) && (!load || !reader_) && !arriving;
}

bool ArtifactCache::has(const CacheRequest& request) const {
    const Queue needs = needed(request);
    return std::all_of(needs.items().begin(), needs.items().end(), [&](std::size_t item) {
        return records_[item].left_out || (loaded_[item] && !arrives(item));
    });
}

bool ArtifactCache::release_some(render::GpuStore& store) {
    if (reader_) {
        reader_->request(std::nullopt);
    }
    for (std::size_t artifact = 0; artifact < size(); ++artifact) {
        const std::size_t begin = levels_item(artifact);
        const std::size_t end = artifact + 1 < size() ? first_items_[artifact + 1] : items_.size();
        for (std::size_t item = begin; item < end; ++item) {
            if (loaded_[item]) {
                release(store, levels(artifact) != nullptr ? begin : item);
                return true;
            }
        }
    }
    return false;
}

void ArtifactCache::receive(std::size_t item, Result<ArtifactReader::Prepared> prepared) {
    if (records_[item].loaded || records_[item].left_out) {
        return;
    }
    if (!prepared) {
        leave_out(item, prepared.error().message);
        return;
    }
    if (auto* const levels = std::get_if<PreparedArtifact>(&*prepared)) {
        expect_pages(items_[item].artifact, *levels);
        loaded_[item] = std::make_unique<Loaded>(LoadedLevels(std::move(*levels)));
    } else if (auto* const page = std::get_if<PreparedPage>(&*prepared)) {
        if (this->levels(items_[item].artifact) == nullptr) {
            return; // the artifact was released meanwhile
        }
        loaded_[item] =
            std::make_unique<Loaded>(LoadedPage(std::move(*page), known(items_[item].artifact).plan.eyes));
    } else {
        loaded_[item] = std::make_unique<Loaded>(LoadedTexts(std::move(std::get<TextPictures>(*prepared))));
    }
    records_[item].bytes = std::visit([](const auto& each) { return each.bytes(); }, *loaded_[item]);
    records_[item].loaded = true;
}

void ArtifactCache::expect_pages(std::size_t artifact, const PreparedArtifact& levels) {
    const std::size_t end = artifact + 1 < size() ? first_items_[artifact + 1] : items_.size();
    for (std::size_t item = first_pages_[artifact]; levels.cells && item < end; ++item) {
        records_[item].bytes =
            expected_page_bytes(*known(artifact).world, *items_[item].page,
                                levels.cells->page_texture_bytes(items_[item].page->place));
    }
}

bool ArtifactCache::arrives(std::size_t item) const {
    return loaded_[item] && !std::visit([](const auto& each) { return each.ready(); }, *loaded_[item]);
}

/// Uploads the most urgent item that is prepared but not ready; unwanted items come last.
void ArtifactCache::upload(render::GpuStore& store, std::span<const std::size_t> needed,
                           std::span<const std::size_t> wanted) {
    const auto first_of = [&](std::span<const std::size_t> items) {
        const auto found =
            std::find_if(items.begin(), items.end(), [&](std::size_t item) { return arrives(item); });
        return found != items.end() ? std::optional(*found) : std::nullopt;
    };
    const std::optional<std::size_t> urgent = first_of(needed);
    std::optional<std::size_t> next = urgent ? urgent : first_of(wanted);
    for (std::size_t item = 0; item < items_.size() && !next; ++item) {
        next = arrives(item) ? std::optional(item) : std::nullopt;
    }
    if (!next) {
        return;
    }
    if (const Result<void> done = upload(store, *next, urgent ? urgent_bytes : early_bytes); !done) {
        const std::string reason = known(items_[*next].artifact).file.string() + ": " + done.error().message;
        say_left_out(*next, reason);
        release(store, *next);
        leave_out(*next, reason);
    }
}

Result<void> ArtifactCache::upload(render::GpuStore& store, std::size_t item, std::uint64_t max_bytes) {
    TRY_VOID(std::visit([&](auto& each) { return each.upload(store, max_bytes); }, *loaded_[item]));
    const std::size_t artifact = items_[item].artifact;
    if (items_[item].is_levels() && !arrives(item)) {
        states_[artifact] = exhibit::ArtifactState::Ready;
    }
    if (const LoadedPage* const page = std::get_if<LoadedPage>(loaded_[item].get());
        page != nullptr && page->ready()) {
        page->give_to(*levels(artifact)->artifact.cells, store);
    }
    return {};
}

bool ArtifactCache::release_if_unseen(render::GpuStore& store, std::size_t item) {
    const std::optional<PageName>& page = items_[item].page;
    if (page && !arrives(item) && !levels(items_[item].artifact)->artifact.cells->let_go(page->place)) {
        return false;
    }
    release(store, item);
    return true;
}

/// Releasing an artifact's levels also releases its texts and pages.
void ArtifactCache::release(render::GpuStore& store, std::size_t item) {
    const std::size_t artifact = items_[item].artifact;
    std::size_t end = item + 1;
    if (items_[item].page && !arrives(item)) {
        levels(artifact)->artifact.cells->take_page(items_[item].page->place);
    }
    if (const LoadedLevels* const gone = items_[item].is_levels() ? levels(artifact) : nullptr) {
        const LevelState state = gone->artifact.levels.state();
        past_switches_ += gone->switches();
        past_ignored_times_ += state.ignored_times;
        states_[artifact] = exhibit::ArtifactState::Away;
        end = artifact + 1 < size() ? first_items_[artifact + 1] : items_.size();
    }
    for (std::size_t each = item; each < end; ++each) {
        if (loaded_[each]) {
            std::visit([&](auto& loaded) { loaded.release(store); }, *loaded_[each]);
            loaded_[each].reset();
            records_[each].loaded = false;
        }
    }
}

void ArtifactCache::leave_out(std::size_t item, const std::string& reason) {
    records_[item].left_out = true;
    if (items_[item].is_levels()) {
        const std::size_t artifact = items_[item].artifact;
        states_[artifact] = exhibit::ArtifactState::Unusable;
        auto more = std::make_shared<std::vector<library::UnshownPack>>(*left_out_);
        more->push_back(library::unshown_pack(known(artifact).file.string(), reason));
        left_out_ = std::move(more);
    }
}

void ArtifactCache::say_left_out(std::size_t item, const std::string& reason) const {
    say_line(set_up_.program, fmt::format("{}: {}",
                                          items_[item].part   ? "texts left out"
                                          : items_[item].page ? "a region's finer level left out"
                                                              : "left out",
                                          reason));
}

LoadedLevels* ArtifactCache::levels(std::size_t artifact) const {
    return std::get_if<LoadedLevels>(loaded_[levels_item(artifact)].get());
}

RunLevels* ArtifactCache::find(std::size_t artifact) {
    return states_[artifact] == exhibit::ArtifactState::Ready ? &levels(artifact)->artifact.levels : nullptr;
}

const RunLevels* ArtifactCache::find(std::size_t artifact) const {
    return const_cast<ArtifactCache*>(this)->find(artifact);
}

RunCells* ArtifactCache::find_cells(std::size_t artifact) const {
    return find(artifact) != nullptr ? levels(artifact)->artifact.cells.get() : nullptr;
}

double ArtifactCache::exposure(std::size_t artifact) const {
    const LoadedLevels* const loaded = levels(artifact);
    return loaded != nullptr ? loaded->artifact.exposure : 1.0;
}

exhibit::ArtifactTriangles ArtifactCache::triangles(std::size_t artifact) const {
    return find(artifact) != nullptr ? levels(artifact)->artifact.triangles : exhibit::ArtifactTriangles{};
}

const LoadedTexts* ArtifactCache::texts(std::size_t artifact, TextPart part, std::size_t language) const {
    return std::get_if<LoadedTexts>(loaded_[text_item(artifact, part, language)].get());
}

std::size_t ArtifactCache::ready() const {
    return static_cast<std::size_t>(
        std::count(states_.begin(), states_.end(), exhibit::ArtifactState::Ready));
}

std::uint64_t ArtifactCache::bytes() const {
    std::uint64_t bytes = 0;
    for (const ResidentItem& record : records_) {
        bytes += record.loaded ? record.bytes : 0;
    }
    return bytes;
}

std::uint64_t ArtifactCache::uploaded_text_bytes() const {
    std::uint64_t bytes = 0;
    for (const std::unique_ptr<Loaded>& each : loaded_) {
        const LoadedTexts* const texts = std::get_if<LoadedTexts>(each.get());
        bytes += texts != nullptr ? texts->uploaded_bytes() : 0;
    }
    return bytes;
}

std::uint64_t ArtifactCache::switches() const {
    std::uint64_t switches = past_switches_;
    for (std::size_t artifact = 0; artifact < size(); ++artifact) {
        const LoadedLevels* const loaded = levels(artifact);
        switches += loaded != nullptr ? loaded->switches() : 0;
    }
    return switches;
}

std::uint64_t ArtifactCache::ignored_times() const {
    std::uint64_t ignored = past_ignored_times_;
    for (std::size_t artifact = 0; artifact < size(); ++artifact) {
        const LoadedLevels* const loaded = levels(artifact);
        ignored += loaded != nullptr ? loaded->artifact.levels.state().ignored_times : 0;
    }
    return ignored;
}

} // namespace frustumscreen::residency
