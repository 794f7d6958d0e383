#include "app/show/shown_set.h"

#include "app/settings/guided.h"
#include "app/settings/lit_zone.h"
#include "app/show/exhibit_place.h"
#include "app/show/room_show.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace frustumscreen::show {

namespace {

/// Type size of advice relative to a caption's.
constexpr double advice_em = 1.5;

/// Without its texts the exhibit shows signs alone, and a note says why.
AdviceWords read_words(const settings::Settings& settings, const SetOptions& options,
                       const SetRequest& request, ShownSet& set) {
    residency::TextStyle style = residency::text_style(settings);
    style.em_m *= advice_em;
    AdviceWords words;
    if (settings::guides_visitors(settings) && !settings.exhibit.words.empty()) {
        AdviceWordsRequest wanted{.file = settings.exhibit.words,
                                  .languages = {settings.exhibit.language},
                                  .em_m = style.em_m,
                                  .texels_per_m = style.texels_per_m,
                                  .spoken = settings.sound.kind != settings::SoundKind::None,
                                  .room = settings.screen.exists()};
        for (const exhibit::CatalogueEntry& artifact : set.catalogue) {
            if (options.devices.language) {
                wanted.languages.insert(wanted.languages.end(), artifact.languages.begin(),
                                        artifact.languages.end());
            }
        }
        Result<AdviceWords> read = read_advice_words(wanted);
        if (read) {
            words = std::move(*read);
        } else {
            set.notes.push_back("guidance shows signs without words: " + read.error().message);
        }
    }
    if (Result<void> line = set_attract_line(request.attract, settings.exhibit.language, style, words);
        !line) {
        set.notes.push_back("the set's own line is not shown: " + line.error().message);
    }
    return words;
}

TableShow read_table(const settings::Settings& settings, const SetOptions& options,
                     std::span<const residency::KnownArtifact> artifacts) {
    if (!settings::chooses_on_table(settings) || artifacts.size() < 2) {
        return {};
    }
    TableShow::Request request{{}, options.devices.language};
    for (const residency::KnownArtifact& artifact : artifacts) {
        request.packs.push_back(artifact.file);
    }
    return TableShow::read(settings, request);
}

void expect(const ExpectedFrames& frames, const residency::KnownArtifact& known,
            residency::RunLevels& levels) {
    scene::PlanView seen = frames.view;
    seen.eyes_m = std::span(&frames.eye_m, 1);
    seen.light = known.plan.light;
    levels.start(frames.cost, frames.prop, seen);
}

/// True if windows show an artifact in a layer's colours.
bool has_layer(const residency::KnownArtifact& known) {
    return std::any_of(known.states.begin(), known.states.end(),
                       [](const pack::PackState& state) { return state.layer.has_value(); });
}

/// Torches' contents take at most a quarter of `exhibit.memory_mb`.
constexpr std::uint64_t share_of_torches = 4;

} // namespace

