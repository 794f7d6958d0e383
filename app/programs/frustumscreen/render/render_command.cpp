#include "app/programs/frustumscreen/render/render_command.h"

#include "app/programs/common/argument_checks.h"
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/common/progress_line.h"
#include "app/programs/frustumscreen/render/eye_choice.h"
#include "app/programs/frustumscreen/render/pin_option.h"
#include "app/programs/frustumscreen/render/pose_input.h"
#include "app/programs/frustumscreen/render/screen_painter.h"
#include "app/programs/frustumscreen/render/screen_pictures.h"
#include "app/programs/frustumscreen/render/site_option.h"
#include "app/scene/other_prop.h"
#include "app/settings/settings.h"
#include "app/show/offline_renderer.h"
#include "app/simulation/room.h"
#include "app/simulation/visitor_view.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/standard_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::programs {

namespace {

struct Request {
    std::filesystem::path config;
    std::filesystem::path pack;
    std::filesystem::path poses;
    std::filesystem::path out;
    std::string output = "prop";
    std::string view = "projector";
    std::string eye; ///< empty: as the settings show it
    int width = 0;   ///< width of the written pictures; 0: the view's
    int height = 0;
    bool no_light = false;
    std::vector<std::string> pins;
    std::string windows = "geometry"; ///< what draws them
    std::string site;                 ///< empty: the whole
    show::OfflineOptions options;
};

std::optional<int> read_arguments(int argc, char** argv, Request& request) {
    CommandLine app("Draws the pictures of a pose file: DIR/frame_00000.png ... and DIR/frames.csv.",
                    "frustumscreen render");
    app.add_option("--config", request.config, "the kiosk's settings, TOML").required();
    app.add_option("--pack", request.pack, "pack of the artifact, *.fspack; the screen's pictures need none");
    app.add_option("--poses", request.poses, "pose file, CSV").required();
    app.add_option("--out", request.out, "folder for the pictures; created if missing").required();
    app.add_option("--technique", request.options.technique,
                   "quality level to draw: auto, finest, level0, level1, ..., relief, relief96, ..., "
                   "relief-gpu, relief96-gpu, ...")
        .check(is_technique_word())
        .capture_default_str();
    const CommandOption width =
        app.add_option("--width", request.width, "width of the pictures, pixels (default: the settings')")
            .within(1, 16384);
    const CommandOption height =
        app.add_option("--height", request.height, "height of the pictures, pixels (default: the settings')")
            .within(1, 16384);
    width.needs(height);
    height.needs(width);
    app.add_option(
           "--output", request.output,
           "whose pictures: the projector's, of the artifact in the prop, or those of the screen behind "
           "the table, of the room in the settings")
        .one_of({"prop", "screen"})
        .capture_default_str();
    app.add_option("--view", request.view,
                   "picture to draw: the projector's; the visitor's view of the prop, which is half as wide "
                   "and high unless --width and --height are given; or room, the visitor's view of table, "
                   "prop and the screen behind")
        .one_of({"projector", "visitor", "room"})
        .capture_default_str();
    app.add_option("--eye", request.eye,
                   "draw the picture of one eye alone, in full size, or of both in the settings' layout "
                   "(default: both where eye.stereo is on, otherwise the point between the eyes)")
        .one_of({"left", "right", "both"});
    const auto behaviour =
        app.add_option("--behaviour", request.options.behaviour,
                       "move the pack's cells by this behaviour; it begins with the first pose");
    app.add_option("--state", request.options.state,
                   "draw the artifact in this state of the pack, in the prop and in windows")
        .excludes(behaviour);
    app.add_option("--torch", request.options.torch,
                   "light the artifact with the torch, station 3 of the poses: white, for plain light, or a "
                   "content of the pack");
    app.add_option(
           "--pin", request.pins,
           "pin what the first pose shows, as its eye sees it, as a window at X,Y on the table, metres, "
           "turned by YAW_DEG; all pictures show it; up to six times")
        .check(is_pin())
        .allow_extra_args(false)
        .type_name("X,Y[,YAW_DEG]");
    app.add_option(
           "--windows", request.windows,
           "what draws windows: geometry, the artifact's level or relief; or patches, points made of it "
           "beforehand for the eyes above the window")
        .one_of({"geometry", "patches"})
        .capture_default_str();
    app.add_option(
           "--site", request.site,
           "draw a part of a site large: the place X,Y of its ground in the prop's middle, ZOOM times "
           "larger than the miniature")
        .check(is_site())
        .type_name("X,Y,ZOOM");
    app.add_flag("--no-light", request.no_light, "do not compensate the projector's fall-off");
    app.add_flag("--aov", request.options.hit_points,
                 "also write hit points (frame_00000.pfm; prop frame, metres)");
    const std::optional<int> end = app.end_of_arguments(argc, argv);
    request.options.light = !request.no_light;
    if (request.view == "projector") {
        request.options.width = request.width;
        request.options.height = request.height;
    }
    return end;
}

/// Warns about places off the table: poses in millimetres, or in a tracker's frame, give dark pictures.
void say_off_the_table(const std::vector<tracking::TrackedState>& frames,
                       const settings::TableSettings& table) {
    const glm::dvec2 half_m = 0.5 * glm::dvec2(table.width_m, table.depth_m);
    const auto off = std::count_if(frames.begin(), frames.end(), [&](const tracking::TrackedState& frame) {
        const glm::dvec2 place_m(frame.table_from_prop.translation);
        return glm::any(glm::greaterThan(glm::abs(place_m), half_m));
    });
    if (off > 0) {
        say_line("frustumscreen",
                 fmt::format("in {} of {} poses the prop is off the table ({} x {} m); positions are metres",
                             off, frames.size(), table.width_m, table.depth_m));
    }
}

/// Inputs of one picture.
struct Studio {
    const Request& request;
    const settings::Settings& settings;
    show::OfflineRenderer& renderer;
    ScreenPainter* screen; ///< none: the settings have no screen, or the view does not show it
    EyeChoice eye;
    MonotonicTime begin;               ///< of the first pose
    std::vector<glm::dvec3> windows_m; ///< their corners

