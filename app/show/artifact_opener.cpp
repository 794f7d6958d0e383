#include "app/show/artifact_opener.h"

#include "app/exhibit/languages.h"
#include "app/pack/pack_file.h"
#include "app/pack/prop_note.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace frustumscreen {

Catalogue catalogue_of(std::span<const ArtifactTexts> artifacts) {
    Catalogue catalogue;
    for (const ArtifactTexts& artifact : artifacts) {
        CatalogueEntry entry{artifact.languages, {}, artifact.hotspots.set};
        for (const std::vector<CaptionPicture>& shapes : artifact.captions) {
            std::vector<glm::dvec2>& sizes = entry.caption_sizes_m.emplace_back();
            std::transform(shapes.begin(), shapes.end(), std::back_inserter(sizes),
                           [](const CaptionPicture& shape) { return shape.size_m; });
        }
        catalogue.push_back(std::move(entry));
    }
    return catalogue;
}

ArtifactOpener::ArtifactOpener(const Settings& settings, Options options, GpuStore& store)
    : settings_(settings), options_(std::move(options)), store_(store),
      captions_(settings.exhibit.caption_height_m,
                settings.projector.pinhole.fx / settings.projector.table_from_projector.translation.z) {}

Result<OpenedArtifact> ArtifactOpener::open(const std::filesystem::path& file) {
    OpenedArtifact opened{{file, {}, {}}, {}};
    const Result<VerifiedPack> pack =
        load_pack(file, [&](const PackOutline& outline) -> Result<std::vector<std::uint32_t>> {
            Result<ScenePlan> plan = plan_scene(settings_, outline, request(outline));
            if (!plan) {
                return tl::unexpected<Error>(plan.error());
            }
            opened.known.outline = outline;
            opened.known.plan = std::move(*plan);
            return std::vector<std::uint32_t>{};
        });
    if (!pack) {
        return tl::unexpected<Error>(pack.error());
    }
    opened.texts.title = (*pack)->title;
    if (Result<void> set = set_captions(opened.known, opened.texts); !set) {
        close(opened.texts);
        return tl::unexpected<Error>(set.error());
    }
    for (const PackCaption& caption : (*pack)->captions) {
        add_language(languages_, caption.language);
    }
    if (const auto note = note_other_prop(file.string(), **pack, name_of(settings_.prop.kind))) {
        notes_.push_back(*note);
    }
    return opened;
}

void ArtifactOpener::close(ArtifactTexts& texts) {
    texts.hotspots.release(store_);
    for (const std::vector<CaptionPicture>& shapes : texts.captions) {
        for (const CaptionPicture& shape : shapes) {
            store_.release(shape.texture);
        }
    }
}

SceneRequest ArtifactOpener::request(const PackOutline& outline) const {
    SceneRequest request;
    request.technique = options_.technique;
    request.room = options_.samples;
    request.economies = options_.economies;
    request.visibility = visibility_of(settings_);
    request.table_pictures = options_.table_pictures;
    std::vector<std::string> languages;
    for (const PackCaption& caption : outline.description.captions) {
        request.captions.push_back(languages.size());
        languages.push_back(caption.language);
    }
    if (!options_.other_languages && !languages.empty()) {
        request.captions = {caption_for(settings_.exhibit.language, languages)};
    }
    return request;
}

/// Reads the glyph runs of the languages that are needed, and no others.
Result<void> ArtifactOpener::set_captions(const KnownArtifact& known, ArtifactTexts& texts) {
    const std::vector<PackCaption>& captions = known.outline.description.captions;
    for (const std::size_t each : known.plan.captions) {
        texts.languages.push_back(captions[each].language);
    }
    const Result<std::vector<SetLanguage>> set =
        texts.languages.empty() ? std::vector<SetLanguage>() : load_set_texts(known.file, texts.languages);
    if (!set) {
        return tl::unexpected<Error>(set.error());
    }
    for (const std::size_t each : known.plan.captions) {
        const Result<std::vector<CaptionImage>> images = captions_.set(captions[each], *set);
        if (!images) {
            return at(known.file.string(), images.error());
        }
        std::vector<CaptionPicture>& shapes = texts.captions.emplace_back();
        for (const CaptionImage& image : *images) {
            const Result<TextureId> texture = store_.upload(image.coverage);
            if (!texture) {
                return at(known.file.string(), texture.error());
            }
            shapes.push_back(
                {*texture, image.size_m, caption_gpu_bytes(image.coverage.width, image.coverage.height)});
        }
    }
    Result<HotspotPictures> hotspots = upload_hotspots(
        known.outline.description.hotspots,
        {texts.languages, *set, known.plan.metres_per_box, settings_.exhibit.caption_height_m,
         settings_.projector.pinhole.fx / settings_.projector.table_from_projector.translation.z},
        store_);
    if (!hotspots) {
        return at(known.file.string(), hotspots.error());
    }
    texts.hotspots = std::move(*hotspots);
    return {};
}

} // namespace frustumscreen
