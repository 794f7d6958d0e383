/// ArtifactShow: what happens once, at the start: uploads, and the measurement of this GPU.
#include "app/exhibit/languages.h"
#include "app/render/block_upload.h"
#include "app/render/read_back.h"
#include "app/scene/window_patches.h"
#include "app/settings/guided.h"
#include "app/settings/lit_zone.h"
#include "app/show/artifact_show.h"
#include "firmware_host/display/egl_context.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace frustumscreen::show {

namespace {

constexpr double warm_up_step_m = 0.01;
constexpr double sample_side_m = 0.05;

} // namespace

Result<std::unique_ptr<ArtifactShow>> ArtifactShow::create(const settings::Settings& settings,
                                                           const scene::DevicePlan& devices,
                                                           const ArtifactShowOptions& options,
                                                           const render::RenderTarget& target) {
    const PixelSize picture = scene::stereo_layout(settings).display;
    TRY(render::Renderer renderer, render::Renderer::create(picture.width, picture.height));
    std::unique_ptr<ArtifactShow> show(new ArtifactShow(settings, std::move(renderer)));
    show->set_options_ = {.technique = options.technique,
                          .samples = options.samples,
                          .cull_kinds = options.cull_kinds,
                          .program = options.program,
                          .waits = options.waits,
                          .devices = devices,
                          .max_blocks_on_gpu = display::draws_on_processor(display::gl_driver_name())
                                                   ? 0
                                                   : render::max_blocks_on_gpu()};
    TRY_VOID(show->upload_what_stays(settings));
    TRY(show->set_, open_set(settings, show->set_options(),
                             {.number = options.set_number,
                              .packs = options.packs,
                              .packs_key = options.packs_key,
                              .attract = options.attract},
                             std::nullopt));
    show->needs_ = show->set_->needs;
    if (options.other_sets) {
        const bool blocks =
            show->set_options_.max_blocks_on_gpu > 0 || options.technique.ends_with(scene::on_gpu_suffix);
        show->needs_ =
            scene::united(show->needs_, residency::needs_of_any_pack(settings, options.samples, blocks));
        show->may_speak_ = settings.sound.kind != settings::SoundKind::None;
    }
    if (show->windows_) {
        show->needs_ = scene::with_points(std::move(show->needs_));
    }
    TRY_VOID(show->renderer_.prepare(show->needs_));
    TRY_VOID(show->upload_set(options.other_sets));
    if (show->windows_) {
        show->windows_->make_space(*show->set_->artifact_cache);
    }
    show->notes_ = show->set_->notes;
    show->note_language(settings);
    show->measure(settings, target, options.other_sets);
    show->keep_names();
    return show;
}

ArtifactShow::ArtifactShow(const settings::Settings& settings, render::Renderer renderer)
    : projector_(settings.projector.pinhole), layout_(scene::stereo_layout(settings)),
      table_from_projector_(settings.projector.table_from_projector),
      prop_(settings::make_prop(settings.prop)), caption_brightness_(settings.exhibit.caption_brightness),
      renderer_(std::move(renderer)), names_{settings.exhibit.language}, attract_place_m_(0.0),
      picture_m_(settings::picture_on_table(settings, 0.0)),
      dark_(layout_.count, scene::make_plan(prop_, 0, 1)) {
    const settings::Rectangle zone = settings::lit_rectangle(settings);
    attract_place_m_ = zone.centre_m;
    if (settings::shows_zone_frame(settings)) {
        zone_ = exhibit::ZoneFrame(zone, 0.5 * settings.prop.base_m,
                                   {settings.table.width_m, settings.table.depth_m});
    }
}

Result<void> ArtifactShow::upload_what_stays(const settings::Settings& settings) {
    if (settings::shows_zone_frame(settings)) {
        TRY(white_, renderer_.store().upload(image::Image<std::uint8_t>(1, 1, 255)));
    }
    if (settings::tells_of_sticks(settings)) {
        TRY_VOID(notice_.prepare(renderer_.store()));
    }
    if (settings.camera.drift) {
        TRY_VOID(marks_.prepare(renderer_.store()));
    }
    if (settings.torch.exists()) {
        torches_.emplace(settings.torch);
        TRY_VOID(torches_->prepare(renderer_.store()));
    }
    if (settings.windows.exist()) {
        windows_.emplace(settings, prop_, layout_.count, set_options_.waits);
        TRY_VOID(windows_->prepare(renderer_.store()));
    }
    return upload_signs(settings);
}

Result<void> ArtifactShow::upload_set(bool hotspots) {
    render::GpuStore& store = renderer_.store();
    const bool has_site =
        std::any_of(catalogue().begin(), catalogue().end(),
                    [](const exhibit::CatalogueEntry& entry) { return !entry.site.regions.empty(); });
    if (has_site && white_ == scene::TextureId::None) {
        TRY(white_, store.upload(image::Image<std::uint8_t>(1, 1, 255)));
    }
    if (hotspots ||
        std::any_of(catalogue().begin(), catalogue().end(),
                    [](const exhibit::CatalogueEntry& entry) { return !entry.hotspots.hotspots.empty(); })) {
        TRY(hotspots_, residency::HotspotShow::create(store));
    }
    constexpr std::uint64_t all = std::numeric_limits<std::uint64_t>::max();
    TRY_VOID(set_->word_pictures.upload(store, all));
    set_->table.upload(store, all);
    return set_->artifact_cache->upload_first(store);
}

