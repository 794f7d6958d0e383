/// The artifacts on the display: a set of them (shown_set.h), what lies on the table whatever set is shown, and the renderer.
/// A Presentation says what is shown, and what may be shown next. The set can be exchanged for another one between two frames.
///
/// Threads  the render thread, with the display's context current; also where it is destroyed.
/// Errors   a pack that cannot be loaded is left out with a line on standard error, also later; if none is left at the
///          start, BadConfiguration.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/render/renderer.h"
#include "app/residency/hotspot_show.h"
#include "app/residency/on_table.h"
#include "app/residency/run_levels.h"
#include "app/scene/device_plan.h"
#include "app/scene/frame_plan.h"
#include "app/scene/shader_key.h"
#include "app/settings/settings.h"
#include "app/show/mark_show.h"
#include "app/show/notice_show.h"
#include "app/show/show.h"
#include "app/show/shown_set.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <functional>
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
    int samples = default_samples;  ///< a pixel, that there is room for wherever the prop stands
    unsigned cull_kinds = AllCullKinds;
    std::string_view program = "frustumscreen"; ///< whose lines on standard error they are
    std::string packs_key = {}; ///< where the settings name the packs, for messages; empty: nowhere
    bool waits =
        false; ///< for all that is wanted, in each frame, so that a run of simulated time is repeatable
    std::uint64_t set_number = 0; ///< this and `attract`: as SetRequest
    std::vector<AttractLine> attract = {};
    bool other_sets = false; ///< may come: all that any set may need is there from the start
};

/// What a show uses, planned and observed.
struct ShowUse {
    std::set<ShaderKey> planned_shaders, shaders;
    std::uint64_t planned_gpu_bytes = 0;
    std::uint64_t gpu_bytes = 0;      ///< as the driver says
    std::uint64_t text_gpu_bytes = 0; ///< of the artifacts' texts that are loaded, as planned
    std::size_t captions = 0;         ///< that may come to be shown, each in some widths
    int samples = 1;                  ///< a pixel, that there is room for
};

class ArtifactShow final : public ExhibitStage {
public:
    /// Loads the first artifact and measures its levels on this GPU by drawing into `target`, which holds nothing useful afterwards.
    [[nodiscard]] static Result<std::unique_ptr<ArtifactShow>> create(const Settings& settings,
                                                                      const DevicePlan& devices,
                                                                      const ArtifactShowOptions& options,
                                                                      const RenderTarget& target);

    /// As the set was opened.
    [[nodiscard]] const Catalogue& catalogue() const { return set_->catalogue; }
    [[nodiscard]] const ShownSet& set() const { return *set_; }
    [[nodiscard]] const ZoneFrame& zone() const { return zone_; }
    [[nodiscard]] DrawResult draw(MonotonicTime now, const Presentation& presentation,
                                  const glm::dvec3& eye_m, const RenderTarget& target,
                                  Redraw redraw) override;
    void set_mark(const std::optional<ShownMark>& mark) override { mark_ = mark; }
    void record_time(MonotonicTime now, double ms) override;
    [[nodiscard]] ShowState state(const Presentation& presentation) const override;
    [[nodiscard]] SharedRecording recording(const WordIndex& word) const override {
        return set_->recording(word);
    }
    [[nodiscard]] SharedRecording recording(const DescriptionIndex& description) const override {
        return set_->artifact_cache->known(description.artifact).texts.recordings[description.language];
    }
    [[nodiscard]] bool speaks() const override;
    [[nodiscard]] std::span<const ArtifactState> artifacts() const override {
        return set_->artifact_cache->states();
    }
    [[nodiscard]] ArtifactTriangles triangles(std::size_t artifact) const override {
        return set_->artifact_cache->triangles(artifact);
    }
    /// The exhibit's own words that it has.
    [[nodiscard]] const std::vector<AdviceLanguage>& words() const { return set_->words.languages; }

