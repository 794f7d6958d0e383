/// Opens packs for the show: of each its manifest is read, what is needed of it is planned, and its captions are set and
/// uploaded. Levels and their textures are left for later (residents.h).
///
/// Threads  the render thread before the first frame, with the display's context current.
/// Errors   as load_pack, as far as manifest and texts go; a technique that the pack does not have; no typeface where one
///          is needed. Messages begin with the file's name.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/render/gpu_store.h"
#include "app/settings/settings.h"
#include "app/show/caption_setter.h"
#include "app/show/description_pictures.h"
#include "app/show/hotspot_show.h"
#include "app/show/prepared_artifact.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen {

/// One text wrapped to one width.
struct CaptionPicture {
    TextureId texture = TextureId::None;
    glm::dvec2 size_m{0.0};
    std::uint64_t planned_gpu_bytes = 0;
};

/// What is said of an artifact.
struct ArtifactTexts {
    std::string title;
    std::vector<std::string> languages;
    /// One list for each of `languages`, in the catalogue's order.
    std::vector<std::vector<CaptionPicture>> captions;
    HotspotPictures hotspots;
    std::vector<DescriptionPictures> descriptions; ///< one for each of `languages`
    /// All of it.
    [[nodiscard]] std::uint64_t planned_gpu_bytes() const;
};
[[nodiscard]] Catalogue catalogue_of(std::span<const ArtifactTexts> artifacts);

struct OpenedArtifact {
    KnownArtifact known;
    ArtifactTexts texts;
};

class ArtifactOpener {
public:
    /// `other_languages`: a visitor can come to see them. `table_pictures`: as SceneRequest. `technique`, `samples`, `economies`: as ArtifactShowOptions.
    struct Options {
        std::string technique = "auto";
        int samples = 1;
        unsigned economies = AllEconomies;
        bool other_languages = false;
        bool table_pictures = false;
    };
    ArtifactOpener(const Settings& settings, Options options, GpuStore& store);

    [[nodiscard]] Result<OpenedArtifact> open(const std::filesystem::path& file);
    /// Takes its captions out of the store.
    void close(ArtifactTexts& texts);

    /// Of all captions of the packs opened, shown or not.
    [[nodiscard]] const std::vector<std::string>& languages() const { return languages_; }
    /// Sentences about what a person may not have meant.
    [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

private:
    [[nodiscard]] SceneRequest request(const PackOutline& outline) const;
    [[nodiscard]] Result<void> set_texts(const Pack& pack, const KnownArtifact& known, ArtifactTexts& texts);
    [[nodiscard]] Result<void> set_captions(const Pack& pack, const ScenePlan& plan,
                                            std::span<const SetLanguage> set, ArtifactTexts& texts);

    const Settings& settings_;
    Options options_;
    GpuStore& store_;
    CaptionSetter captions_;
    std::vector<std::string> languages_;
    std::vector<std::string> notes_;
};

} // namespace frustumscreen
