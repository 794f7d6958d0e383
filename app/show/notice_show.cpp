#include "app/show/notice_show.h"

#include "app/exhibit/languages.h"
#include "app/pack/words_file.h"
#include "app/residency/artifact_opener.h"
#include "app/scene/scene_plan.h"
#include "app/settings/guided.h"
#include "app/settings/lit_zone.h"
#include "app/show/default_words.h"
#include "app/typography/ring.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/standard_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

namespace frustumscreen::show {

namespace {

constexpr double empty_ring_brightness = 0.2; ///< relative to a text's
constexpr int sample_width = 5;
constexpr int sample_height = 3;

/// The function that draws notices; null: notices cannot be drawn, and a line says why.
ImportWatch::Draw draws_with(pack::LanguageWords words, double texels_per_m) {
    Result<typography::Typesetter> opened = typography::Typesetter::open();
    if (!opened) {
        say_line("frustumscreen", "the table shows no notices about sticks: " + opened.error().message);
        return [](const exhibit::NoticeText&, const exhibit::NoticeText&) { return exhibit::SharedNotice(); };
    }
    words.sounds.clear();
    return [kept = std::make_shared<const pack::LanguageWords>(std::move(words)),
            typesetter = std::make_shared<const typography::Typesetter>(std::move(*opened)),
            texels_per_m](const exhibit::NoticeText& text, const exhibit::NoticeText& counts) {
        return std::make_shared<const exhibit::NoticePicture>(
            exhibit::draw_notice(text, counts,
                                 {.runs = kept->runs,
                                  .atlas = kept->atlas,
                                  .typesetter = *typesetter,
                                  .texels_per_m = texels_per_m}));
    };
}

/// The axis-parallel rectangle around a sign, with a margin for its movement.
typography::TableRectangle around(const exhibit::PlacedSign& sign) {
    constexpr double moves_m = 0.02;
    glm::dvec2 low = sign.corners_m[0];
    glm::dvec2 high = low;
    for (const glm::dvec2& corner : sign.corners_m) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    return {0.5 * (low + high), high - low + 2.0 * moves_m, 0};
}

/// The pictures for visitors beside the prop, except the caption.
class Obstacles {
public:
    explicit Obstacles(const exhibit::Presentation& presentation) {
        if (presentation.sign) {
            lit_.add(around(*presentation.sign));
        }
        if (presentation.advice) {
            lit_.add(presentation.advice->rectangle);
        }
        if (presentation.hotspot) {
            lit_.add(presentation.hotspot->label);
        }
        if (presentation.title) {
            lit_.add(presentation.title->rectangle);
        }
        for (const exhibit::PresentedWindow& window : presentation.windows.windows()) {
            if (window.brightness > 0.0) {
                lit_.add(window.rectangle);
            }
        }
        if (presentation.table != nullptr) {
            for (const exhibit::PlacedPicture& picture : presentation.table->pictures()) {
                (picture.brightness > 0.0 ? lit_ : empty_).add(picture.place.whole());
            }
        }
    }
    [[nodiscard]] std::span<const typography::TableRectangle> lit() const { return lit_.all(); }
    /// Places without a picture.
    [[nodiscard]] std::span<const typography::TableRectangle> empty() const { return empty_.all(); }

private:
    class List {
    public:
        void add(const typography::TableRectangle& rectangle) {
            if (count_ < all_.size()) {
                all_[count_++] = rectangle;
            }
        }
        [[nodiscard]] std::span<const typography::TableRectangle> all() const {
            return std::span(all_).first(count_);
        }