Result<std::unique_ptr<ShownSet>> open_set(const settings::Settings& settings, const SetOptions& options,
                                           const SetRequest& request,
                                           const std::optional<ExpectedFrames>& frames) {
    const double deadline_ms = 1e3 / settings.projector.refresh_hz;
    const bool table =
        settings::chooses_on_table(settings) && options.devices.other_packs && request.packs.size() > 1;
    TRY(residency::OpenedArtifacts opened,
        residency::open_artifacts(settings, request.packs,
                                  {.technique = options.technique,
                                   .samples = options.samples,
                                   .cull_kinds = options.cull_kinds,
                                   .other_languages = options.devices.language,
                                   .other_packs = options.devices.other_packs,
                                   .table_pictures = table,
                                   .max_blocks_on_gpu = options.max_blocks_on_gpu,
                                   .deadline_ms = deadline_ms,
                                   .program = options.program,
                                   .packs_key = request.packs_key,
                                   .goes_on = request.goes_on}));
    auto set = std::make_unique<ShownSet>();
    set->number = request.number;
    set->catalogue = residency::catalogue_of(opened.known);
    set->languages = std::move(opened.languages);
    set->notes = std::move(opened.notes);
    set->needs = std::move(opened.needs);
    for (const residency::KnownArtifact& known : opened.known) {
        const std::string& id = known.outline.description.id;
        set->names.push_back(id.empty() ? known.file.string() : id);
    }
    const geometry::PropShape prop = settings::make_prop(settings.prop);
    for (std::size_t k = 0; k < opened.known.size(); ++k) {
        const pack::PackDescription& description = opened.known[k].outline.description;
        set->in_prop.push_back({set->names[k], pack::place(description, prop).metres_per_box});
    }
    set->words = read_words(settings, options, request, *set);
    set->word_pictures = residency::LoadedTexts(std::exchange(set->words.pictures, {}));
    set->table = read_table(settings, options, opened.known);
    set->notes.insert(set->notes.end(), set->table.notes().begin(), set->table.notes().end());
    if (frames) {
        set->browser = exhibit::lay_out_catalogue(set->catalogue, exhibit_place(settings));
        expect(*frames, opened.known.front(), opened.first->levels);
    }
    const double share = settings.screen.exists() ? 1.0 - RoomShow::room_share : 1.0;
    const auto whole = static_cast<std::uint64_t>(share * 1e6 * settings.exhibit.memory_mb);
    const bool layers = std::any_of(opened.known.begin(), opened.known.end(), has_layer);
    const std::uint64_t thrown = settings.torch.exists() || layers ? whole / share_of_torches : 0;
    const std::uint64_t budget = whole - thrown;
    if (settings.torch.exists() || layers) {
        TRY(std::vector<residency::ThrownContents> contents, residency::thrown_contents(opened.known));
        for (residency::ThrownContents& each : contents) {
            if (!settings.torch.exists()) {
                each.torches.contents.clear();
            }
        }
        set->torch_contents = std::make_unique<residency::TorchContents>(
            std::move(contents), residency::TorchContents::Options{.max_bytes = thrown,
                                                                   .waits = options.waits,
                                                                   .program = options.program});
    }
    const std::uint64_t stays = options.gpu_bytes_that_stay + set->planned_gpu_bytes();
    set->artifact_cache = std::make_unique<residency::ArtifactCache>(
        residency::ArtifactCacheSetUp{.artifacts = std::move(opened.known),
                                      .technique = options.technique,
                                      .deadline_ms = deadline_ms,
                                      .budget_bytes = budget - std::min(budget, stays),
                                      .style = residency::text_style(settings),
                                      .language = settings.exhibit.language,
                                      .waits = options.waits,
                                      .program = options.program,
                                      .left_out = std::move(opened.left_out)},
        std::move(*opened.first));
    if (frames) {
        set->artifact_cache->start(frames->cost, frames->prop, frames->view, frames->eye_m);
    }
    return set;
}

/// Small pictures that are visible at once come first.
Result<void> ShownSet::upload(render::GpuStore& store, const residency::CacheRequest& request,
                              std::uint64_t max_bytes) {
    if (!word_pictures.ready()) {
        return word_pictures.upload(store, max_bytes);
    }
    if (!table.ready()) {
        table.upload(store, max_bytes);
        return {};
    }
    artifact_cache->step(store, request);
    return {};
}

bool ShownSet::ready(const residency::CacheRequest& request) const {
    return word_pictures.ready() && table.ready() && artifact_cache->has(request);
}

bool ShownSet::release_some(render::GpuStore& store) {
    if (!std::exchange(words_released_, true)) {
        word_pictures.release(store);
        if (torch_contents) {
            torch_contents->release(store);
        }
        return true;
    }
    return table.release_some(store) || artifact_cache->release_some(store);
}

scene::TextureId ShownSet::word(const exhibit::WordIndex& word, std::size_t shape) const {
    return word_pictures.texture(words.words[word.language][word.text].first_picture + shape);
}

residency::SharedRecording ShownSet::recording(const exhibit::WordIndex& word) const {
    return words.words[word.language][word.text].recording;
}

bool ShownSet::speaks() const {
    for (const std::vector<AdviceWord>& language : words.words) {
        for (const AdviceWord& word : language) {
            if (word.recording) {
                return true;
            }
        }
    }
    for (std::size_t artifact = 0; artifact < artifact_cache->size(); ++artifact) {
        for (const residency::SharedRecording& recording : artifact_cache->known(artifact).texts.recordings) {
            if (recording) {
                return true;
            }
        }
    }
    return false;
}

} // namespace frustumscreen::show
