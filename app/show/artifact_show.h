/// The artifacts on the display: a set of them (shown_set.h), the pictures on the table that every set uses, and the
/// renderer. A Presentation says what is shown and what may be shown next. The set can be exchanged between two
/// frames.
///
/// Threads  the render thread, with the display's context current, including destruction.
/// Errors   a pack that cannot be loaded, at the start or later, is left out with a line on standard error. If none
///          is left at the start, BadConfiguration.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/render/renderer.h"
#include "app/residency/hotspot_show.h"
#include "app/residency/on_table.h"
#include "app/residency/run_levels.h"
#include "app/scene/device_plan.h"
#include "app/scene/frame_plan.h"
#include "app/scene/shader_key.h"
#include "app/scene/stereo.h"
#include "app/settings/settings.h"
#include "app/show/mark_show.h"
#include "app/show/notice_show.h"
#include "app/show/show.h"
#include "app/show/shown_set.h"
#include "app/show/torch_show.h"
#include "app/show/window_show.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::show {

struct ArtifactShowOptions {
    std::vector<std::filesystem::path> packs;
    std::string technique = "auto"; ///< "auto": the governor's choice; otherwise see scene::quality_level_of
    int samples =
        render::default_samples; ///< for each pixel; the render target holds them wherever the prop stands
    unsigned cull_kinds = scene::AllCullKinds;
    std::string_view program = "frustumscreen"; ///< named in lines on standard error
    std::string packs_key = {}; ///< the key of the packs in the settings, for messages; empty: none
    bool waits =
        false; ///< in each frame, for all requested data, so that a run of simulated time is repeatable
    std::uint64_t set_number = 0; ///< `set_number` and `attract`: as SetRequest
    std::vector<AttractLine> attract = {};
    bool other_sets =
        false; ///< other sets may follow: everything that any set may need is prepared at the start
};

/// The resources of a show, planned and observed.
struct ShowUse {
    std::set<scene::ShaderKey> planned_shaders, shaders;
    std::uint64_t planned_gpu_bytes = 0;
    std::uint64_t gpu_bytes = 0;      ///< as reported by the driver
    std::uint64_t text_gpu_bytes = 0; ///< planned, of the loaded texts of the artifacts
    std::size_t captions = 0;         ///< that may be shown, each in several widths
    int samples = 1;                  ///< a pixel, that the render target holds
};

class ArtifactShow final : public PresentationShow {
public:
    /// Loads the first artifact and measures its levels on this GPU by drawing into `target`, whose contents are
    /// undefined afterwards.
    [[nodiscard]] static Result<std::unique_ptr<ArtifactShow>> create(const settings::Settings& settings,
                                                                      const scene::DevicePlan& devices,
                                                                      const ArtifactShowOptions& options,
                                                                      const render::RenderTarget& target);

    /// The catalogue when the set was opened.
    [[nodiscard]] const exhibit::Catalogue& catalogue() const { return set_->catalogue; }
    [[nodiscard]] const ShownSet& set() const { return *set_; }
    [[nodiscard]] const exhibit::ZoneFrame& zone() const { return zone_; }
    [[nodiscard]] render::DrawResult draw(MonotonicTime now, const exhibit::Presentation& presentation,
                                          std::span<const glm::dvec3> eyes_m,
                                          const render::RenderTarget& target, render::Redraw redraw) override;
    void set_mark(const std::optional<drift::ShownMark>& mark) override { mark_ = mark; }
    void record_time(MonotonicTime now, double ms) override;
    [[nodiscard]] ShowState state(const exhibit::Presentation& presentation) const override;
    [[nodiscard]] residency::SharedRecording recording(const exhibit::WordIndex& word) const override {
        return set_->recording(word);
    }
    [[nodiscard]] residency::SharedRecording
    recording(const exhibit::DescriptionIndex& description) const override {
        return set_->artifact_cache->known(description.artifact).texts.recordings[description.language];
    }
    [[nodiscard]] bool speaks() const override;
    [[nodiscard]] std::span<const exhibit::ArtifactState> artifacts() const override {
        return set_->artifact_cache->states();
    }
    [[nodiscard]] std::span<const ArtifactInProp> in_prop() const override { return set_->in_prop; }
    [[nodiscard]] exhibit::ArtifactTriangles triangles(std::size_t artifact) const override {
        return set_->artifact_cache->triangles(artifact);
    }
    /// The exhibit's own texts of the set.
    [[nodiscard]] const std::vector<exhibit::AdviceLanguage>& words() const { return set_->words.languages; }

