#include "app/show/notice_show.h"

#include "app/exhibit/languages.h"
#include "app/pack/words_file.h"
#include "app/residency/artifact_opener.h"
#include "app/scene/scene_plan.h"
#include "app/settings/guided.h"
#include "app/settings/lit_zone.h"
#include "app/show/house_words.h"
#include "app/typography/ring.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/standard_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

namespace frustumscreen {

namespace {

constexpr double empty_ring_brightness = 0.2; ///< relative to a text's
constexpr int sample_width = 5;
constexpr int sample_height = 3;

SharedRecording recording_of(const LanguageWords& words, const std::string& key, double gain_db) {
    const auto sound = words.sounds.find(key);
    if (sound == words.sounds.end()) {
        return nullptr;
    }
    return std::make_shared<const PromptRecording>(PromptRecording{
        fmt::format("{} in '{}'", key, words.language), sound->second, {}, words.language, key, {}, gain_db});
}

/// The function that draws notices; null: notices cannot be drawn, and a line says why.
ImportWatch::Draw draws_with(LanguageWords words, double texels_per_m) {
    Result<Typesetter> opened = Typesetter::open();
    if (!opened) {
        say_line("frustumscreen",
                 "what is done with a stick is not told on the table: " + opened.error().message);
        return [](const NoticeText&, const NoticeText&) { return SharedNotice(); };
    }
    words.sounds.clear();
    return [kept = std::make_shared<const LanguageWords>(std::move(words)),
            typesetter = std::make_shared<const Typesetter>(std::move(*opened)),
            texels_per_m](const NoticeText& text, const NoticeText& counts) {
        return std::make_shared<const NoticePicture>(
            draw_notice(text, counts, {kept->runs, kept->atlas, *typesetter, texels_per_m}));
    };
}

/// The axis-parallel rectangle around a sign, with a margin for its movement.
TableRectangle around(const PlacedSign& sign) {
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
    explicit Obstacles(const Presentation& presentation) {
        if (presentation.sign) {
            lit_.add(around(*presentation.sign));
        }
        if (presentation.advice) {
            lit_.add(presentation.advice->rectangle);
        }
        if (presentation.hotspot) {
            lit_.add(presentation.hotspot->label);
        }
        if (presentation.table != nullptr) {
            for (const PlacedPicture& picture : presentation.table->pictures()) {
                (picture.brightness > 0.0 ? lit_ : empty_).add(picture.place.whole());
            }
        }
    }
    [[nodiscard]] std::span<const TableRectangle> lit() const { return lit_.all(); }
    /// Places without a picture.
    [[nodiscard]] std::span<const TableRectangle> empty() const { return empty_.all(); }

private:
    class List {
    public:
        void add(const TableRectangle& rectangle) {
            if (count_ < all_.size()) {
                all_[count_++] = rectangle;
            }
        }
        [[nodiscard]] std::span<const TableRectangle> all() const { return std::span(all_).first(count_); }

    private:
        std::array<TableRectangle, CaptionPlacer::max_obstacles> all_{};
        std::size_t count_ = 0;
    };
    List lit_, empty_;
};

} // namespace

NoticeShow::NoticeShow(const Settings& settings, ImportWatch::Answer answer)
    : prop_(make_prop(settings.prop)), lens_m_(settings.projector.table_from_projector.translation),
      place_(picture_on_table(settings, 0.0)) {
    if (settings.exhibit.import_report.empty()) {
        return;
    }
    ImportWatch::Draw draw = [](const NoticeText&, const NoticeText&) { return SharedNotice(); };
    if (!tells_of_sticks(settings)) { // only in the journal and the status
        watch_.emplace(settings.exhibit.import_report, std::move(draw), answer);
        return;
    }
    Result<LanguageWords> words = read_house_words(settings, "stick.take_out");
    if (words && settings.sound.kind != SoundKind::None) {
        found_ = recording_of(*words, "stick.found", found_gain_db);
        take_out_ = recording_of(*words, "stick.take_out", 0.0);
    }
    if (words) {
        draw = draws_with(std::move(*words), text_style(settings).texels_per_m);
    } else {
        say_line("frustumscreen",
                 "what is done with a stick is not told on the table: " + words.error().message);
    }
    watch_.emplace(settings.exhibit.import_report, std::move(draw), answer);
}

bool NoticeShow::take_press(MonotonicTime now, std::span<const Command> commands) {
    const bool pressed = std::any_of(commands.begin(), commands.end(), is_press);
    return pressed && lies_there_ && notice_.press(now);
}

SharedNotice NoticeShow::wanted(const std::optional<ShownNotice>& shown) const {
    if (!shown || !import_) {
        return nullptr;
    }
    return shown->stopped ? import_->stopped : import_->notice;
}

void NoticeShow::step(MonotonicTime now, const TrackedState& tracked_state, Presentation& presentation) {
    if (!watch_) {
        return;
    }
    const SharedImport& latest = watch_->latest(now);
    if (latest != import_) {
        import_ = latest;
        notice_.take(now, import_->report, import_->is_old);
    }
    side_.update(tracked_state.eye_m);
    const std::optional<ShownNotice> shown = notice_.at(now);
    const SharedNotice notice = wanted(shown);
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

void NoticeShow::place(MonotonicTime now, const SharedNotice& wanted, const TrackedState& tracked_state,
                       Presentation& presentation) {
    const Obstacles obstacles(presentation);
    NoticeEnvironment environment{hidden_by_prop(prop_, presentation.table_from_prop, lens_m_),
                                  hidden_by_prop(prop_, presentation.table_from_prop, tracked_state.eye_m),
                                  glm::dvec2(presentation.table_from_prop.translation),
                                  side_.quarter_turns(),
                                  obstacles.lit(),
                                  obstacles.empty(),
                                  {}};
    if (presentation.caption) {
        environment.caption = presentation.caption->rectangle;
    }
    presentation.notice = place_.step(now, wanted, environment);
    if (presentation.notice && presentation.caption) {
        presentation.caption->brightness *=
            left_to_caption(presentation.caption->rectangle, *presentation.notice);
    }
}

Result<void> NoticeTextures::prepare(GpuStore& store) {
    return store.upload(Image<std::uint8_t>(1, 1, 255))
        .and_then([&](TextureId texel) {
            white_ = texel;
            return store.upload(Image<std::uint8_t>(sample_width, sample_height, 255));
        })
        .map([&](TextureId sample) { sample_ = sample; });
}

void NoticeTextures::follow(const SharedNotice& picture, std::size_t shape, GpuStore& store) {
    if (picture == picture_ && shape == shape_) {
        return;
    }
    store.release(std::exchange(texture_, TextureId::None));
    picture_ = picture;
    shape_ = shape;
    if (!picture_) {
        return;
    }
    texture_ = store.upload(picture_->shapes[shape].image.coverage).value_or(TextureId::None);
}

std::uint64_t NoticeTextures::planned_gpu_bytes() const {
    std::uint64_t bytes = white_ != TextureId::None
                              ? caption_gpu_bytes(1, 1) + caption_gpu_bytes(sample_width, sample_height)
                              : 0;
    if (texture_ != TextureId::None) {
        const Image<std::uint8_t>& coverage = picture_->shapes[shape_].image.coverage;
        bytes += caption_gpu_bytes(coverage.width, coverage.height);
    }
    return bytes;
}

void NoticeTextures::place(const std::optional<PresentedNotice>& notice, double brightness,
                           const Pinhole& projector, const RigidTransform& table_from_projector,
                           std::span<const glm::dvec2> room, GpuStore& store, OnTable& on_table) {
    follow(notice ? notice->picture : nullptr, notice ? notice->shape : 0, store);
    if (!notice) {
        return;
    }
    on_table.add({picture_corners(on_pixels(notice->rectangle, projector, table_from_projector)),
                  brightness * notice->brightness, texture_});
    const std::optional<TablePolygon> round = notice_ring(*notice);
    if (!round) {
        return;
    }
    const Ring ring = ring_around(*round, notice->ring_full, notice->rectangle.quarter_turns, room);
    for (const RingPiece& piece : ring.pieces()) {
        on_table.add({flat_corners(piece.corners_m),
                      brightness * notice->brightness * (piece.filled ? 1.0 : empty_ring_brightness),
                      white_});
    }
}

} // namespace frustumscreen
