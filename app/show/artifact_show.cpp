#include "app/show/artifact_show.h"

#include "app/exhibit/guidance_setup.h"
#include "app/exhibit/languages.h"
#include "app/render/read_back.h"
#include "app/settings/guided.h"
#include "app/settings/lit_zone.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace frustumscreen {

namespace {

constexpr double warm_up_step_m = 0.01;
constexpr double sample_side_m = 0.05;
/// Type size of what a visitor should do, in those of a caption.
constexpr double advice_em = 1.5;

} // namespace

Result<std::unique_ptr<ArtifactShow>> ArtifactShow::create(const Settings& settings,
                                                           const DevicePlan& devices,
                                                           const ArtifactShowOptions& options,
                                                           const RenderTarget& target) {
    const Pinhole& pinhole = settings.projector.pinhole;
    Result<Renderer> renderer = Renderer::create(pinhole.width, pinhole.height);
    if (!renderer) {
        return tl::unexpected<Error>(renderer.error());
    }
    const double deadline_ms = 1e3 / settings.projector.refresh_hz;
    Result<OpenedArtifacts> opened = open_artifacts(
        settings, options.packs,
        {options.technique, options.samples, options.economies, devices.language, devices.other_packs,
         chooses_on_table(settings) && devices.other_packs && options.packs.size() > 1, deadline_ms,
         options.program, options.packs_key});
    if (!opened) {
        return tl::unexpected<Error>(opened.error());
    }
    if (Result<void> ready = renderer->prepare(opened->needs); !ready) {
        return tl::unexpected<Error>(ready.error());
    }
    std::unique_ptr<ArtifactShow> show(new ArtifactShow(settings, *opened, std::move(*renderer)));
    if (Result<void> stays = show->upload_what_stays(settings, devices, opened->known); !stays) {
        return tl::unexpected<Error>(stays.error());
    }
    const auto budget = static_cast<std::uint64_t>(settings.exhibit.memory_mb) * 1'000'000;
    Result<std::unique_ptr<Residents>> residents = Residents::create(
        {std::move(opened->known), options.technique, deadline_ms,
         budget - std::min(budget, show->planned_bytes_that_stay()), text_style(settings),
         settings.exhibit.language, options.waits, options.program, std::move(opened->left_out)},
        std::move(*opened->first), show->renderer_.store());
    if (!residents) {
        return tl::unexpected<Error>(residents.error());
    }
    show->residents_ = std::move(*residents);
    show->note_language(settings, opened->languages);
    show->measure(settings, target);
    return show;
}

Result<void> ArtifactShow::upload_what_stays(const Settings& settings, const DevicePlan& devices,
                                             std::span<const KnownArtifact> artifacts) {
    if (std::any_of(catalogue_.begin(), catalogue_.end(),
                    [](const CatalogueEntry& entry) { return !entry.hotspots.hotspots.empty(); })) {
        Result<HotspotShow> hotspots = HotspotShow::create(renderer_.store());
        if (!hotspots) {
            return tl::unexpected<Error>(hotspots.error());
        }
        hotspots_ = std::move(*hotspots);
    }
    if (shows_zone_frame(settings)) {
        const Result<TextureId> white = renderer_.store().upload(Image<std::uint8_t>(1, 1, 255));
        if (!white) {
            return tl::unexpected<Error>(white.error());
        }
        white_ = *white;
    }
    if (Result<void> signs = upload_signs(settings); !signs) {
        return signs;
    }
    load_words(settings, devices);
    return load_table(settings, devices, artifacts);
}

Result<void> ArtifactShow::load_table(const Settings& settings, const DevicePlan& devices,
                                      std::span<const KnownArtifact> artifacts) {
    if (!chooses_on_table(settings) || artifacts.size() < 2) {
        return {};
    }
    TableShow::Request request{{}, devices.language};
    for (const KnownArtifact& artifact : artifacts) {
        request.packs.push_back(artifact.file);
    }
    Result<TableShow> table = TableShow::load(settings, request, renderer_.store());
    if (!table) {
        return tl::unexpected<Error>(table.error());
    }
    table_ = std::move(*table);
    notes_.insert(notes_.end(), table_.notes().begin(), table_.notes().end());
    return {};
}