Result<void> ArtifactShow::upload_signs(const settings::Settings& settings) {
    if (!settings::guides_visitors(settings)) {
        return {};
    }
    const double texels_per_m = residency::text_style(settings).texels_per_m;
    for (std::size_t k = 0; k < signs_.size(); ++k) {
        const image::Image<std::uint8_t> picture =
            exhibit::sign_picture(static_cast<exhibit::Sign>(k), texels_per_m);
        TRY(const scene::TextureId texture, renderer_.store().upload(picture));
        signs_.at(k) = texture;
        planned_sign_bytes_ += scene::caption_gpu_bytes(picture.width, picture.height);
    }
    return {};
}

std::uint64_t ArtifactShow::planned_bytes_that_stay() const {
    return (white_ != scene::TextureId::None ? scene::caption_gpu_bytes(1, 1) : 0) + planned_sign_bytes_ +
           hotspots_.planned_gpu_bytes() + notice_.planned_gpu_bytes() + marks_.planned_gpu_bytes() +
           (torches_ ? torches_->planned_gpu_bytes() : 0) + (windows_ ? windows_->planned_gpu_bytes() : 0);
}

void ArtifactShow::note_language(const settings::Settings& settings) {
    const std::vector<std::string>& languages = set_->languages;
    if (!settings.exhibit.captions || languages.empty() ||
        exhibit::has_language(languages, settings.exhibit.language)) {
        return;
    }
    const std::vector<std::string>& shown = catalogue().front().languages;
    notes_.push_back(fmt::format(
        "no artifact has captions in '{}', so {} is shown; the captions are in {}", settings.exhibit.language,
        shown.empty() ? settings.exhibit.language
                      : shown[exhibit::caption_for(settings.exhibit.language, shown)],
        fmt::join(languages, ", ")));
}

/// Measures at the middle of the table, seen by the default eye. Later artifacts are expected to cost as much as the
/// first one, triangle for triangle and sample for sample.
void ArtifactShow::measure(const settings::Settings& settings, const render::RenderTarget& target,
                           bool other_sets) {
    scene::PlanView view{.projector = layout_.pinhole,
                         .table_from_projector = table_from_projector_,
                         .table_from_prop = {},
                         .eyes_m = {}};
    const std::vector eyes_m(layout_.count, settings.eye.default_m);
    residency::ArtifactCache& artifact_cache = *set_->artifact_cache;
    residency::RunLevels& first = *artifact_cache.find(0);
    const scene::ScenePlan& plan = artifact_cache.known(0).plan;
    view.light = plan.light;
    view.brightness = artifact_cache.exposure(0);
    residency::RunCells* const cells = artifact_cache.find_cells(0);
    if (plan.quality_levels.size() > 1 || artifact_cache.size() > 1 || other_sets || cells != nullptr) {
        const std::array<scene::PlanView, 2> views = scene::views_of(layout_, view, eyes_m);
        first.measure(prop_, std::span(views).first(layout_.count), renderer_, target);
    }
    warm_up(view, eyes_m, target);
    expected_ = {
        .cost = scene::cost_of(first.times()), .prop = prop_, .view = view, .eye_m = settings.eye.default_m};
    if (cells != nullptr) {
        cells->start(expected_.cost);
    }
    artifact_cache.start(expected_.cost, prop_, expected_.view, expected_.eye_m);
    if (windows_) {
        windows_->set_cost(expected_.cost);
    }
}

/// Draws a whole picture and one that redraws only what moved, each with one of every picture on the table: drivers
/// compile on first use, and this should happen before the first frame.
void ArtifactShow::warm_up(scene::PlanView view, std::span<const glm::dvec3> eyes_m,
                           const render::RenderTarget& target) {
    if (const std::vector<std::vector<glm::dvec2>>& sizes = catalogue().front().caption_sizes_m;
        !sizes.empty()) {
        for (std::size_t language = 0; language < sizes.size() && !view.caption; ++language) {
            if (const residency::LoadedTexts* const caption =
                    set_->artifact_cache->texts(0, residency::TextPart::Caption, language)) {
                view.caption = scene::TablePicture{
                    .corners_m = residency::picture_corners({attract_place_m_, sizes[language].front()}),
                    .brightness = 1.0,
                    .texture = caption->texture(0)};
            }
        }
    }
    on_table_.clear();
    set_->table.place_samples(attract_place_m_, on_table_);
    const std::vector<std::vector<AdviceWord>>& words = set_->words.words;
    const scene::TextureId word =
        !words.empty() && !words.front().empty() ? set_->word({}, 0) : scene::TextureId::None;
    const auto [ring, notice] = notice_.samples();
    const scene::TextureId spot = torches_ ? torches_->spot() : scene::TextureId::None;
    for (const scene::TextureId texture :
         {white_, ring, notice, marks_.texture(), signs_.front(), word, spot}) {
        if (texture != scene::TextureId::None) {
            on_table_.add(
                {.corners_m = residency::picture_corners({attract_place_m_, glm::dvec2(sample_side_m)}),
                 .brightness = 1.0,
                 .texture = texture});
        }
    }
    view.on_table = on_table_.pictures();
    if (torches_) {
        view.torches = torches_->sample(attract_place_m_);
    }
    residency::RunLevels& levels = *set_->artifact_cache->find(0);
    if (windows_) {
        view.windows = windows_->sample(levels.shown(), attract_place_m_, eyes_m.front());
    }
    const LentSpace lent(windows_ ? &*windows_ : nullptr, levels.plans());
    render::RenderTarget drawn = target;
    for (const render::Redraw redraw : {render::Redraw::Everything, render::Redraw::Changes}) {
        const std::array<scene::PlanView, 2> views = scene::views_of(layout_, view, eyes_m);
        static_cast<void>(
            levels.draw({}, prop_, std::span(views).first(layout_.count), renderer_, drawn, redraw));
        drawn.buffer_age = 1;
        view.table_from_prop.translation.x += warm_up_step_m;
    }
    render::wait_until_drawn();
}

} // namespace frustumscreen::show
