// Draws, for the guide, the table during its calibration by touch and by camera, during a touch-up, and while the eyes
// are measured: the beginning, a cross or the place of a rest, a verdict.
//
//   draw_calibration_pictures FOLDER [WORDS LANGUAGE]

#include "app/image/image.h"
#include "app/programs/calibrate/table_pictures.h"
#include "app/settings/settings.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::tests {
namespace {

// The shipped set-up.
constexpr int width = 1920;
constexpr int height = 1200;
constexpr double above_m = 1.5;
constexpr int touches = 15;
constexpr double prop_px = 720.0;   ///< 30 cm under a projector of throw ratio 1.875
constexpr double board_px = 1008.0; ///< 42 cm under that projector

calibration::CrossSetup shipped_crosses(int count) {
    calibration::CrossSetup setup;
    setup.count = count;
    setup.top_m = geometry::shipped_frustum.height_m;
    setup.reach_m =
        calibration::reach_of({settings::TableSettings().width_m, settings::TableSettings().depth_m},
                              geometry::shipped_frustum.base_m);
    return setup;
}

struct Means {
    typography::Typesetter typesetter;
    std::optional<pack::LanguageWords> own_words;
};

template <typename Way>
Result<void> draw(const Way& way, const Means& means, const std::filesystem::path& file) {
    return write_file(file, image::encode_png(programs::table_picture(
                                way, {.width = width,
                                      .height = height,
                                      .prop_px = prop_px,
                                      .above_m = above_m,
                                      .board_px = board_px,
                                      .typesetter = means.typesetter,
                                      .own_words = means.own_words ? &*means.own_words : nullptr})));
}

/// `words`: a file and a language, or nothing.
Result<Means> means_with(std::span<char*> words) {
    TRY(typography::Typesetter typesetter, typography::Typesetter::open());
    if (words.empty()) {
        return Means{std::move(typesetter), std::nullopt};
    }
    TRY(const Bytes file, read_file(words[0]));
    TRY(pack::LanguageWords own_words, pack::read_words(file, words[1]));
    return Means{std::move(typesetter), std::move(own_words)};
}

/// Lays the prop on every cross, with the poses that a tracker would report.
void touch_all(calibration::TouchProcedure& procedure) {
    MonotonicTime now{};
    while (procedure.stage() == calibration::CalibrationStage::Place) {
        const double place = 0.1 * static_cast<double>(procedure.at());
        procedure.step({now, std::nullopt, true, false});
        for (int k = 0; k < 60 && procedure.stage() == calibration::CalibrationStage::HoldStill; ++k) {
            now += std::chrono::milliseconds(20);
            procedure.step(
                {now, geometry::RigidTransform{{1.0, 0.0, 0.0, 0.0}, {place, 0.0, 0.085}}, false, false});
        }
    }
}

/// A touch-up after the projector was bumped.
Result<void> draw_touch_up(const calibration::TouchModel& kept, const Means& means,
                           const std::filesystem::path& folder) {
    calibration::TouchProcedure procedure(calibration::TouchTask::TouchUp,
                                          calibration::choose_touch_up_crosses(kept, shipped_crosses(7), 2),
                                          7);
    TRY_VOID(draw(procedure, means, folder / "touch_up_begin.png"));
    procedure.step({MonotonicTime{}, std::nullopt, true, false});
    TRY_VOID(draw(procedure, means, folder / "touch_up_cross.png"));
    touch_all(procedure);
    calibration::TouchUp found;
    found.verdict = calibration::Verdict::Good;
    found.moved = calibration::Moved::Projector;
    found.table.emplace();
    found.off_m = 0.012;
    found.uncertainty.mean_m = 5e-4;
    procedure.judge(programs::judgement_of(found));
    return draw(procedure, means, folder / "touch_up_verdict.png");
}

/// Presses the button for the next step, and lets the camera see the light and the dark that are shown.
void look_at_light(calibration::AutoProcedure& procedure) {
    camera::CameraFrame frame{{}, 0, 16, 12, std::vector<std::uint8_t>(16 * 12)};
    calibration::AutoProcedure::Input input;
    input.next = true;
    procedure.step(input);
    input.next = false;
    for (int k = 0; k < 1000 && procedure.stage() == calibration::CalibrationStage::Delay; ++k) {
        input.now += std::chrono::milliseconds(20);
        if (!input.lit || input.lit->number != procedure.number()) {
            input.lit = calibration::CalibrationInput::Lit{procedure.number(), input.now};
        }
        const bool is_white = procedure.shown() == calibration::Pattern{calibration::Stripes::White};
        std::fill(frame.luma.begin(), frame.luma.end(), static_cast<std::uint8_t>(is_white ? 200 : 10));
        frame.time = input.now;
        input.frame = &frame;
        procedure.step(input);
    }
}

Result<void> draw_by_camera(const Means& means, const std::filesystem::path& folder) {
    TRY(const calibration::Board board, calibration::board_for({0.30, 0.08, 0.155}));
    calibration::AutoPlan plan;
    plan.stripes = calibration::stripes_for(width, height);
    plan.crosses_follow = true;
    calibration::AutoProcedure procedure(board, plan);
    TRY_VOID(draw(procedure, means, folder / "camera_begin.png"));
    look_at_light(procedure);
    return draw(procedure, means, folder / "camera_rest.png");
}

/// A person at the shipped table, from the first words to a verdict; the sightings are invented.
Result<void> draw_eyes(const geometry::Pinhole& pinhole, const Means& means,
                       const std::filesystem::path& folder) {
    const calibration::SightScene scene{pinhole, settings::ProjectorSettings().table_from_projector,
                                        geometry::make_frustum(geometry::shipped_frustum),
                                        settings::EyeSettings().default_m};
    calibration::EyeProcedure procedure(scene, {});
    calibration::EyeProcedure::Input input;
    const auto step = [&](bool next) {
        input.now += std::chrono::milliseconds(20);
        input.prop = calibration::first_place(scene);
        input.next = next;
        procedure.step(input);
    };
    TRY_VOID(draw(procedure, means, folder / "eyes_begin.png"));
    input.head = geometry::RigidTransform{{1.0, 0.0, 0.0, 0.0}, scene.usual_eye_m};
    step(true);
    for (int k = 0; k < 4000 && procedure.stage() != calibration::CalibrationStage::Solve; ++k) {
        input.head->rotation =
            glm::angleAxis(0.3 * static_cast<double>(procedure.at() % 3), glm::dvec3(1, 0, 0));
        const bool was_held = procedure.stage() == calibration::CalibrationStage::HoldStill;
        step(procedure.stage() == calibration::CalibrationStage::Shut ||
             procedure.stage() == calibration::CalibrationStage::Place);
        if (was_held && procedure.at() == 1 && procedure.stage() == calibration::CalibrationStage::Place) {
            TRY_VOID(draw(procedure, means, folder / "eyes_cross.png"));
        }
    }
    calibration::EyeFit fit;
    fit.verdict = calibration::Verdict::Usable;
    fit.reason.sentence =
        "the eye's place puts about 1.1 mm on the picture; with more sightings it would be good";
    fit.mean_residual_m = 5e-3;
    fit.worst_residual_m = 9e-3;
    fit.eyes.emplace();
    procedure.judge(fit);
    return draw(procedure, means, folder / "eyes_verdict.png");
}

Result<void> draw_all(const std::filesystem::path& folder, std::span<char*> words) {
    TRY(const Means means, means_with(words));
    geometry::Pinhole pinhole;
    pinhole.width = width;
    pinhole.height = height;
    pinhole.fx = pinhole.fy = 1.875 * width;
    pinhole.cx = 0.5 * width;
    pinhole.cy = 0.5 * height;
    const calibration::TouchModel kept = calibration::rough_model(pinhole, above_m, 0.085);
    calibration::TouchProcedure procedure(calibration::choose_crosses(kept, shipped_crosses(touches)));
    TRY_VOID(draw(procedure, means, folder / "calibrate_begin.png"));
    procedure.step({MonotonicTime{}, std::nullopt, true, false});
    TRY_VOID(draw(procedure, means, folder / "calibrate_cross.png"));
    touch_all(procedure);
    calibration::TouchCalibration judged; // a typical result for a table with the usual noise
    judged.verdict = calibration::Verdict::Usable;
    judged.uncertainty.shares = {0.7e-3, 1.8e-3, 4.4e-3};
    judged.reason.sentence =
        calibration::in_words(judged.uncertainty) + "; with more touches it would be good";
    judged.table.emplace();
    judged.mean_residual_m = 6e-4;
    judged.worst_residual_m = 1.3e-3;
    procedure.judge(programs::judgement_of(judged));
    TRY_VOID(draw(procedure, means, folder / "calibrate_verdict.png"));
    TRY_VOID(draw_touch_up(kept, means, folder));
    TRY_VOID(draw_by_camera(means, folder));
    return draw_eyes(pinhole, means, folder);
}

} // namespace
} // namespace frustumscreen::tests

int main(int argc, char** argv) {
    if (argc != 2 && argc != 4) {
        fmt::print(stderr, "usage: draw_calibration_pictures FOLDER [WORDS LANGUAGE]\n");
        return 2;
    }
    const auto drawn =
        frustumscreen::tests::draw_all(argv[1], std::span(argv, static_cast<std::size_t>(argc)).subspan(2));
    if (!drawn) {
        fmt::print(stderr, "draw_calibration_pictures: {}\n", drawn.error().message);
        return 1;
    }
    return 0;
}
