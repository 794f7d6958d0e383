/// The artifacts on the display: packs in the GPU's memory, their levels and captions, and the renderer. A
/// Presentation says what is shown.
///
/// Threads  the render thread, with the display's context current; also where it is destroyed.
/// Errors   a pack that cannot be loaded is left out with a line on standard error; if none is left,
///          BadConfiguration.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/render/renderer.h"
#include "app/scene/frame_plan.h"
#include "app/scene/shader_key.h"
#include "app/settings/settings.h"
#include "app/show/advice_words.h"
#include "app/show/description_pictures.h"
#include "app/show/run_levels.h"
#include "app/show/show.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

struct ArtifactShowOptions {
    std::vector<std::filesystem::path> packs;
    std::string technique = "auto"; ///< "auto": the governor's choice; else see `level_of`
    int samples = default_samples;  ///< a pixel, that there is room for
    unsigned economies = AllEconomies;
    std::string_view program = "frustumscreen"; ///< whose lines on standard error they are
    std::string packs_key = {}; ///< where the settings name the packs, for messages; empty: nowhere
};

/// What a show uses, planned and observed.
struct ShowUse {
    std::set<ShaderKey> planned_shaders, shaders;
    std::uint64_t planned_gpu_bytes = 0;
    std::uint64_t gpu_bytes = 0; ///< as the driver says
    std::uint64_t caption_gpu_bytes = 0;
    std::size_t captions = 0; ///< texts, each in some widths
    int samples = 1;          ///< a pixel, that there is room for
};

class ArtifactShow final : public Stage {
public:
    /// Measures the levels on this GPU by drawing into `target`, which holds nothing useful afterwards.
    [[nodiscard]] static Result<std::unique_ptr<ArtifactShow>> create(const Settings& settings,
                                                                      const DevicePlan& devices,
                                                                      const ArtifactShowOptions& options,
                                                                      const RenderTarget& target);

    [[nodiscard]] const Catalogue& catalogue() const { return catalogue_; }
    [[nodiscard]] const ZoneFrame& zone() const { return zone_; }
    /// Where an artifact stands while nobody knows where the prop is; table coordinates.
    [[nodiscard]] const glm::dvec2& attract_place_m() const { return attract_place_m_; }
    [[nodiscard]] DrawResult draw(MonotonicTime now, const Presentation& presentation,
                                  const glm::dvec3& eye_m, const RenderTarget& target,
                                  Redraw redraw) override;
    void record_time(MonotonicTime now, double ms) override;
    [[nodiscard]] ShowState state(const Presentation& presentation) const override;
    [[nodiscard]] SharedRecording recording(const WordIndex& word) const override {
        return words_.words[word.language][word.text].recording;
    }
    [[nodiscard]] SharedRecording recording(const DescriptionIndex& description) const override {
        return artifacts_[description.artifact].descriptions[description.language].recording;
    }
    [[nodiscard]] bool speaks() const override;
    /// The exhibit's own words that it has.
    [[nodiscard]] const std::vector<AdviceLanguage>& words() const { return words_.languages; }

    [[nodiscard]] ShowUse use() const;
    /// Sentences about what a person may not have meant.
    [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
    /// `artifact`: the index among the artifacts that are shown.
    [[nodiscard]] const ScenePlan& plan(std::size_t artifact) const { return artifacts_[artifact].plan; }
    [[nodiscard]] const RunLevels& levels(std::size_t artifact) const { return artifacts_[artifact].levels; }

private:
    /// One text wrapped to one width.
    struct CaptionPicture {
        TextureId texture = TextureId::None;
        glm::dvec2 size_m{0.0};
        std::uint64_t planned_gpu_bytes = 0;
    };
    struct Artifact {
        std::string title;
        ScenePlan plan;
        RunLevels levels;
        double exposure = 1.0; ///< factor of linear light
        std::vector<std::string> languages;
        /// One list for each of `languages`, in the catalogue's order.
        std::vector<std::vector<CaptionPicture>> captions;
        std::vector<DescriptionPictures> descriptions = {}; ///< one for each of `languages`
    };
    struct Loader;

    ArtifactShow(const Settings& settings, const RenderNeeds& needs, Renderer renderer,
                 std::vector<Artifact> artifacts);
    void measure(const Settings& settings, const RenderTarget& target);
    void warm_up(Artifact& artifact, PlanView view, const RenderTarget& target);
    [[nodiscard]] Result<void> upload_signs(const Settings& settings);
    /// Without its words the exhibit shows signs alone, and a note says why.
    void load_words(const Settings& settings, const DevicePlan& devices);
    [[nodiscard]] std::optional<TablePicture> place_advice(const Presentation& presentation) const;
    /// The frame around the prop's zone and the sign of the guidance; none if they are dark.
    [[nodiscard]] std::span<const TablePicture> place_signs(const Presentation& presentation);
    /// Nothing if none is shown.
    [[nodiscard]] std::optional<TablePicture> place_caption(const Presentation& presentation) const;

    Pinhole projector_;
    RigidTransform table_from_projector_;
    PropShape prop_;
    double caption_brightness_; ///< share of the projector's light
    RenderNeeds needs_;
    Renderer renderer_;
    std::vector<Artifact> artifacts_;
    std::vector<PackLeftOut> left_out_;
    std::vector<std::string> notes_;
    Catalogue catalogue_;
    glm::dvec2 attract_place_m_;
    ZoneFrame zone_;
    TextureId white_ = TextureId::None;         ///< one texel: what the frame is drawn with
    std::array<TextureId, sign_count> signs_{}; ///< by Sign; none without guidance
    std::uint64_t planned_sign_bytes_ = 0;
    AdviceWords words_;
    std::array<TablePicture, most_lines> lines_{};
    std::size_t on_ = 0; ///< the artifact that is on
};

/// The exhibit of these artifacts on the settings' table.
[[nodiscard]] Exhibit make_exhibit(const Settings& settings, const ArtifactShow& artifacts,
                                   MonotonicTime now);

} // namespace frustumscreen