    [[nodiscard]] ShowUse use() const;
    /// Sentences about settings that may be unintended.
    [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
    [[nodiscard]] const library::UnshownPacks& left_out() const { return set_->artifact_cache->left_out(); }

    // For a change of the set, where `other_sets` may come:
    [[nodiscard]] SetOptions set_options() const {
        SetOptions options = set_options_;
        options.gpu_bytes_that_stay = planned_bytes_that_stay();
        return options;
    }
    [[nodiscard]] const ExpectedFrames& expected_frames() const { return expected_; }
    [[nodiscard]] render::GpuStore& store() { return renderer_.store(); }
    /// Call before the set is shown. With `other_sets` everything is already prepared.
    [[nodiscard]] Result<void> prepare(const ShownSet& set);
    /// Shows the set from the next frame on; a presentation of the previous set must not be drawn any more. Returns
    /// the previous set, whose GPU resources are not released yet.
    [[nodiscard]] std::unique_ptr<ShownSet> exchange(std::unique_ptr<ShownSet> set);
    /// `artifact`: index into the catalogue.
    [[nodiscard]] const scene::ScenePlan& plan(std::size_t artifact) const {
        return set_->artifact_cache->known(artifact).plan;
    }
    /// The levels of a ready artifact; the first is ready until another one is shown.
    [[nodiscard]] const residency::RunLevels& levels(std::size_t artifact) const {
        return *set_->artifact_cache->find(artifact);
    }

private:
    ArtifactShow(const settings::Settings& settings, render::Renderer renderer);
    void note_language(const settings::Settings& settings);
    void measure(const settings::Settings& settings, const render::RenderTarget& target, bool other_sets);
    void warm_up(scene::PlanView view, std::span<const glm::dvec3> eyes_m,
                 const render::RenderTarget& target);
    /// Uploads the pictures on the table that every set uses.
    [[nodiscard]] Result<void> upload_what_stays(const settings::Settings& settings);
    [[nodiscard]] Result<void> upload_signs(const settings::Settings& settings);
    [[nodiscard]] Result<void> upload_set(bool hotspots);
    [[nodiscard]] std::uint64_t planned_bytes_that_stay() const;
    /// Keeps the set's texts that a status or a report may show after the set has gone.
    void keep_names();
    [[nodiscard]] std::string_view kept(std::string_view name) const;
    [[nodiscard]] std::optional<scene::TablePicture>
    place_advice(const exhibit::Presentation& presentation) const;
    /// Places the frame around the prop's zone.
    void place_zone_frame(const exhibit::Presentation& presentation);
    void place_hotspot(const exhibit::Presentation& presentation);
    /// Places the title of the behaviour that the button begins.
    void place_title(const exhibit::Presentation& presentation);
    void place_state_titles(const exhibit::Presentation& presentation);
    /// Starts and ends behaviours and moves the cells. True: the cells of the artifact on show are drawn.
    [[nodiscard]] bool move_cells(MonotonicTime now, const exhibit::Presentation& presentation,
                                  residency::RunLevels* levels, residency::RunCells* cells);
    /// Sets the part of a site that the prop shows, and the mark on its miniature.
    void show_site(const exhibit::Presentation& presentation, residency::RunCells& cells) const;
    /// Places the map of a site while the prop shows a part of it.
    void place_site_map(const exhibit::Presentation& presentation);
    /// Places the sign of the guidance.
    void place_signs(const exhibit::Presentation& presentation);
    /// Steps what torches throw; returns what they throw now.
    [[nodiscard]] std::span<const scene::PlacedTorch> throw_light(const exhibit::Presentation& presentation);
    /// Nothing if no caption is shown, or if its picture is not loaded.
    [[nodiscard]] std::optional<scene::TablePicture>
    place_caption(const exhibit::Presentation& presentation) const;

    geometry::Pinhole projector_; ///< of the whole picture: texts are placed on its pixels
    scene::StereoLayout layout_;
    geometry::RigidTransform table_from_projector_;
    geometry::PropShape prop_;
    double caption_brightness_; ///< fraction of the projector's light
    bool may_speak_ = false;    ///< in at least one set
    scene::RenderNeeds needs_;
    render::Renderer renderer_;
    SetOptions set_options_;
    ExpectedFrames expected_;
    std::unique_ptr<ShownSet> set_;
    std::vector<std::string> notes_;
    std::set<std::string, std::less<>> names_; ///< titles and languages of all sets shown so far
    std::uint64_t past_switches_ = 0, past_ignored_times_ = 0; ///< of previous sets
    glm::dvec2 attract_place_m_;
    exhibit::ZoneFrame zone_;
    scene::TextureId white_ = scene::TextureId::None;           ///< one texel, for drawing the zone's frame
    std::array<scene::TextureId, exhibit::sign_count> signs_{}; ///< by Sign; None without guidance
    std::uint64_t planned_sign_bytes_ = 0;
    residency::HotspotShow hotspots_;
    NoticeTextures notice_;
    MarkShow marks_;
    std::optional<TorchShow> torches_;     ///< none: there is no torch
    std::optional<WindowShow> windows_;    ///< none: none can be pinned
    std::optional<drift::ShownMark> mark_; ///< of this frame
    std::vector<glm::dvec2> picture_m_;    ///< the part of the table that the projector's picture covers
    residency::OnTable on_table_;
    std::optional<std::size_t> on_;      ///< the artifact drawn last; none: it was not ready
    double load_ = 1.0;                  ///< of the GPU (governor.h)
    std::vector<scene::FramePlan> dark_; ///< for a picture without an artifact; one for each eye
};

/// The exhibit for these artifacts on the settings' table.
[[nodiscard]] exhibit::Exhibit make_exhibit(const settings::Settings& settings, const ArtifactShow& artifacts,
                                            MonotonicTime now);

} // namespace frustumscreen::show