std::uint64_t ArtifactShow::planned_bytes_that_stay() const {
    return (white_ != TextureId::None ? caption_gpu_bytes(1, 1) : 0) + planned_sign_bytes_ +
           words_.planned_gpu_bytes + table_.planned_gpu_bytes() + hotspots_.planned_gpu_bytes() +
           notice_.planned_gpu_bytes();
}

void ArtifactShow::note_language(const Settings& settings, const std::vector<std::string>& languages) {
    if (!settings.exhibit.captions || languages.empty() ||
        has_language(languages, settings.exhibit.language)) {
        return;
    }
    const std::vector<std::string>& shown = catalogue_.front().languages;
    notes_.push_back(fmt::format(
        "no artifact has captions in '{}'; {} is shown; there are {}", settings.exhibit.language,
        shown.empty() ? settings.exhibit.language : shown[caption_for(settings.exhibit.language, shown)],
        fmt::join(languages, ", ")));
}

/// Measures at the middle of the table, seen by the default eye. What comes later is expected to cost what the first
/// artifact does, triangle for triangle and sample for sample.
void ArtifactShow::measure(const Settings& settings, const RenderTarget& target) {
    PlanView view{projector_, table_from_projector_, {}, std::span(&settings.eye.default_m, 1)};
    RunLevels& first = *residents_->find(0);
    const ScenePlan& plan = residents_->known(0).plan;
    view.light = plan.light;
    view.brightness = residents_->exposure(0);
    if (plan.rungs.size() > 1 || residents_->size() > 1) {
        first.measure(prop_, view, renderer_, target);
    }
    warm_up(view, target);
    residents_->start(cost_of(first.times()), prop_, view, settings.eye.default_m);
}

/// Draws a whole picture and one that redraws what moved, each with one of all that lies on the table: drivers compile for what
/// a frame does, and this should be done before the first frame.
void ArtifactShow::warm_up(PlanView view, const RenderTarget& target) {
    if (const std::vector<std::vector<glm::dvec2>>& sizes = catalogue_.front().caption_sizes_m;
        !sizes.empty()) {
        for (std::size_t language = 0; language < sizes.size() && !view.caption; ++language) {
            if (const LoadedTexts* const caption = residents_->texts(0, TextPart::Caption, language)) {
                view.caption = TablePicture{picture_corners({attract_place_m_, sizes[language].front()}), 1.0,
                                            caption->texture(0)};
            }
        }
    }
    on_table_.clear();
    table_.place_samples(attract_place_m_, on_table_);
    const bool has_words = !words_.words.empty() && !words_.words.front().empty();
    const TextureId word = has_words ? words_.words.front().front().textures.front() : TextureId::None;
    for (const TextureId texture : {white_, signs_.front(), word}) {
        if (texture != TextureId::None) {
            on_table_.add({picture_corners({attract_place_m_, glm::dvec2(sample_side_m)}), 1.0, texture});
        }
    }
    view.on_table = on_table_.pictures();
    RenderTarget drawn = target;
    for (const Redraw redraw : {Redraw::Everything, Redraw::Changes}) {
        static_cast<void>(residents_->find(0)->draw({}, prop_, view, renderer_, drawn, redraw));
        drawn.buffer_age = 1;
        view.table_from_prop.translation.x += warm_up_step_m;
    }
    wait_until_drawn();
}

ArtifactShow::ArtifactShow(const Settings& settings, const OpenedArtifacts& opened, Renderer renderer)
    : projector_(settings.projector.pinhole), table_from_projector_(settings.projector.table_from_projector),
      prop_(make_prop(settings.prop)), caption_brightness_(settings.exhibit.caption_brightness),
      needs_(opened.needs), renderer_(std::move(renderer)), notes_(opened.notes),
      catalogue_(catalogue_of(opened.known)), attract_place_m_(0.0),
      picture_m_(picture_on_table(settings, 0.0)), dark_(make_plan(prop_, 0, 1)) {
    const Rectangle zone = lit_rectangle(settings);
    attract_place_m_ = zone.centre_m;
    if (shows_zone_frame(settings)) {
        zone_ = ZoneFrame(zone, 0.5 * settings.prop.base_m, {settings.table.width_m, settings.table.depth_m});
    }
}