    [[nodiscard]] ShowUse use() const;
    /// Sentences about what a person may not have meant.
    [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
    [[nodiscard]] const PacksLeftOut& left_out() const { return set_->artifact_cache->left_out(); }

    // For another set, where `other_sets` may come:
    [[nodiscard]] SetOptions set_options() const {
        SetOptions options = set_options_;
        options.gpu_bytes_that_stay = planned_bytes_that_stay();
        return options;
    }
    [[nodiscard]] const ExpectedFrames& expected_frames() const { return expected_; }
    [[nodiscard]] GpuStore& store() { return renderer_.store(); }
    /// Before it is shown. Where `other_sets` may come there is nothing left to do.
    [[nodiscard]] Result<void> prepare(const ShownSet& set);
    /// The set is shown from the next frame on; a presentation of the one before must not be drawn any more. Returns that one, of
    /// which nothing is released yet.
    [[nodiscard]] std::unique_ptr<ShownSet> exchange(std::unique_ptr<ShownSet> set);
    /// `artifact`: the index among the artifacts that are shown.
    [[nodiscard]] const ScenePlan& plan(std::size_t artifact) const {
        return set_->artifact_cache->known(artifact).plan;
    }
    /// Of an artifact that is ready, as the first is until another is shown.
    [[nodiscard]] const RunLevels& levels(std::size_t artifact) const {
        return *set_->artifact_cache->find(artifact);
    }

private:
    ArtifactShow(const Settings& settings, Renderer renderer);
    void note_language(const Settings& settings);
    void measure(const Settings& settings, const RenderTarget& target, bool other_sets);
    void warm_up(PlanView view, const RenderTarget& target);
    /// All that lies on the table whatever set is shown.
    [[nodiscard]] Result<void> upload_what_stays(const Settings& settings);
    [[nodiscard]] Result<void> upload_signs(const Settings& settings);
    [[nodiscard]] Result<void> upload_set(bool hotspots);
    [[nodiscard]] std::uint64_t planned_bytes_that_stay() const;
    /// The set's texts that a status or a report may still show when the set has gone.
    void keep_names();
    [[nodiscard]] std::string_view kept(std::string_view name) const;
    [[nodiscard]] std::optional<TablePicture> place_advice(const Presentation& presentation) const;
    /// The frame around the prop's zone.
    void place_zone_frame(const Presentation& presentation);
    void place_hotspot(const Presentation& presentation);
    /// What the guidance says.
    void place_signs(const Presentation& presentation);
    /// Nothing if none is shown, or if its picture is not there yet.
    [[nodiscard]] std::optional<TablePicture> place_caption(const Presentation& presentation) const;

    Pinhole projector_;
    RigidTransform table_from_projector_;
    PropShape prop_;
    double caption_brightness_; ///< share of the projector's light
    bool may_speak_ = false;    ///< in some set
    RenderNeeds needs_;
    Renderer renderer_;
    SetOptions set_options_;
    ExpectedFrames expected_;
    std::unique_ptr<ShownSet> set_;
    std::vector<std::string> notes_;
    std::set<std::string, std::less<>> names_; ///< titles and languages of all sets that were shown
    std::uint64_t past_switches_ = 0, past_ignored_times_ = 0; ///< of sets that have gone
    glm::dvec2 attract_place_m_;
    ZoneFrame zone_;
    TextureId white_ = TextureId::None;         ///< one texel: what the frame is drawn with
    std::array<TextureId, sign_count> signs_{}; ///< by Sign; none without guidance
    std::uint64_t planned_sign_bytes_ = 0;
    HotspotShow hotspots_;
    NoticeTextures notice_;
    MarkShow marks_;
    std::optional<ShownMark> mark_;     ///< of this frame
    std::vector<glm::dvec2> picture_m_; ///< what the projector's picture covers of the table
    OnTable on_table_;
    std::optional<std::size_t> on_; ///< the artifact that was drawn last; none: it was not there
    double load_ = 1.0;             ///< of the GPU (governor.h)
    FramePlan dark_;                ///< of a picture without an artifact
};

/// The exhibit of these artifacts on the settings' table.
[[nodiscard]] Exhibit make_exhibit(const Settings& settings, const ArtifactShow& artifacts,
                                   MonotonicTime now);

} // namespace frustumscreen