    [[nodiscard]] std::vector<glm::dvec3> eyes_m(const tracking::TrackedState& state) const {
        return chosen_eyes(eye, state, 1e-3 * settings.eye.interocular_mm);
    }
};

/// The view of the visitor's eye: the screen shines by its picture for this eye.
simulation::VisitorScene visitor_scene(const Studio& studio, const tracking::TrackedState& tracked_state,
                                       const glm::dvec3& eye_m) {
    const settings::Settings& settings = studio.settings;
    simulation::VisitorScene scene{.projector = studio.renderer.projector(),
                                   .table_from_projector = settings.projector.table_from_projector,
                                   .prop = studio.renderer.prop(),
                                   .table_from_prop = tracked_state.table_from_prop,
                                   .eye_m = eye_m,
                                   .table_size_m = {settings.table.width_m, settings.table.depth_m},
                                   .beside_m = studio.windows_m};
    if (studio.screen != nullptr) {
        studio.screen->draw(to_seconds(tracked_state.time - studio.begin), std::span(&eye_m, 1));
        scene.screen = simulation::VisitorScreen{.corners_m = settings.screen.corners_m,
                                                 .picture = studio.screen->picture()};
    }
    if (studio.request.view == "room") {
        scene.objects = simulation::room_around(scene.table_size_m, scene.table_from_projector.translation);
        const std::vector<simulation::RoomObject> stand = simulation::stand_of(*scene.screen);
        scene.objects.insert(scene.objects.end(), stand.begin(), stand.end());
    }
    return scene;
}

simulation::VisitorCamera camera_of(const Request& request, const simulation::VisitorScene& scene) {
    const int width = request.width > 0 ? request.width : std::max(1, scene.projector.width / 2);
    const int height = request.height > 0 ? request.height : std::max(1, scene.projector.height / 2);
    return request.view == "room" || !scene.beside_m.empty()
               ? simulation::whole_camera(scene, width, height)
               : simulation::visitor_camera(scene.prop, scene.table_from_prop, scene.eye_m, width, height);
}

std::vector<scene::PlacedTorch> torches_at(const Request& request,
                                           const tracking::TrackedState& tracked_state, double seconds,
                                           show::OfflineRenderer& renderer) {
    std::vector<scene::PlacedTorch> torches;
    if (const tracking::TrackedTorch& torch = tracked_state.torches.front();
        torch.share > 0.0 && !request.options.torch.empty()) {
        torches.push_back(renderer.torch_at(torch.table_from_torch, seconds));
    }
    return torches;
}

/// Writes one frame's files and returns its line of frames.csv.
Result<std::string> make_frame(const Studio& studio, std::size_t frame,
                               const tracking::TrackedState& tracked_state,
                               std::vector<simulation::VisitorFrame>& visitor_frames) {
    const std::vector<glm::dvec3> eyes_m = studio.eyes_m(tracked_state);
    const double seconds = to_seconds(tracked_state.time - studio.begin);
    const std::vector<scene::PlacedTorch> torches =
        torches_at(studio.request, tracked_state, seconds, studio.renderer);
    show::OfflinePicture picture =
        studio.renderer.draw(tracked_state.table_from_prop, eyes_m, seconds, torches);
    const std::int64_t t_us = to_microseconds(tracked_state.time);
    if (studio.request.view != "projector") {
        const simulation::VisitorScene scene = visitor_scene(studio, tracked_state, eyes_m.front());
        const simulation::VisitorCamera camera = camera_of(studio.request, scene);
        picture.colour = simulation::visitor_view(scene, picture.colour, camera,
                                                  studio.request.no_light ? simulation::exact_check()
                                                                          : simulation::VisitorViewOptions{});
        visitor_frames.push_back(
            {.frame = static_cast<int>(frame), .t_us = t_us, .eye_m = eyes_m.front(), .camera = camera});
    }
    const std::filesystem::path stem = studio.request.out / fmt::format("frame_{:05}", frame);
    TRY_VOID(write_file(stem.string() + ".png", image::encode_png(picture.colour)));
    if (picture.hit_points) {
        TRY_VOID(write_file(stem.string() + ".pfm", image::encode_pfm(*picture.hit_points)));
    }
    return fmt::format("{},{},{:.3f},{},{},{}\n", frame, t_us, picture.ms, studio.renderer.technique(),
                       picture.error ? fmt::format("{:.4f}", picture.error->mean_mm) : std::string(),
                       picture.error ? fmt::format("{:.4f}", picture.error->p95_mm) : std::string());
}

/// The options of the offline renderer, with every view that will be drawn.
show::OfflineOptions options_for(const Request& request, EyeChoice eye, const settings::EyeSettings& settings,
                                 const std::vector<tracking::TrackedState>& frames) {
    show::OfflineOptions options = request.options;
    options.both_eyes = eye == EyeChoice::Both;
    options.windows = request.pins.size();
    options.window_patches = options.windows > 0 && request.windows == "patches";
    options.site = request.site.empty() ? std::nullopt : std::optional(site_in(request.site));
    for (const tracking::TrackedState& frame : frames) {
        for (const glm::dvec3& eye_m : chosen_eyes(eye, frame, 1e-3 * settings.interocular_mm)) {
            options.views.push_back({frame.table_from_prop, eye_m});
        }
    }
    return options;
}

Result<void> make_folder(const std::filesystem::path& folder) {
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (failed) {
        return bad_input("render.no_folder", "{}: the folder cannot be made: {}", folder.string(),
                         failed.message());
    }
    return {};
}

/// An option that the screen's pictures do not use.
void say_unused(std::string_view option, bool given) {
    if (given) {
        say_line("frustumscreen",
                 fmt::format("{} is not used: --output screen draws the room alone", option));
    }
}

Result<void> render_screen(const Request& request, const settings::Settings& settings,
                           std::span<const tracking::TrackedState> frames) {
    say_unused("--pack", !request.pack.empty());
    say_unused("--technique", request.options.technique != "auto");
    say_unused("--behaviour", !request.options.behaviour.empty());
    say_unused("--state", !request.options.state.empty());
    say_unused("--view", request.view != "projector");
    say_unused("--pin", !request.pins.empty());
    say_unused("--site", !request.site.empty());
    TRY_VOID(make_folder(request.out));
    return write_screen_pictures(settings,
                                 {.eye = request.eye,
                                  .width = request.width,
                                  .height = request.height,
                                  .hit_points = request.options.hit_points,
                                  .out = request.out},
                                 frames);
}

Result<void> pin_windows(const Request& request, const std::vector<scene::WindowPlace>& places,
                         const std::vector<tracking::TrackedState>& frames, show::OfflineRenderer& renderer) {
    for (std::size_t k = 0; k < places.size() && !frames.empty(); ++k) {
        const glm::dvec3& eye_m = frames.front().eye_m;
        if (!renderer.pin(places[k], frames.front().table_from_prop, eye_m, 0.0,
                          torches_at(request, frames.front(), 0.0, renderer))) {
            return bad_input(
                "render.pin_eye",
                "--pin: the eye of the first pose is at {:.3f}, {:.3f}, {:.3f} m; whoever pins a "
                "window looks at it from above the table: give it a z above 0",
                eye_m.x, eye_m.y, eye_m.z);
        }
    }
    return {};
}

Result<void> render_prop(const Request& request, const settings::CheckedSettings& settings,
                         const std::vector<tracking::TrackedState>& frames) {
    if (request.pack.empty()) {
        return bad_input("render.no_pack",
                         "--pack is missing: the projector's pictures show a pack's artifact");
    }
    if (request.view == "room" && !settings->screen.exists()) {
        return bad_input("render.no_room_to_see",
                         "--view room: the settings have no screen; add a table [screen] with its room");
    }
    TRY(const EyeChoice eye, choose_eye(request.eye, settings::stereo_of(*settings),
                                        request.options.hit_points || request.view != "projector"));
    TRY(const std::vector<scene::WindowPlace> places, places_of(request.pins, settings->windows));
    const show::OfflineSetup setup{settings, options_for(request, eye, settings->eye, frames)};
    TRY(const show::OfflineScene scene,
        show::load_offline(request.pack, [&](const pack::PackOutline& /*outline*/) { return setup; }));
    if (const auto note = scene::note_other_prop(request.pack.string(), settings->prop,
                                                 pack::outline_of(*scene.pack), scene.plan)) {
        say_line("frustumscreen", *note);
    }
    TRY_VOID(make_folder(request.out));
    TRY(const std::unique_ptr<show::OfflineRenderer> renderer, show::OfflineRenderer::create(scene));
    TRY_VOID(pin_windows(request, places, frames, *renderer));
    std::unique_ptr<ScreenPainter> screen;
    if (settings->screen.exists() && request.view != "projector") {
        TRY(screen, ScreenPainter::create(*settings, request.eye, true));
    }
    const Studio studio{.request = request,
                        .settings = *settings,
                        .renderer = *renderer,
                        .screen = screen.get(),
                        .eye = eye,
                        .begin = frames.empty() ? MonotonicTime{} : frames.front().time,
                        .windows_m = corners_of(places)};
    std::string csv = "frame,t_us,ms,technique,estimated_error_mm,p95_error_mm\n";
    std::vector<simulation::VisitorFrame> visitor_frames;
    ProgressLine progress("rendering");
    for (std::size_t frame = 0; frame < frames.size(); ++frame) {
        TRY(const std::string line, make_frame(studio, frame, frames[frame], visitor_frames));
        csv += line;
        progress.show(frame + 1, frames.size());
    }
    std::error_code failed;
    std::filesystem::remove(request.out / simulation::visitor_cameras_name,
                            failed); // left by an earlier call
    if (!visitor_frames.empty()) {
        TRY_VOID(write_file(request.out / simulation::visitor_cameras_name,
                            as_bytes(simulation::visitor_cameras_json(visitor_frames))));
    }
    return write_file(request.out / "frames.csv", as_bytes(csv));
}

Result<void> render(const Request& request) {
    TRY(const settings::CheckedSettings settings, settings::load_settings(request.config));
    TRY(const std::vector<tracking::TrackedState> frames,
        load_pose_frames(request.poses, settings->eye.default_m));
    say_off_the_table(frames, settings->table);
    return request.output == "screen" ? render_screen(request, *settings, frames)
                                      : render_prop(request, settings, frames);
}

} // namespace

int render_command(int argc, char** argv) {
    Request request;
    if (const std::optional<int> end = read_arguments(argc, argv, request)) {
        return *end;
    }
    if (const Result<void> rendered = render(request); !rendered) {
        complain("frustumscreen", rendered.error());
        return 1;
    }
    return 0;
}

} // namespace frustumscreen::programs