Result<void> ArtifactShow::upload_signs(const Settings& settings) {
    if (!guides_visitors(settings)) {
        return {};
    }
    const double texels_per_m = text_style(settings).texels_per_m;
    for (std::size_t k = 0; k < signs_.size(); ++k) {
        const Image<std::uint8_t> picture = sign_picture(static_cast<Sign>(k), texels_per_m);
        const Result<TextureId> texture = renderer_.store().upload(picture);
        if (!texture) {
            return tl::unexpected<Error>(texture.error());
        }
        signs_.at(k) = *texture;
        planned_sign_bytes_ += caption_gpu_bytes(picture.width, picture.height);
    }
    return {};
}

void ArtifactShow::load_words(const Settings& settings, const DevicePlan& devices) {
    if (!guides_visitors(settings) || settings.exhibit.words.empty()) {
        return;
    }
    const TextStyle style = text_style(settings);
    AdviceWordsRequest request{settings.exhibit.words,
                               {settings.exhibit.language},
                               advice_em * style.em_m,
                               style.texels_per_m,
                               settings.sound.kind != SoundKind::None};
    for (const CatalogueEntry& artifact : catalogue_) {
        if (devices.language) {
            request.languages.insert(request.languages.end(), artifact.languages.begin(),
                                     artifact.languages.end());
        }
    }
    Result<AdviceWords> words = load_advice_words(request, renderer_.store());
    if (!words) {
        notes_.push_back("guidance shows signs without words: " + words.error().message);
        return;
    }
    words_ = std::move(*words);
}

bool ArtifactShow::speaks() const {
    for (const std::vector<AdviceWord>& language : words_.words) {
        for (const AdviceWord& word : language) {
            if (word.recording) {
                return true;
            }
        }
    }
    for (std::size_t artifact = 0; artifact < residents_->size(); ++artifact) {
        for (const SharedRecording& recording : residents_->known(artifact).texts.recordings) {
            if (recording) {
                return true;
            }
        }
    }
    return false;
}

std::optional<TablePicture> ArtifactShow::place_advice(const Presentation& presentation) const {
    if (!presentation.advice) {
        return std::nullopt;
    }
    const PresentedAdvice& advice = *presentation.advice;
    const AdviceWord& word = words_.words[advice.word.language][advice.word.text];
    return TablePicture{picture_corners(on_pixels(advice.rectangle, projector_, table_from_projector_)),
                        caption_brightness_ * advice.brightness, word.textures[advice.shape]};
}

void ArtifactShow::place_zone_frame(const Presentation& presentation) {
    if (white_ == TextureId::None) {
        return;
    }
    const double brightness = zone_brightness * caption_brightness_ * presentation.zone_share;
    for (const TableRectangle& side : zone_.sides()) {
        on_table_.add({picture_corners(side), brightness, white_});
    }
}

void ArtifactShow::place_hotspot(const Presentation& presentation) {
    if (!presentation.hotspot) {
        return;
    }
    const PresentedHotspot& hotspot = *presentation.hotspot;
    const CatalogueEntry& entry = catalogue_[hotspot.artifact];
    const LoadedTexts* const texts = residents_->texts(hotspot.artifact, TextPart::Telling, hotspot.language);
    if (texts != nullptr) {
        hotspots_.place(hotspot, texts->texture(label_picture(entry, hotspot.language, hotspot.hotspot)),
                        caption_brightness_, projector_, table_from_projector_, on_table_);
    }
}

void ArtifactShow::place_signs(const Presentation& presentation) {
    if (presentation.sign) {
        const PlacedSign& sign = *presentation.sign;
        on_table_.add({flat_corners(sign.corners_m), caption_brightness_ * sign.brightness,
                       signs_.at(static_cast<std::size_t>(sign.sign))});
    }
    if (const std::optional<TablePicture> advice = place_advice(presentation)) {
        on_table_.add(*advice);
    }
}

std::optional<TablePicture> ArtifactShow::place_caption(const Presentation& presentation) const {
    if (!presentation.caption) {
        return std::nullopt;
    }
    const PresentedCaption& caption = *presentation.caption;
    const LoadedTexts* const texts = residents_->texts(
        presentation.artifact, caption.portion ? TextPart::Telling : TextPart::Caption, caption.language);
    const TextureId texture =
        texts != nullptr ? texts->texture(portion_picture(caption.portion.value_or(0), caption.shape))
                         : TextureId::None;
    if (texture == TextureId::None) {
        return std::nullopt;
    }
    return TablePicture{picture_corners(on_pixels(caption.rectangle, projector_, table_from_projector_)),
                        caption_brightness_ * caption.brightness, texture};
}

