#include "app/show/shown_set.h"

#include "app/settings/guided.h"
#include "app/settings/lit_zone.h"
#include "app/show/exhibit_place.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace frustumscreen {

namespace {

/// Type size of advice relative to a caption's.
constexpr double advice_em = 1.5;

/// Without its texts the exhibit shows signs alone, and a note says why.
AdviceWords read_words(const Settings& settings, const SetOptions& options, const SetRequest& request,
                       ShownSet& set) {
    TextStyle style = text_style(settings);
    style.em_m *= advice_em;
    AdviceWords words;
    if (guides_visitors(settings) && !settings.exhibit.words.empty()) {
        AdviceWordsRequest wanted{settings.exhibit.words,
                                  {settings.exhibit.language},
                                  style.em_m,
                                  style.texels_per_m,
                                  settings.sound.kind != SoundKind::None};
        for (const CatalogueEntry& artifact : set.catalogue) {
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

TableShow read_table(const Settings& settings, const SetOptions& options,
                     std::span<const KnownArtifact> artifacts) {
    if (!chooses_on_table(settings) || artifacts.size() < 2) {
        return {};
    }
    TableShow::Request request{{}, options.devices.language};
    for (const KnownArtifact& artifact : artifacts) {
        request.packs.push_back(artifact.file);
    }
    return TableShow::read(settings, request);
}

void expect(const ExpectedFrames& frames, const KnownArtifact& known, RunLevels& levels) {
    PlanView seen = frames.view;
    seen.eyes_m = std::span(&frames.eye_m, 1);
    seen.light = known.plan.light;
    levels.start(frames.cost, frames.prop, seen);
}

} // namespace

Result<std::unique_ptr<ShownSet>> open_set(const Settings& settings, const SetOptions& options,
                                           const SetRequest& request,
                                           const std::optional<ExpectedFrames>& frames) {
    const double deadline_ms = 1e3 / settings.projector.refresh_hz;
    const bool table = chooses_on_table(settings) && options.devices.other_packs && request.packs.size() > 1;
    TRY(OpenedArtifacts opened,
        open_artifacts(settings, request.packs,
                       {options.technique, options.samples, options.cull_kinds, options.devices.language,
                        options.devices.other_packs, table, options.max_blocks_on_gpu, deadline_ms,
                        options.program, request.packs_key, request.goes_on}));
    auto set = std::make_unique<ShownSet>();
    set->number = request.number;
    set->catalogue = catalogue_of(opened.known);
    set->languages = std::move(opened.languages);
    set->notes = std::move(opened.notes);
    set->needs = std::move(opened.needs);
    for (const KnownArtifact& known : opened.known) {
        const std::string& id = known.outline.description.id;
        set->names.push_back(id.empty() ? known.file.string() : id);
    }
    set->words = read_words(settings, options, request, *set);
    set->word_pictures = LoadedTexts(std::exchange(set->words.pictures, {}));
    set->table = read_table(settings, options, opened.known);
    set->notes.insert(set->notes.end(), set->table.notes().begin(), set->table.notes().end());
    if (frames) {
        set->browser = lay_out_catalogue(set->catalogue, exhibit_place(settings));
        expect(*frames, opened.known.front(), opened.first->levels);
    }
    const auto budget = static_cast<std::uint64_t>(settings.exhibit.memory_mb) * 1'000'000;
    const std::uint64_t stays = options.gpu_bytes_that_stay + set->planned_gpu_bytes();
    set->artifact_cache = std::make_unique<ArtifactCache>(
        ArtifactCacheSetUp{std::move(opened.known), options.technique, deadline_ms,
                           budget - std::min(budget, stays), text_style(settings), settings.exhibit.language,
                           options.waits, options.program, std::move(opened.left_out)},
        std::move(*opened.first));
    if (frames) {
        set->artifact_cache->start(frames->cost, frames->prop, frames->view, frames->eye_m);
    }
    return set;
}

/// Small pictures that are visible at once come first.
Result<void> ShownSet::upload(GpuStore& store, const CacheRequest& request, std::uint64_t max_bytes) {
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

bool ShownSet::ready(const CacheRequest& request) const {
    return word_pictures.ready() && table.ready() && artifact_cache->has(request);
}

bool ShownSet::release_some(GpuStore& store) {
    if (!std::exchange(words_released_, true)) {
        word_pictures.release(store);
        return true;
    }
    return table.release_some(store) || artifact_cache->release_some(store);
}

TextureId ShownSet::word(const WordIndex& word, std::size_t shape) const {
    return word_pictures.texture(words.words[word.language][word.text].first_picture + shape);
}

SharedRecording ShownSet::recording(const WordIndex& word) const {
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
        for (const SharedRecording& recording : artifact_cache->known(artifact).texts.recordings) {
            if (recording) {
                return true;
            }
        }
    }
    return false;
}

} // namespace frustumscreen
