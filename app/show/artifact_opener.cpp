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
        CatalogueEntry entry;
        entry.languages = artifact.languages;
        entry.hotspots = artifact.hotspots.set;
        for (const DescriptionPictures& description : artifact.descriptions) {
            entry.tellables.push_back(description.tellable);
            entry.descriptions.push_back(description.shape);
        }
        for (const std::vector<CaptionPicture>& shapes : artifact.captions) {
            std::vector<glm::dvec2>& sizes = entry.caption_sizes_m.emplace_back();
            std::transform(shapes.begin(), shapes.end(), std::back_inserter(sizes),
                           [](const CaptionPicture& shape) { return shape.size_m; });
        }
        catalogue.push_back(std::move(entry));
    }
    return catalogue;
}

std::uint64_t ArtifactTexts::planned_gpu_bytes() const {
    std::uint64_t bytes = hotspots.planned_gpu_bytes;
    for (const std::vector<CaptionPicture>& shapes : captions) {
        for (const CaptionPicture& shape : shapes) {
            bytes += shape.planned_gpu_bytes;
        }
    }
    for (const DescriptionPictures& description : descriptions) {
        bytes += description.planned_gpu_bytes;
    }
    return bytes;
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
    if (Result<void> set = set_texts(**pack, opened.known, opened.texts); !set) {
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
    for (const DescriptionPictures& description : texts.descriptions) {
        release(description, store_);
    }
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
Result<void> ArtifactOpener::set_texts(const Pack& pack, const KnownArtifact& known, ArtifactTexts& texts) {
    for (const std::size_t each : known.plan.captions) {
        texts.languages.push_back(pack.captions[each].language);
    }
    const Result<std::vector<SetLanguage>> set =
        texts.languages.empty() ? std::vector<SetLanguage>() : load_set_texts(known.file, texts.languages);
    if (!set) {
        return tl::unexpected<Error>(set.error());
    }
    if (Result<void> captions = set_captions(pack, known.plan, *set, texts); !captions) {
        return at(known.file.string(), captions.error());
    }
    Result<HotspotPictures> hotspots = upload_hotspots(
        pack.hotspots,
        {texts.languages, *set, known.plan.metres_per_box, settings_.exhibit.caption_height_m,
         settings_.projector.pinhole.fx / settings_.projector.table_from_projector.translation.z},
        store_);
    if (!hotspots) {
        return at(known.file.string(), hotspots.error());
    }
    texts.hotspots = std::move(*hotspots);
    const DescriptionRequest request{known.file, pack, *set, settings_.sound.kind != SoundKind::None};
    for (const std::size_t each : known.plan.captions) {
        Result<DescriptionPictures> description =
            make_description(request, pack.captions[each], captions_, store_);
        if (!description) {
            return at(known.file.string(), description.error());
        }
        texts.descriptions.push_back(*std::move(description));
    }
    return {};
}

Result<void> ArtifactOpener::set_captions(const Pack& pack, const ScenePlan& plan,
                                          std::span<const SetLanguage> set, ArtifactTexts& texts) {
    for (const std::size_t each : plan.captions) {
        const Result<std::vector<CaptionImage>> images = captions_.set(pack.captions[each], set);
        if (!images) {
            return tl::unexpected<Error>(images.error());
        }
        std::vector<CaptionPicture>& shapes = texts.captions.emplace_back();
        for (const CaptionImage& image : *images) {
            const Result<TextureId> texture = store_.upload(image.coverage);
            if (!texture) {
                return tl::unexpected<Error>(texture.error());
            }
            shapes.push_back(
                {*texture, image.size_m, caption_gpu_bytes(image.coverage.width, image.coverage.height)});
        }
    }
    return {};
}

} // namespace frustumscreen