    private:
        std::array<typography::TableRectangle, typography::CaptionPlacer::max_obstacles> all_{};
        std::size_t count_ = 0;
    };
    List lit_, empty_;
};

} // namespace

NoticeShow::NoticeShow(const settings::Settings& settings, ImportWatch::Answer answer)
    : prop_(settings::make_prop(settings.prop)), lens_m_(settings.projector.table_from_projector.translation),
      place_(settings::picture_on_table(settings, 0.0)) {
    if (settings.exhibit.import_report.empty()) {
        return;
    }
    ImportWatch::Draw draw = [](const exhibit::NoticeText&, const exhibit::NoticeText&) {
        return exhibit::SharedNotice();
    };
    if (!settings::tells_of_sticks(settings)) { // only in the journal and the status
        watch_.emplace(settings.exhibit.import_report, std::move(draw), answer);
        return;
    }
    Result<pack::LanguageWords> words = read_default_words(settings, "stick.take_out");
    if (words && settings.sound.kind != settings::SoundKind::None) {
        found_ = word_recording(*words, "stick.found", found_gain_db);
        take_out_ = word_recording(*words, "stick.take_out");
    }
    if (words) {
        draw = draws_with(std::move(*words), residency::text_style(settings).texels_per_m);
    } else {
        say_line("frustumscreen", "the table shows no notices about sticks: " + words.error().message);
    }
    watch_.emplace(settings.exhibit.import_report, std::move(draw), answer);
}

bool NoticeShow::take_press(MonotonicTime now, std::span<const settings::Command> commands) {
    const bool pressed = std::any_of(commands.begin(), commands.end(), settings::is_press);
    return pressed && lies_there_ && notice_.press(now);
}

exhibit::SharedNotice NoticeShow::wanted(const std::optional<exhibit::ShownNotice>& shown) const {
    if (!shown || !import_) {
        return nullptr;
    }
    return shown->stopped ? import_->stopped : import_->notice;
}

void NoticeShow::step(MonotonicTime now, const tracking::TrackedState& tracked_state,
                      exhibit::Presentation& presentation) {
    if (!watch_) {
        return;
    }
    const SharedImport& latest = watch_->latest(now);
    if (latest != import_) {
        import_ = latest;
        notice_.take(now, import_->report, import_->is_old);
    }
    side_.update(tracked_state.eye_m);
    const std::optional<exhibit::ShownNotice> shown = notice_.at(now);
    const exhibit::SharedNotice notice = wanted(shown);
    place(now, notice, tracked_state, presentation);
    if (presentation.notice) {
        presentation.notice->ring_full = shown ? shown->ring.value_or(1.0) : 1.0;
        presentation.settled = presentation.settled && presentation.notice->brightness >= 1.0;
    }
    const bool between_two = lies_there_ && notice != nullptr; // between two notices
    lies_there_ = (presentation.notice || between_two) && !presentation.staff;
    due_.reset();
    if (shown && lies_there_ && presentation.notice && presentation.notice->picture == notice &&
        !shown->speech.empty() && said_ != Said{shown->import, shown->speech}) {
        due_ = {shown->import, shown->speech};
    }
    announcement_ = !due_ ? nullptr : due_->key == "stick.found" ? found_ : take_out_;
}

void NoticeShow::place(MonotonicTime now, const exhibit::SharedNotice& wanted,
                       const tracking::TrackedState& tracked_state, exhibit::Presentation& presentation) {
    const Obstacles obstacles(presentation);
    exhibit::NoticeEnvironment environment{
        .shadow = typography::hidden_by_prop(prop_, presentation.table_from_prop, lens_m_),
        .hidden = typography::hidden_by_prop(prop_, presentation.table_from_prop, tracked_state.eye_m),
        .prop_m = glm::dvec2(presentation.table_from_prop.translation),
        .quarter_turns = side_.quarter_turns(),
        .obstacles = obstacles.lit(),
        .kept = obstacles.empty(),
        .caption = {}};
    if (presentation.caption) {
        environment.caption = presentation.caption->rectangle;
    }
    presentation.notice = place_.step(now, wanted, environment);
    if (presentation.notice && presentation.caption) {
        presentation.caption->brightness *=
            exhibit::left_to_caption(presentation.caption->rectangle, *presentation.notice);
    }
}

Result<void> NoticeTextures::prepare(render::GpuStore& store) {
    return store.upload(image::Image<std::uint8_t>(1, 1, 255))
        .and_then([&](scene::TextureId texel) {
            white_ = texel;
            return store.upload(image::Image<std::uint8_t>(sample_width, sample_height, 255));
        })
        .map([&](scene::TextureId sample) { sample_ = sample; });
}

void NoticeTextures::follow(const exhibit::SharedNotice& picture, std::size_t shape,
                            render::GpuStore& store) {
    if (picture == picture_ && shape == shape_) {
        return;
    }
    store.release(std::exchange(texture_, scene::TextureId::None));
    picture_ = picture;
    shape_ = shape;
    if (!picture_) {
        return;
    }
    texture_ = store.upload(picture_->shapes[shape].image.coverage).value_or(scene::TextureId::None);
}

std::uint64_t NoticeTextures::planned_gpu_bytes() const {
    std::uint64_t bytes =
        white_ != scene::TextureId::None
            ? scene::caption_gpu_bytes(1, 1) + scene::caption_gpu_bytes(sample_width, sample_height)
            : 0;
    if (texture_ != scene::TextureId::None) {
        const image::Image<std::uint8_t>& coverage = picture_->shapes[shape_].image.coverage;
        bytes += scene::caption_gpu_bytes(coverage.width, coverage.height);
    }
    return bytes;
}

void NoticeTextures::place(const std::optional<exhibit::PresentedNotice>& notice, double brightness,
                           const geometry::Pinhole& projector,
                           const geometry::RigidTransform& table_from_projector,
                           std::span<const glm::dvec2> area, render::GpuStore& store,
                           residency::OnTable& on_table) {
    follow(notice ? notice->picture : nullptr, notice ? notice->shape : 0, store);
    if (!notice) {
        return;
    }
    on_table.add({.corners_m = residency::picture_corners(
                      residency::on_pixels(notice->rectangle, projector, table_from_projector)),
                  .brightness = brightness * notice->brightness,
                  .texture = texture_});
    const std::optional<typography::TablePolygon> round = exhibit::notice_ring(*notice);
    if (!round) {
        return;
    }
    const typography::Ring ring =
        typography::ring_around(*round, notice->ring_full, notice->rectangle.quarter_turns, area);
    for (const typography::RingPiece& piece : ring.pieces()) {
        on_table.add(
            {.corners_m = residency::flat_corners(piece.corners_m),
             .brightness = brightness * notice->brightness * (piece.filled ? 1.0 : empty_ring_brightness),
             .texture = white_});
    }
}

} // namespace frustumscreen::show