DrawResult ArtifactShow::draw(MonotonicTime now, const Presentation& presentation, const glm::dvec3& eye_m,
                              const RenderTarget& target, Redraw redraw) {
    residents_->step(renderer_.store(), {presentation.artifact, presentation.table_language,
                                         presentation.wanted.artifacts(), presentation.wanted_language});
    PlanView view{projector_, table_from_projector_, presentation.table_from_prop, std::span(&eye_m, 1)};
    view.light = residents_->known(presentation.artifact).plan.light;
    view.brightness = residents_->exposure(presentation.artifact) * presentation.brightness;
    view.caption = place_caption(presentation);
    on_table_.clear();
    place_zone_frame(presentation);
    table_.place(presentation,
                 hidden_by_prop(prop_, presentation.table_from_prop, table_from_projector_.translation),
                 on_table_);
    if (presentation.stand_in) {
        table_.place_stand_in(*presentation.stand_in, on_table_);
    }
    place_hotspot(presentation);
    place_signs(presentation);
    notice_.place(presentation.notice, caption_brightness_, projector_, table_from_projector_, picture_m_,
                  renderer_.store(), on_table_);
    view.on_table = on_table_.pictures();
    RunLevels* const levels = residents_->find(presentation.artifact);
    if (levels == nullptr) {
        on_.reset();
        plan_frame(prop_, PlacedLevel{}, view, dark_);
        return renderer_.draw(dark_, target, redraw);
    }
    if (on_ != presentation.artifact) {
        levels->enter(now, load_);
        on_ = presentation.artifact;
    }
    return levels->draw(now, prop_, view, renderer_, target, redraw);
}

ShowUse ArtifactShow::use() const {
    ShowUse use;
    use.planned_shaders = shaders_of(needs_);
    use.shaders = renderer_.shaders();
    use.samples = needs_.samples;
    use.planned_gpu_bytes = gpu_bytes(needs_, projector_.width, projector_.height);
    use.text_gpu_bytes = residents_->uploaded_text_bytes();
    use.planned_gpu_bytes += planned_bytes_that_stay() + use.text_gpu_bytes;
    use.gpu_bytes = renderer_.bytes();
    for (std::size_t artifact = 0; artifact < catalogue_.size(); ++artifact) {
        use.captions += catalogue_[artifact].languages.size();
        if (const RunLevels* levels = residents_->find(artifact)) {
            for (const LevelUse& level : levels->uses()) {
                use.planned_gpu_bytes += level.planned_gpu_bytes;
            }
        }
    }
    return use;
}

void ArtifactShow::record_time(MonotonicTime now, double ms) {
    if (RunLevels* const levels = on_ ? residents_->find(*on_) : nullptr) {
        levels->record_time(now, ms);
        load_ = levels->load();
    }
}

ShowState ArtifactShow::state(const Presentation& presentation) const {
    const RunLevels* const shown = residents_->find(presentation.artifact);
    LevelState levels = shown != nullptr ? shown->state() : LevelState{};
    levels.switches = residents_->switches();
    levels.ignored_times = residents_->ignored_times();
    return {residents_->known(presentation.artifact).outline.description.title,
            presentation.language,
            levels,
            presentation.settled,
            presentation.attracts ? std::optional(presentation.table_from_prop) : std::nullopt,
            residents_->left_out(),
            presentation.lamps,
            residents_->ready(),
            residents_->bytes(),
            presentation.state};
}

Exhibit make_exhibit(const Settings& settings, const ArtifactShow& artifacts, MonotonicTime now) {
    const RigidTransform& table_from_projector = settings.projector.table_from_projector;
    ExhibitPlace place{make_prop(settings.prop),
                       table_from_projector.translation,
                       picture_on_table(settings, 0.0),
                       artifacts.zone(),
                       artifacts.attract_place_m(),
                       settings.panel.buttons(),
                       guides_visitors(settings) ? std::optional(guidance_setup(settings)) : std::nullopt,
                       artifacts.words(),
                       chooses_on_table(settings)};
    place.rest = Nanoseconds(std::llround(1e9 * settings.exhibit.rest_s));
    return {artifacts.catalogue(), place, settings.exhibit.language, now};
}

} // namespace frustumscreen
